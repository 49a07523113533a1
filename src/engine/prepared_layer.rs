//! A layer prepared: its flexibility, and its kernels over the lengths asked for so far.

use super::problem::Problem;
use crate::engine::foreign;
use crate::engine::work::budget::Meter;
use crate::engine::work::counted::Counted;
use crate::plan::{Chosen, Methods};
use slipzone_api::{Component, KernelRequest, KernelStrategy, KernelTable, LayerResponse, Refusal, Rule};
use std::sync::Arc;

/// Half-width over the kernels' length from which on it counts how much finer than its unknowns a rule sums them.
const COUNTED: f64 = 8.0;
/// Wave numbers that a strategy counts as having asked for before it gives up: a fortieth of the budget.
const GIVEN_UP: usize = 50_000;

/// By how much tables may reach farther than asked for, where those before them did.
const REACH_KEPT: f64 = 4.0;

/// All kernels: first the depth, which not every base defines, then what the pressure needs, then what friction adds.
const ALL: [Component; 4] = [Component::Depth, Component::NormalSlope, Component::ShearStrain, Component::Coupling];

/// The flexibility of one layer and the kernel tables made of it, reused from load to load.
pub(crate) struct PreparedLayer {
    response: Box<dyn LayerResponse>,
    /// The same with depths counted from a datum, where they have no meaning otherwise and one is named.
    against_datum: Option<Box<dyn LayerResponse>>,
    is_grounded: bool,
    strategy: Box<dyn KernelStrategy>,
    tables: Option<Tables>,
    given_up: Option<Box<GivenUp>>,
    flexibility_evaluations: usize,
    /// Work on it so far, on tables that were replaced too.
    meter: Arc<Meter>,
}

/// What a strategy could not serve, and why.
struct GivenUp {
    reach: f64,
    wanted: Wanted,
    refusal: Refusal,
}

/// Kernels over a range of lengths.
struct Tables {
    /// `None` on a homogeneous half-plane, which has none.
    kernels: Option<Counted>,
    /// The depth's, where it is counted from a datum.
    depth: Option<Counted>,
    reach: f64,
    serves: Wanted,
}

impl Tables {
    /// Whether they prove their errors.
    fn prove(&self) -> bool {
        self.kernels.iter().chain(&self.depth).all(|table| table.error().is_some())
    }

    /// Wave numbers that they took.
    fn evaluations(&self) -> usize {
        self.kernels.iter().chain(&self.depth).map(KernelTable::flexibility_evaluations).sum()
    }
}

/// What the kernels must serve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Wanted {
    /// Whether shear is asked for.
    pub(crate) frictional: bool,
    /// Whether the depth of the punch is, where the base defines it.
    pub(crate) deep: bool,
    /// Error wanted of the numbers.
    pub(crate) accuracy: f64,
    /// Refinement of strategies that do not know their own error.
    pub(crate) level: u32,
}

impl Wanted {
    /// Whether it asks for all of another's, at least as finely.
    fn asks(&self, less: &Self) -> bool {
        self.accuracy <= less.accuracy && (self.frictional || !less.frictional) && (self.deep || !less.deep)
    }
}

/// No kernel counted from a datum is asked for more: rounding of its sums.
const FINEST: f64 = 1e-14;

impl PreparedLayer {
    pub(crate) fn new(problem: &Problem, methods: &Methods) -> Result<Self, Refusal> {
        let response = foreign::response(&*methods.flexibility, &problem.layer)?;
        let is_grounded = problem.layer.is_grounded();
        Ok(Self {
            against_datum: if is_grounded { None } else { response.against_datum() },
            is_grounded,
            response,
            strategy: methods.kernel.clone(),
            tables: None,
            given_up: None,
            flexibility_evaluations: 0,
            meter: Arc::default(),
        })
    }

    /// The layer of a scene, with nothing tabulated yet.
    pub(super) fn of(chosen: &Chosen) -> Result<Self, Refusal> {
        Self::new(&Problem::new(&chosen.scene)?, &chosen.methods)
    }

    /// Whether its kernels can be told, as far as that is known without tabulating any; `deep` is whether the depth's
    /// are wanted.
    pub(super) fn serves(&self, deep: bool) -> Result<(), Refusal> {
        let response = (!self.is_plain()).then_some(&*self.response);
        let from_datum = self.against_datum.as_deref().filter(|_| deep);
        response.into_iter().chain(from_datum).try_for_each(|response| self.strategy.serves(response))
    }

