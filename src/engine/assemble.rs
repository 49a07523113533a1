//! A solved contact in the scene's units.

use super::contact::Contact;
use super::finite::first_not_finite;
use super::problem::Problem;
use super::refine::Judged;
use super::solution::{EdgeReport, ErrorReport, LoadReport, PressureReport, Profile, Solution, Status, StickReport};
use super::verdict::worst;
use crate::plan::Plan;
use crate::scene::{Load, Scene};
use slipzone_api::{Refusal, Station};

/// The solution; refused when one of its numbers is not finite.
pub(super) fn solution(
    scene: &Scene,
    plan: Plan,
    problem: &Problem,
    judged: &Judged,
    status: Status,
    reason: Option<String>,
) -> Result<Solution, Refusal> {
    let (length, stress) = (problem.length, problem.stress);
    let number = |path: &str, unit: f64| judged.numbers.get(path).map(|value| value * unit);
    // What the scene gives is reported as given, not after its way through the layer's units.
    let (given_force, given_width, given_depth) = match scene.load {
        Load::Force(force) => (Some(force.get()), None, None),
        Load::HalfWidth(half_width) => (None, Some(half_width.get()), None),
        Load::Indentation(depth) => (None, None, Some(depth.get())),
    };
    let force = given_force.or(number("load.force", stress * length));
    let half_width = given_width.or(number("load.half_width", length));
    let solution = Solution {
        status,
        reason,
        load: LoadReport { force, half_width, indentation: given_depth.or(number("load.indentation", length)) },
        pressure: PressureReport {
            centre: number("pressure.centre", stress),
            mean: force.zip(half_width).map(|(force, b)| force / (2.0 * b)),
            peak: number("pressure.peak", stress),
        },
        edge: EdgeReport {
            stress_intensity: number("edge.stress_intensity", stress * length.sqrt()),
            ratio: number("edge.ratio", 1.0),
        },
        stick: judged.contact.friction.as_ref().map(|_| StickReport {
            half_width: number("stick.half_width", length),
            ratio: number("stick.ratio", 1.0),
            one_minus_ratio: number("stick.one_minus_ratio", 1.0),
            slip: judged.contact.slip(),
        }),
        error: ErrorReport {
            estimate: Some(worst(&judged.errors).1),
            each: judged.errors.clone(),
            how: judged.how.clone(),
        },
        profile: profile(scene, problem, &judged.contact),
        ..Solution::refused(scene, plan, String::new())
    };
    match first_not_finite(&solution) {
        None => Ok(solution),
        Some(number) => Err(Refusal::OutOfReach {
            method: "engine",
            why: format!("a number of the result is not finite: {number}"),
            remedy: "check the sizes of the scene's numbers against each other",
        }),
    }
}

/// Tractions at the points that the scene asks for.
fn profile(scene: &Scene, problem: &Problem, contact: &Contact) -> Profile {
    let b = contact.pressure.half_width;
    let relative: Vec<f64> = scene.output.x.clone().unwrap_or_else(|| {
        let last = scene.output.points - 1;
        // Both halves from the same numbers, so that the samples are exactly symmetric.
        (0..=last).map(|i| (2.0 * i as f64 - last as f64) / last as f64).collect()
    });
    let station = |x: &f64| Station { x: x * b, gap: (1.0 - x.abs()) * b };
    let bounded = |value: f64| value.is_finite().then_some(value * problem.stress);
    let sharp = contact.pressure.edge_factor != 0.0;
    let sample = |at: &dyn Fn(Station) -> f64| -> Vec<Option<f64>> {
        let one = |station: Station| match (station.gap > 0.0, sharp) {
            (true, _) => bounded(at(station)),
            (false, true) => None,
            (false, false) => Some(0.0),
        };
        relative.iter().map(station).map(one).collect()
    };
    Profile {
        x: relative.iter().map(|x| x * b * problem.length).collect(),
        pressure: sample(&|station| contact.pressure.at(station)),
        shear: contact.friction.as_ref().map(|stick| sample(&|station| stick.shear.at(&contact.pressure, station))),
    }
}
