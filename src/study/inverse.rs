//! Inverse questions: the value of a field at which a number of the result is as wanted.
//!
//! The range is looked over in steps first, so that every crossing wider than a step is seen; then the crossing is
//! closed in upon between two steps, always bracketed (Alefeld, Potra, Shi, ACM TOMS algorithm 748), a least value by
//! Brent's method.

mod least;
mod reasons;
mod seen;

use super::Study;
use super::find::{Find, Wanted};
use super::record::{Found, Record};
use crate::engine::numerics::root::{self, Bracketed};
use crate::engine::{Plan, Solution};
use basin::RootError;
use seen::{Place, Point};

/// Steps in which a range is looked over.
const STEPS: u32 = 24;
/// Share of the range over which a slope is measured, and what is beside a value.
const BESIDE: f64 = 1e-3;
/// What is left of the excess at a root, over what it is beside: the root's tolerance and the number's own error, but
/// where it jumps.
const JUMP: f64 = 0.01;
/// Part of the way between two places to within which a root is told at least, for a jump to show.
const NEAR: f64 = JUMP * JUMP;
/// How many times as deep as by a parabola through three steps a number may turn between them, and how much deeper
/// still, over the parabola's second difference: of turns close to a step the parabola told a tenth, which was a
/// sixty-sixth of that difference.
const DEEPER: f64 = 2.0;
const SHALLOW: f64 = 1.0 / 16.0;
/// What takes the place of [`JUMP`] around a turn, where the number changes by less than over a step.
const SMALL_JUMP: f64 = 1e-3;

/// The scene of a study with the field at the value that answers the study's question.
pub(super) fn answer(study: &Study, row: u64, find: &Find) -> Record {
    let question = Question { study, row, find, path: &find.path() };
    match question.search() {
        Ok((found, solution)) => Record { found: Some(found), ..Record::solved(study, row, solution) },
        Err(reason) => match study.scene(row) {
            Ok(scene) => Record::solved(study, row, Solution::refused(&scene, Plan::default(), reason)),
            Err(error) => Record::invalid(study, row, &error),
        },
    }
}

struct Question<'a> {
    study: &'a Study,
    row: u64,
    find: &'a Find,
    path: &'a [String],
}

/// How far an error of the number moves the place, over the range taken as 0 to 1.
#[derive(Clone, Copy, Debug)]
enum Moved {
    /// Where it crosses what is wanted, by its slope.
    BySlope(f64),
    /// Where it is least, by its second derivative.
    ByRoot(f64),
}

impl Moved {
    fn by(self, error: f64) -> f64 {
        match self {
            Self::BySlope(slope) => error / slope.abs(),
            Self::ByRoot(bend) => (2.0 * error / bend.abs()).sqrt(),
        }
        .min(1.0)
    }
}

/// The range as it was looked over.
struct Seen {
    points: Vec<Point>,
    /// Where the number could not be told, and why.
    gaps: Vec<(f64, String)>,
}

