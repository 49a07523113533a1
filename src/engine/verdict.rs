//! Whether a solved contact may be believed.

use super::checks;
use super::contact::{Stick, Verdict};
use super::problem::Problem;
use super::refine::Judged;
use super::solution::Status;
use std::collections::BTreeMap;

/// A pressure less certain than this, relative, is no ground for saying that it pulls.
const UNRESOLVED: f64 = 0.1;

/// Status and reason of a solved contact.
pub(super) fn verdict(problem: &Problem, judged: &Judged, tolerance: f64) -> (Status, Option<String>) {
    let Some((status, reason)) = objection(problem, judged, tolerance) else {
        return (Status::Converged, None);
    };
    let ended = judged.stopped.as_ref().map_or(String::new(), |refusal| format!("; refinement ended: {refusal}"));
    (status, Some(reason + &ended))
}

/// The gravest thing to be said against the result.
fn objection(problem: &Problem, judged: &Judged, tolerance: f64) -> Option<(Status, String)> {
    let (name, error) = worst(&judged.errors);
    let inexact = || {
        (Status::NotConverged, format!("estimated error {error:.1e} of {name} exceeds the tolerance {tolerance:.1e}"))
    };
    if judged.errors.get("pressure.centre").is_some_and(|e| *e > UNRESOLVED) {
        return Some(inexact());
    }
    if let Some((x, p)) = checks::tension(&judged.contact.pressure) {
        let why = format!(
            "the pressure is negative, {p:.4} times the mean at |x| = {x:.4} b: the punch lifts off there, and contact \
             with gaps is not modelled"
        );
        return Some((Status::AssumptionViolated, why));
    }
    if !problem.is_convex() {
        let why = "the punch is not convex: the contact may break up into several";
        return Some((Status::AssumptionViolated, why.into()));
    }
    let of_stick =
        judged.contact.friction.as_ref().and_then(|stick| of_stick(stick, judged.contact.pressure.half_width));
    of_stick.or_else(|| (error > tolerance).then(inexact))
}

/// What is to be said against a stick zone in a contact of half-width `b`.
fn of_stick(stick: &Stick, b: f64) -> Option<(Status, String)> {
    let zone = stick.shear.zone;
    match &stick.verdict {
        Verdict::Holds | Verdict::NoShear => None,
        Verdict::Fails(what) => {
            let why = format!("no stick zone satisfies the conditions of friction: {what}");
            Some((Status::AssumptionViolated, why))
        }
        Verdict::None => {
            let why = "no stick zone belongs to this friction coefficient with slip in one direction only";
            Some((Status::AssumptionViolated, why.into()))
        }
        Verdict::TooNarrow => {
            let why = format!(
                "the stick zone is narrower than {:.1e} of the contact, the narrowest looked for; the stick zone \
                 reported is an upper bound, the shear that of full sliding",
                zone.half_width / b
            );
            Some((Status::NotConverged, why))
        }
        Verdict::TooWide => {
            let why = format!(
                "the surface sticks to within {:.1e} of the contact's edge, as close as this resolution can tell; the \
                 stick zone reported is a lower bound",
                zone.slip_width / b
            );
            Some((Status::NotConverged, why))
        }
    }
}

/// The least certain number, by its path, and its error.
pub(super) fn worst(errors: &BTreeMap<String, f64>) -> (&str, f64) {
    errors.iter().fold(("", 0.0), |worst, (name, e)| if *e > worst.1 { (name.as_str(), *e) } else { worst })
}
