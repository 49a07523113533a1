//! Frictionless punch of power-law shape on a half-plane: `g = c|x|^m`, `m >= 1`.
//!
//! D. A. Spence, Proc. R. Soc. A 305 (1968) 55; K. L. Johnson, *Contact Mechanics* (1985), section 5.3. From Abel's
//! integrals: `P ~ b^m`, and with `b' = |x| cosh t` the pressure is
//! `p = (m P/(pi b)) int_0^L (xi cosh t)^(m-1) dt`, `xi = |x|/b = 1/cosh L`: positive and smooth for any real `m`,
//! which no hypergeometric series is over the whole contact. `m = 1` is the wedge, `m = 2` the cylinder.

use super::adaptive::integral;
use spec_math::cephes64::gamma;
use std::f64::consts::PI;

/// A power-law punch in contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Power {
    /// `c` of `g = c|x|^m`, length^(1-m).
    pub coefficient: f64,
    /// `m >= 1`, any real number; up to 100 or so the gamma functions do not overflow.
    pub exponent: f64,
    /// Half-width `b` of the contact.
    pub half_width: f64,
    /// Compliance `A0 = (kappa + 1)/(4 mu)` of the half-plane, 1/stress.
    pub compliance: f64,
}

impl Power {
    /// The contact under a `force` per unit length.
    pub fn pressed(coefficient: f64, exponent: f64, compliance: f64, force: f64) -> Self {
        let unit = Self { coefficient, exponent, half_width: 1.0, compliance };
        Self { half_width: (force / unit.force()).powf(1.0 / exponent), ..unit }
    }

    /// `P = (c m sqrt(pi)/A0) Gamma((m+1)/2)/Gamma(m/2+1) b^m`, per unit length.
    pub fn force(self) -> f64 {
        let m = self.exponent;
        let beta = PI.sqrt() * gamma(0.5 * (m + 1.0)) / gamma(0.5 * m + 1.0);
        self.coefficient * m * beta * self.half_width.powf(m) / self.compliance
    }

    /// `dP/db = m P/b`.
    pub fn force_rate(self) -> f64 {
        self.exponent * self.force() / self.half_width
    }

    /// The pressure; 0 outside the contact, infinite in the middle of a wedge.
    pub fn pressure(self, x: f64) -> f64 {
        let (x, b, m) = (x.abs(), self.half_width, self.exponent);
        if x >= b {
            return 0.0;
        }
        let share = if x > 0.0 {
            // L = acosh(b/x), in a form that keeps its digits at the edge.
            let range = (((b - x) * (b + x)).sqrt() / x).asinh();
            // xi cosh t by the distance to the upper end: neither factor overflows near the middle.
            let rise = |to_upper: f64| (-to_upper).exp() * (1.0 + (-2.0 * (range - to_upper)).exp());
            let top = rise(0.0);
            integral(range, |node| (rise(node.to_upper) / top).powf(m - 1.0))
        } else {
            1.0 / (m - 1.0)
        };
        self.force_rate() / PI * share
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::cylinder::Cylinder;
    use crate::reference::wedge::Wedge;
    use crate::reference::{abel, surface};

    fn contact(exponent: f64) -> Power {
        Power { coefficient: 0.3, exponent, half_width: 0.8, compliance: 0.6 }
    }

    const POINTS: [f64; 6] = [1e-200, 1e-9, 1e-3, 0.3, -0.6, 0.799];

    #[test]
    fn exponents_one_and_two_are_old_friends() {
        let wedge = Wedge { slope: 0.3, half_width: 0.8, compliance: 0.6 };
        // c = 1/(2 R)
        let cylinder = Cylinder { radius: 1.0 / 0.6, half_width: 0.8, compliance: 0.6 };
        assert!((contact(1.0).force() / wedge.force() - 1.0).abs() < 1e-15, "three roundings");
        assert!((contact(2.0).force() / cylinder.force() - 1.0).abs() < 1e-15, "three roundings");
        for x in POINTS {
            let (got, exact) = (contact(1.0).pressure(x), wedge.pressure(x));
            assert!((got / exact - 1.0).abs() < 1e-14, "wedge at {x}: {got} against {exact}");
            let (got, exact) = (contact(2.0).pressure(x), cylinder.pressure(x));
            assert!((got / exact - 1.0).abs() < 1e-14, "cylinder at {x}: {got} against {exact}");
        }
    }

    /// `m = 4`: `int_x^b s^3/sqrt(s^2 - x^2) ds = (b^2 + 2 x^2)/3 sqrt(b^2 - x^2)`, and `P = 3 pi c b^4/(2 A0)`.
    #[test]
    fn the_fourth_power_is_elementary() {
        let quartic = contact(4.0);
        let force = 1.5 * PI * 0.3 * 0.8_f64.powi(4) / 0.6;
        assert!((quartic.force() / force - 1.0).abs() < 1e-15);
        for x in POINTS {
            let exact =
                4.0 * force / PI / 0.8_f64.powi(4) * (0.64 + 2.0 * x * x) / 3.0 * ((0.8 - x) * (0.8 + x)).sqrt();
            let got = quartic.pressure(x);
            assert!((got / exact - 1.0).abs() < 1e-14, "at {x}: {got} against {exact}");
        }
    }

    #[test]
    fn other_exponents_are_stacks_of_flat_punches() {
        for m in [1.0, 1.1, 1.5, 2.7, 6.0, 20.0, 61.3] {
            let slope = |x: f64| 0.3 * m * x.powf(m - 1.0);
            let force = abel::force(slope, &[], 0.8, 0.6);
            // Cephes says 2.3e-16 to 2e-15 of its gamma function.
            assert!((contact(m).force() / force - 1.0).abs() < 5e-15, "P at m = {m}: {force}");
            // Towards the middle the sum has more and more decades to cover with its nodes.
            for x in &POINTS[1..] {
                let (x, rate) = (*x, |b: f64| Power { half_width: b, ..contact(m) }.force_rate());
                let (got, sum) = (contact(m).pressure(x), abel::pressure(rate, &[], 0.8, x));
                // Rounding of both sums.
                assert!((got / sum - 1.0).abs() < 1e-13, "m = {m}, x = {x}: {got} against {sum}");
            }
            let back = Power::pressed(0.3, m, 0.6, contact(m).force()).half_width;
            assert!((back / 0.8 - 1.0).abs() < 1e-15, "{back}");
        }
    }

    #[test]
    fn the_middle_is_a_limit() {
        for m in [1.5, 2.0, 3.3] {
            let (at, beside) = (contact(m).pressure(0.0), contact(m).pressure(1e-60));
            // The next term is (x/b)^(m-1).
            assert!((at / beside - 1.0).abs() < 1e-14, "m = {m}: {at} and {beside}");
        }
        assert!(contact(1.0).pressure(0.0).is_infinite());
    }

    #[test]
    fn the_surface_takes_the_shape_of_the_punch() {
        for m in [1.5, 3.3] {
            for x in [0.01, 0.5] {
                let slope = 0.6 * surface::cauchy(|r| contact(m).pressure(r), 0.8, &[0.0], x);
                let exact = 0.3 * m * x.powf(m - 1.0);
                // What the check leaves out beside the pole, in units of the largest slope.
                assert!((slope - exact).abs() < 1e-11, "m = {m}: slope {slope} at x = {x}");
            }
        }
    }
}
