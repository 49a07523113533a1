//! Plane elasticity: the constants of a point, and what the layer stands on.

use crate::{Poisson, Positive};
use serde::{Deserialize, Serialize};

/// Plane strain or (generalised) plane stress.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Plane {
    /// No strain along the punch: a long punch.
    #[default]
    Strain,
    /// No stress along the punch: a thin plate on edge.
    Stress,
}

impl Plane {
    /// Its name in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::Strain => "plane strain",
            Self::Stress => "plane stress",
        }
    }
}

/// The elastic constants that the contact equations need, in units of the shear modulus.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    /// Kolosov's constant: `3 - 4 nu` (plane strain), `(3 - nu)/(1 + nu)` (plane stress); at least 1.
    pub kappa: f64,
}

/// What a scene calls a modulus.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Moduli {
    /// The shear modulus `mu`.
    #[default]
    Shear,
    /// Young's modulus `E = 2 mu (1 + nu)`.
    Young,
}

impl Moduli {
    /// The shear modulus of a material of that `modulus` and Poisson's ratio.
    pub fn shear(self, modulus: f64, poisson: f64) -> f64 {
        match self {
            Self::Shear => modulus,
            Self::Young => modulus / (2.0 * (1.0 + poisson)),
        }
    }

    /// The modulus of a material of that shear modulus and Poisson's ratio: the inverse of [`Self::shear`].
    pub fn of_shear(self, shear: f64, poisson: f64) -> f64 {
        match self {
            Self::Shear => shear,
            Self::Young => 2.0 * shear * (1.0 + poisson),
        }
    }

    /// Whether it is the shear modulus, as when nothing is said.
    pub fn is_shear(&self) -> bool {
        *self == Self::Shear
    }
}

impl Elastic {
    /// Constants of a material with Poisson's ratio `poisson`.
    pub fn new(plane: Plane, poisson: Poisson) -> Self {
        Self::of(plane, poisson.get())
    }

    /// The same of a ratio that is known to be in range.
    pub fn of(plane: Plane, nu: f64) -> Self {
        let kappa = match plane {
            Plane::Strain => 3.0 - 4.0 * nu,
            Plane::Stress => (3.0 - nu) / (1.0 + nu),
        };
        Self { kappa }
    }

    /// `(kappa + 1)/4`: the half-plane's compliance `A0` times its shear modulus.
    pub fn a0(self) -> f64 {
        (self.kappa + 1.0) / 4.0
    }

    /// `(kappa - 1)/(kappa + 1)`: how strongly normal and tangential problems are coupled.
    pub fn beta(self) -> f64 {
        (self.kappa - 1.0) / (self.kappa + 1.0)
    }

    /// `(3 - kappa)/(1 + kappa)`, the plane's lateral contraction.
    pub fn lambda(self) -> f64 {
        (3.0 - self.kappa) / (1.0 + self.kappa)
    }
}

/// What the layer stands on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Base {
    /// Bonded to a rigid body: `u = v = 0` at `y = h`.
    #[default]
    Rigid,
    /// Resting on a rigid body without friction: `v = 0`, `sigma_xy = 0` at `y = h`.
    Frictionless,
    /// Bonded to an elastic half-plane.
    HalfPlane {
        /// Its shear modulus.
        shear: Positive,
        /// Its Poisson's ratio.
        poisson: Poisson,
    },
    /// No base: the solid goes on for ever.
    Infinite,
}

impl Base {
    /// Whether what lies far below does not give way: rigid bases, and infinite solids that stiffen. Only of an
    /// infinite solid the exponent of its law is asked for.
    pub fn is_grounded(self, exponent: impl FnOnce() -> Option<f64>) -> bool {
        match self {
            Self::Rigid | Self::Frictionless => true,
            Self::HalfPlane { .. } => false,
            Self::Infinite => exponent() != Some(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn constants_of_common_materials() {
        let at = |plane, nu| Elastic::new(plane, Poisson::new(nu).unwrap());
        // nu = 0.3: kappa = 1.8, beta = 0.8/2.8.
        assert!((at(Plane::Strain, 0.3).beta() - 2.0 / 7.0).abs() < 1e-16);
        // Incompressible plane strain decouples: beta = 0, A0 mu = 1/2.
        assert_eq!((at(Plane::Strain, 0.5).beta(), at(Plane::Strain, 0.5).a0()), (0.0, 0.5));
        // Plane stress of nu is plane strain of nu/(1 + nu).
        let (stress, strain) = (at(Plane::Stress, 0.25), at(Plane::Strain, 0.2));
        assert!((stress.kappa - strain.kappa).abs() < 1e-15);
    }
}
