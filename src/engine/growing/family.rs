//! The flat punches of one layer, over all half-widths up to some widest: what every growing contact is a stack of.
//!
//! All that a flat punch answers varies smoothly with its half-width; it is solved at a few and told in between.

mod approach;
mod depths;
mod members;
mod pressed;
mod rubbed;
mod stacked;
mod told;

use super::blend::{Blend, Term};
use super::sheet::END;
use crate::engine::contact::Contact;
use crate::engine::foreign;
use crate::engine::friction::rubbing::Rubbing;
use crate::engine::friction::stick_search::{FrictionCurve, Root};
use crate::engine::friction::stick_zone::StickZone;
use crate::engine::numerics::dense::Dense;
use crate::engine::numerics::lanes::Lanes;
use crate::engine::numerics::root::between;
use crate::engine::outcome::{Left, Task};
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::pressure::half_plane_depth::HalfPlaneDepth;
use crate::engine::problem::Problem;
use crate::engine::work::Work;
use crate::engine::work::budget::Meter;
use depths::Depths;
use pressed::Pressed;
use rubbed::{Moves, PARTS, Rubbed, Seen};
use slipzone_api::double_exponential::Node;
use slipzone_api::{Component, Edge, FlatFace, Parity, Quadrature, Refusal, Rule, Station, root, short};
use std::ops::{Range, RangeInclusive};
use std::sync::Arc;
use told::Told;

pub(crate) use stacked::Slice;

/// Members of the coarsest family: this many, more for each unknown of the pressure, and by this share more for each
/// doubling of the widest half-width beyond the layer's length.
const FEWEST_MEMBERS: f64 = 5.0;
const MEMBERS_PER_UNKNOWN: f64 = 0.6;
const MORE_PER_OCTAVE: f64 = 0.5;

/// What is not analytic in the half-width where it begins with 0, of the pressure and of the shear.
///
/// Measured on the stick zone of a layer five times as thick as the contact is wide, told by 24 members: 1.4e-5 with
/// the first term, 3e-7 with the first two, 1e-8 with three; on the depth 1.4e-10 with one and 4e-13 with two.
pub(crate) const OF_PRESSURE: &[Term] = &[(2, 1), (3, 1)];
pub(crate) const OF_SHEAR: &[Term] = &[(1, 1), (2, 1), (2, 2)];
/// What the series of the pressure may leave, over the tolerance, of a force and of a pressure that is stacked, and
/// those of the shear.
const LEFT_OF_FORCE: f64 = 0.1;
const LEFT_OF_PRESSURE: f64 = 0.3;
const LEFT_OF_SHEAR: f64 = 1.0;
/// A face narrower than that, over the widest half-width, is none to the members: they begin with a point, and tell the
/// logarithms with which a layer begins to be felt. Polynomials from the face on do not.
///
/// Measured on random curves under rounded flat punches, most without friction: with polynomials alone loads on the way
/// were off by up to 21 estimates on 100 of 507 with faces of 1e-4 to 0.1 of the last contact, and so they were by up
/// to 3 on 32 of 687 with faces of 0.01 to 0.03; on none of these so, in half of the work. With faces of 0.03 to 0.25
/// none of 514 was.
const SMALL_FACE: f64 = 3e-2;
/// The widest half-width that the members begin with, over that with which they end.
const LARGEST_FACE: f64 = 0.9999;
/// Laws that begin with a higher power of the depth, no whole number, are told by the terms of smooth ones.
const OF_BREAK: f64 = 2.0;
/// Doubt of a slope that a coarser resolution tells; see [`crate::engine::numerics::root::Near`].
const SLOPE_DOUBT: f64 = 0.005;
/// What is left of a force changes its sign from member to member: its growth, of which a pressure is stacked, is off
/// by as much for each member, and more near the edge, where members crowd.
///
/// Measured under `|x|^2.5` on a stiff skin 33 times thinner than the contact is wide, with 56 members: the force off
/// by 6e-4, the pressure by 2e-3 at a tenth of the half-width and by 6e-2 at its peak beside the edge; so told, peaks
/// there are off by up to half of it.
const STEEP: f64 = 2.0;
/// Of so many points one is checked against the conditions of friction.
const CHECKED: usize = 4;

