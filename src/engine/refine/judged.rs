//! How sure a solved contact is.

use crate::engine::accuracy::error_estimate::{ROUNDING, SAFETY, SLIP_ROUNDING};
use crate::engine::accuracy::quantity::{Numbers, Quantity, ShearTrace};
use crate::engine::friction::half_plane_shear::HalfPlaneShear;
use crate::engine::friction::rubbing::Verdict;
use crate::engine::outcome::Outcome;
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::problem::Problem;
use slipzone_api::Refusal;
use std::f64::consts::FRAC_2_PI;

/// Error of the shear, over the tolerance, from which it takes finer steps. Of 700 random contacts the true one was
/// below a tenth of the estimate in three of four, above all of it in one of fifty.
pub(crate) const SHEAR: f64 = 6.0;
/// The same of the pressure between its nodes.
pub(crate) const BETWEEN: f64 = 3.0;
/// Factor on what the series over the half-width are taken to leave of a shear. With 4 one of 480 loads under known
/// punches was off by 1.01 of what was claimed, with 2 one of forty by 1.15, well within what is allowed.
const LEFT_OF_SHEAR: f64 = 5.0;
/// Error of the pressure, of the shear, and of the strain left, over the tolerance, from which it is said among the
/// assumptions.
pub(crate) const SAID: f64 = 3.0;
/// What a stack leaves out, over the tolerance: its nodes are as many as that asks for.
///
/// Measured: 2.4e-7 of the pressure in the middle of a rounded flat punch at 1e-3.
const STACKED: f64 = 1e-3;
/// Drive of the shear, over the pressure, below which its zone feels errors of the kernels more than the pressure does.
///
/// Measured where the drive was 1e-5 to 1e-2: zones off by 0.2 to 0.6 times what follows from it; where it was 0.03 to
/// 0.1 by 0.4 to 5 times, the worst of 9,000.
const DRIVEN: f64 = 0.3;
/// Share of the tolerance below which no error of the shear's numbers is claimed: what a few coarse resolutions show of
/// a stick zone may agree by chance.
///
/// The atlas found three of 1,000 stick zones off by 3 to 9 of their estimates, at most by 0.35 of the tolerance, and
/// 100,000 random scenes seven, one of them by half of it; three of these estimates are 0.6 of it.
const CLAIMED_OF_SHEAR: f64 = 0.2;
/// A number less certain than this, relative, is not known; a pressure less certain is no ground for saying that it
/// pulls.
pub(crate) const UNKNOWN: f64 = 0.1;
/// Errors that stop shrinking below this are those of rounding.
pub(crate) const ROUNDED: f64 = 1e-9;

/// How sure a solved contact is, and how that is known.
pub(crate) struct Judged {
    pub(crate) outcome: Outcome,
    /// The step of the ladder whose stage holds its tractions.
    pub(crate) step: usize,
    /// Of the numbers that have to meet the tolerance.
    pub(crate) errors: Numbers,
    /// How uncertain the shear itself is, over its largest value, where it is asked for.
    pub(crate) of_shear: Option<f64>,
    /// How uncertain the pressure is between the nodes, over the pressure there or its mean, where it is asked for.
    pub(crate) of_pressure: Option<f64>,
    /// How uncertain the pressure itself is; `None` where no number tells.
    pub(crate) doubt: Option<f64>,
    pub(crate) how: How,
    /// The largest error of the model that stands for the solid.
    pub(crate) of_model: f64,
    /// Why refinement ended before the tolerance was met.
    pub(crate) stopped: Option<Refusal>,
    /// Whether it ended because no refinement will help, whatever the methods: the punch lifts off, or the shape has
    /// details.
    pub(crate) is_hopeless: bool,
}

impl Judged {
    pub(crate) fn new(outcome: Outcome, step: usize, errors: Numbers, how: How) -> Self {
        Self {
            outcome,
            step,
            errors,
            of_shear: None,
            of_pressure: None,
            doubt: None,
            how,
            of_model: 0.0,
            stopped: None,
            is_hopeless: false,
        }
    }

