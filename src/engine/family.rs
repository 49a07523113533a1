//! The flat punches of one layer, over all half-widths up to some widest: what every growing contact is a stack of.
//!
//! All that a flat punch answers varies smoothly with its half-width; it is solved at a few and told in between.

mod rubbed;

use super::blend::{Blend, LANES, Lanes, Term, add_rows};
use super::budget::Meter;
use super::dense::Dense;
use super::layer::{Layer, Wanted};
use super::problem::Problem;
use super::sheet::{self, Places, Sheet};
use super::stack::Slice;
use super::stage::{Outcome, Rubbing, Stage, Task, Verdict};
use super::stick_search::Root;
use super::stick_zone::StickZone;
use super::work::Work;
use rubbed::{Approach, Found, Member, Moves, Rubbed};
use slipzone_api::double_exponential::Node;
use slipzone_api::{Component, Edge, FlatFace, Parity, Quadrature, Refusal, Rule, Span, Station};
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
/// A stick zone farther from the one expected is not near.
const NEAR: f64 = 0.3;
/// Error of the members' stick zones over the tolerance.
const REFINED: f64 = 0.1;
/// Places at which a member's pressure is looked at.
const LOOKED_AT: usize = 16;
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
    /// For what the pressure tells, and for what the shear tells.
    blend: Blend,
    of_shear: Arc<Blend>,
    /// Pressures, times the half-width.
    pressure: Table,
    /// The same times `sqrt(1 - (x/b')^2)` at any place; made when first asked for.
    pressure_at: Option<Sheet>,
    /// Odd densities `W` with `int W(r)/(x - r) dr/pi + ... = -1`: a punch of slope `g'` carries `int W g' dx/A0`.
    tilt: Table,
    /// The same at the nodes of a grid over half of the contact; made when first asked for.
    tilt_over: Option<(Arc<Vec<Node>>, Table)>,
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

/// A few numbers at each point of a family, and then as many for each function of the half-width.
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

    /// From what there is at each point to what there is of each function.
    fn blended(self, blend: &Blend) -> Self {
        Self { numbers: blend.coefficients(&self.numbers, self.width), ..self }
    }

    /// The row between the points.
    fn blend_into(&self, functions: &[f64], out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.width, 0.0);
        add_rows(functions, &self.numbers, out);
    }
}

