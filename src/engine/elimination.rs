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
    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let n = self.n;
        for k in (0..n).step_by(2) {
            self.pivot(k);
            if k + 1 < n {
                self.clear_column(k);
                self.pivot(k + 1);
                self.clear_below(simd, k);
            }
        }
        self.substitute(simd);
    }
}

impl Elimination<'_> {
    /// Brings the row with the largest entry of column `k` up to the diagonal.
    #[inline(always)]
    fn pivot(&mut self, k: usize) {
        let (n, mut pivot, mut largest) = (self.n, k, 0.0);
        for (i, entry) in self.rows[k * n + k..].iter().step_by(n).enumerate() {
            if entry.abs() > largest {
                (pivot, largest) = (k + i, entry.abs());
            }
        }
        if pivot > k {
            let (above, below) = self.rows.split_at_mut(pivot * n);
            above[k * n..(k + 1) * n].swap_with_slice(&mut below[..n]);
            self.columns.chunks_exact_mut(n).for_each(|column| column.swap(k, pivot));
        }
    }

    /// Puts the multiple of row `k` that each row below needs where it would make a zero, and takes it off the next
    /// entry only: all that the choice of the next pivot asks for.
    #[inline(always)]
    fn clear_column(&mut self, k: usize) {
        let (above, below) = self.rows.split_at_mut((k + 1) * self.n);
        let (minus, next) = (-1.0 / above[k * self.n + k], above[k * self.n + k + 1]);
        for row in below.chunks_exact_mut(self.n) {
            let [multiple, entry] = &mut row[k..k + 2] else { unreachable!("a slice of two") };
            *multiple *= minus;
            *entry += *multiple * next;
        }
    }

    /// Takes multiples of the rows `k` and `k + 1` off the rows below: each of their numbers is loaded once for both.
    /// What stands left of the diagonal is never read again.
    #[inline(always)]
    fn clear_below<S: Simd>(&mut self, simd: S, k: usize) {
        let n = self.n;
        let (above, below) = self.rows.split_at_mut((k + 2) * n);
        let (first, second) = above[k * n..].split_at_mut(n);
        let by = second[k];
        for (a, c) in second[k + 2..].iter_mut().zip(&first[k + 2..]) {
            *a += by * c;
        }
        self.columns.chunks_exact_mut(n).for_each(|column| column[k + 1] += by * column[k]);
        let minus = -1.0 / second[k + 1];
        // Whole vectors, as far as there is room on the left.
        let start = n.saturating_sub((n - k - 2).next_multiple_of(S::F64_LANES));
        let (a, a_rest) = S::as_simd_f64s(&first[start..]);
        let (b, b_rest) = S::as_simd_f64s(&second[start..]);
        for (rows, i) in below.chunks_mut(2 * n).zip((k + 2..).step_by(2)) {
            let (one, two) = rows.split_at_mut(n);
            let (p, q) = (one[k], minus * one[k + 1]);
            self.columns.chunks_exact_mut(n).for_each(|column| column[i] += p * column[k] + q * column[k + 1]);
            if two.is_empty() {
                for ((entry, a), b) in one[k + 2..].iter_mut().zip(&first[k + 2..]).zip(&second[k + 2..]) {
                    *entry += p * a + q * b;
                }
                return;
            }
            // Two rows at a time: each vector of the rows above is loaded once for both.
            let (r, s) = (two[k], minus * two[k + 1]);
            self.columns.chunks_exact_mut(n).for_each(|column| column[i + 1] += r * column[k] + s * column[k + 1]);
            let (one, one_rest) = S::as_mut_simd_f64s(&mut one[start..]);
            let (two, two_rest) = S::as_mut_simd_f64s(&mut two[start..]);
            let [wide_p, wide_q, wide_r, wide_s] =
                [simd.splat_f64s(p), simd.splat_f64s(q), simd.splat_f64s(r), simd.splat_f64s(s)];
            for (((one, two), a), b) in one.iter_mut().zip(two).zip(a).zip(b) {
                *one = simd.mul_add_e_f64s(wide_q, *b, simd.mul_add_e_f64s(wide_p, *a, *one));
                *two = simd.mul_add_e_f64s(wide_s, *b, simd.mul_add_e_f64s(wide_r, *a, *two));
            }
            for (((one, two), a), b) in one_rest.iter_mut().zip(two_rest).zip(a_rest).zip(b_rest) {
                *one += p * a + q * b;
                *two += r * a + s * b;
            }
        }
    }

    /// From the last unknown back to the first.
    #[inline(always)]
    fn substitute<S: Simd>(&mut self, simd: S) {
        let n = self.n;
        for column in self.columns.chunks_exact_mut(n) {
            for (i, row) in self.rows.chunks_exact(n).enumerate().rev() {
                let (head, after) = column.split_at_mut(i + 1);
                let ((row_wide, row_rest), (after, after_rest)) =
                    (S::as_simd_f64s(&row[i + 1..]), S::as_simd_f64s(after));
                let mut sum = simd.splat_f64s(0.0);
                for (a, x) in row_wide.iter().zip(after) {
                    sum = simd.mul_add_e_f64s(*a, *x, sum);
                }
                let rest: f64 = row_rest.iter().zip(after_rest).map(|(a, x)| a * x).sum();
                head[i] = (head[i] - simd.reduce_sum_f64s(sum) - rest) / row[i];
            }
        }
    }
}