    /// Completes what the resolutions told: errors that their differences do not see, and which of them count.
    pub(crate) fn conclude(&mut self, problem: &Problem, layer: &PreparedLayer, tolerance: f64) {
        if self.outcome.rubbing.as_ref().is_some_and(|rubbing| !rubbing.has_zone()) {
            // What stands for it in the differences is where the search began.
            for quantity in Quantity::ALL.into_iter().filter(|quantity| quantity.is_of_shear()) {
                self.outcome.numbers.take(quantity);
                self.errors.take(quantity);
            }
            self.of_shear = None;
        }
        if let Some(of_shear) = self.of_shear {
            self.errors.set(Quantity::Shear, of_shear);
        }
        if let Some(of_shear) = self.errors.get(Quantity::Shear) {
            // It is stacked of the pressures, too, and what it lacks of sliding is taken off one that may be off
            // between the nodes.
            let left = self.outcome.lost.unwrap_or_default().left;
            let between = self.outcome.lost.and(self.of_pressure).unwrap_or(0.0);
            let share =
                self.outcome.rubbing.as_ref().and_then(|rubbing| rubbing.shear).map_or(0.0, |shear| shear.of_sliding());
            self.errors.set(Quantity::Shear, of_shear + LEFT_OF_SHEAR * left.shear + left.pressure + share * between);
        }
        let errors = self.errors;
        for (quantity, error) in errors.iter().filter(|(quantity, _)| quantity.is_of_shear()) {
            self.errors.set(quantity, error.max(CLAIMED_OF_SHEAR * tolerance));
        }
        self.errors = with_the_rest(problem, layer, &self.outcome, tolerance, self.errors);
        for given in problem.given() {
            self.errors.set(given, 0.0);
        }
        // A bound does not change with the resolution, or does by chance: differences say nothing of its error. Under a
        // pressure of which nothing is known it is no bound.
        if let Some(bound) = bound_of_stick(&self.outcome, self.errors.get(Quantity::HalfWidth).unwrap_or(0.0)) {
            let unknown = doubt(problem, &self.errors).filter(|doubt| *doubt > UNKNOWN).unwrap_or(0.0);
            bound.iter().for_each(|(quantity, error)| self.errors.set(quantity, error.max(unknown)));
        }
        self.errors = self.errors.telling();
        self.doubt = doubt(problem, &self.errors);
        self.of_pressure = self.of_pressure.map(|between| between + self.doubt.unwrap_or(0.0));
        let has_shear = self.outcome.numbers.get(Quantity::StickHalfWidth).is_some();
        self.of_shear = self.errors.take(Quantity::Shear).filter(|_| problem.wishes.profile && has_shear);
        self.errors = self.errors.judged_by(problem.wishes);
    }

    /// Its largest error.
    pub(crate) fn worst(&self) -> f64 {
        self.errors.worst().map_or(0.0, |(_, error)| error)
    }

    /// The largest error of its pressure, at the nodes and between them.
    pub(crate) fn of_all_pressure(&self) -> f64 {
        let of_numbers = self.errors.iter().filter(|(quantity, _)| !quantity.is_of_shear()).map(|(_, error)| error);
        of_numbers.chain(self.of_pressure).fold(0.0, f64::max)
    }

    /// Whether it misses the tolerance because the shape has details that a grid over all of the contact does not
    /// resolve.
    pub(crate) fn misses_details(&self, problem: &Problem, tolerance: f64) -> bool {
        self.how != How::Twin && self.worst() > tolerance && has_details(problem, &self.outcome, tolerance)
    }
}

/// How the errors were estimated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum How {
    /// By a finer twin.
    Twin,
    /// By that many resolutions, the kernels by their own proof or not.
    Sequence { count: usize, kernels_proven: bool },
    /// By two resolutions and how fast they came before, the kernels likewise.
    Again { kernels_proven: bool },
}

/// Whether the shape has details within the contact found that its grid cannot resolve.
pub(crate) fn has_details(problem: &Problem, outcome: &Outcome, tolerance: f64) -> bool {
    outcome.numbers.get(Quantity::HalfWidth).is_some_and(|half_width| problem.has_details(half_width, tolerance))
}

/// What a grid of so many unknowns may have missed of them, and every coarser one.
pub(crate) fn hidden_details(problem: &Problem, outcome: &Outcome, unknowns: usize) -> f64 {
    let half_width = outcome.numbers.get(Quantity::HalfWidth);
    half_width.map_or(0.0, |half_width| problem.hidden_details(half_width, unknowns))
}

