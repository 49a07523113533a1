//! Refines a scene until its error estimate meets the tolerance.

mod aim;
mod estimate;
pub(crate) mod judged;
mod known;
mod ladder;
pub(crate) mod stage;

use super::growing::Growing;
use super::outcome::Outcome;
use super::prepared_layer::PreparedLayer;
use super::problem::Problem;
use crate::engine::accuracy::error_estimate::{SAFETY, Seen, extrapolated, judged_by_twin};
use crate::engine::accuracy::quantity::{Numbers, Quantity};
use crate::engine::friction::rubbing::Verdict;
use crate::engine::pressure::contact_size;
use arrayvec::ArrayVec;
use estimate::{Estimate, fastest};
use judged::{BETWEEN, How, Judged, SHEAR, has_details, hidden_details, meets, with_the_rest, worst_judged};
use slipzone_api::Refusal;
use stage::Stage;

pub(super) use aim::Aim;
pub(super) use ladder::{FlatPunches, Ladder};

/// Most steps of refinement.
const FINEST: usize = 13;
/// Level from which refinement no longer helps a stick zone out of reach, or a pressure that pulls.
const BOUND_LEVEL: usize = 4;
/// Level at which a shape that is taken for smooth is looked at, should it not have converged before.
const DETAIL_LEVEL: usize = 6;
/// A pressure that is known to within this shows as well as any where friction cannot be told while a contact grows.
const SHOWN: f64 = 1e-3;
/// Steps that may be refused before the first that is solved.
const SKIPPED: usize = 7;
/// Steps that pressure and shear may take beyond those of the numbers, and those of a stack of flat punches, each of
/// which is many.
const FOR_THE_TRACTIONS: usize = 4;
const FOR_STACKED_SHEAR: usize = 3;
/// Of an error of the shear a step of these is to leave no more, or another one is not worth it.
const VAIN: f64 = 0.5;

/// What the checks of friction leave of a result.
enum Settled {
    /// The stick zone found, and how sure the shear is in it where it was refined by itself.
    Here { shear: Option<f64> },
    /// Another one.
    Elsewhere,
}

/// How far the steps led.
struct Climbed {
    /// What the last one that could be solved found.
    outcome: Outcome,
    step: usize,
    /// Why no other was taken, where another was to be.
    stopped: Option<Refusal>,
}

impl Ladder {
    /// Solves a problem with the methods given.
    pub(super) fn refine(&mut self, layer: &mut PreparedLayer, aim: Aim) -> Result<Judged, Refusal> {
        let mut judged = if aim.is_pinned() { self.with_twin(layer, aim)? } else { self.refined(layer, aim)? };
        judged.conclude(aim.problem, layer, aim.tolerance);
        Ok(judged)
    }

    /// Solves at the resolution that the scene fixed, and at the next finer one to tell the error.
    fn with_twin(&mut self, layer: &mut PreparedLayer, aim: Aim) -> Result<Judged, Refusal> {
        layer.meter().conclude();
        // The twin first: the tables left are those of the contact reported.
        let twin = self.solve(layer, aim, 1, None)?;
        let mut outcome = self.solve(layer, aim, 0, Some(&twin))?;
        let task = self.task(aim, 0);
        self.stages[0].settle(layer, task, &mut outcome)?;
        let hidden = hidden_details(aim.problem, &outcome, self.stages[0].unknowns());
        let mut errors = judged_by_twin(&outcome.seen(), &twin.seen()).plus(hidden);
        // The few points of the traces do not see the end of the zone.
        if let Some((traced, apart)) =
            errors.get(Quantity::Shear).zip(self.stages[0].contact.shear_apart(&self.stages[1].contact))
        {
            errors.set(Quantity::Shear, traced.max(SAFETY * apart));
        }
        let of_pressure = self.lost_between(aim, 0);
        Ok(Judged { of_pressure, ..Judged::new(outcome, 0, errors, How::Twin) })
    }

