//! One of the two materials.

use serde::{Deserialize, Serialize};
use slipzone_api::taylor::Arithmetic;
use slipzone_api::{Moduli, Poisson, Positive};

/// A material.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Phase {
    /// Modulus, of the kind that the scene names.
    pub modulus: Positive,
    /// Poisson's ratio; 1/2 for what cannot be compressed.
    pub poisson: Poisson,
}

impl Phase {
    /// Shear modulus.
    pub(super) fn shear(self, moduli: Moduli) -> f64 {
        moduli.shear(self.modulus.get(), self.poisson.get())
    }

    /// Compressibility `1/K = 3 (1 - 2 nu)/(2 G (1 + nu))`, which is 0, and `K` infinite, at a Poisson's ratio of 1/2.
    pub(super) fn compressibility(self, moduli: Moduli) -> f64 {
        let nu = self.poisson.get();
        3.0 * (1.0 - 2.0 * nu) / (2.0 * self.shear(moduli) * (1.0 + nu))
    }
}

/// Modulus, of the kind named, and Poisson's ratio of shear modulus and compressibility: `nu = (3K - 2G)/(2 (3K + G))`,
/// `E = 9 K G/(3K + G)`.
pub(super) fn constants<N: Arithmetic>(shear: N, compressibility: N, moduli: Moduli) -> (N, N) {
    let softness = shear.clone() * compressibility; // G/K
    let below = softness.clone() + 3.0;
    let poisson = (softness * -1.0 + 1.5) / below.clone();
    let modulus = match moduli {
        Moduli::Shear => shear,
        Moduli::Young => shear * 9.0 / below,
    };
    (modulus, poisson)
}
