//! Refines a scene until its error estimate meets the tolerance.

use super::error_estimate::{Fastest, Pace, ROUNDING, SAFETY, SLIP_ROUNDING, Seen, extrapolated, judged_by_twin};
use super::family::Family;
use super::growing::Growing;
use super::judged::{
    BETWEEN, How, Judged, ROUNDED, SHEAR, between_members, has_details, hidden_details, left_by_sticking, meets,
    share_in_middle, share_in_shear, with_the_rest, worst_judged,
};
use super::layer::{Layer, Wanted};
use super::problem::{LoadInLayerUnits, Problem};
use super::quantity::{Numbers, Quantity};
use super::rubbing::{Rubbing, Verdict};
use super::stage::{Outcome, Stage, Task};
use super::work::Work;
use crate::plan::Methods;
use arrayvec::ArrayVec;
use slipzone_api::Refusal;
use std::ops::Add;

/// Most steps of refinement, and more than most scenes take.
const FINEST: usize = 13;
const USUAL_STEPS: usize = 8;
/// Tolerances below which that many more of the coarsest levels are left out, which hardly a pressure converges on, or a shear, or a stack
/// of shears. Searches begin with the coarsest of all nevertheless.
///
/// Sixty random flat punches with friction take 4 % less work at 1e-10 with three levels left out below 3e-11 than below 3e-10; growing
/// contacts 2 to 6 % less at 1e-8 with two below 3e-8 than below 5e-9.
const LEFT_OUT: &[f64] = &[1e-7, 1e-9];
const LEFT_OUT_OF_SHEAR: &[f64] = &[1e-7, 5e-9, 3e-11];
const LEFT_OUT_OF_STACKS: &[f64] = &[1e-7, 3e-8, 3e-10];
/// Level from which refinement no longer helps a stick zone out of reach, or a pressure that pulls.
const BOUND_LEVEL: usize = 4;
/// Level at which a shape that is taken for smooth is looked at, should it not have converged before.
const DETAIL_LEVEL: usize = 6;
/// Extra steps of what the scene left open beside a method that it fixed: of the other method.
const BESIDE_PINNED: u32 = 3;
/// A pressure that is known to within this shows as well as any where friction cannot be told while a contact grows.
const SHOWN: f64 = 1e-3;
/// Steps that may be refused before the first that is solved.
const SKIPPED: usize = 7;
/// Distance of the unknowns in the middle of a contact, over the half-width and times their number, and over the kernels' length where
/// these are not seen.
const WIDE: f64 = 5.5;
const UNSEEN: f64 = 3.0;
/// What a step of refinement leaves of what it changed, on a loading curve; a tenth to a fortieth is seen.
const LEFT: f64 = 0.1;
/// Steps that a loading curve may take beyond those of its last load.
const MORE: usize = 1;
/// Steps that pressure and shear may take beyond those of the numbers, and those of a stack of flat punches, each of which is many.
const FOR_THE_TRACTIONS: usize = 4;
const FOR_STACKED_SHEAR: usize = 3;
/// Of an error of the shear a step of these is to leave no more, or another one is not worth it.
const VAIN: f64 = 0.5;
/// Share of the tolerance that the kernels may use up.
const KERNEL_SHARE: f64 = 0.2;
/// A pressure in the middle below this share of the mean, or of what it was thought to be, wants kernels finer by as much; so does what
/// drives the shear.
const FAINT: f64 = 0.25;
/// No kernels are asked to be finer for that.
const FINEST_KERNELS: f64 = 1e-14;
/// Steps in a row that have to stop shrinking.
const STALLED: usize = 3;
/// Errors that shrink below this share of what no step mends are not worth another one.
const BESIDE_REST: f64 = 0.5;

/// The resolutions solved so far, coarsest first.
#[derive(Default)]
pub(super) struct Ladder {
    stages: Vec<Stage>,
    /// Flat punches of the layer that another punch left behind, by resolution.
    inherited: Vec<Option<Family>>,
    /// The step that was fine enough for a contact that grew.
    settled: Option<usize>,
    /// How fast it was reached, and by how wide a contact.
    pace: Option<(f64, Pace)>,
    /// The least pressure in the middle seen, over the mean, or [`share_in_shear`], where it is faint.
    least_share: Option<f64>,
    /// What cannot be told of friction under the present load, at any resolution.
    forsaken: Option<(f64, Rubbing)>,
    /// Work in the systems of ladders that this one takes the place of.
    before: Work,
}