    /// Takes finer steps until the estimate meets the tolerance, and as many more as the tractions want.
    fn refined(&mut self, layer: &mut PreparedLayer, aim: Aim) -> Result<Judged, Refusal> {
        self.given_up = None;
        if let Some(judged) = self.pressed_again(layer, aim) {
            return Ok(judged);
        }
        let mut estimate = Estimate::default();
        let Climbed { outcome, step, stopped } = self.climb(layer, aim, &mut estimate)?;
        let Estimate { history, errors, of_shear, met, is_hopeless, .. } = &mut estimate;
        let how = How::Sequence { count: 0, kernels_proven: false };
        let of_pressure = self.lost_between(aim, step);
        let mut found = Judged {
            of_shear: *of_shear,
            of_pressure,
            stopped,
            is_hopeless: *is_hopeless,
            ..Judged::new(outcome, step, *errors, how)
        };
        if *met && found.stopped.is_none() {
            self.refine_for_the_tractions(layer, aim, &mut found, history);
        }
        layer.meter().conclude();
        let Judged { outcome, step, errors, of_shear, stopped, .. } = &mut found;
        if stopped.is_some() {
            // Settled by no step: the last one that could be solved is.
            if let Settled::Here { shear: Some(shear) } = self.settle(layer, aim, (outcome, *step), errors)? {
                *of_shear = Some(shear);
            }
        }
        if *errors == Numbers::default() {
            // Changed its mind at the last step.
            outcome.numbers.iter().for_each(|(quantity, _)| errors.set(quantity, 1.0));
        }
        if aim.problem.fixed_half_width().is_none() {
            self.remember(layer, aim.problem, (*step, outcome), history);
        }
        found.how = How::Sequence { count: history.len(), kernels_proven: layer.is_proven() };
        Ok(found)
    }

