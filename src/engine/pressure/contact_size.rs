//! How wide a growing contact becomes under a load.

use super::normal::Normal;
use crate::engine::numerics::climb::Trail;
use crate::engine::numerics::root::{self, Bracketed};
use crate::engine::prepared_layer::{PreparedLayer, Wanted};
use crate::engine::problem::{LoadInLayerUnits, Problem};
use basin::RootError;
use slipzone_api::{Flaw, Refusal, short};
use std::f64::consts::{FRAC_PI_2, LN_2};

/// Steps of the walk towards a sign change; each is at least a factor of 2 at the coarsest resolution.
const MOST_STEPS: u32 = 200;
/// A step this small ends the walk where a contact cannot be solved.
const SMALLEST_STEP: f64 = 0.1;
/// The same on the way to where the punch ends: the load may be borne just before.
const SMALLEST_AT_END: f64 = 1e-3;
/// First half-width tried on a layer: wider ones cost more, and the walk gets there when it must.
const WIDEST_START: f64 = 2.0;
/// Part of that where a base that gives way, too, is pressed in, or gives way more than the surface. A stiff layer
/// bends, and sinks farther than its surface yields; a contact so wide that it would pull may sink as far as the one
/// that the load grew to, or bear as much, and only that is met first on a walk outwards.
const FAR_BELOW: f64 = 1.0 / 64.0;

/// The longest step of that walk: against a datum above a base that gives way, what a punch sinks may grow, shrink and
/// grow again over a few times the datum's depth, and what it bears on a stiff layer over a few thicknesses.
const BENDING_STEP: f64 = 0.5 * LN_2;
/// Where it misses less than that, a step is half as long: it may be met, and missed again within one.
const NEAR: f64 = -1.0;
/// Into so many parts the step is cut in which it is met.
const PARTS: u32 = 4;

/// How far beyond the contact on a half-plane a kink is near, in `ln b`.
const NEAR_KINK: f64 = LN_2;

/// What cannot be solved counts as so low, see [`Trail::top`], and what sinks less than its datum; that of a contact
/// this many times as wide as the layer is thick is not worth a wider one.
const SUNK: f64 = -2.0;
const WIDEST_SUNK: f64 = 4.0;

/// What a load may miss of the one wanted, over the tolerance; it counts as error.
const MISSED: f64 = 0.1;
/// A top that stayed below zero by less than this may be above it at another resolution.
const BESIDE_TOP: f64 = 0.02;
/// What it may miss over what it missed at the size of the coarser resolution, whose error is as large as that.
const CONTRACTED: f64 = 0.03;
/// Steps along the slope before a size counts as lost.
const STEPS: usize = 5;
/// Position tolerance of a search in `ln b`, over the tolerance of the scene.
const POSITION: f64 = 0.01;
/// An excess this small is one of rounding, of the kernel tables included.
const ROUNDING: f64 = 1e-11;
/// What to do about a contact that outgrows its punch.
const FURTHER_OUT: &str = "take a smaller load, or give the shape further out";

/// How wide the contact is, and how its size grows: what the next resolution starts from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Size {
    pub(crate) half_width: f64,
    /// `d ln(load)/d ln b`; NaN where it is not known.
    slope: f64,
    /// What the load reached misses of the one wanted, relative: more than rounding where it jumps, because the
    /// resolution is too coarse for the layer.
    pub(crate) missed: f64,
    /// Whether it is where to start from, and no coarser resolution's.
    is_guess: bool,
    /// Whether a narrower contact bears nearly as much, and then a wider one less: another resolution may find it.
    is_beside_top: bool,
}

impl Size {
    /// A size that bears the load, all but rounding.
    pub(crate) fn exactly(half_width: f64) -> Self {
        Self { half_width, slope: f64::NAN, missed: 0.0, is_guess: false, is_beside_top: false }
    }

    /// The same where that misses so much of the load.
    pub(crate) fn missing(self, missed: f64) -> Self {
        Self { missed, ..self }
    }

    /// The same, and how the load grows there.
    pub(crate) fn growing(self, slope: f64) -> Self {
        Self { slope, ..self }
    }

