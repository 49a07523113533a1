//! A wedge with a sharp tip.

use serde::{Deserialize, Serialize};
use slipzone_api::{Flaw, Positive, PunchProfile, PunchShape, Refusal};

/// `g(x) = slope |x|`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wedge {
    /// Slope of the flanks, the tangent of their angle with the surface.
    pub slope: Positive,
}

slipzone_api::register!(Punch, "wedge", "straight flanks from a sharp tip: the pressure is unbounded in the middle",
    also: ["cone", "conical", "triangle", "triangular", "vee"],
    example: "type = \"wedge\"\nslope = 0.1",
    parameters: [("slope", "slope of the flanks (no unit)", true, [0.01, 0.1, 0.5], Positive)],
    source: "K. L. Johnson, Contact Mechanics (1985), section 5.2: half-plane, P = 2 b slope/A0");

#[typetag::serde(name = "wedge")]
impl PunchProfile for Wedge {
    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
        Ok(Box::new(Flanks { slope: self.slope.get() }))
    }
}

#[derive(Debug)]
struct Flanks {
    slope: f64,
}

impl PunchShape for Flanks {
    fn height(&self, x: f64) -> f64 {
        self.slope * x.abs()
    }

    fn slope(&self, x: f64) -> f64 {
        if x == 0.0 { 0.0 } else { self.slope.copysign(x) }
    }

    /// A wedge has no length: it looks alike at every scale.
    fn natural_length(&self) -> f64 {
        1.0
    }

    fn flaw(&self, _half_width: f64) -> Option<Flaw> {
        None
    }

    fn kinks(&self) -> &[f64] {
        &[0.0]
    }

    fn corners(&self) -> &[f64] {
        &[0.0]
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}
