//! A cylinder, as contact mechanics takes it: a parabola.

use serde::{Deserialize, Serialize};
use slipzone_api::{Flaw, Positive, PunchProfile, PunchShape, Refusal};

/// `g(x) = x^2/(2 radius)`, good while the contact stays narrow beside the radius.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// Radius of the cylinder.
    pub radius: Positive,
}

slipzone_api::register!(Punch, "cylinder", "parabolic tip of a radius: the contact grows with the load and ends smoothly",
    also: ["circle", "circular", "disc", "disk", "parabola", "parabolic", "hertz", "hertzian"],
    example: "type = \"cylinder\"\nradius = 10.0",
    parameters: [("radius", "radius of the cylinder (length)", true, [1.0, 10.0, 1000.0], Positive)],
    source: "CC13 section 4, eqs. 61-67");

#[typetag::serde(name = "cylinder")]
impl PunchProfile for Cylinder {
    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
        Ok(Box::new(Parabola { radius: self.radius.get() }))
    }
}

#[derive(Debug)]
struct Parabola {
    radius: f64,
}

impl PunchShape for Parabola {
    fn height(&self, x: f64) -> f64 {
        0.5 * x * (x / self.radius)
    }

    fn slope(&self, x: f64) -> f64 {
        x / self.radius
    }

    fn natural_length(&self) -> f64 {
        self.radius
    }

    fn flaw(&self, _half_width: f64) -> Option<Flaw> {
        None
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}
