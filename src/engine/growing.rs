//! A contact that grows with the load, solved as a stack of flat punches: under friction, which remembers how it grew,
//! and under shapes that are not analytic.

mod blend;
pub(crate) mod family;
mod friction;
mod overload;
mod sheet;
mod stack;
mod strain;

use super::outcome::{Left, Lost, Outcome, Task};
use super::prepared_layer::PreparedLayer;
use super::problem::{LoadInLayerUnits, Problem};
use super::work::Work;
use crate::engine::accuracy::quantity::{Numbers, Quantity, Traces};
use crate::engine::friction::rubbing::Rubbing;
use crate::engine::pressure::contact_size::{self, Size};
use crate::engine::pressure::lookout::Lookout;
use crate::engine::pressure::normal::Normal;
use family::{Family, Unfit};
use slipzone_api::{Quadrature, Refusal, Station};
use stack::Stack;

/// By how much a family is wider than a contact that a coarser resolution found.
const ROOM: f64 = 1.02;
/// By how much it is wider than one that was guessed.
const ROOM_BESIDE_GUESS: f64 = 1.3;
/// And where what is wider spoils it, though its size is a coarser resolution's.
const SCANT_ROOM: f64 = 1.001;
/// How often it is widened when that was not enough.
const WIDENED: usize = 20;
/// Nearer to the end of a shape, relative, a family is not widened any more.
const BESIDE_END: f64 = 1e-4;
/// Error of a guess.
const GUESSED: f64 = 1e-3;
/// Error of the series over the half-width, over the tolerance.
const SERIES_SHARE: f64 = 1e-2;
/// Nodes on either side of the integrals over shape and half-width: this many,
const FEWEST_NODES: f64 = 6.0;
/// more per decimal digit of the tolerance,
const NODES_PER_DIGIT: f64 = 1.8;
/// per unknown, so that resolutions differ in them, too,
const NODES_PER_UNKNOWN: f64 = 0.125;
/// and per kernel length in the widest half-width.
///
/// Measured on half-planes at x = 0.03 b: errors of 6e-9, 1e-9 and 3e-11 of the largest traction with 14, 18 and 26.
/// Under a kink on a layer of a tenth of the half-width, ten times as stiff as what is below: of the pressure there 0.5
/// and 3e-4 with 17 and 28; with 34 it is as good as the flat punches.
const NODES_PER_LENGTH: f64 = 1.5;
/// Lengths from which more of them take no more nodes: a bound of the work. Measured up to some 30.
const MOST_LENGTHS: f64 = 60.0;
/// The stick zone may shrink by rounding, relative.
const STEADY: f64 = 1e-9;

/// One resolution of a growing contact.
pub(crate) struct Growing {
    quadrature: Box<dyn Quadrature>,
    pub(crate) family: Option<Family>,
    /// Work in its systems before it was inherited.
    inherited: Work,
    stack: Option<Stack>,
    /// Half-width of the present contact.
    half_width: f64,
    force: f64,
    /// Whether the contact is solved as a stack, or only followed as one on its way to the load.
    pub(crate) is_solver: bool,
    /// Whether the pressure is stacked, too.
    is_kinked: bool,
    /// What keeps friction from being told.
    broken: Option<(f64, Rubbing)>,
    /// The same of coarser resolutions, where this one is not to look for it again.
    given_up: Option<(f64, Rubbing)>,
}

impl Growing {
    pub(crate) fn new(problem: &Problem, quadrature: Box<dyn Quadrature>) -> Self {
        Self {
            quadrature,
            family: None,
            inherited: Work::default(),
            stack: None,
            half_width: 0.0,
            force: 0.0,
            is_solver: problem.is_stacked(),
            is_kinked: problem.is_kinked(),
            broken: None,
            given_up: None,
        }
    }

    /// Takes flat punches that were solved for another punch.
    pub(crate) fn inherit(&mut self, family: Option<Family>) {
        self.inherited = family.as_ref().map_or(Work::default(), Family::work);
        self.family = family;
    }

