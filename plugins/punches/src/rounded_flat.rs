//! A flat punch whose edges are rounded off.

use serde::{Deserialize, Serialize};
use slipzone_api::{Flaw, Positive, PunchProfile, PunchShape, Refusal};

/// `g(x) = 0` on the face `|x| <= half_width`, then `g(x) = (|x| - half_width)^2/(2 radius)`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RoundedFlat {
    /// Half-width of the flat face, without the rounded edges.
    pub half_width: Positive,
    /// Radius of the edges.
    pub radius: Positive,
}

slipzone_api::register!(Punch, "rounded-flat", "flat face with rounded edges: the contact begins as wide as the face",
    also: ["flat-rounded", "flat-with-rounded-edges", "chamfered"],
    example: "type = \"rounded-flat\"\nhalf_width = 0.5\nradius = 5.0",
    parameters: [
        ("half_width", "half-width of the flat face alone (length)", true, [0.1, 0.5, 1.0], Positive),
        ("radius", "radius of the edges (length)", true, [1.0, 5.0, 100.0], Positive),
    ],
    source: "M. Ciavarella, D. A. Hills, G. Monno, J. Mech. Eng. Sci. 212 (1998) 319");

#[typetag::serde(name = "rounded-flat")]
impl PunchProfile for RoundedFlat {
    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
        Ok(Box::new(Edges { half_width: [self.half_width.get()], radius: self.radius.get() }))
    }
}

#[derive(Debug)]
struct Edges {
    /// Of the face; the one kink.
    half_width: [f64; 1],
    radius: f64,
}

impl Edges {
    /// How far outside the face.
    fn outside(&self, x: f64) -> f64 {
        (x.abs() - self.half_width[0]).max(0.0)
    }
}

impl PunchShape for Edges {
    fn height(&self, x: f64) -> f64 {
        let outside = self.outside(x);
        0.5 * outside * (outside / self.radius)
    }

    fn slope(&self, x: f64) -> f64 {
        self.outside(x).copysign(x) / self.radius
    }

    fn face(&self) -> f64 {
        self.half_width[0]
    }

    fn natural_length(&self) -> f64 {
        2.0 * self.half_width[0] // on the edges, where the height says something
    }

    fn flaw(&self, _half_width: f64) -> Option<Flaw> {
        None
    }

    fn kinks(&self) -> &[f64] {
        &self.half_width
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}
