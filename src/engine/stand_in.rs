//! A cheaper solid in place of the one that a scene describes, and by how much that changes each number.
//!
//! The bounds are derived, and their constants measured, in docs/planner.md.

pub(crate) mod thin;

use super::problem::Problem;
use crate::engine::accuracy::quantity::{Numbers, Quantity};
use crate::engine::pressure::contact_size;
use crate::plan::{half_plane, has_closed_form, homogeneous, serves_any_contact};
use crate::scene::{Model, Scene};
use slipzone_api::{Base, LayerModel};

/// Share of the tolerance that a model may use up; the rest is the numerical error's.
pub(super) const SHARE: f64 = 0.5;
/// What to do about a model that does not apply.
pub(super) const REMEDY: &str = "leave out `solver.model`, and the planner chooses";
/// Half-widths over the thickness up to which the constants below were measured.
const WIDEST: f64 = 0.25;
/// Depths over the half-width above which a gradient is not looked at.
const NEAREST: f64 = 0.01;
/// Samples of the law in each of its stretches, beside its probes.
const SAMPLES: usize = 48;

/// How far a solid is from a homogeneous half-plane of its surface's material, in units of its thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Departure {
    /// What lies below the layer: 0 where nothing does, 1 for rigid bases, more for soft ones.
    base: f64,
    /// Largest change of the material over the depth at which it is met.
    gradient: f64,
}

impl Departure {
    /// Of a layer under a contact of about that half-width.
    fn of(layer: &LayerModel, half_width: f64) -> Self {
        let base = match layer.base {
            Base::Infinite => 0.0,
            Base::Rigid | Base::Frictionless => 1.0,
            Base::HalfPlane { .. } => {
                layer.substrate().map_or(1.0, |below| (below.elastic.a0() / below.shear / layer.elastic.a0()).max(1.0))
            }
        };
        Self { base, gradient: gradient(layer, NEAREST * half_width) }
    }
}

/// `sup |ln(mu/mu1)| + |kappa - kappa1|` over the depth, times the largest compliance; what happens closer to the
/// surface than `least` is not looked at.
fn gradient(layer: &LayerModel, least: f64) -> f64 {
    if layer.exponent() == Some(0.0) {
        return 0.0;
    }
    let (mut steepest, mut softest) = (0.0_f64, 1.0_f64);
    for stretch in layer.law.stretches() {
        let span = stretch.to - stretch.from;
        let mut look = |depth: f64| {
            let material = layer.material(stretch.law, depth);
            let change = material.shear.ln().abs() + (material.elastic.kappa - layer.elastic.kappa).abs();
            steepest = steepest.max(change / stretch.in_whole(depth).max(least));
            softest = softest.max(material.shear.recip());
        };
        for i in 0..=SAMPLES {
            let part = i as f64 / SAMPLES as f64;
            // Denser at the top, where the surface is near.
            look(stretch.from + span * part * part * part);
        }
        stretch.probes(stretch.from, stretch.to).iter().for_each(|depth| look(*depth));
    }
    steepest * softest
}

/// A model in place of a scene's solid.
#[derive(Clone, Copy, Debug)]
pub(super) struct StandIn {
    pub(super) model: Model,
    /// Whether the scene wants it, whatever its error.
    pub(super) is_forced: bool,
    departure: Departure,
    /// Thickness in layer units of the problem that it is solved as.
    thickness: f64,
}

/// What is decided on the solid of a scene.
pub(super) enum Decision {
    /// As described.
    Full,
    /// Something cheaper.
    Cheaper(StandIn),
    /// A model is forced that does not apply: why.
    Inapplicable(String),
}

/// Decides; `open` is whether the scene leaves all methods to the planner.
pub(super) fn decide(scene: &Scene, problem: &Problem, open: bool) -> Decision {
    match scene.solver.model {
        Some(Model::Full) => Decision::Full,
        // Of a thin layer there is nothing to be solved in its place.
        Some(model @ Model::Thin) => match thin::obstacle(problem, scene.path.is_some()) {
            Some(why) => Decision::Inapplicable(format!("the model `{}` {why}", model.name())),
            None => Decision::Full,
        },
        Some(Model::CorrectedHalfPlane) if !open && !has_moments(scene) => Decision::Inapplicable(
            "the model `corrected-half-plane` brings a kernel strategy of its own, and the scene names its methods"
                .into(),
        ),
        Some(model) => match obstacle(model, scene, problem) {
            Some(Obstacle::Same) => Decision::Full,
            Some(Obstacle::No(why)) => Decision::Inapplicable(format!("the model `{}` {why}", model.name())),
            None => {
                let departure = Departure::of(&problem.layer, contact_size::guess(problem));
                Decision::Cheaper(StandIn { model, is_forced: true, departure, thickness: 1.0 })
            }
        },
        None if open => cheapest(scene, problem).map_or(Decision::Full, Decision::Cheaper),
        None => Decision::Full,
    }
}

