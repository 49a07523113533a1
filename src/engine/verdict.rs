//! Whether a solved contact may be believed.

use super::prepared_layer::PreparedLayer;
use super::problem::Problem;
use super::solution::Status;
use crate::engine::accuracy::quantity::Quantity;
use crate::engine::friction::checks::place;
use crate::engine::friction::linear_strain::SCANNED;
use crate::engine::friction::rubbing::{Rubbing, Verdict};
use crate::engine::friction::stick_zone::StickZone;
use crate::engine::refine::judged::{Judged, ROUNDED, UNKNOWN, of_kernels};
use crate::engine::refine::stage::Stage;

/// A shape that is unsure by more than that, over its height at the contact's edge, is not the punch's.
///
/// Measured on 429 tables of 4 to 1000 rows of powers of `x` from 1.5 to 8, with scatter and without, that reach up to
/// four half-widths: of the 92 with more all forces were off by a fifth or more; of the 286 with less than a twentieth
/// half by less than 0.2 %, and none by more than 18 %.
const UNSURE: f64 = 0.25;

/// In Goodman's approximation friction changes nothing else.
const REST_HOLDS: &str = "; stick zone and shear do not hold, all other numbers do, each within its error";
const NO_ROOT: &str = "no stick zone belongs to this friction coefficient with slip in one direction only";

/// Status and reason of a solved contact.
pub(super) fn verdict(
    layer: &PreparedLayer,
    problem: &Problem,
    stage: &mut Stage,
    judged: &Judged,
    tolerance: f64,
) -> (Status, Option<String>) {
    let Some((status, reason)) = objection(layer, problem, stage, judged, tolerance) else {
        return (Status::Converged, None);
    };
    let ended = judged.stopped.as_ref().map_or(String::new(), |refusal| format!("; refinement ended: {refusal}"));
    (status, Some(reason + &ended))
}

/// The gravest thing to be said against the result.
fn objection(
    layer: &PreparedLayer,
    problem: &Problem,
    stage: &mut Stage,
    judged: &Judged,
    tolerance: f64,
) -> Option<(Status, String)> {
    let half_width = judged.outcome.numbers.get(Quantity::HalfWidth)?;
    let of_shape = problem.flaw(half_width).map(|flaw| problem.objection(&flaw));
    if let Some(why) = of_shape.or_else(|| problem.unsure(half_width, UNSURE)) {
        return Some((Status::AssumptionViolated, why));
    }
    let (worst, error) = judged.errors.worst().unwrap_or((Quantity::Force, 0.0));
    let inexact = || {
        let force = judged.outcome.numbers.get(Quantity::Force);
        let why = if force.is_some_and(|force| force < 0.0) {
            "; the force found is below nothing: the punch lifts off before, and contact with gaps is not modelled"
        } else if error < ROUNDED {
            "; double precision allows no more"
        } else if judged.outcome.size.is_some_and(|size| size.missed > 0.5 * error) {
            "; so little of the half-width lies beyond the punch's face that double precision allows no more: prescribe the half-width, whose \
             force is more accurate"
        } else if problem.layer.law.broken_power().is_some()
            && !layer.begins_with_a_power()
            && judged.outcome.numbers.get(Quantity::HalfWidth).and_then(|b| layer.kernel_error(b))
                > Some(0.5 * tolerance)
        {
            "; the modulus begins at the surface with a power of the depth that is no whole number, and of its kernels little \
             can be proved: leave out `kernel` and `quadrature`, or take `octaves` and `graded-panels`"
        } else if of_kernels(layer, &judged.outcome) > 0.5 * error {
            "; what is proved of the kernels leaves as much at every resolution: take a larger `tolerance`"
        } else {
            ""
        };
        let name = worst.path();
        (
            Status::NotConverged,
            format!("estimated error {error:.1e} of {name} exceeds the tolerance {tolerance:.1e}{why}"),
        )
    };
    if let Some(doubt) = judged.doubt.filter(|doubt| *doubt > UNKNOWN) {
        let untold =
            || format!("the pressure is uncertain by {doubt:.1e} of itself: where the punch lifts off cannot be known");
        return Some(if error > tolerance { inexact() } else { (Status::NotConverged, untold()) });
    }
    let rubbing = judged.outcome.rubbing.as_ref();
    if let Some((x, p)) = stage.tension(layer, problem, &judged.outcome) {
        let why = format!(
            "the pressure is negative, {p:.4} times the mean at {} on either side: the punch lifts off there, and \
             contact with gaps is not modelled",
            place(x)
        );
        let has_root = rubbing.is_none_or(|rubbing| rubbing.verdict != Verdict::NoRoot);
        return Some((Status::AssumptionViolated, if has_root { why } else { format!("{why}; {NO_ROOT}") }));
    }
    let of_stick = rubbing.and_then(|rubbing| of_stick(rubbing, problem.is_stacked()));
    of_stick.or_else(|| (error > tolerance).then(inexact))
}

/// What is to be said against a stick zone, of a contact that grew or one that did not.
fn of_stick(rubbing: &Rubbing, has_grown: bool) -> Option<(Status, String)> {
    match &rubbing.verdict {
        Verdict::Holds | Verdict::Sticks | Verdict::NoShear => None,
        Verdict::Fails(what) => {
            let why = format!("no stick zone satisfies the conditions of friction: {what}{REST_HOLDS}");
            Some((Status::AssumptionViolated, why))
        }
        Verdict::Unbuilt(how) => {
            Some((Status::AssumptionViolated, format!("the stick zone is not solved: {how}{REST_HOLDS}")))
        }
        Verdict::Untold(why) => Some((Status::NotConverged, format!("the stick zone cannot be found: {why}"))),
        Verdict::NoRoot => Some((Status::AssumptionViolated, format!("{NO_ROOT}{REST_HOLDS}"))),
        Verdict::NotScanned => {
            let [narrowest, widest] = [SCANNED.start(), SCANNED.end()].map(|lambda| StickZone::from_log(*lambda, 1.0));
            let why = format!(
                "no stick zone between a/b = {:.0e} and 1 - a/b = {:.0e} belongs to this friction coefficient and a strain \
                 C|x|, and no other is looked for: leave out `strain`",
                narrowest.ratio(),
                widest.one_minus_ratio()
            );
            Some((Status::NotConverged, why))
        }
        Verdict::TooNarrow => {
            let shear = if has_grown { "the shear is not solved" } else { "the shear is that of full sliding" };
            let why = format!(
                "the stick zone is narrower than {:.1e} of the contact, the narrowest looked for: practically full sliding; the \
                 stick zone reported is an upper bound, and {shear}",
                rubbing.zone.ratio()
            );
            Some((Status::NotConverged, why))
        }
    }
}
