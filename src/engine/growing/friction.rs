//! Friction of a growing contact: its stick zone, its shear, and what cannot be told of either.

use super::{GUESSED, Growing, ROOM_BESIDE_GUESS, STEADY};
use crate::engine::accuracy::quantity::ShearTrace;
use crate::engine::friction::rubbing::{Rubbing, Verdict};
use crate::engine::growing::family::{Family, SHRINKS, during};
use crate::engine::outcome::{Outcome, Task};
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::pressure::normal::Normal;
use crate::engine::problem::Problem;
use slipzone_api::{Refusal, Station};

/// Where what the shear lacks is compared from resolution to resolution, over the half-width of the stick zone: near
/// the middle it is stacked of the most members.
const TRACED: [f64; ShearTrace::POINTS] = [0.05, 0.4, 0.85, 1.0];

impl Growing {
    /// The stick zone, and the shear's trace.
    pub(super) fn rub(&mut self, layer: &mut PreparedLayer, task: Task, normal: &Normal) -> Result<Rubbing, Refusal> {
        let (b, problem) = (self.half_width, task.problem);
        if let Some((at, rubbing)) = &self.broken {
            return Ok(self.told_of_broken(problem, *at, rubbing));
        }
        let family = self.family.as_mut().expect("provided before");
        let zone = family.zone(b);
        let solved = family.rubbing(layer, task, b)?;
        let lost = solved.as_ref().map_or(0.0, |_| family.lost_of_shear());
        let rubbing = solved.or_else(|| family.rubbing_between(problem, b)).expect("a family with friction");
        if rubbing.failure().is_some() {
            return Ok(rubbing);
        }
        if let Some(at) = family.shrinks(problem.face()..b, STEADY) {
            // What is stacked of a zone that shrinks is no shear of this contact.
            return Ok(rubbing.failing(during(problem, at, SHRINKS)));
        }
        // The pressure has a trace of its own.
        let (friction, sliding) = (family.signed_friction(), family.lacking_to());
        let mean = self.mean();
        let lack = TRACED.map(|part| self.lack(problem, b, part * zone.half_width) / mean);
        let inner = ShearTrace::NEAR_MIDDLE.map(|part| self.lack(problem, b, part * zone.half_width) / mean);
        let own = |part: f64| Station { x: part * zone.half_width, gap: (1.0 - part) * zone.half_width };
        let shear = self.shear_traced(problem, normal, TRACED.map(|part| zone.in_contact(own(part))), lack);
        if rubbing.is_full {
            // Beside what slides with much friction what sticks may be little, and so may be the errors of what is
            // lacking.
            let at = ShearTrace::NEAR_MIDDLE.map(|part| zone.in_contact(own(part)));
            let inner = self.shear_traced(problem, normal, at, inner);
            return Ok(rubbing.traced(ShearTrace { inner, sliding, lost, ..ShearTrace::new(shear, shear, friction) }));
        }
        Ok(rubbing.traced(ShearTrace { inner, lost, ..ShearTrace::new(lack, shear, friction) }))
    }

    /// The shear at some points, where it lacks so much to what slides; both over the mean pressure.
    fn shear_traced<const N: usize>(
        &mut self,
        problem: &Problem,
        normal: &Normal,
        at: [Station; N],
        lack: [f64; N],
    ) -> [f64; N] {
        let mut pressure = [0.0; N];
        self.pressure_into(problem, normal, &at, &mut pressure);
        let mean = self.mean();
        let sliding = self.family.as_ref().filter(|_| self.broken.is_none()).map_or(0.0, Family::lacking_to);
        std::array::from_fn(|i| sliding * pressure[i] / mean - lack[i])
    }

    /// What could not be told of friction when the contact had grown to a half-width, in words, unless it is so now.
    fn told_of_broken(&self, problem: &Problem, at: f64, rubbing: &Rubbing) -> Rubbing {
        let rubbing = Rubbing { is_full: rubbing.is_full && !self.was_broken(), ..rubbing.clone() };
        let during = |what: &str| during(problem, at, what);
        match &rubbing.verdict {
            Verdict::Fails(what) => rubbing.clone().failing(during(what)),
            Verdict::Untold(why) => rubbing.clone().untold(during(why)),
            Verdict::Unbuilt(how) => rubbing.clone().unbuilt(during(how)),
            // Of the contact itself, whose size a coarser resolution knew less well.
            _ if !self.is_narrower(at) || self.has_no_shear() => {
                Rubbing { zone: rubbing.zone.of(self.half_width), ..rubbing }
            }
            Verdict::TooNarrow => rubbing.untold(during("the stick zone was narrower than any looked for")),
            Verdict::NoShear => rubbing.failing(during("no shear arises, but later")),
            _ => rubbing.failing(during("no stick zone belongs to this friction coefficient")),
        }
    }

