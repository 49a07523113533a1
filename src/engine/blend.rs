//! Functions of a contact's half-width, known at a few half-widths.
//!
//! Seen from a contact that is narrow beside a graded layer, what a flat punch answers is a series in `b` and `log b`, the
//! logarithm first with `b` (stick zone) or `b^2` (pressure): polynomials alone converge slowly, one logarithm beside
//! them costs nothing and saves half of the points. Measured on
//! the stick ratio of a graded layer five times as thick as the contact is wide: 4e-7 by 18 polynomials in `(b/B)^(1/2)`,
//! 9e-9 in `(b/B)^(1/3)`, 4e-9 by 17 in `b/B` and the logarithm. More logarithms are nearly alike and lose the digits.

use super::dense::Dense;
use arrayvec::ArrayVec;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::Refusal;
use std::f64::consts::FRAC_PI_4;

/// Polynomials tell `s^k log s` to about `n^-(2 k + 1)` by themselves. Where that is below this, the logarithm is too much
/// like them to stand beside them.
const ALIKE: f64 = 1e-8;

/// Most half-widths.
const MOST: usize = 256;

/// Half-widths at which functions are known, and how they are told in between.
#[derive(Clone, Debug)]
pub(crate) struct Blend {
    narrowest: f64,
    widest: f64,
    /// Power of `b` beside the logarithm.
    order: Option<i32>,
    /// Descending.
    half_widths: Vec<f64>,
    /// `inverse[m * n + k]`: how much of the function `m` a value at the point `k` is.
    inverse: Vec<f64>,
}

impl Blend {
    /// So many half-widths between two, crowding at both ends like Chebyshev points; for functions whose first logarithm
    /// goes with that power of the half-width: it is told where the half-widths begin with 0.
    pub(crate) fn new((narrowest, widest): (f64, f64), n: usize, order: i32) -> Result<Self, Refusal> {
        let n = n.min(MOST);
        let order = if narrowest > 0.0 { None } else { Some(order) };
        let angle = |k: usize| (2 * k + 1) as f64 * FRAC_PI_4 / n as f64;
        let at: Vec<f64> = (0..n).map(|k| angle(k).cos().powi(2)).collect();
        let mut system = Dense::new(n, n);
        for (row, s) in system.rows.chunks_exact_mut(n).zip(&at) {
            row.iter_mut().zip(functions(*s, n, order)).for_each(|(entry, function)| *entry = function);
        }
        // Unit values at one point after another.
        system.columns.iter_mut().step_by(n + 1).for_each(|one| *one = 1.0);
        system.solve(n)?;
        let inverse = (0..n * n).map(|i| system.columns[i % n * n + i / n]).collect();
        let half_widths = at.iter().map(|s| narrowest + (widest - narrowest) * s).collect();
        Ok(Self { narrowest, widest, order, half_widths, inverse })
    }

    /// The narrowest.
    pub(crate) fn narrowest(&self) -> f64 {
        self.narrowest
    }

    /// The widest.
    pub(crate) fn widest(&self) -> f64 {
        self.widest
    }

    /// Where the functions are known, descending.
    pub(crate) fn half_widths(&self) -> &[f64] {
        &self.half_widths
    }

    /// How much of the value at each point there is in the value at a half-width.
    pub(crate) fn shares_into(&self, half_width: f64, shares: &mut Vec<f64>) {
        let n = self.half_widths.len();
        shares.clear();
        shares.resize(n, 0.0);
        let factors: ArrayVec<f64, MOST> =
            functions((half_width - self.narrowest) / (self.widest - self.narrowest), n, self.order).collect();
        add_rows(&factors, &self.inverse, shares);
    }
}

/// The sum of the rows of a table, each so many times, added to what there is.
pub(crate) fn add_rows(factors: &[f64], rows: &[f64], to: &mut [f64]) {
    Arch::new().dispatch(AddRows { factors, rows, to });
}

struct AddRows<'a> {
    factors: &'a [f64],
    rows: &'a [f64],
    to: &'a mut [f64],
}

impl WithSimd for AddRows<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (factor, row) in self.factors.iter().zip(self.rows.chunks_exact(self.to.len())) {
            let (row, row_rest) = S::as_simd_f64s(row);
            let (to, to_rest) = S::as_mut_simd_f64s(self.to);
            let wide = simd.splat_f64s(*factor);
            for (to, row) in to.iter_mut().zip(row) {
                *to = simd.mul_add_e_f64s(wide, *row, *to);
            }
            for (to, row) in to_rest.iter_mut().zip(row_rest) {
                *to += factor * row;
            }
        }
    }
}

/// Chebyshev polynomials on `[0, 1]`, the last of them `s^order log s` unless there are many.
fn functions(s: f64, n: usize, order: Option<i32>) -> impl Iterator<Item = f64> {
    let x = 2.0 * s - 1.0;
    let mut pair = (1.0, x);
    let order = order.filter(|order| (n as f64).powi(-2 * order - 1) > ALIKE);
    (0..n).map(move |m| {
        let this = pair.0;
        pair = (pair.1, 2.0 * x * pair.1 - pair.0);
        match order.filter(|_| m + 1 == n) {
            Some(order) if s > 0.0 => s.powi(order) * s.ln(),
            Some(_) => 0.0,
            None => this,
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn error(f: impl Fn(f64) -> f64, count: usize) -> f64 {
        let blend = Blend::new((0.0, 3.0), count, 1).unwrap();
        let values: Vec<f64> = blend.half_widths().iter().map(|b| f(*b)).collect();
        let mut shares = Vec::new();
        let at = |b: f64| {
            blend.shares_into(b, &mut shares);
            let blended: f64 = shares.iter().zip(&values).map(|(share, value)| share * value).sum();
            (blended - f(b)).abs()
        };
        [0.0, 1e-6, 0.01, 0.3, 1.0, 2.2, 3.0].into_iter().map(at).fold(0.0, f64::max)
    }

    #[test]
    fn the_logarithm_of_the_narrow_end_costs_no_digit() {
        let smooth = |b: f64| (0.5 * b).exp();
        let logarithmic = |b: f64| if b > 0.0 { smooth(b) + 0.1 * b * b.ln() } else { 1.0 };
        // Rounding, grown by functions that are nearly alike.
        assert!(error(smooth, 16) < 1e-12, "{:e}", error(smooth, 16));
        assert!(error(logarithmic, 16) < 1e-12, "{:e}", error(logarithmic, 16));
        // What comes next, b^2 log b, converges like n^-4.
        let next = |b: f64| if b > 0.0 { b * b * b.ln() } else { 0.0 };
        assert!(error(next, 32) < error(next, 16) / 12.0, "{:e} and {:e}", error(next, 32), error(next, 16));
    }
}