/// What one punch leaves behind for another on the same layer: the flat punches of each resolution, the step that was fine
/// enough, and how fast it was reached.
#[derive(Default)]
pub(super) struct FlatPunches {
    families: Vec<Option<Family>>,
    settled: Option<usize>,
    pace: Option<(f64, Pace)>,
}

/// What is to be solved, how, and how well.
#[derive(Clone, Copy)]
pub(super) struct Aim<'a> {
    pub(super) problem: &'a Problem,
    pub(super) methods: &'a Methods,
    pub(super) tolerance: f64,
}

/// What the checks of friction leave of a result.
enum Settled {
    /// The stick zone found, and how sure the shear is in it where it was refined by itself.
    Here { shear: Option<f64> },
    /// Another one.
    Elsewhere,
}

impl Ladder {
    /// A ladder for another punch on a layer whose flat punches are known.
    pub(super) fn inheriting(FlatPunches { families, settled, pace }: FlatPunches) -> Self {
        let pace = pace.map(|(half_width, pace)| (half_width, pace.of_another_punch()));
        Self { inherited: families, settled, pace, ..Self::default() }
    }

    /// The flat punches that it leaves behind.
    pub(super) fn into_flat_punches(self) -> FlatPunches {
        let families = self.stages.into_iter().map(|stage| stage.growing?.family).collect();
        FlatPunches { families, settled: self.settled, pace: self.pace }
    }

    /// The stage that a solved contact lives in.
    pub(super) fn stage(&mut self, index: usize) -> &mut Stage {
        &mut self.stages[index]
    }

    /// Work in its systems so far, and in those of ladders that it takes the place of.
    pub(super) fn work(&self) -> Work {
        self.stages.iter().map(Stage::work).fold(self.before, Add::add)
    }

    /// Takes the place of others: `all` is the work on them and on this one.
    pub(super) fn take_over(&mut self, all: Work) {
        self.before = all - (self.work() - self.before);
    }

    /// Solves a problem with the methods given.
    pub(super) fn refine(&mut self, layer: &mut Layer, aim: Aim) -> Result<Judged, Refusal> {
        let is_pinned = aim.methods.kernel.is_pinned() || aim.methods.quadrature.is_pinned();
        let mut judged = if is_pinned { self.with_twin(layer, aim)? } else { self.refined(layer, aim)? };
        judged.conclude(aim.problem, layer, aim.tolerance);
        Ok(judged)
    }

    /// Sizes of a contact on its way to a load that was refined already, each with an estimate of its error; `None` where
    /// no stack tells them.
    pub(super) fn on_the_way(
        &mut self,
        layer: &mut Layer,
        aim: Aim,
        judged: &Judged,
        loads: &[LoadInLayerUnits],
    ) -> Option<Vec<(Numbers, f64)>> {
        let before = judged.stage.checked_sub(1).filter(|_| judged.how != How::Twin)?;
        let half_width = judged.outcome.numbers.get(Quantity::HalfWidth)?;
        let (_, error) = judged.errors.worst()?;
        let mut told = |index: usize| {
            let task = self.made(aim, index)?;
            self.stages[index].growing.as_mut()?.on_the_way(layer, task, half_width, loads)
        };
        let left = |coarse: &Numbers, fine: &Numbers| error.max(LEFT * fine.change_from(coarse));
        // The flat punches may take a step more than their stack did.
        let (mut coarse, _) = told(before)?;
        for index in judged.stage..=(judged.stage + MORE).min(FINEST) {
            let (fine, lost) = told(index)?;
            let errors: Vec<f64> =
                coarse.iter().zip(&fine).map(|(coarse, fine)| left(coarse, fine).max(lost)).collect();
            if index == judged.stage + MORE || errors.iter().all(|error| *error <= aim.tolerance) {
                return Some(fine.into_iter().zip(errors).collect());
            }
            coarse = fine;
        }
        None
    }

