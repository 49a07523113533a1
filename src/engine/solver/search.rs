//! Which grids, methods and solids are tried, one after another, until the numbers are found.

use super::{Solver, prepared};
use crate::engine::accuracy::quantity::Quantity;
use crate::engine::culprit::culprit;
use crate::engine::problem::{LoadInLayerUnits, Problem};
use crate::engine::refine::judged::{Judged, ROUNDED, UNKNOWN};
use crate::engine::refine::{Aim, FlatPunches, Ladder};
use crate::engine::stand_in;
use crate::plan::{Chosen, choose};
use crate::scene::check::bounded;
use crate::scene::{Asked, Model};
use slipzone_api::Refusal;

/// Share of a budget that is left for other methods where the first used it up: `graded-panels` take longer for the
/// same work.
const LEFT_FOR_OTHERS: u64 = 10;
/// What other methods find is taken where its errors are at most this part of those of what was found first.
const FAR_LESS: f64 = 0.1;

impl Solver {
    /// Finds the numbers, and keeps them for [`Self::solve`]; writes no report. Refinement ends where its work would
    /// exceed the [budget](crate::engine::BUDGET); where that is for the shear, the pressure is found without.
    pub fn find(&mut self) -> Result<(), Refusal> {
        let found = self.find_by_any();
        if let Some(why) = self.misses_friction(&found)
            && let Some(other) = self.pressure_alone(why)
        {
            // Not to the methods that found nothing either.
            self.go_back();
            self.stand_aside_for(other);
            return Ok(());
        }
        found
    }

    /// The same by the methods chosen, or by others.
    fn find_by_any(&mut self) -> Result<(), Refusal> {
        self.layer.meter().begin(self.budget);
        let found = self.find_within();
        if let Some(other) = found.as_ref().err().and_then(|refusal| self.chosen.instead(refusal)) {
            self.go_on_with(other)?;
            return self.find_by_any();
        }
        if found.is_ok()
            && self.may_be_bettered()
            && let Some(other) = self.chosen.otherwise()
            && let Some(other) = self.bettered_by(other, self.budget / LEFT_FOR_OTHERS)
        {
            self.stand_aside_for(other);
            return Ok(());
        }
        found
    }

    /// Leaves the present load to another solver.
    fn stand_aside_for(&mut self, other: Self) {
        let usual = std::mem::replace(self, other);
        self.usual = Some(Box::new(usual));
    }

    /// Why nothing was found: what a plugin gave in place of a number says more than what came of it.
    pub(super) fn explained(&self, refusal: Refusal) -> Refusal {
        culprit(&self.chosen.methods, &self.layer).unwrap_or(refusal)
    }

    /// Whether what was found misses the tolerance for what its methods lack: budget, room, or convergence. A model
    /// that the scene forces misses it by itself, and rounding is in other methods, too.
    fn may_be_bettered(&self) -> bool {
        let is_open = self.judged.as_ref().is_some_and(|found| !found.is_hopeless) && self.stand_in.is_none();
        is_open && self.worst() > self.tolerance().max(ROUNDED)
    }

    /// The largest error of what was found and has to meet the tolerance.
    fn worst(&self) -> f64 {
        self.judged.as_ref().map_or(f64::INFINITY, Judged::worst)
    }

    /// The same load on another scene, or by other methods, within a budget, where these meet the tolerance or miss it
    /// by far less.
    fn bettered_by(&self, chosen: Chosen, budget: u64) -> Option<Self> {
        let mut other = Self::prepare(chosen).ok()?;
        other.problem.wishes = self.problem.wishes;
        other.limit(budget);
        other.find_by_any().ok()?;
        other.limit(self.budget);
        // Telling what was found has its own.
        other.begin_whole();
        if let (Some(found), Some(first)) = (&mut other.judged, &self.judged)
            && found.stopped.is_some()
            && first.stopped.is_some()
        {
            // Of the budget that the scene has, not of what was left for this.
            found.stopped.clone_from(&first.stopped);
        }
        (other.worst() <= self.tolerance().max(FAR_LESS * self.worst())).then_some(other)
    }

    /// Why nothing is known of the pressure, where that is the work which the shear takes.
    fn misses_friction(&self, found: &Result<(), Refusal>) -> Option<Refusal> {
        self.problem.friction?;
        let refusal = match (found, &self.judged) {
            (Err(refusal), _) => refusal,
            (Ok(()), Some(judged)) if judged.of_all_pressure() > UNKNOWN => judged.stopped.as_ref()?,
            _ => return None,
        };
        matches!(refusal, Refusal::Limit { .. }).then(|| refusal.clone())
    }

    /// The same scene and load without friction, which the pressure does not depend on, where that tells it.
    fn pressure_alone(&self, why: Refusal) -> Option<Self> {
        let mut scene = self.chosen.before_model();
        let friction = scene.friction.take()?;
        if !Asked::NAMES.iter().any(|name| !name.starts_with("stick") && scene.output.asks(name)) {
            return None;
        }
        let dry = self.bettered_by(choose(&scene), self.budget);
        let mut other = dry.filter(|dry| dry.worst() <= UNKNOWN)?;
        (other.usual, other.untold) = (None, Some((friction, why)));
        Some(other)
    }

    /// A budget of which nothing is kept for telling what is found.
    pub(super) fn begin_whole(&self) {
        self.layer.meter().begin(self.budget);
        self.layer.meter().conclude();
    }

    /// Goes back to the methods that other loads take.
    pub(super) fn go_back(&mut self) {
        if let Some(usual) = self.usual.take() {
            *self = *usual;
        }
    }

    /// The same within what is left of a budget. Tables that grew for a load which was refused in the end are as coarse
    /// as they are far: no other load is to be solved with them.
    pub(super) fn find_within(&mut self) -> Result<(), Refusal> {
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
        if self.problem.is_pressed_by_depth()
            && let Some(why) = self.lacks_depths()
        {
            return Err(why);
        }
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
            return self.find_by_any();
        }
        self.judged = Some(found);
        Ok(())
    }

    /// The contact where it ends before the first kink of the shape, and is solved as a smooth one; `None` where it
    /// does not, or is not found so to the tolerance, and whenever it was not before.
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

    /// What refinement finds. A smooth shape that has details is solved as one with kinks where it does not converge,
    /// and to the end as it is where it does not converge so either.
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
}
