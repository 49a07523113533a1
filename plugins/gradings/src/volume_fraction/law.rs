//! A mixture over depth.

use super::rule::Mixture;
use slipzone_api::ModulusLaw;
use slipzone_api::taylor::{Arithmetic, Taylor};

/// From this exponent on a broken power has as many derivatives at the surface as the kernels ask for.
const SMOOTH: f64 = 5.0;
/// Depth over the thickness below which a broken power is rounded.
const ROUNDED: f64 = 1e-3;
/// Relative error of a contact's numbers over the change of the modulus by the rounding, the share of the contact's width that is
/// changed so, and how much stiffer the rest is.
const FELT: f64 = 1.0;
/// From this exponent on what the rounding leaves at the surface is small enough.
const FLAT: f64 = 3.0;
/// What a unit of Poisson's ratio counts beside a relative change of the modulus.
const OF_POISSON: f64 = 4.0;

/// `mixture` at the share `depth^exponent`.
///
/// A broken power has a branch point at the surface, of which jump and logarithm of the kernels know nothing. So it is rounded
/// there. With `r^2 = y^2 + e^2` and `w = (e/r)^2` it is `r^p (1 - w)^(p/2)`; the series of that in `w` is cut after its square,
/// whose coefficient makes the share vanish at the surface, as it should. What is left falls like `e^4 y^(p-4)` below, and
/// is felt over a depth of some `e` alone: the edge of a contact, too, feels but the modulus at the surface, and the energy set
/// free there, which is that of the whole contact (the layer is the same all along, and so the energy release rate does not
/// depend on the path). From `p = 3` on the square is left out: the kernels are smoother so, and the share is off by less than
/// `e^p` at the surface.
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
        let least = ROUNDED * ROUNDED;
        let around = square.clone() + least;
        let rest = (1.0 - half) * least;
        if self.exponent < FLAT {
            square * (around.clone() + rest) * power(around, half - 2.0)
        } else {
            (square + rest) * power(around, half - 1.0)
        }
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

    fn smoothing_error(&self, width: f64) -> f64 {
        if !self.is_rounded {
            return 0.0;
        }
        // By the share of the base's material.
        let (modulus, poisson) = self.mixture.at(&Taylor::line(0.0, 1.0, 2));
        let (modulus, poisson) = (modulus.coefficients(), poisson.coefficients());
        let contrast = (modulus[1] / modulus[0]).abs() + OF_POISSON * poisson[1].abs();
        let width = width.min(1.0);
        let stiffer = (self.modulus(width) / self.surface_modulus()).max(1.0);
        // At the surface, and what is left below.
        let share = if self.exponent < FLAT { (ROUNDED / width).min(1.0) } else { 1.0 };
        let changed = share * ROUNDED.powf(self.exponent) + ROUNDED.powi(4);
        FELT * contrast * changed * stiffer
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        (self.series(terms).0 * self.surface_modulus().recip()).with_value(1.0).into_finite()
    }

    fn poisson_series(&self, terms: usize) -> Vec<f64> {
        self.series(terms).1.into_finite()
    }
}
