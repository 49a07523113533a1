//! The route of CC13: eigenvectors, transfer matrix, and their inverse.

use serde::{Deserialize, Serialize};
use slipzone_api::{Flexibility, LayerModel, LayerResponse, Refusal};

/// `H(s, y)`, `G(s) = H(s, 0) H(s, h)^-1` (CC13 eq. 32), `N(s)` (eq. 35).
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TransferMatrix {}

slipzone_api::register!(Flexibility, "transfer-matrix", "the published route through eigenvectors; refuses where it overflows or degenerates",
    example: "type = \"transfer-matrix\"",
    parameters: [],
    source: "CC13 eqs. 18-35");

#[typetag::serde(name = "transfer-matrix")]
impl Flexibility for TransferMatrix {
    fn respond<'a>(&self, layer: &'a LayerModel) -> Result<Box<dyn LayerResponse + 'a>, Refusal> {
        let _ = layer;
        todo!()
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}