    /// Solves, from the size that a coarser resolution found and the family that it found it with.
    pub(crate) fn solve(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        normal: &mut Normal,
        known: Option<Size>,
        coarse_family: Option<&Family>,
    ) -> Result<Outcome, Refusal> {
        let problem = task.problem;
        let size = if self.is_kinked {
            guessed(layer, task, normal, known)?
        } else {
            contact_size::press(layer, problem, normal, task.wanted, task.tolerance, known)?
        };
        let room = room(problem, size.half_width, self.is_kinked && known.is_none());
        self.provide(layer, task, size.half_width, room, coarse_family)?;
        let size = if self.is_kinked { self.widen(layer, task, size)? } else { size };
        let (numbers, pressure) = self.sized(layer, problem, normal, size);
        let rubbing = match problem.friction {
            Some(_) => Some(self.rub(layer, task, normal)?),
            None => None,
        };
        let pressure = pressure.unwrap_or_else(|| self.pressure_traced(problem, normal));
        Ok(self.outcome(problem, size, numbers, pressure, rubbing))
    }

    /// Solves another load of the same punch, the stick zone told between those of the flat punches known; `None` where
    /// it is no stack of these, or where friction is to be looked at more closely.
    pub(crate) fn solve_again(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        normal: &mut Normal,
        known: Option<Size>,
    ) -> Result<Option<Outcome>, Refusal> {
        let problem = task.problem;
        let rubs = problem.friction.is_some();
        let serves = |family: &Family, half_width: f64| family.serves(task, rubs, half_width);
        let Some(widest) = self.family.as_ref().filter(|_| self.broken.is_none()).map(Family::widest) else {
            return Ok(None);
        };
        if self.stack.is_none() && self.family.as_ref().is_some_and(|family| serves(family, widest)) {
            // Under another punch.
            if problem.reach() < widest {
                return Ok(None);
            }
            self.stacked_on(task, f64::INFINITY)?;
        }
        let (Some(family), Some(stack)) = (&mut self.family, &mut self.stack) else { return Ok(None) };
        let Some(half_width) = stack.under(problem, family, problem.load) else { return Ok(None) };
        if !serves(family, half_width) || !stack.reaches(half_width) {
            return Ok(None);
        }
        let size = if self.is_kinked {
            stack.size(problem, family, half_width)
        } else {
            let start = known.unwrap_or_else(|| stack.size_about(problem, family, half_width));
            contact_size::press(layer, problem, normal, task.wanted, task.tolerance, Some(start))?
        };
        // By a hair it may be wider than expected.
        let is_steady = family.shrinks(problem.face()..size.half_width, STEADY).is_none();
        if !serves(family, size.half_width) || !is_steady {
            return Ok(None);
        }
        // The finer of both resolutions solves the zone for itself: between the flat punches it is known to the
        // tolerance only.
        let rubbing = match known {
            Some(_) if rubs => match family.rubbing(layer, task, size.half_width)? {
                None => return Ok(None),
                solved => solved,
            },
            _ => family.rubbing_between(problem, size.half_width),
        };
        let (numbers, pressure) = self.sized(layer, problem, normal, size);
        // A stacked pressure is as good as the flat punches known.
        let pressure = pressure.unwrap_or_default();
        Ok(Some(self.outcome(problem, size, numbers, pressure, rubbing)))
    }

    /// Takes a size; the numbers of the pressure there, and the pressure at [`Traces::AT`] over its mean unless it is
    /// stacked.
    fn sized(
        &mut self,
        layer: &PreparedLayer,
        problem: &Problem,
        normal: &mut Normal,
        size: Size,
    ) -> (Numbers, Option<[f64; Traces::AT.len()]>) {
        self.half_width = size.half_width;
        let (numbers, pressure) = if self.is_kinked {
            (self.stacked_numbers(layer, problem), None)
        } else {
            let (numbers, pressure) = normal.numbers(layer, problem);
            (numbers, Some(pressure))
        };
        self.force = numbers.get(Quantity::Force).expect("every contact has one");
        (numbers, pressure)
    }

    /// Mean pressure.
    fn mean(&self) -> f64 {
        self.force / (2.0 * self.half_width)
    }

    /// The pressure at [`Traces::AT`] over its mean.
    fn pressure_traced(&mut self, problem: &Problem, normal: &Normal) -> [f64; Traces::AT.len()] {
        let mean = self.mean();
        let mut pressure = [0.0; Traces::AT.len()];
        self.pressure_into(problem, normal, &Traces::stations(self.half_width), &mut pressure);
        pressure.map(|p| p / mean)
    }