    /// Checks the conditions of friction where no coarser resolution has.
    pub(crate) fn settle(
        &mut self,
        layer: &mut PreparedLayer,
        task: Task,
        outcome: &mut Outcome,
    ) -> Result<(), Refusal> {
        let (Some(family), Some(rubbing)) = (&mut self.family, &mut outcome.rubbing) else { return Ok(()) };
        if !matches!(rubbing.verdict, Verdict::Holds | Verdict::Sticks) {
            return Ok(());
        }
        let failed = if family.is_checked() { None } else { family.check(layer, task, self.half_width)? };
        let is_overloaded = family.is_overloaded();
        if let Some(what) = failed.or_else(|| if is_overloaded { self.overload(task.problem) } else { None }) {
            *rubbing = rubbing.clone().failing(what);
        }
        Ok(())
    }

    /// Shear at points strictly inside the contact, where the pressures are `pressure`; `None` where there is none.
    pub(crate) fn shear(&mut self, problem: &Problem, at: &[Station], pressure: &[f64]) -> Option<Vec<f64>> {
        if self.has_no_shear() {
            return Some(vec![0.0; at.len()]);
        }
        let (Some(family), Some(_), None) = (&self.family, &self.stack, &self.broken) else { return None };
        problem.friction?;
        let (b, zone, sliding) = (self.half_width, family.zone(self.half_width), family.lacking_to());
        let one = |(at, p): (&Station, &f64)| {
            let x = at.x.abs();
            if x == 0.0 {
                return 0.0;
            }
            let lack = if x < zone.half_width { self.lack(problem, b, x) } else { 0.0 };
            (sliding * p - lack) * 1.0_f64.copysign(at.x)
        };
        Some(at.iter().zip(pressure).map(one).collect())
    }

    /// What the shear at a point of the stick zone lacks to what slides, `eta p`.
    pub(super) fn lack(&mut self, problem: &Problem, b: f64, x: f64) -> f64 {
        let (family, stack) = self.family.as_mut().zip(self.stack.as_ref()).expect("provided before");
        stack.lack(problem, family, b, x)
    }

    /// Friction coefficient of the shear, negative where the slip is outward; `None` where there is none to tell.
    pub(crate) fn signed_friction(&self) -> Option<f64> {
        self.family.as_ref().filter(|_| self.broken.is_none()).map(Family::signed_friction)
    }

    /// What cannot be told of friction.
    pub(crate) fn broken(&self) -> Option<&(f64, Rubbing)> {
        self.broken.as_ref()
    }

    /// From now on friction is not looked for where coarser resolutions could not tell it; `None` takes that back.
    pub(crate) fn give_up(&mut self, broken: Option<&(f64, Rubbing)>) {
        self.given_up = broken.cloned();
    }

    /// Whether friction cannot be told of the contact as it grew.
    pub(crate) fn is_broken(&self) -> bool {
        // None under a contact of much that width is none under this one.
        let shears = |at: f64, rubbing: &Rubbing| {
            rubbing.verdict != Verdict::NoShear || ROOM_BESIDE_GUESS * at < self.half_width
        };
        self.broken.as_ref().is_some_and(|(at, rubbing)| shears(*at, rubbing))
    }

    /// Whether it is of a narrower contact that friction cannot be told: the stick zone found there is none of this
    /// one's.
    pub(super) fn was_broken(&self) -> bool {
        self.is_broken() && self.broken.as_ref().is_some_and(|(at, _)| self.is_narrower(*at))
    }

    /// Whether a contact of that half-width is one on the way, and not this one as a coarser resolution knew it.
    fn is_narrower(&self, at: f64) -> bool {
        at < self.half_width * (1.0 - GUESSED)
    }

    /// Whether no shear arises, however wide the contact grew.
    pub(super) fn has_no_shear(&self) -> bool {
        self.broken.is_some() && !self.is_broken()
    }
}
