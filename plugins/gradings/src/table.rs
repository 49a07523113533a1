//! A modulus given by measured or computed values.

mod floater_hormann;
mod profile;
mod rows;

use crate::thickness;
use profile::Profile;
use serde::{Deserialize, Serialize};
use slipzone_api::rows::Source;
use slipzone_api::{Fault, Files, Grading, ModulusLaw, NoFiles, Positive, Refusal, Setting, Values};
use std::sync::Arc;

/// Moduli, and Poisson's ratios, at depths.
///
/// Between the rows, and exactly through them, go rational functions without poles (M. Floater, K. Hormann, Numer.
/// Math. 107 (2007) 315, of degree 4): one for the logarithm of the modulus, so that it stays positive and an
/// exponential law comes back exactly, one for Poisson's ratio. They are analytic; their error falls like the fifth
/// power of the distance between rows. What scatters in the rows scatters between them, too: nothing is smoothed. Time:
/// linear in the number of rows for each value.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Table {
    source: Source<Vec<f64>>,
    depth_unit: Positive,
    modulus_unit: Positive,
    /// What was made of the rows, once they are there.
    profile: Option<Arc<Profile>>,
}

/// The keys of the table in a scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<Vec<Vec<f64>>>,
    #[serde(default = "one")]
    depth_unit: Positive,
    #[serde(default = "one")]
    modulus_unit: Positive,
}

fn one() -> Positive {
    Positive::new(1.0).expect("a positive constant")
}

impl TryFrom<Written> for Table {
    type Error = String;

    fn try_from(Written { file, points, depth_unit, modulus_unit }: Written) -> Result<Self, String> {
        let source = Source::of_keys(file, points, "depth and modulus")?;
        Ok(Self { source, depth_unit, modulus_unit, profile: None })
    }
}

impl From<Table> for Written {
    fn from(Table { source, depth_unit, modulus_unit, .. }: Table) -> Self {
        let (file, points) = source.into_keys();
        Self { file, points, depth_unit, modulus_unit }
    }
}

slipzone_api::register!(Grading, "table", "measured or computed moduli at depths, with a smooth curve through them",
    also: ["points", "profile", "measured", "file", "csv", "data", "spline"],
    example: "type = \"table\"\npoints = [[0.0, 1.0], [1.0, 1.5], [2.0, 2.2], [3.0, 3.1], [5.0, 5.5]]",
    parameters: [
        ("points", "[[depth, modulus], ...] or [[depth, modulus, poisson], ...], from depth 0 to the base at least, at least 4 rows (depth_unit, modulus_unit, no unit); `file`, the name of a file with such rows, may stand in its place", true, [], List(&Values::List(&Values::Number, 2, 3), 4, rows::MOST)),
        ("file", "name of a file with such rows, relative to the scene's folder", false, [], Text, in_place_of "points"),
        ("depth_unit", "what 1 in the column of depths is in the scene's unit (length); default 1", false, [1.0, 10.0], Positive),
        ("modulus_unit", "what 1 in the column of moduli is in the scene's unit (stress); default 1", false, [0.001, 1.0, 1000.0], Positive),
    ],
    source: "M. Floater, K. Hormann, Numer. Math. 107 (2007) 315, eqs. 11, 18");

impl Table {
    /// The grading of rows `[depth, modulus]` or `[depth, modulus, poisson]`, in the scene's units.
    pub fn points(points: Vec<Vec<f64>>) -> Self {
        Self { source: Source::Points(points), depth_unit: one(), modulus_unit: one(), profile: None }
    }

    /// The rows understood, with curves through them.
    fn understood(&self, files: &dyn Files) -> Result<Profile, Fault> {
        let profile = Profile::new(&rows::of(&self.source, files)?, self.depth_unit.get(), self.modulus_unit.get());
        profile.map_err(|fault| self.source.fault(fault))
    }
}

#[typetag::serde(name = "table")]
impl Grading for Table {
    fn read(&mut self, files: &dyn Files) -> Result<(), Fault> {
        self.profile = Some(Arc::new(self.understood(files)?));
        Ok(())
    }

    fn law(&self, setting: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        let unusable = |why: String| Refusal::Unusable { plugin: "table", why };
        let profile = match &self.profile {
            Some(profile) => Arc::clone(profile),
            None => Arc::new(self.understood(&NoFiles).map_err(|fault| unusable(fault.to_string()))?),
        };
        let thickness = thickness::of(setting, "a grading by a table")?;
        profile.law(thickness).map_err(unusable)
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests;