    fn outcome(
        &self,
        problem: &Problem,
        size: Size,
        mut numbers: Numbers,
        pressure: [f64; Traces::AT.len()],
        rubbing: Option<Rubbing>,
    ) -> Outcome {
        if let Some(rubbing) = rubbing.as_ref().filter(|_| !self.was_broken()) {
            rubbing.report(&mut numbers);
        }
        let left = self.family.as_ref().map_or_else(Left::default, Family::left);
        let left = if self.is_kinked { left } else { Left { shear: left.shear, ..Left::default() } };
        let lost_of = |stack: &Stack| (stack.lost(problem, self.half_width), stack.lost_at_kinks());
        let (stacked, at_kinks) = self.stack.as_ref().map_or((0.0, 0.0), lost_of);
        let lost = Some(Lost { stacked, at_kinks, left });
        Outcome { numbers, rubbing, size: Some(size), pressure, lost }
    }

    /// Whether it knows the flat punches that a contact of about that half-width is a stack of.
    pub(crate) fn serves(&self, task: Task, half_width: f64) -> bool {
        let rubs = task.problem.friction.is_some();
        let serves = |family: &Family| family.serves(task, rubs, half_width);
        self.is_solver && self.broken.is_none() && self.family.as_ref().is_some_and(serves)
    }

    /// Makes a family and a stack that reach to a half-width.
    fn provide(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        half_width: f64,
        room: f64,
        coarse: Option<&Family>,
    ) -> Result<(), Refusal> {
        self.broken.clone_from(&self.given_up);
        if self.given_up.is_some() && !self.is_kinked {
            (self.family, self.stack) = (None, None);
            return Ok(());
        }
        let rubs = task.problem.friction.is_some() && self.given_up.is_none();
        if self.family.as_ref().is_some_and(|family| family.serves(task, rubs, half_width)) {
            return match &self.stack {
                None => self.stacked_on(task, f64::INFINITY),
                // One that ends sooner tells what is of rounding in this one.
                Some(stack) if !stack.tells(task.problem, half_width, SERIES_SHARE * task.tolerance) => {
                    self.stacked_on(task, room * half_width)
                }
                Some(_) => Ok(()),
            };
        }
        self.stack = None;
        self.inherited = Work::default();
        let made = match self.family_beside(layer, task, (half_width, room), rubs, coarse) {
            Err(Unfit::Friction(at, rubbing)) => {
                self.broken = Some((at, *rubbing));
                // The pressure can be told all the same.
                let sizes = (half_width, room * half_width);
                let dry = || Family::new(layer, task, self.quadrature.as_ref(), sizes, false, None);
                self.is_kinked.then(dry).transpose()
            }
            made => made.map(Some),
        };
        self.family = made.map_err(|unfit| match unfit {
            Unfit::Refused(refusal) => refusal,
            Unfit::Friction(..) => unreachable!("no friction was asked for"),
        })?;
        self.stacked_on(task, f64::INFINITY)
    }

    /// A family that reaches beyond a half-width by so much room, or by less where what is wider spoils it: that is
    /// none of a contact's history.
    fn family_beside(
        &self,
        layer: &mut PreparedLayer,
        task: Task,
        (half_width, room): (f64, f64),
        rubs: bool,
        coarse: Option<&Family>,
    ) -> Result<Family, Unfit> {
        let shrinks = |family: &Family| family.shrinks(0.0..f64::INFINITY, STEADY).is_some();
        let shrank = coarse.is_some_and(shrinks);
        // Where stick zones shrink some are not the contact's own; those at a finer resolution are looked for anew.
        let coarse = coarse.filter(|_| !shrank);
        let mut up_to = |room: f64| {
            let sizes = (half_width, room * half_width);
            Family::new(layer, task, self.quadrature.as_ref(), sizes, rubs, coarse)
        };
        let made = up_to(room);
        let is_spoilt = match &made {
            Err(Unfit::Friction(at, _)) => *at > half_width,
            Err(Unfit::Refused(_)) => false,
            Ok(family) => !shrank && shrinks(family),
        };
        if is_spoilt && room > 1.0 { up_to(if self.is_kinked { room.min(SCANT_ROOM) } else { 1.0 }) } else { made }
    }

    /// Makes the stack over the members of the family, of those up to a half-width.
    fn stacked_on(&mut self, task: Task, up_to: f64) -> Result<(), Refusal> {
        let Some(family) = &mut self.family else { return Ok(()) };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few dozen
        let nodes = (FEWEST_NODES - NODES_PER_DIGIT * task.tolerance.log10()
            + NODES_PER_UNKNOWN * family.unknowns() as f64
            + NODES_PER_LENGTH * family.kernel_lengths().min(MOST_LENGTHS)) as usize;
        let widest = family.widest().min(up_to);
        self.stack = Some(Stack::new(task.problem, family, widest, (SERIES_SHARE * task.tolerance, nodes))?);
        Ok(())
    }

