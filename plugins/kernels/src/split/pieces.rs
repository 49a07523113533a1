//! The three parts of the kernels as polynomials over pieces of `|t|`.

use crate::piece::{Kernel, NEAR_ORIGIN, Piece, Pieces, Sample, Values, Variable, place};

/// Where and how the kernels are interpolated.
pub(super) struct Plan {
    /// End of the range.
    pub(super) reach: f64,
    /// Whether far away the odd kernels are `-1/t` and the others nothing, but for what falls exponentially: the layer
    /// is bonded to a rigid base.
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
        let mut pieces = Self { ends: Vec::new(), kernels: vec![Kernel::default(); plan.kernels.len()] };
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
            for (values, v) in values.iter_mut().zip(&variable.all) {
                parts(place(*v, (lower, upper)), values);
            }
            let sampled = Sampled { variable, ends: (lower, upper), values: &values };
            let pieced = sampled.pieces(plan);
            // Parts that cancel each other down to their noise tell nothing, and pieces of it would be without number.
            let told = |i: usize| sampled.largest(i).max(plan.reach.recip());
            if pieced.iter().enumerate().any(|(i, piece)| piece.noise * plan.reach > 1.0 && piece.noise > told(i)) {
                break;
            }
            // In units of what is wanted, or of the noise once that has shown.
            let missed = pieced.iter().zip(&floor).map(|(piece, floor)| piece.error / floor.max(piece.noise));
            let worst = missed.fold(0.0, f64::max);
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
            pieces.take(upper, pieced, stalled);
            let far: Vec<f64> = plan.kernels.iter().enumerate().map(|(i, (odd, _))| sampled.far(i, *odd)).collect();
            quiet = if far.iter().zip(&floor).all(|(far, floor)| far <= floor) { quiet + 1 } else { 0 };
            if plan.is_local && quiet >= 2 && upper > plan.local && upper < plan.reach {
                for (kernel, far) in pieces.kernels.iter_mut().zip(far) {
                    kernel.error = kernel.error.max(far);
                }
                return pieces;
            }
            lower = upper;
            (before, attempts) = (f64::INFINITY, 0);
            width = plan.next_width(lower, width, if stalled { None } else { Some(fit) });
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

impl Plan {
    /// The width tried from `lower` on, after a piece that should have been `fit` times as wide as it was; `None` where
    /// it was noise, which says nothing of a better width.
    fn next_width(&self, lower: f64, width: f64, fit: Option<f64>) -> f64 {
        let widest = match self.is_local {
            _ if lower < self.local => self.widest,
            true => WIDEST,
            false => f64::INFINITY,
        };
        let (least, most) = (width.max(LEAST_WIDENING * lower), (1.5 * width).max(WIDENING * lower));
        fit.map_or(most, |fit| (fit * width).clamp(least, most)).min(widest)
    }
}

/// The kernels between two ends, at all places of a variable.
struct Sampled<'a> {
    variable: &'a Variable,
    ends: (f64, f64),
    values: &'a [Vec<Values>],
}

impl Sampled<'_> {
    /// Where they were sampled, and all of them there.
    fn all(&self) -> impl Iterator<Item = (f64, f64, &Vec<Values>)> {
        self.variable.all.iter().zip(self.values).map(|(v, all)| (*v, place(*v, self.ends), all))
    }

    /// A piece of each kernel.
    fn pieces(&self, plan: &Plan) -> Vec<Piece> {
        let piece = |(i, (odd, aim)): (usize, &(bool, f64))| {
            let own: Vec<Sample> = self.all().map(|(v, t, all)| (v, t, all[i])).collect();
            Piece::through(own.split_at(self.variable.nodes), self.ends.0 == 0.0, *odd, *aim)
        };
        plan.kernels.iter().enumerate().map(piece).collect()
    }

    /// How large a kernel is.
    fn largest(&self, i: usize) -> f64 {
        let whole = |(_, t, all): (f64, f64, &Vec<Values>)| all[i][0] + all[i][1] + t.ln() * all[i][2];
        self.all().map(whole).fold(0.0, |most: f64, k| most.max(k.abs()))
    }

    /// How far a kernel is from what it is far away.
    fn far(&self, i: usize, odd: bool) -> f64 {
        let apart = |(_, t, all): (f64, f64, &Vec<Values>)| {
            let form = if odd { -1.0 / t } else { 0.0 };
            (all[i][0] - form).abs() + all[i][1].abs() + all[i][2].abs()
        };
        self.all().map(apart).fold(0.0, f64::max)
    }
}
