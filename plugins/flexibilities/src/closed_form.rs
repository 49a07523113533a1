//! Exponential layers in closed form.

mod exponents;
mod minors;

use crate::compliance::STEEPEST;
use crate::half_plane::HalfPlane;
use crate::surface_tail;
use minors::Minors;
use serde::{Deserialize, Serialize};
use slipzone_api::{Base, Elastic, Flexibility, LayerModel, LayerResponse, Refusal, SurfaceFlexibility};
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
        match (layer.base, layer.law.exponent()) {
            (Base::Infinite, Some(0.0)) => Ok(Box::new(HalfPlane { elastic })),
            (Base::Rigid, Some(gamma)) if gamma.abs() <= STEEPEST => Ok(Box::new(Bonded { elastic, gamma })),
            (Base::Rigid, Some(gamma)) => Err(Refusal::OutOfReach {
                method: METHOD,
                why: format!("ln(mu3/mu1) = {gamma} is beyond +-{STEEPEST}"),
                remedy: "use a modulus at the base that is closer to the one at the surface",
            }),
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

/// `mu1 exp(gamma y)` on a rigid base.
#[derive(Debug)]
struct Bonded {
    elastic: Elastic,
    gamma: f64,
}

impl LayerResponse for Bonded {
    fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        Ok(Minors::new(self.elastic, self.gamma).surface(s))
    }

    fn elastic(&self) -> Elastic {
        self.elastic
    }

    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        surface_tail::exponential(self.elastic, self.gamma, terms)
    }

    fn depth(&self) -> Option<f64> {
        Some(1.0)
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests;