    /// The size of a stacked contact; widens the family until it bears the load.
    fn widen(&mut self, layer: &mut PreparedLayer, task: Task, guess: Size) -> Result<Size, Refusal> {
        let problem = task.problem;
        let mut widest = guess.half_width;
        for _ in 0..WIDENED {
            let (Some(family), Some(stack)) = (&mut self.family, &mut self.stack) else { break };
            let found = stack.under(problem, family, problem.load);
            // Beyond a pole a force is found, too, but no contact.
            let flaw = match found {
                Some(half_width) => problem.flaw(half_width).filter(|flaw| problem.ends_at(flaw)),
                None => problem.flaw(widest),
            };
            if let Some(flaw) = flaw {
                return Err(Refusal::OutOfReach {
                    method: "punch",
                    why: problem.objection(&flaw),
                    remedy: "take a smaller load, or mend the shape",
                });
            }
            if let Some(half_width) = found {
                return Ok(stack.size(problem, family, half_width));
            }
            let before = widest;
            widest = short_of_end(problem, widest, widest * ROOM_BESIDE_GUESS.powi(2));
            if widest <= before * (1.0 + BESIDE_END) {
                return Err(contact_size::outgrown(widest * problem.length));
            }
            self.family = None;
            self.provide(layer, task, widest, 1.0, None)?;
        }
        Err(contact_size::no_size("no half-width of the contact bears the load".into()))
    }

    /// The numbers of a stacked pressure.
    fn stacked_numbers(&mut self, layer: &PreparedLayer, problem: &Problem) -> Numbers {
        let (Some(family), Some(stack)) = (&mut self.family, &mut self.stack) else { unreachable!("provided before") };
        let b = self.half_width;
        let mut numbers = sizes(layer, problem, family, stack, b);
        numbers.set(Quantity::Mean, stack.force(problem, b) / (2.0 * b));
        numbers.set(Quantity::StressIntensity, 0.0);
        numbers.set(Quantity::EdgeRatio, 0.0);
        let corners: Vec<f64> = problem.corners().filter(|corner| *corner < b).collect();
        if problem.wishes.judges(Quantity::Centre) && corners.first().is_none_or(|corner| *corner > 0.0) {
            numbers.set(Quantity::Centre, stack.pressure(problem, family, b, 0.0));
        }
        if problem.wishes.reports(Quantity::Peak) && corners.is_empty() {
            let peak = Lookout::lend(|lookout| {
                lookout.between(&stack.pressure_ends(b), b);
                lookout.peak(|at, out| stack.pressure_into(problem, family, b, at, out))
            });
            numbers.set(Quantity::Peak, peak);
        }
        numbers
    }

    /// Sizes of the contact on its way to a load solved already, whose half-width is given, each with what the stack
    /// that tells them leaves out, relative; `None` where it is no single stack. Stick zones are solved for where they
    /// are to be `sure`: told between the flat punches, narrow ones are as good as wide ones ask for. Where one is not
    /// found near there, or the pressure pulls, infinitely much is left out.
    pub(crate) fn on_the_way(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        (half_width, sure): (f64, bool),
        loads: &[LoadInLayerUnits],
    ) -> Option<Vec<(Numbers, f64)>> {
        self.provide(layer, task, half_width, 1.0, None).ok()?;
        let problem = task.problem;
        let (Some(family), Some(stack), None) = (&mut self.family, &mut self.stack, &self.broken) else { return None };
        if problem.friction.is_some() && family.shrinks(problem.face()..half_width, STEADY).is_some() {
            return None;
        }
        let may_pull = !stack.presses(problem, family, half_width);
        let mut point = |load: &LoadInLayerUnits| {
            family.within_budget().ok()?;
            let b = stack.under(problem, family, *load)?;
            let mut numbers = sizes(layer, problem, family, stack, b);
            if may_pull && stack.pulls(problem, family, b) {
                return Some((numbers, f64::INFINITY));
            }
            let missed = stack.excess(problem, family, *load, b).abs();
            let lost = stack.lost(problem, b) + family.left().force + missed;
            if problem.friction.is_none() {
                return Some((numbers, lost));
            }
            let told = if sure {
                family.take_pressure(b);
                family.rubbing(layer, task, b).ok()?
            } else {
                family.rubbing_between(problem, b)
            };
            let Some(rubbing) = told.filter(|told| told.failure().is_none()) else {
                return Some((numbers, f64::INFINITY));
            };
            let zone = rubbing.reported_zone();
            numbers.set(Quantity::StickHalfWidth, zone.half_width);
            numbers.set(Quantity::StickRatio, zone.ratio());
            Some((numbers, lost))
        };
        loads.iter().map(&mut point).collect()
    }

