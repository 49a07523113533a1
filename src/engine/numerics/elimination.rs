//! Gaussian elimination for few equations, where the plainest way is the shortest: a third of the instructions of a
//! blocked factorisation at 33 equations, and none of its memory (4 MB of packing buffers a thread).

use pulp::{Arch, Simd, WithSimd};

/// Most equations.
pub(crate) const MOST: usize = 96;
/// Rows that are cleared together: each vector of the pivots' rows is loaded once for all of them.
const TOGETHER: usize = 4;
/// An entry on the diagonal stays the pivot unless another of its row is more than `1/NEARLY` times as large: to
/// exchange unknowns costs a walk down all rows, and every other pivot of a stick zone's system would.
const NEARLY: f64 = 0.25;

/// Solves `n` equations for each of the right-hand sides in `columns`; the matrix comes row by row and is used up.
/// A singular one gives infinities or NaN.
///
/// The pivot is the largest entry of a row, or nearly: unknowns change places and equations do not, so that all there
/// is to do runs along rows.
pub(crate) fn solve(rows: &mut [f64], columns: &mut [f64], n: usize) {
    assert!(n <= MOST, "room for {MOST} equations, and here are {n}");
    Arch::new().dispatch(Elimination { rows, columns, n });
}

/// 0, 1, 2 and so on.
#[allow(clippy::cast_possible_truncation)] // below `MOST`
const fn in_order() -> [u8; MOST] {
    let (mut order, mut k) = ([0; MOST], 0);
    while k < MOST {
        order[k] = k as u8;
        k += 1;
    }
    order
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
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { rows, columns, n } = self;
        // Which unknown stands where.
        let mut order: [u8; MOST] = const { in_order() };
        let mut multiples = [[0.0; MOST]; 2];
        for k in (0..n).step_by(2) {
            bring_pivot(simd, rows, n, k, &mut order);
            let (above, below) = rows.split_at_mut((k + 1) * n);
            let first = from::<S>(&mut above[k * n..], k);
            let inverse = 1.0 / first[first.len() - (n - k)];
            scale(simd, first, inverse);
            columns.chunks_exact_mut(n).for_each(|column| column[k] *= inverse);
            if k + 1 == n {
                break;
            }
            let second = &mut below[..n];
            let multiple = -second[k];
            add(simd, from::<S>(second, k), first, multiple);
            columns.chunks_exact_mut(n).for_each(|column| column[k + 1] += multiple * column[k]);

            bring_pivot(simd, rows, n, k + 1, &mut order);
            let (above, below) = rows.split_at_mut((k + 2) * n);
            let (first, second) = above[k * n..].split_at_mut(n);
            let (by, inverse) = (first[k + 1], 1.0 / second[k + 1]);
            columns.chunks_exact_mut(n).for_each(|column| column[k + 1] *= inverse);
            let (first, second) = (from::<S>(first, k + 2), from::<S>(second, k + 2));
            scale(simd, second, inverse);

            // Multiples of both rows that make zeros of what stands below the pivots.
            let [p, q] = multiples.each_mut().map(|multiples| &mut multiples[..n - k - 2]);
            for ((row, p), q) in below.chunks_exact(n).zip(&mut *p).zip(&mut *q) {
                *p = -row[k];
                *q = -row[k + 1] - *p * by;
            }
            clear(simd, below, n, (first, second), (p, q));
            for column in columns.chunks_exact_mut(n) {
                let (known, rest) = column.split_at_mut(k + 2);
                add_both(simd, rest, (p, q), (known[k], known[k + 1]));
            }
        }
        for column in columns.chunks_exact_mut(n) {
            let mut unknowns = [0.0; MOST];
            for k in (0..n).rev() {
                let (left, known) = column.split_at_mut(k + 1);
                left[k] -= dot(simd, &rows[k * n + k + 1..(k + 1) * n], known);
                unknowns[usize::from(order[k])] = left[k];
            }
            column.copy_from_slice(&unknowns[..n]);
        }
    }
}

/// A row from its entry `k` on, and before that whatever fills whole vectors up: what stands left of the diagonal is
/// never read again.
#[inline(always)]
fn from<S: Simd>(row: &mut [f64], k: usize) -> &mut [f64] {
    let n = k + row[k..].len();
    let start = n.saturating_sub((n - k).next_multiple_of(S::F64_LANES));
    &mut row[start..]
}

/// Exchanges unknowns so that a large entry of row `k`, compared to the others, comes to the diagonal.
#[inline(always)]
fn bring_pivot<S: Simd>(simd: S, rows: &mut [f64], n: usize, k: usize, order: &mut [u8; MOST]) {
    let row = &rows[k * n + k..(k + 1) * n];
    let (vectors, rest) = S::as_simd_f64s(row);
    let mut most = simd.splat_f64s(0.0);
    for entries in vectors {
        most = simd.max_f64s(most, simd.abs_f64s(*entries));
    }
    let largest = rest.iter().fold(simd.reduce_max_f64s(most), |most, entry| most.max(entry.abs()));
    // Most often one is there.
    if row[0].abs() < NEARLY * largest {
        let pivot = k + row.iter().position(|entry| entry.abs() >= largest).unwrap_or(0);
        order.swap(k, pivot);
        rows.chunks_exact_mut(n).for_each(|row| row.swap(k, pivot));
    }
}