impl Question<'_> {
    /// The field's value, and the solution there.
    fn search(&self) -> Result<(Found, Solution), String> {
        let seen = self.look_over()?;
        let mut places = match self.find.wanted {
            Wanted::Minimum | Wanted::Maximum => vec![self.least(&seen.points)?],
            Wanted::Target(_) | Wanted::HalfPlaneWithin(_) => {
                self.crossings(&seen.points).map_err(|reason| reason + &self.untold(&seen.gaps))?
            }
        };
        if matches!(self.find.wanted, Wanted::HalfPlaneWithin(_)) {
            // From the last crossing on it stays within.
            places.reverse();
        }
        let (point, off, solution) = self.settled(places[0])?;
        let value = self.value(point.at);
        let error = self.relative(value) * off;
        let settled = |place: &(f64, Moved)| self.settled(*place).map_or(place.0, |(point, ..)| point.at);
        let others = places[1..].iter().map(settled).map(|at| self.value(at)).collect();
        let is_at_end = matches!(places[0].1, Moved::ByRoot(_)) && (point.at <= 0.0 || point.at >= 1.0);
        Ok((Found { field: self.find.field.clone(), value, error, others, is_at_end }, solution))
    }

    /// An answer seen with all that is asked for, and how far off its place may be. It was looked for with solutions
    /// for the number alone, which may be rougher: where the number is not as wanted after all, one step along its
    /// slope is taken.
    fn settled(&self, (at, moved): (f64, Moved)) -> Result<(Point, f64, Solution), String> {
        let see = |at: f64| {
            let solution = self.solution(self.value(at), false).map_err(|why| self.placed(at, &why))?;
            self.seen(at, &solution).map(|point| (point, solution))
        };
        let (mut point, mut solution) = see(at)?;
        let tolerance = solution.scene.solver.tolerance.get();
        let Moved::BySlope(slope) = moved else {
            let off = moved.by(point.error.max(self.point(at)?.error));
            return Ok((point, off + tolerance, solution));
        };
        let slope = self.slope(at).unwrap_or(slope);
        if !point.may_be_hit()
            && let Ok((nearer, there)) = see((at - point.excess / slope).clamp(0.0, 1.0))
            && nearer.excess.abs() < point.excess.abs()
        {
            (point, solution) = (nearer, there);
        }
        let off = Moved::BySlope(slope).by(point.error + point.excess.abs());
        Ok((point, off + tolerance, solution))
    }

    /// The slope of the number around a place, where it can be told.
    fn slope(&self, at: f64) -> Option<f64> {
        let (lower, upper) = ((at - BESIDE).max(0.0), (at + BESIDE).min(1.0));
        let (one, other) = (self.excess(lower).ok()?, self.excess(upper).ok()?);
        Some((other - one) / (upper - lower)).filter(|slope| *slope != 0.0)
    }

    /// Values of the field at equal steps. At least two can be solved, and they differ by more than their errors.
    fn look_over(&self) -> Result<Seen, String> {
        let (mut points, mut gaps) = (Vec::new(), Vec::new());
        for step in 0..=STEPS {
            let at = f64::from(step) / f64::from(STEPS);
            match self.point(at) {
                Ok(point) => points.push(point),
                Err(why) => gaps.push((at, why)),
            }
        }
        if let Some((at, why)) = gaps.last().filter(|_| points.len() < 2) {
            return Err(self.placed(*at, why));
        }
        // The excess over a large target has no digits of the number.
        let most = points.iter().fold(f64::NEG_INFINITY, |most, point| most.max(point.number - point.error));
        let least = points.iter().fold(f64::INFINITY, |least, point| least.min(point.number + point.error));
        // How far a half-plane is off may well be nothing anywhere: that is told as such.
        if most <= least && !matches!(self.find.wanted, Wanted::HalfPlaneWithin(_)) {
            return Err(self.constant() + &self.untold(&gaps));
        }
        Ok(Seen { points, gaps })
    }

    /// Where the number is as wanted, over the range taken as 0 to 1.
    fn crossings(&self, points: &[Point]) -> Result<Vec<(f64, Moved)>, String> {
        let step = f64::from(STEPS).recip();
        let places: Vec<Place> = points.iter().map(Point::place).collect();
        let runs = || places.chunk_by(|one, other| other.0 - one.0 < 1.5 * step);
        let mut found = self.roots(runs().flat_map(|run| run.windows(2)).map(|pair| [pair[0], pair[1]]), JUMP)?;
        found.extend(runs().flat_map(|run| self.turns(run)));
        // Steps may hit it.
        self.is_no_plateau(points, |pair| pair.iter().any(|point| point.excess == 0.0))?;
        let hit = places.windows(2).filter(|pair| pair[0].1 == 0.0 || pair[1].1 == 0.0);
        found.extend(hit.map(|pair| (pair[usize::from(pair[0].1 != 0.0)].0, by_slope([pair[0], pair[1]]))));
        if found.is_empty() {
            // Or it lies between a value that can be told and one that cannot.
            let ends = places.iter().flat_map(|place| [place.0 - step, place.0 + step].map(|end| (*place, end)));
            let ends = ends.filter(|(_, end)| (-BESIDE..=1.0 + BESIDE).contains(end));
            found = self.roots(ends.map(|(place, end)| [place, self.reached(points, place, end)]), JUMP)?;
        }
        if found.is_empty() && matches!(self.find.wanted, Wanted::Target(_)) {
            // Or it is a value told, but for less than its error.
            self.is_no_plateau(points, |_| true)?;
            let nearly =
                points.windows(2).filter_map(|pair| Some((pair, pair.iter().find(|point| point.may_be_hit())?)));
            found.extend(nearly.map(|(pair, hit)| (hit.at, by_slope([pair[0].place(), pair[1].place()]))));
        }
        if matches!(self.find.wanted, Wanted::Target(_)) {
            found.extend(hit_at_ends(points, &found));
        }
        found.sort_by(|one, other| one.0.total_cmp(&other.0));
        found.dedup_by(|one, other| one.0.to_bits() == other.0.to_bits());
        if found.is_empty() {
            return Err(self.missed(points));
        }
        if matches!(self.find.wanted, Wanted::HalfPlaneWithin(_))
            && points.last().is_none_or(|p| p.excess > 0.0 || p.at < 1.0)
        {
            return Err(self.outside_at_end());
        }
        Ok(found)
    }

    /// The crossings between places, of a run of steps, at which the number has not crossed what is wanted, but turns
    /// near it.
    fn turns(&self, run: &[Place]) -> Vec<(f64, Moved)> {
        let mut found = Vec::new();
        for (i, three) in run.windows(3).enumerate() {
            let sign = three[1].1.signum();
            let [one, middle, other] = [0, 1, 2].map(|i| sign * three[i].1);
            let nearest = one.min(middle).min(other);
            // Each turn once: around the nearest place, which may be an end of the run.
            let is_first = i == 0 && one <= middle.min(other);
            let is_last = i + 3 == run.len() && other < middle.min(one);
            let is_around = middle < one && middle <= other || is_first || is_last;
            // The parabola through them: where it turns, in steps, and how far below the nearest.
            let (rise, bend) = (0.5 * (other - one), one - 2.0 * middle + other);
            let turn = 1.0 - rise / bend;
            let falls = nearest - middle + 0.5 * rise * rise / bend;
            let comes_near = (0.0..=2.0).contains(&turn) && nearest < DEEPER * falls + SHALLOW * bend;
            if nearest > 0.0 && is_around && comes_near {
                let highest = one.max(middle).max(other);
                let lowest = self.lowest(sign, [three[0].0, three[2].0], highest);
                let between = |lowest| self.roots([[three[0], lowest], [lowest, three[2]]].into_iter(), SMALL_JUMP);
                // What cannot be solved on the way is no answer.
                found.extend(lowest.and_then(between).unwrap_or_default());
            }
        }
        found
    }

    /// Refuses a number that is as wanted, within its error, at a step and at the next one: any value between them
    /// answers. Of pairs of steps those count that are said to.
    fn is_no_plateau(&self, points: &[Point], counts: impl Fn(&[Point]) -> bool) -> Result<(), String> {
        let is_flat = |pair: &&[Point]| counts(pair) && pair.iter().all(Point::may_be_hit);
        let mut flat = points.windows(2).filter(is_flat);
        let Some(first) = flat.next() else { return Ok(()) };
        Err(self.plateau(first[0].number, first[0].at, flat.next_back().unwrap_or(first)[1].at))
    }

    /// The roots between places at which the excess has two signs; refuses one at which it jumps by more than that
    /// share.
    fn roots(&self, pairs: impl Iterator<Item = [Place; 2]>, jump: f64) -> Result<Vec<(f64, Moved)>, String> {
        let tolerance = self.study.scene.solver.tolerance.get();
        let crosses = |[one, other]: &[Place; 2]| one.1 < 0.0 && other.1 > 0.0 || one.1 > 0.0 && other.1 < 0.0;
        let closed_in = |pair: [Place; 2]| {
            let [one, other] = pair;
            let (from, to) = (one.0.min(other.0), one.0.max(other.0));
            let excess = |at| self.excess(at).map_err(|why| self.placed(at, &why));
            let found = root::bracketed((from, to), tolerance.min(NEAR * (to - from)), excess);
            let Bracketed { at, value: left, .. } = found.map_err(|error| match error {
                RootError::Evaluation(why) => why,
                other => other.to_string(),
            })?;
            let value = self.value(at);
            if left.abs() > jump * (other.1 - one.1).abs()
                && left.abs() > self.excess_error(&self.solution(value, true)?)
            {
                return Err(self.jump(value));
            }
            Ok((at, by_slope(pair)))
        };
        pairs.filter(crosses).map(closed_in).collect()
    }
}

/// The ends of the range at which the number is as wanted, but for less than its error: beside one a root may be lost
/// to rounding. Not where one was found between it and its neighbour, nor where that is as wanted as the end.
fn hit_at_ends(points: &[Point], found: &[(f64, Moved)]) -> Vec<(f64, Moved)> {
    let [first, second, ..] = points else { return Vec::new() };
    let [.., last_but_one, last] = points else { return Vec::new() };
    let is_hit = |end: &Point, beside: &Point| {
        let between = end.at.min(beside.at)..=end.at.max(beside.at);
        end.may_be_hit() && !beside.may_be_hit() && !found.iter().any(|(at, _)| between.contains(at))
    };
    [(first, second), (last, last_but_one)]
        .into_iter()
        .filter(|(end, beside)| (end.at <= 0.0 || end.at >= 1.0) && is_hit(end, beside))
        .map(|(end, beside)| (end.at, by_slope([end.place(), beside.place()])))
        .collect()
}

/// The slope from one place to another.
fn by_slope([one, other]: [Place; 2]) -> Moved {
    Moved::BySlope((other.1 - one.1) / (other.0 - one.0))
}
