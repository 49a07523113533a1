//! Gaussian elimination for few equations, where the plainest way is the shortest: half of the instructions of a
//! blocked factorisation at 33 equations, and none of its memory (4 MB of packing buffers a thread).

use pulp::{Arch, Simd, WithSimd};

/// Solves `n` equations for each of the right-hand sides in `columns`; the matrix comes row by row and is used up.
/// A singular one gives infinities or NaN.
pub(super) fn solve(rows: &mut [f64], columns: &mut [f64], n: usize) {
    Arch::new().dispatch(Elimination { rows, columns, n });
}

struct Elimination<'a> {
    rows: &'a mut [f64],
    columns: &'a mut [f64],
    n: usize,
}

impl WithSimd for Elimination<'_> {
    type Output = ();

    // What is inlined here is compiled for the vectors that the machine has.
    #[allow(clippy::inline_always)]
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        for k in 0..self.n {
            self.pivot(k);
            self.clear_below(simd, k);
        }
        self.substitute();
    }
}

#[allow(clippy::inline_always)]
impl Elimination<'_> {
    /// Brings the row with the largest entry of column `k` up to the diagonal.
    #[inline(always)]
    fn pivot(&mut self, k: usize) {
        let (n, mut pivot, mut largest) = (self.n, k, 0.0);
        for (i, row) in self.rows.chunks_exact(n).enumerate().skip(k) {
            if row[k].abs() > largest {
                (pivot, largest) = (i, row[k].abs());
            }
        }
        if pivot > k {
            let (above, below) = self.rows.split_at_mut(pivot * n);
            above[k * n..(k + 1) * n].swap_with_slice(&mut below[..n]);
            self.columns.chunks_exact_mut(n).for_each(|column| column.swap(k, pivot));
        }
    }

    /// Takes multiples of row `k` off the rows below, so that column `k` would vanish there. What stands left of
    /// the diagonal is never read again.
    #[inline(always)]
    fn clear_below<S: Simd>(&mut self, simd: S, k: usize) {
        let n = self.n;
        let (above, below) = self.rows.split_at_mut((k + 1) * n);
        let row = &above[k * n..];
        let minus = -1.0 / row[k];
        // Whole vectors, as far as there is room on the left.
        let start = n.saturating_sub((n - k - 1).next_multiple_of(S::F64_LANES));
        let (vectors, rest) = S::as_simd_f64s(&row[start..]);
        for (pair, i) in below.chunks_mut(2 * n).zip((k + 1..).step_by(2)) {
            let (one, two) = pair.split_at_mut(n);
            let by = minus * one[k];
            self.columns.chunks_exact_mut(n).for_each(|column| column[i] += by * column[k]);
            if two.is_empty() {
                for (a, c) in one[k + 1..].iter_mut().zip(&row[k + 1..]) {
                    *a += by * c;
                }
                return;
            }
            // Two rows at a time: each vector of row `k` is loaded once for both.
            let by_two = minus * two[k];
            self.columns.chunks_exact_mut(n).for_each(|column| column[i + 1] += by_two * column[k]);
            let (one, one_rest) = S::as_mut_simd_f64s(&mut one[start..]);
            let (two, two_rest) = S::as_mut_simd_f64s(&mut two[start..]);
            let (by_all, by_two_all) = (simd.splat_f64s(by), simd.splat_f64s(by_two));
            for ((a, b), c) in one.iter_mut().zip(two).zip(vectors) {
                *a = simd.mul_add_e_f64s(by_all, *c, *a);
                *b = simd.mul_add_e_f64s(by_two_all, *c, *b);
            }
            for ((a, b), c) in one_rest.iter_mut().zip(two_rest).zip(rest) {
                *a += by * c;
                *b += by_two * c;
            }
        }
    }

    /// From the last unknown back to the first.
    #[inline(always)]
    fn substitute(&mut self) {
        let n = self.n;
        for column in self.columns.chunks_exact_mut(n) {
            for (i, row) in self.rows.chunks_exact(n).enumerate().rev() {
                let known: f64 = row[i + 1..].iter().zip(&column[i + 1..]).map(|(a, x)| a * x).sum();
                column[i] = (column[i] - known) / row[i];
            }
        }
    }
}