    /// By how many times an error of the load moves the numbers of the contact, both relative: as much as forces move
    /// where it grows like the square of the half-width, or faster, and without bound where it is about to fall, as the
    /// depth to a shallow datum does.
    pub(crate) fn moves(&self) -> f64 {
        if self.slope < 1.0 { 2.0 / self.slope.max(FLATTEST) } else { 1.0 }
    }

    /// A size to start from, where the load grows with that slope.
    pub(crate) fn about(half_width: f64, slope: f64) -> Self {
        Self { slope, is_guess: true, ..Self::exactly(half_width) }
    }

    /// Where to start under another load, from the size under one; `None` where these do not compare.
    pub(crate) fn under(&self, before: LoadInLayerUnits, load: LoadInLayerUnits) -> Option<Self> {
        let times = match (before, load) {
            (_, LoadInLayerUnits::HalfWidth(half_width)) => return Some(Self::exactly(half_width)),
            (LoadInLayerUnits::Force(before), LoadInLayerUnits::Force(load))
            | (LoadInLayerUnits::Indentation(before), LoadInLayerUnits::Indentation(load)) => load / before,
            _ => return None,
        };
        SLOPES.contains(&self.slope).then(|| Self::about(self.half_width * times.powf(1.0 / self.slope), self.slope))
    }
}

/// A load that grows no faster with the half-width does not tell it.
const FLATTEST: f64 = 1e-12;
/// Slopes of a contact's load over its size, `d ln P/d ln b`, that are no jump; 2 to 3 for a cylinder.
const SLOPES: std::ops::RangeInclusive<f64> = 0.2..=30.0;

/// Solves the pressure under a punch whose contact grows, at the load of the problem.
///
/// `known`: the size at a coarser resolution, or under another load, where there was one.
pub(crate) fn press(
    layer: &mut PreparedLayer,
    problem: &Problem,
    normal: &mut Normal,
    wanted: Wanted,
    tolerance: f64,
    known: Option<Size>,
) -> Result<Size, Refusal> {
    let (target, by_force) = match problem.load {
        LoadInLayerUnits::HalfWidth(half_width) => {
            layer.tabulate(half_width, wanted)?;
            normal.press_smooth(layer, problem, half_width)?;
            return Ok(Size::exactly(half_width));
        }
        LoadInLayerUnits::Force(target) => (target, true),
        LoadInLayerUnits::Indentation(target) => (target, false),
    };
    let mut search = Search { layer, problem, normal, wanted, tolerance, target, by_force, widest: 0.0, pulls: false };
    let known = known.filter(|known| !known.is_beside_top);
    if let Some(size) = known
        && let Some(near) = search.follow(size)?
    {
        return Ok(near);
    }
    search.search(known.map(|known| known.half_width))
}

/// A walk towards a sign change, in `ln b`.
#[derive(Clone, Copy)]
struct Walk {
    start: f64,
    /// Where it ends.
    limit: f64,
    /// The first step.
    step: f64,
    /// A step that is not halved any more.
    smallest: f64,
    /// Whether what is looked for may grow, shrink and grow again on the way.
    bends: bool,
}

/// A sign change between two steps of a walk, in `ln b`.
struct Crossing {
    log_b: f64,
    /// The slope there.
    slope: f64,
    /// Whether a top beside it is nearly one.
    is_beside_top: bool,
}

/// The search for the contact that bears a load.
struct Search<'a> {
    layer: &'a mut PreparedLayer,
    problem: &'a Problem,
    normal: &'a mut Normal,
    wanted: Wanted,
    tolerance: f64,
    /// The load wanted: a force or an indentation.
    target: f64,
    by_force: bool,
    /// The widest contact tried so far.
    widest: f64,
    /// Whether the one tried last pulls somewhere.
    pulls: bool,
}

