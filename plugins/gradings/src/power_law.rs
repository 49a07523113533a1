//! A power of the depth below a point above the surface.

use crate::homogeneous::Constant;
use crate::thickness;
use serde::{Deserialize, Serialize};
use slipzone_api::taylor::Taylor;
use slipzone_api::{Finite, Grading, ModulusLaw, Positive, Refusal, Setting};

/// `mu(y) = surface (1 + y/length)^exponent`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PowerLaw {
    /// Modulus at the surface.
    pub surface: Positive,
    /// Depth at which the modulus is `2^exponent` times that at the surface.
    pub length: Positive,
    /// Power, of either sign.
    pub exponent: Finite,
}

slipzone_api::register!(Grading, "power-law", "modulus like a power of depth: surface (1 + y/length)^exponent",
    also: ["power"],
    example: "type = \"power-law\"\nsurface = 1.0\nlength = 2.0\nexponent = 1.5",
    parameters: [
        ("surface", "modulus at the surface (stress)", true, [0.5, 1.0, 100.0], Positive),
        ("length", "depth at which the modulus is 2^exponent times that at the surface (length)", true, [0.5, 2.0, 10.0], Positive),
        ("exponent", "power, a number of either sign", true, [-1.0, 0.5, 1.0, 2.0], Number),
    ],
    source: "docs/plugins.md");

#[typetag::serde(name = "power-law")]
impl Grading for PowerLaw {
    fn law(&self, setting: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        let thickness = thickness::of(setting, "a power law")?;
        let (surface, exponent) = (self.surface.get(), self.exponent.get());
        if exponent == 0.0 {
            return Ok(Box::new(Constant(surface)));
        }
        Ok(Box::new(Law { surface, rate: thickness / self.length.get(), exponent }))
    }
}

/// `surface (1 + rate depth)^exponent`.
#[derive(Debug)]
struct Law {
    surface: f64,
    rate: f64,
    exponent: f64,
}

impl ModulusLaw for Law {
    fn modulus(&self, depth: f64) -> f64 {
        self.surface * (self.exponent * (self.rate * depth).ln_1p()).exp()
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        Taylor::line(1.0, self.rate, terms).powf(self.exponent).into_finite()
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(length: f64, exponent: f64, thickness: f64) -> Box<dyn ModulusLaw> {
        let positive = |value| Positive::new(value).unwrap();
        let exponent = Finite::new(exponent).unwrap();
        let law = PowerLaw { surface: positive(2.0), length: positive(length), exponent };
        law.law(&Setting::thick(positive(thickness))).unwrap()
    }

    #[test]
    fn values_and_series() {
        let quadratic = law(2.0, 2.0, 4.0);
        assert!((quadratic.modulus(0.5) - 8.0).abs() < 1e-14);
        let series = quadratic.surface_series(4);
        assert!(series.iter().zip([1.0, 4.0, 4.0, 0.0]).all(|(a, b)| (a - b).abs() < 1e-15), "{series:?}");
        let inverse = law(4.0, -1.0, 4.0).surface_series(4);
        assert!(inverse.iter().zip([1.0, -1.0, 1.0, -1.0]).all(|(a, b)| (a - b).abs() < 1e-15), "{inverse:?}");
        assert_eq!(law(4.0, 0.0, 4.0).exponent(), Some(0.0));
    }

    /// `(1 + y/(n l))^n` tends to `exp(y/l)`: the difference is of order 1/n.
    #[test]
    fn great_powers_tend_to_the_exponential() {
        let law = law(1e9, 1e9, 1.5);
        assert!((law.modulus(1.0) / (2.0 * 1.5_f64.exp()) - 1.0).abs() < 1e-8);
    }
}
