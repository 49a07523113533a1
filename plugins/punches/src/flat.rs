//! A flat punch with sharp corners.

use serde::{Deserialize, Serialize};
use slipzone_api::{FlatFace, Positive, PunchProfile, PunchShape, Refusal};

/// `g(x) = 0` for `|x| <= half_width`: the contact is as wide as the punch at any load.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Flat {
    /// Half the punch's width.
    pub half_width: Positive,
}

slipzone_api::register!(Punch, "flat", "flat face, sharp corners: the contact never grows",
    also: ["rectangle", "rectangular", "flat-ended", "block"],
    example: "type = \"flat\"\nhalf_width = 1.0",
    parameters: [("half_width", "half the punch's width (length)", true, [0.1, 1.0, 10.0], Positive)],
    source: "CC13 section 3, eqs. 45-60");

#[typetag::serde(name = "flat")]
impl PunchProfile for Flat {
    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
        Ok(Box::new(FlatFace { half_width: self.half_width.get() }))
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}