impl Search<'_> {
    /// Presses a contact of half-width `b`, and tells by how much the load that it takes is beyond the one wanted:
    /// `ln(reached/target)`, which is nearly linear in `ln b` for any punch.
    fn excess(&mut self, log_b: f64) -> Result<f64, Refusal> {
        let problem = self.problem;
        // What the logarithm rounds must not leave the shape.
        let half_width = log_b.exp().min(problem.reach());
        self.widest = half_width.max(self.widest);
        self.layer.tabulate(roomy(half_width), self.wanted)?;
        self.normal.press_smooth(self.layer, problem, half_width)?;
        self.pulls = self.normal.unknowns().iter().any(|p| *p < 0.0);
        let reached = if self.by_force { Some(self.normal.force) } else { self.normal.depth(self.layer, problem) };
        let sinks_with_datum = !self.by_force && problem.layer.datum.is_some();
        match reached {
            Some(reached) if reached > 0.0 => Ok((reached / self.target).ln()),
            // The datum sinks more than the punch does; under a wider contact it may sink less.
            Some(_) if sinks_with_datum && half_width < WIDEST_SUNK => Ok(SUNK),
            Some(_) if sinks_with_datum => Err(Refusal::OutOfReach {
                method: "contact size",
                why: format!("under a contact of half-width {half_width:.3e} h the datum sinks more than the punch"),
                remedy: "give the force or the half-width, or a deeper `datum`",
            }),
            _ => Err(no_size(format!(
                "at this resolution a contact of half-width {half_width:.3e} h bears no load: it is too wide beside the \
                 layer for the nodes, or the cutoff too small"
            ))),
        }
    }

    /// The same, where what cannot be solved counts as low.
    fn excess_or_sunk(&mut self, log_b: f64) -> f64 {
        self.excess(log_b).unwrap_or(SUNK)
    }

    /// The size of a coarser resolution, moved along the slope until little is missed; `None` where it is not near.
    ///
    /// No sign change is asked for: the load is borne at the size returned, all but what is missed.
    fn follow(&mut self, known: Size) -> Result<Option<Size>, Refusal> {
        let Size { half_width, mut slope, is_beside_top, .. } = known;
        let mut log_b = half_width.ln();
        let mut missed = self.excess(log_b)?;
        let allowed = MISSED * self.tolerance / known.moves();
        let enough = if known.is_guess { allowed } else { allowed.max(CONTRACTED * missed.abs()) };
        for _ in 0..STEPS {
            if missed.abs() <= enough {
                let (half_width, missed) = (log_b.exp(), missed.abs());
                return Ok(Some(Size { half_width, slope, missed, is_guess: false, is_beside_top }));
            }
            let step = -missed / slope;
            if !SLOPES.contains(&slope) || step.abs() > LN_2 {
                break;
            }
            let next = self.excess(log_b + step)?;
            slope = (next - missed) / step;
            (log_b, missed) = (log_b + step, next);
        }
        Ok(None)
    }

    /// Looks for the size from one that is known, or from that on a half-plane.
    fn search(&mut self, known: Option<f64>) -> Result<Size, Refusal> {
        let (problem, target, by_force) = (self.problem, self.target, self.by_force);
        let bends = problem.is_on_soft_base() || !by_force && problem.is_on_half_plane();
        let first = || first_size(problem, target, by_force);
        let from = if bends { FAR_BELOW } else { 1.0 };
        let walk = Walk {
            start: known.unwrap_or_else(|| from * first()).ln(),
            limit: problem.reach().ln(),
            step: if known.is_some() { 0.01 } else { LN_2 },
            smallest: SMALLEST_STEP,
            bends,
        };
        // Towards a kink that is near no walk is worth it where a contact up to there bears less.
        let is_near = problem.ends_before_kinks && walk.limit < NEAR_KINK + first().ln();
        if is_near && self.excess(walk.limit)? < 0.0 {
            return Err(outgrown(problem.reach() * problem.length));
        }
        let found = self.walk(walk).or_else(|refusal| self.walk_to_flaw(walk, refusal));
        let mut met = found.and_then(|crossing| self.meet(crossing));
        if !bends && (met.is_err() || self.pulls) && problem.is_softer_below() {
            // Beyond the contact that a stiff surface bears before it bends.
            let start = (FAR_BELOW * first()).ln();
            let narrower = self.walk(Walk { start, step: LN_2, bends: true, ..walk });
            met = narrower.or(met.map(|(wider, _)| wider)).and_then(|crossing| self.meet(crossing));
        }
        let (Crossing { log_b, slope, is_beside_top }, missed) = met?;
        let missed = missed.abs();
        let slope = if bends || SLOPES.contains(&slope) { slope } else { f64::NAN };
        Ok(Size { half_width: log_b.exp(), slope, missed, is_guess: false, is_beside_top })
    }

    /// Presses the contact at a crossing; with what it misses of the load.
    fn meet(&mut self, crossing: Crossing) -> Result<(Crossing, f64), Refusal> {
        let missed = self.excess(crossing.log_b)?;
        Ok((crossing, missed))
    }

    /// What a walk that was refused finds before the first flaw of the punch: beyond it nothing was worth trying, nor
    /// is what came of it worth telling.
    fn walk_to_flaw(&mut self, walk: Walk, refusal: Refusal) -> Result<Crossing, Refusal> {
        let Some(flaw) = self.problem.flaw(self.widest).filter(|flaw| flaw.x > 0.0) else { return Err(refusal) };
        let limit = (flaw.x / self.problem.length).ln();
        let walk = Walk { start: walk.start.min(limit - LN_2), limit, step: LN_2, smallest: SMALLEST_AT_END, ..walk };
        self.walk(walk).map_err(|_| ended(&flaw))
    }

    /// The sign change from a start that may be far off and below a limit.
    fn walk(&mut self, walk: Walk) -> Result<Crossing, Refusal> {
        let mut trail = Trail::default();
        let (lower, upper) = self.bracket(walk, &mut trail)?;
        let position = (POSITION * self.tolerance).max(4.0 * f64::EPSILON * lower.abs().max(1.0));
        let (log_b, slope) = match root::bracketed((lower, upper), position, |log_b| self.excess(log_b)) {
            Ok(Bracketed { at, slope, .. }) => (at, slope),
            // The walk widens the kernel tables, which changes last bits: a root at one end may lose its sign.
            Err(RootError::NotBracketed { lower, upper, f_lower, f_upper })
                if f_lower.abs().min(f_upper.abs()) < ROUNDING =>
            {
                let at = if f_lower.abs() < ROUNDING { lower } else { upper };
                (at, (f_upper - f_lower) / (upper - lower))
            }
            Err(RootError::Evaluation(refusal)) => return Err(refusal),
            Err(other) => return Err(no_size(other.to_string())),
        };
        let is_beside_top = trail.highest.is_some_and(|height| height > -BESIDE_TOP);
        Ok(Crossing { log_b, slope, is_beside_top })
    }

    /// Walks towards the sign change of an increasing function, in growing steps.
    fn bracket(
        &mut self,
        Walk { start, limit, mut step, smallest, bends }: Walk,
        trail: &mut Trail,
    ) -> Result<(f64, f64), Refusal> {
        let start = start.min(limit);
        let from = self.excess(start)?;
        let direction = if from > 0.0 { -1.0 } else { 1.0 };
        let longest = if bends { BENDING_STEP } else { 2.0 * LN_2 };
        let (mut here, mut growth) = (start, 2.0);
        trail.pass((start, from));
        let climbs = bends && direction > 0.0;
        for _ in 0..MOST_STEPS {
            let next = (here + direction * step).min(limit);
            if next <= here && direction > 0.0 {
                return Err(outgrown(limit.exp() * self.problem.length));
            }
            match self.excess(next) {
                Ok(there) if climbs && there >= 0.0 => return Ok(self.first_part(here, next)),
                Ok(there) if there * direction >= 0.0 => return Ok((here.min(next), here.max(next))),
                Ok(there) => {
                    if climbs && let Some(top) = trail.top((next, there), |at| self.excess_or_sunk(at)) {
                        return Ok(top);
                    }
                    trail.pass((next, there));
                    here = next;
                    step = (growth * step).min(if climbs && there > NEAR { 0.5 * longest } else { longest });
                }
                Err(refusal) if step < smallest => return Err(refusal),
                // Beyond what this resolution can solve, or what it sinks to is above the datum; the load may be borne
                // before.
                Err(_) => {
                    if climbs && let Some(top) = trail.top((next, SUNK), |at| self.excess_or_sunk(at)) {
                        return Ok(top);
                    }
                    step *= 0.5;
                    growth = 1.0;
                }
            }
        }
        Err(no_size(format!("no half-width between {:.3e} h and {:.3e} h bears the load", start.exp(), here.exp())))
    }

    /// The first part of a step in which the excess grows through zero, which it has at its end.
    fn first_part(&mut self, from: f64, to: f64) -> (f64, f64) {
        let at = |part: u32| from + (to - from) * f64::from(part) / f64::from(PARTS);
        let mut met = |part: &u32| self.excess(at(*part)).is_ok_and(|excess| excess >= 0.0);
        let part = (1..PARTS).find(|part| met(part)).unwrap_or(PARTS);
        (at(part - 1), if part == PARTS { to } else { at(part) })
    }
}

