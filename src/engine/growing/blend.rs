//! Functions of a contact's half-width, known at a few half-widths.
//!
//! Seen from a contact that is narrow beside a graded layer, what a flat punch answers is a series in `b` and `log b`,
//! the logarithm first with `b` (stick zone) or `b^2` (pressure). Polynomials alone tell `b^p log b` no better than
//! `n^-(2 p + 1)`; the first few of these terms beside them cost nothing.

use crate::engine::numerics::chebyshev::{Points, largest};
use crate::engine::numerics::dense::Dense;
use crate::engine::numerics::lanes::{LANES, Lanes, add_rows, polynomials_in_lanes};
use arrayvec::ArrayVec;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::Refusal;
use std::f64::consts::{LN_2, PI};

/// Most half-widths.
const MOST: usize = 256;

/// Most terms with logarithms.
const MOST_TERMS: usize = 3;

/// Places of the narrowest half-widths but 0, over that of the narrowest Chebyshev point. Chebyshev points alone hardly
/// see a logarithm: rounding of values there would grow as `n^2` in between with one term, as `n^4` with two. With
/// these it grows 4 to 26 times.
const BESIDE: [f64; 2] = [0.3, 0.02];

/// Half-widths at which functions are known, and how they are told in between.
#[derive(Clone, Debug)]
pub(crate) struct Blend {
    narrowest: f64,
    widest: f64,
    /// Functions are smooth in this root of the half-width.
    root: u32,
    functions: Functions,
    /// Descending.
    half_widths: Vec<f64>,
    /// `inverse[m * n + k]`: how much of the function `m` a value at the point `k` is.
    inverse: Vec<f64>,
}

impl Blend {
    /// So many half-widths between two, crowding at both ends like Chebyshev points; for functions with these terms
    /// beside what is analytic: they are told where the half-widths begin with 0.
    pub(crate) fn new(ends: (f64, f64), n: usize, terms: &[Term]) -> Result<Self, Refusal> {
        let terms = if ends.0 > 0.0 { &[] } else { terms };
        Self::through(ends, 1, n, terms)
    }

    /// The same of functions that are analytic in a root of the half-width, where the half-widths begin with 0.
    pub(crate) fn in_root(ends: (f64, f64), root: u32, n: usize) -> Result<Self, Refusal> {
        Self::through(ends, if ends.0 > 0.0 { 1 } else { root }, n, &[])
    }

    fn through((narrowest, widest): (f64, f64), root: u32, n: usize, terms: &[Term]) -> Result<Self, Refusal> {
        let n = n.min(MOST);
        let functions = Functions::new(terms, n);
        let at = if terms.is_empty() { Points::get(n).at.clone() } else { places(n) };
        let mut system = Dense::new(n, n);
        // A row for each function: the pivots are then the points where it is largest, and few digits are lost.
        let mut values = vec![0.0; n];
        system.solve(|rows, columns| {
            for (k, s) in at.iter().enumerate() {
                functions.values_into(*s, &mut values);
                rows[k..].iter_mut().step_by(n).zip(&values).for_each(|(entry, value)| *entry = *value);
            }
            // One function after another.
            columns.fill(0.0);
            columns.iter_mut().step_by(n + 1).for_each(|one| *one = 1.0);
            n
        })?;
        let inverse = (0..n).flat_map(|m| system.column(m)).copied().collect();
        let power = i32::try_from(root).unwrap_or(i32::MAX);
        let half_widths = at.iter().map(|s| narrowest + (widest - narrowest) * s.powi(power)).collect();
        Ok(Self { narrowest, widest, root, functions, half_widths, inverse })
    }

    /// The narrowest.
    pub(crate) fn narrowest(&self) -> f64 {
        self.narrowest
    }

    /// The widest.
    pub(crate) fn widest(&self) -> f64 {
        self.widest
    }

    /// Functions are smooth in this root of the half-width.
    pub(crate) fn root(&self) -> u32 {
        self.root
    }

    /// Where the functions are known, descending.
    pub(crate) fn half_widths(&self) -> &[f64] {
        &self.half_widths
    }

    /// How many functions tell what is between.
    pub(crate) fn functions(&self) -> usize {
        self.half_widths.len()
    }

    /// How much there is of each function, for `width` things whose values at the points are the rows of a table.
    pub(crate) fn coefficients(&self, rows: &[f64], width: usize) -> Vec<f64> {
        let n = self.half_widths.len();
        assert_eq!(rows.len(), n * width, "one row for each point");
        let mut coefficients = vec![0.0; n * width];
        for (inverse, to) in self.inverse.chunks_exact(n).zip(coefficients.chunks_exact_mut(width)) {
            add_rows(inverse, rows, to);
        }
        coefficients
    }