    /// Solves at the resolution that the scene fixed, and at the next finer one to tell the error.
    fn with_twin(&mut self, layer: &mut Layer, aim: Aim) -> Result<Judged, Refusal> {
        layer.meter().conclude();
        let level = |is_pinned: bool| if is_pinned { 0 } else { BESIDE_PINNED };
        let (of_kernel, of_quadrature) =
            (level(aim.methods.kernel.is_pinned()), level(aim.methods.quadrature.is_pinned()));
        let mut solve = |index: usize, coarse: Option<&Outcome>| {
            let step = u32::try_from(index).expect("two steps");
            self.solve(layer, aim, (index, of_kernel + step, of_quadrature + step), coarse)
        };
        // The twin first: the tables left are those of the contact reported.
        let twin = solve(1, None)?;
        let mut outcome = solve(0, Some(&twin))?;
        let task = self.task(aim, of_kernel);
        self.stages[0].settle(layer, task, &mut outcome)?;
        let hidden = hidden_details(aim.problem, &outcome, self.stages[0].unknowns());
        let mut errors = judged_by_twin(&outcome.seen(), &twin.seen()).plus(hidden);
        // The few points of the traces do not see the end of the zone.
        if let Some((traced, apart)) = errors.get(Quantity::Shear).zip(self.stages[0].shear_apart(&self.stages[1])) {
            errors.set(Quantity::Shear, traced.max(SAFETY * apart));
        }
        let of_pressure = self.lost_between(aim, 0);
        Ok(Judged { of_pressure, ..Judged::new(outcome, 0, errors, How::Twin) })
    }

    /// Takes finer steps until the estimate meets the tolerance.
    fn refined(&mut self, layer: &mut Layer, aim: Aim) -> Result<Judged, Refusal> {
        let mut estimate = Estimate::default();
        self.forsaken = None;
        let (mut last, mut stopped): (Option<(Outcome, usize)>, _) = (None, None);
        let first = first_level(aim.problem, aim.tolerance);
        // What a search found on the coarsest level is followed from there to the first that matters.
        let after_search =
            Some(left_out(aim.problem, aim.tolerance)).filter(|level| searches(aim.problem) && *level > 1);
        if let Some(judged) = self.pressed_again(layer, aim) {
            return Ok(judged);
        }
        let mut next = 0;
        for step in 0..=FINEST - first {
            if step < next {
                continue;
            }
            let level = level(first, step);
            let coarse = last.as_ref().map(|(outcome, _)| outcome);
            let least_share = self.least_share;
            let solved = self.solve(layer, aim, (step, level, level), coarse);
            let lacking =
                solved.as_ref().ok().and_then(|outcome| self.lacks_room(layer, aim, (step, outcome), &estimate));
            let mut outcome = match solved {
                Ok(outcome) if lacking.is_none() => outcome,
                other => {
                    let refusal = lacking.or(other.err()).expect("the one or the other");
                    if estimate.is_told() {
                        stopped = Some(refusal);
                        break;
                    }
                    // Too coarse for a thin layer: finer steps may do.
                    if step < SKIPPED && matches!(refusal, Refusal::OutOfReach { .. }) {
                        stopped = Some(refusal);
                        continue;
                    }
                    return Err(refusal);
                }
            };
            stopped = None;
            if step == 0
                && let Some(later) = self.known_from(aim, &outcome).or(after_search)
            {
                (next, last) = (later, Some((outcome, step)));
                continue;
            }
            let unknowns = self.stages[step].unknowns();
            // A resolution so coarse may only seem not to tell of friction.
            let is_early = step + first < BOUND_LEVEL && self.stages[step].is_broken();
            // Or else the next kernels are finer ones.
            let has_kernels = self.least_share == least_share;
            let mut done = estimate.add(layer, aim, &outcome, (unknowns, has_kernels)) && !is_early
                || self.is_hopeless(layer, aim, (step, first), &outcome, &estimate.errors);
            if self.is_broken(step, first, &estimate.errors) {
                // The pressure does not depend on it.
                self.forsaken = self.stages[step].growing.as_deref().and_then(Growing::broken).cloned();
            }
            if done || step + first == FINEST {
                let task = self.task(aim, level);
                match self.settle(layer, task, (&mut outcome, step), &estimate.errors) {
                    Ok(Settled::Elsewhere) => {
                        estimate = Estimate::beginning_with(&outcome);
                        done = false;
                    }
                    Ok(Settled::Here { shear }) => estimate.of_shear = shear.or(estimate.of_shear),
                    Err(refusal) if estimate.is_told() => (stopped, done) = (Some(refusal), true),
                    Err(refusal) => return Err(refusal),
                }
            }
            last = Some((outcome, step));
            if done {
                break;
            }
        }
        let Some((outcome, stage)) = last else {
            return Err(stopped.expect("every step was solved or refused"));
        };
        let Estimate { mut history, errors, of_shear, met, .. } = estimate;
        let how = How::Sequence { count: 0, kernels_proven: false };
        let of_pressure = self.lost_between(aim, stage);
        let mut found = Judged { of_shear, of_pressure, stopped, ..Judged::new(outcome, stage, errors, how) };
        if met && found.stopped.is_none() {
            self.refine_for_the_tractions(layer, aim, first, &mut found, &mut history);
        }
        layer.meter().conclude();
        let Judged { outcome, stage, errors, of_shear, stopped, .. } = &mut found;
        if stopped.is_some() {
            // Settled by no step: the last one that could be solved is.
            let task = self.task(aim, level(first, *stage));
            if let Settled::Here { shear: Some(shear) } = self.settle(layer, task, (outcome, *stage), errors)? {
                *of_shear = Some(shear);
            }
        }
        if *errors == Numbers::default() {
            // Changed its mind at the last step.
            outcome.numbers.iter().for_each(|(quantity, _)| errors.set(quantity, 1.0));
        }
        if aim.problem.fixed_half_width().is_none() {
            self.remember(layer, *stage, outcome, &history);
        }
        found.how = How::Sequence { count: history.len(), kernels_proven: layer.is_proven() };
        Ok(found)
    }

