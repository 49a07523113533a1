//! Frictionless wedge on a half-plane: `g = s|x|`.
//!
//! K. L. Johnson, *Contact Mechanics* (1985), section 5.2; from Abel's integrals with `dP/db = 2 s/A0`. The slope is
//! small, as everything is in linear elasticity.

use std::f64::consts::PI;

/// A wedge in contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wedge {
    /// Slope `s` of its faces against the surface, dimensionless.
    pub slope: f64,
    /// Half-width `b` of the contact.
    pub half_width: f64,
    /// Compliance `A0 = (kappa + 1)/(4 mu)` of the half-plane, 1/stress.
    pub compliance: f64,
}

impl Wedge {
    /// The contact under a `force` per unit length: `b = A0 P/(2 s)`.
    pub fn pressed(slope: f64, compliance: f64, force: f64) -> Self {
        Self { slope, half_width: compliance * force / (2.0 * slope), compliance }
    }

    /// `P = 2 s b/A0`, per unit length.
    pub fn force(self) -> f64 {
        self.force_rate() * self.half_width
    }

    /// `dP/db = 2 s/A0`.
    pub fn force_rate(self) -> f64 {
        2.0 * self.slope / self.compliance
    }

    /// `p = (2 s/(pi A0)) acosh(b/|x|)`: infinite under the tip, 0 outside the contact.
    pub fn pressure(self, x: f64) -> f64 {
        let (x, b) = (x.abs(), self.half_width);
        if x >= b {
            return 0.0;
        }
        // acosh(b/x) = asinh(sqrt(b^2 - x^2)/x), which keeps its digits at the edge.
        self.force_rate() / PI * (((b - x) * (b + x)).sqrt() / x).asinh()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::{abel, surface};

    const CONTACT: Wedge = Wedge { slope: 0.02, half_width: 0.4, compliance: 0.7 };

    #[test]
    fn it_is_a_stack_of_flat_punches() {
        let force = abel::force(|_| 0.02, &[], 0.4, 0.7);
        assert!((force / CONTACT.force() - 1.0).abs() < 1e-14, "rounding of the sum: {force}");
        for x in [1e-9, 0.01, -0.3, 0.399] {
            let sum = abel::pressure(|_| CONTACT.force_rate(), &[], 0.4, x);
            assert!((CONTACT.pressure(x) / sum - 1.0).abs() < 2e-14, "rounding of the sum at x = {x}: {sum}");
        }
        assert!(CONTACT.pressure(0.4).abs() < f64::MIN_POSITIVE && CONTACT.pressure(0.0).is_infinite());
        let back = Wedge::pressed(0.02, 0.7, CONTACT.force()).half_width;
        assert!((back / 0.4 - 1.0).abs() < 1e-15, "{back}");
    }

    #[test]
    fn the_pressure_carries_the_load() {
        let total = 2.0 * crate::reference::adaptive::integral(0.4, |node| CONTACT.pressure(node.from_lower));
        // The edge seen from the middle: sqrt(gap) without its last digits where the weights are small.
        assert!((total / CONTACT.force() - 1.0).abs() < 1e-14, "{total}");
    }

    #[test]
    fn the_surface_takes_the_shape_of_the_wedge() {
        for x in [0.003, 0.1, 0.27, 0.39] {
            let slope = 0.7 * surface::cauchy(|r| CONTACT.pressure(r), 0.4, &[0.0], x);
            // What the check leaves out beside the pole.
            assert!((slope / 0.02 - 1.0).abs() < 1e-10, "slope {slope} at x = {x}");
        }
    }
}