/// Adds `p first + q second` to each of the rows, which end where these do.
#[inline(always)]
fn clear<S: Simd>(simd: S, rows: &mut [f64], n: usize, (first, second): (&[f64], &[f64]), (p, q): (&[f64], &[f64])) {
    let start = n - first.len();
    let ((a, a_rest), (b, b_rest)) = (S::as_simd_f64s(first), S::as_simd_f64s(second));
    // Cut to lengths that the compiler knows to be one: no index is checked in the loops.
    let (count, left) = (a.len(), a_rest.len());
    let (b, b_rest) = (&b[..count], &b_rest[..left]);
    let mut blocks = rows.chunks_exact_mut(TOGETHER * n);
    let ((p, p_rest), (q, q_rest)) = (p.as_chunks::<TOGETHER>(), q.as_chunks::<TOGETHER>());
    for ((block, p), q) in (&mut blocks).zip(p).zip(q) {
        let (upper, lower) = block.split_at_mut(2 * n);
        let ((one, two), (three, four)) = (upper.split_at_mut(n), lower.split_at_mut(n));
        let (one, one_rest) = S::as_mut_simd_f64s(&mut one[start..]);
        let (two, two_rest) = S::as_mut_simd_f64s(&mut two[start..]);
        let (three, three_rest) = S::as_mut_simd_f64s(&mut three[start..]);
        let (four, four_rest) = S::as_mut_simd_f64s(&mut four[start..]);
        let (one, two, three, four) = (&mut one[..count], &mut two[..count], &mut three[..count], &mut four[..count]);
        let (wide_p, wide_q) = (p.map(|p| simd.splat_f64s(p)), q.map(|q| simd.splat_f64s(q)));
        for j in 0..count {
            one[j] = simd.mul_add_e_f64s(wide_q[0], b[j], simd.mul_add_e_f64s(wide_p[0], a[j], one[j]));
            two[j] = simd.mul_add_e_f64s(wide_q[1], b[j], simd.mul_add_e_f64s(wide_p[1], a[j], two[j]));
            three[j] = simd.mul_add_e_f64s(wide_q[2], b[j], simd.mul_add_e_f64s(wide_p[2], a[j], three[j]));
            four[j] = simd.mul_add_e_f64s(wide_q[3], b[j], simd.mul_add_e_f64s(wide_p[3], a[j], four[j]));
        }
        for (i, rest) in [one_rest, two_rest, three_rest, four_rest].into_iter().enumerate() {
            for j in 0..left {
                rest[j] += p[i] * a_rest[j] + q[i] * b_rest[j];
            }
        }
    }
    for ((row, p), q) in blocks.into_remainder().chunks_exact_mut(n).zip(p_rest).zip(q_rest) {
        add_both(simd, &mut row[start..], (first, second), (*p, *q));
    }
}

/// `row *= factor`.
#[inline(always)]
fn scale<S: Simd>(simd: S, row: &mut [f64], factor: f64) {
    let (vectors, rest) = S::as_mut_simd_f64s(row);
    let wide = simd.splat_f64s(factor);
    for entries in vectors {
        *entries = simd.mul_f64s(*entries, wide);
    }
    for entry in rest {
        *entry *= factor;
    }
}

/// `row += factor other`.
#[inline(always)]
fn add<S: Simd>(simd: S, row: &mut [f64], other: &[f64], factor: f64) {
    let ((vectors, rest), (others, others_rest)) = (S::as_mut_simd_f64s(row), S::as_simd_f64s(other));
    let wide = simd.splat_f64s(factor);
    for (entries, others) in vectors.iter_mut().zip(others) {
        *entries = simd.mul_add_e_f64s(wide, *others, *entries);
    }
    for (entry, other) in rest.iter_mut().zip(others_rest) {
        *entry += factor * other;
    }
}

/// `row += p first + q second`, as long as the row.
#[inline(always)]
fn add_both<S: Simd>(simd: S, row: &mut [f64], (first, second): (&[f64], &[f64]), (p, q): (f64, f64)) {
    let length = row.len();
    let ((entries, rest), (a, a_rest)) = (S::as_mut_simd_f64s(row), S::as_simd_f64s(&first[..length]));
    let (b, b_rest) = S::as_simd_f64s(&second[..length]);
    let (wide_p, wide_q) = (simd.splat_f64s(p), simd.splat_f64s(q));
    for ((entries, a), b) in entries.iter_mut().zip(a).zip(b) {
        *entries = simd.mul_add_e_f64s(wide_q, *b, simd.mul_add_e_f64s(wide_p, *a, *entries));
    }
    for ((entry, a), b) in rest.iter_mut().zip(a_rest).zip(b_rest) {
        *entry += p * a + q * b;
    }
}

/// Sum of products.
#[inline(always)]
fn dot<S: Simd>(simd: S, one: &[f64], other: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (S::as_simd_f64s(one), S::as_simd_f64s(other));
    let mut sum = simd.splat_f64s(0.0);
    for (a, b) in a.iter().zip(b) {
        sum = simd.mul_add_e_f64s(*a, *b, sum);
    }
    simd.reduce_sum_f64s(sum) + a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum::<f64>()
}
