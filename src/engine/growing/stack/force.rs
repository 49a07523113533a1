//! The force of a stack over its half-widths, as series piece by piece.

use super::{ROUNDING, Stack};
use crate::engine::growing::family::{Family, Slice};
use crate::engine::numerics::chebyshev::{Points, Series};
use crate::engine::numerics::lanes::LANES;
use crate::engine::problem::Problem;

/// Coefficients of the force over a piece that are tried first; twice as many follow. The fewer leave out 2e-9, 2e-7
/// and 2e-6 on layers 50, 5 and 1 half-widths thick, and are not tried where less than this is to be left.
const COEFFICIENTS: [usize; 2] = [12, 24];
const OF_FEWER: f64 = 1e-7;
/// Most of them; fewer where twice as many from so many on are no better.
const MOST_COEFFICIENTS: usize = 384;
const STALLING: usize = 48;
/// What twice as many leave of what a series misses that is singular at the tip: more of them are worth less than a cut
/// nearer to it.
const SLOW: f64 = 0.1;
/// What a pressure exactly at a kink misses, over what the series does of the rate there: one that goes with a low
/// power of the distance has most of it nearest to the kink.
const AT_KINK: f64 = 4.0;
/// Root of the distance from where a piece begins in which its force is a series; over the first piece that of the flat
/// punches, if higher.
const ROOT: u32 = 2;
/// Over a piece shorter than this, beside where it ends, the force hardly grows: what its series does below rounding
/// would be no small part of that.
const SHORT: f64 = 1e-3;
/// A height below this, beside the others of a shape, is none.
const FAINTEST: f64 = 1e-290;

/// The force between two half-widths at which the shape is not analytic.
pub(super) struct Piece {
    pub(super) from: f64,
    pub(super) to: f64,
    /// In this root of the distance from where it begins the force is a series.
    root: u32,
    force: Force,
}

/// How the force is written.
enum Force {
    /// From a point: `rho` times the height, which is `kappa b' g'(b')`; both series in a root of `b'/to`. So the force
    /// has the order of the shape from the start. A height that a formula gives may have lost all digits there, a slope
    /// has not.
    OfHeight { rho: Series, kappa: Series },
    /// From the end of a face, without a corner: `s^2` times a series in `s = ((b' - from)/(to - from))^(1/2)`. There
    /// is no force at first, and it begins to grow at no rate: what the series misses of that is felt all over the
    /// face's end.
    FromFace(Series),
    /// From anywhere else: a series in `s`. Only beyond a corner its slope there is more than what the series misses;
    /// what it feigns elsewhere is taken off as far as its points do not reach: a rate that goes with `1/s` would be
    /// felt at the kink itself, where the pressure of what is stacked does so, too. (A series for the growth over
    /// `s^2`, as from a face, would be of rounding: here there is a force already.)
    Plain { series: Series, feigned: f64 },
}

impl Force {
    /// Whether a series from a tip is not analytic there.
    fn is_singular_at_tip(&self) -> bool {
        let Self::OfHeight { rho, kappa } = self else { return false };
        [rho, kappa].into_iter().any(|series| series.left_of_power().is_some())
    }
}

/// A piece, what its series leaves out of the force, relative, and what of the pressure at a kink where it begins.
pub(super) struct Made {
    pub(super) piece: Piece,
    pub(super) missed: f64,
    pub(super) at_kink: f64,
}

impl Stack {
    /// The force over a piece, with as many coefficients as the digits wanted take.
    pub(super) fn piece(&mut self, problem: &Problem, family: &mut Family, ends: (f64, f64), digits: f64) -> Made {
        let (from, to) = ends;
        let root = if from == 0.0 { family.root().max(ROOT) } else { ROOT };
        let mut count = COEFFICIENTS[usize::from(digits < OF_FEWER)];
        let mut before = f64::INFINITY;
        let mut best: Option<(f64, f64, Force)> = None;
        loop {
            let points = Points::get(count);
            let (force, missed) = if from == 0.0 {
                self.fit_of_height(problem, family, (to, root), &points)
            } else if from <= self.breaks[0] && !problem.is_corner(from) {
                self.fit_from_face(problem, family, ends, &points)
            } else {
                self.fit_plain(problem, family, ends, &points)
            };
            // A kink at the beginning feels the rate of the force, which a plain series misses by so much more than the
            // force.
            let felt = if matches!(force, Force::Plain { .. }) { (count * count) as f64 } else { 1.0 };
            let is_enough = missed < (digits / felt).max(ROUNDING);
            let slow = if force.is_singular_at_tip() { SLOW } else { 0.5 };
            let is_vain = missed.is_nan() || count >= STALLING && missed > slow * before;
            // Where more coefficients tell no more of the force they tell less of its rate.
            if is_enough || best.as_ref().is_none_or(|(least, ..)| felt * missed < *least) {
                best = Some((felt * missed, missed, force));
            }
            if is_enough || is_vain || 2 * count > MOST_COEFFICIENTS {
                let (felt_missed, missed, force) = best.expect("one at least");
                let piece = Piece { from, to, root, force };
                let share = self.share_at_kink(problem, &piece);
                let at_kink = if is_enough { 0.0 } else { AT_KINK * felt_missed * share };
                let missed = missed.max(piece.felt_of_width(problem));
                return Made { piece, missed, at_kink };
            }
            (before, count) = (missed, 2 * count);
        }
    }

