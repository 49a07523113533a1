//! Dense linear systems.

use faer::linalg::solvers::{PartialPivLu, Solve};
use faer::{Mat, MatRef};

/// Solves `rows x = right` for each right-hand side; `rows` is square, row-major.
///
/// `None` when the matrix is singular to working precision: the factorisation gives infinities or NaN
/// then, and no error.
pub(crate) fn solve(rows: &[f64], right: &[&[f64]]) -> Option<Vec<Vec<f64>>> {
    let n = right.first()?.len();
    assert_eq!(rows.len(), n * n, "a square matrix of the right-hand side's size");
    let mut x = Mat::from_fn(n, right.len(), |i, k| right[k][i]);
    PartialPivLu::new(MatRef::from_row_major_slice(rows, n, n)).solve_in_place(&mut x);
    let columns: Vec<Vec<f64>> = (0..right.len()).map(|k| (0..n).map(|i| x[(i, k)]).collect()).collect();
    columns.iter().flatten().all(|v| v.is_finite()).then_some(columns)
}

#[cfg(test)]
mod tests {
    use super::solve;

    #[test]
    fn solves_and_notices_singularity() {
        let x = solve(&[2.0, 1.0, 0.0, 4.0], &[&[4.0, 8.0], &[2.0, 0.0]]).unwrap();
        assert_eq!(x, [[1.0, 2.0], [1.0, 0.0]]);
        assert!(solve(&[0.0, 0.0, 0.0, 0.0], &[&[1.0, 1.0]]).is_none());
    }
}