    /// Makes the kernels serve contacts up to a half-width; tables that do already are kept.
    pub(crate) fn tabulate(&mut self, half_width: f64, wanted: Wanted) -> Result<(), Refusal> {
        let reach = 2.0 * half_width;
        let wanted = Wanted { accuracy: wanted.accuracy / spread(half_width), ..wanted };
        let serves = |tables: &Tables| {
            let known = tables.serves;
            let precise = if tables.prove() { known.accuracy <= wanted.accuracy } else { known.level == wanted.level };
            let complete = (known.frictional || !wanted.frictional) && (known.deep || !wanted.deep);
            precise && reach <= tables.reach && complete
        };
        if self.is_plain() && !(self.has_depths() && wanted.deep) || self.tables.as_ref().is_some_and(serves) {
            return Ok(());
        }
        // Who does not prove an error is judged by another level of the same reach: a level more for half the reach may
        // be the same cut-off, and the same error.
        let reach = match &self.tables {
            Some(tables) if !tables.prove() && tables.reach <= REACH_KEPT * reach => reach.max(tables.reach),
            _ => reach,
        };
        self.meter.within()?;
        if let Some(known) = &self.given_up
            && reach >= known.reach
            && wanted.asks(&known.wanted)
            && (wanted.level == known.wanted.level || self.tables.as_ref().is_some_and(Tables::prove))
        {
            return Err(known.refusal.clone());
        }
        let strategy = self.strategy.refined(wanted.level);
        let (kernels, depth) = self.tables_of(&*strategy, (half_width, reach), wanted).inspect_err(|refusal| {
            // Who gives up does not say after how much.
            self.meter.count_wave_numbers(GIVEN_UP);
            self.given_up = Some(Box::new(GivenUp { reach, wanted, refusal: refusal.clone() }));
        })?;
        let tables = Tables { kernels, depth, reach, serves: wanted };
        let evaluations = tables.evaluations();
        self.flexibility_evaluations += evaluations;
        self.meter.count_wave_numbers(evaluations);
        // Two that are the same agree, whatever the error.
        let is_coarser = |before: &&Tables| before.serves.level < wanted.level && before.reach <= reach;
        if !tables.prove()
            && let Some(before) = self.tables.as_ref().filter(is_coarser)
            && evaluations <= before.evaluations()
        {
            let fault = format!(
                "error() = None, but refined({}) takes {evaluations} wave numbers, level {} {}",
                wanted.level,
                before.serves.level,
                before.evaluations()
            );
            return Err(foreign::broken(strategy.typetag_name(), &fault));
        }
        self.tables = Some(tables);
        Ok(())
    }

    /// The tables of a strategy for contacts up to a half-width: those of all kernels wanted, and the depth's from a
    /// datum.
    fn tables_of(
        &self,
        strategy: &dyn KernelStrategy,
        (half_width, reach): (f64, f64),
        wanted: Wanted,
    ) -> Result<(Option<Counted>, Option<Counted>), Refusal> {
        let tabulate = |response: &dyn LayerResponse, components, accuracy| {
            let table = strategy.tabulate(response, &KernelRequest { reach, components, accuracy })?;
            let table = foreign::table(strategy.typetag_name(), table)?;
            Ok(Counted { table, meter: Arc::clone(&self.meter) })
        };
        let components = &ALL[usize::from(!(self.is_grounded && wanted.deep))..if wanted.frictional { 4 } else { 2 }];
        let response = (!self.is_plain()).then_some(&*self.response);
        let kernels = response.map(|response| tabulate(response, components, wanted.accuracy)).transpose()?;
        let from_datum = self.against_datum.as_deref().filter(|_| wanted.deep);
        let accuracy = (wanted.accuracy / self.shallowness(half_width)).max(FINEST);
        let depth = from_datum.map(|response| tabulate(response, &ALL[..1], accuracy)).transpose()?;
        Ok((kernels, depth))
    }

    /// Whether its kernels vary with the distance itself down to the origin, as a power of it does.
    pub(crate) fn begins_with_a_power(&self) -> bool {
        self.nearest().is_some()
    }

    /// Down to which distance, over the thickness, they do.
    pub(crate) fn nearest(&self) -> Option<f64> {
        self.kernel(Component::NormalSlope).and_then(|(table, _)| table.nearest())
    }

    /// The power of the distance with which its kernels begin, over the distance itself, where they do and it is known.
    pub(crate) fn kernel_power(&self) -> Option<f64> {
        self.kernel(Component::NormalSlope).and_then(|(table, _)| table.power())
    }

    /// How far its kernels reach.
    pub(super) fn reach(&self) -> f64 {
        self.tables.as_ref().map_or(0.0, |tables| tables.reach)
    }

    /// Gives up its tables.
    pub(super) fn forget(&mut self) {
        self.tables = None;
    }

    /// What tells kernels that are as good as the present ones from others.
    pub(crate) fn fineness(&self) -> u64 {
        match &self.tables {
            None => 0,
            Some(tables) if tables.prove() => tables.serves.accuracy.to_bits(),
            Some(tables) => 1 + u64::from(tables.serves.level),
        }
    }

    /// The work on it, and its bound.
    pub(crate) fn meter(&self) -> &Arc<Meter> {
        &self.meter
    }