    /// How large a pressure the force of a piece would make where it begins, all of it having grown over the piece,
    /// beside that of the widest contact; no more than 1.
    fn share_at_kink(&self, problem: &Problem, piece: &Piece) -> f64 {
        let Piece { from, to, .. } = *piece;
        let made = piece.force(problem, to) / (2.0 * from * (to - from)).sqrt();
        let widest = self.breaks.last().map_or(0.0, |widest| problem.slope(*widest)) / (2.0 * problem.elastic.a0());
        // A quotient of zeros counts in full.
        (made / widest).abs().min(1.0)
    }

    /// [`Force::OfHeight`], and what the series leave out of all the force that the middle feels.
    fn fit_of_height(
        &mut self,
        problem: &Problem,
        family: &mut Family,
        (to, root): (f64, u32),
        points: &Points,
    ) -> (Force, f64) {
        let count = points.at.len();
        let (mut rhos, mut kappas) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for s in &points.at {
            let b = to * s.powi(root.cast_signed());
            let (force, mean) = self.force_and_mean_slope(problem, family, b);
            let slope = problem.slope(b);
            // Slopes too small for a number with all its digits: as if they went on as they are farther out.
            let (rho, kappa) = if b * mean < FAINTEST || slope == 0.0 {
                (*rhos.last().unwrap_or(&0.0), *kappas.last().unwrap_or(&1.0))
            } else {
                (force / (b * mean), mean / slope)
            };
            rhos.push(rho);
            kappas.push(kappa);
        }
        let (rho, kappa) = (points.through(&rhos), points.through(&kappas));
        // Beside what both are at the end: close to the tip they may be of rounding.
        let left = |series: &Series| series.left_of_power().unwrap_or_else(|| series.last());
        let tail = (left(&rho) / rhos[0]).abs().max((left(&kappa) / kappas[0]).abs());
        // Of all that is pressed on the middle, so much is while the contact grows to the end of this piece.
        let widest = self.breaks.last().map_or(0.0, |widest| problem.slope(*widest));
        let share = (problem.slope(to) / widest).abs().min(1.0);
        (Force::OfHeight { rho, kappa }, share * tail)
    }

    /// [`Force::FromFace`], and what the series leaves out.
    fn fit_from_face(
        &mut self,
        problem: &Problem,
        family: &mut Family,
        ends: (f64, f64),
        points: &Points,
    ) -> (Force, f64) {
        let forces = self.forces(problem, family, ends, points);
        let values: Vec<f64> = forces.zip(&points.at).map(|(force, s)| force / (s * s)).collect();
        let series = points.through(&values);
        let tail = series.tail();
        (Force::FromFace(series), tail)
    }

    /// [`Force::Plain`], and what the series leaves out, or what is taken off it.
    fn fit_plain(&mut self, problem: &Problem, family: &mut Family, ends: (f64, f64), points: &Points) -> (Force, f64) {
        let values: Vec<f64> = self.forces(problem, family, ends, points).collect();
        let mut series = points.through(&values);
        let tail = series.tail();
        if ends.1 - ends.0 < SHORT * ends.1 {
            series.cut(f64::EPSILON);
        }
        let feigned = if problem.is_corner(ends.0) { 0.0 } else { series.value_and_slope(0.0).1 };
        // With a rate that is all but that of a corner what is taken off was there.
        let taken = (feigned / values.len().pow(2) as f64 / values[0]).abs();
        (Force::Plain { series, feigned }, tail.max(taken))
    }

    /// The force where a series in `s` has its points.
    fn forces<'a>(
        &'a mut self,
        problem: &'a Problem,
        family: &'a mut Family,
        (from, to): (f64, f64),
        points: &'a Points,
    ) -> impl Iterator<Item = f64> + 'a {
        points.at.iter().map(move |s| self.force_by_tilt(problem, family, (from, (to - from) * s * s)))
    }
}

