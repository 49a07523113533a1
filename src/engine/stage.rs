//! One scene at one resolution: pressure, stick zone, and the numbers reported.

mod friction;

use super::checks::{self, SlipCheck};
use super::contact_size::{self, Size};
use super::error_estimate::{SAFETY, Seen};
use super::family::{Family, Left};
use super::growing::Growing;
use super::lookout::Lookout;
use super::normal::Normal;
use super::prepared_layer::{PreparedLayer, Wanted};
use super::problem::{LoadInLayerUnits, Problem};
use super::quantity::{Numbers, Quantity, Traces};
use super::rubbing::{Rubbing, Verdict};
use super::stick::Shear;
use super::stick_search::Samples;
use super::work::Work;
use slipzone_api::{Edge, Quadrature, Refusal, Station};

/// Rules, matrices and scratch of one resolution, reused from load to load.
pub(crate) struct Stage {
    pub(crate) normal: Normal,
    /// Under a flat punch with friction.
    pub(crate) shear: Option<Box<Shear>>,
    /// Of a contact that grows with the load.
    pub(crate) growing: Option<Box<Growing>>,
    /// Made when first asked for.
    slip_check: Option<Box<SlipCheck>>,
    /// Whether it solves slices of contacts that grow. Friction bears their sum: it need not bear each of them.
    pub(crate) of_slices: bool,
    /// Whether it does not bear one of those examined.
    pub(crate) is_overloaded: bool,
    /// The friction curve, and the half-width that it belongs to: it depends on no load.
    sampled: Option<(f64, Samples)>,
    /// The stick zones found last, and the half-width and the friction coefficient that they belong to: they
    /// depend on no load either.
    rubbed: Option<(f64, f64, Rubbing)>,
    /// Half-width and force of the pressure that `shear` was shown last.
    shown: Option<(f64, f64)>,
    /// [`Layer::fineness`] of the kernels that all of that was found with.
    found_with: u64,
    /// How wide the contact became under its load, where that was looked for.
    sized: Option<(LoadInLayerUnits, Size)>,
}

/// What one resolution found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outcome {
    /// The numbers reported, in layer units.
    pub(crate) numbers: Numbers,
    pub(crate) rubbing: Option<Rubbing>,
    pub(crate) size: Option<Size>,
    /// The pressure at [`Traces::AT`] over its mean.
    pressure: [f64; Traces::AT.len()],
    /// Of a contact that grew: what its stack loses, relative.
    pub(crate) lost: Option<f64>,
    /// The same of a pressure exactly at a kink of the shape.
    pub(crate) lost_at_kinks: f64,
    /// What series over the half-width leave of a stack.
    pub(crate) left: Left,
}

impl Outcome {
    /// Of a contact that grew; the pressure is that at [`Traces::AT`], over its mean.
    pub(crate) fn new(
        numbers: Numbers,
        rubbing: Option<Rubbing>,
        size: Option<Size>,
        pressure: [f64; Traces::AT.len()],
        (lost, lost_at_kinks): (f64, f64),
        left: Left,
    ) -> Self {
        Self { numbers, rubbing, size, pressure, lost: Some(lost), lost_at_kinks, left }
    }

    /// An outcome of which only the stick zone is known.
    pub(crate) fn of_rubbing(rubbing: Rubbing) -> Self {
        Self::new(Numbers::default(), Some(rubbing), None, [0.0; Traces::AT.len()], (0.0, 0.0), Left::default())
    }

    /// What it tells of the next resolution.
    pub(crate) fn seen(&self) -> Seen {
        let shear = self.rubbing.as_ref().and_then(|rubbing| rubbing.shear);
        let traces = Traces { pressure: self.pressure, shear, is_stacked: self.lost.is_some() };
        let mut numbers = self.numbers;
        if self.rubbing.as_ref().is_some_and(|rubbing| rubbing.is_full) {
            // A zone that is all of the contact is no number that converges.
            for quantity in [Quantity::StickHalfWidth, Quantity::StickRatio, Quantity::OneMinusRatio] {
                numbers.take(quantity);
            }
        }
        Seen { numbers, traces }
    }
}

/// What a stage needs to know beside its own scratch.
#[derive(Clone, Copy)]
pub(crate) struct Task<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) wanted: Wanted,
    pub(crate) tolerance: f64,
}

/// What solves a contact that is stacked.
fn stacking(growing: &mut Option<Box<Growing>>) -> Option<&mut Growing> {
    growing.as_deref_mut().filter(|growing| growing.is_solver)
}