/// The cheapest model whose error is small enough; `None` where that is the solid itself.
fn cheapest(scene: &Scene, problem: &Problem) -> Option<StandIn> {
    let b = contact_size::guess(problem);
    let allowed = SHARE * scene.solver.tolerance.get();
    // No bound is below that: most scenes end here.
    if b > WIDEST || least(&problem.layer, b) > allowed {
        return None;
    }
    let departure = Departure::of(&problem.layer, b);
    // Where the flexibility is as cheap as it gets, another grading saves nothing.
    let saves =
        |model: &Model| *model != Model::Homogeneous || !scene.layer.model().is_ok_and(|model| has_closed_form(&model));
    let fits = |model: Model| {
        let stand_in = StandIn { model, is_forced: false, departure, thickness: 1.0 };
        let is_near = stand_in.bound(problem, b).worst().is_some_and(|(_, bound)| bound <= allowed)
            && (model != Model::CorrectedHalfPlane || left_out(problem, b) <= SHARE * allowed);
        (is_near && !scene.solver.forbid.contains(&model) && obstacle(model, scene, problem).is_none())
            .then_some(stand_in)
    };
    let models = [Model::HalfPlane, Model::CorrectedHalfPlane, Model::Homogeneous];
    models.into_iter().filter(saves).find_map(fits)
}

/// Whether a scene names the kernel strategy of the corrected half-plane.
fn has_moments(scene: &Scene) -> bool {
    scene.solver.kernel.as_ref().is_some_and(|kernel| !serves_any_contact(kernel.typetag_name()))
}

/// Less than any bound for a contact of that half-width, at the price of one look at the law.
fn least(layer: &LayerModel, b: f64) -> f64 {
    match layer.exponent() {
        Some(0.0) if layer.base == Base::Infinite => f64::INFINITY,
        Some(0.0) => b.powi(4),
        Some(exponent) => b * exponent.abs(),
        None if layer.law.sublayers().is_empty() => b * layer.material(&*layer.law, 1.0).shear.ln().abs(),
        None => 0.0,
    }
}

/// What keeps a model from standing for a solid.
enum Obstacle {
    /// The solid is that model already.
    Same,
    /// A quantity that it cannot give, in words.
    No(&'static str),
}

fn obstacle(model: Model, scene: &Scene, problem: &Problem) -> Option<Obstacle> {
    let is_homogeneous = problem.layer.exponent() == Some(0.0);
    let is_infinite = scene.layer.base == Base::Infinite;
    if is_homogeneous && (is_infinite || model == Model::Homogeneous) {
        return Some(Obstacle::Same);
    }
    if scene.output.strain || problem.is_linear {
        return Some(Obstacle::No("has no bound on the strain left in the stick zone, which is asked for"));
    }
    match model {
        Model::CorrectedHalfPlane if !matches!(scene.layer.base, Base::Rigid | Base::Frictionless) => {
            Some(Obstacle::No("takes a layer on a rigid base"))
        }
        Model::HalfPlane if problem.wants_depth() && scene.layer.has_depths() => Some(Obstacle::No(
            "has no indentation: name the others in `[output] quantities`, as in [\"load.force\", \"pressure\", \"edge\", \"stick\"]",
        )),
        Model::Homogeneous if is_infinite => Some(Obstacle::No("takes a layer on a base: `half-plane` is one without")),
        _ => None,
    }
}

impl StandIn {
    /// The scene with the model in place of its solid.
    pub(super) fn modelled(&self, scene: &Scene, problem: &Problem) -> Scene {
        let layer = match self.model {
            Model::HalfPlane => half_plane(&scene.layer, &problem.layer),
            _ => homogeneous(&scene.layer, &problem.layer),
        };
        Scene { layer, ..scene.clone() }
    }

