//! A scene made ready to be solved for one load after another.

mod closed_form;
mod curve;
mod search;

use super::assemble::{self, Solved};
use super::layer::Layer;
use super::prepared_layer::PreparedLayer;
use super::problem::Problem;
use super::refine::{FlatPunches, Ladder};
use super::solution::Solution;
use super::stand_in::{self, Decision, StandIn};
use super::verdict::verdict;
use crate::engine::refine::judged::Judged;
use crate::engine::stand_in::thin;
use crate::engine::work::budget::BUDGET;
use crate::plan::{Chosen, Plan, choose};
use crate::scene::check::bounds;
use crate::scene::{Load, Model, Scene};
use slipzone_api::{Friction, Refusal};
use std::borrow::Cow;

/// A layer, a punch and the methods that solve them, with all that earlier loads left behind: kernel tables,
/// rules, matrices, scratch.
///
/// A further load on the same layer evaluates no flexibility and allocates nothing until its report is
/// written, unless the contact outgrows the tables.
///
/// ```
/// use slipzone::{api::Positive, engine::Solver, scene::{self, Load}};
///
/// let scene = scene::parse("example.toml", r#"
///     format = 1
///     layer = { thickness = 5.0, poisson = 0.3, grading = { type = "exponential", surface = 1.0, base = 8.0 } }
///     punch = { type = "cylinder", radius = 1.0 }
///     load = { half_width = 1.0 }
/// "#).unwrap();
/// let mut solver = Solver::new(&scene).unwrap();
/// let evaluations = solver.solve().plan.flexibility_evaluations;
/// solver.press(Load::HalfWidth(Positive::new(0.9).unwrap()));
/// let narrower = solver.solve();
/// assert_eq!(narrower.plan.flexibility_evaluations, evaluations, "the layer is known already");
/// assert_eq!(narrower.load.half_width, Some(0.9));
/// ```
pub struct Solver {
    chosen: Chosen,
    problem: Problem,
    layer: PreparedLayer,
    ladder: Ladder,
    judged: Option<Judged>,
    /// What is solved in place of the scene's solid.
    stand_in: Option<StandIn>,
    /// The layer itself, where a model of it is solved and its tables are known.
    aside: Option<Layer>,
    /// Work that a load may take.
    budget: u64,
    /// What another load is solved by, where the present one took other methods, or the pressure alone.
    usual: Option<Box<Self>>,
    /// The friction that is left out for the present load, and why.
    untold: Option<(Friction, Refusal)>,
}

impl Solver {
    /// Prepares a scene; refuses what no method can solve.
    pub fn new(scene: &Scene) -> Result<Self, Refusal> {
        Self::prepare(choose(scene)).map_err(|(refusal, _)| refusal)
    }

    /// Prepares, or gives the scene back.
    pub(super) fn prepare(chosen: Chosen) -> Result<Self, (Refusal, Box<Chosen>)> {
        let problem = match bounds(&chosen.scene).and_then(|()| Problem::new(&chosen.scene)) {
            Ok(problem) => problem,
            Err(refusal) => return Err((refusal, Box::new(chosen))),
        };
        let (chosen, problem, stand_in) = decided(chosen, problem)?;
        match PreparedLayer::new(&problem, &chosen.methods) {
            Ok(layer) => Ok(Self::made(chosen, problem, layer, stand_in)),
            Err(refusal) => Err((refusal, Box::new(chosen))),
        }
    }

    /// Before anything is solved.
    fn made(chosen: Chosen, problem: Problem, layer: PreparedLayer, stand_in: Option<StandIn>) -> Self {
        Self {
            chosen,
            problem,
            layer,
            ladder: Ladder::default(),
            judged: None,
            stand_in,
            aside: None,
            budget: BUDGET,
            usual: None,
            untold: None,
        }
    }

    /// Why it would be refused before anything is computed.
    pub(super) fn would_refuse(&self) -> Option<Refusal> {
        let told = match self.chosen.scene.solver.model {
            Some(Model::Thin) => thin::told(&self.problem, self.layer.response()).map(|_| ()),
            _ => self.layer.serves(self.problem.wants_depth()),
        };
        told.err().or_else(|| self.lacks_depths().filter(|_| self.problem.is_pressed_by_depth()))
    }

    /// Why depths are not told though the layer names a datum: its flexibility knows none.
    fn lacks_depths(&self) -> Option<Refusal> {
        if self.problem.layer.datum.is_none() || self.layer.has_depths() {
            return None;
        }
        Some(Refusal::NotBuilt {
            what: format!("an indentation against a datum by flexibility `{}`", self.chosen.plan.flexibility),
            remedy: "take `flexibility = { type = \"compliance\" }`".into(),
        })
    }

