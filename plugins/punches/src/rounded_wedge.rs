//! A wedge whose tip is rounded off.

use serde::{Deserialize, Serialize};
use slipzone_api::{Flaw, Positive, PunchProfile, PunchShape, Refusal};

/// `g(x) = x^2/(2 radius)` up to `|x| = slope radius`, where the straight flanks `g(x) = slope |x| - slope^2 radius/2`
/// continue it without a corner.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RoundedWedge {
    /// Slope of the flanks.
    pub slope: Positive,
    /// Radius of the tip.
    pub radius: Positive,
}

slipzone_api::register!(Punch, "rounded-wedge", "straight flanks from a rounded tip",
    also: ["blunt-wedge", "rounded-cone", "blunted"],
    example: "type = \"rounded-wedge\"\nslope = 0.1\nradius = 5.0",
    parameters: [
        ("slope", "slope of the flanks (no unit)", true, [0.01, 0.1, 0.5], Positive),
        ("radius", "radius of the tip (length)", true, [1.0, 5.0, 100.0], Positive),
    ],
    source: "M. Ciavarella, D. A. Hills, G. Monno, Int. J. Mech. Sci. 40 (1998) 977");

#[typetag::serde(name = "rounded-wedge")]
impl PunchProfile for RoundedWedge {
    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
        let (slope, radius) = (self.slope.get(), self.radius.get());
        Ok(Box::new(Tip { slope, radius, join: [slope * radius] }))
    }
}

#[derive(Debug)]
struct Tip {
    slope: f64,
    radius: f64,
    /// Where the flanks begin; the one kink.
    join: [f64; 1],
}

impl PunchShape for Tip {
    fn height(&self, x: f64) -> f64 {
        let [join] = self.join;
        let x = x.abs();
        if x <= join { 0.5 * x * (x / self.radius) } else { self.slope * (x - 0.5 * join) }
    }

    fn slope(&self, x: f64) -> f64 {
        if x.abs() <= self.join[0] { x / self.radius } else { self.slope.copysign(x) }
    }

    fn natural_length(&self) -> f64 {
        2.0 * self.join[0]
    }

    fn flaw(&self, _half_width: f64) -> Option<Flaw> {
        None
    }

    fn kinks(&self) -> &[f64] {
        &self.join
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}
