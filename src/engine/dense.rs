//! Dense linear systems, factorised in scratch that is kept.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::PermRef;
use faer::{Mat, MatMut, Par};
use slipzone_api::Refusal;

/// A square system of fixed size and a few right-hand sides. Solving it allocates nothing.
pub(crate) struct Dense {
    /// The matrix, row by row, to be filled before [`Self::solve`].
    pub(crate) rows: Vec<f64>,
    /// Right-hand sides one after another before, solutions after [`Self::solve`].
    pub(crate) columns: Vec<f64>,
    matrix: Mat<f64>,
    forward: Vec<usize>,
    inverse: Vec<usize>,
    scratch: MemBuffer,
    /// Matrices factorised so far.
    pub(crate) factorisations: usize,
}

impl Dense {
    /// Room for `n` equations and `right` right-hand sides.
    pub(crate) fn new(n: usize, right: usize) -> Self {
        let factor = factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, faer::Spec::default());
        let solve = solve::solve_in_place_scratch::<usize, f64>(n, right, Par::Seq);
        Self {
            rows: vec![0.0; n * n],
            columns: vec![0.0; n * right],
            matrix: Mat::zeros(n, n),
            forward: vec![0; n],
            inverse: vec![0; n],
            scratch: MemBuffer::new(factor.or(solve)),
            factorisations: 0,
        }
    }

    /// Number of equations.
    pub(crate) fn size(&self) -> usize {
        self.forward.len()
    }

    /// Right-hand side or solution `k`.
    pub(crate) fn column(&self, k: usize) -> &[f64] {
        let n = self.size();
        &self.columns[k * n..(k + 1) * n]
    }

    /// Replaces the first `right` right-hand sides by their solutions.
    pub(crate) fn solve(&mut self, right: usize) -> Result<(), Refusal> {
        let n = self.size();
        self.factorisations += 1;
        for j in 0..n {
            for (i, entry) in self.matrix.col_as_slice_mut(j).iter_mut().enumerate() {
                *entry = self.rows[i * n + j];
            }
        }
        let stack = MemStack::new(&mut self.scratch);
        let (forward, inverse) = (&mut self.forward, &mut self.inverse);
        factor::lu_in_place(self.matrix.as_mut(), forward, inverse, Par::Seq, stack, faer::Spec::default());
        let columns = &mut self.columns[..n * right];
        let order = PermRef::new_checked(forward, inverse, n);
        let x = MatMut::from_column_major_slice_mut(columns, n, right);
        solve::solve_in_place(self.matrix.as_ref(), self.matrix.as_ref(), order, x, Par::Seq, stack);
        // A singular matrix gives infinities or NaN and no error.
        if columns.iter().all(|v| v.is_finite()) {
            return Ok(());
        }
        Err(Refusal::OutOfReach {
            method: "engine",
            why: format!("the system of {n} equations is singular to working precision"),
            remedy: "take fewer nodes, or report the scene",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_again_and_again_and_notices_singularity() {
        let mut system = Dense::new(2, 2);
        for scale in [1.0, -3.0] {
            system.rows.copy_from_slice(&[2.0 * scale, scale, 0.0, 4.0 * scale]);
            system.columns.copy_from_slice(&[4.0 * scale, 8.0 * scale, 2.0 * scale, 0.0]);
            system.solve(2).unwrap();
            assert_eq!((system.column(0), system.column(1)), (&[1.0, 2.0][..], &[1.0, 0.0][..]));
        }
        system.rows.fill(0.0);
        assert!(system.solve(1).is_err());
        assert_eq!(system.factorisations, 3);
    }
}
