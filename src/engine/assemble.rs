//! A solved contact in the scene's units.

mod coupling;
mod profile;

use super::prepared_layer::PreparedLayer;
use super::problem::Problem;
use super::solution::{
    EdgeReport, ErrorReport, LoadReport, PressureReport, Profile, Slip, Solution, Status, StickReport,
};
use crate::engine::accuracy::quantity::{Numbers, Quantity};
use crate::engine::friction::rubbing::{Rubbing, Verdict};
use crate::engine::refine::judged::{How, Judged, SAID};
use crate::engine::refine::stage::Stage;
use crate::engine::solution::finite::first_found_not_finite;
use crate::engine::solution::loading_curve::Point;
use crate::plan::Plan;
use crate::scene::{Load, Model, Scene};
use coupling::{Neglected, Untold};
use slipzone_api::Refusal;
use std::borrow::Cow;

/// Where the pressure stands in a result.
const PRESSURE: &str = "profile.pressure";
/// Where the strain left stands in a result.
const STRAIN: &str = "profile.strain";
/// Indentation over the thickness, mean pressure over the shear modulus, and slope of the punch in contact, from which
/// strains are no longer called small.
const DEEP: f64 = 0.1;
const PRESSED: f64 = 1.0;
const STEEP: f64 = 0.3;
/// What is said where the cost of Goodman's approximation is not known.
const COST_UNTOLD: &str = "Goodman: what it costs that q does not change p is not known: its estimate fails here, as on layers much thinner than the contact, or where much friction lets little slip";
/// More force than told from which that is said, and more of it than what is estimated to be as much as that.
const SAID_OF_FORCE: f64 = 0.02;
const LEAST_OF_FORCE: f64 = 0.25;

/// A contact that was solved, and what tells of it.
pub(super) struct Solved<'a> {
    pub(super) layer: &'a PreparedLayer,
    pub(super) problem: &'a Problem,
    pub(super) stage: &'a mut Stage,
    pub(super) judged: &'a Judged,
}

/// The solution; refused when one of its numbers is not finite.
pub(super) fn solution(
    scene: &Scene,
    mut plan: Plan,
    mut solved: Solved,
    (status, reason): (Status, Option<String>),
) -> Result<Solution, Refusal> {
    let (problem, judged) = (solved.problem, solved.judged);
    let mut profile = if problem.wishes.profile { solved.profile(scene)? } else { Profile::default() };
    let is_found = |rubbing: &&Rubbing| matches!(rubbing.verdict, Verdict::Holds | Verdict::Sticks);
    let rubbing = judged.outcome.rubbing.as_ref().filter(is_found);
    let neglected = rubbing.map(|rubbing| coupling::neglected(solved.layer, problem, rubbing, scene));
    plan.coupling_neglected = neglected.and_then(|neglected| neglected.ok()?.friction);
    let asks_of_strain = scene.output.strain && problem.wishes.profile;
    // Where the budget does not reach for it, all else is told.
    let of_strain = if asks_of_strain { solved.add_strain(scene, &mut profile) } else { Ok(None) };
    let stick = solved.stick().filter(|_| scene.output.asks_of_stick());
    let told = of_pressure(scene, plan, problem, &judged.outcome.numbers, &judged.errors, how(judged));
    let mut solution = Solution { status, reason, stick, profile, ..told };
    tell_of_profile(&mut solution, judged, of_strain.as_ref().copied().unwrap_or_default());
    match neglected {
        Some(Ok(neglected)) => tell_of_neglected(&mut solution, neglected),
        Some(Err(Untold)) => solution.assumptions.push(COST_UNTOLD.into()),
        None => {}
    }
    if let Err(refusal) = of_strain {
        solution = solution.lacking(&format!("the strain left in the stick zone is not known: {refusal}"));
    }
    finite(solution)
}

impl Solved<'_> {
    /// What is told of the stick zone, where friction was looked at.
    fn stick(&self) -> Option<StickReport> {
        let rubbing = self.judged.outcome.rubbing.as_ref()?;
        let (length, wishes) = (self.problem.length, self.problem.wishes);
        let number = |quantity, unit: f64| {
            self.judged.outcome.numbers.get(quantity).filter(|_| wishes.reports(quantity)).map(|value| value * unit)
        };
        let slip = self.stage.signed_friction().filter(|_| {
            // Or nothing slips, or nothing was found.
            !rubbing.is_full && rubbing.verdict != Verdict::NoShear && rubbing.has_zone()
        });
        Some(StickReport {
            half_width: number(Quantity::StickHalfWidth, length),
            ratio: number(Quantity::StickRatio, 1.0),
            one_minus_ratio: number(Quantity::OneMinusRatio, 1.0),
            slip: slip.map(|friction| if friction < 0.0 { Slip::Outward } else { Slip::Inward }),
            strain_rate: number(Quantity::StrainRate, 1.0 / length),
        })
    }
}

