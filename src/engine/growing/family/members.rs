//! The members of a family, solved one by one.

use super::depths::Depths;
use super::rubbed::{Member, Members, Rubbed, Seen};
use super::{CHECKED, Family, SHRINKS, STUCK_AFTER, STUCK_BEFORE, Unfit, during, member};
use crate::engine::accuracy::error_estimate::apart;
use crate::engine::accuracy::quantity::ShearTrace;
use crate::engine::contact::Contact;
use crate::engine::friction::rubbing::{Rubbing, Verdict};
use crate::engine::friction::stick_search::{FrictionCurve, Root};
use crate::engine::growing::STEADY;
use crate::engine::growing::blend::Blend;
use crate::engine::growing::sheet::{END, FAR_END};
use crate::engine::numerics::chebyshev::largest;
use crate::engine::outcome::{Outcome, Task};
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::problem::Problem;
use slipzone_api::{Component, Refusal, short};
use std::f64::consts::PI;

/// A stick zone farther from the one expected is not near.
const NEAR: f64 = 0.3;
/// Error of the members' stick zones over the tolerance.
const REFINED: f64 = 0.1;

/// A member and whether the conditions of friction were found to hold under it, or what is to be said of its stick
/// zone.
type Solved = Result<(Member, bool), Box<Rubbing>>;

/// By how much a coarser family was wrong about members of this one, each in proportion to its half-width: narrow ones
/// bear little.
#[derive(Default)]
struct Wrong(Option<f64>);

impl Wrong {
    fn add(&mut self, half_width: f64, apart: f64) {
        self.0 = self.0.into_iter().chain([half_width * apart]).reduce(f64::max);
    }

    fn add_apart(&mut self, coarse: Option<&Rubbed>, member: &Member, half_width: f64) {
        if let Some(coarse) = coarse.filter(|coarse| coarse.tells(half_width)) {
            self.add(half_width, coarse.apart_from(member, half_width));
        }
    }

    /// Infinite where nothing was compared.
    fn over(&self, widest: f64) -> f64 {
        self.0.map_or(f64::INFINITY, |most| most / widest)
    }
}

/// Where the places end at which shears are told under members one of which has that stick zone, if any has. Narrow
/// ones are half-planes'.
fn end_of_shear(flat: &Problem, zone: Option<Root>) -> f64 {
    /// Of a zone as wide as that, at [`END`] the shear has met `eta p`.
    const MET: f64 = 18.0;
    let on_half_plane = flat.friction.unwrap_or(0.0) * PI / flat.elastic.beta();
    if zone.is_some_and(|zone| on_half_plane.max(zone.lambda) < MET) { END } else { FAR_END }
}

impl Family {
    /// Solves the pressures of all members; `coarse` is the family of a coarser resolution.
    pub(super) fn solve_pressures(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        coarse: Option<&Family>,
    ) -> Result<(), Refusal> {
        let mut wrong = Wrong::default();
        for b in self.pressed.blend.half_widths().to_vec() {
            let flat = member(task.problem, b, false);
            self.contact.press(layer, Task { problem: &flat, ..task }, b)?;
            self.keep_pressure(layer, &flat, b)?;
            if let Some(coarse) = coarse.filter(|coarse| b <= coarse.widest()) {
                wrong.add(b, self.apart_at_edge(coarse, b));
            }
        }
        self.pressed.blended(coarse.map(|coarse| (coarse.pressed.told, wrong.over(self.widest()))));
        Ok(())
    }

    /// By how much pressure and `W` of the member solved last differ at the edge, relative, from what a coarser
    /// resolution tells of them: resolutions agree there long before they do elsewhere.
    fn apart_at_edge(&mut self, coarse: &Family, b: f64) -> f64 {
        let told = [
            coarse.contact.normal.edge_factor_of(coarse.pressed.pressure(b, &mut self.room)),
            coarse.edge_factor_of_tilt(coarse.pressed.tilt(b, &mut self.room)),
        ];
        let normal = &self.contact.normal;
        let here = [b * normal.edge_factor_of(normal.unknowns()), self.edge_factor_of_tilt(self.system.column(0))];
        apart(&[told[0] / here[0], told[1] / here[1]], &[1.0; 2], 1.0)
    }

