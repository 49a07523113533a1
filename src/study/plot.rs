//! Figures that a study asks for.

use serde::de::value::SeqAccessDeserializer;
use serde::de::{self, Deserializer, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// A figure of a study: what is drawn over what.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plot {
    /// Name of the SVG file in the folder of the results.
    pub file: String,
    /// What it shows.
    #[serde(default)]
    pub kind: PlotKind,
    /// Title above the figure; the study's unless it has one of its own.
    pub title: Option<String>,
    /// A line under the title: what all curves have in common.
    pub note: Option<String>,
    /// The abscissa: an axis (its field or label) or a number of the result, such as `load.force`. Of tractions it is
    /// `x/b`, and left out.
    pub x: Option<String>,
    /// The ordinate: numbers of the result, side by side where there are several; of a map its second axis; of
    /// tractions `pressure`, `shear`, or both where it is left out.
    pub y: Option<OneOrMore>,
    /// The number that a map shows over two axes.
    pub z: Option<String>,
    /// Axes whose values have a curve each; unless some are listed, all that are neither drawn at random nor the
    /// abscissa nor the panels. (Over a number of the result a curve follows the last axis.)
    pub family: Option<OneOrMore>,
    /// An axis whose values have a panel each.
    pub panels: Option<String>,
    /// Steps along the abscissa.
    #[serde(default)]
    pub x_scale: Scale,
    /// Steps along the ordinate.
    #[serde(default)]
    pub y_scale: Scale,
    /// In place of the name of the abscissa.
    pub x_label: Option<String>,
    /// In place of the name of the ordinate.
    pub y_label: Option<String>,
    /// What tractions are divided by.
    #[serde(default)]
    pub over: Over,
    /// Scenes that are shown: those where the axes named have a value listed, `only = { "mu1/mu3" = ["1", "8"] }`.
    #[serde(default)]
    pub only: BTreeMap<String, toml::Value>,
    /// Lines across the figure at given ordinates.
    #[serde(default)]
    pub lines: Vec<Line>,
    /// Numbers from elsewhere, as marks.
    #[serde(default)]
    pub points: Vec<Points>,
}

/// A line across a figure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// Its ordinate.
    pub y: f64,
    /// Its name in the legend.
    pub label: String,
}

/// Numbers that were measured, published or computed elsewhere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Points {
    /// Their name in the legend.
    pub label: String,
    /// Abscissae.
    pub x: Vec<f64>,
    /// Ordinates.
    pub y: Vec<f64>,
}

/// One name or several.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum OneOrMore {
    /// One name.
    One(String),
    /// Several.
    More(Vec<String>),
}

impl OneOrMore {
    /// The names.
    pub fn names(&self) -> &[String] {
        match self {
            Self::One(name) => std::slice::from_ref(name),
            Self::More(names) => names,
        }
    }
}

impl<'de> Deserialize<'de> for OneOrMore {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Names)
    }
}

/// Reads [`OneOrMore`]; the derived code would not say what it takes.
struct Names;

impl<'de> Visitor<'de> for Names {
    type Value = OneOrMore;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a name in quotes, or an array of names")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<OneOrMore, E> {
        Ok(OneOrMore::One(name.into()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, names: A) -> Result<OneOrMore, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(names)).map(OneOrMore::More)
    }
}

/// What a figure shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PlotKind {
    /// A number over an axis, a curve for each member of a family.
    #[default]
    Curves,
    /// A number over two axes, in colours.
    Map,
    /// Tractions over the contact, a curve for each scene.
    Tractions,
}

/// How an axis of a figure is stepped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scale {
    /// Equal steps.
    #[default]
    Linear,
    /// Equal factors.
    Log,
}

/// What tractions are divided by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Over {
    /// The mean pressure `P/2b`.
    #[default]
    Mean,
    /// The shear modulus at the surface.
    Modulus,
    /// Nothing: stresses in the scene's unit.
    One,
}
