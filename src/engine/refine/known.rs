//! What another load, or another punch on the same layer, tells of a contact that grows.

use super::aim::Aim;
use super::estimate::fastest;
use super::ladder::Ladder;
use super::{BOUND_LEVEL, FINEST, is_known_between};
use crate::engine::accuracy::error_estimate::{Pace, Seen, extrapolated};
use crate::engine::accuracy::quantity::{Numbers, Quantity};
use crate::engine::outcome::{Outcome, Task};
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::problem::{LoadInLayerUnits, Problem};
use crate::engine::refine::judged::{How, Judged, meets, with_the_rest};
use crate::engine::refine::stage::Stage;

/// What a step of refinement leaves of what it changed, on a loading curve; a tenth to a fortieth is seen.
const LEFT: f64 = 0.1;
/// Steps that a loading curve may take beyond those of its last load.
const MORE: usize = 1;

impl Ladder {
    /// Sizes of a contact on its way to a load that was refined already, each with an estimate of its error; `None`
    /// where no stack tells them.
    pub(in crate::engine) fn on_the_way(
        &mut self,
        layer: &mut PreparedLayer,
        aim: Aim,
        judged: &Judged,
        loads: &[LoadInLayerUnits],
    ) -> Option<Vec<(Numbers, f64)>> {
        let before = judged.step.checked_sub(1).filter(|_| judged.how != How::Twin)?;
        let half_width = judged.outcome.numbers.get(Quantity::HalfWidth)?;
        let (_, error) = judged.errors.worst()?;
        let mut told = |step: usize, sure: bool| {
            let task = self.made(aim, step)?;
            self.stages[step].growing.as_mut()?.on_the_way(layer, task, (half_width, sure), loads)
        };
        let left = |coarse: &Numbers, fine: &Numbers| error.max(LEFT * fine.change_from(coarse));
        // The flat punches may take a step more than their stack did.
        let mut coarse = told(before, false)?;
        for step in judged.step..=(judged.step + MORE).min(FINEST) {
            let fine = told(step, true)?;
            let each = coarse.iter().zip(&fine);
            let errors: Vec<f64> = each.map(|((coarse, _), (fine, lost))| left(coarse, fine).max(*lost)).collect();
            if step == judged.step + MORE || errors.iter().all(|error| *error <= aim.tolerance) {
                return Some(fine.into_iter().zip(errors).map(|((numbers, _), error)| (numbers, error)).collect());
            }
            coarse = fine;
        }
        None
    }

    /// Takes note of how a contact that grew was settled.
    pub(super) fn remember(
        &mut self,
        layer: &PreparedLayer,
        problem: &Problem,
        (step, outcome): (usize, &Outcome),
        history: &[Seen],
    ) {
        self.settled = Some(step);
        let pace = Pace::seen(history, fastest(layer, problem, outcome, self.stages[step].unknowns()));
        self.pace = outcome.numbers.get(Quantity::HalfWidth).zip(pace);
    }

    /// A contact no wider than one that was settled, under another load, or a stack of the same flat punches under
    /// another punch: the step that was fine enough then and the one before tell how fine it is now. `None` where it
    /// wants finer steps, or is refused: whether it is, and why, is left to these.
    pub(super) fn pressed_again(&mut self, layer: &mut PreparedLayer, aim: Aim) -> Option<Judged> {
        let (step, (widest, pace)) = self.settled.zip(self.pace)?;
        let coarse = self.solve_again(layer, aim, (step.checked_sub(1)?, widest), None)?;
        let outcome = self.solve_again(layer, aim, (step, widest), Some(&coarse))?;
        let errors = pace.judge(&coarse.seen(), &outcome.seen());
        let kernels_proven = layer.is_proven();
        let mut found = Judged::new(outcome, step, errors, How::Again { kernels_proven });
        if !self.is_sure(layer, aim, &mut found) {
            if aim.problem.is_stacked() {
                return None;
            }
            // One step more is less than all of them again.
            let finer = self.solve_again(layer, aim, (step + 1, widest), Some(&found.outcome))?;
            let seen = [&coarse, &found.outcome, &finer].map(Outcome::seen);
            let errors = extrapolated(&seen, fastest(layer, aim.problem, &finer, self.stages[step + 1].unknowns()))?;
            found = Judged::new(finer, step + 1, errors, How::Sequence { count: seen.len(), kernels_proven });
            if !self.is_sure(layer, aim, &mut found) {
                return None;
            }
        }
        layer.meter().conclude();
        let task = self.task(aim, found.step);
        self.stages[found.step].settle(layer, task, &mut found.outcome).ok()?;
        Some(found)
    }

    /// Makes the stages up to a step, and tells what the last needs to know.
    fn made<'a>(&mut self, aim: Aim<'a>, step: usize) -> Option<Task<'a>> {
        self.make(aim, step).ok()?;
        Some(self.task(aim, step))
    }

    /// [`Stage::solve_again`]; `None` where the contact would be wider than that given, too: it may take finer steps.
    fn solve_again(
        &mut self,
        layer: &mut PreparedLayer,
        aim: Aim,
        (step, widest): (usize, f64),
        coarse: Option<&Outcome>,
    ) -> Option<Outcome> {
        let task = self.made(aim, step)?;
        let found = self.stages[step].solve_again(layer, task, widest, coarse).ok()??;
        found.numbers.get(Quantity::HalfWidth).is_some_and(|b| b <= widest).then_some(found)
    }

    /// Whether what was found meets the tolerance, between the nodes, too, which is noted.
    fn is_sure(&self, layer: &PreparedLayer, aim: Aim, found: &mut Judged) -> bool {
        let Judged { outcome, step, errors, of_pressure, .. } = found;
        let all = with_the_rest(aim.problem, layer, outcome, aim.tolerance, *errors);
        *of_pressure = self.lost_between(aim, *step);
        meets(aim.problem, &all, aim.tolerance) && is_known_between(*of_pressure, aim.tolerance)
    }

    /// The first of the last three steps that another contact took on this layer, where the coarsest one finds this one
    /// among the flat punches of all of them: the estimate looks at three, and those before would cost more than they
    /// tell.
    pub(super) fn known_from(&mut self, aim: Aim, coarsest: &Outcome) -> Option<usize> {
        let settled = self.settled?;
        let later = settled.checked_sub(2)?.min(BOUND_LEVEL);
        let half_width = coarsest.numbers.get(Quantity::HalfWidth)?;
        self.make(aim, settled).ok()?;
        let task = self.task(aim, 0);
        let serves = |stage: &Stage| stage.growing.as_ref().is_some_and(|growing| growing.serves(task, half_width));
        (later > 1 && self.stages[1..=settled].iter().all(serves)).then_some(later)
    }
}
