//! A mixture over depth.

use super::rule::Mixture;
use slipzone_api::ModulusLaw;
use slipzone_api::taylor::Taylor;

/// `mixture` at the share `depth^exponent`.
#[derive(Debug)]
pub(super) struct Law {
    mixture: Mixture,
    exponent: f64,
}

impl Law {
    pub(super) fn new(mixture: Mixture, exponent: f64) -> Self {
        Self { mixture, exponent }
    }

    fn at(&self, depth: f64) -> (f64, f64) {
        self.mixture.at(&depth.powf(self.exponent))
    }

    fn series(&self, terms: usize) -> (Taylor, Taylor) {
        self.mixture.at(&Taylor::line(0.0, 1.0, terms).powf(self.exponent))
    }
}

impl ModulusLaw for Law {
    fn modulus(&self, depth: f64) -> f64 {
        self.at(depth).0
    }

    fn poisson(&self, depth: f64) -> Option<f64> {
        // Between two ratios in range; 1/2 rounds to what is above it.
        Some(self.at(depth).1.min(0.5))
    }

    fn broken_power(&self) -> Option<f64> {
        (self.exponent.fract() != 0.0).then_some(self.exponent)
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        (self.series(terms).0 * self.surface_modulus().recip()).with_value(1.0).into_finite()
    }

    fn poisson_series(&self, terms: usize) -> Vec<f64> {
        self.series(terms).1.into_finite()
    }
}
