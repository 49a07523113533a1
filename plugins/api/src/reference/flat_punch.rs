//! Frictionless flat punch with sharp corners on a half-plane.
//!
//! M. A. Sadowsky, ZAMM 8 (1928) 107; K. L. Johnson, *Contact Mechanics* (1985), section 2.8.
//! None of it depends on the elastic constants.

use std::f64::consts::{FRAC_1_PI, PI};

/// `f(b)/P = stress_intensity sqrt(b)/P`: what a layer's edge ratio tends to as the layer grows thick.
pub const EDGE_RATIO: f64 = FRAC_1_PI;

/// Pressure `P/(pi sqrt(b^2 - x^2))` at a distance `gap = b - |x|` from the nearer corner.
///
/// Takes the gap and not `x`, because `b - |x|` near a corner has no digits left.
pub fn pressure(force: f64, half_width: f64, gap: f64) -> f64 {
    force / (PI * (gap * (2.0 * half_width - gap)).sqrt())
}

/// Stress intensity `lim sqrt(2 (b - x)) p(x) = P/(pi sqrt(b))`, stress times square root of length.
pub fn stress_intensity(force: f64, half_width: f64) -> f64 {
    force / (PI * half_width.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::double_exponential::nodes;

    const FORCE: f64 = 2.5;
    const HALF_WIDTH: f64 = 0.7;

    #[test]
    fn the_pressure_carries_the_load() {
        let total: f64 = nodes(2.0 * HALF_WIDTH, 20)
            .iter()
            .map(|node| node.weight * pressure(FORCE, HALF_WIDTH, node.from_lower.min(node.to_upper)))
            .sum();
        assert!((total / FORCE - 1.0).abs() < 2e-15, "rounding of 41 terms: {total}");
    }

    /// `PV int p(r)/(x - r) dr = 0` inside: subtract the pole with the same integral of a constant,
    /// `PV int dr/(x - r) = log((b + x)/(b - x))`.
    #[test]
    fn the_surface_stays_flat() {
        for x in [0.0, 0.3, -0.55, 0.69] {
            let (from_lower, to_upper) = (HALF_WIDTH + x, HALF_WIDTH - x);
            let here = pressure(FORCE, HALF_WIDTH, from_lower.min(to_upper));
            // Two grids that meet at x, so that the removable point lies at their ends.
            let left: f64 =
                nodes(from_lower, 80).iter().map(|r| r.weight * (corner(r.from_lower) - here) / r.to_upper).sum();
            let right: f64 =
                nodes(to_upper, 80).iter().map(|r| r.weight * (here - corner(r.to_upper)) / r.from_lower).sum();
            let slope = left + right + here * (from_lower / to_upper).ln();
            // Close to x the difference of two pressures has an absolute error of eps p/distance; the
            // weights there are proportional to the distance, some twenty of them.
            assert!(slope.abs() < 1e-13 * here, "slope {slope} at x = {x}");
        }
    }

    fn corner(gap: f64) -> f64 {
        pressure(FORCE, HALF_WIDTH, gap.min(2.0 * HALF_WIDTH - gap))
    }

    #[test]
    fn intensity_is_the_limit_and_the_ratio_its_scaled_form() {
        let gap = 1e-20_f64;
        let limit = (2.0 * gap).sqrt() * pressure(FORCE, HALF_WIDTH, gap);
        let intensity = stress_intensity(FORCE, HALF_WIDTH);
        assert!((limit / intensity - 1.0).abs() < 1e-15, "gap/b = 1e-20 is far below rounding");
        assert!((intensity * HALF_WIDTH.sqrt() / FORCE - EDGE_RATIO).abs() < 1e-16);
    }
}
