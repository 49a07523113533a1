//! How a layer answers a sinusoidal load on its surface.

use crate::{Elastic, LayerModel, Refusal};
use std::fmt::Debug;
use std::sync::Arc;

/// Surface flexibility at one wave number, scaled: the entries of `s F(s)/A0`.
///
/// For `p = P cos(sx)`, `q = Q sin(sx)`: `v = (Fvv P + Fuv Q) cos(sx)`, `u = (Fuv P + Fuu Q) sin(sx)`. They tend to
/// `1`, `1`, `-beta` as `s` grows, `beta` being that of the surface. At the origin they tend to 0 at least like `s`
/// when the layer is bonded to a rigid base, to the flexibility of an elastic half-plane when it stands on one; on a
/// base without friction `uu` grows like `1/s`, see [`LayerResponse::pole`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceFlexibility {
    /// `s Fvv/A0`: indentation by pressure.
    pub vv: f64,
    /// `s Fuu/A0`: tangential displacement by shear.
    pub uu: f64,
    /// `s Fuv/A0`: the coupling.
    pub uv: f64,
}

/// Config half: how `F(s)` is got (such as `compliance`).
#[typetag::serde(tag = "type")]
pub trait Flexibility: dyn_clone::DynClone + Debug + Send + Sync {
    /// Prepares the layer; refuses a base or law that the method cannot treat.
    fn respond(&self, layer: &Arc<LayerModel>) -> Result<Box<dyn LayerResponse>, Refusal>;
}
dyn_clone::clone_trait_object!(Flexibility);

/// Run-time half: the surface flexibility of one layer.
pub trait LayerResponse: Send + Sync {
    /// `s F/A0` at `wave_number` `s >= 0`, in units of `1/h`; at 0 the limit, [`Self::pole`] left out.
    fn surface(&self, wave_number: f64) -> Result<SurfaceFlexibility, Refusal>;

    /// [`Self::surface`] at each of `wave_numbers`; ends at the first refusal.
    ///
    /// # Panics
    /// When the slices differ in length.
    fn surface_into(&self, wave_numbers: &[f64], out: &mut [SurfaceFlexibility]) -> Result<(), Refusal> {
        assert_eq!(wave_numbers.len(), out.len(), "one flexibility per wave number");
        for (&s, out) in wave_numbers.iter().zip(out) {
            *out = self.surface(s)?;
        }
        Ok(())
    }

    /// Elastic constants at the surface.
    fn elastic(&self) -> Elastic;

    /// Coefficients of `1/s`, `1/s^2`, ... in `s F/A0` as `s` grows, beyond its limit (`vv`, `uu`, `uv`):
    /// `terms` of them, or as many as the law's derivatives at the surface give. A homogeneous surface has
    /// zeros; a law that tells nothing of its gradient has an empty series.
    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility>;

    /// `c` where `s Fuu/A0 = c/s + O(s)` at the origin: a layer that slides on its base follows long waves of shear
    /// as a membrane does. 0 on all other bases.
    fn pole(&self) -> f64 {
        0.0
    }

    /// The same layer's response with `vv` counted from the depth that the model calls [`LayerModel::datum`], where it
    /// names one and the method knows: `s (Fvv - Fvv(datum))/A0`. The other entries stay.
    fn against_datum(&self) -> Option<Box<dyn LayerResponse>> {
        None
    }

    /// The same response, with errors allowed: of up to `accuracy` times the entry itself in `vv` and `uu`, times
    /// `sqrt(vv uu)` in `uv`. `None` where that would save nothing. What is asked of the response itself stays as good
    /// as it can be, whoever asked for less before.
    fn roughly(&self, accuracy: f64) -> Option<&dyn LayerResponse> {
        let _ = accuracy;
        None
    }

    /// Depth `d` below which the surface feels something that its own derivatives do not tell (a base,
    /// a kink): what is left of `s F` after its series in `1/s` decays like `exp(-2 s d)`. `None` when
    /// `s F` equals its limit at every `s`: a homogeneous half-plane.
    fn depth(&self) -> Option<f64>;

    /// How deep all of it is that the surface feels, in the same unit: at a base, or a datum. Breaks above it, of which
    /// the first is at
    /// [`Self::depth`], may be as faint as they like.
    fn thickness(&self) -> Option<f64> {
        self.depth()
    }

    /// The power of the depth, no whole number, with which the solid begins at its surface to be no analytic function
    /// of it; `None` where that is not known, or it is one.
    fn broken_power(&self) -> Option<f64> {
        None
    }

    /// How deep the solid goes on to change, where a datum makes [`Self::thickness`] less: towards the origin the
    /// flexibility varies over its inverse.
    fn extent(&self) -> Option<f64> {
        self.thickness()
    }

    /// Whether the solid is the same at every depth, down to its base.
    fn is_homogeneous(&self) -> bool {
        false
    }

    /// Whether [`Self::depth`] is where the law breaks, and not only how far it is known to be smooth.
    fn breaks(&self) -> bool {
        false
    }
}