    /// `lim W sqrt(b^2 - x^2)/b`.
    fn edge_factor_of_tilt(&self, unknowns: &[f64]) -> f64 {
        self.rule.edge_factor(unknowns) / self.rule.half_width()
    }

    /// Solves the pressures of all members, and the shears of those of a blend of their own.
    pub(super) fn solve_under_friction(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        contact: f64,
        (blend, coarse): (Blend, Option<&Family>),
    ) -> Result<(), Unfit> {
        let flat = member(task.problem, contact, true);
        let mut before = match coarse {
            Some(coarse) if coarse.rubbed.is_some() => None,
            _ => Some(self.search(layer, Task { problem: &flat, ..task }, (contact, task.problem.face()))?),
        };
        self.end_of_shear = end_of_shear(&flat, before.or_else(|| coarse.and_then(|coarse| coarse.root_at(contact))));
        self.solve_pressures(layer, task, coarse)?;
        // What a coarser resolution found to hold is not checked again; without one, nothing is known well enough.
        let (is_first, known) = (coarse.is_none(), coarse.is_some_and(Family::is_checked));
        let mut members = Members::new(coarse.and_then(Family::moves), !is_first);
        let half_widths = blend.half_widths();
        // What sticks as a whole slips in no direction.
        let can_stick = flat.elastic.beta() < FrictionCurve::FLAT * PI;
        let sticks_at_times = |members: &Members| {
            let ends = members.sticks_at_times(half_widths).filter(|_| can_stick);
            ends.map(|ends| (ends, members.narrowest_zone(half_widths, contact)))
        };
        let coarse_zones = coarse.and_then(|coarse| coarse.rubbed.as_ref());
        let mut wrong = Wrong::default();
        for (k, b) in half_widths.iter().copied().enumerate() {
            let flat = member(task.problem, b, true);
            let task = Task { problem: &flat, ..task };
            self.take_pressure(b);
            let asked = !is_first && !known && k % CHECKED == 0;
            let told = coarse.and_then(|coarse| coarse.root_at(b));
            let start = told.or_else(|| members.continued(&half_widths[..k], b)).or(before.take());
            let (member, checked) = match self.solve_member(layer, task, b, (start, asked), &mut members)? {
                Ok(solved) => solved,
                Err(why) => return Err(Unfit::Friction(b, why)),
            };
            if !is_first && !known && !asked {
                // Takes note of it where friction does not bear it: not for long, maybe.
                self.contact.overload(layer, flat.friction.expect("friction"));
            }
            members.checked &= checked || !asked;
            let root = member.root;
            wrong.add_apart(coarse_zones, &member, b);
            if !members.add(member) {
                if let Some(found) = sticks_at_times(&members) {
                    return Err(self.sticks_between(layer, task, found)?);
                }
                let by_then = short(half_widths[k - 1] * flat.length);
                let turns = format!("the direction of slip turns between there and {by_then}");
                return Err(Unfit::Friction(b, Box::new(Rubbing::expected(root, b, false).failing(turns))));
            }
        }
        if let Some(found) = sticks_at_times(&members) {
            return Err(self.sticks_between(layer, Task { problem: &flat, ..task }, found)?);
        }
        let told = coarse_zones.map(|coarse| (coarse.told, wrong.over(blend.widest())));
        self.rubbed = Some(members.blended(blend, (self.end_of_shear, self.accuracy), told));
        Ok(self.look_closer(layer, task)?)
    }