    /// [`Stage::lost_between`], where the tractions are asked for.
    fn lost_between(&self, aim: Aim, stage: usize) -> Option<f64> {
        self.stages[stage].lost_between().filter(|_| aim.problem.wishes.profile)
    }

    /// Takes resolutions more than the numbers need: between the nodes the pressure is known later, and the shear may want a finer one,
    /// or finer flat punches. What is found stays where they cannot be had, or are no better.
    fn refine_for_the_tractions(
        &mut self,
        layer: &mut Layer,
        aim: Aim,
        first: usize,
        found: &mut Judged,
        history: &mut ArrayVec<Seen, { FINEST + 1 }>,
    ) {
        let most = if aim.problem.is_stacked() { FOR_STACKED_SHEAR } else { FOR_THE_TRACTIONS };
        // How many of the resolutions count: those after the last one taken do not.
        let (mut counted, mut passed) = (history.len(), None);
        for stage in (found.stage + 1..).take(most) {
            // That everything sticks, coarse resolutions cannot tell: they have no shear to compare with.
            let unknown =
                aim.problem.wishes.profile && found.outcome.rubbing.as_ref().is_some_and(|rubbing| rubbing.is_full);
            let error = found.of_shear.unwrap_or(if unknown { 1.0 } else { 0.0 });
            if is_known_between(found.of_pressure, aim.tolerance)
                && error <= left_by_sticking(&found.outcome).max(SHEAR * aim.tolerance)
            {
                break;
            }
            if history.is_full() {
                break;
            }
            let level = level(first, stage);
            let task = self.task(aim, level);
            let coarse = passed.as_ref().unwrap_or(&found.outcome);
            let Ok(mut outcome) = self.solve(layer, aim, (stage, level, level), Some(coarse)) else {
                break;
            };
            history.push(outcome.seen());
            let fastest = fastest(layer, &outcome, self.stages[stage].unknowns());
            let Some(mut errors) = extrapolated(history, fastest) else { break };
            let told = errors.take(Quantity::Shear);
            let all = with_the_rest(aim.problem, layer, &outcome, aim.tolerance, errors);
            if !meets(aim.problem, &all, aim.tolerance) {
                // What was found before looked better than it was, and this may.
                found.of_shear = found.of_shear.into_iter().chain(told).reduce(f64::max);
                passed = Some(outcome);
                continue;
            }
            let Ok(Settled::Here { shear }) = self.settle(layer, task, (&mut outcome, stage), &errors) else { break };
            (found.outcome, found.stage, found.errors, found.of_shear) = (outcome, stage, errors, shear.or(told));
            found.of_pressure = self.lost_between(aim, stage);
            (counted, passed) = (history.len(), None);
            // Under a flat punch its finer grids were tried already.
            let is_vain = !aim.problem.is_stacked() && shear.is_some_and(|shear| shear > VAIN * error);
            if is_vain && is_known_between(found.of_pressure, aim.tolerance) {
                break;
            }
        }
        history.truncate(counted);
    }

