//! The loading curve as a table.

use super::csv::cell;
use crate::engine::Solution;
use crate::engine::insist;
use std::fmt::Write;

/// The loading curve as comma-separated values under the heading
/// `force,half_width,indentation,stick_half_width,stick_ratio`.
///
/// One line per load, the smallest first, in the scene's units. A number that does not exist is empty. The heading
/// alone where the solution has no curve. Numbers read back exactly.
///
/// # Panics
/// If a number of the solution is not finite; see [`first_not_finite`](crate::engine::first_not_finite).
pub fn curve_csv(solution: &Solution) -> String {
    insist(solution);
    let mut table = String::from("force,half_width,indentation,stick_half_width,stick_ratio\n");
    let Some(curve) = &solution.path else { return table };
    for i in 0..curve.points() {
        let known = |column: &[Option<f64>]| cell(column.get(i).copied().flatten());
        let maybe = |column: &Option<Vec<Option<f64>>>| known(column.as_deref().unwrap_or_default());
        let row = [
            known(&curve.force),
            known(&curve.half_width),
            maybe(&curve.indentation),
            maybe(&curve.stick_half_width),
            maybe(&curve.stick_ratio),
        ];
        writeln!(table, "{}", row.join(",")).expect("a String takes any text");
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::samples;

    #[test]
    fn numbers_read_back_exactly_and_what_is_missing_is_empty() {
        let mut solution = samples::loading_curve();
        let curve = solution.path.as_mut().expect("a curve");
        (curve.half_width[0], curve.force[1]) = (Some(1.0 / 3.0), None);
        let table = curve_csv(&solution);
        let rows: Vec<Vec<&str>> = table.lines().map(|row| row.split(',').collect()).collect();
        assert_eq!(rows[0], ["force", "half_width", "indentation", "stick_half_width", "stick_ratio"]);
        assert_eq!(rows[1][1].parse::<f64>(), Ok(1.0 / 3.0));
        assert_eq!(rows[2][0], "");
        assert_eq!(rows.len(), 1 + solution.path.as_ref().expect("a curve").points());
        let curve = solution.path.as_mut().expect("a curve");
        (curve.indentation, curve.stick_half_width, curve.stick_ratio) = (None, None, None);
        assert!(curve_csv(&solution).lines().skip(1).all(|row| row.ends_with(",,,")), "no base and no friction");
    }

    #[test]
    fn without_a_curve_there_are_no_rows() {
        assert_eq!(curve_csv(&samples::refused()).lines().count(), 1);
    }
}
