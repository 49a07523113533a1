//! The Fourier integrals of CC13, cut at a finite wave number.

use serde::{Deserialize, Serialize};
use slipzone_api::{KernelRequest, KernelStrategy, KernelTable, LayerResponse, Positive, Refusal};

/// CC13 eqs. 43, 44 over `[0, S]`, the leading `1/s` of the tail beyond in closed form.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Truncated {
    /// `S h`; left out, the solver raises it until the error estimate is met.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cutoff: Option<Positive>,
}

slipzone_api::register!(Kernel, "truncated", "Fourier integral cut at a finite wave number, leading tail in closed form",
    example: "type = \"truncated\"\ncutoff = 80.0",
    parameters: [("cutoff", "wave number times thickness at which the integral is cut", false, [40.0, 80.0, 320.0])],
    source: "CC13 eqs. 43, 44");

#[typetag::serde(name = "truncated")]
impl KernelStrategy for Truncated {
    fn tabulate(&self, response: &dyn LayerResponse, request: &KernelRequest) -> Result<Box<dyn KernelTable>, Refusal> {
        let _ = (response, request);
        todo!()
    }

    fn refined(&self, _level: u32) -> Box<dyn KernelStrategy> {
        todo!()
    }

    fn is_pinned(&self) -> bool {
        self.cutoff.is_some()
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}