/// Adds the errors of the tractions and of the strain left, and says so where one is large.
fn tell_of_profile(solution: &mut Solution, judged: &Judged, of_strain: Option<f64>) {
    let errors = [
        (PRESSURE, judged.of_pressure, "the pressure between the nodes", "what it is there, or of its mean"),
        (Quantity::Shear.path(), judged.of_shear, "the shear in the stick zone", "its largest value"),
        (STRAIN, of_strain, "the strain left in the stick zone", "A0 eta P/(2b)"),
    ];
    for (path, error, what, scale) in errors {
        let Some(error) = error else { continue };
        solution.error.each.insert(path, error);
        if error > SAID * solution.scene.solver.tolerance.get() {
            solution.assumptions.push(format!("{what} is known to {error:.0e} of {scale}").into());
        }
    }
}

/// Says what Goodman's approximation costs.
fn tell_of_neglected(solution: &mut Solution, neglected: Neglected) {
    let of_friction = neglected.friction.map(|neglected| {
        let (share, side) = (percent(neglected.abs()), if neglected < 0.0 { "less" } else { "more" });
        format!("Goodman: with the effect of q on p, this a/b needs about {share} {side} friction")
    });
    let force = neglected.force.filter(|force| force.abs() > SAID_OF_FORCE);
    let of_force = force.map(|force| {
        let (share, side) = (percent(force.abs()), if force < 0.0 { "less" } else { "more" });
        let about = if force > LEAST_OF_FORCE { "at least" } else { "about" };
        format!("Goodman: with the effect of q on p, this indentation needs {about} {share} {side} force")
    });
    for reason in of_friction.into_iter().chain(of_force) {
        solution.assumptions.push(reason.clone().into());
        solution.plan.reasons.push(reason.into());
    }
}

/// A contact of which the pressure's numbers are known in closed form.
pub(super) fn in_closed_form(
    scene: &Scene,
    plan: Plan,
    problem: &Problem,
    (numbers, errors): (&Numbers, &Numbers),
    (status, reason): (Status, Option<String>),
) -> Result<Solution, Refusal> {
    let how = "closed form; the model of the solid by its bound".into();
    finite(Solution { status, reason, ..of_pressure(scene, plan, problem, numbers, errors, how) })
}

/// All that is told of the pressure, in the scene's units; the rest is left out.
fn of_pressure(
    scene: &Scene,
    plan: Plan,
    problem: &Problem,
    numbers: &Numbers,
    errors: &Numbers,
    how: String,
) -> Solution {
    let (length, stress, wishes) = (problem.length, problem.stress, problem.wishes);
    let reported = |quantity, value: Option<f64>| value.filter(|_| wishes.reports(quantity));
    let number = |quantity, unit: f64| reported(quantity, numbers.get(quantity).map(|value| value * unit));
    let load = load(scene.load, problem, numbers);
    let mean = load.force.zip(load.half_width).map(|(force, b)| force / (2.0 * b));
    let each = errors.iter().filter(|(quantity, _)| wishes.reports(*quantity));
    let mut solution = Solution {
        pressure: PressureReport {
            centre: number(Quantity::Centre, stress),
            mean: reported(Quantity::Mean, mean),
            peak: number(Quantity::Peak, stress),
        },
        edge: EdgeReport {
            stress_intensity: number(Quantity::StressIntensity, stress * length.sqrt()),
            ratio: number(Quantity::EdgeRatio, 1.0),
        },
        load: LoadReport {
            force: reported(Quantity::Force, load.force),
            half_width: reported(Quantity::HalfWidth, load.half_width),
            indentation: reported(Quantity::Indentation, load.indentation),
        },
        error: ErrorReport {
            estimate: errors.worst().map(|(_, error)| error),
            each: each.map(|(quantity, error)| (quantity.path(), error)).collect(),
            how,
        },
        ..Solution::refused(scene, plan, String::new())
    };
    solution.assumptions.extend(remarks(solution.plan.model, problem, numbers));
    solution
}

/// A shape that is unsure by more than that, and heights that scatter by more, over its height at the contact's edge,
/// are said to be.
const TOLD: f64 = 0.05;

