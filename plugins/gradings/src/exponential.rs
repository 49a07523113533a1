//! The exponential law of CC13.

use serde::{Deserialize, Serialize};
use slipzone_api::{Finite, Grading, ModulusLaw, Positive, Refusal, Setting};

/// `mu(y) = mu1 exp(gamma y)`, `gamma = ln(mu3/mu1)/h` (CC13 eqs. 1, 2).
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Exponential {
    surface: Positive,
    decay: Decay,
}

/// The two ways of saying how fast the modulus changes.
#[derive(Clone, Copy, Debug)]
enum Decay {
    /// By the modulus at the base, `mu3`.
    Base(Positive),
    /// By `gamma`, in 1/length.
    Gradient(f64),
}

/// The keys of the table in a scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    surface: Positive,
    #[serde(skip_serializing_if = "Option::is_none")]
    base: Option<Positive>,
    #[serde(skip_serializing_if = "Option::is_none")]
    gradient: Option<f64>,
}

impl TryFrom<Written> for Exponential {
    type Error = String;

    fn try_from(written: Written) -> Result<Self, String> {
        let decay = match (written.base, written.gradient) {
            (Some(base), None) => Decay::Base(base),
            (None, Some(gradient)) if gradient.is_finite() => Decay::Gradient(gradient),
            (None, Some(gradient)) => return Err(format!("expected a finite `gradient`, found {gradient}")),
            (Some(_), Some(_)) => return Err("expected one of `base` and `gradient`, found both".into()),
            (None, None) => {
                return Err("expected `base` (modulus at the base) or `gradient` (1/length), found neither".into());
            }
        };
        Ok(Self { surface: written.surface, decay })
    }
}

impl From<Exponential> for Written {
    fn from(law: Exponential) -> Self {
        let (base, gradient) = match law.decay {
            Decay::Base(base) => (Some(base), None),
            Decay::Gradient(gradient) => (None, Some(gradient)),
        };
        Self { surface: law.surface, base, gradient }
    }
}

slipzone_api::register!(Grading, "exponential", "modulus growing or falling exponentially with depth",
    also: ["exp"],
    example: "type = \"exponential\"\nsurface = 1.0\nbase = 8.0",
    parameters: [
        ("surface", "modulus at the surface (stress)", true, [0.5, 1.0, 100.0], Positive),
        ("base", "modulus at the layer's bottom, y = h (stress); `gradient` (gamma, in 1/length) may stand in its place", true, [0.125, 1.0, 8.0], Positive),
        ("gradient", "gamma of surface exp(gamma y) (1/length)", false, [-0.5, 0.0, 0.5], Number, in_place_of "base"),
    ],
    source: "CC13 eqs. 1, 2");

impl Exponential {
    /// The law that grows by a factor of `e` over the length `1/gradient`.
    pub fn by_gradient(surface: Positive, gradient: Finite) -> Self {
        Self { surface, decay: Decay::Gradient(gradient.get()) }
    }
}

#[typetag::serde(name = "exponential")]
impl Grading for Exponential {
    fn law(&self, setting: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        let surface = self.surface.get();
        let exponent = match (self.decay, setting.thickness) {
            (Decay::Base(base), Some(_)) => log_ratio(base.get(), surface),
            (Decay::Gradient(gradient), thickness) => gradient * thickness.map_or(1.0, Positive::get),
            (Decay::Base(_), None) => {
                return Err(Refusal::NotBuilt {
                    what: "an exponential grading towards a `base` modulus on a solid without a base".into(),
                    remedy: "give `gradient` (gamma, in 1/length) in place of `base`".into(),
                });
            }
        };
        Ok(Box::new(Law { surface, exponent }))
    }
}

/// `ln(a/b)` to full relative precision, also where the two nearly agree or their quotient overflows.
fn log_ratio(a: f64, b: f64) -> f64 {
    let excess = (a - b) / b;
    if excess.abs() < 0.5 { excess.ln_1p() } else { a.ln() - b.ln() }
}

/// `surface exp(exponent depth)`, depth in units of the thickness.
#[derive(Debug)]
struct Law {
    surface: f64,
    exponent: f64,
}

impl ModulusLaw for Law {
    fn modulus(&self, depth: f64) -> f64 {
        self.surface * (self.exponent * depth).exp()
    }

    fn exponent(&self) -> Option<f64> {
        Some(self.exponent)
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(surface: f64, decay: Decay, h: f64) -> Box<dyn ModulusLaw> {
        let surface = Positive::new(surface).unwrap();
        Exponential { surface, decay }.law(&Setting::thick(Positive::new(h).unwrap())).unwrap()
    }

    #[test]
    fn meets_both_ends() {
        let layer = law(2.0, Decay::Base(Positive::new(16.0).unwrap()), 5.0);
        assert!((layer.surface_modulus() - 2.0).abs() < f64::EPSILON, "exp(0) = 1");
        assert!((layer.modulus(1.0) - 16.0).abs() < 16.0 * 4.0 * f64::EPSILON, "rounding of exp(ln 8)");
    }

    #[test]
    fn a_gradient_says_the_same_as_a_base_modulus() {
        let by_base = law(1.0, Decay::Base(Positive::new(8.0).unwrap()), 5.0).exponent().unwrap();
        let by_gradient = law(1.0, Decay::Gradient(8.0_f64.ln() / 5.0), 5.0).exponent().unwrap();
        assert!((by_base - by_gradient).abs() < 1e-15);
    }

    #[test]
    fn nearly_equal_moduli_keep_their_digits() {
        let tiny = 1e-12;
        let exponent = law(1.0, Decay::Base(Positive::new(1.0 + tiny).unwrap()), 1.0).exponent().unwrap();
        let exact = (1.0 + tiny) - 1.0; // what the float really holds; ln(1 + x) = x to 5e-13 here
        assert!((exponent / exact - 1.0).abs() < 1e-12);
    }
}
