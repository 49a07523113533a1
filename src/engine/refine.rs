//! Refines a scene until its error estimate meets the tolerance.

use super::contact::{Contact, Verdict};
use super::error_estimate::{Numbers, extrapolated, judged_by_twin};
use super::layer::{Layer, Work};
use super::problem::Problem;
use super::{Plan, Solution, Status, checks, solution};
use crate::scene::Scene;
use slipzone_api::Refusal;
use std::collections::BTreeMap;

/// Finest resolution: 2^6 times the coarsest.
const FINEST: u32 = 6;
/// Resolution from which a stick zone out of reach is no longer searched for.
const BOUND_LEVEL: u32 = 4;
/// Extra resolution of what the scene left open beside a method that it fixed: of the other method, and of
/// the slip zones.
const BESIDE_PINNED: u32 = 3;

/// A solved contact, how sure it is, and how that is known.
pub(super) struct Judged {
    pub(super) contact: Contact,
    pub(super) numbers: Numbers,
    pub(super) errors: BTreeMap<String, f64>,
    pub(super) how: String,
    /// Why refinement ended before the tolerance was met.
    pub(super) stopped: Option<String>,
}

/// Solves a scene whose methods are all filled in.
pub(super) fn to_tolerance(scene: &Scene, mut plan: Plan) -> Result<Solution, Refusal> {
    let problem = Problem::new(scene)?;
    let missing =
        || Refusal::NotBuilt { what: "a scene without methods".into(), remedy: "fill in the plan first".into() };
    let flexibility = scene.solver.flexibility.as_ref().ok_or_else(missing)?;
    let kernel = scene.solver.kernel.as_ref().ok_or_else(missing)?;
    let quadrature = scene.solver.quadrature.as_ref().ok_or_else(missing)?;
    let response = flexibility.respond(&problem.layer)?;
    let work = Work::default();
    let tolerance = scene.solver.tolerance.get();
    let at_level = |kernel_level: u32, quadrature_level: u32, level: u32, coarser: Option<&Contact>| {
        let strategy = kernel.refined(kernel_level);
        let quadrature = quadrature.refined(quadrature_level);
        let mut layer = Layer::new(&problem, response.as_ref(), strategy.as_ref(), quadrature.as_ref(), &work);
        let contact = Contact::solve(&mut layer, tolerance, level, coarser)?;
        Ok::<_, Refusal>(contact)
    };

    let mut judged = if kernel.is_pinned() || quadrature.is_pinned() {
        let kernel_level = if kernel.is_pinned() { 0 } else { BESIDE_PINNED };
        let quadrature_level = if quadrature.is_pinned() { 0 } else { BESIDE_PINNED };
        let contact = at_level(kernel_level, quadrature_level, BESIDE_PINNED, None)?;
        let twin = at_level(kernel_level + 1, quadrature_level + 1, BESIDE_PINNED + 1, Some(&contact))?;
        let numbers = contact.numbers();
        let errors = judged_by_twin(&numbers, &twin.numbers());
        let how = "resolution fixed by the scene, compared with a twin of twice the resolution".into();
        Judged { contact, numbers, errors, how, stopped: None }
    } else {
        refined(tolerance, |level, coarser| at_level(level, level, level, coarser))?
    };
    // A bound does not change with the resolution, or does by chance: differences say nothing of its error.
    judged.errors.extend(bound_of_stick(&judged.contact).unwrap_or_default());
    for given in problem.given() {
        judged.errors.insert(given.into(), 0.0);
    }
    plan.unknowns = judged.contact.pressure.size();
    plan.flexibility_evaluations = work.flexibility_evaluations.get();
    plan.factorisations = work.factorisations.get();
    let (status, reason) = verdict(scene, &problem, &judged);
    solution::assemble(scene, plan, &problem, &judged, status, reason)
}

/// Doubles the resolution until the estimate meets the tolerance.
fn refined(
    tolerance: f64,
    at_level: impl Fn(u32, Option<&Contact>) -> Result<Contact, Refusal>,
) -> Result<Judged, Refusal> {
    let mut history: Vec<Numbers> = Vec::new();
    let mut contact: Option<Contact> = None;
    let mut stopped = None;
    let mut errors = BTreeMap::new();
    for level in 0..=FINEST {
        match at_level(level, contact.as_ref()) {
            Ok(next) => {
                history.push(next.numbers());
                contact = Some(next);
            }
            Err(refusal) if history.len() >= 3 => {
                stopped = Some(refusal.to_string());
                break;
            }
            Err(refusal) => return Err(refusal),
        }
        if let Some(estimate) = extrapolated(&history) {
            errors = estimate;
            if errors.values().all(|e| *e <= tolerance) {
                break;
            }
        }
        if level >= BOUND_LEVEL && contact.as_ref().and_then(bound_of_stick).is_some() {
            break;
        }
    }
    let (Some(contact), Some(numbers)) = (contact, history.pop()) else {
        unreachable!("level 0 returned or was pushed")
    };
    let how = format!("differences between {} resolutions, each twice the one before, extrapolated", history.len() + 1);
    Ok(Judged { contact, numbers, errors, how, stopped })
}

/// Errors of a stick zone that is only bounded, not found; `None` where it is found.
fn bound_of_stick(contact: &Contact) -> Option<BTreeMap<String, f64>> {
    let stick = contact.friction.as_ref()?;
    let b = contact.pressure.half_width;
    let (ratio, one_minus) = (stick.shear.zone.half_width / b, stick.shear.zone.slip_width / b);
    let (of_ratio, of_gap) = match stick.verdict {
        Verdict::TooNarrow => (1.0, ratio / one_minus),
        Verdict::TooWide => (one_minus / ratio, 1.0),
        _ => return None,
    };
    let each = [("stick.half_width", of_ratio), ("stick.ratio", of_ratio), ("stick.one_minus_ratio", of_gap)];
    Some(each.map(|(name, error)| (name.to_owned(), error)).into())
}

/// Status and reason of a solved scene.
fn verdict(scene: &Scene, problem: &Problem, judged: &Judged) -> (Status, Option<String>) {
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
    let (tolerance, worst) = (scene.solver.tolerance.get(), worst(&judged.errors));
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
