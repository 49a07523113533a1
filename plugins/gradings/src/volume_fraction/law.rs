//! A mixture over depth.

use super::rule::Mixture;
use slipzone_api::ModulusLaw;
use slipzone_api::taylor::{Arithmetic, Taylor};

/// From this exponent on a broken power has as many derivatives at the surface as the kernels ask for.
const SMOOTH: f64 = 5.0;
/// Depth over the thickness, squared, above which a broken power is what it says.
const ROUNDED: f64 = 1e-6;
/// Relative error of a contact's numbers over what the rounding changes near the surface, which is `e^p` of the contrast: at most
/// `1 - p/2` of that where the contact is so narrow that it feels nothing else, an eighth of it at corners of wider ones.
const FELT: f64 = 0.5;
/// What a unit of Poisson's ratio counts beside a relative change of the modulus.
const OF_POISSON: f64 = 4.0;

/// `mixture` at the share `depth^exponent`.
///
/// A broken power has a branch point at the surface, of which jump and logarithm of the kernels know nothing. So it is rounded
/// there: `y^p` gives way to `(y^2 + e^2)^(p/2) - (p/2) e^2 (y^2 + e^2)^(p/2 - 1)`, which is `y^p` but for `e^4 y^(p-4)`
/// below, and off by `(1 - p/2) e^p` at the surface.
#[derive(Debug)]
pub(super) struct Law {
    mixture: Mixture,
    exponent: f64,
    is_rounded: bool,
}

impl Law {
    pub(super) fn new(mixture: Mixture, exponent: f64) -> Self {
        Self { mixture, exponent, is_rounded: exponent.fract() != 0.0 && exponent < SMOOTH }
    }

    /// The share, from the depth and what raises to a power.
    fn share<N: Arithmetic>(&self, depth: N, power: impl Fn(N, f64) -> N) -> N {
        if !self.is_rounded {
            return power(depth, self.exponent);
        }
        let (half, square) = (0.5 * self.exponent, depth.clone() * depth);
        power(square.clone() + ROUNDED, half - 1.0) * (square + (1.0 - half) * ROUNDED)
    }

    fn at(&self, depth: f64) -> (f64, f64) {
        self.mixture.at(&self.share(depth, f64::powf))
    }

    fn series(&self, terms: usize) -> (Taylor, Taylor) {
        self.mixture.at(&self.share(Taylor::line(0.0, 1.0, terms), Taylor::powf))
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

    fn smoothing_error(&self) -> f64 {
        if !self.is_rounded {
            return 0.0;
        }
        // By the share of the base's material.
        let (modulus, poisson) = self.mixture.at(&Taylor::line(0.0, 1.0, 2));
        let (modulus, poisson) = (modulus.coefficients(), poisson.coefficients());
        let contrast = (modulus[1] / modulus[0]).abs() + OF_POISSON * poisson[1].abs();
        FELT * contrast * ROUNDED.powf(0.5 * self.exponent)
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        (self.series(terms).0 * self.surface_modulus().recip()).with_value(1.0).into_finite()
    }

    fn poisson_series(&self, terms: usize) -> Vec<f64> {
        self.series(terms).1.into_finite()
    }
}
