//! One curve of a panel: force over a length.

use crate::report::svg::legend::Entry;
use crate::report::svg::panel::{Curve, MARKED};

/// The points of a curve, in the scene's units, and how it is drawn.
pub(super) struct Trace {
    pub(super) entry: Entry,
    /// Length and force; `None` where one of them is not known.
    points: Vec<Option<(f64, f64)>>,
    /// The length without a load, where it is known.
    start: Option<f64>,
}

/// Part of the last force up to which the first is near enough to the beginning for the curve to be continued to it.
const NEAR: f64 = 0.05;
/// Powers of the length that the force may begin with; 2 under a cylinder.
const POWERS: std::ops::RangeInclusive<f64> = 0.2..=20.0;

impl Trace {
    /// `None` where nothing is known.
    pub(super) fn new(
        entry: Entry,
        lengths: &[Option<f64>],
        force: &[Option<f64>],
        start: Option<f64>,
    ) -> Option<Self> {
        let points: Vec<_> = lengths.iter().zip(force).map(|(length, force)| length.zip(*force)).collect();
        let known: Vec<f64> = points.iter().flatten().map(|point| point.1).collect();
        let (first, last) = (known.first()?, known.last()?);
        let joined = points.first().is_some_and(Option::is_some) && *first <= NEAR * last;
        let entry = Entry { is_marked: known.len() <= MARKED, ..entry };
        Some(Self { entry, points, start: start.filter(|_| joined) })
    }

    /// The points that are known.
    fn points(&self) -> impl Iterator<Item = (f64, f64)> {
        self.points.iter().flatten().copied()
    }

    /// The largest length.
    pub(super) fn widest(&self) -> f64 {
        self.points().map(|point| point.0).fold(0.0, f64::max)
    }

    /// The curve in the units of the axes, its points marked where it has few.
    pub(super) fn curve(&self, unit: f64, force_unit: f64) -> Curve {
        let scaled = |(x, y): (f64, f64)| (x / unit, y / force_unit);
        let mut stretches: Vec<Vec<(f64, f64)>> = self
            .points
            .split(Option::is_none)
            .map(|known| known.iter().flatten().copied().map(scaled).collect())
            .collect();
        if let (Some(start), Some(first)) = (self.start, stretches.first_mut()) {
            let beginning = beginning(start / unit, first);
            first.splice(..0, beginning);
        }
        stretches.retain(|stretch| !stretch.is_empty());
        let marks = if self.entry.is_marked { self.points().map(scaled).collect() } else { Vec::new() };
        Curve { style: self.entry.style, stretches, marks }
    }
}

/// The curve from where there is no load to its first point: force begins as a power of the length that is added, the
/// one that the first two points tell.
fn beginning(start: f64, points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    const PARTS: u8 = 16;
    let [(x, y), rest @ ..] = points else { return Vec::new() };
    let power = rest.first().map(|next| (next.1 / y).ln() / ((next.0 - start) / (x - start)).ln());
    let power = power.filter(|power| POWERS.contains(power)).unwrap_or(1.0);
    let part = |i: u8| f64::from(i) / f64::from(PARTS);
    (0..PARTS).map(part).map(|t| (start + t * (x - start), y * t.powf(power))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::svg::canvas::thinned;
    use crate::report::svg::loading::CONTACT;

    fn trace(lengths: &[Option<f64>], start: f64) -> Option<Trace> {
        let force: Vec<Option<f64>> = (1..=lengths.len()).map(|i| Some(i as f64)).collect();
        Trace::new(CONTACT, lengths, &force, Some(start))
    }

    #[test]
    fn an_unknown_point_is_a_gap() {
        let trace = trace(&[Some(1.0), Some(2.0), None, Some(4.0)], 0.0).expect("a trace");
        assert_eq!(
            trace.curve(2.0, 1.0).stretches,
            [vec![(0.5, 1.0), (1.0, 2.0)], vec![(2.0, 4.0)]],
            "the first load is far from none"
        );
        assert!(self::trace(&[None, None], 0.0).is_none());
    }

    #[test]
    fn a_power_law_is_continued_to_its_beginning() {
        let lengths: Vec<Option<f64>> = (1..=60).map(|i| Some(1.0 + f64::from(i).sqrt())).collect();
        let trace = trace(&lengths, 1.0).expect("a trace");
        for (x, y) in trace.curve(1.0, 1.0).stretches.concat() {
            assert!((y - (x - 1.0).powi(2)).abs() < 1e-12 * y.max(1.0), "{x}, {y}: rounding of a power");
        }
    }

    #[test]
    fn a_curve_of_many_loads_begins_without_one() {
        let lengths: Vec<Option<f64>> = (1..=100_000).map(|i| Some(f64::from(i))).collect();
        let trace = trace(&lengths, 0.5).expect("a trace");
        let points = thinned(&trace.curve(1.0, 1.0).stretches.concat(), |(x, y)| (x / 1e5, y / 1e5));
        assert_eq!((points.first(), points.last()), (Some(&(0.5, 0.0)), Some(&(1e5, 1e5))));
        assert!((900..1100).contains(&points.len()), "{} points of a line that has 100000", points.len());
    }
}
