//! One kernel's parts as polynomials on one piece of `|t|`.

use crate::polynomial;
use slipzone_api::chebyshev::in_powers;
use std::f64::consts::PI;
use std::sync::OnceLock;

/// The variable of a piece, the distance, and the parts there.
pub(crate) type Sample = (f64, f64, Values);

/// A kernel's parts (smooth, sign, log) at `t > 0`.
pub(crate) type Values = [f64; 3];

/// Most nodes of a piece.
pub(crate) const MOST_NODES: usize = 18;

/// Where the variable of a piece is sampled: Chebyshev nodes, then the checks.
pub(crate) struct Variable {
    pub(crate) nodes: usize,
    pub(crate) all: Vec<f64>,
}

impl Variable {
    /// An interpolant is worst at the ends of its range.
    pub(crate) fn chebyshev(nodes: usize, checks: &[f64]) -> Self {
        let cosine = |j: usize| (PI * (2 * j + 1) as f64 / (2 * nodes) as f64).cos();
        Self { nodes, all: (0..nodes).map(cosine).chain(checks.iter().copied()).collect() }
    }
}

/// The variable `2 (t/upper)^2 - 1` at a thousandth of the first piece: nearly its lower end, where a kernel whose
/// series is too short is not smooth.
pub(crate) const NEAR_ORIGIN: f64 = -1.0 + 2e-6;

/// One kernel on one piece.
pub(crate) struct Piece {
    pub(crate) rows: Vec<[f64; 3]>,
    pub(crate) error: f64,
    /// What of the error no finer piece removes.
    pub(crate) noise: f64,
}

/// One kernel over all pieces.
#[derive(Clone, Debug, Default)]
pub(crate) struct Kernel {
    /// Rows of a piece: one per power of its variable, constant first; the columns are the parts.
    pub(crate) rows: Vec<Vec<[f64; 3]>>,
    /// Bound on the interpolation's error, and on `|k - far form|` beyond the last piece.
    pub(crate) error: f64,
    /// What of it no finer pieces would remove.
    pub(crate) noise: f64,
}

/// All kernels over the same pieces.
#[derive(Clone, Debug, Default)]
pub(crate) struct Pieces {
    /// Upper ends; the first piece begins at 0.
    pub(crate) ends: Vec<f64>,
    pub(crate) kernels: Vec<Kernel>,
}

impl Pieces {
    /// Takes the kernels' pieces up to an end; where they have stalled, all their error is noise.
    pub(crate) fn take(&mut self, upper: f64, pieces: Vec<Piece>, stalled: bool) {
        self.ends.push(upper);
        for (kernel, piece) in self.kernels.iter_mut().zip(pieces) {
            kernel.error = worst(kernel.error, piece.error);
            kernel.noise = worst(kernel.noise, if stalled { piece.error } else { piece.noise });
            kernel.rows.push(piece.rows);
        }
    }
}

/// The larger of an error so far and another. One that is no number may be any: `f64::max` would leave it out.
pub(crate) fn worst(most: f64, error: f64) -> f64 {
    if error.is_nan() { f64::INFINITY } else { most.max(error) }
}

/// Where a variable stands between two ends.
pub(crate) fn place(v: f64, (lower, upper): (f64, f64)) -> f64 {
    // (1 + v)/2 without cancellation on the first piece, whose variable is (t/upper)^2.
    if lower == 0.0 { upper * (0.5 * (1.0 + v)).sqrt() } else { lower + (upper - lower) * 0.5 * (1.0 + v) }
}

/// Rounding of the values that are interpolated, over their size: below it nothing is resolved.
const NOISE: f64 = 6.0 * f64::EPSILON;

/// On the piece at the origin an even factor of the logarithm has its error multiplied by up to this: `|log t|`
/// at the smallest distances that two points of a contact have, `exp(-40)` of the thickness.
pub(crate) const LARGEST_LOG: f64 = 40.0;

