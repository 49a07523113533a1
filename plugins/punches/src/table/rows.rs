//! The rows of a punch's table, each number checked.

use slipzone_api::rows::{self, Columns, Source, Wrong};
use slipzone_api::{Fault, Files, MODERATE};

/// The most rows that are taken.
pub(super) const MOST: usize = 1_000_000;

/// Points with ascending `x`.
pub(super) type Rows = Vec<[f64; 2]>;

/// Rows from the scene itself, or from a file.
pub(super) fn of(source: &Source<[f64; 2]>, files: &dyn Files) -> Result<Rows, Fault> {
    let mut rows = Vec::new();
    let columns = Columns { count: 2..=2, number: "two", names: "x and height" };
    source.rows(files, &columns, |row| push(&mut rows, row))?;
    Ok(rows)
}

/// Appends a row that follows those before it.
fn push(rows: &mut Rows, row: &[f64]) -> Result<(), Wrong> {
    let row = [row[0], row[1]];
    for (column, value) in row.iter().enumerate() {
        if !(*value == 0.0 || MODERATE.contains(&value.abs())) {
            let message = if column == 0 { "an x that is not allowed" } else { "a height that is not allowed" };
            let expected = "0, or a number between 1e-100 and 1e100, or its negative".into();
            let (message, found) = (message.into(), format!("`{value}`"));
            return Err(Wrong { column: Some(column), message, found, expected, hint: None });
        }
    }
    let before = rows.last().map(|[before, _]| *before);
    rows::ascending("an x", before, row[0])?;
    if rows.len() == MOST {
        return Err(rows::too_many(MOST));
    }
    rows.push(row);
    Ok(())
}