/// The largest error of a number that has to meet the tolerance.
pub(crate) fn worst_judged(problem: &Problem, errors: &Numbers) -> Option<(Quantity, f64)> {
    errors.judged_by(problem.wishes).worst()
}

/// Whether all that has to meet the tolerance does.
pub(crate) fn meets(problem: &Problem, errors: &Numbers, tolerance: f64) -> bool {
    worst_judged(problem, errors).is_none_or(|(_, error)| error <= tolerance)
}

/// How uncertain the pressure is: by its value in the middle, or by all that is known of it where that is not asked
/// for, or not finite.
fn doubt(problem: &Problem, errors: &Numbers) -> Option<f64> {
    // Under a tip there is none.
    if let Some(centre) = errors.get(Quantity::Centre).filter(|_| problem.wishes.judges(Quantity::Centre)) {
        return Some(centre);
    }
    let of_pressure = errors.iter().filter(|(quantity, _)| !quantity.is_of_shear());
    of_pressure.map(|(_, error)| error).reduce(f64::max)
}

/// Whether the pressure is known well enough to judge by it what is made of it, asked for or not.
pub(crate) fn is_pressure_known(problem: &Problem, errors: &Numbers) -> bool {
    doubt(problem, errors).is_none_or(|doubt| doubt <= UNKNOWN)
}

/// What the forces of flat punches told between those solved may be off by, relative.
fn between_members(outcome: &Outcome) -> f64 {
    SAFETY * outcome.lost.map_or(0.0, |lost| lost.left.force)
}

/// What more flat punches, and smoother ones, mend of a number.
pub(crate) fn mended(outcome: &Outcome, quantity: Quantity) -> f64 {
    between_members(outcome) + if quantity == Quantity::Peak { of_peak(outcome) } else { 0.0 }
}

/// What the peak is off by beside that which moves all numbers of a stack: it may be near the edge, or at a kink. In
/// the middle, which feels all flat punches alike, what they are off by in turns hardly counts.
fn of_peak(outcome: &Outcome) -> f64 {
    outcome.lost.map_or(0.0, |lost| lost.left.pressure + lost.at_kinks)
}

/// Errors, and those that differences between resolutions do not see: what the kernels prove of theirs, what a contact
/// misses of its load, and what a stack leaves out at all of them, which follows the tolerance.
pub(crate) fn with_the_rest(
    problem: &Problem,
    layer: &PreparedLayer,
    outcome: &Outcome,
    tolerance: f64,
    errors: Numbers,
) -> Numbers {
    let half_width = outcome.numbers.get(Quantity::HalfWidth).unwrap_or(0.0);
    let missed = outcome.size.map_or(0.0, |size| size.missed);
    let left_out = outcome.lost.map_or(0.0, |lost| lost.stacked.max(STACKED * tolerance));
    let missed = if missed > ROUNDING { missed } else { 0.0 };
    let of_kernels = layer.kernel_error(half_width).unwrap_or(0.0);
    let of_depth = layer.depth_error(half_width).unwrap_or(0.0);
    let mut of_load = of_kernels + missed;
    if problem.is_pressed_by_depth() {
        of_load += of_depth;
    }
    let rest = moves(outcome) * of_load + left_out + between_members(outcome);
    let mut errors = errors.plus(rest);
    errors.add(Quantity::Indentation, of_depth);
    let of_edge = layer.edge_error();
    if of_edge > 0.0 {
        errors.add(Quantity::StressIntensity, of_edge);
        errors.add(Quantity::EdgeRatio, of_edge);
    }
    let of_zone = of_kernels * (1.0 / share_in_shear(outcome) - 1.0);
    for quantity in Quantity::ALL.into_iter().filter(|quantity| quantity.is_of_shear()) {
        errors.add(quantity, of_zone);
    }
    errors.add(Quantity::Peak, of_peak(outcome));
    // These are beside the mean.
    errors.add(Quantity::Centre, rest * (1.0 / share_in_middle(outcome) - 1.0));
    share_zones(problem, &mut errors, &outcome.numbers);
    errors
}

