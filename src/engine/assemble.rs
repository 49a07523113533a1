//! A solved contact in the scene's units.

use super::coupling;
use super::finite::first_found_not_finite;
use super::judged::{How, Judged, SAID};
use super::loading_curve::Point;
use super::prepared_layer::PreparedLayer;
use super::problem::Problem;
use super::quantity::{Numbers, Quantity};
use super::rubbing::{Rubbing, Verdict};
use super::solution::{
    EdgeReport, ErrorReport, LoadReport, PressureReport, Profile, Slip, Solution, Status, StickReport,
};
use super::stage::Stage;
use super::stick_zone::StickZone;
use crate::plan::Plan;
use crate::scene::{Load, Model, Scene};
use slipzone_api::{Refusal, Station};
use std::borrow::Cow;

/// Where the pressure stands in a result.
const PRESSURE: &str = "profile.pressure";
/// Where the strain left stands in a result.
const STRAIN: &str = "profile.strain";
/// Points at which tractions are told before the budget is looked at again, and those of a stack, each of which is told by many flat punches.
const AT_ONCE: usize = 1024;
const STACKED_AT_ONCE: usize = 32;
/// Indentation over the thickness from which strains are no longer called small.
const DEEP: f64 = 0.1;
/// More force than told from which that is said.
const SAID_OF_FORCE: f64 = 0.02;
/// Slope of the punch in contact from which they are not.
const STEEP: f64 = 0.3;

/// The solution; refused when one of its numbers is not finite.
pub(super) fn solution(
    scene: &Scene,
    plan: Plan,
    layer: &PreparedLayer,
    problem: &Problem,
    stage: &mut Stage,
    judged: &Judged,
    (status, reason): (Status, Option<String>),
) -> Result<Solution, Refusal> {
    let (length, wishes) = (problem.length, problem.wishes);
    let numbers = &judged.outcome.numbers;
    let number =
        |quantity, unit: f64| numbers.get(quantity).filter(|_| wishes.reports(quantity)).map(|value| value * unit);
    let b = numbers.get(Quantity::HalfWidth).unwrap_or(0.0);
    let mut profile = if wishes.profile { profile(scene, layer, problem, stage, b)? } else { Profile::default() };
    let mut of_strain = None;
    if scene.output.strain
        && let Some(rubbing) = &judged.outcome.rubbing
    {
        let relative = profile.x.iter().map(|x| x / (length * b));
        let scale = strain_scale(problem, numbers);
        let wanted = scene.solver.tolerance.get() * scale;
        if let Some((strain, apart)) = strain((relative, wanted), problem, layer, stage, rubbing.zone) {
            // Where the pressure is unbounded there is none.
            let told = strain.into_iter().zip(&profile.pressure).map(|(strain, p)| p.and(strain));
            profile.strain = Some(told.collect());
            of_strain = strain_error(problem, judged, apart / scale);
        }
    }
    let is_found = |rubbing: &&Rubbing| matches!(rubbing.verdict, Verdict::Holds | Verdict::Sticks);
    let rubbing = judged.outcome.rubbing.as_ref().filter(is_found);
    let mut plan = plan;
    let neglected = rubbing.and_then(|rubbing| coupling::neglected(layer, problem, rubbing, scene));
    plan.coupling_neglected = neglected.and_then(|neglected| neglected.friction);
    let stick = judged.outcome.rubbing.as_ref().filter(|_| scene.output.asks_of_stick()).map(|_| StickReport {
        half_width: number(Quantity::StickHalfWidth, length),
        ratio: number(Quantity::StickRatio, 1.0),
        one_minus_ratio: number(Quantity::OneMinusRatio, 1.0),
        slip: slip(stage, judged),
        strain_rate: number(Quantity::StrainRate, 1.0 / length),
    });
    let told = of_pressure(scene, plan, problem, numbers, &judged.errors, how(judged));
    let mut solution = Solution { status, reason, stick, profile, ..told };
    let of_pressure = judged
        .of_pressure
        .map(|error| (PRESSURE, error, "the pressure between the nodes", "what it is there, or of its mean"));
    let of_shear = judged
        .of_shear
        .map(|error| (Quantity::Shear.path(), error, "the shear in the stick zone", "its largest value"));
    let of_strain = of_strain.map(|error| (STRAIN, error, "the strain left in the stick zone", "A0 eta P/(2b)"));
    for (path, error, what, scale) in of_pressure.into_iter().chain(of_shear).chain(of_strain) {
        solution.error.each.insert(path, error);
        if error > SAID * scene.solver.tolerance.get() {
            solution.assumptions.push(format!("{what} is known to {error:.0e} of {scale}").into());
        }
    }
    let of_friction = solution.plan.coupling_neglected.map(|neglected| {
        let (share, side) = (percent(neglected.abs()), if neglected < 0.0 { "large" } else { "small" });
        format!("Goodman: that q does not change p makes the friction that belongs to this stick ratio about {share} too {side}")
    });
    let force = neglected.and_then(|neglected| neglected.force).filter(|force| force.abs() > SAID_OF_FORCE);
    let of_force = force.map(|force| {
        let (share, side) = (percent(force.abs()), if force < 0.0 { "less" } else { "more" });
        format!("Goodman: if q changed p, this indentation would take about {share} {side} force")
    });
    for reason in of_friction.into_iter().chain(of_force) {
        solution.assumptions.push(reason.clone().into());
        solution.plan.reasons.push(reason.into());
    }
    finite(solution)
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
    let stand_in = match solution.plan.model {
        Model::Full => None,
        Model::HalfPlane => Some("the solid taken for a half-plane of its surface's material"),
        Model::CorrectedHalfPlane => {
            Some("the solid taken for a half-plane of its surface's material, with the first correction by its base")
        }
        Model::Homogeneous => Some("the layer taken for one of its surface's material throughout"),
        Model::Thin => Some("the layer taken for thin: each point of it yields by what presses on it, edges shifted"),
    };
    solution.assumptions.extend(stand_in.map(Cow::Borrowed));
    if let Some(noise) = problem.noise() {
        let rest =
            format!("the punch's heights scatter by {noise:.1e} (root mean square) around the smooth shape taken");
        solution.assumptions.push(rest.into());
    }
    if problem.may_sink_as_far_again() {
        let which = "of all contacts that sink as far against the datum, the narrowest: the force grew from zero";
        solution.assumptions.push(which.into());
    }
    solution.assumptions.extend(problem.layer.law.remarks().into_iter().map(Cow::Owned));
    let rounded = problem.smoothing_errors(numbers).worst().map_or(0.0, |(_, error)| error);
    if rounded > 0.0 {
        let why = format!(
            "the grading is rounded at the surface, where it has too few derivatives: up to {rounded:.0e} of the errors"
        );
        solution.assumptions.push(why.into());
    }
    solution.assumptions.extend(large_strains(problem, numbers).map(Cow::Owned));
    solution
}