    /// How much there is of the function that varies fastest, at most of `width` things.
    pub(crate) fn last(&self, coefficients: &[f64], width: usize) -> f64 {
        let terms = self.functions.terms.len();
        // Of two polynomials one may be missing.
        let last = if terms > 0 { terms - 1..terms } else { self.functions() - 2..self.functions() };
        largest(&coefficients[last.start * width..last.end * width])
    }

    /// A half-width from 0, the narrowest, to 1, the widest; its root.
    fn share(&self, half_width: f64) -> f64 {
        let share = (half_width - self.narrowest) / (self.widest - self.narrowest);
        if self.root == 1 { share } else { share.powf(f64::from(self.root).recip()) }
    }

    /// The functions at some half-widths, one after another.
    pub(crate) fn functions_into(&self, half_widths: &Lanes, out: &mut Vec<Lanes>) {
        // All of it is written: nothing has to be cleared.
        out.resize(self.half_widths.len(), [0.0; LANES]);
        self.functions.lanes_into(&half_widths.map(|half_width| self.share(half_width)), out);
    }

    /// The functions at a half-width.
    pub(crate) fn functions_at(&self, half_width: f64, out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.half_widths.len(), 0.0);
        self.functions.values_into(self.share(half_width), out);
    }

    /// One thing at a half-width, of which there is so much of each function.
    pub(crate) fn sum(&self, half_width: f64, coefficients: &[f64]) -> f64 {
        let mut values = [0.0; MOST];
        let values = &mut values[..coefficients.len()];
        self.functions.values_into(self.share(half_width), values);
        values.iter().zip(coefficients).map(|(value, coefficient)| value * coefficient).sum()
    }
}

/// Points on `(0, 1)` that tell logarithms at 0 from polynomials, descending.
fn places(n: usize) -> Vec<f64> {
    let mut at = Points::get(n - BESIDE.len()).at.clone();
    let first = at[at.len() - 1];
    at.extend(BESIDE.map(|share| share * first));
    at
}

/// A power of the half-width, and of its logarithm beside it.
pub(crate) type Term = (usize, i32);

/// Chebyshev polynomials on `[0, 1]`, and a few terms `s^p log^q s` in place of the last of them.
///
/// As they are, the latter are nearly alike, and like polynomials. So each is less all that the polynomials beside it
/// tell, and those before it are taken out, so that it leads with the polynomial that it stands for. That spans the
/// same.
#[derive(Clone, Debug)]
struct Functions {
    terms: ArrayVec<Term, MOST_TERMS>,
    /// Chebyshev coefficients that are left out of each, one after another.
    told: Vec<f64>,
    /// `mixed[i * terms + j]`: how much of term `j` there is in number `i`.
    mixed: Vec<f64>,
}

impl Functions {
    /// `n` of them, more than twice as many as terms.
    fn new(terms: &[Term], n: usize) -> Self {
        let m = terms.len();
        let mut told = Vec::with_capacity(m * (n - m));
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(m);
        for (i, term) in terms.iter().enumerate() {
            let coefficients = coefficients(*term, n);
            told.extend(&coefficients[..n - m]);
            let one = (0..m).map(|j| if i == j { 1.0 } else { 0.0 });
            rows.push(coefficients[n - m..].iter().copied().chain(one).collect());
        }
        // Each leads with 1 and is taken out of those after it.
        for i in 0..m {
            let scale = 1.0 / rows[i][i];
            rows[i].iter_mut().for_each(|entry| *entry *= scale);
            let (done, rest) = rows.split_at_mut(i + 1);
            for row in rest {
                let share = row[i];
                row.iter_mut().zip(&done[i]).for_each(|(entry, first)| *entry -= share * first);
            }
        }
        let mixed = rows.iter().flat_map(|row| row[m..].to_vec()).collect();
        Self { terms: terms.iter().copied().collect(), told, mixed }
    }

    /// All values at some points.
    fn lanes_into(&self, s: &Lanes, out: &mut [Lanes]) {
        let logs = if self.terms.is_empty() { [0.0; LANES] } else { s.map(|s| if s > 0.0 { s.ln() } else { 0.0 }) };
        Arch::new().dispatch(InLanes { functions: self, s, logs: &logs, out });
    }

