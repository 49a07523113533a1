//! Which plugins are linked into this program.

use crate::Values;
use serde::Serialize;

/// The five families of plugins.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Family {
    /// [`crate::Grading`], `layer.grading`.
    Grading,
    /// [`crate::PunchProfile`], `[punch]`.
    Punch,
    /// [`crate::Flexibility`], `solver.flexibility`.
    Flexibility,
    /// [`crate::KernelStrategy`], `solver.kernel`.
    Kernel,
    /// [`crate::Quadrature`], `solver.quadrature`.
    Quadrature,
}

impl Family {
    /// All families, in the order in which a scene names them.
    pub const ALL: [Self; 5] = [Self::Grading, Self::Punch, Self::Flexibility, Self::Kernel, Self::Quadrature];

    /// Where a scene names a plugin of this family, such as `layer.grading`.
    pub fn place(self) -> &'static str {
        match self {
            Self::Grading => "layer.grading",
            Self::Punch => "punch",
            Self::Flexibility => "solver.flexibility",
            Self::Kernel => "solver.kernel",
            Self::Quadrature => "solver.quadrature",
        }
    }

    /// Name in words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Grading => "grading",
            Self::Punch => "punch",
            Self::Flexibility => "flexibility",
            Self::Kernel => "kernel",
            Self::Quadrature => "quadrature",
        }
    }
}

/// One key of a plugin's table: enough for an editor, a chart or a random scene to fill it in.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Parameter {
    /// The key.
    pub name: &'static str,
    /// Meaning and unit, in a few words.
    pub summary: &'static str,
    /// Whether the key must be there.
    pub required: bool,
    /// Values that make sense, smallest first.
    pub samples: &'static [f64],
    /// What it may hold.
    pub values: Values,
    /// The key that it excludes and whose absence it makes up for.
    pub in_place_of: Option<&'static str>,
}

impl Parameter {
    /// Whether its unit, in brackets at the end of the summary, is that of length.
    pub fn is_length(&self) -> bool {
        self.summary.ends_with("(length)")
    }
}

/// The record beside each plugin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PluginInfo {
    /// Family.
    pub family: Family,
    /// The `type` under which a scene names it.
    pub name: &'static str,
    /// What it is, in one line.
    pub summary: &'static str,
    /// Words for it elsewhere, of which a scene that has one is told its name: lower case, `-` between words.
    pub also: &'static [&'static str],
    /// A table body (TOML, `type` included) that parses, and is complete without files.
    pub example: &'static str,
    /// Keys besides `type`.
    pub parameters: &'static [Parameter],
    /// Paper and equation, or where the formula was derived.
    pub source: &'static str,
    /// The crate that brings it.
    pub krate: &'static str,
}
inventory::collect!(PluginInfo);

/// Every linked plugin, sorted by family and name (`inventory` promises no order).
pub fn plugins() -> Vec<&'static PluginInfo> {
    let mut all: Vec<_> = inventory::iter::<PluginInfo>.into_iter().collect();
    all.sort_unstable_by_key(|info| (info.family, info.name));
    all
}

/// The plugin of a family with that name.
pub fn find(family: Family, name: &str) -> Option<&'static PluginInfo> {
    plugins().into_iter().find(|info| info.family == family && info.name == name)
}

/// The name of the plugin of a family that goes by a word elsewhere; case and `_` for `-` not counted.
pub fn known_elsewhere(family: Family, word: &str) -> Option<&'static str> {
    let word = word.to_lowercase().replace('_', "-");
    let is_meant = |info: &&PluginInfo| info.family == family && info.also.contains(&word.as_str());
    plugins().into_iter().find(is_meant).map(|info| info.name)
}

/// Records a plugin: put it beside the `#[typetag::serde]` implementation.
///
/// A key is its name, its meaning and unit, whether it is required, samples, and what it may hold: a variant of
/// [`Values`], which may be left out; `in_place_of "..."` behind that names a key for which it may stand. `also`, which may be left out,
/// are words for the plugin elsewhere: who writes one in a scene is told its name.
///
/// ```
/// slipzone_api::register!(Punch, "needle", "a punch with no width",
///     also: ["stylus"],
///     example: "type = \"needle\"\nlength = 1.0",
///     parameters: [("length", "length of the needle", true, [0.5, 1.0], Positive)],
///     source: "none");
/// assert!(slipzone_api::find(slipzone_api::Family::Punch, "needle").is_some());
/// assert_eq!(slipzone_api::known_elsewhere(slipzone_api::Family::Punch, "Stylus"), Some("needle"));
/// ```
#[macro_export]
macro_rules! register {
    ($family:ident, $name:literal, $summary:literal,
     $(also: [$($also:literal),* $(,)?],)?
     example: $example:literal,
     parameters: [$((
        $key:literal, $about:literal, $required:literal, [$($sample:expr),* $(,)?]
        $(, $values:ident $(($($of:tt)*))? $(, in_place_of $other:literal)?)? $(,)?
     )),* $(,)?],
     source: $source:literal $(,)?) => {
        $crate::inventory::submit! {
            $crate::PluginInfo {
                family: $crate::Family::$family,
                name: $name,
                summary: $summary,
                also: &[$($($also),*)?],
                example: $example,
                parameters: &[$($crate::Parameter {
                    name: $key, summary: $about, required: $required, samples: &[$($sample),*],
                    values: $crate::register!(@values $($values $(($($of)*))?)?),
                    in_place_of: $crate::register!(@other $($($other)?)?),
                }),*],
                source: $source,
                krate: env!("CARGO_PKG_NAME"),
            }
        }
    };
    (@values) => { $crate::Values::Unstated };
    (@values $($values:tt)+) => { $crate::Values::$($values)+ };
    (@other) => { None };
    (@other $other:literal) => { Some($other) };
}