    /// What is said of contacts that stick as a whole at one of two half-widths, and not at the other: where that ends,
    /// or begins. A stick zone of a wider one that is smaller than that shrinks.
    fn sticks_between(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        ((mut sticks, mut slips), narrowest_zone): ((f64, f64), f64),
    ) -> Result<Unfit, Refusal> {
        /// As told at this resolution, which tells a narrow slip zone by few digits.
        const SURE: f64 = 1e-3;
        /// By how much the coarsest resolution may be off, which is the one that ends here: measured up to 0.17.
        const UNSURE: f64 = 0.2;
        let is_at_first = sticks < slips;
        while (sticks - slips).abs() > SURE * sticks {
            let b = f64::midpoint(sticks, slips);
            self.take_pressure(b);
            *(if self.contact.stuck(layer, task)?.is_some() { &mut sticks } else { &mut slips }) = b;
        }
        let stuck = Rubbing::sticking(sticks, false);
        let rubbing = match is_at_first {
            true if narrowest_zone < sticks * (1.0 - UNSURE) => {
                stuck.failing(format!("{SHRINKS} that was all of the contact up to about there"))
            }
            true => stuck.unbuilt(STUCK_BEFORE.into()),
            false => stuck.unbuilt(STUCK_AFTER.into()),
        };
        Ok(Unfit::Friction(sticks, Box::new(rubbing)))
    }

    /// Solves for the stick zones between the members that are told to shrink, but by less than is sure: narrow ones
    /// are told no better than wide ones ask for.
    fn look_closer(&mut self, layer: &mut PreparedLayer, task: Task) -> Result<(), Refusal> {
        let Some(rubbed) = self.rubbed.as_ref().filter(|_| self.shrinks(0.0..f64::INFINITY, STEADY).is_none()) else {
            return Ok(());
        };
        let neighbours = rubbed.zones.windows(2).enumerate();
        let told = neighbours.filter(|(_, zones)| zones[0].shrinks_from(&zones[1]).end > STEADY);
        let mut unsure: Vec<usize> = told.flat_map(|(k, _)| [k, k + 1]).collect();
        unsure.retain(|k| rubbed.zones[*k].unsure > 0.0);
        unsure.dedup();
        let half_widths: Vec<f64> = unsure.iter().map(|k| rubbed.zones[*k].half_width).collect();
        for (k, b) in unsure.into_iter().zip(half_widths) {
            self.take_pressure(b);
            let Some(found) = self.rubbing(layer, task, b)? else { continue };
            let rubbed = self.rubbed.as_mut().expect("known above");
            rubbed.zones[k] = Seen { half_width: b, zone: found.zone.half_width, unsure: REFINED * task.tolerance * b };
        }
        Ok(())
    }

    /// The stick zone of one member by a search of its own: the others follow. Of several it is one that slides as the
    /// contact has from the beginning: where that is a face, as that does.
    fn search(&mut self, layer: &mut PreparedLayer, task: Task, (b, face): (f64, f64)) -> Result<Root, Unfit> {
        let mut outcome = self.contact.solve(layer, task, None, None)?;
        let is_one_of_several =
            |outcome: &Outcome| outcome.rubbing.as_ref().is_some_and(|found| found.found.roots.len() > 1);
        let could_slip_otherwise = is_one_of_several(&outcome);
        self.slips_by_face = could_slip_otherwise.then_some(face);
        if face > 0.0 && could_slip_otherwise {
            self.contact.branch = self.branch_of(layer, task, face)?;
            if self.contact.branch < 0.0 {
                outcome = self.contact.solve(layer, task, None, None)?;
            }
        }
        let found = outcome.rubbing.expect("a stick zone, or why there is none");
        if found.verdict == Verdict::TooNarrow
            && let Some(narrower) = self.wider_zone(layer, task, (b, face), found.zone.half_width)?
        {
            let rubbing =
                found.failing(format!("{SHRINKS}, at the latest from there on, to less than can be resolved"));
            return Err(Unfit::Friction(narrower, Box::new(rubbing)));
        }
        let root = if found.verdict == Verdict::Sticks { self.contact.stuck(layer, task)? } else { found.reported() };
        root.ok_or_else(|| Unfit::Friction(b, Box::new(found)))
    }

