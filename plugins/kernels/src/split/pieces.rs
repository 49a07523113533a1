//! The three parts of the kernels as polynomials over pieces of `|t|`.

use crate::even_table::chebyshev;
use std::f64::consts::PI;

/// The variable of a piece, the distance, and the parts there.
type Sample = (f64, f64, Values);

/// A kernel's parts (smooth, sign, log) at `t > 0`.
pub(super) type Values = [f64; 3];

/// Where and how the kernels are interpolated.
pub(super) struct Plan {
    /// End of the range.
    pub(super) reach: f64,
    /// First width tried.
    pub(super) width: f64,
    /// Beyond this the singular parts are gone.
    pub(super) local: f64,
    /// Per kernel: whether it is odd, and the error that a piece may have.
    pub(super) kernels: Vec<(bool, f64)>,
}

/// One kernel over all pieces.
#[derive(Clone, Debug, Default)]
pub(super) struct Kernel {
    pub(super) odd: bool,
    /// Rows of a piece: one per power of its variable, constant first; the columns are the parts.
    pub(super) rows: Vec<Vec<[f64; 4]>>,
    /// Bound on the interpolation's error, and on `|k - far form|` beyond the last piece.
    pub(super) error: f64,
    /// What of it no finer pieces would remove.
    pub(super) noise: f64,
}

/// All kernels over the same pieces.
#[derive(Clone, Debug, Default)]
pub(super) struct Pieces {
    /// Upper ends; the first piece begins at 0.
    pub(super) ends: Vec<f64>,
    pub(super) kernels: Vec<Kernel>,
}

/// Most pieces: 0.1 h wide ones over 50 h.
const MOST_PIECES: usize = 512;
/// Part of the nodes that the piece at the origin needs: parity halves its polynomials.
const FIRST_NODES: f64 = 0.6;
/// A piece that starts beyond `t` is up to this part of `t` wide: singularities are that far away.
const WIDENING: f64 = 0.25;
/// Widest piece, in units of the thickness.
const WIDEST: f64 = 4.0;
/// A piece that was halved and has not come below this part of its error is as good as it gets: noise.
const STALL: f64 = 0.6;
/// No noise is larger than this.
const LARGEST_NOISE: f64 = 1e-11;
/// Halvings of one piece before its error is accepted as it is.
const MOST_HALVINGS: u32 = 12;

