//! One modulus at every depth.

use serde::{Deserialize, Serialize};
use slipzone_api::{Grading, ModulusLaw, Positive, Refusal, Setting};

/// `mu(y) = modulus`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Homogeneous {
    /// Shear modulus.
    pub modulus: Positive,
}

slipzone_api::register!(Grading, "homogeneous", "the same modulus at every depth",
    also: ["uniform", "constant", "isotropic", "none"],
    example: "type = \"homogeneous\"\nmodulus = 1.0",
    parameters: [("modulus", "modulus (stress)", true, [0.5, 1.0, 200.0], Positive)],
    source: "docs/theory.md section 1");

#[typetag::serde(name = "homogeneous")]
impl Grading for Homogeneous {
    fn law(&self, _setting: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        Ok(Box::new(Constant(self.modulus.get())))
    }
}

#[derive(Debug)]
pub(crate) struct Constant(pub(crate) f64);

impl ModulusLaw for Constant {
    fn modulus(&self, _depth: f64) -> f64 {
        self.0
    }

    fn exponent(&self) -> Option<f64> {
        Some(0.0)
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}
