//! A punch given by a formula for its height or its slope.

mod shape;

use serde::{Deserialize, Serialize};
use slipzone_api::{Fault, Files, PunchProfile, PunchShape, Refusal, Values};
use slipzone_formula as formula;
use std::collections::BTreeMap;

/// `g(x)`, or `g'(x)`, as a formula in `x` and named parameters; see [`slipzone_formula`] for what may stand in it.
///
/// A height is shifted so that `g(0) = 0`; of a slope, the height is the integral.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Formula {
    /// What the text gives.
    gives: Gives,
    text: String,
    parameters: BTreeMap<String, f64>,
}

/// What a formula is for.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Gives {
    Height,
    Slope,
}

impl Gives {
    /// The key in a scene.
    const fn key(self) -> &'static str {
        match self {
            Self::Height => "height",
            Self::Slope => "slope",
        }
    }
}

/// The keys of the table in a scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(skip_serializing_if = "Option::is_none")]
    height: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    slope: Option<String>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    parameters: BTreeMap<String, f64>,
}

impl TryFrom<Written> for Formula {
    type Error = String;

    fn try_from(written: Written) -> Result<Self, String> {
        let (gives, text) = match (written.height, written.slope) {
            (Some(height), None) => (Gives::Height, height),
            (None, Some(slope)) => (Gives::Slope, slope),
            (Some(_), Some(_)) => return Err("expected one of `height` and `slope`, found both".into()),
            (None, None) => return Err("expected `height` or `slope` (a formula in `x`), found neither".into()),
        };
        Ok(Self { gives, text, parameters: written.parameters })
    }
}

impl From<Formula> for Written {
    fn from(formula: Formula) -> Self {
        let (height, slope) = match formula.gives {
            Gives::Height => (Some(formula.text), None),
            Gives::Slope => (None, Some(formula.text)),
        };
        Self { height, slope, parameters: formula.parameters }
    }
}

slipzone_api::register!(Punch, "formula", "height or slope by a formula in x with named parameters",
    also: ["function", "expression", "custom"],
    example: "type = \"formula\"\nheight = \"x^2/(2*R)\"\nparameters = { R = 10.0 }",
    parameters: [
        ("height", "formula in `x` (length); `slope` (no unit) may stand in its place", true, [], Text),
        ("slope", "formula in `x` (no unit)", false, [], Text, in_place_of "height"),
        ("parameters", "values of the names in the formula", false, [], ByName(&Values::Number)),
    ],
    source: "docs/plugins.md");

impl Formula {
    /// The punch of a formula for its height.
    pub fn height(text: impl Into<String>, parameters: BTreeMap<String, f64>) -> Self {
        Self { gives: Gives::Height, text: text.into(), parameters }
    }

    /// The punch of a formula for its slope.
    pub fn slope(text: impl Into<String>, parameters: BTreeMap<String, f64>) -> Self {
        Self { gives: Gives::Slope, text: text.into(), parameters }
    }

    fn understood(&self) -> Result<shape::Graph, Fault> {
        let key = self.gives.key();
        let formula = formula::Formula::parse(key, &self.text, "x", &self.parameters)?;
        shape::Graph::new(formula, self.gives).map_err(|fault| Fault { path: vec![key.into()], ..fault })
    }
}

#[typetag::serde(name = "formula")]
impl PunchProfile for Formula {
    fn read(&mut self, _files: &dyn Files) -> Result<(), Fault> {
        self.understood().map(|_| ())
    }

    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
        match self.understood() {
            Ok(graph) => Ok(Box::new(graph)),
            Err(fault) => Err(Refusal::Unusable { plugin: "formula", why: fault.to_string() }),
        }
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests;
