//! Shear under a punch pressed on a half-plane, in Goodman's approximation: the pressure of the frictionless
//! contact, friction grown with the force from nothing.
//!
//! Under a flat punch the equation `(1/pi) PV int_-a^a q/(x - r) dr = -beta p - (eta/pi) int_slip sign(r) p/(x - r) dr`
//! is inverted for a shear bounded at `x = a` (N. I. Muskhelishvili, *Singular Integral Equations*, section 88);
//! with `p = P/(pi sqrt(b^2 - x^2))` both parts are elliptic integrals of the third kind, the principal value by
//! Abramowitz and Stegun 17.7.7:
//! `q = (2 x P/pi^2) sqrt(a^2 - x^2) (eta Pi(n, k')/(b (b^2 - x^2)) - beta (Pi(x^2/b^2, k) - K(k))/(b x^2))`,
//! `n = (b^2 - a^2)/(b^2 - x^2)`, `k = a/b`.
//!
//! Any other convex profile is a stack of flat punches (`docs/theory.md`, section 4), and so is its shear: a point
//! slips until the stick zone, `a = k b'` whatever the profile, reaches it at `b* = |x|/k`, and sticks from then on.

use super::adaptive::pieces;
use super::partial_slip::{Stick, mean, stick};
use spec_math::misc::elliprj;
use std::f64::consts::PI;

/// What the shear depends on beside the pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goodman {
    /// Friction coefficient, above zero.
    pub eta: f64,
    /// `(kappa - 1)/(kappa + 1)` of the half-plane.
    pub beta: f64,
}

impl Goodman {
    /// The stick zone, the same share of the contact under every convex punch.
    pub fn stick(self) -> Stick {
        stick(self.eta, self.beta)
    }

    /// Shear at `x` under a flat punch of `half_width` that carries `force`.
    pub fn flat(self, force: f64, half_width: f64, x: f64) -> f64 {
        let k = self.stick().ratio;
        let (b, at) = (half_width, x.abs());
        let apart = (b - at) * (b + at);
        let q = if at < k * b {
            self.stuck(b, at, (k * b - at) * (k * b + at))
        } else if at < b {
            self.eta / (PI * apart.sqrt())
        } else {
            0.0
        };
        q * force * x.signum()
    }

    /// Shear at `x` under a punch whose force grows with its half-width by `force_rate(b') = dP/db'`, 0 where there
    /// is no contact yet; `kinks` are the half-widths at which that rate is not smooth.
    pub fn grown(self, force_rate: impl Fn(f64) -> f64, kinks: &[f64], half_width: f64, x: f64) -> f64 {
        let (b, at, k) = (half_width, x.abs(), self.stick().ratio);
        if at == 0.0 || at >= b {
            return 0.0;
        }
        let reached = at / k;
        let slipping = pieces(at, b.min(reached), kinks, |lower, _, node| {
            let (gap, b) = (lower - at + node.from_lower, lower + node.from_lower);
            self.eta * force_rate(b) / (PI * (gap * (b + at)).sqrt())
        });
        let sticking = pieces(reached, b, kinks, |lower, _, node| {
            let (gap, b) = (lower - reached + node.from_lower, lower + node.from_lower);
            self.stuck(b, at, k * k * gap * (b + reached)) * force_rate(b)
        });
        (slipping + sticking) * x.signum()
    }

    /// The strain that stays in the stick zone of a cylinder is `u' = C|x|`; this is `C R = -pi eta/(2 k K(k))`.
    ///
    /// That it is proportional to `|x|` follows from the contact's being similar to itself as it grows.
    pub fn frozen_strain(self) -> f64 {
        let zone = self.stick();
        // K(k) = pi/(2 agm(1, k'))
        -self.eta * mean((zone.one_minus_ratio * (1.0 + zone.ratio)).sqrt()) / zone.ratio
    }

