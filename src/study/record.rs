//! One line of a sweep's results.

use super::shown::FOUND;
use super::{Cell, Study};
use crate::engine::{EdgeReport, ErrorReport, LoadReport, PressureReport, Profile, Solution, Status, StickReport};
use crate::scene::SceneError;
use serde::ser::SerializeMap;
use serde::{Deserialize, Serialize, Serializer};
use serde_json::Value;

/// A scene of a study, solved: what changed in it, and the numbers of its result under the keys of a result.
#[derive(Clone, Debug, Serialize)]
pub struct Record {
    /// Number of the scene, from 0.
    pub index: u64,
    /// What changed: labels of the axes and their values.
    #[serde(serialize_with = "as_map")]
    pub axes: Vec<(String, Cell)>,
    /// How the solve ended.
    pub status: RecordStatus,
    /// Why it did not converge.
    pub reason: Option<String>,
    /// Force, contact size, indentation.
    pub load: LoadReport,
    /// Pressure at a few points.
    pub pressure: PressureReport,
    /// Stress intensity at the contact's edge.
    pub edge: EdgeReport,
    /// The stick zone; `None` without friction.
    pub stick: Option<StickReport>,
    /// How sure the numbers are.
    pub error: ErrorReport,
    /// Tractions, where the study asks for them.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub profile: Option<Profile>,
    /// The answer to the study's question.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub found: Option<Found>,
}

/// The answer to a study's question; the numbers of its record are those of the scene with this value.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Found {
    /// Path of the field that was looked for.
    pub field: String,
    /// Its value.
    pub value: f64,
    /// Error of the value, relative, by the error of the number that decides.
    pub error: f64,
    /// Other values that answer the question as well.
    pub others: Vec<f64>,
    /// Whether the least or largest value lies at an end of the range: further out there may be a better one.
    pub is_at_end: bool,
}

/// Columns of the answer: the value, its error, and whether a least or largest one lies at an end of the range.
pub(crate) const ANSWER: [&str; 3] = [FOUND, "found.error", "found.is_at_end"];

/// How a scene of a study ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RecordStatus {
    /// Its values make no scene together.
    Invalid,
    /// It was solved.
    #[serde(untagged)]
    Solved(Status),
}

fn as_map<S: Serializer>(axes: &[(String, Cell)], serializer: S) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(Some(axes.len()))?;
    axes.iter().try_for_each(|(label, cell)| map.serialize_entry(label, cell))?;
    map.end()
}

impl Record {
    /// A scene that was solved.
    pub(super) fn solved(study: &Study, row: u64, solution: Solution) -> Self {
        let Solution { scene, status, reason, load, pressure, edge, stick, error, profile, .. } = solution;
        let status = RecordStatus::Solved(status);
        let profile = scene.output.asks("profile").then_some(profile);
        Self { reason, load, pressure, edge, stick, error, profile, ..Self::without_numbers(study, row, status, None) }
    }

    /// Values that make no scene.
    pub(super) fn invalid(study: &Study, row: u64, error: &SceneError) -> Self {
        Self::without_numbers(study, row, RecordStatus::Invalid, Some(error.in_one_line()))
    }

    /// A scene at which the program, or a plugin, panicked.
    pub(super) fn panicked(study: &Study, row: u64, why: String) -> Self {
        Self::without_numbers(study, row, RecordStatus::Solved(Status::Refused), Some(why))
    }

    fn without_numbers(study: &Study, row: u64, status: RecordStatus, reason: Option<String>) -> Self {
        Self {
            index: row,
            axes: axes(study, row),
            status,
            reason,
            load: LoadReport::default(),
            pressure: PressureReport::default(),
            edge: EdgeReport::default(),
            stick: None,
            error: ErrorReport::default(),
            profile: None,
            found: None,
        }
    }

    /// Whether it converged.
    pub fn is_converged(&self) -> bool {
        self.status == RecordStatus::Solved(Status::Converged)
    }

    /// A number of the result by its path, such as `stick.ratio`.
    pub fn number(&self, path: &str) -> Option<f64> {
        at(&serde_json::to_value(self).ok()?, path)?.as_f64()
    }
}

/// What stands at a path of a record.
pub(crate) fn at<'a>(record: &'a Value, path: &str) -> Option<&'a Value> {
    path.split('.').try_fold(record, |value, key| value.get(key))
}

fn axes(study: &Study, row: u64) -> Vec<(String, Cell)> {
    study.columns().map(|column| column.label.clone()).zip(study.cells(row)).collect()
}
