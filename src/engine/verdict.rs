//! Whether a solved contact may be believed.

use super::checks;
use super::contact::Verdict;
use super::problem::Problem;
use super::refine::Judged;
use super::solution::Status;
use std::collections::BTreeMap;

/// Status and reason of a solved scene.
pub(super) fn verdict(problem: &Problem, judged: &Judged, tolerance: f64) -> (Status, Option<String>) {
    let violated = |why: String| (Status::AssumptionViolated, Some(why));
    if let Some((x, p)) = checks::tension(&judged.contact.pressure) {
        return violated(format!(
            "the pressure is negative, {p:.4} times the mean at |x| = {x:.4} b: the punch lifts off there, and \
             contact with gaps is not modelled"
        ));
    }
    if !problem.is_convex() {
        return violated("the punch is not convex: the contact may break up into several".into());
    }
    if let (Some(stick), Some(eta)) = (&judged.contact.friction, problem.friction) {
        let zone = stick.shear.zone;
        let b = judged.contact.pressure.half_width;
        let not_converged = |why: String| (Status::NotConverged, Some(why));
        match &stick.verdict {
            Verdict::Holds => {}
            Verdict::Fails(what) => {
                return violated(format!("no stick zone satisfies the conditions of friction: {what}"));
            }
            Verdict::None => {
                return violated(format!(
                    "no stick zone belongs to a friction coefficient of {eta} with slip in one direction only"
                ));
            }
            Verdict::TooNarrow => {
                return not_converged(format!(
                    "the stick zone is narrower than {:.1e} of the contact, the narrowest looked for; its tractions are those reported, full sliding but for that",
                    zone.half_width / b
                ));
            }
            Verdict::TooWide => {
                return not_converged(format!(
                    "the surface sticks to within {:.1e} of the contact's edge, which is as close as this resolution can tell; the stick zone reported is a lower bound",
                    zone.slip_width / b
                ));
            }
        }
    }
    let worst = worst(&judged.errors);
    if worst.1 <= tolerance {
        return (Status::Converged, None);
    }
    let why = match &judged.stopped {
        Some(refusal) => format!("; refinement ended: {refusal}"),
        None => String::new(),
    };
    let reason = format!("estimated error {:.1e} of {} exceeds the tolerance {tolerance:.1e}{why}", worst.1, worst.0);
    (Status::NotConverged, Some(reason))
}

/// The least certain number.
pub(super) fn worst(errors: &BTreeMap<String, f64>) -> (&str, f64) {
    errors.iter().fold(("", 0.0), |worst, (name, e)| if *e > worst.1 { (name.as_str(), *e) } else { worst })
}
