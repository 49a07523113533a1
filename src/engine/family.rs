//! The flat punches of one layer, over all half-widths up to some widest: what every growing contact is a stack of.
//!
//! All that a flat punch answers varies smoothly with its half-width; it is solved at a few and told in between.

use super::blend::{Blend, Term, add_rows};
use super::budget::Meter;
use super::dense::Dense;
use super::layer::{Layer, Wanted};
use super::problem::Problem;
use super::stage::{Outcome, Rubbing, Stage, Task, Verdict};
use super::stick_search::Root;
use super::stick_zone::StickZone;
use super::work::Work;
use slipzone_api::{Component, Density, Edge, FlatFace, Parity, Quadrature, Refusal, Rule, Span, Station};
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::Arc;

/// Points: at least, and more per unknown of the pressure; so many times more for each doubling of the widest half-width
/// beyond the layer's length.
const POINTS: (f64, f64, f64) = (5.0, 0.6, 0.5);
/// What is not analytic in the half-width where it begins with 0, of the pressure and of the shear.
///
/// Measured on the stick zone of a layer five times as thick as the contact is wide, told by 24 members: 1.4e-5 with the first
/// term, 3e-7 with the first two, 1e-8 with three; on the depth 1.4e-10 with one and 4e-13 with two.
pub(super) const OF_PRESSURE: &[Term] = &[(2, 1), (3, 1)];
pub(super) const OF_SHEAR: &[Term] = &[(1, 1), (2, 1), (2, 2)];
/// Doubt of a slope that a coarser resolution tells; see [`super::root::Near`].
const SLOPE_DOUBT: f64 = 0.005;
/// Error of the members' stick zones over the tolerance.
const REFINED: f64 = 0.1;
/// Of so many points one is checked against the conditions of friction.
const CHECKED: usize = 4;

/// Flat punches that carry a unit force each, at one resolution, in layer units.
pub(crate) struct Family {
    friction: Option<f64>,
    /// Whether the depths of its members are known, where the base defines them.
    is_deep: bool,
    accuracy: f64,
    /// For what the pressure tells, and for what the shear tells.
    blend: Blend,
    of_shear: Blend,
    /// Pressures, times the half-width.
    pressure: Table,
    /// Odd densities `W` with `int W(r)/(x - r) dr/pi + ... = -1`: a punch of slope `g'` carries `int W g' dx/A0`.
    tilt: Table,
    /// Depth, `ln(b')/pi` added.
    depth: Vec<f64>,
    /// What friction makes of it.
    rubbed: Option<Rubbed>,
    /// Rules and room of the flat punch.
    stage: Box<Stage>,
    rule: Box<dyn Rule>,
    system: Dense,
    room: Room,
    meter: Arc<Meter>,
}

/// The stick zones of a family.
struct Rubbed {
    /// `ln(a/(b' - a))`, and the slope of the friction coefficient over it.
    lambda: Vec<f64>,
    slope: Vec<f64>,
    /// `+1` where the slip is inward, `-1` where it is outward.
    branch: f64,
    /// Shear in the stick zone, times the half-width; its value at the end is the last number.
    shear: Table,
    /// Whether the conditions of friction were found to hold.
    checked: bool,
}

impl Rubbed {
    /// The stick zone to be expected next, from the last two.
    fn continued(&self, half_widths: &[f64], b: f64) -> Option<Rubbing> {
        let ([.., b2, b1], [.., l2, l1]) = (half_widths, self.lambda.as_slice()) else { return None };
        let lambda = l1 + (l1 - l2) / (b1 - b2) * (b - b1);
        let root = Root { lambda, branch: self.branch, slope: *self.slope.last()?, doubt: f64::INFINITY };
        Some(Rubbing::expected(root, b, true))
    }
}

/// A few numbers at each point of a family.
#[derive(Default)]
struct Table {
    width: usize,
    numbers: Vec<f64>,
}

impl Table {
    fn push(&mut self, row: impl Iterator<Item = f64>) {
        let before = self.numbers.len();
        self.numbers.extend(row);
        self.width = self.numbers.len() - before;
    }