    /// Takes note of how a contact that grew was settled.
    fn remember(&mut self, layer: &Layer, stage: usize, outcome: &Outcome, history: &[Seen]) {
        self.settled = Some(stage);
        let pace = Pace::seen(history, fastest(layer, outcome, self.stages[stage].unknowns()));
        self.pace = outcome.numbers.get(Quantity::HalfWidth).zip(pace);
    }

    /// Checks the conditions of friction, and makes the shear as sure as the rest where it is asked for.
    fn settle(
        &mut self,
        layer: &mut Layer,
        task: Task,
        (outcome, stage): (&mut Outcome, usize),
        errors: &Numbers,
    ) -> Result<Settled, Refusal> {
        let (coarser, here) = self.stages.split_at_mut(stage);
        let stage = &mut here[0];
        if stage.settle(layer, task, outcome)? {
            return Ok(Settled::Elsewhere);
        }
        let wishes = task.problem.wishes;
        if !wishes.profile || outcome.rubbing.is_none() {
            return Ok(Settled::Here { shear: None });
        }
        let is_of_pressure = |quantity: Quantity| !quantity.is_of_shear() && quantity != Quantity::Indentation;
        let known = errors.judged_by(wishes);
        let at_nodes = known.iter().filter(|(quantity, _)| is_of_pressure(*quantity)).map(|(_, error)| error);
        let of_pressure = at_nodes.fold(stage.lost_between().unwrap_or(0.0), f64::max);
        let shear = stage.sharpen(layer, task, outcome, of_pressure, coarser.last())?;
        Ok(Settled::Here { shear })
    }

    /// A contact no wider than one that was settled, under another load, or a stack of the same flat punches under another punch:
    /// the step that was fine enough then and the one before tell how fine it is now. `None` where it wants finer steps, or is
    /// refused: whether it is, and why, is left to these.
    fn pressed_again(&mut self, layer: &mut Layer, aim: Aim) -> Option<Judged> {
        let (stage, (widest, pace)) = self.settled.zip(self.pace)?;
        let coarse = self.solve_again(layer, aim, (stage.checked_sub(1)?, widest), None)?;
        let outcome = self.solve_again(layer, aim, (stage, widest), Some(&coarse))?;
        let errors = pace.judge(&coarse.seen(), &outcome.seen());
        let kernels_proven = layer.is_proven();
        let mut found = Judged::new(outcome, stage, errors, How::Again { kernels_proven });
        if !self.is_sure(layer, aim, &mut found) {
            if aim.problem.is_stacked() {
                return None;
            }
            // One step more is less than all of them again.
            let finer = self.solve_again(layer, aim, (stage + 1, widest), Some(&found.outcome))?;
            let seen = [&coarse, &found.outcome, &finer].map(Outcome::seen);
            let errors = extrapolated(&seen, fastest(layer, &finer, self.stages[stage + 1].unknowns()))?;
            found = Judged::new(finer, stage + 1, errors, How::Sequence { count: seen.len(), kernels_proven });
            if !self.is_sure(layer, aim, &mut found) {
                return None;
            }
        }
        layer.meter().conclude();
        let task = self.task(aim, u32::try_from(found.stage).ok()?);
        self.stages[found.stage].settle(layer, task, &mut found.outcome).ok()?;
        Some(found)
    }