    /// Takes what a system of so many equations and right-hand sides costs, filled in by a rule on a contact, or a
    /// stick zone, of that half-width, from the budget; refuses it where that has no room.
    pub(crate) fn room_for(&self, (n, right): (usize, usize), rule: &dyn Rule, half_width: f64) -> Result<(), Refusal> {
        let thinness = half_width / self.length();
        let beside = if thinness > COUNTED { rule.multiplications_beside(thinness) } else { 0 };
        self.meter.system((n, right), beside)
    }

    /// A kernel for the quadratures; `None` on a homogeneous half-plane, which has none, and for the depth where that
    /// has no meaning or was not wanted.
    pub(crate) fn kernel(&self, component: Component) -> Option<(&dyn KernelTable, Component)> {
        let tables = self.tables.as_ref()?;
        if component == Component::Depth && !tables.serves.deep {
            return None;
        }
        let is_apart = component == Component::Depth && !self.is_grounded;
        let table = if is_apart { &tables.depth } else { &tables.kernels };
        table.as_ref().map(|table| (table as &dyn KernelTable, component))
    }

    /// The kernels that are tabulated.
    pub(crate) fn kernels(&self) -> impl Iterator<Item = (&dyn KernelTable, Component)> {
        let is_frictional = self.tables.as_ref().is_some_and(|tables| tables.serves.frictional);
        let known = &ALL[..if is_frictional { 4 } else { 2 }];
        known.iter().filter_map(|component| self.kernel(*component))
    }

    /// A kernel at each distance; zeros on a homogeneous half-plane.
    pub(crate) fn kernel_values(&self, component: Component, distances: &[f64], out: &mut [f64]) {
        match self.kernel(component) {
            Some((table, component)) => table.values_into(component, distances, out),
            None => out.fill(0.0),
        }
    }

    /// The shortest length over which the kernels vary; infinite without kernels.
    pub(crate) fn length(&self) -> f64 {
        let kernels = self.tables.as_ref().and_then(|tables| tables.kernels.as_ref());
        kernels.map_or(f64::INFINITY, Counted::length)
    }

    /// The error that the tables prove of themselves, grown on its way into the numbers of a contact of
    /// `half_width`; `None` where only a refined twin can tell.
    pub(crate) fn kernel_error(&self, half_width: f64) -> Option<f64> {
        let Some(tables) = &self.tables else { return Some(0.0) };
        Some(spread(half_width) * proven(tables.kernels.as_ref())?)
    }

    /// The same of the kernel that tells depths, and nothing else.
    pub(crate) fn depth_error(&self, half_width: f64) -> Option<f64> {
        let Some(tables) = &self.tables else { return Some(0.0) };
        Some(self.shallowness(half_width) * proven(tables.depth.as_ref())?)
    }

    /// What is wrong beside it of the singularity at an edge.
    pub(crate) fn edge_error(&self) -> f64 {
        let kernels = self.tables.as_ref().and_then(|tables| tables.kernels.as_ref());
        kernels.map_or(0.0, Counted::edge_error)
    }

    /// Whether all its tables prove their error.
    pub(crate) fn is_proven(&self) -> bool {
        self.tables.as_ref().is_none_or(Tables::prove)
    }

    /// The half-width over the distance to a datum, where that is near: what sinks against it is as small, and an error
    /// of its kernel as large beside it.
    fn shallowness(&self, half_width: f64) -> f64 {
        let distance = self.against_datum.as_ref().and_then(|response| response.depth());
        distance.map_or(1.0, |distance| (half_width / distance).max(1.0))
    }

    /// The flexibility of its surface.
    pub(crate) fn response(&self) -> &dyn LayerResponse {
        &*self.response
    }

    /// Whether this is a homogeneous half-plane: no kernels but the depth's.
    pub(crate) fn is_plain(&self) -> bool {
        self.response.depth().is_none()
    }

    /// Whether depths are known: far below nothing gives way, or a datum is named.
    pub(crate) fn has_depths(&self) -> bool {
        self.is_grounded || self.against_datum.is_some()
    }

    /// Wave numbers at which the flexibility was evaluated so far.
    pub(crate) fn flexibility_evaluations(&self) -> usize {
        self.flexibility_evaluations
    }

    /// Distances at which its kernels were read so far.
    pub(crate) fn kernel_evaluations(&self) -> u64 {
        self.meter.readings()
    }
}

/// The error that a table proves of itself.
fn proven(table: Option<&Counted>) -> Option<f64> {
    table.map_or(Some(0.0), Counted::error)
}

/// By how much an error of the kernels grows on its way into the numbers: a layer thinner than the contact
/// answers a tilt of its surface over the whole width with a pressure larger by `b/h`.
fn spread(half_width: f64) -> f64 {
    1.0 + half_width
}
