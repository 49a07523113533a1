//! A flat punch with sharp corners.

use serde::{Deserialize, Serialize};
use slipzone_api::{Positive, PunchProfile, PunchShape, Refusal};

/// `g(x) = 0` for `|x| <= half_width`: the contact is as wide as the punch at any load.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Flat {
    /// Half the punch's width.
    pub half_width: Positive,
}

slipzone_api::register!(Punch, "flat", "flat face, sharp corners: the contact never grows",
    example: "type = \"flat\"\nhalf_width = 1.0",
    parameters: [("half_width", "half the punch's width (length)", true, [0.1, 1.0, 10.0])],
    source: "CC13 section 3, eqs. 45-60");

#[typetag::serde(name = "flat")]
impl PunchProfile for Flat {
    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
        Ok(Box::new(Face { half_width: self.half_width.get() }))
    }
}

#[derive(Debug)]
struct Face {
    half_width: f64,
}

impl PunchShape for Face {
    fn height(&self, _x: f64) -> f64 {
        0.0
    }

    fn slope(&self, _x: f64) -> f64 {
        0.0
    }

    fn fixed_half_width(&self) -> Option<f64> {
        Some(self.half_width)
    }

    fn natural_length(&self) -> f64 {
        self.half_width
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}
