//! A punch given by measured or computed heights.

mod fit;
mod folded;
mod profile;
mod rows;
mod scatter;
mod spline;
mod strays;
#[cfg(test)]
mod tests;

use profile::Profile;
use serde::{Deserialize, Serialize};
use slipzone_api::rows::Source;
use slipzone_api::{Fault, Files, Positive, PunchProfile, PunchShape, Refusal, Values};

/// Heights at points `x`, smoothed by the convex spline that comes closest to them.
///
/// `g(x)` is a cubic spline in `|x|` with `g''` continuous and never negative, so that the slope is continuous and
/// never falls; fitted by least squares. Of 1, 2, 4, 8, 16 and 32 pieces, each with as many points as the others, it
/// has the number with the smallest `N ln(S/N) + p ln N` (G. Schwarz, Ann. Stat. 6 (1978) 461), `S` the sum of squares
/// left over from `N` points and `p` the number of coefficients; and a corner in the middle where that gains ten times
/// as much as a coefficient has to. Rows far off all others have no part in it. Time: linear in `N`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
pub struct Table {
    source: Source<[f64; 2]>,
    x_unit: Positive,
    height_unit: Positive,
    /// What was made of the points, once they are there.
    profile: Option<Profile>,
}

/// The keys of the table in a scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Written {
    #[serde(skip_serializing_if = "Option::is_none")]
    file: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<Vec<Row>>,
    #[serde(default = "one")]
    x_unit: Positive,
    #[serde(default = "one")]
    height_unit: Positive,
}

/// Two numbers and no more: a plain array would let a third one pass unread.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(try_from = "Vec<f64>", into = "[f64; 2]")]
struct Row([f64; 2]);

impl TryFrom<Vec<f64>> for Row {
    type Error = String;

    fn try_from(row: Vec<f64>) -> Result<Self, String> {
        let count = row.len();
        row.try_into().map(Row).map_err(|_| format!("expected a row of two numbers, x and height, found {count}"))
    }
}

impl From<Row> for [f64; 2] {
    fn from(Row(row): Row) -> Self {
        row
    }
}

fn one() -> Positive {
    Positive::new(1.0).expect("a positive constant")
}

impl TryFrom<Written> for Table {
    type Error = String;

    fn try_from(Written { file, points, x_unit, height_unit }: Written) -> Result<Self, String> {
        let points = points.map(|points| points.into_iter().map(Into::into).collect());
        let source = Source::of_keys(file, points, "x and height")?;
        Ok(Self { source, x_unit, height_unit, profile: None })
    }
}

impl From<Table> for Written {
    fn from(table: Table) -> Self {
        let (file, points) = table.source.into_keys();
        let points = points.map(|points| points.into_iter().map(Row).collect());
        Self { file, points, x_unit: table.x_unit, height_unit: table.height_unit }
    }
}

slipzone_api::register!(Punch, "table", "measured or computed heights, smoothed by the nearest convex spline",
    also: ["points", "profile", "measured", "file", "csv", "data", "spline"],
    example: "type = \"table\"\npoints = [[0.0, 0.0], [1.0, 0.05], [2.0, 0.2], [3.0, 0.45], [4.0, 0.8]]",
    parameters: [
        ("points", "[[x, height], ...], x ascending, at least 4 rows (x_unit, height_unit); `file`, the name of a file with such rows, may stand in its place", true, [], List(&Values::List(&Values::Number, 2, 2), 4, rows::MOST)),
        ("file", "name of a file with such rows, relative to the scene's folder", false, [], Text, in_place_of "points"),
        ("x_unit", "what 1 in the column of x is in the scene's unit (length); default 1", false, [0.001, 1.0, 1000.0], Positive),
        ("height_unit", "what 1 in the column of heights is in the scene's unit (length); default 1", false, [0.001, 1.0, 1000.0], Positive),
    ],
    source: "docs/plugins.md");

impl Table {
    /// The punch of points `[x, height]`, both in the scene's unit of length.
    pub fn points(points: Vec<[f64; 2]>) -> Self {
        Self { source: Source::Points(points), x_unit: one(), height_unit: one(), profile: None }
    }

    /// The points understood and fitted.
    fn understood(&self, files: &dyn Files) -> Result<Profile, Fault> {
        let profile = Profile::fit(&rows::of(&self.source, files)?, [self.x_unit.get(), self.height_unit.get()]);
        profile.map_err(|fault| self.source.fault(fault))
    }
}

#[typetag::serde(name = "table")]
impl PunchProfile for Table {
    fn read(&mut self, files: &dyn Files) -> Result<(), Fault> {
        self.profile = Some(self.understood(files)?);
        Ok(())
    }

    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
        if let Some(profile) = &self.profile {
            return Ok(Box::new(profile.clone()));
        }
        let profile = self.understood(&slipzone_api::NoFiles);
        let profile = profile.map_err(|fault| Refusal::Unusable { plugin: "table", why: fault.to_string() })?;
        Ok(Box::new(profile))
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}