    /// All values at a point.
    fn values_into(&self, s: f64, out: &mut [f64]) {
        let (mixtures, polynomials) = out.split_at_mut(self.terms.len());
        let x = 2.0 * s - 1.0;
        let mut pair = (1.0, x);
        for value in &mut *polynomials {
            *value = pair.0;
            pair = (pair.1, 2.0 * x * pair.1 - pair.0);
        }
        let log = if s > 0.0 { s.ln() } else { 0.0 };
        let told = self.told.chunks_exact(polynomials.len());
        let left = self.terms.iter().zip(told).map(|((p, q), told)| {
            let told: f64 = told.iter().zip(&*polynomials).map(|(told, value)| told * value).sum();
            (0..*p).fold(log.powi(*q), |term, _| term * s) - told
        });
        let left: ArrayVec<f64, MOST_TERMS> = left.collect();
        for (value, row) in mixtures.iter_mut().zip(self.mixed.chunks_exact(left.len().max(1))) {
            *value = row.iter().zip(&left).map(|(mixed, left)| mixed * left).sum();
        }
    }
}

struct InLanes<'a> {
    functions: &'a Functions,
    s: &'a Lanes,
    /// The logarithms.
    logs: &'a Lanes,
    out: &'a mut [Lanes],
}

impl WithSimd for InLanes<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { functions: Functions { terms, told, mixed }, s, logs, out } = self;
        let (mixtures, polynomials) = out.split_at_mut(terms.len());
        polynomials_in_lanes(simd, s, polynomials);
        let mut left = [[0.0; LANES]; MOST_TERMS];
        for ((left, (p, q)), told) in left.iter_mut().zip(terms).zip(told.chunks_exact(polynomials.len())) {
            for ((left, s), log) in left.iter_mut().zip(s).zip(logs) {
                *left = (0..*p).fold(log.powi(*q), |term, _| term * s);
            }
            let left = S::as_mut_simd_f64s(left).0;
            for (told, value) in told.iter().zip(&*polynomials) {
                let less = simd.splat_f64s(-told);
                for (left, value) in left.iter_mut().zip(S::as_simd_f64s(value).0) {
                    *left = simd.mul_add_e_f64s(less, *value, *left);
                }
            }
        }
        for (value, row) in mixtures.iter_mut().zip(mixed.chunks_exact(terms.len().max(1))) {
            *value = [0.0; LANES];
            let value = S::as_mut_simd_f64s(value).0;
            for (mixed, left) in row.iter().zip(&left) {
                let mixed = simd.splat_f64s(*mixed);
                for (value, left) in value.iter_mut().zip(S::as_simd_f64s(left).0) {
                    *value = simd.mul_add_e_f64s(mixed, *left, *value);
                }
            }
        }
    }
}

/// The first `n` Chebyshev coefficients of `s^p log^q s` on `[0, 1]`, with `q` 1 or 2.
///
/// `s = cos^2(angle/2)`, so that `log s = 2 L - 2 log 2` with `L = log(2 cos(angle/2)) = sum (-1)^(k+1) cos(k
/// angle)/k`; the square of `L` has the coefficients `(-1)^k (H(k-1) + H(k))/k`, the first `pi^2/12`, with the sums
/// `H(k) = 1 + ... + 1/k`.
fn coefficients((p, q): Term, n: usize) -> Vec<f64> {
    let mut sum = 0.0;
    let of_power = |k: usize| {
        // The first is doubled as yet.
        if k == 0 {
            return if q == 1 { -4.0 * LN_2 } else { 8.0 * (PI * PI / 12.0 + LN_2 * LN_2) };
        }
        let (inverse, sign) = (1.0 / k as f64, if k.is_multiple_of(2) { 1.0 } else { -1.0 });
        let sums = 2.0 * sum + inverse;
        sum += inverse;
        sign * inverse * if q == 1 { -2.0 } else { 4.0 * sums + 8.0 * LN_2 }
    };
    let mut of: Vec<f64> = (0..n + p).map(of_power).collect();
    // One factor s = (1 + cos(angle))/2 after another.
    for _ in 0..p {
        of = (0..of.len() - 1).map(|k| 0.5 * of[k] + 0.25 * (of[k.abs_diff(1)] + of[k + 1])).collect();
    }
    of[0] *= 0.5;
    of
}

#[cfg(test)]
mod tests {
    use super::super::family::{OF_PRESSURE, OF_SHEAR};
    use super::*;

    const EVERYWHERE: [f64; 7] = [0.0, 1e-6, 0.01, 0.3, 1.0, 2.2, 3.0];