    /// Makes the stages up to one whose level is its index, and tells what it needs to know.
    fn made<'a>(&mut self, aim: Aim<'a>, index: usize) -> Option<Task<'a>> {
        let level = u32::try_from(index).ok()?;
        self.make(aim, (index, level)).ok()?;
        Some(self.task(aim, level))
    }

    /// [`Stage::solve_again`]; `None` where the contact would be wider than that given, too: it may take finer steps.
    fn solve_again(
        &mut self,
        layer: &mut Layer,
        aim: Aim,
        (index, widest): (usize, f64),
        coarse: Option<&Outcome>,
    ) -> Option<Outcome> {
        let task = self.made(aim, index)?;
        let found = self.stages[index].solve_again(layer, task, widest, coarse).ok()??;
        found.numbers.get(Quantity::HalfWidth).is_some_and(|b| b <= widest).then_some(found)
    }

    /// Whether what was found meets the tolerance, between the nodes, too, which is noted.
    fn is_sure(&self, layer: &Layer, aim: Aim, found: &mut Judged) -> bool {
        let Judged { outcome, stage, errors, of_pressure, .. } = found;
        let all = with_the_rest(aim.problem, layer, outcome, aim.tolerance, *errors);
        *of_pressure = self.lost_between(aim, *stage);
        meets(aim.problem, &all, aim.tolerance) && is_known_between(*of_pressure, aim.tolerance)
    }

    /// The first of the last three steps that another contact took on this layer, where the coarsest one finds this one among
    /// the flat punches of all of them: the estimate looks at three, and those before would cost more than they tell.
    fn known_from(&mut self, aim: Aim, coarsest: &Outcome) -> Option<usize> {
        let settled = self.settled?;
        let later = settled.checked_sub(2)?.min(BOUND_LEVEL);
        let half_width = coarsest.numbers.get(Quantity::HalfWidth)?;
        self.make(aim, (settled, u32::try_from(settled).ok()?)).ok()?;
        let task = self.task(aim, 0);
        let serves = |stage: &Stage| stage.growing.as_ref().is_some_and(|growing| growing.serves(task, half_width));
        (later > 1 && self.stages[1..=settled].iter().all(serves)).then_some(later)
    }

    /// What a stage needs to know.
    fn task<'a>(&self, aim: Aim<'a>, level: u32) -> Task<'a> {
        let Aim { problem, tolerance, .. } = aim;
        let accuracy = KERNEL_SHARE * tolerance;
        let wanted = Wanted {
            frictional: problem.friction.is_some(),
            deep: problem.wants_depth(),
            accuracy: accuracy.min((accuracy * self.least_share.unwrap_or(1.0)).max(FINEST_KERNELS)),
            level,
        };
        Task { problem, wanted, tolerance }
    }

    /// Takes note of a pressure that is faint in the middle, or of a shear that is, either of which wants finer kernels.
    fn note(&mut self, outcome: &Outcome) {
        let share = share_in_middle(outcome).min(share_in_shear(outcome));
        if share < FAINT * self.least_share.unwrap_or(1.0) {
            self.least_share = Some(share);
        }
    }

    /// Solves on one stage, made when first asked for.
    fn solve(
        &mut self,
        layer: &mut Layer,
        aim: Aim,
        (index, kernel_level, quadrature_level): (usize, u32, u32),
        coarse: Option<&Outcome>,
    ) -> Result<Outcome, Refusal> {
        self.make(aim, (index, quadrature_level))?;
        let task = self.task(aim, kernel_level);
        let (before, here) = self.stages.split_at_mut(index);
        let family = before.iter().rev().find_map(|stage| stage.growing.as_ref()?.family.as_ref());
        if let Some(growing) = &mut here[0].growing {
            growing.forsake(self.forsaken.as_ref());
        }
        let outcome = here[0].solve(layer, task, coarse, family)?;
        self.note(&outcome);
        Ok(outcome)
    }

    /// Why an outcome is none: its stage lacks the room that its kernels take, and loses more by that than is left of the error told before.
    fn lacks_room(
        &self,
        layer: &Layer,
        aim: Aim,
        (stage, outcome): (usize, &Outcome),
        estimate: &Estimate,
    ) -> Option<Refusal> {
        if !estimate.is_told() {
            return None;
        }
        let told = worst_judged(aim.problem, &estimate.errors).map_or(0.0, |(_, error)| error);
        let half_width = outcome.numbers.get(Quantity::HalfWidth).unwrap_or(0.0);
        let lost = |stage: usize| self.stages[stage].normal.lost_for_room(half_width, layer.length());
        let here = lost(stage);
        if here <= told || here <= lost(stage - 1) {
            return None;
        }
        let (unknowns, short) = (self.stages[stage].unknowns(), layer.length() / half_width);
        Some(Refusal::OutOfReach {
            method: "quadrature",
            why: format!(
                "{unknowns} unknowns under kernels as short as {short:.0e} half-widths take more room than there is"
            ),
            remedy: "take a larger `tolerance`, or `quadrature = { type = \"graded-panels\" }`",
        })
    }

    /// Makes the stages up to one of that level.
    fn make(&mut self, aim: Aim, (index, quadrature_level): (usize, u32)) -> Result<(), Refusal> {
        if self.stages.is_empty() {
            // Stages are large, and to move them costs more than the room.
            self.stages.reserve(USUAL_STEPS.max(index + 1));
        }
        while self.stages.len() <= index {
            let missing = u32::try_from(index - self.stages.len()).expect("a few steps");
            let quadrature = aim.methods.quadrature.refined(quadrature_level - missing);
            let mut stage = Stage::new(aim.problem, quadrature)?;
            if let (Some(growing), Some(family)) = (&mut stage.growing, self.inherited.get_mut(self.stages.len())) {
                growing.inherit(family.take());
            }
            self.stages.push(stage);
        }
        Ok(())
    }

    /// Whether no refinement will help. A pressure that pulls is looked for as soon as it is known: finer steps do not mend it.
    fn is_hopeless(
        &mut self,
        layer: &Layer,
        aim: Aim,
        (step, first): (usize, usize),
        outcome: &Outcome,
        errors: &Numbers,
    ) -> bool {
        let level = step + first;
        // Before the pressure is known nothing is told well enough to end with.
        let is_known = level >= BOUND_LEVEL && is_shown(errors);
        let stage = &mut self.stages[step];
        is_known
            && (is_bounded(outcome)
                || stage.tension(layer, aim.problem, outcome).is_some_and(|(_, pull)| pull < -SHOWN))
            || level == DETAIL_LEVEL && has_details(aim.problem, outcome, aim.tolerance)
    }

    /// Whether friction cannot be told of a contact as it grew, at this step and at the one before. Where in its growth
    /// that is moves with the members solved: no refinement settles it.
    fn is_broken(&self, step: usize, first: usize, errors: &Numbers) -> bool {
        step > 0
            && step + first >= BOUND_LEVEL
            && self.stages[step - 1..=step].iter().all(Stage::is_broken)
            && is_shown(errors)
    }
}

