//! The resolutions of a scene, and what they are solved with.

use super::aim::Aim;
use crate::engine::accuracy::error_estimate::Pace;
use crate::engine::foreign::broken;
use crate::engine::friction::rubbing::Rubbing;
use crate::engine::growing::family::Family;
use crate::engine::outcome::{Outcome, Task};
use crate::engine::prepared_layer::{PreparedLayer, Wanted};
use crate::engine::problem::Problem;
use crate::engine::refine::judged::{moves, share_in_middle, share_in_shear};
use crate::engine::refine::stage::Stage;
use crate::engine::work::Work;
use slipzone_api::Refusal;
use std::ops::Add;

/// About as many steps as most scenes take.
const USUAL_STEPS: usize = 8;
/// Share of the tolerance that the kernels may use up.
const KERNEL_SHARE: f64 = 0.2;
/// A pressure in the middle below this share of the mean, or of what it was thought to be, wants kernels finer by as
/// much; so does what drives the shear.
pub(super) const FAINT: f64 = 0.25;
/// No kernels are asked to be finer for that.
const FINEST_KERNELS: f64 = 1e-14;

/// The resolutions solved so far, coarsest first.
#[derive(Default)]
pub(in crate::engine) struct Ladder {
    pub(super) stages: Vec<Stage>,
    /// Flat punches of the layer that another punch left behind, by resolution.
    inherited: Vec<Option<Family>>,
    /// The step that was fine enough for a contact that grew.
    pub(super) settled: Option<usize>,
    /// How fast it was reached, and by how wide a contact.
    pub(super) pace: Option<(f64, Pace)>,
    /// The least pressure in the middle seen, over the mean, or [`share_in_shear`], or the inverse of [`moves`], where
    /// it is faint.
    pub(super) least_share: Option<f64>,
    /// What cannot be told of friction under the present load, at any resolution.
    pub(super) given_up: Option<(f64, Rubbing)>,
    /// Work in the systems of ladders that this one takes the place of.
    before: Work,
}

/// What one punch leaves behind for another on the same layer: the flat punches of each resolution, the step that was
/// fine enough, and how fast it was reached.
#[derive(Default)]
pub(in crate::engine) struct FlatPunches {
    families: Vec<Option<Family>>,
    settled: Option<usize>,
    pace: Option<(f64, Pace)>,
}

impl Ladder {
    /// A ladder for another punch on a layer whose flat punches are known.
    pub(in crate::engine) fn inheriting(FlatPunches { families, settled, pace }: FlatPunches) -> Self {
        let pace = pace.map(|(half_width, pace)| (half_width, pace.of_another_punch()));
        Self { inherited: families, settled, pace, ..Self::default() }
    }

    /// The flat punches that it leaves behind, those of resolutions that it did not get to among them.
    pub(in crate::engine) fn into_flat_punches(self) -> FlatPunches {
        let beyond = self.inherited.into_iter().skip(self.stages.len());
        let families = self.stages.into_iter().map(|stage| stage.growing?.family).chain(beyond).collect();
        FlatPunches { families, settled: self.settled, pace: self.pace }
    }

    /// Begins again with flat punches that are known, those of the ladder so far or others; the work so far counts.
    pub(in crate::engine) fn begin_again(&mut self, known: impl FnOnce(Self) -> FlatPunches) {
        let work = self.work();
        *self = Self::inheriting(known(std::mem::take(self)));
        self.take_over(work);
    }

    /// What was solved at a step.
    pub(in crate::engine) fn stage(&mut self, step: usize) -> &mut Stage {
        &mut self.stages[step]
    }

    /// Work in its systems so far, and in those of ladders that it takes the place of.
    pub(in crate::engine) fn work(&self) -> Work {
        self.stages.iter().map(Stage::work).fold(self.before, Add::add)
    }

    /// Takes the place of others: `all` is the work on them and on this one.
    pub(in crate::engine) fn take_over(&mut self, all: Work) {
        self.before = all - (self.work() - self.before);
    }

    /// What the stage of a step needs to know.
    pub(super) fn task<'a>(&self, aim: Aim<'a>, step: usize) -> Task<'a> {
        let Aim { problem, tolerance, .. } = aim;
        let [level, _] = aim.levels(step);
        let accuracy = KERNEL_SHARE * tolerance;
        let wanted = Wanted {
            frictional: problem.friction.is_some(),
            deep: problem.wants_depth(),
            accuracy: accuracy.min((accuracy * self.least_share(problem)).max(FINEST_KERNELS)),
            level,
        };
        Task { problem, wanted, tolerance }
    }

    /// Takes note of a pressure that is faint in the middle, of a shear that is, or of a load that hardly tells the
    /// contact, each of which wants finer kernels.
    fn note(&mut self, problem: &Problem, outcome: &Outcome) {
        let share = share_in_middle(outcome).min(share_in_shear(outcome)).min(moves(outcome).recip());
        if share < FAINT * self.least_share(problem) {
            self.least_share = Some(share);
        }
    }

    /// The least share seen, or the one to expect: under friction a faint one, for to make kernels a little finer from
    /// the beginning costs less than to make them again.
    fn least_share(&self, problem: &Problem) -> f64 {
        self.least_share.unwrap_or(if problem.friction.is_some() { FAINT } else { 1.0 })
    }

    /// Solves at a step, whose stage is made when first asked for.
    pub(super) fn solve(
        &mut self,
        layer: &mut PreparedLayer,
        aim: Aim,
        step: usize,
        coarse: Option<&Outcome>,
    ) -> Result<Outcome, Refusal> {
        self.make(aim, step)?;
        let task = self.task(aim, step);
        let (before, here) = self.stages.split_at_mut(step);
        let family = before.iter().rev().find_map(|stage| stage.growing.as_ref()?.family.as_ref());
        if let Some(growing) = &mut here[0].growing {
            growing.give_up(self.given_up.as_ref());
        }
        let solved = here[0].solve(layer, task, coarse, family);
        if let Ok(outcome) = &solved {
            self.note(task.problem, outcome);
        }
        solved
    }

    /// Makes the stages up to a step.
    pub(super) fn make(&mut self, aim: Aim, step: usize) -> Result<(), Refusal> {
        if self.stages.is_empty() {
            // Stages are large, and to move them costs more than the room.
            self.stages.reserve(USUAL_STEPS.max(step + 1));
        }
        while self.stages.len() <= step {
            let [_, level] = aim.levels(self.stages.len());
            let mut stage = Stage::new(aim.problem, aim.methods.quadrature.refined(level))?;
            // Two that are the same agree, whatever the error.
            if let Some(coarser) =
                self.stages.last().map(Stage::unknowns).filter(|coarser| stage.unknowns() <= *coarser)
            {
                let fault =
                    format!("refined({level}) has {} unknowns, the level before it {coarser}", stage.unknowns());
                return Err(broken(aim.methods.quadrature.typetag_name(), &fault));
            }
            if let (Some(growing), Some(family)) = (&mut stage.growing, self.inherited.get_mut(self.stages.len())) {
                growing.inherit(family.take());
            }
            self.stages.push(stage);
        }
        Ok(())
    }
}
