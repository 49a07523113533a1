//! A straight line from the surface to the base.

use crate::homogeneous::Constant;
use crate::thickness;
use serde::{Deserialize, Serialize};
use slipzone_api::{Grading, ModulusLaw, Positive, Refusal, Setting};

/// `mu(y) = surface + (base - surface) y/h`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Linear {
    /// Modulus at the surface.
    pub surface: Positive,
    /// Modulus at the base.
    pub base: Positive,
}

slipzone_api::register!(Grading, "linear", "modulus growing or falling in proportion to depth",
    example: "type = \"linear\"\nsurface = 1.0\nbase = 8.0",
    parameters: [
        ("surface", "modulus at the surface (stress)", true, [0.5, 1.0, 100.0], Positive),
        ("base", "modulus at the layer's bottom, y = h (stress)", true, [0.125, 1.0, 8.0], Positive),
    ],
    source: "docs/plugins.md");

#[typetag::serde(name = "linear")]
impl Grading for Linear {
    fn law(&self, setting: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        thickness::of(setting, "a linear grading")?;
        let (surface, base) = (self.surface.get(), self.base.get());
        let is_level = self.surface == self.base;
        Ok(if is_level { Box::new(Constant(surface)) } else { Box::new(Law { surface, base }) })
    }
}

#[derive(Debug)]
struct Law {
    surface: f64,
    base: f64,
}

impl ModulusLaw for Law {
    fn modulus(&self, depth: f64) -> f64 {
        self.surface * (1.0 - depth) + self.base * depth
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        let slope = (self.base - self.surface) / self.surface;
        (0..terms).map(|k| [1.0, slope].get(k).copied().unwrap_or(0.0)).collect()
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
#[allow(clippy::float_cmp)] // where equality is asserted, it is exact by construction
mod tests {
    use super::*;

    fn law(surface: f64, base: f64) -> Box<dyn ModulusLaw> {
        let positive = |value| Positive::new(value).unwrap();
        let linear = Linear { surface: positive(surface), base: positive(base) };
        linear.law(&Setting::thick(positive(4.0))).unwrap()
    }

    #[test]
    fn is_a_line() {
        let line = law(2.0, 10.0);
        assert_eq!([0.0, 0.25, 1.0].map(|depth| line.modulus(depth)), [2.0, 4.0, 10.0]);
        assert_eq!(line.surface_series(4), [1.0, 4.0, 0.0, 0.0]);
        assert_eq!((line.surface_series(1), line.exponent()), (vec![1.0], None));
    }

    #[test]
    fn a_level_line_is_homogeneous() {
        assert_eq!(law(3.0, 3.0).exponent(), Some(0.0));
    }
}
