//! Exponential layers in closed form.

use crate::exponential::Exponential;
use crate::graded_half_plane;
use crate::minors::Minors;
use serde::{Deserialize, Serialize};
use slipzone_api::{Base, Flexibility, LayerModel, LayerResponse, Refusal};
use std::sync::Arc;

const METHOD: &str = "closed-form";

/// `s F/A0` of `mu1 exp(gamma y)` on a rigid base as quotients of sums of exponentials, for every wave number,
/// gradient (none included) and Poisson's ratio (1/2 included).
///
/// Good to about 5e-15, and to 1e-14 beyond `|gamma| = 30`. Small entries keep their relative precision; `uv`, which
/// may pass through zero, has that of `sqrt(vv uu)`. Only towards `kappa = 400` (plates with `nu = -0.99`) round-off
/// is magnified, up to 1e-13 around `s = |gamma|/2`. Some 0.1 microseconds per wave number. Other laws are left to
/// `compliance`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClosedForm {}

slipzone_api::register!(Flexibility, "closed-form", "exponential layers by their depth exponents, without degenerate cases; fastest",
    example: "type = \"closed-form\"",
    parameters: [],
    source: "CC13 eq. 20; docs/theory.md section 2");

#[typetag::serde(name = "closed-form")]
impl Flexibility for ClosedForm {
    fn respond(&self, layer: &Arc<LayerModel>) -> Result<Box<dyn LayerResponse>, Refusal> {
        let elastic = layer.elastic;
        match (layer.base, layer.exponent()) {
            (Base::Infinite, Some(gamma)) => graded_half_plane::response(layer, gamma, METHOD),
            (Base::Rigid, Some(gamma)) => {
                let surface = |layer: &Exponential, s: f64| Ok(Minors::new(layer.elastic, layer.gamma).surface(s));
                Exponential { elastic, gamma, depth: 1.0, surface }.no_steeper(METHOD)
            }
            (_, None) => Err(not_built("a law other than the exponential one")),
            (_, Some(_)) => Err(not_built("a base other than the rigid one")),
        }
    }
}

fn not_built(what: &str) -> Refusal {
    Refusal::NotBuilt {
        what: format!("{what} in flexibility `{METHOD}`"),
        remedy: "use flexibility = { type = \"compliance\" }".into(),
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests;