    /// A contact narrower than one, on its way from a face, with a stick zone wider than that one's.
    fn wider_zone(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        (b, face): (f64, f64),
        zone: f64,
    ) -> Result<Option<f64>, Refusal> {
        /// Parts of the contact that are looked at.
        const LOOKED_AT: [f64; 3] = [0.5, 0.1, 0.01];
        for narrower in LOOKED_AT.map(|part| part * b).into_iter().filter(|narrower| *narrower > face) {
            let flat = member(task.problem, narrower, true);
            let found = self.contact.solve(layer, Task { problem: &flat, ..task }, None, None)?.rubbing;
            if found.is_some_and(|found| found.solved().is_some() && found.zone.half_width > zone) {
                return Ok(Some(narrower));
            }
        }
        Ok(None)
    }

    /// The direction of slip under the face of a punch, which bears its own shear.
    fn branch_of(&mut self, layer: &mut PreparedLayer, task: Task, face: f64) -> Result<f64, Refusal> {
        let flat = member(task.problem, face, true);
        self.contact.bears_own_shear(true);
        let outcome = self.contact.solve(layer, Task { problem: &flat, ..task }, None, None);
        self.contact.bears_own_shear(false);
        Ok(outcome?.rubbing.and_then(|found| found.reported()).map_or(self.contact.branch, |root| root.branch))
    }

    /// Gives the contact the pressure of a member, as it is told between those solved.
    pub(crate) fn take_pressure(&mut self, b: f64) {
        let pressure = self.pressed.pressure(b, &mut self.room);
        self.contact.normal.take_flat(b, pressure.iter().map(|p| p / b));
    }

    /// Keeps what the pressure of the member solved last tells.
    fn keep_pressure(&mut self, layer: &PreparedLayer, flat: &Problem, b: f64) -> Result<(), Refusal> {
        self.pressed.pressure.push(self.contact.normal.unknowns().iter().map(|p| p * b));
        self.tilted(layer, b)?;
        // Against a datum they are taken elsewhere, see [`Depths`].
        let is_by_members = flat.layer.datum.is_none();
        let depth = if is_by_members { self.contact.normal.depth(layer, flat) } else { None };
        self.pressed.depth.push(depth.map_or(0.0, |depth| depth / flat.elastic.a0() - self.on_half_plane.at(b)));
        Ok(())
    }

    /// Depths of members between two half-widths, each by its pressure as it is told between those solved.
    pub(super) fn against_datum(
        &mut self,
        layer: &PreparedLayer,
        task: Task,
        ends: (f64, f64),
        datum: f64,
    ) -> Result<Depths, Refusal> {
        let flat = member(task.problem, ends.1, false);
        Depths::new(task.problem, datum, ends, self.contact.normal.size(), |b| {
            let depth = self.contact.normal.depth_of(b, self.pressed.pressure(b, &mut self.room), (layer, &flat));
            depth.map_or(0.0, |depth| depth / (b * flat.elastic.a0()) - self.on_half_plane.at(b))
        })
    }

    /// Solves for `W`.
    fn tilted(&mut self, layer: &PreparedLayer, b: f64) -> Result<(), Refusal> {
        layer.room_for((self.rule.unknowns(), 1), &*self.rule, b)?;
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
        self.pressed.tilt.push(self.system.column(0).iter().copied());
        Ok(())
    }

    /// Solves one member under friction from a guess of its stick zone, and leaves its pressure in the contact: what is
    /// found, and whether the conditions of friction were found to hold where that is asked; or else what is to be said
    /// of it.
    fn solve_member(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        b: f64,
        (start, asked): (Option<Root>, bool),
        members: &mut Members,
    ) -> Result<Solved, Refusal> {
        if start.is_some_and(|start| start.lambda > FrictionCurve::WIDEST) {
            self.contact.press(layer, task, b)?;
            if let Some(stuck) = self.stuck_member(layer, task, b, asked)? {
                return Ok(stuck);
            }
        }
        if let Some(guess) = start
            && let Some(member) = self.approach(layer, task, b, guess, members)?
        {
            let lambda = member.root.lambda;
            let holds = asked && Contact::is_known(guess.lambda, lambda) && self.contact.holds(layer, task, lambda)?;
            return Ok(Ok((member, holds)));
        }
        let start = start.map(|start| Rubbing::expected(start, b, !asked));
        let outcome = self.contact.solve(layer, task, None, start.as_ref())?;
        let rubbing = outcome.rubbing.expect("a stick zone, or why there is none");
        if rubbing.verdict == Verdict::Sticks
            && let Some(stuck) = self.stuck_member(layer, task, b, asked)?
        {
            return Ok(stuck);
        }
        let Some(root) = rubbing.reported() else { return Ok(Err(Box::new(rubbing))) };
        let member = if let Some(member) = self.approach(layer, task, b, root, members)? {
            member
        } else {
            self.contact.curve(layer, task).at(root.lambda)?;
            let friction = self.contact.friction_of_shear();
            Member { root, lack: Member::lack(&self.contact, friction, self.end_of_shear), stuck: None, moves: None }
        };
        Ok(Ok((member, rubbing.checked)))
    }

