//! What the resolutions solved so far tell of the error.

use super::FINEST;
use super::aim::Aim;
use super::ladder::FAINT;
use crate::engine::accuracy::error_estimate::{Fastest, ROUNDING, SLIP_ROUNDING, Seen, extrapolated};
use crate::engine::accuracy::quantity::{Numbers, Quantity};
use crate::engine::outcome::Outcome;
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::problem::Problem;
use crate::engine::refine::judged::{
    ROUNDED, hidden_details, is_pressure_known, meets, mended, share_in_middle, with_the_rest, worst_judged,
};
use arrayvec::ArrayVec;

/// Steps in a row that have to stop shrinking.
const STALLED: usize = 3;
/// Errors that shrink below this share of what no step mends are not worth another one.
const BESIDE_REST: f64 = 0.5;
/// Distance of the unknowns in the middle of a contact, over the half-width and times their number, and over the
/// kernels' length where these are not seen.
const WIDE: f64 = 5.5;
const UNSEEN: f64 = 3.0;
/// An edge beyond a face that is narrower than this over the contact: force and pressure are there what flat punches
/// are beside their ends, known like values between nodes, whose errors wave with the resolution, and not like
/// integrals.
///
/// Edges of 1e-5 and 1e-7 were off by up to 32 estimates, and 58 tolerances, without.
const NARROW_EDGE: f64 = 1e-3;
/// Times as stiff as the surface is what lies a half-width below, under laws that begin with a broken power, from which
/// on that power begins so near to the surface that resolutions agree by chance on what is between.
///
/// Of 690 numbers of flat punches on surfaces 1e3 to 1e7 times as soft 63 were off by more than three estimates, by up
/// to 145, without; of 490 with it 12, by up to 34, on the softest, where errors of the kernels count for more than
/// they are taken to. On those 100 times as soft none.
const TURNS: f64 = 200.0;

/// What the resolutions solved so far tell of the error.
#[derive(Default)]
pub(super) struct Estimate {
    pub(super) history: ArrayVec<Seen, { FINEST + 1 }>,
    pub(super) errors: Numbers,
    /// Of the shear itself, where it is asked for.
    pub(super) of_shear: Option<f64>,
    /// Whether the tolerance is met.
    pub(super) met: bool,
    /// Whether the last step told that no other will help.
    pub(super) is_hopeless: bool,
    /// For how many steps in a row the errors have not shrunk any more.
    stalled: usize,
}

impl Estimate {
    /// Before it is one resolution alone.
    pub(super) fn beginning_with(outcome: &Outcome) -> Self {
        Self { history: ArrayVec::from_iter([outcome.seen()]), ..Self::default() }
    }

    /// Whether the errors are told at all.
    pub(super) fn is_told(&self) -> bool {
        self.errors != Numbers::default()
    }

    /// Takes note of a finer resolution; whether it is fine enough, or no finer one would be any better. `has_kernels`
    /// is whether those that come would be solved with the same kernels.
    pub(super) fn add(
        &mut self,
        layer: &PreparedLayer,
        aim: Aim,
        outcome: &Outcome,
        (unknowns, has_kernels): (usize, bool),
    ) -> bool {
        let Aim { problem, tolerance, .. } = aim;
        self.history.push(outcome.seen());
        let fastest = fastest(layer, problem, outcome, unknowns);
        let Some(estimate) = extrapolated(&self.history, fastest) else { return false };
        // All may agree on what none of them sees.
        let mut estimate = estimate.plus(hidden_details(problem, outcome, unknowns));
        self.of_shear = estimate.take(Quantity::Shear).filter(|_| problem.wishes.profile);
        let now = worst_judged(problem, &estimate).map_or(0.0, |(_, error)| error);
        // Two alone do not tell that more of them are vain, nor more than what happens to agree where one number is far
        // less sure than all others.
        if self.history.len() < 3 && (now > tolerance || share_in_middle(outcome) < FAINT) {
            return false;
        }
        let is_stalled =
            now < ROUNDED && worst_judged(problem, &self.errors).is_some_and(|(_, before)| now > 0.5 * before);
        self.errors = estimate;
        let all = with_the_rest(problem, layer, outcome, tolerance, estimate);
        // Stick zones may agree under a pressure that is none.
        self.met = (meets(problem, &all, tolerance) || now <= 2.0 * ROUNDING) && is_pressure_known(problem, &all);
        self.stalled = if is_stalled { self.stalled + 1 } else { 0 };
        let is_done = self.met || self.stalled >= STALLED;
        is_done || is_vain(problem, outcome, tolerance, (&estimate, &all), has_kernels)
    }
}

/// Whether no finer step brings the errors told, and all that stands beside them, below the tolerance: what none of
/// them mends is above it, and what they would mend is little beside that. They mend neither what a stack loses nor a
/// law that was smoothed, nor kernels as good as they get where those that come would be the same, and claim no number
/// of the shear to more digits than its integrals have.
fn is_vain(
    problem: &Problem,
    outcome: &Outcome,
    tolerance: f64,
    (told, all): (&Numbers, &Numbers),
    has_kernels: bool,
) -> bool {
    let lost = outcome.lost.map_or(0.0, |lost| lost.stacked);
    // A finer step may miss less of the load, which counts for more beside a faint pressure in the middle.
    let missed = outcome.size.map_or(0.0, |size| size.missed) / share_in_middle(outcome);
    let unmended = |(quantity, error): (Quantity, f64)| {
        let beside = all.get(quantity).filter(|_| has_kernels);
        let rest = beside.map_or(0.0, |all| all - error - missed - mended(outcome, quantity));
        let least = if quantity.is_of_shear() { SLIP_ROUNDING } else { ROUNDING };
        (lost.max(least), rest)
    };
    let judged = told.judged_by(problem.wishes);
    let is_beyond = |told: (Quantity, f64)| {
        let (least, rest) = unmended(told);
        least.max(rest) > tolerance
    };
    let is_small = |told: (Quantity, f64)| {
        let (least, rest) = unmended(told);
        told.1 <= tolerance.max(least).max(BESIDE_REST * rest)
    };
    judged.iter().any(is_beyond) && judged.iter().all(is_small)
}

/// How fast resolutions of so many unknowns may come; few stand too far apart to see the layer, or a narrow edge, or
/// how the kernel of a soft surface turns into a power of the distance.
pub(super) fn fastest(layer: &PreparedLayer, problem: &Problem, outcome: &Outcome, unknowns: usize) -> Fastest {
    let half_width = outcome.numbers.get(Quantity::HalfWidth).unwrap_or(0.0);
    // All of the contact where there is no face, none where there is nothing else.
    let edge = half_width - problem.face();
    let below = || problem.layer.material(&*problem.layer.law, half_width.min(1.0)).shear;
    match layer.is_proven() {
        _ if layer.begins_with_a_power() && below() > TURNS => Fastest::UNSEEN,
        _ if edge > 0.0 && edge < NARROW_EDGE * half_width => Fastest::UNSEEN,
        _ if WIDE * half_width > UNSEEN * layer.length() * unknowns as f64 => Fastest::UNSEEN,
        true => Fastest::PROVEN,
        false => Fastest::UNPROVEN,
    }
}