/// Flat punches that carry a unit force each, at one resolution, in layer units.
pub(crate) struct Family {
    friction: Option<f64>,
    /// Whether the depths of its members are known, where the base defines them.
    is_deep: bool,
    accuracy: f64,
    /// Kernel lengths in its widest half-width.
    kernel_lengths: f64,
    pressed: Pressed,
    on_half_plane: HalfPlaneDepth,
    /// Where a datum is what depths are counted from.
    depths: Option<Depths>,
    /// Where the places end at which shears are told.
    end_of_shear: f64,
    /// The face by which it was chosen how its members slip, where they could have slipped otherwise.
    slips_by_face: Option<f64>,
    /// What friction makes of it.
    rubbed: Option<Rubbed>,
    /// Rules and room of the flat punch, and of `W`.
    contact: Contact,
    rule: Box<dyn Rule>,
    system: Dense,
    room: Room,
    meter: Arc<Meter>,
}

/// Room for one member.
#[derive(Default)]
struct Room {
    functions: Vec<f64>,
    density: Vec<f64>,
    side_by_side: Vec<Lanes>,
    polynomials: Vec<Lanes>,
}

/// Members of the coarsest family.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few dozen
fn first_members(unknowns: usize, kernel_lengths: f64) -> usize {
    let octaves = kernel_lengths.max(1.0).log2();
    ((FEWEST_MEMBERS + MEMBERS_PER_UNKNOWN * unknowns as f64) * (1.0 + MORE_PER_OCTAVE * octaves)) as usize
}

/// What tells functions of the half-width between so many members: by series in `b` with these terms beside them, or,
/// where the law begins with a power `p` of the depth that is no whole number, in a root of `b` in which `b^p` is
/// nearly a polynomial.
fn blend(problem: &Problem, ends: (f64, f64), members: usize, terms: &[Term]) -> Result<Blend, Refusal> {
    /// Roots tried for a power that is exactly as smooth as it may be; else one in which it is as smooth as that.
    const ROOTS: RangeInclusive<u32> = 6..=12;
    const EXACT: f64 = 1e-9;
    const POWER: f64 = 3.0;
    const MOST: f64 = 12.0;
    let Some(power) = problem.layer.law.broken_power().filter(|power| *power < OF_BREAK) else {
        return Blend::new(ends, members, terms);
    };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // positive and small
    let root = root::whole(power, ROOTS, EXACT).unwrap_or_else(|| (POWER / power).ceil().clamp(2.0, MOST) as u32);
    Blend::in_root(ends, root, members)
}

/// A flat punch of that half-width.
fn member(problem: &Problem, half_width: f64, friction: bool) -> Problem {
    let face = Box::new(FlatFace { half_width: half_width * problem.length });
    if friction { problem.under(face) } else { problem.dry(face) }
}

/// A failure with its place in the history.
pub(crate) fn during(problem: &Problem, half_width: f64, what: &str) -> String {
    format!("while the contact grew, at a half-width of {}: {what}", short(half_width * problem.length))
}

/// What is said of a contact whose stick zone begins as all of it.
const STUCK_BEFORE: &str =
    "about up to there the whole contact sticks, beyond it the edges slip: this sequence is not implemented";
/// And where it is the other way about.
const STUCK_AFTER: &str =
    "about from there on the whole contact sticks, before it the edges slip: this sequence is not implemented";
/// Where what has slipped would stick again, and what sticks slip.
pub(crate) const SHRINKS: &str = "the stick zone shrinks";

/// Why a family ends before its widest member.
#[derive(Clone, Debug)]
pub(crate) enum Unfit {
    /// A method's limit.
    Refused(Refusal),
    /// No single stick zone under one of its members: its half-width, and what is reported of it.
    Friction(f64, Box<Rubbing>),
}

impl From<Refusal> for Unfit {
    fn from(refusal: Refusal) -> Self {
        Self::Refused(refusal)
    }
}

