//! What becomes of two materials mixed.

use super::phase::{Phase, constants};
use serde::{Deserialize, Serialize};
use slipzone_api::Moduli;
use slipzone_api::taylor::Arithmetic;

/// A rule for the constants of a mixture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MixingRule {
    /// Modulus and Poisson's ratio in proportion to the volumes (Voigt).
    Mixture,
    /// Spheres of the base's material in a matrix of the surface's, each in the mean strain of the matrix.
    MoriTanaka,
}

impl MixingRule {
    /// The mixture of two phases whose moduli are of that kind.
    pub(super) fn mixture(self, matrix: Phase, inclusions: Phase, moduli: Moduli) -> Mixture {
        Mixture { rule: self, matrix, inclusions, moduli }
    }
}

/// Two phases and how they mix.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mixture {
    rule: MixingRule,
    matrix: Phase,
    inclusions: Phase,
    moduli: Moduli,
}

impl Mixture {
    /// Modulus and Poisson's ratio where the volume fraction of the inclusions is `share`.
    pub(super) fn at<N: Arithmetic>(&self, share: &N) -> (N, N) {
        match self.rule {
            MixingRule::Mixture => {
                let (a, b) = (self.matrix, self.inclusions);
                (between(a.modulus.get(), b.modulus.get(), share), between(a.poisson.get(), b.poisson.get(), share))
            }
            MixingRule::MoriTanaka => self.spheres(share),
        }
    }

    /// `G = G1 + V dG/(1 + (1 - V) dG/(G1 + F))`, `F = G1 (9 K1 + 8 G1)/(6 (K1 + 2 G1))`, and `K` likewise with `4
    /// G1/3` for `F`; written with `1/K`, so that no phase needs a finite one.
    fn spheres<N: Arithmetic>(&self, share: &N) -> (N, N) {
        let (g1, g2) = (self.matrix.shear(self.moduli), self.inclusions.shear(self.moduli));
        let (k1, k2) = (self.matrix.compressibility(self.moduli), self.inclusions.compressibility(self.moduli));
        let f = g1 * (9.0 + 8.0 * g1 * k1) / (6.0 * (1.0 + 2.0 * g1 * k1));
        // Multiplied by what stands below, both are quotients of linear functions of V.
        let shear = (between(g1 * (g2 + f), g2 * (g1 + f), share)) / between(g2 + f, g1 + f, share);
        let a = 4.0 / 3.0 * g1;
        let compressibility = (between(k1, k2, share) + a * k1 * k2) / (between(k2, k1, share) * a + 1.0);
        constants(shear, compressibility, self.moduli)
    }
}

/// `a` at a share of 0, `b` at 1, in proportion between; where both are the same without rounding, of which a material
/// next to incompressible would make much.
fn between<N: Arithmetic>(a: f64, b: f64, share: &N) -> N {
    if a.to_bits() == b.to_bits() {
        return share.clone() * 0.0 + a;
    }
    (share.clone() * -1.0 + 1.0) * a + share.clone() * b
}
