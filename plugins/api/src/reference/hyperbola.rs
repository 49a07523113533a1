//! Frictionless wedge with a tip rounded off to a hyperbola on a half-plane: `g = s (sqrt(x^2 + c^2) - c)`.
//!
//! Derived here from Abel's integrals: with `D = sqrt(b^2 + c^2)` and the complete elliptic integrals of `m = b^2/D^2`,
//! `P = (2 s/A0) (D E - c^2 K/D)` and `dP/db = (2 s/A0) (b/D) E`. Its singular points `+-i c` stand as close to the
//! middle as it is sharp, though it is smooth.

use super::adaptive::integral;
use spec_math::cephes64::{ellpe, ellpk};
use std::f64::consts::PI;

/// A wedge with a hyperbolic tip in contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hyperbola {
    /// Slope `s` of the flanks, far out.
    pub slope: f64,
    /// How far from the middle the flanks are reached, `c > 0`.
    pub rounding: f64,
    /// Half-width `b` of the contact.
    pub half_width: f64,
    /// Compliance `A0 = (kappa + 1)/(4 mu)` of the half-plane, 1/stress.
    pub compliance: f64,
}

impl Hyperbola {
    /// `P`, per unit length.
    pub fn force(self) -> f64 {
        let (c, d) = (self.rounding, self.distance());
        2.0 * self.slope / self.compliance * (d * self.second_kind() - c * c / d * self.first_kind())
    }

    /// `dP/db`.
    pub fn force_rate(self) -> f64 {
        2.0 * self.slope / self.compliance * self.half_width / self.distance() * self.second_kind()
    }

    /// The pressure, summed over flat punches `b' = |x| cosh t`, in the middle `(2 s/(pi A0)) (b/D) K`; 0 outside the
    /// contact.
    pub fn pressure(self, x: f64) -> f64 {
        let (x, b) = (x.abs(), self.half_width);
        if x >= b {
            return 0.0;
        }
        if x == 0.0 {
            return 2.0 * self.slope / (PI * self.compliance) * b / self.distance() * self.first_kind();
        }
        // acosh(b/x), in a form that keeps its digits at the edge.
        let range = (((b - x) * (b + x)).sqrt() / x).asinh();
        integral(range, |node| Self { half_width: x * node.from_lower.cosh(), ..self }.force_rate()) / PI
    }

    fn distance(self) -> f64 {
        self.half_width.hypot(self.rounding)
    }

    /// `K`, which Cephes tells from `1 - m`.
    fn first_kind(self) -> f64 {
        ellpk((self.rounding / self.distance()).powi(2))
    }

    /// `E`.
    fn second_kind(self) -> f64 {
        ellpe((self.half_width / self.distance()).powi(2))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::abel;
    use crate::reference::wedge::Wedge;

    fn contact(rounding: f64) -> Hyperbola {
        Hyperbola { slope: 0.3, rounding, half_width: 0.8, compliance: 0.6 }
    }

    #[test]
    fn it_is_a_stack_of_flat_punches() {
        for c in [5.0, 0.3, 0.01] {
            let exact = abel::force(|x| 0.3 * x / x.hypot(c), &[], 0.8, 0.6);
            let cancelled = 1e-15 * (1.0 + c * c);
            assert!((contact(c).force() / exact - 1.0).abs() < 2.0 * cancelled + 1e-14, "P at c = {c}: {exact}");
            for x in [0.0, 1e-6, 0.02, 0.5, 0.799] {
                let rate = |b: f64| Hyperbola { half_width: b, ..contact(c) }.force_rate();
                let exact = abel::pressure(rate, &[c.min(0.8)], 0.8, x);
                let got = contact(c).pressure(x);
                assert!((got / exact - 1.0).abs() < 1e-13, "c = {c}, x = {x}: {got} against {exact}");
            }
        }
    }

    #[test]
    fn a_sharp_tip_is_a_wedge() {
        let wedge = Wedge { slope: 0.3, half_width: 0.8, compliance: 0.6 };
        let sharp = contact(1e-9);
        assert!((sharp.force() / wedge.force() - 1.0).abs() < 1e-14);
        for x in [0.01, 0.5, 0.799] {
            assert!((sharp.pressure(x) / wedge.pressure(x) - 1.0).abs() < 1e-13, "x = {x}");
        }
        // K is ln(4 D/c) there.
        let middle = 2.0 * 0.3 / (PI * 0.6) * (4.0 * 0.8 / 1e-9_f64).ln();
        assert!((sharp.pressure(0.0) / middle - 1.0).abs() < 1e-14);
    }
}
