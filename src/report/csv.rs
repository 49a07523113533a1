//! The profile as a table.

use crate::engine::Solution;
use crate::engine::insist;
use std::fmt::Write;

/// The profile as comma-separated values under the heading `x,pressure,shear`.
///
/// One line per sample, in the scene's units. A value that is unbounded there is empty, and so is the shear
/// without friction. Numbers read back exactly.
///
/// # Panics
/// If a number of the solution is not finite; see [`first_not_finite`](crate::engine::first_not_finite).
pub fn csv(solution: &Solution) -> String {
    insist(solution);
    let profile = &solution.profile;
    let mut table = String::from("x,pressure,shear\n");
    for (i, x) in profile.x.iter().enumerate() {
        let pressure = profile.pressure.get(i).copied().flatten();
        let shear = profile.shear.as_ref().and_then(|q| q.get(i).copied().flatten());
        writeln!(table, "{x:?},{},{}", cell(pressure), cell(shear)).expect("a String takes any text");
    }
    table
}

/// The shortest decimal that reads back as the same number (`{:?}` turns to powers of ten where `{}` would
/// write hundreds of zeros).
pub(super) fn cell(value: Option<f64>) -> String {
    value.map_or_else(String::new, |v| format!("{v:?}"))
}

/// A line of comma-separated values, in quotes where need be.
pub(super) fn line(cells: impl IntoIterator<Item = String>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(cells).expect("memory takes any text");
    let bytes = writer.into_inner().expect("memory takes any text");
    String::from_utf8(bytes).expect("text in, text out")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::samples;

    /// Cells of a row as numbers.
    fn read(row: &str) -> Vec<Option<f64>> {
        row.split(',').map(|c| if c.is_empty() { None } else { Some(c.parse().unwrap()) }).collect()
    }

    #[test]
    fn numbers_read_back_exactly() {
        let mut solution = samples::flat_with_friction();
        solution.profile.x[1] = -1.0 / 3.0;
        solution.profile.pressure[1] = Some(f64::MIN_POSITIVE);
        solution.profile.pressure[2] = Some(f64::MAX);
        let (table, profile) = (csv(&solution), &solution.profile);
        let mut rows = table.lines();
        assert_eq!(rows.next(), Some("x,pressure,shear"));
        for (i, row) in rows.enumerate() {
            assert_eq!(read(row), [Some(profile.x[i]), profile.pressure[i], profile.shear.as_ref().unwrap()[i]]);
        }
        assert_eq!(table.lines().count(), 1 + profile.x.len());
    }

    #[test]
    fn unbounded_and_frictionless_are_empty() {
        let table = csv(&samples::cylinder_without_friction());
        assert!(table.lines().skip(1).all(|row| row.ends_with(',')), "no shear without friction");
        let table = csv(&samples::flat_with_friction());
        assert_eq!(table.lines().nth(1), Some("-1.0,,"), "everything is unbounded at a sharp edge");
    }

    #[test]
    fn a_refused_scene_has_no_rows() {
        assert_eq!(csv(&samples::refused()), "x,pressure,shear\n");
    }
}