/// Stick zone and slip zones make up the contact: what is wrong of the narrower is wrong of the wider, over its width.
fn share_zones(problem: &Problem, errors: &mut Numbers, numbers: &Numbers) {
    let parts = [Quantity::StickRatio, Quantity::OneMinusRatio];
    let [Some(stick), Some(slip)] = parts.map(|part| numbers.get(part)) else { return };
    let (narrow, wide, quotient) =
        if slip < stick { (parts[1], parts[0], slip / stick) } else { (parts[0], parts[1], stick / slip) };
    let Some(of_wide) = errors.get(narrow).map(|of_narrow| (quotient * of_narrow).max(SLIP_ROUNDING)) else { return };
    let of_contact = if problem.has_half_width() { 0.0 } else { errors.get(Quantity::HalfWidth).unwrap_or(0.0) };
    let half_width = (wide == Quantity::StickRatio).then_some((Quantity::StickHalfWidth, of_wide + of_contact));
    for (quantity, most) in [(wide, of_wide)].into_iter().chain(half_width) {
        if let Some(error) = errors.get(quantity) {
            errors.set(quantity, error.min(most));
        }
    }
}

/// The pressure in the middle over the mean, where it is the smaller: what moves all of the pressure moves it by so
/// much more.
pub(crate) fn share_in_middle(outcome: &Outcome) -> f64 {
    let numbers = &outcome.numbers;
    let share =
        numbers.get(Quantity::Centre).zip(numbers.get(Quantity::Mean)).map_or(1.0, |(centre, mean)| centre / mean);
    share.abs().clamp(f64::MIN_POSITIVE, 1.0)
}

/// What the number that feels it most may be off by because the kernels are, as far as that is proved.
pub(crate) fn of_kernels(layer: &PreparedLayer, outcome: &Outcome) -> f64 {
    let half_width = outcome.numbers.get(Quantity::HalfWidth).unwrap_or(0.0);
    let felt = (moves(outcome) / share_in_middle(outcome)).max(share_in_shear(outcome).recip());
    layer.kernel_error(half_width).unwrap_or(0.0) * felt
}

/// By how many times what the load is off by moves the numbers of the contact.
pub(crate) fn moves(outcome: &Outcome) -> f64 {
    outcome.size.map_or(1.0, |size| size.moves())
}

/// By how much less than all of the pressure moves a stick zone, or what drives it, 1 at most: what moves the pressure
/// moves the zone by so much more.
///
/// In the stick zone `beta p`, less what the kernel of the coupling makes of `p`, drives the shear. A half-plane's of
/// that strength has the friction `eta = f beta`, `f = K(k)/K(k')`. Where what is left is little, as on a thick, nearly
/// incompressible layer over a base that gives way, errors of the kernels are much beside it. And where the zone is
/// narrow, or the slip zone is, it goes with `exp(-pi/(2 f))` or `exp(-pi f/2)`. A narrow one feels what the kernel of
/// the coupling is off by so much more, however strong it is: `pi/(2 f)` times.
pub(crate) fn share_in_shear(outcome: &Outcome) -> f64 {
    let Some(rubbing) = &outcome.rubbing else { return 1.0 };
    let Some(ShearTrace { friction, .. }) = rubbing.shear else { return 1.0 };
    let of_unit = HalfPlaneShear::new(rubbing.zone).friction(1.0);
    let driven = friction.abs() / (DRIVEN * (of_unit * of_unit).max(0.5));
    let share = driven.min(FRAC_2_PI * of_unit);
    if share > 0.0 { share.min(1.0) } else { 1.0 }
}

/// Errors of a stick zone that is only bounded, however close the bound is, in a contact as uncertain as that; `None`
/// where it is found, or nothing is.
fn bound_of_stick(outcome: &Outcome, of_contact: f64) -> Option<Numbers> {
    let rubbing = outcome.rubbing.as_ref()?;
    let (ratio, one_minus) = (rubbing.zone.ratio(), rubbing.zone.one_minus_ratio());
    let (of_ratio, of_gap) = match rubbing.verdict {
        Verdict::TooNarrow => (1.0, ratio / one_minus),
        Verdict::NoShear => (0.0, 0.0),
        // There is none beside it.
        _ if rubbing.is_full => (one_minus / ratio, one_minus / ratio),
        _ => return None,
    };
    let mut errors = Numbers::default();
    errors.set(Quantity::StickHalfWidth, of_ratio + of_contact);
    errors.set(Quantity::StickRatio, of_ratio);
    errors.set(Quantity::OneMinusRatio, of_gap);
    Some(errors)
}
