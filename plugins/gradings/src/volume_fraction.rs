//! Two materials mixed in a proportion that changes with depth.

mod law;
mod phase;
mod rule;

use crate::homogeneous::Constant;
use crate::own_poisson::OwnPoisson;
use crate::thickness;
use law::Law;
pub use phase::Phase;
pub use rule::MixingRule;
use serde::{Deserialize, Serialize};
use slipzone_api::{Grading, ModulusLaw, Parameter, Positive, Refusal, Setting, Values};

/// A volume fraction `(y/h)^exponent` of the base's material in that of the surface, and a rule for what the mixture
/// is.
///
/// Moduli are of the kind that the scene names. With an exponent that is no whole number the law has only so many
/// derivatives at the surface; the kernel strategy `octaves` does without.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VolumeFraction {
    /// The material at the surface.
    pub surface: Phase,
    /// The material at the base.
    pub base: Phase,
    /// Power of the relative depth.
    pub exponent: Positive,
    /// How the mixture's moduli come about.
    pub rule: MixingRule,
}

slipzone_api::register!(Grading, "volume-fraction", "two materials mixed, the share of the second like a power of depth",
    also: ["fgm", "functionally-graded", "mixture", "rule-of-mixtures", "mori-tanaka"],
    example: "type = \"volume-fraction\"\nsurface = { modulus = 1.0, poisson = 0.3 }\nbase = { modulus = 4.0, poisson = 0.2 }\n\
              exponent = 2.0\nrule = \"mori-tanaka\"",
    parameters: [
        ("surface", "{ modulus, poisson } of the material at the surface (stress, no unit)", true, [], Table(PHASE)),
        ("base", "{ modulus, poisson } of the material at the base (stress, no unit)", true, [], Table(PHASE)),
        ("exponent", "power of the depth in the volume fraction of the base's material", true, [1.0, 2.0, 2.5], Positive),
        ("rule", "\"mixture\" (modulus and Poisson's ratio in proportion) or \"mori-tanaka\" (spheres of the base's material in that of the surface)", true, [], OneOf(&["mixture", "mori-tanaka"])),
    ],
    source: "Y. Benveniste, Mech. Mater. 6 (1987) 147, eqs. 21, 22 for spheres");

/// Keys of a material.
const PHASE: &[Parameter] = &[
    Parameter::required("modulus", "its modulus (stress)", Values::Positive),
    Parameter::required("poisson", "its Poisson's ratio (no unit)", Values::Poisson),
];

#[typetag::serde(name = "volume-fraction")]
impl Grading for VolumeFraction {
    fn law(&self, setting: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        thickness::of(setting, "a volume fraction that grows towards the base")?;
        let Self { surface, base, exponent, rule } = self;
        if surface == base {
            return Ok(Box::new(OwnPoisson::new(Box::new(Constant(surface.modulus.get())), surface.poisson)));
        }
        let mixture = rule.mixture(*surface, *base, setting.moduli);
        Ok(Box::new(Law::new(mixture, exponent.get())))
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests;