impl Stage {
    pub(crate) fn new(problem: &Problem, quadrature: Box<dyn Quadrature>) -> Result<Self, Refusal> {
        let edge = if problem.fixed_half_width().is_some() { Edge::Sharp } else { Edge::Smooth };
        let normal = Normal::new(quadrature.as_ref(), edge)?;
        let grows = problem.fixed_half_width().is_none();
        let growing = grows.then(|| Box::new(Growing::new(problem, quadrature.clone())));
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
            growing,
            slip_check: None,
            of_slices: false,
            is_overloaded: false,
            sampled: None,
            rubbed: None,
            shown: None,
            found_with: 0,
            sized: None,
        })
    }

    /// Solves; `coarse` is what a coarser resolution found, and the flat punches it found it with.
    pub(crate) fn solve(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        coarse: Option<&Outcome>,
        family: Option<&Family>,
    ) -> Result<Outcome, Refusal> {
        let problem = task.problem;
        if let Some(growing) = stacking(&mut self.growing) {
            return growing.solve(layer, task, &mut self.normal, coarse, family);
        }
        let size = if let Some(half_width) = problem.fixed_half_width() {
            self.press(layer, task, half_width)?;
            None
        } else {
            let known = coarse.and_then(|coarse| coarse.size);
            Some(self.press_smooth(layer, task, known)?)
        };
        let rubbing = match problem.friction {
            Some(eta) if problem.is_linear => {
                Some(self.rub_linearly(layer, task, eta, coarse.and_then(|c| c.rubbing.as_ref()))?)
            }
            Some(eta) => Some(self.rub(layer, task, eta, coarse.and_then(|c| c.rubbing.as_ref()))?),
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

    /// Solves another load of a punch whose contact grows, no wider than the one given, from what is known of others and what a
    /// coarser resolution found; `None` where that is not enough.
    pub(crate) fn solve_again(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        widest: f64,
        coarse: Option<&Outcome>,
    ) -> Result<Option<Outcome>, Refusal> {
        let problem = task.problem;
        let known = coarse.and_then(|coarse| coarse.size);
        if let Some(growing) = stacking(&mut self.growing) {
            return growing.solve_again(layer, task, &mut self.normal, known);
        }
        let known = known.or_else(|| self.sized.and_then(|(before, size)| size.under(before, problem.load)));
        let Some(known) = known.filter(|size| size.half_width <= widest && problem.friction.is_none()) else {
            return Ok(None);
        };
        let size = self.press_smooth(layer, task, Some(known))?;
        Ok(Some(self.outcome(layer, problem, Some(size), None)))
    }

    /// Pressure at points strictly inside the contact solved last.
    pub(crate) fn pressure_into(&mut self, problem: &Problem, at: &[Station], out: &mut [f64]) {
        match stacking(&mut self.growing) {
            Some(growing) => growing.pressure_into(problem, &self.normal, at, out),
            None => self.normal.values_into(at, out),
        }
    }

    /// Error estimate of the pressure between its nodes, see [`Normal::lost_between`]; `None` where nothing tells.
    pub(crate) fn lost_between(&self) -> Option<f64> {
        let is_stacked = self.growing.as_ref().is_some_and(|growing| growing.is_solver);
        if is_stacked { None } else { self.normal.lost_between().map(|lost| SAFETY * lost) }
    }

    /// Shear at such points, where the pressures are `pressure`; `None` where there is none to tell.
    pub(crate) fn shear(&mut self, problem: &Problem, at: &[Station], pressure: &[f64]) -> Option<Vec<f64>> {
        match stacking(&mut self.growing) {
            Some(growing) => growing.shear(problem, at, pressure),
            None => self.shear.as_ref().map(|shear| shear.values(at, pressure)),
        }
    }

    /// The strain left on the surface at points `x >= 0` of the stick zone, to within an error, and how uncertain it is where the
    /// tractions are exact; `None` where there is none to tell.
    pub(crate) fn strain(
        &mut self,
        layer: &PreparedLayer,
        problem: &Problem,
        (at, wanted): (&[f64], f64),
    ) -> Option<(Vec<Option<f64>>, f64)> {
        match stacking(&mut self.growing) {
            Some(growing) => growing.strain(layer, problem, &self.normal, (at, wanted)),
            // What sticks to a flat punch has never slipped.
            None => self.shear.as_ref().map(|shear| {
                let rate = problem.elastic.a0() * shear.strain_rate;
                (at.iter().map(|x| Some(rate * x)).collect(), 0.0)
            }),
        }
    }

    /// Friction coefficient of the shear, negative where the slip is outward.
    pub(crate) fn signed_friction(&self) -> Option<f64> {
        match self.growing.as_ref().filter(|growing| growing.is_solver) {
            Some(growing) => growing.signed_friction(),
            None => self.shear.as_ref().map(|shear| shear.friction),
        }
    }

    /// Where the pressure of an outcome pulls, see [`checks::tension`].
    pub(crate) fn tension(
        &mut self,
        layer: &PreparedLayer,
        problem: &Problem,
        outcome: &Outcome,
    ) -> Option<(f64, f64)> {
        if self.growing.as_mut().is_some_and(|growing| growing.is_solver && growing.presses(problem)) {
            return None;
        }
        let (b, mean) = (outcome.numbers.get(Quantity::HalfWidth)?, outcome.numbers.get(Quantity::Mean)?);
        Lookout::lend(|lookout| {
            match stacking(&mut self.growing) {
                Some(growing) => growing.look(&self.normal, lookout),
                None => self.normal.look(lookout),
            }
            checks::tension(lookout, (b, mean, layer.length()), |at, out| self.pressure_into(problem, at, out))
        })
    }

    /// Whether friction cannot be told of a contact as it grew.
    pub(crate) fn is_broken(&self) -> bool {
        self.growing.as_ref().is_some_and(|growing| growing.is_broken())
    }

    /// Unknowns of the pressure.
    pub(crate) fn unknowns(&self) -> usize {
        self.normal.size()
    }

    /// Work in its systems so far.
    pub(crate) fn work(&self) -> Work {
        let of_shear = self.shear.as_deref().map_or(Work::default(), Shear::work);
        let of_members = self.growing.as_ref().map_or(Work::default(), |growing| growing.work());
        self.normal.work() + of_shear + of_members
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
}
