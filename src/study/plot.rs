//! Figures that a study asks for.

use serde::{Deserialize, Serialize};

/// A figure of a study: what is drawn over what.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plot {
    /// Name of the SVG file in the folder of the results.
    pub file: String,
    /// What it shows.
    #[serde(default)]
    pub kind: PlotKind,
    /// Title above the figure; the study's unless it has one of its own.
    #[serde(default)]
    pub title: Option<String>,
    /// The abscissa: an axis (its field or label) or a number of the result, such as `load.force`. Of tractions it is
    /// `x/b`, and left out.
    #[serde(default)]
    pub x: Option<String>,
    /// The ordinate: an axis or a number of the result; of tractions `pressure`, `shear` or both.
    pub y: OneOrMore,
    /// The number that a map shows over two axes.
    #[serde(default)]
    pub z: Option<String>,
    /// Axes whose values have a curve each; all that are neither `x` nor `y`, unless some are listed.
    #[serde(default)]
    pub family: Option<OneOrMore>,
    /// Steps along the abscissa.
    #[serde(default)]
    pub x_scale: Scale,
    /// Steps along the ordinate.
    #[serde(default)]
    pub y_scale: Scale,
    /// In place of the name of the abscissa.
    #[serde(default)]
    pub x_label: Option<String>,
    /// In place of the name of the ordinate.
    #[serde(default)]
    pub y_label: Option<String>,
    /// What tractions are divided by.
    #[serde(default)]
    pub over: Over,
    /// Rows that are left out unless the axes named here have the values given: `only = { "mu1/mu3" = "8" }`.
    #[serde(default)]
    pub only: std::collections::BTreeMap<String, toml::Value>,
    /// Lines across the figure at given ordinates.
    #[serde(default)]
    pub lines: Vec<Line>,
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

/// One name or several.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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

/// What a figure shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PlotKind {
    /// A number over an axis, a curve for each member of a family.
    #[default]
    Curves,
    /// A number over two axes, as filled contours.
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