    /// Shear per force in the stick zone of a flat punch, `0 <= x < a`; `inside = a^2 - x^2`, which its caller knows
    /// to more digits than `a` and `x` have.
    fn stuck(self, b: f64, x: f64, inside: f64) -> f64 {
        let zone = self.stick();
        let k2 = zone.ratio * zone.ratio;
        let slip = zone.one_minus_ratio * (1.0 + zone.ratio);
        let apart = inside + slip * b * b;
        // Pi(n, k) = K(k) + (n/3) R_J(0, 1 - k^2, 1, 1 - n), DLMF 19.25.14.
        let first =
            PI / (2.0 * mean(zone.ratio)) + slip * b * b / (3.0 * apart) * elliprj(0.0, k2, 1.0, inside / apart);
        let second = elliprj(0.0, slip, 1.0, apart / (b * b)) / 3.0;
        2.0 * x * inside.sqrt() / (PI * PI * b) * (self.eta * first / apart - self.beta * second / (b * b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::cylinder::Cylinder;
    use crate::reference::surface::cauchy;
    use crate::reference::{flat_punch, rounded_flat::RoundedFlat, wedge::Wedge};
    use std::f64::consts::FRAC_PI_2;

    const CASES: [Goodman; 3] = [
        Goodman { eta: 0.2374, beta: 2.0 / 7.0 },
        Goodman { eta: 0.5, beta: 2.0 / 7.0 },
        Goodman { eta: 0.12, beta: 0.375 },
    ];
    const CYLINDER: Cylinder = Cylinder { radius: 2.0, half_width: 0.9, compliance: 0.7 };

    /// The equation itself: no strain where the surface sticks to a flat punch.
    #[test]
    fn a_flat_punch_does_not_stretch_what_sticks_to_it() {
        for law in CASES {
            let a = law.stick().ratio;
            for part in [0.05, 0.5, 0.9] {
                let x = part * a;
                let q = cauchy(|r| law.flat(1.0, 1.0, r), 1.0, &[-a, a], x);
                let p = flat_punch::pressure(1.0, 1.0, 1.0 - x);
                // Nodes within 1e-16 of the corner have lost their distance: 1e-8 of the singularity's integral.
                assert!((q + law.beta * p).abs() < 1e-7, "{law:?}: {q} and {} at x = {x}", law.beta * p);
            }
        }
    }

    #[test]
    fn it_is_continuous_where_slip_begins() {
        for law in CASES {
            let a = law.stick().ratio;
            let inside = law.flat(1.0, 1.0, a * (1.0 - 1e-12));
            // The difference grows like sqrt(a - x), by a factor of order ten.
            let jump = inside / law.flat(1.0, 1.0, a) - 1.0;
            assert!(jump.abs() < 2e-5 && jump < 0.0, "{law:?}: {jump}");
            assert!((law.flat(2.0, 1.0, -0.3 * a) + 2.0 * law.flat(1.0, 1.0, 0.3 * a)).abs() < 1e-15, "odd, linear");
        }
    }

    #[test]
    fn the_strain_frozen_under_a_cylinder_is_proportional_to_the_distance() {
        for law in CASES {
            let (b, a) = (0.9, 0.9 * law.stick().ratio);
            let rate = |b: f64| Cylinder { half_width: b, ..CYLINDER }.force_rate();
            for part in [0.05, 0.5, 0.9] {
                let x = part * a;
                let q = cauchy(|r| law.grown(rate, &[], b, r), b, &[-a, 0.0, a], x);
                let strain = -0.7 * (q + law.beta * CYLINDER.pressure(x));
                let exact = law.frozen_strain() / 2.0 * x;
                // What the check leaves out beside the pole.
                assert!((strain - exact).abs() < 1e-10, "{law:?}: {strain} against {exact} at x = {x}");
            }
        }
    }

    /// Where it slips the shear is `eta p`, of whatever profile; where it sticks it is less.
    #[test]
    fn friction_is_obeyed_under_any_profile() {
        let wedge = Wedge { slope: 0.1, half_width: 0.9, compliance: 0.7 };
        let rounded = RoundedFlat { flat: 0.5, radius: 2.0, half_width: 0.9, compliance: 0.7 };
        for law in CASES {
            let a = 0.9 * law.stick().ratio;
            for step in 1..30 {
                let x = 0.03 * f64::from(step);
                let round = law.grown(|b| RoundedFlat { half_width: b, ..rounded }.force_rate(), &[0.5], 0.9, x);
                for (q, p) in
                    [(law.grown(|_| wedge.force_rate(), &[], 0.9, x), wedge.pressure(x)), (round, rounded.pressure(x))]
                {
                    let excess = q / (law.eta * p) - 1.0;
                    // Rounding of the sums; of the rounded flat's pressure too.
                    let obeyed = if x >= a { excess.abs() < 2e-13 } else { q > 0.0 && excess < 2e-13 };
                    assert!(obeyed, "{law:?}: q = {q}, eta p = {}, x = {x}, a = {a}", law.eta * p);
                }
            }
        }
    }

    /// `cylinder_shear.json` of the repository's references, computed by a program that shares nothing with this one.
    #[test]
    fn the_numbers_of_another_program() {
        // nu = 0.3; A0 = 0.7, b = R = 1. The layer is 2000 b thick: a half-plane but for a small multiple of b/h.
        let law = Goodman { eta: 0.3, beta: 2.0 / 7.0 };
        let unit = Cylinder { radius: 1.0, half_width: 1.0, compliance: 0.7 };
        for (x, other) in [(0.25, 0.208_289_75), (0.5, 0.295_069_63), (0.75, 0.283_473_41)] {
            let q = law.grown(|b| Cylinder { half_width: b, ..unit }.force_rate(), &[], 1.0, x);
            assert!((q / other - 1.0).abs() < 2.0 / 2000.0, "q = {q} against {other} at x = {x}");
        }
    }

    /// `R_J(0, y, 1, p) = (3/2) int_0^inf dt/((t + p) sqrt(t (t + y) (t + 1)))` by the trapezoidal rule in `ln t`,
    /// where the integrand is analytic in a strip of `|Im| < pi`.
    #[test]
    fn the_elliptic_integral_is_its_integral() {
        for y in [1e-6, 0.1, 0.5, 0.999, 1.0] {
            for p in [1e-12, 1e-3, 0.3, 0.5, 1.0] {
                let f = |t: f64| t / ((t + p) * (t * (t + y) * (t + 1.0)).sqrt());
                let direct: f64 = (-400..=400).map(|j| 1.5 * 0.25 * f((0.25 * f64::from(j)).exp())).sum();
                let got = elliprj(0.0, y, 1.0, p);
                // Some hundreds of terms; what is cut off is of the order exp(-50)/p at worst.
                assert!((got / direct - 1.0).abs() < 1e-14, "y = {y}, p = {p}: {got} against {direct}");
            }
        }
    }

    /// `R_J(0, 1, 1, p) = 3 pi/(2 (1 + sqrt p) sqrt p)`, DLMF 19.20.8.
    #[test]
    fn the_elliptic_integral_is_elementary_on_a_circle() {
        for decade in 0..=250 {
            let p = 10.0_f64.powi(-decade);
            let exact = 3.0 * FRAC_PI_2 / ((1.0 + p.sqrt()) * p.sqrt());
            let got = elliprj(0.0, 1.0, 1.0, p);
            assert!((got / exact - 1.0).abs() < 4e-15, "p = {p:e}: {got:e} against {exact:e}");
        }
    }
}
