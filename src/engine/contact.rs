//! A contact solved at once, at one resolution: the pressure over all of it, and under a flat punch the shear.

mod friction;

use super::outcome::{Outcome, Task};
use super::prepared_layer::PreparedLayer;
use super::problem::{LoadInLayerUnits, Problem};
use super::work::Work;
use crate::engine::accuracy::quantity::Quantity;
use crate::engine::friction::checks::SlipCheck;
use crate::engine::friction::rubbing::{Rubbing, Verdict};
use crate::engine::friction::stick::Shear;
use crate::engine::friction::stick_search::Samples;
use crate::engine::pressure::contact_size::{self, Size};
use crate::engine::pressure::normal::Normal;
use slipzone_api::{Edge, Quadrature, Refusal};

/// Rules, matrices and scratch of one resolution, reused from load to load.
pub(crate) struct Contact {
    pub(crate) normal: Normal,
    /// Under a flat punch with friction.
    pub(crate) shear: Option<Box<Shear>>,
    /// Made when first asked for.
    slip_check: Option<Box<SlipCheck>>,
    /// Whether it solves slices of contacts that grow. Friction bears their sum: it need not bear each of them.
    of_slices: bool,
    /// Of several stick zones those of slip in this direction come first: `+1` inward, `-1` outward.
    pub(crate) branch: f64,
    /// Whether friction does not bear one of those examined.
    pub(crate) is_overloaded: bool,
    /// The friction curve, and the half-width that it belongs to: it depends on no load.
    sampled: Option<(f64, Samples)>,
    /// The stick zones found last, and the half-width and the friction coefficient that they belong to: they
    /// depend on no load either.
    rubbed: Option<(f64, f64, Rubbing)>,
    /// Half-width and force of the pressure that `shear` was shown last.
    shown: Option<(f64, f64)>,
    /// [`PreparedLayer::fineness`] of the kernels that all of that was found with.
    found_with: u64,
    /// How wide the contact became under its load, where that was looked for.
    sized: Option<(LoadInLayerUnits, Size)>,
}

impl Contact {
    pub(crate) fn new(problem: &Problem, quadrature: Box<dyn Quadrature>) -> Result<Self, Refusal> {
        let edge = if problem.fixed_half_width().is_some() { Edge::Sharp } else { Edge::Smooth };
        let normal = Normal::new(quadrature.as_ref(), edge)?;
        let shear = match problem.friction {
            // The kink of a strain `C|x|` is resolved late.
            Some(_) if problem.is_linear && !quadrature.is_pinned() => {
                Some(Box::new(Shear::new(quadrature.refined(1))?))
            }
            Some(_) if !problem.is_stacked() => Some(Box::new(Shear::new(quadrature)?)),
            _ => None,
        };
        Ok(Self {
            normal,
            shear,
            slip_check: None,
            of_slices: false,
            branch: 1.0,
            is_overloaded: false,
            sampled: None,
            rubbed: None,
            shown: None,
            found_with: 0,
            sized: None,
        })
    }

    /// Whether friction is to bear its shear as it is, or it is a slice of a contact that grows. What was found of
    /// stick zones goes with that.
    pub(crate) fn bears_own_shear(&mut self, bears: bool) {
        self.of_slices = !bears;
        self.rubbed = None;
    }

    /// Solves, from what a coarser resolution found of its size and its stick zone.
    pub(crate) fn solve(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        known_size: Option<Size>,
        known: Option<&Rubbing>,
    ) -> Result<Outcome, Refusal> {
        let problem = task.problem;
        let size = if let Some(half_width) = problem.fixed_half_width() {
            self.press(layer, task, half_width)?;
            None
        } else {
            Some(self.press_smooth(layer, task, known_size)?)
        };
        let rubbing = match problem.friction {
            Some(_) if problem.is_linear => Some(self.rub_linearly(layer, task, known)?),
            Some(_) => Some(self.rub(layer, task, known)?),
            None => None,
        };
        let mut outcome = self.outcome(layer, problem, size, rubbing);
        let rubbing = &outcome.rubbing;
        if problem.is_linear && rubbing.as_ref().is_some_and(|rubbing| rubbing.verdict == Verdict::Holds) {
            let rate = self.shear.as_ref().map_or(0.0, |shear| shear.strain_rate);
            outcome.numbers.set(Quantity::StrainRate, problem.elastic.a0() * rate);
        }
        Ok(outcome)
    }

    /// Solves another load of a punch whose contact grows, no wider than the one given, from its size where that is
    /// known, or from what is known of others; `None` where that is not enough.
    pub(crate) fn solve_again(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        widest: f64,
        known: Option<Size>,
    ) -> Result<Option<Outcome>, Refusal> {
        let problem = task.problem;
        let known = known.or_else(|| self.sized.and_then(|(before, size)| size.under(before, problem.load)));
        let Some(known) = known.filter(|size| size.half_width <= widest && problem.friction.is_none()) else {
            return Ok(None);
        };
        let size = self.press_smooth(layer, task, Some(known))?;
        Ok(Some(self.outcome(layer, problem, Some(size), None)))
    }

    /// Solves the pressure of a contact that grows, from what is known of its size.
    fn press_smooth(&mut self, layer: &mut PreparedLayer, task: Task, known: Option<Size>) -> Result<Size, Refusal> {
        let size = contact_size::press(layer, task.problem, &mut self.normal, task.wanted, task.tolerance, known)?;
        self.sized = Some((task.problem.load, size));
        Ok(size)
    }

    /// What the pressure solved last tells, and the stick zone found for it.
    fn outcome(
        &mut self,
        layer: &PreparedLayer,
        problem: &Problem,
        size: Option<Size>,
        rubbing: Option<Rubbing>,
    ) -> Outcome {
        let (mut numbers, pressure) = self.normal.numbers(layer, problem);
        if let Some(rubbing) = &rubbing {
            rubbing.report(&mut numbers);
        }
        Outcome { numbers, rubbing, size, pressure, ..Outcome::default() }
    }

    /// The pressure under a punch whose corners fix the contact.
    pub(crate) fn press(&mut self, layer: &mut PreparedLayer, task: Task, half_width: f64) -> Result<(), Refusal> {
        layer.tabulate(half_width, task.wanted)?;
        let fineness = layer.fineness();
        if self.found_with != fineness {
            // What coarser kernels told is as coarse.
            self.found_with = fineness;
            self.normal.forget();
            (self.sampled, self.rubbed, self.shown) = (None, None, None);
        }
        self.normal.press_sharp(layer, task.problem, half_width)
    }

    /// Work in its systems so far.
    pub(crate) fn work(&self) -> Work {
        self.normal.work() + self.shear.as_deref().map_or(Work::default(), Shear::work)
    }
}
