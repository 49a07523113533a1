//! Solutions made by hand, for the tests of the reports. Their shapes are right, their digits need not be.

use crate::engine::{
    Curve, EdgeReport, ErrorReport, LoadReport, Plan, PressureReport, Profile, Slip, Solution, Status, StickReport,
};
use crate::scene::Scene;
use std::f64::consts::PI;

fn scene(toml: &str) -> Scene {
    crate::link_plugins();
    toml::from_str(toml).expect("the samples are well-formed")
}

/// The scene that the reports of a [`flat`] punch carry.
fn flat_scene(eta: f64) -> Scene {
    let toml = "format = 1\ntitle = 'Flat punch, layer stiffening downwards'\n\
         [layer]\nthickness = 5.0\npoisson = 0.3\ngrading = { type = 'exponential', surface = 1.0, base = 8.0 }\n\
         [punch]\ntype = 'flat'\nhalf_width = 1.0\n\
         [load]\nforce = 1.0\n[units]\nlength = 'mm'\nstress = 'MPa'\n";
    scene(&format!("{toml}[friction]\ntype = 'goodman'\ncoefficient = {eta}\n"))
}

/// Equally spaced, both ends included.
fn abscissae(points: u32) -> Vec<f64> {
    (0..points).map(|i| f64::from(2 * i) / f64::from(points - 1) - 1.0).collect()
}

/// Sharp edges, `b = P = 1`: `p = 1/(pi sqrt(1 - x^2))`; `|q| = eta p` outside `a`, less within.
pub(crate) fn flat(a: f64, eta: f64, slip: Slip, points: u32) -> Solution {
    let x = abscissae(points);
    let pressure = |x: f64| (x.abs() < 1.0).then(|| 1.0 / (PI * (1.0 - x * x).sqrt()));
    let towards = if slip == Slip::Inward { 1.0 } else { -1.0 };
    let share = |x: f64| if x.abs() < a { 1.0 - (1.0 - (x / a).powi(2)).sqrt() } else { 1.0 };
    let shear = |x: f64| pressure(x).map(|p| towards * x.signum() * eta * p * share(x));
    let each = [
        ("load.force", 0.0),
        ("load.half_width", 0.0),
        ("pressure.centre", 2e-9),
        ("pressure.mean", 0.0),
        ("edge.stress_intensity", 3e-10),
        ("edge.ratio", 3e-10),
        ("stick.half_width", 4e-7),
        ("stick.ratio", 4e-7),
        ("stick.one_minus_ratio", 1e-6),
    ];
    Solution {
        status: Status::Converged,
        reason: None,
        load: LoadReport { force: Some(1.0), half_width: Some(1.0), indentation: None },
        pressure: PressureReport { centre: pressure(0.0), mean: Some(0.5), peak: None },
        edge: EdgeReport { stress_intensity: Some(1.0 / PI), ratio: Some(1.0 / PI) },
        stick: Some(StickReport {
            half_width: Some(a),
            ratio: Some(a),
            one_minus_ratio: Some(1.0 - a),
            slip: Some(slip),
            strain_rate: None,
        }),
        error: ErrorReport {
            estimate: Some(1e-6),
            each: each.into(),
            how: "difference from the next finer resolution".into(),
        },
        plan: Plan {
            grading: "exponential",
            flexibility: "transfer-matrix",
            kernel: "split",
            quadrature: "de-sinc",
            unknowns: 40,
            flexibility_evaluations: 120,
            factorisations: 3,
            reasons: vec!["split: the kernel jumps at t = 0".into()],
            ..Plan::default()
        },
        profile: Profile {
            pressure: x.iter().map(|x| pressure(*x)).collect(),
            shear: Some(x.iter().map(|x| shear(*x)).collect()),
            strain: None,
            x,
        },
        assumptions: vec!["plane strain".into(), "Goodman: q does not change p".into()],
        ..Solution::refused(&flat_scene(eta), Plan::default(), String::new())
    }
}

/// The usual case.
pub(crate) fn flat_with_friction() -> Solution {
    flat(0.5530, 0.3, Slip::Inward, 201)
}

/// A smooth edge: `p = 2/pi sqrt(1 - x^2)`, `b = P = 1`; no labels, no base.
pub(crate) fn cylinder_without_friction() -> Solution {
    let scene = scene(
        "format = 1\n[layer]\npoisson = 0.3\nbase = { type = 'infinite' }\n\
         grading = { type = 'homogeneous', modulus = 1.0 }\n\
         [punch]\ntype = 'cylinder'\nradius = 10.0\n[load]\nhalf_width = 1.0\n",
    );
    let x = abscissae(201);
    Solution {
        status: Status::Converged,
        reason: None,
        load: LoadReport { force: Some(1.0), half_width: Some(1.0), indentation: None },
        pressure: PressureReport { centre: Some(2.0 / PI), mean: Some(0.5), peak: Some(2.0 / PI) },
        edge: EdgeReport { stress_intensity: Some(0.0), ratio: Some(0.0) },
        error: ErrorReport {
            estimate: Some(1e-4),
            each: [("pressure.centre", 1e-4), ("pressure.peak", 1e-4)].into(),
            how: String::new(),
        },
        profile: Profile {
            pressure: x.iter().map(|x| Some(2.0 / PI * (1.0 - x * x).sqrt())).collect(),
            shear: None,
            strain: None,
            x,
        },
        ..Solution::refused(&scene, Plan::default(), String::new())
    }
}

/// A contact that grows with friction on its way to [`flat_with_friction`]: `b = sqrt(P)`, `delta = P/10`.
pub(crate) fn loading_curve() -> Solution {
    let mut solution = flat_with_friction();
    let forces: Vec<f64> = (1..=60).map(|i| f64::from(i) / 60.0).collect();
    let column = |of: fn(f64) -> f64| forces.iter().map(|force| Some(of(*force))).collect::<Vec<_>>();
    solution.scene.punch = cylinder_without_friction().scene.punch;
    solution.path = Some(Curve {
        status: Status::Converged,
        note: None,
        error: Some(1e-6),
        force: column(|force| force),
        half_width: column(f64::sqrt),
        indentation: Some(column(|force| 0.1 * force)),
        stick_half_width: Some(column(|force| 0.553 * force.sqrt())),
        stick_ratio: Some(column(|_| 0.553)),
    });
    solution
}

/// No numbers.
pub(crate) fn refused() -> Solution {
    Solution::refused(&flat_scene(0.3), Plan::default(), "this grading does not exist yet; take `exponential`".into())
}
