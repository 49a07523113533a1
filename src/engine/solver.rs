//! A scene made ready to be solved for one load after another.

mod curve;

use super::assemble::{self, Solved};
use super::foreign;
use super::layer::Layer;
use super::prepared_layer::PreparedLayer;
use super::problem::{LoadInLayerUnits, Problem};
use super::refine::{Aim, FlatPunches, Ladder};
use super::solution::{Solution, Status};
use super::stand_in::{self, Decision, StandIn};
use super::verdict::verdict;
use crate::engine::accuracy::quantity::Quantity;
use crate::engine::refine::judged::{Judged, ROUNDED};
use crate::engine::stand_in::thin;
use crate::engine::work::budget::BUDGET;
use crate::plan::{Chosen, Plan, choose};
use crate::scene::check::{bounded, bounds};
use crate::scene::{Load, Model, Scene};
use slipzone_api::{Friction, Refusal};

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
    /// What another load is solved by, where the present one took other methods.
    usual: Option<Box<Self>>,
}

/// Share of a budget that is left for other methods where the first used it up: `graded-panels` take longer for the same work.
const LEFT_FOR_OTHERS: u64 = 10;
/// What other methods find is taken where its errors are at most this part of those of what was found first.
const FAR_LESS: f64 = 0.1;

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
        let ladder = Ladder::default();
        Self { chosen, problem, layer, ladder, judged: None, stand_in, aside: None, budget: BUDGET, usual: None }
    }

    /// Why it would be refused before anything is computed.
    pub(super) fn would_refuse(&self) -> Option<Refusal> {
        let told = match self.chosen.scene.solver.model {
            Some(Model::Thin) => thin::told(&self.problem, self.layer.response()).map(|_| ()),
            _ => self.layer.serves(self.problem.wants_depth()),
        };
        told.err()
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
    #[must_use]
    pub fn into_layer(mut self) -> Layer {
        self.go_back();
        let scene = &self.chosen.scene;
        match (self.stand_in, self.aside) {
            (None, _) => Layer::known(self.layer, scene, self.ladder.into_flat_punches()),
            (Some(_), Some(layer)) => layer,
            (Some(_), None) => Layer::modelled(self.layer, &choose(&self.chosen.before_model()).scene),
        }
    }

    /// Takes another budget of work than [`BUDGET`](super::BUDGET) for each load: where refinement would exceed half of it,
    /// it ends, and the result says so.
    pub fn limit(&mut self, budget: u64) {
        self.budget = budget;
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
        assert!(self.chosen.scene.friction.is_some(), "the scene was prepared without friction");
        self.go_back();
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

    /// Finds the numbers, and keeps them for [`Self::solve`]; writes no report. Refinement ends where its work would exceed
    /// the [budget](super::BUDGET).
    pub fn find(&mut self) -> Result<(), Refusal> {
        self.layer.meter().begin(self.budget);
        let found = self.find_within();
        if let Some(other) = found.as_ref().err().and_then(|refusal| self.chosen.instead(refusal)) {
            self.go_on_with(other)?;
            return self.find();
        }
        if found.is_ok()
            && self.may_be_bettered()
            && let Some(other) = self.chosen.otherwise()
            && let Some(other) = self.bettered_by(other)
        {
            let usual = std::mem::replace(self, other);
            self.usual = Some(Box::new(usual));
            return Ok(());
        }
        found
    }

    /// Why nothing was found: what a plugin gave in place of a number says more than what came of it.
    fn explained(&self, refusal: Refusal) -> Refusal {
        foreign::culprit(&self.chosen.methods, &self.layer).unwrap_or(refusal)
    }

    /// Whether what was found misses the tolerance for what its methods lack: budget, room, or convergence. A model that the scene
    /// forces misses it by itself, and rounding is in other methods, too.
    fn may_be_bettered(&self) -> bool {
        let is_open = self.judged.as_ref().is_some_and(|found| !found.is_hopeless) && self.stand_in.is_none();
        is_open && self.worst() > self.tolerance().max(ROUNDED)
    }

    fn tolerance(&self) -> f64 {
        self.chosen.scene.solver.tolerance.get()
    }

    /// The largest error of what was found and has to meet the tolerance.
    fn worst(&self) -> f64 {
        self.judged.as_ref().map_or(f64::INFINITY, Judged::worst)
    }

    /// The same scene and load by other methods, where these meet the tolerance or miss it by far less.
    fn bettered_by(&self, chosen: Chosen) -> Option<Self> {
        let mut other = Self::prepare(chosen).ok()?;
        other.problem.wishes = self.problem.wishes;
        other.limit(self.budget / LEFT_FOR_OTHERS);
        other.find().ok()?;
        other.limit(self.budget);
        // Telling what was found has its own.
        other.begin_whole();
        (other.worst() <= self.tolerance().max(FAR_LESS * self.worst())).then_some(other)
    }

    /// A budget of which nothing is kept for telling what is found.
    fn begin_whole(&self) {
        self.layer.meter().begin(self.budget);
        self.layer.meter().conclude();
    }

    /// Goes back to the methods that other loads take.
    fn go_back(&mut self) {
        if let Some(usual) = self.usual.take() {
            *self = *usual;
        }
    }

    /// The same within what is left of a budget. Tables that grew for a load which was refused in the end are as coarse as they are far:
    /// no other load is to be solved with them.
    fn find_within(&mut self) -> Result<(), Refusal> {
        let reach = self.layer.reach();
        let found = self.found_within().map_err(|refusal| self.explained(refusal));
        if found.is_err() && self.layer.reach() > reach {
            self.judged = None;
            self.layer.forget();
            self.ladder.begin_again(|_| FlatPunches::default());
        }
        found
    }

    /// The same, whatever becomes of the tables.
    fn found_within(&mut self) -> Result<(), Refusal> {
        bounded(self.chosen.scene.load)?;
        self.layer.meter().within()?;
        let solver = &self.chosen.scene.solver;
        if solver.model == Some(Model::Thin) {
            // Told in closed form by `solve`.
            let what = "a loading curve by the model `thin`".into();
            return Err(Refusal::NotBuilt { what, remedy: "leave out `solver.model`, or solve load by load".into() });
        }
        let tolerance = solver.tolerance.get();
        let Some(stand_in) = self.stand_in else {
            self.judged = Some(self.refined(tolerance)?);
            return Ok(());
        };
        let mut found = self.refined(stand_in::SHARE * tolerance)?;
        let half_width = found.outcome.numbers.get(Quantity::HalfWidth).unwrap_or(f64::INFINITY);
        let bound = stand_in.bound(&self.problem, half_width);
        found.errors = found.errors.and(&bound);
        if let (Some(numerical), Some(bound)) = (&mut found.of_shear, bound.get(Quantity::StickHalfWidth)) {
            *numerical += bound;
        }
        found.of_model = bound.worst().map_or(0.0, |(_, bound)| bound);
        found.of_pressure = found.of_pressure.map(|numerical| numerical + found.of_model);
        if !stand_in.is_forced && found.errors.worst().is_some_and(|(_, error)| error > tolerance) {
            // Guessed too narrow a contact, or a scene that is hard for the numbers.
            self.solve_in_full()?;
            return self.find();
        }
        self.judged = Some(found);
        Ok(())
    }

    /// The contact where it ends before the first kink of the shape, and is solved as a smooth one; `None` where it does not, or is not
    /// found so to the tolerance, and whenever it was not before.
    fn before_kinks(&mut self, tolerance: f64) -> Option<Judged> {
        let Self { chosen, problem, layer, ladder, .. } = self;
        if !problem.ends_before_kinks {
            return None;
        }
        let aim = Aim { problem, methods: &chosen.methods, tolerance };
        let is_wider = matches!(problem.load, LoadInLayerUnits::HalfWidth(b) if b > problem.reach());
        let found = if is_wider { None } else { ladder.refine(layer, aim).ok() };
        let found = found.filter(|found| found.worst() <= tolerance);
        if found.is_none() {
            problem.ends_before_kinks = false;
            layer.meter().resume();
            ladder.begin_again(Ladder::into_flat_punches);
        }
        found
    }

    /// What refinement finds. A smooth shape that has details is solved as one with kinks where it does not converge, and to the end
    /// as it is where it does not converge so either.
    fn refined(&mut self, tolerance: f64) -> Result<Judged, Refusal> {
        if let Some(found) = self.before_kinks(tolerance) {
            return Ok(found);
        }
        let Self { chosen, problem, layer, ladder, .. } = self;
        let methods = &chosen.methods;
        let found = ladder.refine(layer, Aim { problem, methods, tolerance })?;
        if !found.misses_details(problem, tolerance) {
            return Ok(found);
        }
        let mut work = ladder.work();
        let mut again = |is_detailed| {
            layer.meter().resume();
            problem.is_detailed = Some(is_detailed);
            let mut ladder = Ladder::default();
            let found = ladder.refine(layer, Aim { problem, methods, tolerance });
            work = work + ladder.work();
            found.map(|found| (found.worst(), found, ladder))
        };
        let error = |solved: &Result<(f64, _, _), Refusal>| solved.as_ref().map_or(f64::INFINITY, |solved| solved.0);
        let mut best = again(true);
        if error(&best) > tolerance {
            let smooth = again(false);
            if error(&smooth) <= error(&best) {
                best = smooth;
            } else {
                problem.is_detailed = Some(true);
            }
        }
        let (_, found, best) = best?;
        *ladder = best;
        ladder.take_over(work);
        Ok(found)
    }

    /// Goes back to the solid itself.
    fn solve_in_full(&mut self) -> Result<(), Refusal> {
        let mut chosen = choose(&self.chosen.before_model());
        chosen.plan.reasons.insert(0, "full: the error of a cheaper model was found to exceed the tolerance".into());
        self.go_on_with(chosen)
    }

    /// Goes on with other methods, or another solid, for the same scene.
    fn go_on_with(&mut self, chosen: Chosen) -> Result<(), Refusal> {
        let wishes = self.problem.wishes;
        self.problem = Problem::new(&chosen.scene)?;
        self.problem.wishes = wishes;
        let known = self.aside.take().filter(|layer| layer.is_of(&chosen.scene));
        let (layer, flat_punches) = prepared(known, &self.problem, &chosen)?;
        self.layer = layer;
        self.ladder.begin_again(|_| flat_punches);
        (self.chosen, self.stand_in, self.judged) = (chosen, None, None);
        Ok(())
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
                return Solution::refused(&self.chosen.scene, self.chosen.plan.clone(), reason);
            }
        };
        if let Some(path) = self.chosen.scene.path.clone() {
            let last = self.point();
            solution.path = Some(self.curve_to(&path, last));
            solution.plan.work = self.layer.meter().spent();
            self.press(path.last());
            self.chosen.scene.path = Some(path);
        }
        solution
    }

    /// The contact on a layer that is thin enough to be told in closed form, or that the scene wants to be taken for one.
    fn in_closed_form(&self) -> Option<Solution> {
        let solver = &self.chosen.scene.solver;
        if solver.model == Some(Model::Thin) {
            let refused =
                |refusal: Refusal| Solution::refused(&self.chosen.scene, self.chosen.plan.clone(), refusal.to_string());
            return Some(self.thin().unwrap_or_else(refused));
        }
        let is_open = self.chosen.is_open && solver.model.is_none() && self.stand_in.is_none();
        let serves = || {
            thin::obstacle(&self.problem, self.chosen.scene.path.is_some()).is_none()
                && thin::may_serve(&self.problem, stand_in::SHARE * solver.tolerance.get())
        };
        if !is_open || solver.forbid.contains(&Model::Thin) || !serves() {
            return None;
        }
        self.thin().ok().filter(|solution| solution.status == Status::Converged)
    }

    /// The contact by the model `thin`, which nothing keeps from being asked, see [`thin::obstacle`].
    fn thin(&self) -> Result<Solution, Refusal> {
        let Self { chosen, problem, layer, .. } = self;
        bounded(chosen.scene.load)?;
        let (numbers, errors) = thin::told(problem, layer.response())?;
        let worst = errors.worst().map_or(0.0, |(_, error)| error);
        let judgement = if worst <= chosen.scene.solver.tolerance.get() {
            (Status::Converged, None)
        } else {
            let reason =
                format!("the model `thin` is good to {worst:.0e} here; leave out `solver.model`, or ask for less");
            (Status::NotConverged, Some(reason))
        };
        let reason = format!(
            "thin: each point of the surface yields by what presses on it, edges shifted, to within {worst:.0e}; no kernel \
             and no system is needed"
        );
        let plan = Plan {
            model: Model::Thin,
            bound: Some(worst),
            flexibility_evaluations: thin::EVALUATIONS,
            reasons: vec![reason.into()],
            ..chosen.plan.clone()
        };
        assemble::in_closed_form(&chosen.scene, plan, problem, (&numbers, &errors), judgement)
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
        let why = format!("the tractions are not told: {refusal}");
        numbers.map(|numbers| numbers.lacking(&why))
    }

    /// The report of what was found.
    fn report(&mut self) -> Result<Solution, Refusal> {
        let Some(judged) = &self.judged else { unreachable!("found before") };
        let tolerance = self.tolerance();
        let work = self.ladder.work();
        let stage = self.ladder.stage(judged.step);
        let judgement = verdict(&self.layer, &self.problem, stage, judged, tolerance);
        let plan = Plan {
            unknowns: stage.unknowns(),
            flexibility_evaluations: self.layer.flexibility_evaluations(),
            kernel_evaluations: self.layer.kernel_evaluations(),
            factorisations: work.factorisations,
            operations: work.operations,
            work: self.layer.meter().spent(),
            bound: Some(judged.of_model),
            ..self.chosen.plan.clone()
        };
        let solved = Solved { layer: &self.layer, problem: &self.problem, stage, judged };
        assemble::solution(&self.chosen.scene, plan, solved, judgement)
    }
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
