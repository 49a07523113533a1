//! Stable recursion of the compliance from the base to the surface.

use serde::{Deserialize, Serialize};
use slipzone_api::{Flexibility, LayerModel, LayerResponse, Refusal};

/// The compliance `d = C t` between displacement and traction, carried from the base to the surface.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Compliance {}

slipzone_api::register!(Flexibility, "compliance", "compliance carried from the base to the surface; stable for every wave number and grading",
    example: "type = \"compliance\"",
    parameters: [],
    source: "docs/theory.md section 2");

#[typetag::serde(name = "compliance")]
impl Flexibility for Compliance {
    fn respond<'a>(&self, layer: &'a LayerModel) -> Result<Box<dyn LayerResponse + 'a>, Refusal> {
        let _ = layer;
        todo!()
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}
