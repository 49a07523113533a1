//! Any symmetric convex punch without friction on a half-plane, by Abel's integrals.
//!
//! Every such contact is a stack of flat punches: the rate of `p` at a half-width `b'` is the flat punch's,
//! `1/(pi sqrt(b'^2 - x^2))` per force, so that `p = int_x^b dP(b')/(pi sqrt(b'^2 - x^2))`; that it meets the slope
//! `g'` of the punch gives `P = (2/A0) int_0^b r g'(r)/sqrt(b^2 - r^2) dr`. I. Ya. Shtaerman, *The Contact Problem of
//! Elasticity* (1949); K. L. Johnson, *Contact Mechanics* (1985), section 2.7; `docs/theory.md`, section 4.
//!
//! By quadrature, to rounding: what the closed forms of single shapes are checked against, and what serves shapes
//! that have none.

use super::adaptive::pieces;
use std::f64::consts::PI;

/// Force `P(b)` of a punch of slope `g'(x)`, `x >= 0`; its `kinks` are where the slope is not smooth.
pub fn force(slope: impl Fn(f64) -> f64, kinks: &[f64], half_width: f64, compliance: f64) -> f64 {
    let b = half_width;
    let sum = pieces(0.0, b, kinks, |lower, upper, node| {
        let x = lower + node.from_lower;
        x * slope(x) / ((b - upper + node.to_upper) * (b + x)).sqrt()
    });
    2.0 * sum / compliance
}

/// Pressure at `x` of a punch whose force grows with its half-width by `force_rate(b') = dP/db'`, 0 where there is
/// no contact yet; `kinks` are the half-widths at which that rate is not smooth.
pub fn pressure(force_rate: impl Fn(f64) -> f64, kinks: &[f64], half_width: f64, x: f64) -> f64 {
    let x = x.abs();
    let sum = pieces(x, half_width, kinks, |lower, _, node| {
        let (gap, b) = (lower - x + node.from_lower, lower + node.from_lower);
        force_rate(b) / (gap * (b + x)).sqrt()
    });
    sum / PI
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::cylinder::Cylinder;

    #[test]
    fn a_cylinder_is_a_stack_of_flat_punches() {
        let cylinder = Cylinder { radius: 3.0, half_width: 0.8, compliance: 0.6 };
        let force = force(|x| x / 3.0, &[], 0.8, 0.6);
        assert!((force / cylinder.force() - 1.0).abs() < 1e-14, "rounding of the sum: {force}");
        for x in [0.0, 1e-9, 0.3, -0.5, 0.79] {
            let rate = |b: f64| Cylinder { half_width: b, ..cylinder }.force_rate();
            let got = pressure(rate, &[], 0.8, x);
            assert!((got / cylinder.pressure(x) - 1.0).abs() < 2e-14, "rounding of the sum: {got} at x = {x}");
        }
        assert!(pressure(|_| 1.0, &[], 0.8, 0.81).abs() < f64::MIN_POSITIVE, "no contact, no pressure");
    }
}
