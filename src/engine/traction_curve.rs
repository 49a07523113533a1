//! A traction over part of the contact, told at many points from its values at a few.

use super::chebyshev::{Points, Series};
use std::f64::consts::FRAC_PI_2;

/// Asked for so many points or fewer, a traction is not worth a curve.
pub(crate) const WORTH: usize = 48;
/// Points of a piece: at least, and per decimal digit.
const POINTS: (f64, f64) = (10.0, 3.0);

/// A traction between points at which it is not analytic, like half-integer powers or `x log x`.
pub(crate) struct TractionCurve {
    pieces: Vec<Piece>,
}

struct Piece {
    from: f64,
    to: f64,
    series: Series,
}

impl TractionCurve {
    /// The curve through values over pieces that ascend; `digits` is the error wanted.
    pub(crate) fn new(ends: &[f64], digits: f64, mut value: impl FnMut(f64) -> f64) -> Self {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few dozen
        let points = Points::new((POINTS.0 - POINTS.1 * digits.log10()) as usize);
        let piece = |ends: &[f64]| {
            let (from, to) = (ends[0], ends[1]);
            let values: Vec<f64> = points.at.iter().map(|s| value(from + (to - from) * part(*s))).collect();
            Piece { from, to, series: points.through(&values) }
        };
        Self { pieces: ends.windows(2).filter(|ends| ends[0] < ends[1]).map(piece).collect() }
    }

    /// The traction at a point within the pieces.
    pub(crate) fn value(&self, x: f64) -> f64 {
        let Some(piece) = self.pieces.iter().find(|piece| x <= piece.to).or(self.pieces.last()) else { return 0.0 };
        let part = ((x - piece.from) / (piece.to - piece.from)).clamp(0.0, 1.0);
        piece.series.value_and_slope(whole(part)).0
    }
}

/// `sin^2((pi/2) sin^2(pi s/2))`, which leaves and reaches its ends with the fourth power: what is not analytic there goes
/// with the eighth power of the points or faster.
fn part(s: f64) -> f64 {
    (FRAC_PI_2 * (FRAC_PI_2 * s).sin().powi(2)).sin().powi(2)
}

/// The inverse of [`part`].
fn whole(part: f64) -> f64 {
    (part.sqrt().asin() / FRAC_PI_2).sqrt().asin() / FRAC_PI_2
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithms_and_square_roots_are_told() {
        let f = |x: f64| {
            let log = if x > 0.0 { x * x.ln() } else { 0.0 };
            log + (1.0 - x).powf(1.5) + (2.0 * x).cos()
        };
        let curve = TractionCurve::new(&[0.0, 1.0], 1e-10, f);
        for i in 0..=200 {
            let x = f64::from(i) / 200.0;
            let error = (curve.value(x) - f(x)).abs();
            assert!(error < 1e-9, "{error:e} at {x}");
        }
        assert!((part(whole(0.3)) - 0.3).abs() < 1e-15);
    }
}
