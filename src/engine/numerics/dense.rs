//! Dense linear systems, solved in room that is kept.

use super::elimination;
use crate::engine::work::Work;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::PermRef;
use faer::{MatMut, Par};
use slipzone_api::{Refusal, lend};
use std::cell::Cell;

/// So many equations at most are eliminated one by one: for few factorising in blocks takes more instructions, and its
/// products of matrices keep twice the processor's largest cache for themselves, per thread.
const FEW: usize = elimination::MOST;

thread_local! {
    /// Room of this thread for the matrix of a few equations: to clear one for each system would cost more than to fill
    /// it.
    static ROOM: Cell<Vec<f64>> = const { Cell::new(Vec::new()) };
}

/// A square system of fixed size and a few right-hand sides. Solving it again allocates nothing.
pub(crate) struct Dense {
    /// Right-hand sides one after another before, solutions after [`Self::solve`].
    columns: Vec<f64>,
    /// Number of equations.
    size: usize,
    /// Room for more than a few equations.
    blocks: Option<Blocks>,
    /// What all of it took so far.
    pub(crate) work: Work,
}

impl Dense {
    /// Room for `n` equations and `right` right-hand sides.
    pub(crate) fn new(n: usize, right: usize) -> Self {
        Self {
            columns: vec![0.0; n * right],
            size: n,
            blocks: (n > FEW).then(|| Blocks::new(n, right)),
            work: Work::default(),
        }
    }

    /// Right-hand side or solution `k`.
    pub(crate) fn column(&self, k: usize) -> &[f64] {
        let n = self.size;
        &self.columns[k * n..(k + 1) * n]
    }

    /// Solution of the first of two right-hand sides, and the room of the other.
    pub(crate) fn single(&mut self) -> (&[f64], &mut [f64]) {
        let (solution, room) = self.columns.split_at_mut(self.size);
        (solution, room)
    }

    /// Takes a solution that is known for the only one.
    pub(crate) fn take(&mut self, solution: impl Iterator<Item = f64>) {
        self.columns.fill(0.0);
        self.columns.iter_mut().zip(solution).for_each(|(to, unknown)| *to = unknown);
    }

    /// Fills in the matrix, row by row, and the right-hand sides, one after another; both hold what earlier systems
    /// left. Replaces as many of the right-hand sides as `fill` returns by their solutions.
    pub(crate) fn solve(&mut self, mut fill: impl FnMut(&mut [f64], &mut [f64]) -> usize) -> Result<(), Refusal> {
        let n = self.size;
        let right = if let Some(blocks) = &mut self.blocks {
            let right = fill(&mut blocks.rows, &mut self.columns);
            blocks.solve(&mut self.columns[..n * right]);
            right
        } else {
            lend(&ROOM, |room| {
                if room.len() < n * n {
                    room.resize(FEW * FEW, 0.0);
                }
                let rows = &mut room[..n * n];
                let right = fill(rows, &mut self.columns);
                elimination::solve(rows, &mut self.columns[..n * right], n);
                right
            })
        };
        self.work.count(n, right);
        let columns = &self.columns[..n * right];
        // A singular matrix gives infinities or NaN and no error.
        if columns.iter().all(|v| v.is_finite()) {
            return Ok(());
        }
        // So does one that is made of them: it is gone, and filled in again to be seen.
        let mut rows = vec![0.0; n * n];
        self.columns.fill(0.0);
        let right = fill(&mut rows, &mut self.columns);
        if !rows.iter().chain(&self.columns[..n * right]).all(|v| v.is_finite()) {
            return Err(Refusal::Limit {
                why: format!("the system of {n} equations holds what is no finite number"),
                remedy: "look for it in what the plugins of the punch, the kernel and the quadrature give",
            });
        }
        Err(Refusal::Limit {
            why: format!("the system of {n} equations is singular to working precision"),
            remedy: "take fewer nodes, or report the scene",
        })
    }
}