/// What the numbers rest on beside what the scene alone tells.
fn remarks(model: Model, problem: &Problem, numbers: &Numbers) -> Vec<Cow<'static, str>> {
    let stand_in = match model {
        Model::Full => None,
        Model::HalfPlane => Some("the solid taken for a half-plane of its surface's material"),
        Model::CorrectedHalfPlane => {
            Some("the solid taken for a half-plane of its surface's material, with the first correction by its base")
        }
        Model::Homogeneous => Some("the layer taken for one of its surface's material throughout"),
        Model::Thin => Some(
            "the layer taken for thin: each point of its surface sinks by its own pressure alone (Winkler), edges shifted",
        ),
    };
    let half_width = numbers.get(Quantity::HalfWidth);
    let scatter = problem.scatter(half_width, TOLD).map(Cow::Owned);
    let narrowest = "of all contacts with this indentation, the narrowest is given: the force grew from zero";
    let mut remarks: Vec<Cow<'static, str>> = stand_in.map(Cow::Borrowed).into_iter().chain(scatter).collect();
    let of_shape = half_width.map(|b| problem.remarks_on_shape(b));
    remarks.extend(half_width.and_then(|b| problem.unsure(b, TOLD)).map(Cow::Owned));
    remarks.extend(of_shape.into_iter().flatten().map(Cow::Owned));
    remarks.extend(problem.may_sink_as_far_again().then_some(Cow::Borrowed(narrowest)));
    remarks.extend(problem.layer.law.remarks().into_iter().map(Cow::Owned));
    remarks.extend(large_strains(problem, numbers).map(Cow::Owned));
    remarks
}

/// What is to be said where strains are not small.
fn large_strains(problem: &Problem, numbers: &Numbers) -> Option<String> {
    let depth = numbers.get(Quantity::Indentation).filter(|_| problem.is_on_rigid_base());
    // Convex: steepest at the edge.
    let grown = numbers.get(Quantity::HalfWidth).filter(|_| problem.fixed_half_width().is_none());
    let (depth, slope) = (depth.unwrap_or(0.0), grown.map_or(0.0, |b| problem.slope(b)));
    // Of the surface and of what the layer rests on; on a rigid base pressure may be high where nothing gives way.
    let over_shear = |mean: f64| mean / problem.layer.substrate().map_or(1.0, |substrate| substrate.shear.max(1.0));
    let mean = numbers.get(Quantity::Mean).filter(|_| !problem.is_on_rigid_base()).map_or(0.0, over_shear);
    let what = if depth > DEEP {
        format!("the indentation is {depth:.2} times the thickness")
    } else if mean > PRESSED {
        format!("the mean pressure is {mean:.2} times the shear modulus")
    } else if slope > STEEP {
        format!("the punch has a slope of {slope:.2} at the contact's edge")
    } else {
        return None;
    };
    Some(format!("{what}: strains are not small, and neglecting that makes an error of this order"))
}

/// A solution as it is, unless one of its numbers is not finite.
fn finite(solution: Solution) -> Result<Solution, Refusal> {
    match first_found_not_finite(&solution) {
        None => Ok(solution),
        Some(number) => Err(Refusal::Limit {
            why: format!("a number of the result is not finite: {number}"),
            remedy: "check the sizes of the scene's numbers against each other",
        }),
    }
}

/// A share in percent, with as many digits as an estimate has.
fn percent(share: f64) -> String {
    let percent = 100.0 * share;
    if percent < 0.1 {
        "less than 0.1 %".into()
    } else if percent < 10.0 {
        format!("{percent:.1} %")
    } else {
        format!("{percent:.0} %")
    }
}

/// Load and what it does.
fn load(load: Load, problem: &Problem, numbers: &Numbers) -> LoadReport {
    let (length, stress) = (problem.length, problem.stress);
    let number = |quantity, unit: f64| numbers.get(quantity).map(|value| value * unit);
    // What the scene and the punch give is reported as given, not after its way through the layer's units.
    let given = LoadReport::given(load);
    LoadReport {
        force: given.force.or(number(Quantity::Force, stress * length)),
        half_width: given.half_width.or(problem.width_of_corners()).or(number(Quantity::HalfWidth, length)),
        indentation: given.indentation.or(number(Quantity::Indentation, length)),
    }
}

/// A solved contact as a point of a loading curve; `error` is the largest of its numbers.
pub(super) fn point(
    given: Load,
    problem: &Problem,
    numbers: &Numbers,
    error: Option<f64>,
    (status, reason): (Status, Option<String>),
) -> Point {
    let load = load(given, problem, numbers);
    let stick_half_width = numbers.get(Quantity::StickHalfWidth).map(|a| a * problem.length);
    Point { load, stick_half_width, stick_ratio: numbers.get(Quantity::StickRatio), error, status, reason }
}

/// How the errors were estimated, in words.
fn how(judged: &Judged) -> String {
    let of_kernels = |proven| if proven { "; kernels by their own bound" } else { "" };
    let numerical = match judged.how {
        How::Twin => "resolution fixed by the scene, compared with a finer twin".into(),
        How::Sequence { count: 2, kernels_proven } => {
            format!("twice the largest difference between two resolutions{}", of_kernels(kernels_proven))
        }
        How::Sequence { count, kernels_proven } => format!(
            "differences between {count} resolutions, each finer than the one before, extrapolated{}",
            of_kernels(kernels_proven)
        ),
        How::Again { kernels_proven } => format!(
            "difference between two resolutions, extrapolated at the pace seen under another load or punch{}",
            of_kernels(kernels_proven)
        ),
    };
    if judged.of_model > 0.0 { numerical + "; the model of the solid by its bound" } else { numerical }
}