    /// What is not told though it is asked for, and why.
    fn missing(&self) -> Vec<String> {
        let shear = self.untold.as_ref().map(|(_, why)| format!("the shear is not solved: {why}"));
        let depth = if self.problem.wants_depth() { self.lacks_depths() } else { None };
        shear.into_iter().chain(depth.map(|why| format!("the indentation is not known: {why}"))).collect()
    }

    /// How it would be solved.
    pub(super) fn planned(&self) -> Plan {
        self.in_closed_form().map_or_else(|| self.chosen.plan.clone(), |solution| solution.plan)
    }

    /// Prepares another scene of the same layer, with all that is known of the layer already; refuses a scene
    /// of another layer, or one that asks for other methods.
    pub fn on(layer: Layer, scene: &Scene) -> Result<Self, Refusal> {
        bounds(scene)?;
        let chosen = choose(scene);
        let problem = Problem::new(&chosen.scene)?;
        if !layer.is_of(&chosen.scene) {
            return Err(Refusal::NotBuilt {
                what: "solving a scene on the tables of another layer, or of other methods,".into(),
                remedy: "prepare it by itself: `Solver::new`".into(),
            });
        }
        let (chosen, problem, stand_in) = decided(chosen, problem).map_err(|(refusal, _)| refusal)?;
        let known = (!layer.is_model).then_some(layer);
        if stand_in.is_some() {
            let model = PreparedLayer::new(&problem, &chosen.methods)?;
            return Ok(Self { aside: known, ..Self::made(chosen, problem, model, stand_in) });
        }
        let (layer, flat_punches) = prepared(known, &problem, &chosen)?;
        let ladder = Ladder::inheriting(flat_punches);
        Ok(Self { ladder, ..Self::made(chosen, problem, layer, stand_in) })
    }

    /// The layer, to be used under another punch.
    pub fn into_layer(mut self) -> Layer {
        self.go_back();
        let scene = &self.chosen.scene;
        match (self.stand_in, self.aside) {
            (None, _) => Layer::known(self.layer, scene, self.ladder.into_flat_punches()),
            (Some(_), Some(layer)) => layer,
            (Some(_), None) => Layer::modelled(self.layer, &choose(&self.chosen.before_model()).scene),
        }
    }

    /// Takes another budget of work than [`BUDGET`](super::BUDGET) for each load: where refinement would exceed half of
    /// it, it ends, and the result says so.
    pub fn limit(&mut self, budget: u64) {
        self.budget = budget;
        if let Some(usual) = &mut self.usual {
            usual.limit(budget);
        }
    }

    /// Takes another load; of a path, that one alone.
    pub fn press(&mut self, load: Load) {
        self.go_back();
        self.load(load);
    }

    /// The same with the methods at hand.
    fn load(&mut self, load: Load) {
        self.chosen.scene.load = load;
        self.chosen.scene.path = None;
        self.problem.press(load);
        self.judged = None;
    }

    /// Takes another friction coefficient; the strain in the stick zone stays what the scene says of it.
    ///
    /// # Panics
    /// When the scene was prepared without friction: there are no kernels for it.
    pub fn rub(&mut self, friction: Friction) {
        self.go_back();
        assert!(self.chosen.scene.friction.is_some(), "the scene was prepared without friction");
        let Friction::Goodman { coefficient, .. } = friction;
        if let Some(Friction::Goodman { coefficient: present, .. }) = &mut self.chosen.scene.friction {
            *present = coefficient;
        }
        // Of a scene that asks for nothing of the shear nothing depends on it.
        if self.problem.friction.is_some() {
            self.problem.rub(friction);
            self.judged = None;
        }
    }

    /// Solves for the present load, and for those on the way to it where the scene asks for them. Whatever happens is
    /// in the solution's `status` and `reason`, or in its path's.
    pub fn solve(&mut self) -> Solution {
        if let Some(solution) = self.in_closed_form() {
            return solution;
        }
        let found = if self.judged.is_some() { Ok(()) } else { self.find() };
        let reported = found.and_then(|()| self.report_within().map_err(|refusal| self.explained(refusal)));
        let mut solution = match reported {
            Ok(solution) => solution,
            Err(refusal) => {
                // Of a shape that is not defined all over the contact there may be no more to tell than that.
                let flaw = self.problem.flaw_under_load();
                let reason = flaw.map_or_else(|| refusal.to_string(), |flaw| self.problem.objection(&flaw));
                return Solution::refused(
                    &with_friction(&self.chosen.scene, self.untold.as_ref()),
                    self.chosen.plan.clone(),
                    reason,
                );
            }
        };
        // A solution is large, and stays where it is as a rule.
        for why in self.missing() {
            solution = solution.lacking(&why);
        }
        if let Some(path) = self.chosen.scene.path.clone() {
            let last = self.point();
            solution.path = Some(self.curve_to(&path, last));
            solution.plan.work = self.spent();
            self.press(path.last());
            self.chosen.scene.path = Some(path);
        }
        solution
    }

