//! One scene at one resolution: a contact solved at once, or a stack of them.

use crate::engine::accuracy::error_estimate::SAFETY;
use crate::engine::accuracy::quantity::Quantity;
use crate::engine::contact::Contact;
use crate::engine::friction::checks;
use crate::engine::friction::strain::Strains;
use crate::engine::growing::Growing;
use crate::engine::growing::family::Family;
use crate::engine::outcome::{Outcome, Task};
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::pressure::lookout::Lookout;
use crate::engine::problem::Problem;
use crate::engine::work::Work;
use slipzone_api::{Quadrature, Refusal, Station};

/// All that is solved at one resolution, reused from load to load.
pub(crate) struct Stage {
    /// The contact solved at once. Where it is stacked under a smooth punch, its pressure.
    pub(crate) contact: Contact,
    /// Of a contact that grows with the load.
    pub(crate) growing: Option<Box<Growing>>,
}

/// What solves a contact that is stacked.
fn stacking(growing: &mut Option<Box<Growing>>) -> Option<&mut Growing> {
    growing.as_deref_mut().filter(|growing| growing.is_solver)
}

impl Stage {
    pub(crate) fn new(problem: &Problem, quadrature: Box<dyn Quadrature>) -> Result<Self, Refusal> {
        let grows = problem.fixed_half_width().is_none();
        let growing = grows.then(|| Box::new(Growing::new(problem, quadrature.clone())));
        Ok(Self { contact: Contact::new(problem, quadrature)?, growing })
    }

    /// Solves; `coarse` is what a coarser resolution found, and the flat punches it found it with.
    pub(crate) fn solve(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        coarse: Option<&Outcome>,
        family: Option<&Family>,
    ) -> Result<Outcome, Refusal> {
        let size = coarse.and_then(|coarse| coarse.size);
        match stacking(&mut self.growing) {
            Some(growing) => growing.solve(layer, task, &mut self.contact.normal, size, family),
            None => self.contact.solve(layer, task, size, coarse.and_then(|coarse| coarse.rubbing.as_ref())),
        }
    }

    /// Solves another load of a punch whose contact grows, no wider than the one given, from what is known of others
    /// and what a coarser resolution found; `None` where that is not enough.
    pub(crate) fn solve_again(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        widest: f64,
        coarse: Option<&Outcome>,
    ) -> Result<Option<Outcome>, Refusal> {
        let known = coarse.and_then(|coarse| coarse.size);
        match stacking(&mut self.growing) {
            Some(growing) => growing.solve_again(layer, task, &mut self.contact.normal, known),
            None => self.contact.solve_again(layer, task, widest, known),
        }
    }

    /// Pressure at points strictly inside the contact solved last.
    pub(crate) fn pressure_into(&mut self, problem: &Problem, at: &[Station], out: &mut [f64]) {
        match stacking(&mut self.growing) {
            Some(growing) => growing.pressure_into(problem, &self.contact.normal, at, out),
            None => self.contact.normal.values_into(at, out),
        }
    }

    /// Error estimate of the pressure between its nodes, see [`Normal::lost_between`]; `None` where nothing tells.
    pub(crate) fn lost_between(&self, nearest: f64) -> Option<f64> {
        let is_stacked = self.growing.as_ref().is_some_and(|growing| growing.stacks_pressure());
        if is_stacked { None } else { self.contact.normal.lost_between(nearest).map(|lost| SAFETY * lost) }
    }

    /// Shear at such points, where the pressures are `pressure`; `None` where there is none to tell.
    pub(crate) fn shear(&mut self, problem: &Problem, at: &[Station], pressure: &[f64]) -> Option<Vec<f64>> {
        match stacking(&mut self.growing) {
            Some(growing) => growing.shear(problem, at, pressure),
            None => self.contact.shear.as_ref().map(|shear| shear.values(at, pressure)),
        }
    }

    /// The strain left on the surface at points `x >= 0` of the stick zone, to within an error, and how uncertain it is
    /// where the tractions are exact; `None` where there is none to tell.
    pub(crate) fn strain(
        &mut self,
        layer: &PreparedLayer,
        problem: &Problem,
        (at, wanted): (&[f64], f64),
    ) -> Result<Option<Strains<Option<f64>>>, Refusal> {
        match stacking(&mut self.growing) {
            Some(growing) => growing.strain(layer, problem, &self.contact.normal, (at, wanted)),
            // What sticks to a flat punch has never slipped.
            None => Ok(self.contact.shear.as_ref().map(|shear| {
                let rate = problem.elastic.a0() * shear.strain_rate;
                Strains { each: at.iter().map(|x| Some(rate * x)).collect(), apart: 0.0 }
            })),
        }
    }

    /// Friction coefficient of the shear, negative where the slip is outward.
    pub(crate) fn signed_friction(&self) -> Option<f64> {
        match self.growing.as_ref().filter(|growing| growing.is_solver) {
            Some(growing) => growing.signed_friction(),
            None => self.contact.shear.as_ref().map(|shear| shear.friction),
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
                Some(growing) => growing.look(&self.contact.normal, lookout),
                None => self.contact.normal.look(lookout),
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
        self.contact.normal.size()
    }

    /// Leaves the shear of the stick zone reported, and checks it. Returns whether another zone than before is
    /// reported.
    pub(crate) fn settle(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        outcome: &mut Outcome,
    ) -> Result<bool, Refusal> {
        match stacking(&mut self.growing) {
            Some(growing) => growing.settle(layer, task, outcome).map(|()| false),
            None => self.contact.settle(layer, task, outcome),
        }
    }

    /// Work in its systems so far.
    pub(crate) fn work(&self) -> Work {
        self.contact.work() + self.growing.as_ref().map_or(Work::default(), |growing| growing.work())
    }
}