impl Pieces {
    /// Interpolates `parts(t)`, which fills one [`Values`] per kernel, with `nodes` of them in a piece.
    ///
    /// The pieces end where each kernel has become what it is far away: `-1/t` if it is odd and nothing
    /// otherwise, the base being rigid. What is left there falls exponentially; two pieces running must agree.
    pub(super) fn new(plan: &Plan, nodes: usize, mut parts: impl FnMut(f64, &mut [Values])) -> Self {
        let kernels = plan.kernels.iter().map(|(odd, _)| Kernel { odd: *odd, ..Kernel::default() }).collect();
        let mut pieces = Self { ends: Vec::new(), kernels };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // few and positive
        let fewer = (FIRST_NODES * nodes as f64).ceil() as usize;
        let at_origin = Variable::chebyshev(fewer, &[NEAR_ORIGIN, 1.0]);
        let elsewhere = Variable::chebyshev(nodes, &[1.0]);
        let (mut lower, mut width, mut halvings, mut quiet) = (0.0, plan.width, 0, 0);
        let mut floor: Vec<f64> = plan.kernels.iter().map(|(_, aim)| *aim).collect();
        let mut before = f64::INFINITY;
        let mut values = vec![vec![Values::default(); plan.kernels.len()]; nodes + 2];
        while lower < plan.reach && pieces.ends.len() < MOST_PIECES {
            let upper = if lower + 1.01 * width >= plan.reach { plan.reach } else { lower + width };
            let variable = if lower == 0.0 { &at_origin } else { &elsewhere };
            let place = |v: f64| {
                // (1 + v)/2 without cancellation for the first piece, whose variable is (t/upper)^2.
                if lower == 0.0 { upper * (0.5 * (1.0 + v)).sqrt() } else { lower + (upper - lower) * 0.5 * (1.0 + v) }
            };
            for (values, v) in values.iter_mut().zip(&variable.all) {
                parts(place(*v), values);
            }
            let pieced: Vec<Piece> = plan
                .kernels
                .iter()
                .enumerate()
                .map(|(i, (odd, aim))| {
                    let own: Vec<Sample> =
                        variable.all.iter().zip(&values).map(|(v, all)| (*v, place(*v), all[i])).collect();
                    Piece::through(own.split_at(variable.nodes), lower == 0.0, *odd, *aim)
                })
                .collect();
            // In units of what is wanted, or of the noise once that has shown.
            let worst = pieced
                .iter()
                .zip(&floor)
                .map(|(piece, floor)| piece.error / floor.max(piece.noise))
                .fold(0.0, f64::max);
            let stalled = worst > STALL * before && pieced.iter().all(|piece| piece.error < LARGEST_NOISE);
            if worst > 1.0 && !stalled && halvings < MOST_HALVINGS {
                (before, halvings) = (worst, halvings + 1);
                width *= 0.5;
                continue;
            }
            if worst > 1.0 {
                for (floor, piece) in floor.iter_mut().zip(&pieced) {
                    *floor = floor.max(piece.error);
                }
            }
            let mut far = vec![0.0_f64; plan.kernels.len()];
            for (i, (kernel, piece)) in pieces.kernels.iter_mut().zip(pieced).enumerate() {
                kernel.error = kernel.error.max(piece.error);
                kernel.noise = kernel.noise.max(if stalled { piece.error } else { piece.noise });
                kernel.rows.push(piece.rows);
                for (v, all) in variable.all.iter().zip(&values) {
                    let form = if kernel.odd { -1.0 / place(*v) } else { 0.0 };
                    far[i] = far[i].max((all[i][0] - form).abs() + all[i][1].abs() + all[i][2].abs());
                }
            }
            pieces.ends.push(upper);
            quiet = if far.iter().zip(&floor).all(|(far, floor)| far <= floor) { quiet + 1 } else { 0 };
            if quiet >= 2 && upper > plan.local && upper < plan.reach {
                for (kernel, far) in pieces.kernels.iter_mut().zip(far) {
                    kernel.error = kernel.error.max(far);
                }
                return pieces;
            }
            lower = upper;
            (before, halvings) = (f64::INFINITY, 0);
            width = (1.5 * width).max(WIDENING * lower).min(if lower < plan.local { plan.width } else { WIDEST });
        }
        if lower < plan.reach {
            // Not everything is covered.
            for kernel in &mut pieces.kernels {
                kernel.error = f64::INFINITY;
            }
        }
        pieces
    }
}

/// Where the variable of a piece is sampled: Chebyshev nodes, then the checks.
struct Variable {
    nodes: usize,
    all: Vec<f64>,
}

impl Variable {
    /// An interpolant is worst at the ends of its range.
    fn chebyshev(nodes: usize, checks: &[f64]) -> Self {
        let cosine = |j: usize| (PI * (2 * j + 1) as f64 / (2 * nodes) as f64).cos();
        Self { nodes, all: (0..nodes).map(cosine).chain(checks.iter().copied()).collect() }
    }
}

/// The variable `2 (t/upper)^2 - 1` at a thousandth of the first piece: nearly its lower end, where a kernel whose series
/// is too short is not smooth.
const NEAR_ORIGIN: f64 = -1.0 + 2e-6;

/// One kernel on one piece.
struct Piece {
    rows: Vec<[f64; 4]>,
    error: f64,
    /// What of the error no finer piece removes.
    noise: f64,
}

/// Rounding of the values that are interpolated, over their size: below it nothing is resolved.
const NOISE: f64 = 6.0 * f64::EPSILON;