    /// Takes finer steps until the estimate meets the tolerance or none will. The estimate is large, and stays where it
    /// is.
    fn climb(&mut self, layer: &mut PreparedLayer, aim: Aim, estimate: &mut Estimate) -> Result<Climbed, Refusal> {
        let (mut last, mut stopped): (Option<(Outcome, usize)>, _) = (None, None);
        // What a search found on the coarsest level is followed from there to the first that matters.
        let after_search = Some(aim.left_out()).filter(|level| aim.searches() && *level > 1);
        let mut next = 0;
        for step in (0..).take_while(|step| aim.level(*step) <= FINEST) {
            if step < next {
                continue;
            }
            let coarse = last.as_ref().map(|(outcome, _)| outcome);
            let least_share = self.least_share;
            let mut outcome = match self.solve(layer, aim, step, coarse) {
                Ok(outcome) => outcome,
                Err(refusal) if estimate.is_told() => {
                    stopped = Some(refusal);
                    break;
                }
                // Too coarse for a thin layer: finer steps may do.
                Err(refusal @ (Refusal::OutOfReach { .. } | Refusal::Limit { .. }))
                    if step < SKIPPED && !is_beyond_kink(aim.problem, &refusal) =>
                {
                    stopped = Some(refusal);
                    continue;
                }
                Err(refusal) => return Err(refusal),
            };
            stopped = self.lacks_room(layer, aim, (step, &outcome), estimate);
            if stopped.is_some() {
                break;
            }
            if step == 0
                && let Some(later) = self.known_from(aim, &outcome).or(after_search)
            {
                (next, last) = (later, Some((outcome, step)));
                continue;
            }
            // Or else the next kernels are finer ones.
            let has_kernels = self.least_share == least_share;
            let mut done = self.is_done(layer, aim, step, (&outcome, has_kernels), estimate);
            if done || aim.level(step) == FINEST {
                match self.settle(layer, aim, (&mut outcome, step), &estimate.errors) {
                    Ok(Settled::Elsewhere) => {
                        *estimate = Estimate::beginning_with(&outcome);
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
        let Some((outcome, step)) = last else {
            return Err(stopped.expect("every step was solved or refused"));
        };
        Ok(Climbed { outcome, step, stopped })
    }

    /// Takes note of what a step found; whether it is fine enough, or no finer one would be any better. `has_kernels`
    /// is whether those that come would be solved with the same kernels.
    fn is_done(
        &mut self,
        layer: &PreparedLayer,
        aim: Aim,
        step: usize,
        (outcome, has_kernels): (&Outcome, bool),
        estimate: &mut Estimate,
    ) -> bool {
        let unknowns = self.stages[step].unknowns();
        // A resolution so coarse may only seem not to tell of friction.
        let is_early = aim.level(step) < BOUND_LEVEL && self.stages[step].is_broken();
        let is_enough = estimate.add(layer, aim, outcome, (unknowns, has_kernels)) && !is_early;
        estimate.is_hopeless = !is_enough && self.is_hopeless(layer, aim, step, outcome, &estimate.errors);
        if self.is_broken(aim, step, &estimate.errors) {
            // The pressure does not depend on it.
            self.given_up = self.stages[step].growing.as_deref().and_then(Growing::broken).cloned();
        }
        is_enough || estimate.is_hopeless
    }

    /// [`Stage::lost_between`], where the tractions are asked for.
    fn lost_between(&self, aim: Aim, step: usize) -> Option<f64> {
        let wishes = aim.problem.wishes;
        self.stages[step].lost_between(wishes.nearest).filter(|_| wishes.profile)
    }

    /// Takes resolutions more than the numbers need: between the nodes the pressure is known later, and the shear may
    /// want a finer one, or finer flat punches. What is found stays where they cannot be had, or are no better.
    fn refine_for_the_tractions(
        &mut self,
        layer: &mut PreparedLayer,
        aim: Aim,
        found: &mut Judged,
        history: &mut ArrayVec<Seen, { FINEST + 1 }>,
    ) {
        let most = if aim.problem.is_stacked() { FOR_STACKED_SHEAR } else { FOR_THE_TRACTIONS };
        // How many of the resolutions count: those after the last one taken do not.
        let (mut counted, mut passed) = (history.len(), None);
        for step in (found.step + 1..).take(most) {
            // That everything sticks, coarse resolutions cannot tell: they have no shear to compare with.
            let unknown =
                aim.problem.wishes.profile && found.outcome.rubbing.as_ref().is_some_and(|rubbing| rubbing.is_full);
            let error = found.of_shear.unwrap_or(if unknown { 1.0 } else { 0.0 });
            if is_known_between(found.of_pressure, aim.tolerance) && error <= SHEAR * aim.tolerance {
                break;
            }
            if history.is_full() {
                break;
            }
            let coarse = passed.as_ref().unwrap_or(&found.outcome);
            let Ok(mut outcome) = self.solve(layer, aim, step, Some(coarse)) else {
                break;
            };
            history.push(outcome.seen());
            let fastest = fastest(layer, aim.problem, &outcome, self.stages[step].unknowns());
            let Some(mut errors) = extrapolated(history, fastest) else { break };
            let told = errors.take(Quantity::Shear);
            let all = with_the_rest(aim.problem, layer, &outcome, aim.tolerance, errors);
            if !meets(aim.problem, &all, aim.tolerance) {
                // What was found before looked better than it was, and this may.
                found.of_shear = found.of_shear.into_iter().chain(told).reduce(f64::max);
                passed = Some(outcome);
                continue;
            }
            let Ok(Settled::Here { shear }) = self.settle(layer, aim, (&mut outcome, step), &errors) else { break };
            (found.outcome, found.step, found.errors, found.of_shear) = (outcome, step, errors, shear.or(told));
            found.of_pressure = self.lost_between(aim, step);
            (counted, passed) = (history.len(), None);
            // Under a flat punch its finer grids were tried already.
            let is_vain = !aim.problem.is_stacked() && shear.is_some_and(|shear| shear > VAIN * error);
            if is_vain && is_known_between(found.of_pressure, aim.tolerance) {
                break;
            }
        }
        history.truncate(counted);
    }

    /// Checks the conditions of friction, and makes the shear as sure as the rest where it is asked for.
    fn settle(
        &mut self,
        layer: &mut PreparedLayer,
        aim: Aim,
        (outcome, step): (&mut Outcome, usize),
        errors: &Numbers,
    ) -> Result<Settled, Refusal> {
        let task = self.task(aim, step);
        let (coarser, here) = self.stages.split_at_mut(step);
        let stage = &mut here[0];
        if stage.settle(layer, task, outcome)? {
            return Ok(Settled::Elsewhere);
        }
        let wishes = aim.problem.wishes;
        if !wishes.profile || outcome.rubbing.is_none() {
            return Ok(Settled::Here { shear: None });
        }
        let is_of_pressure = |quantity: Quantity| !quantity.is_of_shear() && quantity != Quantity::Indentation;
        let known = errors.judged_by(wishes);
        let at_nodes = known.iter().filter(|(quantity, _)| is_of_pressure(*quantity)).map(|(_, error)| error);
        let of_pressure = at_nodes.fold(stage.lost_between(wishes.nearest).unwrap_or(0.0), f64::max);
        let shear =
            stage.contact.sharpen(layer, task, outcome, of_pressure, coarser.last().map(|stage| &stage.contact))?;
        Ok(Settled::Here { shear })
    }

    /// Why an outcome is none: its step lacks the room that its kernels take, and loses more by that than is left of
    /// the error told before.
    fn lacks_room(
        &self,
        layer: &PreparedLayer,
        aim: Aim,
        (step, outcome): (usize, &Outcome),
        estimate: &Estimate,
    ) -> Option<Refusal> {
        if !estimate.is_told() {
            return None;
        }
        let told = worst_judged(aim.problem, &estimate.errors).map_or(0.0, |(_, error)| error);
        let half_width = outcome.numbers.get(Quantity::HalfWidth).unwrap_or(0.0);
        let lost = |step: usize| self.stages[step].contact.normal.lost_for_room(half_width, layer.length());
        let here = lost(step);
        if here <= told || here <= lost(step - 1) {
            return None;
        }
        let (unknowns, short) = (self.stages[step].unknowns(), layer.length() / half_width);
        Some(Refusal::OutOfReach {
            method: "quadrature",
            why: format!(
                "{unknowns} unknowns under kernels as short as {short:.0e} half-widths take more room than there is"
            ),
            remedy: "take a larger `tolerance`, or `quadrature = { type = \"graded-panels\" }`",
        })
    }

    /// Whether no refinement will help. A pressure that pulls is looked for as soon as it is known: finer steps do not
    /// mend it.
    fn is_hopeless(
        &mut self,
        layer: &PreparedLayer,
        aim: Aim,
        step: usize,
        outcome: &Outcome,
        errors: &Numbers,
    ) -> bool {
        let level = aim.level(step);
        // Before the pressure is known nothing is told well enough to end with.
        let is_known = level >= BOUND_LEVEL && is_told_to(errors, SHOWN);
        let stage = &mut self.stages[step];
        is_known
            && (is_bounded(outcome) && is_told_to(errors, aim.tolerance)
                || stage.tension(layer, aim.problem, outcome).is_some_and(|(_, pull)| pull < -SHOWN))
            || level == DETAIL_LEVEL && has_details(aim.problem, outcome, aim.tolerance)
    }

    /// Whether friction cannot be told of a contact as it grew, at this step and at the one before. Where in its growth
    /// that is moves with the members solved: no refinement settles it.
    fn is_broken(&self, aim: Aim, step: usize, errors: &Numbers) -> bool {
        step > 0
            && aim.level(step) >= BOUND_LEVEL
            && self.stages[step - 1..=step].iter().all(Stage::is_broken)
            && is_told_to(errors, SHOWN)
    }
}

/// Whether a load was refused because its contact goes beyond the first kink, where it is to end before: the coarsest
/// step tells that.
fn is_beyond_kink(problem: &Problem, refusal: &Refusal) -> bool {
    problem.ends_before_kinks && contact_size::is_outgrown(refusal)
}

/// Whether a pressure is known between its nodes, as far as anything tells.
fn is_known_between(lost: Option<f64>, tolerance: f64) -> bool {
    lost.is_none_or(|lost| lost <= BETWEEN * tolerance)
}

/// Whether all that is told of a pressure is told to such an error.
fn is_told_to(errors: &Numbers, known: f64) -> bool {
    let mut of_pressure = errors.iter().filter(|(quantity, _)| !quantity.is_of_shear()).peekable();
    of_pressure.peek().is_some() && of_pressure.all(|(_, error)| error <= known)
}

/// Whether a stick zone is only bounded, if that, and no finer step finds it.
fn is_bounded(outcome: &Outcome) -> bool {
    let is_beyond = |verdict: &Verdict| matches!(verdict, Verdict::TooNarrow | Verdict::NotScanned);
    outcome.rubbing.as_ref().is_some_and(|rubbing| is_beyond(&rubbing.verdict))
}