impl Family {
    /// Solves the members up to a widest half-width for a contact that is nearly as wide, with friction or without;
    /// `coarse` is the family of a coarser resolution.
    pub(crate) fn new(
        layer: &mut PreparedLayer,
        task: Task,
        quadrature: &dyn Quadrature,
        (contact, widest): (f64, f64),
        friction: bool,
        coarse: Option<&Family>,
    ) -> Result<Self, Unfit> {
        let flat = member(task.problem, widest, friction);
        let rule = foreign::rule(quadrature, Parity::Odd, Edge::Sharp)?;
        let n = rule.unknowns();
        layer.tabulate(widest, task.wanted)?;
        // A contact is never narrower than the face, and under narrower flat punches friction may fail.
        let face = task.problem.face();
        let ends = (if face < SMALL_FACE * widest { 0.0 } else { face.min(LARGEST_FACE * widest) }, widest);
        let kernel_lengths = widest / layer.length();
        let members = |told: Option<Told>, left: f64| {
            told.map_or_else(|| first_members(n, kernel_lengths), |told| told.enough(left * task.tolerance))
        };
        let told = coarse.map(|coarse| coarse.pressed.told);
        // If not this punch, another may ask for its pressure.
        let of_pressure = told.map_or(f64::INFINITY, |told| LEFT_OF_PRESSURE / (STEEP * told.members() as f64));
        let pressed = members(told, LEFT_OF_FORCE.min(of_pressure));
        let mut family = Self {
            friction: flat.friction,
            is_deep: task.problem.wants_depth(),
            accuracy: task.wanted.accuracy,
            kernel_lengths,
            pressed: Pressed::new(blend(task.problem, ends, pressed, OF_PRESSURE)?),
            on_half_plane: HalfPlaneDepth::new(task.problem.layer.datum, task.problem.elastic.beta()),
            depths: None,
            end_of_shear: END,
            slips_by_face: coarse.and_then(|coarse| coarse.slips_by_face),
            rubbed: None,
            contact: Contact::new(&flat, quadrature.refined(0))?,
            rule,
            system: Dense::new(n, 1),
            room: Room::default(),
            meter: Arc::clone(layer.meter()),
        };
        family.contact.bears_own_shear(false);
        // What a coarser resolution found to hold is not looked at again, and nor is how the face slides.
        family.contact.branch = coarse.map_or(1.0, |coarse| coarse.contact.branch);
        family.contact.is_overloaded = coarse.is_some_and(Family::is_overloaded);
        if friction {
            let rubbed = members(coarse.and_then(|coarse| Some(coarse.rubbed.as_ref()?.told)), LEFT_OF_SHEAR);
            let blend = blend(task.problem, ends, rubbed, OF_SHEAR)?;
            family.solve_under_friction(layer, task, contact, (blend, coarse))?;
        } else {
            family.solve_pressures(layer, task, coarse)?;
        }
        // A half-plane has none beyond its own.
        let has_depths = family.is_deep && layer.kernel(Component::Depth).is_some();
        if let Some(datum) = task.problem.layer.datum.filter(|_| has_depths) {
            family.depths = Some(family.against_datum(layer, task, ends, datum)?);
        }
        Ok(family)
    }

    /// Whether it is what a task asks for.
    pub(crate) fn serves(&self, task: Task, friction: bool, half_width: f64) -> bool {
        let asked = task.problem.friction.filter(|_| friction);
        self.friction.map(f64::to_bits) == asked.map(f64::to_bits)
            && (self.is_deep || !task.problem.wants_depth())
            && self.accuracy <= task.wanted.accuracy
            && self.pressed.blend.narrowest() <= task.problem.face()
            && self.slips_by_face.is_none_or(|face| face.to_bits() == task.problem.face().to_bits())
            && (self.widest() / 4.0..=self.widest()).contains(&half_width)
    }

    pub(crate) fn widest(&self) -> f64 {
        self.pressed.blend.widest()
    }