impl Piece {
    /// Whether it begins at a tip where no series is analytic.
    pub(super) fn is_singular_at_tip(&self) -> bool {
        self.force.is_singular_at_tip()
    }

    /// What the series leaves out of the force at a half-width, relative to that force. A series of the force itself is
    /// as good as its largest coefficient has digits; beside the force close to where the piece begins that may be
    /// anything.
    ///
    /// Measured under `|x|^64` on a layer of 0.56 half-widths, at 0.3 of the half-width: the force there is 2e-34 of
    /// the last, and was -0.5 of what it is.
    pub(super) fn missed_at(&self, problem: &Problem, b: f64) -> f64 {
        let s = self.variable((b - self.from).max(0.0));
        let missed = match &self.force {
            Force::OfHeight { rho, kappa } => {
                let part = |series: &Series| series.last() / series.value_and_slope(s).0.abs();
                part(rho).max(part(kappa))
            }
            Force::FromFace(series) => series.missed(ROUNDING) / series.value_and_slope(s).0.abs(),
            Force::Plain { series, .. } => series.missed(ROUNDING) / self.force(problem, b).max(0.0),
        };
        // A quotient of zeros misses nothing: there is no force.
        if missed.is_nan() { 0.0 } else { missed }
    }

    /// The force at a half-width.
    pub(super) fn force(&self, problem: &Problem, b: f64) -> f64 {
        let s = self.variable(b - self.from);
        let (series, kappa) = self.series();
        self.told(problem, (b, s), series.value_and_slope(s), kappa.map_or(0.0, |kappa| kappa.value_and_slope(s).0)).0
    }

    /// Multiplies what slices weigh by the rate `dP/db'` of the force there; their distances to the lower end are not
    /// left to differences.
    pub(super) fn weigh(&self, problem: &Problem, slices: &mut [Slice], from_lower: &[f64]) {
        let (series, kappa) = self.series();
        for (slices, from_lower) in slices.chunks_mut(LANES).zip(from_lower.chunks(LANES)) {
            let mut s = [0.0; LANES];
            s.iter_mut().zip(from_lower).for_each(|(s, from_lower)| *s = self.variable(*from_lower));
            let (values, rises) = series.values_and_slopes(&s);
            let kappas = kappa.map_or([0.0; LANES], |kappa| kappa.values_and_slopes(&s).0);
            for (i, slice) in slices.iter_mut().enumerate() {
                slice.force *= self.told(problem, (slice.half_width, s[i]), (values[i], rises[i]), kappas[i]).1;
            }
        }
    }

    /// What rounding of the ends makes of the force: between two close to each other it grows all the same.
    fn felt_of_width(&self, problem: &Problem) -> f64 {
        if self.from == 0.0 || !problem.rounds_lengths() {
            return 0.0;
        }
        let [first, last] = [self.from, self.to].map(|b| self.force(problem, b));
        f64::EPSILON * self.to / (self.to - self.from) * ((last - first) / last).abs()
    }

    /// What the series go with.
    fn variable(&self, from_lower: f64) -> f64 {
        let part = from_lower / (self.to - self.from);
        if self.root == ROOT { part.sqrt() } else { part.powf(f64::from(self.root).recip()) }
    }

    /// The series, and that of `kappa`.
    fn series(&self) -> (&Series, Option<&Series>) {
        match &self.force {
            Force::OfHeight { rho, kappa } => (rho, Some(kappa)),
            Force::FromFace(series) | Force::Plain { series, .. } => (series, None),
        }
    }

    /// The force at a half-width and its rate, of the series there.
    fn told(&self, problem: &Problem, (b, s): (f64, f64), (value, rise): (f64, f64), kappa: f64) -> (f64, f64) {
        let width = self.to - self.from;
        match &self.force {
            Force::OfHeight { .. } => {
                // Where the shape has a kink at the end, its slope before that.
                let slope = problem.slope_before(self.to, b);
                let height = kappa * b * slope;
                (height * value, slope * value + height * rise * s / (f64::from(self.root) * b))
            }
            Force::FromFace(_) => (s * s * value, (value + 0.5 * s * rise) / width),
            Force::Plain { series, feigned } => {
                // As far as the first of the points, as they crowd.
                let unseen = (-s * (series.len() as f64).powi(2)).exp();
                (value, (rise - feigned * unseen) / (2.0 * s * width))
            }
        }
    }
}