impl Piece {
    /// Through the values at the nodes; those at the `checks`, of which the last is the upper end, show the error.
    ///
    /// The piece `at_origin` has the parity of each part built in: a kernel's smooth part and the factor of its
    /// logarithm are odd when it is (`odd`), the factor of its sign when it is not.
    pub(crate) fn through((nodes, checks): (&[Sample], &[Sample]), at_origin: bool, odd: bool, aim: f64) -> Self {
        let upper = checks.last().expect("a check at the upper end").1;
        let parity = [odd, !odd, odd].map(|odd| odd && at_origin);
        let mut piece = Self { rows: Vec::with_capacity(nodes.len()), error: 0.0, noise: 0.0 };
        for part in 0..3 {
            let mut values = [0.0; MOST_NODES];
            for (value, (.., all)) in values.iter_mut().zip(nodes) {
                *value = all[part];
            }
            let values = &values[..nodes.len()];
            let series = chebyshev(values, parity[part]);
            let mut series = &series[..nodes.len()];
            let weight = match part {
                2 if at_origin && !odd => LARGEST_LOG,
                2 => upper.ln().abs().max(1.0),
                _ => 1.0,
            };
            let noise = NOISE * values.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
            let left_out = remainder(series, noise);
            // Drop what is not wanted.
            let mut dropped = 0.0;
            while let [kept @ .., c] = series {
                if dropped + c.abs() > 0.1 * aim / weight {
                    break;
                }
                dropped += c.abs();
                series = kept;
            }
            let mut powers = monomials(series, parity[part]);
            let powers = &mut powers[..series.len()];
            if parity[part] {
                // The table multiplies by t.
                for c in &mut *powers {
                    *c /= upper;
                }
            }
            let seen = checks.iter().fold(0.0_f64, |most, (v, t, value)| {
                let sum = powers.iter().rev().fold(0.0, |sum, c| sum * v + c);
                worst(most, (if parity[part] { sum * t } else { sum } - value[part]).abs())
            });
            piece.error += weight * (3.0 * worst(seen, left_out) + dropped);
            piece.noise += weight * noise;
            piece.rows.resize(piece.rows.len().max(powers.len()), [0.0; 3]);
            for (row, c) in piece.rows.iter_mut().zip(powers) {
                row[part] = *c;
            }
        }
        piece
    }
}

/// What the coefficients beyond the last sum up to, if they go on falling as they did; noise falls no more.
fn remainder(series: &[f64], noise: f64) -> f64 {
    let n = series.len();
    let most = |range: std::ops::Range<usize>| series[range].iter().fold(0.0_f64, |most, c| most.max(c.abs()));
    let last = most(n - 2..n);
    if last <= noise {
        return last;
    }
    let ratio = (last / most(n / 2 - 1..n / 2 + 1).max(f64::MIN_POSITIVE)).powf(2.0 / n as f64);
    last / (1.0 - ratio.min(SLOWEST))
}

/// Slowest decay assumed from one Chebyshev coefficient to the next.
const SLOWEST: f64 = 0.95;

/// Coefficients of `T_0, T_1, ...` in the interpolant through values at `cos((2j + 1) pi/2n)`, or, of an `odd` one, of
/// `T_1, T_3, ...` through values at `cos((2j + 1) pi/4n)`.
fn chebyshev(values: &[f64], odd: bool) -> [f64; MOST_NODES] {
    let mut series = [0.0; MOST_NODES];
    for (c, row) in series.iter_mut().zip(cosines(values.len(), odd).chunks_exact(values.len())) {
        *c = row.iter().zip(values).map(|(cosine, value)| value * cosine).sum();
    }
    series
}

/// What leads from values to those coefficients, row by row; made when first asked for.
fn cosines(nodes: usize, odd: bool) -> &'static [f64] {
    static COSINES: [[OnceLock<Vec<f64>>; MOST_NODES + 1]; 2] =
        [const { [const { OnceLock::new() }; MOST_NODES + 1] }; 2];
    COSINES[usize::from(odd)][nodes].get_or_init(|| {
        let entry = |k: usize, j: usize| {
            let order = if odd { 2 * k + 1 } else { 2 * k };
            // The angle in units of pi/4n, within a turn.
            let angle = order * (2 * j + 1) % (8 * nodes);
            let weight = if order == 0 { 1.0 } else { 2.0 } / nodes as f64;
            weight * (PI * angle as f64 / (4 * nodes) as f64).cos()
        };
        (0..nodes).flat_map(|k| (0..nodes).map(move |j| entry(k, j))).collect()
    })
}

/// `sum_k series[k] T_k(v)` in powers of `v`; of an odd series, `sum_k series[k] T_(2k+1)(x)/x` in powers of
/// `v = 2 x^2 - 1`.
fn monomials(series: &[f64], odd: bool) -> [f64; MOST_NODES] {
    static ROWS: OnceLock<[[[f64; MOST_NODES]; MOST_NODES]; 2]> = OnceLock::new();
    let rows = ROWS.get_or_init(|| [[0.0, 1.0], [-1.0, 2.0]].map(in_powers));
    polynomial::sum(series, &rows[usize::from(odd)])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values that are no numbers have any error; none was told of them.
    #[test]
    fn a_value_that_is_no_number_is_in_error() {
        let Variable { all, nodes, .. } = Variable::chebyshev(8, &[1.0]);
        let sample = |value: f64| move |v: &f64| (*v, place(*v, (1.0, 2.0)), [value * v, 0.0, 0.0]);
        for (value, is_told) in [(1.0, true), (f64::NAN, false)] {
            let samples: Vec<Sample> = all.iter().map(sample(value)).collect();
            let mut pieces = Pieces { ends: Vec::new(), kernels: vec![Kernel::default()] };
            pieces.take(2.0, vec![Piece::through(samples.split_at(nodes), false, true, 1e-10)], false);
            assert_eq!(pieces.kernels[0].error < 1e-9, is_told, "{value}: {:e}", pieces.kernels[0].error);
        }
    }
}