    /// The first half-width that a contact grows through beyond which the stick zone shrinks: from one member to the
    /// next by more than rounding, between them, and up to the last contact, by more than is not known of it, too.
    pub(crate) fn shrinks(&self, through: Range<f64>, rounding: f64) -> Option<f64> {
        let rubbed = self.rubbed.as_ref()?;
        let zones = &rubbed.zones;
        let shrinks = |wide: &Seen, narrow: &Seen| {
            let is_within = through.contains(&narrow.half_width) && wide.half_width <= through.end;
            is_within && wide.shrinks_from(narrow).start > rounding
        };
        let first = |step: usize| {
            let mut wide = (0..zones.len().saturating_sub(step)).step_by(step).rev();
            wide.find(|k| shrinks(&zones[*k], &zones[k + step])).map(|k| (k + step, step))
        };
        // The last before it shrinks, and how many places its neighbours are away: members, or what is between.
        if let Some((top, step)) = [PARTS, 1].into_iter().filter_map(first).max_by_key(|(top, _)| *top) {
            let narrower = zones.get(top + step).filter(|narrower| narrower.half_width >= through.start);
            return Some(narrower.map_or(zones[top].half_width, |narrower| {
                rubbed.widest_zone([narrower, &zones[top], &zones[top - step]]).half_width
            }));
        }
        let last = rubbed.seen(through.end.min(self.widest()));
        let before = &zones[zones.partition_point(|seen| seen.half_width >= last.half_width)..];
        let [top, narrower, ..] = before else { return None };
        let widest = rubbed.widest_zone([narrower, top, &last]);
        shrinks(&last, &widest).then_some(widest.half_width)
    }

    /// The stick zone of a contact of that half-width, as told between the members; `None` without friction.
    pub(crate) fn rubbing_between(&self, problem: &Problem, b: f64) -> Option<Rubbing> {
        let root = self.root_at(b)?;
        if root.lambda <= FrictionCurve::WIDEST {
            return Some(Rubbing::expected(root, b, self.is_checked()));
        }
        let stuck = Rubbing::sticking(b, self.is_checked());
        Some(match self.comes_off(b) {
            None => stuck,
            Some(at) => stuck.unbuilt(during(problem, at, STUCK_BEFORE)),
        })
    }

    /// The half-width from which on a contact that grows to another no longer sticks as a whole, though all members do.
    fn comes_off(&self, b: f64) -> Option<f64> {
        let (rubbed, friction) = (self.rubbed.as_ref()?, self.friction?);
        // How wide a zone is that all is in tells by how much friction is more than it takes, of either sign.
        let spare = |b: f64| {
            let root = rubbed.root_at(b, 0.0);
            2.0 * friction - (root.lambda - FrictionCurve::WIDEST) * root.slope
        };
        let b = b.min(self.widest());
        (spare(b) < 0.0).then(|| between((rubbed.blend.narrowest(), b), f64::EPSILON * b, spare).unwrap_or(b))
    }

    /// What its series leave.
    pub(crate) fn left(&self) -> Left {
        let told = self.pressed.told;
        Left {
            force: told.left(),
            pressure: STEEP * told.members() as f64 * told.left(),
            shear: self.rubbed.as_ref().map_or(0.0, |rubbed| rubbed.told.left()),
        }
    }

    /// Work in its systems so far.
    pub(crate) fn work(&self) -> Work {
        self.contact.work() + self.system.work
    }

    /// In this root of the half-width its pressures are smooth.
    pub(crate) fn root(&self) -> u32 {
        self.pressed.blend.root()
    }

    /// Kernel lengths in its widest half-width.
    pub(crate) fn kernel_lengths(&self) -> f64 {
        self.kernel_lengths
    }

    /// Unknowns of a member's pressure.
    pub(crate) fn unknowns(&self) -> usize {
        self.contact.normal.size()
    }

    /// The stick zone to be expected under a member. Beyond the widest nothing is told but its own, below the narrowest
    /// nothing.
    fn root_at(&self, b: f64) -> Option<Root> {
        if b < self.pressed.blend.narrowest() {
            return None;
        }
        let (within, doubt) = if b > self.widest() { (self.widest(), f64::INFINITY) } else { (b, SLOPE_DOUBT) };
        Some(self.rubbed.as_ref()?.root_at(within, doubt))
    }