    fn error(f: impl Fn(f64) -> f64, count: usize, terms: &[Term], places: &[f64]) -> f64 {
        let blend = Blend::new((0.0, 3.0), count, terms).unwrap();
        let values: Vec<f64> = blend.half_widths().iter().map(|b| f(*b)).collect();
        let coefficients = blend.coefficients(&values, 1);
        let at = |b: &f64| (blend.sum(*b, &coefficients) - f(*b)).abs();
        let side_by_side = |places: &[f64]| {
            let mut lanes = [1.0; LANES];
            lanes[..places.len()].copy_from_slice(places);
            let mut functions = Vec::new();
            blend.functions_into(&lanes, &mut functions);
            let blended = |i: usize| functions.iter().zip(&coefficients).map(|(f, c)| f[i] * c).sum::<f64>();
            (0..places.len()).map(|i| (blended(i) - f(places[i])).abs()).fold(0.0, f64::max)
        };
        places.iter().map(at).fold(side_by_side(places), f64::max)
    }

    #[test]
    fn logarithms_cost_no_digit_however_alike() {
        for terms in [OF_PRESSURE, OF_SHEAR] {
            for count in [16, 40, 120, 256] {
                for (p, q) in terms {
                    // In s = b/3 the squared logarithm is one of the terms.
                    let logarithmic = |b: f64| {
                        let s = b / 3.0;
                        let term = if s > 0.0 { s.powi(i32::try_from(*p).unwrap()) * s.ln().powi(*q) } else { 0.0 };
                        (0.5 * b).exp() + term
                    };
                    // Rounding of 1e-16 in values of up to 4.5, grown up to 60 times.
                    let apart = error(logarithmic, count, terms, &EVERYWHERE[2..]);
                    assert!(apart < 5e-13, "{count} of {terms:?}: {apart:e}");
                    // Narrower than a millionth, where no load is to speak of, many polynomials lose more.
                    let close = error(logarithmic, count, terms, &EVERYWHERE[..2]);
                    assert!(close < if count > 100 { 1e-8 } else { 5e-14 }, "{count} of {terms:?}: {close:e}");
                }
            }
        }
    }

    #[test]
    fn what_is_not_told_converges_as_polynomials_do() {
        // b^3 log b like n^-6 at b = 0 and n^-7 elsewhere, b^2 log b beside one logarithm like n^-4 and n^-5.
        let cubic = |b: f64| if b > 0.0 { b.powi(3) * b.ln() } else { 0.0 };
        let square = |b: f64| if b > 0.0 { b * b * b.ln() } else { 0.0 };
        let ratio = |f: &dyn Fn(f64) -> f64, terms: &[Term]| {
            error(f, 16, terms, &EVERYWHERE) / error(f, 32, terms, &EVERYWHERE)
        };
        assert!(ratio(&cubic, &[(1, 1), (2, 1)]) > 48.0, "{}", ratio(&cubic, &[(1, 1), (2, 1)]));
        assert!(ratio(&square, &[(1, 1)]) > 12.0, "{}", ratio(&square, &[(1, 1)]));
    }

    #[test]
    fn broken_powers_are_polynomials_in_a_root() {
        let broken = |b: f64| (0.5 * b).exp() + b.powf(0.4) + b.powf(1.2);
        let error = |root: u32| {
            let blend = Blend::in_root((0.0, 3.0), root, 40).unwrap();
            let values: Vec<f64> = blend.half_widths().iter().map(|b| broken(*b)).collect();
            let coefficients = blend.coefficients(&values, 1);
            let at = |b: &f64| (blend.sum(*b, &coefficients) - broken(*b)).abs();
            EVERYWHERE.iter().map(at).fold(0.0, f64::max)
        };
        assert!(error(5) < 1e-13, "{:e}", error(5));
        assert!(error(1) > 1e-3, "{:e}", error(1));
        // A layer that ends in a face has no such power.
        assert_eq!(
            Blend::in_root((1.0, 3.0), 5, 8).unwrap().half_widths(),
            Blend::new((1.0, 3.0), 8, &[]).unwrap().half_widths()
        );
    }

    #[test]
    fn coefficients_are_those_of_the_function() {
        // By Gauss's rule, which takes coefficients about 2 n for them: 8 log(2 n)/(2 n)^3 and less.
        let n = 4096;
        let alias = 8.0 * 8192.0_f64.ln() / 8192.0_f64.powi(3);
        let points = Points::get(n).at.clone();
        for (p, q) in [(1, 1), (1, 2), (2, 1), (2, 2), (3, 1)] {
            for (k, told) in coefficients((p, q), 12).into_iter().enumerate() {
                let term = |s: &f64| {
                    s.powi(i32::try_from(p).unwrap()) * s.ln().powi(q) * (k as f64 * (2.0 * s - 1.0).acos()).cos()
                };
                let sum: f64 = points.iter().map(term).sum();
                let expected = sum * if k == 0 { 1.0 } else { 2.0 } / n as f64;
                assert!((told - expected).abs() < alias, "{p}, {q}, {k}: {told:e} and {expected:e}");
            }
        }
    }
}
