//! The shape of the rigid punch.

use crate::Refusal;
use std::fmt::Debug;

/// Config half of a punch: what a scene says under `[punch]`, lengths in the user's units.
#[typetag::serde(tag = "type")]
pub trait PunchProfile: dyn_clone::DynClone + Debug + Send + Sync {
    /// The shape, ready to be evaluated.
    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal>;
}
dyn_clone::clone_trait_object!(PunchProfile);

/// Run-time half of a punch: its height over the surface, all lengths in the user's unit.
///
/// Shapes are symmetric about `x = 0` and convex unless they say otherwise.
pub trait PunchShape: Debug + Send + Sync {
    /// Gap `g(x)` between the unloaded surface and the punch that touches it at the origin; `g(0) = 0`.
    fn height(&self, x: f64) -> f64;

    /// Slope `g'(x)`, dimensionless.
    fn slope(&self, x: f64) -> f64;

    /// Half-width of the contact when sharp corners fix it, whatever the load; `None` for a contact
    /// that grows with the load and ends smoothly.
    fn fixed_half_width(&self) -> Option<f64> {
        None
    }

    /// A length typical of the shape: half-width of a flat, radius of a cylinder. The search for an
    /// unknown contact size starts from it.
    fn natural_length(&self) -> f64;

    /// Whether `g` is convex: only then is the contact one interval that grows with the load.
    fn is_convex(&self) -> bool {
        true
    }

    /// Where the slope jumps, besides sharp corners at the contact's ends.
    fn kinks(&self) -> &[f64] {
        &[]
    }
}