/// On the piece at the origin an even factor of the logarithm has its error multiplied by up to this: `|log t|`
/// at the smallest distances that two points of a contact have, `exp(-40)` of the thickness.
pub(super) const LARGEST_LOG: f64 = 40.0;

impl Piece {
    /// Through the values at the nodes; those at the `checks`, of which the last is the upper end, show the error.
    ///
    /// The piece `at_origin` has the parity of each part built in: a kernel's smooth part and the factor of its
    /// logarithm are odd when it is (`odd`), the factor of its sign when it is not.
    fn through((nodes, checks): (&[Sample], &[Sample]), at_origin: bool, odd: bool, aim: f64) -> Self {
        let upper = checks.last().expect("a check at the upper end").1;
        let parity = [odd, !odd, odd].map(|odd| odd && at_origin);
        let mut piece = Self { rows: Vec::new(), error: 0.0, noise: 0.0 };
        for part in 0..3 {
            let values: Vec<f64> = nodes.iter().map(|(.., v)| v[part]).collect();
            let mut series = if parity[part] { odd_chebyshev(&values) } else { chebyshev(&values) };
            let weight = match part {
                2 if at_origin && !odd => LARGEST_LOG,
                2 => upper.ln().abs().max(1.0),
                _ => 1.0,
            };
            let noise = NOISE * values.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
            let left_out = remainder(&series, noise);
            // Drop what is not wanted.
            let mut dropped = 0.0;
            while let Some(c) = series.last() {
                if dropped + c.abs() > 0.1 * aim / weight {
                    break;
                }
                dropped += c.abs();
                series.pop();
            }
            let mut powers = monomials(&series, parity[part]);
            if parity[part] {
                // The table multiplies by t.
                for c in &mut powers {
                    *c /= upper;
                }
            }
            let seen = checks.iter().fold(0.0_f64, |most, (v, t, value)| {
                let sum = powers.iter().rev().fold(0.0, |sum, c| sum * v + c);
                most.max((if parity[part] { sum * t } else { sum } - value[part]).abs())
            });
            piece.error += weight * (3.0 * seen.max(left_out) + dropped);
            piece.noise += weight * noise;
            for (power, c) in powers.into_iter().enumerate() {
                if piece.rows.len() <= power {
                    piece.rows.push([0.0; 4]);
                }
                piece.rows[power][part] = c;
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

/// Coefficients of `T_1, T_3, ...` in the odd interpolant through values at `cos((2j + 1) pi/4n)`.
fn odd_chebyshev(values: &[f64]) -> Vec<f64> {
    let n = values.len();
    let cosines: Vec<f64> = (0..8 * n).map(|m| (PI * m as f64 / (4 * n) as f64).cos()).collect();
    let coefficient = |k: usize| {
        let sum: f64 = values.iter().enumerate().map(|(j, v)| v * cosines[(2 * k + 1) * (2 * j + 1) % (8 * n)]).sum();
        sum * 2.0 / n as f64
    };
    (0..n).map(coefficient).collect()
}

/// `sum_k series[k] T_k(v)` in powers of `v`; of an odd series, `sum_k series[k] T_(2k+1)(x)/x` in powers of
/// `v = 2 x^2 - 1`.
fn monomials(series: &[f64], odd: bool) -> Vec<f64> {
    let n = series.len();
    let mut sum = vec![0.0; n];
    let (mut older, mut newer) = (vec![0.0; n], vec![0.0; n]);
    for (k, c) in series.iter().enumerate() {
        let mut next = vec![0.0; n];
        match k {
            0 => next[0] = 1.0,
            // T_1(v) = v; T_3(x)/x = 2 v - 1. Both families go on by the same recurrence.
            1 if odd => (next[0], next[1]) = (-1.0, 2.0),
            1 => next[1] = 1.0,
            _ => {
                for j in 0..n {
                    next[j] = if j > 0 { 2.0 * newer[j - 1] } else { 0.0 } - older[j];
                }
            }
        }
        for (sum, t) in sum.iter_mut().zip(&next) {
            *sum += c * t;
        }
        older = newer;
        newer = next;
    }
    sum
}