    /// Why it was chosen.
    pub(super) fn reason(&self, problem: &Problem) -> String {
        let name = self.model.name();
        if self.is_forced {
            return format!("{name}: the scene wants it, whatever its error");
        }
        let bound = self.bound(problem, contact_size::guess(problem)).worst().map_or(0.0, |(_, bound)| bound);
        let what = match self.model {
            Model::HalfPlane => "base and grading change",
            Model::CorrectedHalfPlane => "the grading, and the base beyond the first correction, change",
            _ => "the grading changes",
        };
        let by = if bound > 0.0 { format!(" by more than about {bound:.0e}") } else { String::new() };
        format!("{name}: {what} no number asked for{by}")
    }

    /// The same, of a problem whose unit of length is another.
    pub(super) fn in_units(self, thickness: f64) -> Self {
        Self { thickness, ..self }
    }

    /// Bounds on the relative errors of all numbers under a contact of a half-width in the problem's units.
    pub(super) fn bound(&self, problem: &Problem, half_width: f64) -> Numbers {
        let b = half_width / self.thickness;
        let Departure { base, gradient } = self.departure;
        let base = if self.model == Model::HalfPlane { base } else { 0.0 };
        // Kernels tell what they leave out of the base, but not what becomes of it in the drive of the shear.
        let rest = if self.model == Model::CorrectedHalfPlane { SECOND_CORRECTION * b.powi(4) } else { 0.0 };
        // A contact of a given depth is as uncertain as the depth is.
        let by_depth = if problem.is_pressed_by_depth() { DEPTH * gradient } else { 0.0 };
        let of_pressure = PRESSURE_BY_BASE * base * b * b + PRESSURE_BY_GRADIENT * gradient * b + by_depth;
        let beta = problem.elastic.beta().abs();
        // The coupling's kernel has a logarithm, and what it is compared with is beta.
        let coupled =
            (ZONE_BY_BASE * base * b + rest + ZONE_BY_GRADIENT * gradient * b * (1.0 + (1.0 + b.recip()).ln())) / beta;
        let eta = problem.friction.unwrap_or(beta);
        let mut bound = Numbers::default();
        let kept: Vec<Quantity> = problem.given().collect();
        for quantity in Quantity::ALL {
            let error = match quantity {
                quantity if kept.contains(&quantity) => continue,
                quantity if !problem.wishes.judges(quantity) => continue,
                quantity if quantity.is_of_shear() && problem.friction.is_none() => continue,
                Quantity::Indentation => DEPTH * gradient + of_pressure,
                Quantity::StickHalfWidth | Quantity::StickRatio => (of_pressure + coupled) * (1.0 + beta / eta),
                Quantity::OneMinusRatio => (of_pressure + coupled) * (1.0 + eta / beta),
                _ => of_pressure,
            };
            // Beyond what was measured nothing is claimed.
            let is_known = b <= WIDEST && error.is_finite();
            bound.set(quantity, if is_known { error } else { 1.0 });
        }
        bound
    }
}

/// What the kernels of the corrected half-plane leave out of those of the layer, as they state it.
fn left_out(problem: &Problem, b: f64) -> f64 {
    let sums = if problem.wants_depth() { 0.5 } else { b };
    SECOND_CORRECTION * b.powi(4) + MOMENTS * sums
}

/// Errors by a base: of the pressure's numbers over `b^2`, and of the stick zone's over `b`.
const PRESSURE_BY_BASE: f64 = 3.0;
const ZONE_BY_BASE: f64 = 3.0;
/// Errors by a gradient: of the pressure's numbers over `b`, and of the stick zone's over `b log b`.
const PRESSURE_BY_GRADIENT: f64 = 4.0;
const ZONE_BY_GRADIENT: f64 = 2.0;
/// Error of the kernels with their first correction, over `b^4`, as they state it: `int s^3 |M_vv| ds (2 b)^4/6` at
/// most.
const SECOND_CORRECTION: f64 = 26.0;
/// What the sums that these are made of are good to: over `b` where they are the coupling's, as it is where they are
/// the depth's.
const MOMENTS: f64 = 2e-6;
/// Error of the depth by a gradient.
const DEPTH: f64 = 1.0;
