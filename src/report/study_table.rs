//! The results of a study as a table, and its failures in a line each.

use super::csv::{cell, line};
use crate::scene::Asked;
use crate::study::{ANSWER, Cell, Record, Study, at};
use serde_json::Value;
use slipzone_api::{Friction, FrozenStrain};

/// The columns of a study's CSV: `index`, what changed, `status`, the numbers by their paths in a result, the direction
/// of slip, the largest error estimate, and why a scene failed.
pub struct StudyTable {
    labels: Vec<String>,
    numbers: Vec<&'static str>,
    has_slip: bool,
    has_answer: bool,
}

impl StudyTable {
    /// The columns that a study fills.
    pub fn new(study: &Study) -> Self {
        let changes = |section: &str| study.columns().any(|column| column.field.split('.').next() == Some(section));
        let rubs = study.scene.friction.is_some() || changes("friction");
        let changes_strain = ["friction", "friction.strain"];
        let changes_strain = study.columns().any(|column| changes_strain.contains(&column.field.as_str()));
        let is_linear = matches!(study.scene.friction, Some(Friction::Goodman { strain: FrozenStrain::Linear, .. }));
        let is_filled = |number: &&str| {
            let exists = match *number {
                "stick.strain_rate" => is_linear || changes_strain,
                number => rubs || !number.starts_with("stick."),
            };
            // A field that changes has a column already.
            exists && study.asks(number) && study.columns().all(|column| column.label != **number)
        };
        Self {
            labels: study.columns().map(|column| column.label.clone()).collect(),
            numbers: Asked::NUMBERS.into_iter().filter(is_filled).collect(),
            has_slip: rubs && study.asks("stick.slip"),
            has_answer: study.find.is_some(),
        }
    }

    /// The first line.
    pub fn head(&self) -> String {
        let labels = self.labels.iter().map(String::as_str);
        let slip = self.has_slip.then_some("stick.slip");
        let after = slip.into_iter().chain(ANSWER.into_iter().filter(|_| self.has_answer));
        let names = ["index"].into_iter().chain(labels).chain(["status"]).chain(self.numbers.iter().copied());
        line(names.chain(after).chain(["error", "reason"]).map(str::to_owned))
    }

    /// Whether a record, as the results have it in JSON, has what the columns are filled with.
    pub fn is_filled_by(&self, record: &Value) -> bool {
        let is_number = |path: &&str| match path.split_once('.').and_then(|(report, _)| record.get(report)) {
            // Without friction, or where no stick zone was looked for.
            Some(Value::Null) => path.starts_with("stick."),
            _ => at(record, path).is_some_and(|value| value.is_number() || value.is_null()),
        };
        let is_value = |label| record["axes"].get(label).is_some_and(|value| value.is_number() || value.is_string());
        self.labels.iter().all(is_value) && self.numbers.iter().all(is_number) && is_number(&"error.estimate")
    }

    /// A record, as the results have it in JSON, as a line that belongs to [`Self::head`].
    pub fn row(&self, record: &Value) -> String {
        let number = |path: &str| cell(at(record, path).and_then(Value::as_f64));
        let text = |path: &str| at(record, path).and_then(Value::as_str).unwrap_or_default().to_owned();
        let mut cells = vec![record["index"].to_string()];
        cells.extend(self.labels.iter().map(|label| match &record["axes"][label] {
            Value::String(text) => text.clone(),
            other => cell(other.as_f64()),
        }));
        cells.push(text("status"));
        cells.extend(self.numbers.iter().map(|path| number(path)));
        if self.has_slip {
            cells.push(text("stick.slip"));
        }
        if self.has_answer {
            cells.extend(ANSWER.map(|path| match at(record, path) {
                Some(Value::Bool(is)) => is.to_string(),
                _ => number(path),
            }));
        }
        cells.push(number("error.estimate"));
        cells.push(text("reason"));
        line(cells)
    }
}

/// A scene that failed, in one line.
pub fn record_line(record: &Record) -> String {
    let values: Vec<String> = record
        .axes
        .iter()
        .map(|(label, value)| match value {
            Cell::Number(number) => format!("{label} = {number:?}"),
            Cell::Text(text) => format!("{label} = {text}"),
        })
        .collect();
    let status = serde_json::to_value(record.status).ok();
    let status = status.as_ref().and_then(Value::as_str).unwrap_or_default();
    let reason = record.reason.as_deref().unwrap_or("no reason is known");
    let values = if values.is_empty() { String::new() } else { format!(" ({})", values.join(", ")) };
    format!("scene {}{values}: {status}: {}", record.index, reason.replace('\n', " "))
}
