//! Frictionless cylinder on a half-plane (Hertz).
//!
//! K. L. Johnson, *Contact Mechanics* (1985), section 4.2(c), with `A0 = (kappa + 1)/(4 mu)` in place
//! of `2/E*`: `1/A0 = 4 mu/(kappa + 1) = E*/2`.

use std::f64::consts::PI;

/// A cylinder in contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// Radius `R`.
    pub radius: f64,
    /// Half-width `b` of the contact.
    pub half_width: f64,
    /// Compliance `A0 = (kappa + 1)/(4 mu)` of the half-plane, 1/stress.
    pub compliance: f64,
}

impl Cylinder {
    /// The contact under a `force` per unit length: `b = sqrt(2 A0 R P/pi)`.
    pub fn pressed(radius: f64, compliance: f64, force: f64) -> Self {
        Self { radius, half_width: (2.0 * compliance * radius * force / PI).sqrt(), compliance }
    }

    /// `P = pi b^2/(2 A0 R)`, per unit length.
    pub fn force(self) -> f64 {
        PI * self.half_width * self.half_width / (2.0 * self.compliance * self.radius)
    }

    /// `dP/db = pi b/(A0 R)`.
    pub fn force_rate(self) -> f64 {
        PI * self.half_width / (self.compliance * self.radius)
    }

    /// `p = b/(A0 R) sqrt(1 - (x/b)^2)`; 0 outside the contact.
    pub fn pressure(self, x: f64) -> f64 {
        let inside = (self.half_width - x) * (self.half_width + x);
        inside.max(0.0).sqrt() / (self.compliance * self.radius)
    }

    /// The largest pressure, `p(0) = b/(A0 R)`.
    pub fn peak_pressure(self) -> f64 {
        self.half_width / (self.compliance * self.radius)
    }
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // where equality is asserted, it is exact by construction
mod tests {
    use super::*;
    use crate::double_exponential::nodes;

    const CONTACT: Cylinder = Cylinder { radius: 12.0, half_width: 0.4, compliance: 0.7 };

    #[test]
    fn the_pressure_carries_the_load() {
        let total: f64 = nodes(2.0 * CONTACT.half_width, 20)
            .iter()
            .map(|r| r.weight * CONTACT.pressure(r.from_lower - CONTACT.half_width))
            .sum();
        assert!((total / CONTACT.force() - 1.0).abs() < 2e-15, "rounding of 41 terms: {total}");
        assert_eq!(CONTACT.pressure(0.0), CONTACT.peak_pressure());
        assert_eq!(CONTACT.pressure(0.41), 0.0);
    }

    #[test]
    fn force_and_half_width_are_inverse() {
        for decade in -6..=6 {
            let force = 10.0_f64.powi(decade);
            let back = Cylinder::pressed(3.0, 0.6, force).force();
            assert!((back / force - 1.0).abs() < 1e-15, "{force} came back as {back}");
        }
    }

    /// `(1/pi) PV int p(r)/(x - r) dr = x/(A0 R)`, by splitting the interval at `x` and taking off
    /// `p(x)`, whose own integral is `p(x) log((b + x)/(b - x))`.
    #[test]
    fn the_surface_takes_the_shape_of_the_cylinder() {
        let b = CONTACT.half_width;
        for x in [0.0, 0.1, -0.27, 0.39] {
            let here = CONTACT.pressure(x);
            let left: f64 = nodes(b + x, 30)
                .iter()
                .map(|r| r.weight * (CONTACT.pressure(x - r.to_upper) - here) / r.to_upper)
                .sum();
            let right: f64 = nodes(b - x, 30)
                .iter()
                .map(|r| r.weight * (here - CONTACT.pressure(x + r.from_lower)) / r.from_lower)
                .sum();
            let slope = CONTACT.compliance / PI * (left + right + here * ((b + x) / (b - x)).ln());
            // In units of b/R: rounding of p(x) - p(r) beside a small distance, some twenty nodes of it.
            let error = (slope - x / CONTACT.radius) * CONTACT.radius / b;
            assert!(error.abs() < 1e-13, "slope {slope} at x = {x}, error {error}");
        }
    }
}
