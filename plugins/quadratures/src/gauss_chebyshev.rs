//! The published discretisation: Gauss-Chebyshev after Erdogan, Gupta and Cook.

use serde::{Deserialize, Serialize};
use slipzone_api::{Quadrature, Refusal, Rule, Span};

/// Gauss-Chebyshev nodes and staggered collocation points (CC13 eqs. 55-60, 64-67).
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GaussChebyshev {
    /// Number of nodes over the whole interval, even; left out, the solver chooses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub n: Option<usize>,
}

slipzone_api::register!(Quadrature, "gauss-chebyshev", "the published scheme; treats the kernel as smooth",
    example: "type = \"gauss-chebyshev\"\nn = 60",
    parameters: [("n", "nodes over the whole contact, even", false, [8.0, 60.0, 200.0])],
    source: "CC13 eqs. 55-60, 64-67; F. Erdogan, G. D. Gupta, T. S. Cook (1973)");

#[typetag::serde(name = "gauss-chebyshev")]
impl Quadrature for GaussChebyshev {
    fn rule(&self, span: &Span) -> Result<Box<dyn Rule>, Refusal> {
        let _ = span;
        todo!()
    }

    fn refined(&self, _level: u32) -> Box<dyn Quadrature> {
        todo!()
    }

    fn is_pinned(&self) -> bool {
        self.n.is_some()
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}
