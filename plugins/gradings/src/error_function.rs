//! An interface blurred by diffusion.

use crate::transition::{Step, Transition};
use serde::{Deserialize, Serialize};
use slipzone_api::taylor::Taylor;
use slipzone_api::{Grading, ModulusLaw, Refusal, Setting};
use spec_math::cephes64::erfc;

/// `mu(y) = (above + below)/2 + (below - above)/2 erf((y - centre)/width)`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ErrorFunction(pub Transition);

slipzone_api::register!(Grading, "error-function", "two materials, their interface blurred as by diffusion",
    also: ["erf", "diffusion"],
    example: "type = \"error-function\"\nabove = 1.0\nbelow = 4.0\ncentre = 1.0\nwidth = 0.5",
    parameters: [
        ("above", "modulus far above the interface (stress)", true, [0.5, 1.0, 100.0], Positive),
        ("below", "modulus far below it (stress)", true, [0.25, 1.0, 4.0], Positive),
        ("centre", "depth of the interface (length)", true, [0.0, 1.0, 2.0], Number),
        ("width", "distance from `centre` at which the modulus is erf(1) = 84 % of the way from its middle value to `below` (length)", true, [0.2, 0.5, 2.0], Positive),
    ],
    source: "DLMF 7.2.1");

#[typetag::serde(name = "error-function")]
impl Grading for ErrorFunction {
    fn law(&self, setting: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        self.0.law::<Diffuse>(setting, "an error-function grading")
    }
}

/// `erfc(z)/2`.
#[derive(Debug)]
struct Diffuse;

impl Step for Diffuse {
    fn value(z: f64) -> f64 {
        0.5 * erfc(z)
    }

    fn series(z: Taylor) -> (Taylor, Taylor) {
        let half = z.erf() * 0.5;
        (-half.clone() + 0.5, half + 0.5)
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_as_erf_does() {
        crate::transition::check::<Diffuse>();
        // erfc(1) and erfc(-1/2) by DLMF 7.6.1, summed to 20 digits.
        assert!((Diffuse::value(1.0) - 0.5 * 0.157_299_207_050_285_13).abs() < 1e-16);
        assert!((Diffuse::value(-0.5) - 0.5 * 1.520_499_877_813_046_5).abs() < 2e-16);
    }
}
