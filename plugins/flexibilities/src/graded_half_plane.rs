//! A solid without a base whose modulus is an exponential of the depth, or constant.

use crate::exponential::Exponential;
use crate::half_plane::HalfPlane;
use crate::minors::Minors;
use slipzone_api::{LayerModel, LayerResponse, Refusal};

/// The response of `mu1 exp(gamma y)` without a base.
pub(crate) fn response(
    layer: &LayerModel,
    gamma: f64,
    method: &'static str,
) -> Result<Box<dyn LayerResponse>, Refusal> {
    let elastic = layer.elastic;
    if gamma == 0.0 {
        return Ok(Box::new(HalfPlane { elastic, datum: layer.datum }));
    }
    if gamma < 0.0 {
        return Err(Refusal::OutOfReach {
            method,
            why: "a solid that softens without end carries no load".into(),
            remedy: "give the layer a thickness and a base",
        });
    }
    // What decays with depth alone: the two depth exponents with negative real parts (CC13 eq. 20). `s F` is an
    // algebraic function of `s`, its series in `gamma/s` converges beyond its branch points, and nothing else is left
    // there. Towards `s = 0` it vanishes: a solid that stiffens without end is its own base.
    let surface = |solid: &Exponential, s: f64| Ok(Minors::new(solid.elastic, solid.gamma).infinite(s));
    Ok(Box::new(Exponential { elastic, gamma, depth: gamma.recip(), surface }))
}