/// What is to be said where strains are not small.
fn large_strains(problem: &Problem, numbers: &Numbers) -> Option<String> {
    let depth = numbers.get(Quantity::Indentation).filter(|_| problem.is_on_rigid_base());
    // Convex: steepest at the edge.
    let grown = numbers.get(Quantity::HalfWidth).filter(|_| problem.fixed_half_width().is_none());
    let (depth, slope) = (depth.unwrap_or(0.0), grown.map_or(0.0, |b| problem.slope(b)));
    let what = if depth > DEEP {
        format!("the punch sinks in by {depth:.2} of the thickness")
    } else if slope > STEEP {
        format!("the punch has a slope of {slope:.2} at the contact's edge")
    } else {
        return None;
    };
    Some(format!("{what}: strains are not small there, and what is neglected with them is of that order"))
}

/// A solution as it is, unless one of its numbers is not finite.
fn finite(solution: Solution) -> Result<Solution, Refusal> {
    match first_found_not_finite(&solution) {
        None => Ok(solution),
        Some(number) => Err(Refusal::OutOfReach {
            method: "engine",
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

/// Direction of slip, where there is one to tell.
fn slip(stage: &Stage, judged: &Judged) -> Option<Slip> {
    let (friction, rubbing) = (stage.signed_friction()?, judged.outcome.rubbing.as_ref()?);
    if matches!(rubbing.verdict, Verdict::NoShear | Verdict::Sticks | Verdict::NotScanned) {
        return None; // nothing slips, or nothing was found
    }
    Some(if friction < 0.0 { Slip::Outward } else { Slip::Inward })
}

/// Tractions at the points that the scene asks for.
fn profile(
    scene: &Scene,
    layer: &PreparedLayer,
    problem: &Problem,
    stage: &mut Stage,
    b: f64,
) -> Result<Profile, Refusal> {
    if let Some(x) = &scene.output.x {
        return tractions(x, layer, problem, stage, b);
    }
    // Equally spaced points are their own mirror images, and so are the tractions: the right half will do.
    let last = scene.output.points - 1;
    let right: Vec<f64> = (last.div_ceil(2)..=last).map(|i| (2 * i - last) as f64 / last as f64).collect();
    let half = tractions(&right, layer, problem, stage, b)?;
    let left = scene.output.points / 2;
    Ok(Profile {
        x: with_mirror(&half.x, left, |x| -x),
        pressure: with_mirror(&half.pressure, left, |p| p),
        shear: half.shear.map(|shear| with_mirror(&shear, left, |q| q.map(|q| -q))),
        strain: None,
    })
}

/// The mirror images of the outer `left` values, which are all but that of a point in the middle, and the values.
fn with_mirror<T: Copy>(right: &[T], left: usize, mirror: impl Fn(T) -> T) -> Vec<T> {
    let mut all = Vec::with_capacity(left + right.len());
    all.extend(right[right.len() - left..].iter().rev().map(|value| mirror(*value)));
    all.extend_from_slice(right);
    all
}

/// Tractions at points in units of the half-width `b`.
fn tractions(
    relative: &[f64],
    layer: &PreparedLayer,
    problem: &Problem,
    stage: &mut Stage,
    b: f64,
) -> Result<Profile, Refusal> {
    let sharp = stage.contact.normal.is_sharp();
    let value = |found: Option<f64>| match found {
        Some(value) => value.is_finite().then_some(value * problem.stress),
        None => (!sharp).then_some(0.0),
    };
    let station = |x: &f64| Station { x: x * b, gap: (1.0 - x.abs()) * b };
    let mut inside: Vec<Station> = relative.iter().map(station).collect();
    inside.retain(|station| station.gap > 0.0);
    let mut pressure = vec![0.0; inside.len()];
    let mut shear = Some(Vec::with_capacity(inside.len()));
    let at_once = if problem.is_stacked() { STACKED_AT_ONCE } else { AT_ONCE };
    for (at, pressure) in inside.chunks(at_once).zip(pressure.chunks_mut(at_once)) {
        layer.meter().within()?;
        stage.pressure_into(problem, at, pressure);
        let found = stage.shear(problem, at, pressure);
        shear = shear.zip(found).map(|(mut all, found)| {
            all.extend(found);
            all
        });
    }
    // Points on the edge or beyond it have no value of their own.
    let spread = |values: Vec<f64>| {
        let mut values = values.into_iter();
        relative.iter().map(|x| value(if station(x).gap > 0.0 { values.next() } else { None })).collect()
    };
    let shear = shear.map(&spread);
    Ok(Profile {
        x: relative.iter().map(|x| x * b * problem.length).collect(),
        pressure: spread(pressure),
        shear,
        strain: None,
    })
}

/// `A0 eta P/(2b)`, which errors of the strain left are relative to.
fn strain_scale(problem: &Problem, numbers: &Numbers) -> f64 {
    problem.elastic.a0() * problem.friction.unwrap_or(0.0) * numbers.get(Quantity::Mean).unwrap_or(0.0)
}

/// How uncertain the strains left are, relative: by what coarser grids change them, and by what the errors of the tractions make of
/// them.
fn strain_error(problem: &Problem, judged: &Judged, by_grids: f64) -> Option<f64> {
    let of_pressure = problem.elastic.beta().abs() / problem.friction? * judged.doubt.unwrap_or(0.0);
    let error = by_grids + judged.of_shear.unwrap_or(0.0) + of_pressure;
    error.is_finite().then_some(error)
}

/// The strain left in the stick zone at points in units of the half-width, the same on either side, and how uncertain it is where
/// the tractions are exact.
fn strain(
    (relative, wanted): (impl Iterator<Item = f64>, f64),
    problem: &Problem,
    layer: &PreparedLayer,
    stage: &mut Stage,
    zone: StickZone,
) -> Option<(Vec<Option<f64>>, f64)> {
    let b = zone.contact();
    let at: Vec<f64> = relative.map(|x| x.abs() * b).collect();
    let mut sticking: Vec<f64> = at.iter().copied().filter(|x| *x < zone.half_width).collect();
    // Each distance once, though it comes on both sides.
    sticking.sort_by(f64::total_cmp);
    sticking.dedup_by(|one, other| one.to_bits() == other.to_bits());
    let (strain, apart) = stage.strain(layer, problem, (&sticking, wanted))?;
    let one = |x: f64| {
        let found = sticking.binary_search_by(|other| other.total_cmp(&x)).ok()?;
        strain[found].filter(|strain| strain.is_finite())
    };
    Some((at.into_iter().map(one).collect(), apart))
}
