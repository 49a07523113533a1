//! The result of a scene (docs: `docs/formats.md`). Lengths, stresses and forces in the scene's units.

use super::contact::Contact;
use super::finite::first_not_finite;
use super::problem::Problem;
use super::refine::{Judged, worst};
use crate::scene::{Load, Scene, Units};
use serde::Serialize;
use slipzone_api::{Base, Friction, Plane, Refusal, Station};
use std::collections::BTreeMap;

/// How a solve ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Every number is within the error stated.
    Converged,
    /// The best numbers found; their error estimate exceeds the tolerance.
    NotConverged,
    /// The numbers solve the equations, but a condition that the model rests on fails.
    AssumptionViolated,
    /// No numbers: the method or the combination is out of reach.
    Refused,
}

/// A solved scene. The keys of its JSON are stable: added to, never renamed.
#[derive(Clone, Debug, Serialize)]
pub struct Solution {
    /// Version of the result format; 1.
    pub format: u32,
    /// What solved it.
    pub program: Program,
    /// The scene as solved, defaults filled in.
    pub scene: Scene,
    /// Labels of the units.
    pub units: Units,
    /// How it ended.
    pub status: Status,
    /// What failed, where, and what to do; `None` when converged.
    pub reason: Option<String>,
    /// Force, contact size, indentation.
    pub load: LoadReport,
    /// Pressure at a few points.
    pub pressure: PressureReport,
    /// Stress intensity at the contact's edge.
    pub edge: EdgeReport,
    /// The stick zone; `None` without friction.
    pub stick: Option<StickReport>,
    /// How sure the numbers are.
    pub error: ErrorReport,
    /// How they were got.
    pub plan: Plan,
    /// Tractions along the contact.
    pub profile: Profile,
    /// What the model takes for granted.
    pub assumptions: Vec<String>,
}

/// Name and version of the program.
#[derive(Clone, Debug, Serialize)]
pub struct Program {
    /// `slipzone`.
    pub name: &'static str,
    /// Its version.
    pub version: &'static str,
}

/// Load and what it does.
#[derive(Clone, Debug, Default, Serialize)]
pub struct LoadReport {
    /// Normal force per unit length.
    pub force: Option<f64>,
    /// Half-width of the contact.
    pub half_width: Option<f64>,
    /// Depth of the punch; `None` on a half-plane, where it is undefined.
    pub indentation: Option<f64>,
}

/// Pressure at a few points.
#[derive(Clone, Debug, Default, Serialize)]
pub struct PressureReport {
    /// At `x = 0`.
    pub centre: Option<f64>,
    /// Force over contact width.
    pub mean: Option<f64>,
    /// The largest; `None` where it is unbounded.
    pub peak: Option<f64>,
}

/// The edge of the contact.
#[derive(Clone, Debug, Default, Serialize)]
pub struct EdgeReport {
    /// `lim sqrt(2 (b - x)) p(x)`; 0 at a smooth edge.
    pub stress_intensity: Option<f64>,
    /// `stress_intensity sqrt(b)/P`, the `F_I/F_0` of CC13 Table 1.
    pub ratio: Option<f64>,
}

/// Direction in which the surface slides beside the stick zone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Slip {
    /// Towards the middle: `q = +eta p` for `x > a`.
    Inward,
    /// Away from the middle: `q = -eta p` for `x > a`.
    Outward,
}

/// The stick zone.
#[derive(Clone, Debug, Serialize)]
pub struct StickReport {
    /// `a`.
    pub half_width: Option<f64>,
    /// `a/b`.
    pub ratio: Option<f64>,
    /// `1 - a/b`, without cancellation.
    pub one_minus_ratio: Option<f64>,
    /// Direction of slip.
    pub slip: Option<Slip>,
}

/// Error estimates, relative.
#[derive(Clone, Debug, Default, Serialize)]
pub struct ErrorReport {
    /// The largest of `each`; `None` when refused.
    pub estimate: Option<f64>,
    /// One estimate for each number reported, by its path, such as `edge.ratio`.
    pub each: BTreeMap<String, f64>,
    /// How they were got, in words.
    pub how: String,
}

/// How the numbers were got.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Plan {
    /// Grading, by its `type`.
    pub grading: String,
    /// Flexibility, by its `type`.
    pub flexibility: String,
    /// Kernel strategy, by its `type`.
    pub kernel: String,
    /// Quadrature, by its `type`.
    pub quadrature: String,
    /// Unknowns of the finest pressure problem.
    pub unknowns: usize,
    /// Wave numbers at which the flexibility was evaluated, all resolutions together.
    pub flexibility_evaluations: usize,
    /// Matrices factorised, all resolutions together.
    pub factorisations: usize,
    /// Why each choice was made.
    pub reasons: Vec<String>,
}

/// Tractions along the contact, equally spaced unless the scene lists its own points.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Profile {
    /// Abscissae.
    pub x: Vec<f64>,
    /// Pressure; `None` where it is unbounded.
    pub pressure: Vec<Option<f64>>,
    /// Shear traction on the surface along +x; absent without friction.
    pub shear: Option<Vec<Option<f64>>>,
}

impl Solution {
    /// A solution without numbers: everything that the scene alone tells, and the reason.
    pub(crate) fn refused(scene: &Scene, plan: Plan, reason: String) -> Self {
        Self {
            format: 1,
            program: Program { name: env!("CARGO_PKG_NAME"), version: env!("CARGO_PKG_VERSION") },
            scene: scene.clone(),
            units: scene.units.clone(),
            status: Status::Refused,
            reason: Some(reason),
            load: LoadReport::default(),
            pressure: PressureReport::default(),
            edge: EdgeReport::default(),
            stick: None,
            error: ErrorReport::default(),
            plan,
            profile: Profile::default(),
            assumptions: assumptions(scene),
        }
    }
}

/// A solved contact in the scene's units.
pub(super) fn assemble(
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

/// What the numbers rest on.
fn assumptions(scene: &Scene) -> Vec<String> {
    let plane = match scene.layer.plane {
        Plane::Strain => "plane strain",
        Plane::Stress => "plane stress",
    };
    let base = match scene.layer.base {
        Base::Rigid => "bonded to a rigid base",
        Base::Frictionless => "resting on a rigid base without friction",
        Base::HalfPlane { .. } => "bonded to an elastic half-plane",
        Base::Infinite => "no base: the solid goes on for ever; the indentation is undefined",
    };
    let friction = match scene.friction {
        Some(Friction::Goodman { .. }) => {
            "Goodman: q does not change p; one stick zone, slip in one direction on either side; force grown from zero"
        }
        None => "no friction",
    };
    let common = "linear elasticity, small strains, rigid punch, symmetric normal load";
    [plane, base, friction, common].map(String::from).to_vec()
}
