//! How the shear modulus varies with depth.

use crate::{Positive, Refusal};
use std::fmt::Debug;

/// Config half of a grading: what a scene says under `layer.grading`.
///
/// Moduli and depths are in the user's units here.
#[typetag::serde(tag = "type")]
pub trait Grading: dyn_clone::DynClone + Debug + Send + Sync {
    /// The law over a layer of `thickness`; `None` on an infinite solid.
    ///
    /// Refuses what only the thickness can show to be impossible.
    fn law(&self, thickness: Option<Positive>) -> Result<Box<dyn ModulusLaw>, Refusal>;
}
dyn_clone::clone_trait_object!(Grading);

/// Run-time half of a grading: the modulus as a function of depth.
///
/// `modulus` and `surface_modulus` are in the user's unit of stress; `depth` runs from 0 at the surface
/// to 1 at the base, in units of the thickness (of the user's length on an infinite solid). Only
/// `modulus` is required: what else a law can tell makes it faster, never different.
pub trait ModulusLaw: Debug + Send + Sync {
    /// Shear modulus at `depth`; finite and positive.
    fn modulus(&self, depth: f64) -> f64;

    /// Shear modulus at the surface, `mu1`.
    fn surface_modulus(&self) -> f64 {
        self.modulus(0.0)
    }

    /// `Some(gamma)` if and only if the law is exactly `mu1 exp(gamma depth)`; 0 when homogeneous.
    ///
    /// The depth exponents are then known in closed form (CC13 eq. 20).
    fn exponent(&self) -> Option<f64> {
        None
    }

    /// Taylor coefficients of `modulus(depth)/surface_modulus()` at the surface: `terms` of them, or as many
    /// as are known (the first is 1). They set the kernel's jump and logarithm.
    fn surface_series(&self, terms: usize) -> Vec<f64> {
        let Some(gamma) = self.exponent() else { return vec![1.0; terms.min(1)] };
        let next = |term: &mut f64, k: usize| {
            let here = *term;
            *term *= gamma / (k + 1) as f64;
            Some(here)
        };
        (0..terms).scan(1.0, next).collect()
    }

    /// Depths, ascending, at which the law has a kink or a jump.
    fn breakpoints(&self) -> &[f64] {
        &[]
    }
}