/// Whether a pressure is known between its nodes, as far as anything tells.
fn is_known_between(lost: Option<f64>, tolerance: f64) -> bool {
    lost.is_none_or(|lost| lost <= BETWEEN * tolerance)
}

/// Whether a pressure is known well enough to be shown.
fn is_shown(errors: &Numbers) -> bool {
    let mut of_pressure = errors.iter().filter(|(quantity, _)| !quantity.is_of_shear()).peekable();
    of_pressure.peek().is_some() && of_pressure.all(|(_, error)| error < SHOWN)
}

/// The coarsest level worth solving.
fn first_level(problem: &Problem, tolerance: f64) -> usize {
    if searches(problem) { 0 } else { left_out(problem, tolerance) }
}

/// Whether a stick zone or the size of the contact has to be found.
fn searches(problem: &Problem) -> bool {
    problem.friction.is_some() || problem.fixed_half_width().is_none()
}

/// How many of the coarsest levels hardly anything converges on.
fn left_out(problem: &Problem, tolerance: f64) -> usize {
    let thresholds = match problem.friction {
        None => LEFT_OUT,
        Some(_) if problem.is_stacked() => LEFT_OUT_OF_STACKS,
        Some(_) => LEFT_OUT_OF_SHEAR,
    };
    thresholds.iter().filter(|least| tolerance < **least).count()
}

#[allow(clippy::cast_possible_truncation)] // at most FINEST
fn level(first: usize, step: usize) -> u32 {
    (first + step) as u32
}

/// How fast resolutions of so many unknowns may come; few stand too far apart to see the layer.
fn fastest(layer: &Layer, outcome: &Outcome, unknowns: usize) -> Fastest {
    let half_width = outcome.numbers.get(Quantity::HalfWidth).unwrap_or(0.0);
    match layer.is_proven() {
        _ if WIDE * half_width > UNSEEN * layer.length() * unknowns as f64 => Fastest::UNSEEN,
        true => Fastest::PROVEN,
        false => Fastest::UNPROVEN,
    }
}