    /// Pressure at points strictly inside the contact.
    pub(crate) fn pressure_into(&mut self, problem: &Problem, normal: &Normal, at: &[Station], out: &mut [f64]) {
        if !self.is_kinked {
            return normal.values_into(at, out);
        }
        let (Some(family), Some(stack)) = (&mut self.family, &self.stack) else { unreachable!("provided before") };
        stack.pressure_into(problem, family, self.half_width, at, out);
    }

    /// Where the pressure is looked at for what happens between the points reported.
    pub(crate) fn look(&self, normal: &Normal, lookout: &mut Lookout) {
        match &self.stack {
            Some(stack) if self.is_kinked => lookout.between(&stack.pressure_ends(self.half_width), self.half_width),
            _ => normal.look(lookout),
        }
    }

    /// Whether its pressure is stacked, too.
    pub(crate) fn stacks_pressure(&self) -> bool {
        self.is_solver && self.is_kinked
    }

    /// Whether the pressure pulls nowhere, because none of the slices does that it is a stack of.
    pub(crate) fn presses(&mut self, problem: &Problem) -> bool {
        let (true, Some(family), Some(stack)) = (self.is_kinked, &mut self.family, &self.stack) else { return false };
        stack.presses(problem, family, self.half_width)
    }

    /// Work in its systems so far.
    pub(crate) fn work(&self) -> Work {
        self.family.as_ref().map_or(Work::default(), |family| family.work() - self.inherited)
    }
}

/// The size of a stacked contact, from a coarser resolution or about.
fn guessed(layer: &mut PreparedLayer, task: Task, normal: &mut Normal, known: Option<Size>) -> Result<Size, Refusal> {
    let problem = task.problem;
    match (problem.load, known) {
        (LoadInLayerUnits::HalfWidth(half_width), _) => Ok(Size::exactly(half_width)),
        (_, Some(size)) => Ok(size),
        // Against a datum a pressure as coarse as this one tells nothing of how deep a kink sinks.
        (LoadInLayerUnits::Indentation(_), None) if !problem.layer.is_grounded() => {
            Ok(Size::exactly(contact_size::guess(problem)))
        }
        (_, None) => match contact_size::press(layer, problem, normal, task.wanted, GUESSED, None) {
            // A contact hardly wider than the face has no node beyond it.
            Err(Refusal::OutOfReach { .. } | Refusal::Limit { .. }) if problem.face() > 0.0 => {
                Ok(Size::exactly(problem.face()))
            }
            found => found,
        },
    }
}

/// By how much a family is to be wider than a contact of that half-width.
fn room(problem: &Problem, half_width: f64, is_guess: bool) -> f64 {
    let room = match problem.load {
        LoadInLayerUnits::HalfWidth(_) => 1.0,
        // Not beyond the end of a circle where that can be helped.
        _ if is_guess && problem.flaw(ROOM_BESIDE_GUESS * half_width).is_none() => ROOM_BESIDE_GUESS,
        _ => ROOM,
    };
    (short_of_end(problem, half_width, room * half_width) / half_width).max(1.0)
}

/// A half-width up to which a family reaches beside a contact: not so far as the shape ends, where no flat punch has a
/// slope.
fn short_of_end(problem: &Problem, contact: f64, wide: f64) -> f64 {
    match problem.flaw(wide).filter(|flaw| problem.ends_at(flaw)) {
        Some(end) => f64::midpoint(contact, end.x / problem.length),
        None => wide.min(problem.reach()),
    }
}

/// Force, half-width and depth of a stacked contact.
fn sizes(layer: &PreparedLayer, problem: &Problem, family: &mut Family, stack: &mut Stack, b: f64) -> Numbers {
    let mut numbers = Numbers::default();
    numbers.set(Quantity::Force, stack.force(problem, b));
    numbers.set(Quantity::HalfWidth, b);
    if layer.has_depths() && problem.wants_depth() {
        numbers.set(Quantity::Indentation, stack.depth(problem, family, b));
    }
    numbers
}