/// Factorisation in blocks.
struct Blocks {
    rows: Vec<f64>,
    forward: Vec<usize>,
    inverse: Vec<usize>,
    scratch: MemBuffer,
}

impl Blocks {
    fn new(n: usize, right: usize) -> Self {
        let factor = factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, faer::Spec::default());
        let solve = solve::solve_transpose_in_place_scratch::<usize, f64>(n, right, Par::Seq);
        Self {
            rows: vec![0.0; n * n],
            forward: vec![0; n],
            inverse: vec![0; n],
            scratch: MemBuffer::new(factor.or(solve)),
        }
    }

    /// As [`elimination::solve`].
    fn solve(&mut self, columns: &mut [f64]) {
        let n = self.forward.len();
        // Rows one after another are the columns of the transpose, which is factorised where it stands.
        let mut transpose = MatMut::from_column_major_slice_mut(&mut self.rows, n, n);
        let stack = MemStack::new(&mut self.scratch);
        let (forward, inverse) = (&mut self.forward, &mut self.inverse);
        factor::lu_in_place(transpose.as_mut(), forward, inverse, Par::Seq, stack, faer::Spec::default());
        let order = PermRef::new_checked(forward, inverse, n);
        let right = columns.len() / n;
        let x = MatMut::from_column_major_slice_mut(columns, n, right);
        solve::solve_transpose_in_place(transpose.as_ref(), transpose.as_ref(), order, x, Par::Seq, stack);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_again_and_again_and_notices_singularity() {
        let mut system = Dense::new(2, 2);
        for scale in [1.0, -3.0] {
            let filled = system.solve(|rows, columns| {
                rows.copy_from_slice(&[2.0 * scale, scale, 0.0, 4.0 * scale]);
                columns.copy_from_slice(&[4.0 * scale, 8.0 * scale, 2.0 * scale, 0.0]);
                2
            });
            filled.unwrap();
            assert_eq!((system.column(0), system.column(1)), (&[1.0, 2.0][..], &[1.0, 0.0][..]));
        }
        let singular = system.solve(|rows, _| {
            rows.fill(0.0);
            1
        });
        assert!(singular.unwrap_err().to_string().contains("singular to working precision"));
        assert_eq!(system.work, Work { factorisations: 3, operations: 3 * 2 + 2 * 8 + 4 });
    }

    #[test]
    fn what_holds_no_number_is_not_called_singular() {
        for n in [2, FEW + 1] {
            let solved = Dense::new(n, 1).solve(|rows, right| {
                rows.fill(0.0);
                rows.iter_mut().step_by(n + 1).for_each(|one| *one = 1.0);
                right.fill(1.0);
                rows[1] = f64::NAN;
                1
            });
            assert!(solved.unwrap_err().to_string().contains("holds what is no finite number"), "{n}");
        }
    }

    /// Sizes around the vectors' lengths and around [`FEW`]; entries without order, so that rows change places.
    #[test]
    fn every_size_is_solved() {
        for n in (1..=20).chain([FEW - 1, FEW, FEW + 1, 100]) {
            let mut system = Dense::new(n, 2);
            let entry = |i: usize, j: usize| (((i * 37 + j * 101 + i * i * j) % 211) as f64 / 105.5 - 1.0).powi(3);
            let unknown = |j: usize, k: usize| 1.0 + (j + 3 * k) as f64;
            let solved = system.solve(|rows, columns| {
                columns.fill(0.0);
                for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
                    rows[i * n + j] = entry(i, j);
                    for k in 0..2 {
                        columns[k * n + i] += entry(i, j) * unknown(j, k);
                    }
                }
                2
            });
            solved.unwrap();
            for (k, j) in (0..2).flat_map(|k| (0..n).map(move |j| (k, j))) {
                let (got, expected) = (system.column(k)[j], unknown(j, k));
                // The matrices are conditioned like 1e4 at worst, and unknowns reach 100.
                assert!((got - expected).abs() < 1e-9, "unknown {j} of {n}: {got} for {expected}");
            }
        }
    }
}