    fn tolerance(&self) -> f64 {
        self.chosen.scene.solver.tolerance.get()
    }

    /// The work so far, on friction that was left out in the end, too.
    fn spent(&self) -> u64 {
        let on_friction = self.usual.as_ref().filter(|_| self.untold.is_some());
        self.layer.meter().spent() + on_friction.map_or(0, |usual| usual.layer.meter().spent())
    }

    /// The report of what was found; without tractions where these would take more than is left of the budget.
    fn report_within(&mut self) -> Result<Solution, Refusal> {
        let told = self.report();
        let Err(refusal) = &told else { return told };
        let wishes = self.problem.wishes;
        if !wishes.profile || self.layer.meter().within().is_ok() {
            return told;
        }
        self.problem.wishes.profile = false;
        let numbers = self.report();
        self.problem.wishes = wishes;
        let why = format!("the tractions are not known: {refusal}");
        numbers.map(|numbers| numbers.lacking(&why))
    }

    /// The report of what was found.
    fn report(&mut self) -> Result<Solution, Refusal> {
        let Some(judged) = &self.judged else { unreachable!("found before") };
        let (tolerance, spent) = (self.tolerance(), self.spent());
        let work = self.ladder.work();
        let stage = self.ladder.stage(judged.step);
        let judgement = verdict(&self.layer, &self.problem, stage, judged, tolerance);
        let plan = Plan {
            unknowns: stage.unknowns(),
            flexibility_evaluations: self.layer.flexibility_evaluations(),
            kernel_evaluations: self.layer.kernel_evaluations(),
            factorisations: work.factorisations,
            operations: work.operations,
            work: spent,
            bound: Some(judged.of_model),
            ..self.chosen.plan.clone()
        };
        let solved = Solved { layer: &self.layer, problem: &self.problem, stage, judged };
        assemble::solution(&with_friction(&self.chosen.scene, self.untold.as_ref()), plan, solved, judgement)
    }
}

/// A scene as it is reported: with the friction that was left out.
fn with_friction<'s>(scene: &'s Scene, left_out: Option<&(Friction, Refusal)>) -> Cow<'s, Scene> {
    let Some((friction, _)) = left_out else { return Cow::Borrowed(scene) };
    Cow::Owned(Scene { friction: Some(*friction), ..scene.clone() })
}

/// A layer to solve a scene on, with the flat punches that are known of it: the one at hand, or a new one.
fn prepared(known: Option<Layer>, problem: &Problem, chosen: &Chosen) -> Result<(PreparedLayer, FlatPunches), Refusal> {
    match known {
        Some(layer) => Ok(layer.for_scene(&chosen.scene)),
        None => Ok((PreparedLayer::new(problem, &chosen.methods)?, FlatPunches::default())),
    }
}

/// A scene with its solid decided: as described, or by a model.
#[allow(clippy::type_complexity)] // once
pub(super) fn decided(
    chosen: Chosen,
    problem: Problem,
) -> Result<(Chosen, Problem, Option<StandIn>), (Refusal, Box<Chosen>)> {
    let stand_in = match stand_in::decide(&chosen.scene, &problem, chosen.is_open) {
        Decision::Full => return Ok((chosen, problem, None)),
        Decision::Cheaper(stand_in) => stand_in,
        Decision::Inapplicable(why) => {
            return Err((Refusal::OutOfReach { method: "model", why, remedy: stand_in::REMEDY }, Box::new(chosen)));
        }
    };
    let modelled = stand_in.modelled(&chosen.scene, &problem);
    let because = stand_in.reason(&problem);
    let thickness = problem.length;
    match Problem::new(&modelled) {
        Ok(problem) => {
            let stand_in = stand_in.in_units(thickness / problem.length);
            Ok((chosen.with(stand_in.model, &modelled.layer, because), problem, Some(stand_in)))
        }
        Err(refusal) => Err((refusal, Box::new(chosen))),
    }
}