    /// [`Self::solve_member`] of the member pressed last, where all of it sticks; `None` where it does not.
    fn stuck_member(
        &mut self,
        layer: &PreparedLayer,
        task: Task,
        b: f64,
        asked: bool,
    ) -> Result<Option<Solved>, Refusal> {
        let Some(root) = self.contact.stuck(layer, task)? else { return Ok(None) };
        let eta = task.friction();
        if asked && let Some(what) = self.contact.overload(layer, eta) {
            let stuck = Rubbing::sticking(b, true);
            return Ok(Some(Err(Box::new(stuck.failing(what)))));
        }
        let [lack, stuck] = [eta, 0.0].map(|friction| Member::lack(&self.contact, friction, self.end_of_shear));
        let least = ShearTrace::least(eta) / eta * largest(&lack);
        Ok(Some(Ok((Member { root, lack, stuck: Some((stuck, least)), moves: None }, asked))))
    }

    /// The stick zone of one member from near it.
    fn approach(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        b: f64,
        guess: Root,
        members: &mut Members,
    ) -> Result<Option<Member>, Refusal> {
        let (contact, end) = (&mut self.contact, self.end_of_shear);
        members.approach(REFINED * task.tolerance, b, guess, |from| {
            let next = contact.follow(layer, task, b, from, NEAR)?;
            Ok(next.map(|next| (next, Member::lack(contact, contact.friction_of_shear(), end))))
        })
    }

    /// Checks the conditions of friction under some of the members up to a half-width; what the first that fails one
    /// fails.
    pub(crate) fn check(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        half_width: f64,
    ) -> Result<Option<String>, Refusal> {
        for b in self.looked_at(half_width) {
            let flat = member(task.problem, b, true);
            let task = Task { problem: &flat, ..task };
            let known = self.root_at(b);
            if known.is_some_and(|known| known.lambda > FrictionCurve::WIDEST) {
                self.contact.press(layer, task, b)?;
                match self.stuck_member(layer, task, b, true)? {
                    Some(Ok(_)) => continue,
                    Some(Err(what)) => return Ok(what.failure().map(|what| during(task.problem, b, what))),
                    None => {}
                }
            }
            let start = known.map(|root| Rubbing::expected(root, b, false));
            let mut outcome = self.contact.solve(layer, task, None, start.as_ref())?;
            self.contact.settle(layer, task, &mut outcome)?;
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

    /// What the shear of the flat punch solved last loses between its nodes, over its mean pressure.
    pub(crate) fn lost_of_shear(&self) -> f64 {
        self.contact.lost_of_shear()
    }

    /// The stick zone of a contact of that half-width, solved for itself: what is told between the members is but its
    /// beginning, and narrow ones are told no better than wide ones ask for. `None` where it is not near that.
    pub(crate) fn rubbing(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        b: f64,
    ) -> Result<Option<Rubbing>, Refusal> {
        let checked = self.is_checked();
        let Some(guess) = self.root_at(b) else { return Ok(None) };
        if guess.lambda > FrictionCurve::WIDEST {
            return Ok(self.rubbing_between(task.problem, b));
        }
        let flat = member(task.problem, b, true);
        let root = self.contact.follow(layer, Task { problem: &flat, ..task }, b, guess, REFINED * task.tolerance)?;
        Ok(root.map(|root| Rubbing::expected(root, b, checked)))
    }
}
