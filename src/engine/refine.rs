//! Refines a scene until its error estimate meets the tolerance.

use super::checks::tension;
use super::contact::{Contact, Verdict};
use super::error_estimate::{Numbers, extrapolated, judged_by_twin};
use super::layer::{Layer, Work};
use super::problem::Problem;
use crate::plan::Methods;
use slipzone_api::Refusal;
use std::collections::BTreeMap;

/// Finest resolution: 2^6 times the coarsest.
const FINEST: u32 = 6;
/// Resolution from which refinement no longer helps a stick zone out of reach, or a pressure that pulls.
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

/// Solves a problem with the methods given.
pub(super) fn to_tolerance(
    problem: &Problem,
    methods: &Methods,
    tolerance: f64,
    work: &Work,
) -> Result<Judged, Refusal> {
    let Methods { flexibility, kernel, quadrature } = methods;
    let response = flexibility.respond(&problem.layer)?;
    let at_level = |kernel_level: u32, quadrature_level: u32, level: u32, coarser: Option<&Contact>| {
        let (kernel, quadrature) = (kernel.refined(kernel_level), quadrature.refined(quadrature_level));
        let mut layer = Layer::new(problem, response.as_ref(), kernel.as_ref(), quadrature.as_ref(), work);
        Contact::solve(&mut layer, tolerance, level, coarser)
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
    Ok(judged)
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
        let is_hopeless = |contact: &Contact| bound_of_stick(contact).is_some() || tension(&contact.pressure).is_some();
        if level >= BOUND_LEVEL && contact.as_ref().is_some_and(is_hopeless) {
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