/// What the resolutions solved so far tell of the error.
#[derive(Default)]
struct Estimate {
    history: ArrayVec<Seen, { FINEST + 1 }>,
    errors: Numbers,
    /// Of the shear itself, where it is asked for.
    of_shear: Option<f64>,
    /// Whether the tolerance is met.
    met: bool,
    /// For how many steps in a row the errors have not shrunk any more.
    stalled: usize,
}

impl Estimate {
    /// Before it is one resolution alone.
    fn beginning_with(outcome: &Outcome) -> Self {
        Self { history: ArrayVec::from_iter([outcome.seen()]), ..Self::default() }
    }

    /// Whether the errors are told at all.
    fn is_told(&self) -> bool {
        self.errors != Numbers::default()
    }

    /// Takes note of a finer resolution; whether it is fine enough, or no finer one would be any better. `has_kernels` is whether those
    /// that come would be solved with the same kernels.
    fn add(&mut self, layer: &Layer, aim: Aim, outcome: &Outcome, (unknowns, has_kernels): (usize, bool)) -> bool {
        let Aim { problem, tolerance, .. } = aim;
        self.history.push(outcome.seen());
        let fastest = fastest(layer, outcome, unknowns);
        let Some(estimate) = extrapolated(&self.history, fastest) else { return false };
        // All may agree on what none of them sees.
        let mut estimate = estimate.plus(hidden_details(problem, outcome, unknowns));
        self.of_shear = estimate.take(Quantity::Shear).filter(|_| problem.wishes.profile);
        let now = worst_judged(problem, &estimate).map_or(0.0, |(_, error)| error);
        // Two alone do not tell that more of them are vain, nor more than what happens to agree where one number is far less sure than all others.
        if self.history.len() < 3 && (now > tolerance || share_in_middle(outcome) < FAINT) {
            return false;
        }
        let is_stalled =
            now < ROUNDED && worst_judged(problem, &self.errors).is_some_and(|(_, before)| now > 0.5 * before);
        self.errors = estimate;
        let all = with_the_rest(problem, layer, outcome, tolerance, estimate);
        self.met = meets(problem, &all, tolerance) || now <= 2.0 * ROUNDING;
        self.stalled = if is_stalled { self.stalled + 1 } else { 0 };
        let is_done = self.met || self.stalled >= STALLED;
        is_done || is_vain(problem, outcome, tolerance, (&estimate, &all), has_kernels)
    }
}

/// Whether no finer step brings the errors told, and all that stands beside them, below the tolerance: what none of them mends is above
/// it, and what they would mend is little beside that. They mend neither what a stack loses nor a law that was smoothed, nor kernels as good
/// as they get where those that come would be the same, and claim no number of the shear to more digits than its integrals have.
fn is_vain(
    problem: &Problem,
    outcome: &Outcome,
    tolerance: f64,
    (told, all): (&Numbers, &Numbers),
    has_kernels: bool,
) -> bool {
    let lost = problem.smoothing_errors(&outcome.numbers).plus(outcome.lost.unwrap_or(0.0));
    let is_final = has_kernels && outcome.size.is_none_or(|size| size.missed <= ROUNDING);
    // Finer steps have more flat punches, and smoother ones.
    let mended = |quantity: Quantity| {
        between_members(outcome) + if quantity == Quantity::Peak { outcome.lost_at_kinks } else { 0.0 }
    };
    let unmended = |(quantity, error): (Quantity, f64)| {
        let rest = if is_final { all.get(quantity).map_or(0.0, |all| all - error - mended(quantity)) } else { 0.0 };
        let least = if quantity.is_of_shear() { SLIP_ROUNDING } else { ROUNDING };
        (lost.get(quantity).unwrap_or(0.0).max(least), rest)
    };
    let judged = told.judged_by(problem.wishes);
    let is_beyond = |told: (Quantity, f64)| {
        let (least, rest) = unmended(told);
        least.max(rest) > tolerance
    };
    let is_small = |told: (Quantity, f64)| {
        let (least, rest) = unmended(told);
        told.1 <= tolerance.max(least).max(BESIDE_REST * rest)
    };
    judged.iter().any(is_beyond) && judged.iter().all(is_small)
}

/// Whether a stick zone is only bounded, and no finer step finds it.
fn is_bounded(outcome: &Outcome) -> bool {
    outcome.rubbing.as_ref().is_some_and(|rubbing| matches!(rubbing.verdict, Verdict::TooNarrow | Verdict::TooWide))
}
