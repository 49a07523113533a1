//! Where a number is least, by Brent's method.

use super::seen::{Place, Point};
use super::{BESIDE, Moved, Question, STEPS};
use basin::{BoxBounds, Brent, ConstraintDescription, ConstraintSet, Constraints, CostFunction, Executor, PointState};

/// Iterations of a search that has a bracket.
const MOST: u64 = 100;

impl Question<'_> {
    /// Where `sign` times the excess is least between two places, and the excess there; `highest` is no less than it is
    /// around.
    pub(super) fn lowest(&self, sign: f64, [lower, upper]: [f64; 2], highest: f64) -> Result<Place, String> {
        let valley = Valley { question: self, sign, lower, upper, highest };
        let found = Executor::new(valley, Brent::new(), PointState::new(0.5 * (lower + upper)))
            .max_iter(MOST)
            .run()
            .map_err(|error| error.to_string())?;
        Ok((*found.param(), sign * found.cost()))
    }

    /// Where the number is least, over the range taken as 0 to 1.
    pub(super) fn least(&self, points: &[Point]) -> Result<(f64, Moved), String> {
        let order = |one: &&[Point], other: &&[Point]| one[1].excess.total_cmp(&other[1].excess);
        let around = points.windows(3).min_by(order).ok_or("too little of the range can be solved")?;
        let lower_of = |one: &Place, other: &Place| one.1.total_cmp(&other.1);
        let seen = points.iter().map(Point::place);
        let lowest = seen.clone().min_by(lower_of).unwrap_or((0.0, f64::INFINITY));
        let step = f64::from(STEPS).recip();
        let ends = [(lowest.0 - step).max(0.0), (lowest.0 + step).min(1.0)];
        let ends = ends.map(|end| self.reached(points, lowest, end));
        let highest = points.iter().fold(f64::NEG_INFINITY, |most, point| most.max(point.excess));
        let inside = self.lowest(1.0, ends.map(|end| end.0), highest)?;
        // A value that falls to the very end of what can be solved has its least there, where Brent's method does not
        // look.
        let (at, excess) = seen.chain(ends).chain([inside]).min_by(lower_of).unwrap_or(inside);
        self.is_surrounded(points, (at, excess))?;
        // Between the steps may be some that could not be solved.
        let slope = |one: &Point, other: &Point| (other.excess - one.excess) / (other.at - one.at);
        let half = 0.5 * (around[2].at - around[0].at);
        let bend = (slope(&around[1], &around[2]) - slope(&around[0], &around[1])) / half;
        Ok((at, Moved::ByRoot(bend)))
    }

    /// How far the number can be told on the way from a place where it can, and what it is there: to a place that was
    /// looked at, or to within [`BESIDE`] of one where it cannot.
    pub(super) fn reached(&self, points: &[Point], from: Place, to: f64) -> Place {
        if let Some(point) = points.iter().find(|point| (point.at - to).abs() < BESIDE) {
            return point.place();
        }
        let (mut told, mut untold) = (from, to);
        while (untold - told.0).abs() > BESIDE {
            let middle = f64::midpoint(told.0, untold);
            match self.excess(middle) {
                Ok(excess) => told = (middle, excess),
                Err(_) => untold = middle,
            }
        }
        told
    }

    /// Refuses a least value beside which nothing can be solved, as the number may go on falling there, and one that is
    /// the same beside: it is rounded, to nothing or to a whole.
    fn is_surrounded(&self, points: &[Point], (at, excess): Place) -> Result<(), String> {
        let [lower, upper] = [(at - BESIDE).max(0.0), (at + BESIDE).min(1.0)];
        let beside =
            |beside| self.excess(beside).map_err(|why| self.at_end_of_solved(at, excess) + &self.placed(beside, &why));
        let beside = [(lower, beside(lower)?), (upper, beside(upper)?)];
        let is_same = |there: &Place| there.1.to_bits() == excess.to_bits();
        if !beside.iter().any(|there| (there.0 - at).abs() > 0.0 && is_same(there)) {
            return Ok(());
        }
        let same = points.iter().map(Point::place).chain(beside).filter(is_same).map(|there| there.0);
        let (from, to) = same.fold((at, at), |(from, to), at| (at.min(from), at.max(to)));
        Err(self.plateau(self.number_of(excess), from, to))
    }
}

/// A stretch of the range in which the least value lies.
struct Valley<'a> {
    question: &'a Question<'a>,
    /// 1, or -1 where the largest is looked for.
    sign: f64,
    lower: f64,
    upper: f64,
    /// No less than any value around.
    highest: f64,
}

impl Constraints for Valley<'_> {
    type Set = ConstraintSet<BoxBounds<f64>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new().with_bounds(BoxBounds::new(Some(&self.lower), Some(&self.upper)))
    }
}

impl CostFunction for Valley<'_> {
    type Param = f64;
    type Output = f64;
    type Error = std::convert::Infallible;

    fn cost(&self, at: &f64) -> Result<f64, Self::Error> {
        // What cannot be solved is no place for the least.
        Ok(self.question.excess(*at).map_or(self.highest, |excess| self.sign * excess))
    }
}