/// A half-width that tables are made for, so that a search changes them rarely: the next power of two.
fn roomy(half_width: f64) -> f64 {
    half_width.log2().ceil().exp2().max(half_width)
}

/// A half-width that the contact on a half-plane is hardly wider than; exact where the scene gives it.
pub(crate) fn guess(problem: &Problem) -> f64 {
    match (problem.fixed_half_width(), problem.load) {
        (Some(half_width), _) | (None, LoadInLayerUnits::HalfWidth(half_width)) => half_width,
        (None, LoadInLayerUnits::Force(target)) => first_size(problem, target, true),
        (None, LoadInLayerUnits::Indentation(target)) => first_size(problem, target, false),
    }
}

/// The half-width on a half-plane, within a factor of 2; exact formulas for the cylinder
/// (`P = pi b g'(b)/(2 A0)`), and of the right size for other convex shapes. On a layer no wider than
/// [`WIDEST_START`].
fn first_size(problem: &Problem, target: f64, by_force: bool) -> f64 {
    let reached = |b: f64| {
        if by_force { FRAC_PI_2 * b * problem.slope(b) / problem.elastic.a0() } else { 2.0 * problem.height(b) }
    };
    // In layer units a length that is positive and finite may be neither.
    let mut b = problem.natural_length().clamp(f64::MIN_POSITIVE, f64::MAX);
    // Further out than the face a punch that does not rise is hollow there, or has no shape. Each loop ends, as b is
    // positive and finite: it leaves the range of floating point numbers after 2100 steps at the latest.
    let rises = |b: f64| b <= problem.face() || reached(b) > 0.0;
    let is_beyond = |b: f64| reached(b) > target || !rises(b);
    while is_beyond(b) && b > f64::MIN_POSITIVE {
        b *= 0.5;
    }
    while reached(b) < target && b < f64::MAX / 4.0 && reached(2.0 * b) >= reached(b) {
        b *= 2.0;
    }
    if problem.has_base() { b.min(WIDEST_START) } else { b }
}

/// The load asks for more of the shape than there is up to `x`, where it ends.
pub(crate) fn outgrown(x: f64) -> Refusal {
    Refusal::OutOfReach {
        method: "contact size",
        why: format!(
            "under this load the contact would outgrow the punch, whose shape is known up to x = {} and no further out",
            short(x)
        ),
        remedy: FURTHER_OUT,
    }
}

/// Whether that is why a load was refused.
pub(crate) fn is_outgrown(refusal: &Refusal) -> bool {
    matches!(refusal, Refusal::OutOfReach { remedy: FURTHER_OUT, .. })
}

/// The load asks for more of the shape than is sound.
fn ended(flaw: &Flaw) -> Refusal {
    Refusal::OutOfReach {
        method: "contact size",
        why: format!("{} at x = {}, and up to there no contact bears this load", flaw.what, short(flaw.x)),
        remedy: "take a smaller load, or mend the shape",
    }
}

pub(crate) fn no_size(why: String) -> Refusal {
    Refusal::OutOfReach { method: "contact size", why, remedy: "check the load against the punch and the layer" }
}