    /// By how much its shear is known to move with the stick zone.
    fn moves(&self) -> Option<Arc<Moves>> {
        self.rubbed.as_ref()?.moves.clone()
    }

    /// The stick zone of a member.
    pub(crate) fn zone(&self, b: f64) -> StickZone {
        let rubbed = self.rubbed.as_ref().expect("a family with friction");
        StickZone::from_log(rubbed.lambda_at(b).min(FrictionCurve::WIDEST), b)
    }

    /// Friction coefficient, negative where the slip is outward.
    pub(crate) fn signed_friction(&self) -> f64 {
        self.rubbed.as_ref().map_or(0.0, |rubbed| rubbed.branch) * self.friction.unwrap_or(0.0)
    }

    /// The coefficient of what its shears are told to lack, of the same sign: none where all of it sticks at all
    /// half-widths.
    pub(crate) fn lacking_to(&self) -> f64 {
        if self.rubbed.as_ref().is_some_and(|rubbed| rubbed.sticks) { 0.0 } else { self.signed_friction() }
    }

    /// Whether friction does not bear one of its members by itself.
    pub(crate) fn is_overloaded(&self) -> bool {
        self.contact.is_overloaded
    }

    /// Half-widths at which a contact that grew so wide is looked at.
    pub(crate) fn looked_at(&self, half_width: f64) -> Vec<f64> {
        let all = self.half_widths_to(half_width);
        [half_width].into_iter().chain(all[1..].iter().copied().step_by(CHECKED)).collect()
    }

    /// One, and those of all narrower members.
    pub(crate) fn half_widths_to(&self, half_width: f64) -> Vec<f64> {
        let blend = self.rubbed.as_ref().map_or(&self.pressed.blend, |rubbed| &rubbed.blend);
        let narrower = blend.half_widths().iter().copied().filter(|b| *b < half_width);
        [half_width].into_iter().chain(narrower).collect()
    }

    /// Whether the conditions of friction were found to hold under its members.
    pub(crate) fn is_checked(&self) -> bool {
        self.rubbed.as_ref().is_none_or(|rubbed| rubbed.checked)
    }

    /// Depth of a member over `A0`.
    pub(crate) fn depth(&self, b: f64) -> f64 {
        let beyond = match &self.depths {
            Some(depths) => depths.at(b),
            None => self.pressed.blend.sum(b, &self.pressed.depth),
        };
        beyond + self.on_half_plane.at(b)
    }

    /// `W` of a member at points within it.
    pub(crate) fn tilt_into(&mut self, b: f64, at: &[Station], out: &mut [f64]) {
        self.count(self.pressed.tilt.width, at.len());
        let unknowns = self.pressed.tilt(b, &mut self.room);
        self.rule.stretch(b);
        self.rule.values_into(unknowns, at, out);
    }

    /// `W` of a member at the nodes of a grid over its right half.
    pub(crate) fn tilt_over(&mut self, b: f64, grid: &Arc<Vec<Node>>, out: &mut Vec<f64>) {
        self.meter.count_multiplications(self.pressed.blend.functions() * grid.len());
        self.pressed.tilt_over(b, grid, &mut *self.rule, &mut self.room.functions, out);
    }

    /// Pressure of a member at points within it.
    pub(crate) fn pressure_into(&mut self, b: f64, at: &[Station], out: &mut [f64]) {
        self.count(self.pressed.pressure.width, at.len());
        self.contact.normal.values_of(b, self.pressed.pressure(b, &mut self.room), at, out);
        for p in out {
            *p /= b;
        }
    }

    /// Takes note of a member that is blended and told at so many points.
    fn count(&self, width: usize, points: usize) {
        let members = self.pressed.blend.half_widths().len();
        self.meter.count_multiplications(members * width + points * width);
    }

    /// Refuses to go on where the budget is used up.
    pub(crate) fn within_budget(&self) -> Result<(), Refusal> {
        self.meter.within()
    }
}
