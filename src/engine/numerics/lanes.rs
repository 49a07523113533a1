//! Sums and polynomials that vectors make side by side.

use pulp::{Arch, Simd, WithSimd};

/// So many numbers stand side by side: whole vectors of any machine.
pub(crate) const LANES: usize = 16;
/// One number for each of them.
pub(crate) type Lanes = [f64; LANES];

/// The sum of the rows of a table, each so many times, added to what there is.
pub(crate) fn add_rows(factors: &[f64], rows: &[f64], to: &mut [f64]) {
    Arch::new().dispatch(AddRows { factors, rows, to });
}

/// So many rows are added at a time.
const TOGETHER: usize = 4;

struct AddRows<'a> {
    factors: &'a [f64],
    rows: &'a [f64],
    to: &'a mut [f64],
}

impl WithSimd for AddRows<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (factors, factors_left) = self.factors.as_chunks::<TOGETHER>();
        let (rows, rows_left) = self.rows.split_at(factors.len() * TOGETHER * self.to.len());
        for (factors, rows) in factors.iter().zip(rows.chunks_exact(TOGETHER * self.to.len())) {
            add_together(simd, factors, rows, self.to);
        }
        for (factor, row) in factors_left.iter().zip(rows_left.chunks_exact(self.to.len())) {
            add_together(simd, &[*factor], row, self.to);
        }
    }
}

/// Adds a few rows at a time, one after another to what is loaded once.
#[inline(always)]
fn add_together<S: Simd, const N: usize>(simd: S, factors: &[f64; N], rows: &[f64], to: &mut [f64]) {
    let width = to.len();
    let rows: [&[f64]; N] = std::array::from_fn(|i| &rows[i * width..(i + 1) * width]);
    let wide = factors.map(|factor| simd.splat_f64s(factor));
    let (to, to_rest) = S::as_mut_simd_f64s(to);
    let in_lanes = rows.map(|row| &S::as_simd_f64s(row).0[..to.len()]);
    for (k, to) in to.iter_mut().enumerate() {
        *to = (0..N).fold(*to, |sum, i| simd.mul_add_e_f64s(wide[i], in_lanes[i][k], sum));
    }
    let rest = rows.map(|row| &row[width - to_rest.len()..]);
    for (k, to) in to_rest.iter_mut().enumerate() {
        *to = (0..N).fold(*to, |sum, i| sum + factors[i] * rest[i][k]);
    }
}

/// Chebyshev polynomials on `[0, 1]`, at least one of them, one after another.
#[inline(always)]
pub(crate) fn polynomials_in_lanes<S: Simd>(simd: S, s: &Lanes, out: &mut [Lanes]) {
    let [first, rest @ ..] = out else { return };
    *first = [1.0; LANES];
    let Some(second) = rest.first_mut() else { return };
    *second = s.map(|s| 2.0 * s - 1.0);
    let twice = second.map(|x| 2.0 * x);
    let twice = S::as_simd_f64s(&twice).0;
    for m in 2..out.len() {
        let (before, here) = out.split_at_mut(m);
        let (two, one) = (S::as_simd_f64s(&before[m - 2]).0, S::as_simd_f64s(&before[m - 1]).0);
        for (i, value) in S::as_mut_simd_f64s(&mut here[0]).0.iter_mut().enumerate() {
            *value = simd.sub_f64s(simd.mul_f64s(twice[i], one[i]), two[i]);
        }
    }
}
