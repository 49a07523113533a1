//! The three parts of the kernels as polynomials over pieces of `|t|`.

use super::piece::{NEAR_ORIGIN, Piece, Sample, Values, Variable};

/// Where and how the kernels are interpolated.
pub(super) struct Plan {
    /// End of the range.
    pub(super) reach: f64,
    /// Whether far away the odd kernels are `-1/t` and the others nothing, but for what falls exponentially: the layer is
    /// bonded to a rigid base.
    pub(super) is_local: bool,
    /// First width tried.
    pub(super) width: f64,
    /// Widest where the singular parts are not gone.
    pub(super) widest: f64,
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
    pub(super) rows: Vec<Vec<[f64; 3]>>,
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
/// And it is tried with this part of `t` at least.
const LEAST_WIDENING: f64 = 0.1;
/// Widest piece, in units of the thickness.
const WIDEST: f64 = 4.0;
/// A piece is made as wide as should leave this part of the error that it may have.
const SAFE: f64 = 0.4;
/// By how much one that fails is made narrower at first; if it fails again, by the first of these.
const NARROWER: (f64, f64) = (0.5, 0.85);
/// A piece that was narrowed and has not come below this part of its error is as good as it gets: noise.
const STALL: f64 = 0.6;
/// No noise is larger than this.
const LARGEST_NOISE: f64 = 1e-11;
/// A piece is made narrower as often as this before its error is accepted as it is.
const MOST_ATTEMPTS: u32 = 12;

impl Pieces {
    /// Interpolates `parts(t)`, which fills one [`Values`] per kernel, with `nodes` of them in a piece.
    ///
    /// On a rigid base the pieces end where each kernel has become what it is far away: `-1/t` if it is odd and nothing
    /// otherwise. What is left there falls exponentially; two pieces running must agree.
    pub(super) fn new(plan: &Plan, nodes: usize, mut parts: impl FnMut(f64, &mut [Values])) -> Self {
        let kernels = plan.kernels.iter().map(|(odd, _)| Kernel { odd: *odd, ..Kernel::default() }).collect();
        let mut pieces = Self { ends: Vec::new(), kernels };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // few and positive
        let fewer = (FIRST_NODES * nodes as f64).ceil() as usize;
        let at_origin = Variable::chebyshev(fewer, &[NEAR_ORIGIN, 1.0]);
        let elsewhere = Variable::chebyshev(nodes, &[1.0]);
        let (mut lower, mut width, mut attempts, mut quiet) = (0.0, plan.width, 0, 0);
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
            // Parts that cancel each other down to their noise tell nothing, and pieces of it would be without number.
            let told = |i: usize| {
                let whole = |(v, all): (&f64, &Vec<Values>)| all[i][0] + all[i][1] + place(*v).ln() * all[i][2];
                let largest = variable.all.iter().zip(&values).map(whole).fold(0.0, |most: f64, k| most.max(k.abs()));
                largest.max(plan.reach.recip())
            };
            if pieced.iter().enumerate().any(|(i, piece)| piece.noise * plan.reach > 1.0 && piece.noise > told(i)) {
                break;
            }
            // In units of what is wanted, or of the noise once that has shown.
            let worst = pieced
                .iter()
                .zip(&floor)
                .map(|(piece, floor)| piece.error / floor.max(piece.noise))
                .fold(0.0, f64::max);
            // The error grows with the width to the power of the number of nodes.
            let fit = (SAFE / worst).powf((variable.nodes as f64).recip());
            let stalled = worst > STALL * before && pieced.iter().all(|piece| piece.error < LARGEST_NOISE);
            if worst > 1.0 && !stalled && attempts < MOST_ATTEMPTS {
                width *= if attempts == 0 { fit.clamp(NARROWER.0, NARROWER.1) } else { NARROWER.0 };
                (before, attempts) = (worst, attempts + 1);
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
            if plan.is_local && quiet >= 2 && upper > plan.local && upper < plan.reach {
                for (kernel, far) in pieces.kernels.iter_mut().zip(far) {
                    kernel.error = kernel.error.max(far);
                }
                return pieces;
            }
            lower = upper;
            (before, attempts) = (f64::INFINITY, 0);
            let widest = if plan.is_local { WIDEST } else { f64::INFINITY };
            let widest = if lower < plan.local { plan.widest } else { widest };
            // Noise says nothing of a better width.
            let (least, most) = (width.max(LEAST_WIDENING * lower), (1.5 * width).max(WIDENING * lower));
            width = if stalled { most } else { (fit * width).clamp(least, most) }.min(widest);
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