/// Room for one member.
#[derive(Default)]
struct Room {
    functions: Vec<f64>,
    density: Vec<f64>,
    side_by_side: Vec<Lanes>,
    polynomials: Vec<Lanes>,
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
        coarse: Option<&Family>,
    ) -> Result<Self, Unfit> {
        let flat = member(task.problem, widest, friction);
        let rule = quadrature.rule(&Span::symmetric(1.0, Parity::Odd, Edge::Sharp))?;
        let n = rule.unknowns();
        layer.tabulate(Wanted { half_width: widest, ..task.wanted })?;
        // A contact is never narrower than the face.
        let face = task.problem.face().min(0.5 * widest);
        let kernel_lengths = widest / layer.length();
        let octaves = kernel_lengths.max(1.0).log2();
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few dozen
        let count = ((POINTS.0 + POINTS.1 * n as f64) * (1.0 + POINTS.2 * octaves)) as usize;
        let mut family = Self {
            friction: flat.friction,
            is_deep: task.problem.wants_depth(),
            accuracy: task.wanted.accuracy,
            kernel_lengths,
            blend: Blend::new((face, widest), count, OF_PRESSURE)?,
            of_shear: Arc::new(Blend::new((face, widest), count, OF_SHEAR)?),
            pressure: Table::default(),
            pressure_at: None,
            tilt: Table::default(),
            tilt_over: None,
            depth: Vec::new(),
            rubbed: None,
            stage: Box::new(Stage::new(&flat, quadrature.refined(0))?),
            rule,
            system: Dense::new(n, 1),
            room: Room::default(),
            meter: Arc::clone(layer.meter()),
        };
        family.stage.of_slices = true;
        // What a coarser resolution found to hold is not looked at again.
        family.stage.is_overloaded = coarse.is_some_and(Family::is_overloaded);
        family.solve(layer, task, contact, coarse)?;
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

    /// Solves all members.
    fn solve(&mut self, layer: &mut Layer, task: Task, contact: f64, coarse: Option<&Family>) -> Result<(), Unfit> {
        let half_widths = self.blend.half_widths().to_vec();
        let mut before: Option<Root> = None;
        let mut sticks = coarse.is_some_and(Family::sticks);
        if self.friction.is_some() && coarse.as_ref().is_none_or(|coarse| coarse.rubbed.is_none()) {
            // The contact itself, by a search of its own: the others follow.
            let flat = member(task.problem, contact, true);
            let outcome = self.stage.solve(layer, Task { problem: &flat, ..task }, None, None)?;
            let found = outcome.rubbing.as_ref().expect("a stick zone, or why there is none");
            before = found.reported();
            sticks = found.verdict == Verdict::Sticks;
            if before.is_none() && !sticks {
                return Err(Unfit::Friction(contact, Box::new(found.clone())));
            }
        }
        // What a coarser resolution found to hold is not checked again; without one, nothing is known well enough.
        let (is_first, known) = (coarse.is_none(), coarse.is_some_and(Family::is_checked));
        let mut found = Found::new(coarse.and_then(Family::moves), !is_first);
        for (k, b) in half_widths.iter().copied().enumerate() {
            let flat = member(task.problem, b, self.friction.is_some());
            let task = Task { problem: &flat, ..task };
            if self.friction.is_none() {
                self.stage.press(layer, task, b)?;
                self.keep_pressure(layer, &flat, b)?;
                continue;
            }
            let asked = !is_first && !known && k % CHECKED == 0;
            if sticks {
                let member = match self.stick_member(layer, task, b, asked) {
                    // At other times slip zones are seen beside the edge, just so: the contact's own is narrower.
                    Err(Unfit::Friction(_, why)) if why.verdict == Verdict::TooWide => {
                        return Err(Unfit::Friction(contact, Box::new(why.bounded(contact))));
                    }
                    member => member?,
                };
                self.keep_pressure(layer, &flat, b)?;
                found.add(member);
                continue;
            }
            let told = coarse.and_then(|coarse| coarse.root_at(b));
            let start = told.or_else(|| found.continued(&half_widths[..k], b)).or(before.take());
            let (member, checked) = match self.solve_member(layer, task, b, (start, asked), &mut found)? {
                Ok(solved) => solved,
                Err(why) => return Err(Unfit::Friction(b, why)),
            };
            found.checked &= checked || !asked;
            self.keep_pressure(layer, &flat, b)?;
            let root = member.root;
            if !found.add(member) {
                let turned = "the direction of slip turns while the contact grows".into();
                return Err(Unfit::Friction(b, Box::new(Rubbing::expected(root, b, false).failing(turned))));
            }
        }
        self.pressure = std::mem::take(&mut self.pressure).blended(&self.blend);
        self.tilt = std::mem::take(&mut self.tilt).blended(&self.blend);
        self.depth = self.blend.coefficients(&self.depth, 1);
        self.rubbed = self.friction.map(|_| found.blended(&self.of_shear));
        Ok(())
    }

    /// Keeps what the pressure of the member solved last tells.
    fn keep_pressure(&mut self, layer: &Layer, flat: &Problem, b: f64) -> Result<(), Refusal> {
        self.pressure.push(self.stage.normal.unknowns().iter().map(|p| p * b));
        self.tilted(layer, b)?;
        let depth = self.stage.normal.depth(layer, flat);
        self.depth.push(depth.map_or(0.0, |depth| depth / flat.elastic.a0() + b.ln() / PI));
        Ok(())
    }

    /// Solves one member under friction from a guess of its stick zone, and leaves its pressure in the stage: what is found,
    /// and whether the conditions of friction were found to hold where that is asked; or else what is to be said of it.
    fn solve_member(
        &mut self,
        layer: &mut Layer,
        task: Task,
        b: f64,
        (start, asked): (Option<Root>, bool),
        found: &mut Found,
    ) -> Result<Result<(Member, bool), Box<Rubbing>>, Refusal> {
        if let Some(guess) = start
            && let Some(member) = self.approach(layer, task, b, guess, found)?
        {
            let holds = asked && self.stage.holds(layer, task, guess.lambda, member.root.lambda)?;
            return Ok(Ok((member, holds)));
        }
        let start = start.map(|start| Outcome::of_rubbing(Rubbing::expected(start, b, !asked)));
        let outcome = self.stage.solve(layer, task, start.as_ref(), None)?;
        let rubbing = outcome.rubbing.expect("a stick zone, or why there is none");
        let Some(root) = rubbing.reported() else { return Ok(Err(Box::new(rubbing))) };
        let member = if let Some(member) = self.approach(layer, task, b, root, found)? {
            member
        } else {
            self.stage.curve(layer, task).at(root.lambda)?;
            Member { root, lack: Found::lack(&self.stage, b), moves: None, least: None }
        };
        Ok(Ok((member, rubbing.is_checked())))
    }

    /// Solves one member of which all shall stick, and leaves its pressure in the stage; the conditions of that are looked at where
    /// that is asked.
    fn stick_member(&mut self, layer: &mut Layer, task: Task, b: f64, asked: bool) -> Result<Member, Unfit> {
        self.stage.press(layer, task, b)?;
        let eta = task.problem.friction.expect("friction that sticks");
        let (lambda, least) = self.stage.stick(layer, task)?;
        let stuck = || Rubbing::sticking(b, lambda, asked);
        if least.abs() >= eta {
            return Err(Unfit::Friction(b, Box::new(stuck().bounded(b))));
        }
        if asked && let Some(what) = self.stage.overload(eta) {
            return Err(Unfit::Friction(b, Box::new(stuck().failing(what))));
        }
        let root = Root { lambda, branch: 1.0, slope: f64::NAN, doubt: f64::INFINITY };
        Ok(Member { root, lack: Found::lack(&self.stage, b), moves: None, least: Some(least) })
    }

    /// The stick zone of one member from near it.
    fn approach(
        &mut self,
        layer: &mut Layer,
        task: Task,
        b: f64,
        guess: Root,
        found: &mut Found,
    ) -> Result<Option<Member>, Refusal> {
        let stage = &mut self.stage;
        let approach = Approach { error: REFINED * task.tolerance, widest: stage.curve(layer, task).widest() };
        found.approach(&approach, b, guess, |from| {
            let next = stage.follow(layer, task, b, from, NEAR)?;
            Ok(next.map(|next| (next, Found::lack(stage, b))))
        })
    }

    /// Checks the conditions of friction under some of the members up to a half-width; what the first that fails one
    /// fails.
    pub(crate) fn check(&mut self, layer: &mut Layer, task: Task, half_width: f64) -> Result<Option<String>, Refusal> {
        for b in self.looked_at(half_width) {
            let flat = member(task.problem, b, true);
            let task = Task { problem: &flat, ..task };
            if self.sticks() {
                match self.stick_member(layer, task, b, true) {
                    Ok(_) => continue,
                    Err(Unfit::Refused(refusal)) => return Err(refusal),
                    Err(Unfit::Friction(b, what)) => {
                        return Ok(what.failure().map(|what| during(task.problem, b, what)));
                    }
                }
            }
            let start = self.root_at(b).map(|root| Outcome::of_rubbing(Rubbing::expected(root, b, false)));
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
        if self.sticks() {
            return Ok(self.rubbing_between(b));
        }
        let Some(guess) = self.root_at(b) else { return Ok(None) };
        let flat = member(task.problem, b, true);
        let root = self.stage.follow(layer, Task { problem: &flat, ..task }, b, guess, REFINED * task.tolerance)?;
        Ok(Some(Rubbing::expected(root.unwrap_or(guess), b, checked)))
    }

    /// The stick zone of a contact of that half-width, as told between the members; `None` without friction.
    pub(crate) fn rubbing_between(&self, b: f64) -> Option<Rubbing> {
        if self.sticks() {
            return Some(Rubbing::sticking(b, self.zone(b).log(), self.is_checked()));
        }
        Some(Rubbing::expected(self.root_at(b)?, b, self.is_checked()))
    }

    /// Whether everything sticks under all of its members.
    pub(crate) fn sticks(&self) -> bool {
        self.rubbed.as_ref().is_some_and(|rubbed| rubbed.of_least.is_some())
    }

    /// The friction coefficient that a member's shear lacks what it does of: where everything sticks the least with which it does.
    pub(crate) fn sliding(&self, b: f64) -> f64 {
        let least = self.rubbed.as_ref().and_then(|rubbed| rubbed.of_least.as_ref());
        least.map_or_else(|| self.signed_friction(), |of_least| self.of_shear.sum(b, of_least))
    }

    /// Work in its systems so far.
    pub(crate) fn work(&self) -> Work {
        self.stage.work() + self.system.work
    }

    /// Kernel lengths in its widest half-width.
    pub(crate) fn kernel_lengths(&self) -> f64 {
        self.kernel_lengths
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

    /// The stick zone to be expected under a member. Beyond the widest nothing is told but its own.
    fn root_at(&self, b: f64) -> Option<Root> {
        let (within, doubt) = if b > self.widest() { (self.widest(), f64::INFINITY) } else { (b, SLOPE_DOUBT) };
        Some(self.rubbed.as_ref()?.root_at(&self.of_shear, within, doubt))
    }

    /// By how much its shear is known to move with the stick zone.
    fn moves(&self) -> Option<Arc<Moves>> {
        self.rubbed.as_ref()?.moves.clone()
    }

    /// The stick zone of a member.
    pub(crate) fn zone(&self, b: f64) -> StickZone {
        let rubbed = self.rubbed.as_ref().expect("a family with friction");
        StickZone::from_log(rubbed.lambda_at(&self.of_shear, b), b)
    }

    /// Friction coefficient, negative where the slip is outward.
    pub(crate) fn signed_friction(&self) -> f64 {
        self.rubbed.as_ref().map_or(0.0, |rubbed| rubbed.branch) * self.friction.unwrap_or(0.0)
    }

    /// Whether friction does not bear one of its members by itself.
    pub(crate) fn is_overloaded(&self) -> bool {
        self.stage.is_overloaded
    }

    /// Half-widths at which a contact that grew so wide is looked at.
    pub(crate) fn looked_at(&self, half_width: f64) -> Vec<f64> {
        let narrower = self.blend.half_widths().iter().copied().filter(|b| *b < half_width);
        [half_width].into_iter().chain(narrower.step_by(CHECKED)).collect()
    }

    /// Whether the conditions of friction were found to hold under its members.
    pub(crate) fn is_checked(&self) -> bool {
        self.rubbed.as_ref().is_none_or(|rubbed| rubbed.checked)
    }

    /// Depth of a member over `A0`.
    pub(crate) fn depth(&self, b: f64) -> f64 {
        self.blend.sum(b, &self.depth) - b.ln() / PI
    }

    /// `W` of a member at points within it.
    pub(crate) fn tilt_into(&mut self, b: f64, at: &[Station], out: &mut [f64]) {
        self.count(self.tilt.width, at.len());
        self.blend.functions_at(b, &mut self.room.functions);
        self.tilt.blend_into(&self.room.functions, &mut self.room.density);
        self.rule.stretch(b);
        self.rule.values_into(&self.room.density, at, out);
    }

    /// `W` of a member at the nodes of a grid over its right half.
    pub(crate) fn tilt_over(&mut self, b: f64, grid: &Arc<Vec<Node>>, out: &mut Vec<f64>) {
        if !self.tilt_over.as_ref().is_some_and(|(known, _)| Arc::ptr_eq(known, grid)) {
            let at: Vec<Station> = grid.iter().map(|node| Station { x: node.from_lower, gap: node.to_upper }).collect();
            let mut numbers = vec![0.0; self.blend.functions() * at.len()];
            self.rule.stretch(1.0);
            let rows = self.tilt.numbers.chunks_exact(self.tilt.width).zip(numbers.chunks_exact_mut(at.len()));
            rows.for_each(|(row, out)| self.rule.values_into(row, &at, out));
            self.tilt_over = Some((Arc::clone(grid), Table { width: at.len(), numbers }));
        }
        let (_, table) = self.tilt_over.as_ref().expect("made before");
        self.meter.count_multiplications(table.numbers.len());
        self.blend.functions_at(b, &mut self.room.functions);
        table.blend_into(&self.room.functions, out);
    }

    /// Pressure of a member at points within it.
    pub(crate) fn pressure_into(&mut self, b: f64, at: &[Station], out: &mut [f64]) {
        self.count(self.pressure.width, at.len());
        self.blend.functions_at(b, &mut self.room.functions);
        self.pressure.blend_into(&self.room.functions, &mut self.room.density);
        self.stage.normal.values_of(b, &self.room.density, at, out);
        for p in out {
            *p /= b;
        }
    }

    /// Takes note of a member that is blended and told at so many points.
    fn count(&self, width: usize, points: usize) {
        let members = self.blend.half_widths().len();
        self.meter.count_multiplications(members * width + points * width);
    }

    /// Refuses to go on where the budget is used up.
    pub(crate) fn within_budget(&self) -> Result<(), Refusal> {
        self.meter.within()
    }

    /// The pressure of slices at a point.
    pub(crate) fn stacked_pressure(&mut self, slices: &[Slice], x: f64) -> f64 {
        self.spread_pressure();
        let sheet = self.pressure_at.as_ref().expect("made before");
        self.meter.count_multiplications(slices.len() * self.pressure.numbers.len());
        let (mut places, mut factors) = ([0.0; LANES], [0.0; LANES]);
        let mut sum = 0.0;
        for slices in slices.chunks(LANES) {
            factors.fill(0.0);
            let lanes = slices.iter().zip(places.iter_mut().zip(&mut factors));
            for (Slice { beyond, force, .. }, (place, factor)) in lanes {
                // Of `b'`, `sqrt(1 - (x/b')^2)`.
                let root = (beyond * (2.0 * x + beyond)).sqrt();
                *place = sheet::place(Station { x, gap: *beyond }).min(1.0);
                *factor = if root > 0.0 { force / root } else { 0.0 };
            }
            self.blend.functions_into(&half_widths(slices), &mut self.room.side_by_side);
            let mut values = [0.0; LANES];
            sheet.values_into(&self.room.side_by_side, &places, &mut self.room.polynomials, &mut values);
            sum += values.iter().zip(&factors).map(|(value, factor)| value * factor).sum::<f64>();
        }
        sum
    }

    /// Whether the pressure of no member pulls anywhere, as far as a few places tell.
    pub(crate) fn presses(&mut self) -> bool {
        self.spread_pressure();
        let sheet = self.pressure_at.as_ref().expect("made before");
        self.blend.half_widths().chunks(LANES).all(|members| {
            let mut half_widths = [members[0]; LANES];
            half_widths[..members.len()].copy_from_slice(members);
            self.blend.functions_into(&half_widths, &mut self.room.side_by_side);
            (0..LOOKED_AT).all(|i| {
                let mut values = [0.0; LANES];
                let place = [i as f64 / LOOKED_AT as f64; LANES];
                sheet.values_into(&self.room.side_by_side, &place, &mut self.room.polynomials, &mut values);
                values.iter().all(|p| *p > 0.0)
            })
        })
    }

    /// Makes the pressures of all half-widths known at any place.
    fn spread_pressure(&mut self) {
        if self.pressure_at.is_some() {
            return;
        }
        let places = Places::of(self.pressure.width as f64);
        let Places { points, stations } = &*places;
        let mut rows = Vec::with_capacity(self.blend.functions() * stations.len());
        for row in self.pressure.numbers.chunks_exact(self.pressure.width) {
            let first = rows.len();
            rows.resize(first + stations.len(), 0.0);
            self.stage.normal.values_of(1.0, row, stations, &mut rows[first..]);
            rows[first..].iter_mut().zip(stations).for_each(|(p, at)| *p *= (at.gap * (2.0 - at.gap)).sqrt());
        }
        self.pressure_at = Some(Sheet::through(points, &rows));
    }

    /// What the shear of slices lacks to that of full sliding, `eta p - q`, at a point.
    pub(crate) fn stacked_lack(&mut self, slices: &[Slice], x: f64) -> f64 {
        let rubbed = self.rubbed.as_ref().expect("a family with friction");
        self.meter.count_multiplications(slices.len() * self.of_shear.functions() * rubbed.lack.width());
        let (mut places, mut factors) = ([0.0; LANES], [0.0; LANES]);
        let mut sum = 0.0;
        for slices in slices.chunks(LANES) {
            self.of_shear.functions_into(&half_widths(slices), &mut self.room.side_by_side);
            let lambda = rubbed.lambda_in_lanes(&self.room.side_by_side);
            factors.fill(0.0);
            let lanes = slices.iter().zip(&lambda).zip(places.iter_mut().zip(&mut factors));
            for ((Slice { half_width, force, .. }, lambda), (place, factor)) in lanes {
                let gap = StickZone::from_log(*lambda, *half_width).half_width - x;
                let at = if gap > 0.0 { sheet::place(Station { x, gap }) } else { 1.0 };
                // Beside the stick zone nothing is lacking, and so close to its end next to nothing.
                (*place, *factor) = if at < 1.0 { (at, force / half_width) } else { (1.0, 0.0) };
            }
            let mut values = [0.0; LANES];
            rubbed.lack.values_into(&self.room.side_by_side, &places, &mut self.room.polynomials, &mut values);
            sum += values.iter().zip(&factors).map(|(value, factor)| value * factor).sum::<f64>();
        }
        sum
    }
}

/// Those of a few slices, side by side.
fn half_widths(slices: &[Slice]) -> Lanes {
    let mut half_widths = [slices[0].half_width; LANES];
    half_widths.iter_mut().zip(slices).for_each(|(half_width, slice)| *half_width = slice.half_width);
    half_widths
}
