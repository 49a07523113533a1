//! The rows of a grading's table, each number checked.

use slipzone_api::rows::{self, Columns, Source, Wrong};
use slipzone_api::{Fault, Files, MODERATE, Poisson};

/// The most rows that are taken: each value of the modulus takes time in proportion.
pub(super) const MOST: usize = 5000;

/// Depths that ascend from 0, moduli, and Poisson's ratios if there are any.
#[derive(Debug, Default)]
pub(super) struct Rows {
    pub(super) depths: Vec<f64>,
    pub(super) moduli: Vec<f64>,
    pub(super) ratios: Vec<f64>,
}

/// Rows from the scene itself, or from a file.
pub(super) fn of(source: &Source<Vec<f64>>, files: &dyn Files) -> Result<Rows, Fault> {
    let mut rows = Rows::default();
    let columns =
        Columns { count: 2..=3, number: "two or three", names: "depth, modulus and, if it varies, Poisson's ratio" };
    source.rows(files, &columns, |row| rows.push(row))?;
    Ok(rows)
}

impl Rows {
    /// Appends a row that follows those before it.
    fn push(&mut self, row: &[f64]) -> Result<(), Wrong> {
        let wrong = |column, message: &str, found: String, expected: &str| {
            Err(Wrong { column, message: message.into(), found, expected: expected.into(), hint: None })
        };
        let columns = |count: usize| if count == 1 { "1 column".into() } else { format!("{count} columns") };
        let &[depth, modulus, ref rest @ ..] = row else {
            return wrong(None, "not a row of two or three columns", columns(row.len()), "depth and modulus");
        };
        if rest.len() > 1 {
            let expected = "depth, modulus and, if it varies, Poisson's ratio";
            return wrong(None, "not a row of two or three columns", columns(row.len()), expected);
        }
        if !self.depths.is_empty() && rest.is_empty() != self.ratios.is_empty() {
            let before = columns(if self.ratios.is_empty() { 2 } else { 3 });
            let expected = "Poisson's ratio in the third column of all rows, or of none";
            let found = format!("{} below rows of {before}", columns(row.len()));
            return wrong(None, "a row that differs from those before", found, expected);
        }
        if !(depth == 0.0 || MODERATE.contains(&depth)) {
            return wrong(
                Some(0),
                "a depth that is not allowed",
                format!("`{depth}`"),
                "0, or a number between 1e-100 and 1e100",
            );
        }
        if self.depths.is_empty() && depth != 0.0 {
            return wrong(Some(0), "the first row is not at the surface", format!("`{depth}`"), "depth 0");
        }
        rows::ascending("a depth", self.depths.last().copied(), depth)?;
        if !MODERATE.contains(&modulus) {
            return wrong(
                Some(1),
                "a modulus that is not allowed",
                format!("`{modulus}`"),
                "a number between 1e-100 and 1e100",
            );
        }
        if let Some(error) = rest.first().and_then(|nu| Poisson::new(*nu).err()) {
            return wrong(
                Some(2),
                "a Poisson's ratio that is not allowed",
                format!("`{}`", error.found),
                error.expected,
            );
        }
        if self.depths.len() == MOST {
            let hint = Some("thin the rows out: the curve between a few hundred is as good");
            return Err(Wrong { hint, ..rows::too_many(MOST) });
        }
        self.depths.push(depth);
        self.moduli.push(modulus);
        self.ratios.extend(rest);
        Ok(())
    }
}