    /// The row between the points.
    fn blend_into(&self, shares: &[f64], out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.width, 0.0);
        add_rows(shares, &self.numbers, out);
    }
}

/// Room for one member.
#[derive(Default)]
struct Room {
    shares: Vec<f64>,
    pressure: Vec<f64>,
    tilt: Vec<f64>,
    shear: Vec<f64>,
}

/// A flat punch of that half-width.
fn member(problem: &Problem, half_width: f64, friction: bool) -> Problem {
    let face = Box::new(FlatFace { half_width: half_width * problem.length });
    if friction { problem.under(face) } else { problem.dry(face) }
}

/// A failure with its place in the history.
pub(crate) fn during(problem: &Problem, half_width: f64, what: &str) -> String {
    format!("while the contact grew, at a half-width of {:.6}: {what}", half_width * problem.length)
}

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
        layer: &mut Layer,
        task: Task,
        quadrature: &dyn Quadrature,
        (contact, widest): (f64, f64),
        friction: bool,
        mut coarse: Option<&mut Family>,
    ) -> Result<Self, Unfit> {
        let flat = member(task.problem, widest, friction);
        let rule = quadrature.rule(&Span::symmetric(1.0, Parity::Odd, Edge::Sharp))?;
        let n = rule.unknowns();
        layer.tabulate(Wanted { half_width: widest, ..task.wanted })?;
        // A contact is never narrower than the face.
        let face = task.problem.face().min(0.5 * widest);
        let octaves = (widest / layer.length()).max(1.0).log2();
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few dozen
        let count = ((POINTS.0 + POINTS.1 * n as f64) * (1.0 + POINTS.2 * octaves)) as usize;
        let mut family = Self {
            friction: flat.friction,
            is_deep: task.problem.wants_depth(),
            accuracy: task.wanted.accuracy,
            blend: Blend::new((face, widest), count, OF_PRESSURE)?,
            of_shear: Blend::new((face, widest), count, OF_SHEAR)?,
            pressure: Table::default(),
            tilt: Table::default(),
            depth: Vec::new(),
            rubbed: None,
            stage: Box::new(Stage::new(&flat, quadrature.refined(0))?),
            rule,
            system: Dense::new(n, 1),
            room: Room::default(),
            meter: Arc::clone(layer.meter()),
        };
        // Finer grids of the stick zone where one member needs them.
        while !family.solve(layer, task, contact, coarse.as_deref_mut())? {}
        Ok(family)
    }

    /// Whether it is what a task asks for.
    pub(crate) fn serves(&self, task: Task, friction: bool, half_width: f64) -> bool {
        let asked = task.problem.friction.filter(|_| friction);
        self.friction.map(f64::to_bits) == asked.map(f64::to_bits)
            && (self.is_deep || !task.problem.wants_depth())
            && self.accuracy <= task.wanted.accuracy
            && self.blend.narrowest() <= task.problem.face()
            && (self.blend.widest() / 4.0..=self.blend.widest()).contains(&half_width)
    }

    pub(crate) fn widest(&self) -> f64 {
        self.blend.widest()
    }

    /// Solves all members. Returns false where one of them needed a finer grid than the others: between different grids
    /// nothing can be interpolated.
    fn solve(
        &mut self,
        layer: &mut Layer,
        task: Task,
        contact: f64,
        mut coarse: Option<&mut Family>,
    ) -> Result<bool, Unfit> {
        self.pressure = Table::default();
        self.tilt = Table::default();
        self.depth.clear();
        let half_widths = self.blend.half_widths().to_vec();
        let mut before: Option<Rubbing> = None;
        if self.friction.is_some() && coarse.as_ref().is_none_or(|coarse| coarse.rubbed.is_none()) {
            // The contact itself, by a search of its own: the others follow.
            let flat = member(task.problem, contact, true);
            let outcome = self.stage.solve(layer, Task { problem: &flat, ..task }, None, None)?;
            let found = outcome.rubbing.as_ref().expect("a stick zone, or why there is none");
            if found.reported().is_none() {
                return Err(Unfit::Friction(contact, Box::new(found.clone())));
            }
            before = outcome.rubbing;
        }
        // What a coarser resolution found to hold is not checked again; without one, nothing is known well enough.
        let (is_first, known) = (coarse.is_none(), coarse.as_ref().is_some_and(|coarse| coarse.is_checked()));
        let count = half_widths.len();
        let mut rubbed = Rubbed {
            lambda: Vec::with_capacity(count),
            slope: Vec::with_capacity(count),
            branch: 1.0,
            shear: Table::default(),
            checked: !is_first,
        };
        for (k, b) in half_widths.iter().copied().enumerate() {
            let flat = member(task.problem, b, self.friction.is_some());
            let task = Task { problem: &flat, ..task };
            let asked = !is_first && !known && k % CHECKED == 0;
            let start = match coarse.as_mut().and_then(|coarse| coarse.rubbing_at(b, !asked)) {
                Some(predicted) => Some(predicted),
                None => rubbed.continued(&half_widths[..k], b).or(before.take()),
            };
            let root = if self.friction.is_some() {
                match self.solve_member(layer, task, b, start, asked)? {
                    Ok((root, checked)) => {
                        rubbed.checked &= checked || !asked;
                        Some(root)
                    }
                    Err(found) => return Err(Unfit::Friction(b, found)),
                }
            } else {
                self.stage.press(layer, task, b)?;
                None
            };
            let normal = &self.stage.normal;
            self.pressure.push(normal.unknowns().iter().map(|p| p * b));
            self.tilted(layer, b)?;
            let depth = self.stage.normal.depth(layer, &flat);
            self.depth.push(depth.map_or(0.0, |depth| depth / flat.elastic.a0() + b.ln() / PI));
            let Some(root) = root else { continue };
            if k == 0 {
                rubbed.branch = root.branch;
            } else if rubbed.branch.to_bits() != root.branch.to_bits() {
                let turned = "the direction of slip turns while the contact grows".into();
                return Err(Unfit::Friction(b, Box::new(Rubbing::expected(root, b, false).failing(turned))));
            }
            let shear = self.stage.shear.as_mut().expect("friction has shear");
            let grid = shear.grid();
            if k > 0 && grid > shear.insisted() {
                shear.insist_on(grid);
                return Ok(false);
            }
            shear.insist_on(grid);
            rubbed.lambda.push(root.lambda);
            rubbed.slope.push(root.slope);
            rubbed.shear.push(shear.unknowns().iter().copied().chain([shear.at_edge]).map(|q| q * b));
        }
        self.rubbed = self.friction.map(|_| rubbed);
        Ok(true)
    }

    /// Solves one member under friction from a guess of its stick zone, and leaves its pressure and shear in the stage: its
    /// root, and whether the conditions of friction were found to hold; or else what is to be said of it.
    fn solve_member(
        &mut self,
        layer: &mut Layer,
        task: Task,
        b: f64,
        start: Option<Rubbing>,
        asked: bool,
    ) -> Result<Result<(Root, bool), Box<Rubbing>>, Refusal> {
        let error = REFINED * task.tolerance;
        if let Some(guess) = start.as_ref().and_then(Rubbing::reported).filter(|_| !asked)
            && let Some(root) = self.stage.follow(layer, task, b, guess, error)?
        {
            return Ok(Ok((root, false)));
        }
        let start = start.map(Outcome::of_rubbing);
        let outcome = self.stage.solve(layer, task, start.as_ref(), None)?;
        let found = outcome.rubbing.expect("a stick zone, or why there is none");
        let Some(root) = found.reported() else { return Ok(Err(Box::new(found))) };
        let root = self.stage.follow(layer, task, b, root, error)?.unwrap_or(root);
        Ok(Ok((root, found.is_checked())))
    }

    /// Checks the conditions of friction under some of the members up to a half-width; what the first that fails one
    /// fails.
    pub(crate) fn check(&mut self, layer: &mut Layer, task: Task, half_width: f64) -> Result<Option<String>, Refusal> {
        let half_widths = self.blend.half_widths().to_vec();
        for b in [half_width].into_iter().chain(half_widths.into_iter().filter(|b| *b < half_width).step_by(CHECKED)) {
            let flat = member(task.problem, b, true);
            let task = Task { problem: &flat, ..task };
            let start = self.rubbing_at(b, false).map(Outcome::of_rubbing);
            let mut outcome = self.stage.solve(layer, task, start.as_ref(), None)?;
            self.stage.settle(layer, task, &mut outcome)?;
            let found = outcome.rubbing.as_ref().expect("a stick zone, or why there is none");
            match &found.verdict {
                Verdict::Holds => {}
                Verdict::Fails(what) => return Ok(Some(during(task.problem, b, what))),
                _ => return Ok(Some(during(task.problem, b, "no stick zone belongs to this friction coefficient"))),
            }
        }
        if let Some(rubbed) = &mut self.rubbed {
            rubbed.checked = true;
        }
        Ok(None)
    }

    /// The widest of the half-widths that a contact grows through beyond which the stick zone shrinks, by more than rounding.
    pub(crate) fn shrinks(&self, through: Range<f64>, rounding: f64) -> Option<f64> {
        let zones = self.blend.half_widths().iter().zip(&self.rubbed.as_ref()?.lambda);
        let zones: Vec<(f64, f64)> =
            zones.map(|(b, lambda)| (*b, StickZone::from_log(*lambda, *b).half_width)).collect();
        let shrinks = |pair: &&[(f64, f64)]| through.contains(&pair[1].0) && pair[0].1 < pair[1].1 * (1.0 - rounding);
        zones.windows(2).find(shrinks).map(|pair| pair[1].0)
    }

    /// The stick zone of a contact of that half-width, solved for itself: what is told between the members is but its
    /// beginning.
    pub(crate) fn rubbing(&mut self, layer: &mut Layer, task: Task, b: f64) -> Result<Option<Rubbing>, Refusal> {
        let checked = self.is_checked();
        let expected = self.rubbing_at(b, checked);
        let Some(guess) = expected.as_ref().and_then(Rubbing::reported) else { return Ok(expected) };
        let flat = member(task.problem, b, true);
        let root = self.stage.follow(layer, Task { problem: &flat, ..task }, b, guess, REFINED * task.tolerance)?;
        Ok(root.map(|root| Rubbing::expected(root, b, checked)).or(expected))
    }

    /// Work in its systems so far.
    pub(crate) fn work(&self) -> Work {
        self.stage.work() + self.system.work
    }

    /// Unknowns of a member's pressure.
    pub(crate) fn unknowns(&self) -> usize {
        self.stage.normal.size()
    }

    /// Solves for `W`.
    fn tilted(&mut self, layer: &Layer, b: f64) -> Result<(), Refusal> {
        layer.meter().system(self.rule.unknowns(), 1)?;
        let Self { rule, system, .. } = self;
        rule.stretch(b);
        system.solve(|rows, right| {
            rule.operator_into(layer.kernel(Component::NormalSlope), rows);
            match rule.row_scale() {
                Some(scale) => right.iter_mut().zip(scale).for_each(|(right, scale)| *right = -scale),
                None => right.fill(-1.0),
            }
            1
        })?;
        self.tilt.push(self.system.column(0).iter().copied());
        Ok(())
    }

    /// The stick zone to be expected under a member.
    fn rubbing_at(&mut self, b: f64, checked: bool) -> Option<Rubbing> {
        self.of_shear.shares_into(b, &mut self.room.shares);
        let rubbed = self.rubbed.as_ref()?;
        let blend = |numbers: &[f64]| self.room.shares.iter().zip(numbers).map(|(share, number)| share * number).sum();
        let root = Root {
            lambda: blend(&rubbed.lambda),
            branch: rubbed.branch,
            slope: blend(&rubbed.slope),
            doubt: SLOPE_DOUBT,
        };
        Some(Rubbing::expected(root, b, checked))
    }

    /// The stick zone of a member.
    pub(crate) fn zone(&mut self, b: f64) -> StickZone {
        let rubbed = self.rubbed.as_ref().expect("a family with friction");
        self.of_shear.shares_into(b, &mut self.room.shares);
        let lambda = self.room.shares.iter().zip(&rubbed.lambda).map(|(share, number)| share * number).sum();
        StickZone::from_log(lambda, b)
    }

    /// Friction coefficient, negative where the slip is outward.
    pub(crate) fn signed_friction(&self) -> f64 {
        self.rubbed.as_ref().map_or(0.0, |rubbed| rubbed.branch) * self.friction.unwrap_or(0.0)
    }

    /// Whether the conditions of friction were found to hold under its members.
    pub(crate) fn is_checked(&self) -> bool {
        self.rubbed.as_ref().is_none_or(|rubbed| rubbed.checked)
    }

    /// Depth of a member over `A0`.
    pub(crate) fn depth(&mut self, b: f64) -> f64 {
        self.blend.shares_into(b, &mut self.room.shares);
        let sum: f64 = self.room.shares.iter().zip(&self.depth).map(|(share, depth)| share * depth).sum();
        sum - b.ln() / PI
    }

    /// `W` of a member at points within it.
    pub(crate) fn tilt_into(&mut self, b: f64, at: &[Station], out: &mut [f64]) {
        self.count(self.tilt.width, at.len());
        self.blend.shares_into(b, &mut self.room.shares);
        self.tilt.blend_into(&self.room.shares, &mut self.room.tilt);
        self.rule.stretch(b);
        self.rule.values_into(Density { unknowns: &self.room.tilt, carrier: 0.0 }, at, out);
    }

    /// Pressure of a member at points within it.
    pub(crate) fn pressure_into(&mut self, b: f64, at: &[Station], out: &mut [f64]) {
        self.count(self.pressure.width, at.len());
        self.blend.shares_into(b, &mut self.room.shares);
        self.pressure.blend_into(&self.room.shares, &mut self.room.pressure);
        self.stage.normal.values_of(b, &self.room.pressure, at, out);
        for p in out {
            *p /= b;
        }
    }

    /// Takes note of a member that is blended and told at so many points.
    fn count(&self, width: usize, points: usize) {
        let members = self.blend.half_widths().len();
        self.meter.count_multiplications(members * (members + width) + points * width);
    }

    /// Refuses to go on where the budget is used up.
    pub(crate) fn within_budget(&self) -> Result<(), Refusal> {
        self.meter.within()
    }

    /// What the shear of a member lacks to that of full sliding, `eta p - q`, at a point within its stick zone.
    pub(crate) fn lack(&mut self, b: f64, x: f64) -> f64 {
        let members = self.of_shear.half_widths().len();
        self.meter.count_multiplications(members * members);
        self.of_shear.shares_into(b, &mut self.room.shares);
        let rubbed = self.rubbed.as_ref().expect("a family with friction");
        let blend = |numbers: &[f64]| self.room.shares.iter().zip(numbers).map(|(share, number)| share * number).sum();
        let zone = StickZone::from_log(blend(&rubbed.lambda), b);
        let gap = zone.half_width - x;
        if gap <= 0.0 {
            return 0.0;
        }
        self.meter.count_multiplications(members * rubbed.shear.width);
        rubbed.shear.blend_into(&self.room.shares, &mut self.room.shear);
        let (at_edge, unknowns) = self.room.shear.split_last().expect("the shear's end");
        let shear = self.stage.shear.as_mut().expect("friction has shear");
        let q = shear.value_of(zone, unknowns, *at_edge, Station { x, gap }) / b;
        let mut p = [0.0];
        self.pressure_into(b, &[Station { x, gap: gap + zone.slip_width }], &mut p);
        self.signed_friction() * p[0] - q
    }
}
