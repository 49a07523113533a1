//! Functions on `[0, 1]` known at Chebyshev points.
//!
//! L. N. Trefethen, *Approximation Theory and Approximation Practice* (SIAM, 2013), chapters 3 to 5 and 8.

use super::lanes::{Lanes, add_rows};
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::Shelf;
use std::f64::consts::FRAC_PI_2;
use std::sync::{Arc, OnceLock};

/// Room for the matrices of all points kept, 8 MB.
const KEPT: usize = 1 << 20;

static POINTS: Shelf<usize, Points> = Shelf::new(KEPT, |points| points.at.len().pow(2));

/// Chebyshev points of the first kind on `(0, 1)`, descending.
#[derive(Debug)]
pub(crate) struct Points {
    pub(crate) at: Vec<f64>,
    /// `coefficients[k * n + m]`: how much of the polynomial `m` a value at the point `k` is; made when first asked
    /// for.
    coefficients: OnceLock<Vec<f64>>,
}

impl Points {
    /// So many points.
    pub(crate) fn get(count: usize) -> Arc<Self> {
        POINTS.get(count, || {
            let angle = |k: usize| (2 * k + 1) as f64 * FRAC_PI_2 / count as f64;
            // (1 + cos)/2, without cancellation near 0.
            let at = (0..count).map(|k| (0.5 * angle(k)).cos().powi(2)).collect();
            Self { at, coefficients: OnceLock::new() }
        })
    }

    /// The polynomial through values at the points.
    pub(crate) fn through(&self, values: &[f64]) -> Series {
        let mut series = vec![0.0; self.at.len()];
        self.through_into(values, &mut series);
        Series(series)
    }

    /// Writes the coefficients of the polynomial through values at the points.
    pub(crate) fn through_into(&self, values: &[f64], coefficients: &mut [f64]) {
        let n = self.at.len();
        assert_eq!((values.len(), coefficients.len()), (n, n), "one value and one coefficient per point");
        let of_points = self.coefficients.get_or_init(|| {
            let cosines: Vec<f64> = (0..4 * n).map(|j| (j as f64 * FRAC_PI_2 / n as f64).cos()).collect();
            let share =
                |k: usize, m: usize| cosines[(2 * k + 1) * m % (4 * n)] * if m == 0 { 1.0 } else { 2.0 } / n as f64;
            (0..n).flat_map(|k| (0..n).map(move |m| (k, m))).map(|(k, m)| share(k, m)).collect()
        });
        coefficients.fill(0.0);
        add_rows(values, of_points, coefficients);
    }
}

/// A Chebyshev series on `[0, 1]`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Series(Vec<f64>);

impl Series {
    /// Value and derivative (Clenshaw's recurrence).
    pub(crate) fn value_and_slope(&self, s: f64) -> (f64, f64) {
        let ([value], [slope]) = self.side_by_side(&[s]);
        (value, slope)
    }

    /// The same at some points.
    pub(crate) fn values_and_slopes(&self, s: &Lanes) -> (Lanes, Lanes) {
        Arch::new().dispatch(InLanes { series: self, s })
    }

    /// Compiled for the vectors of whoever asks.
    #[inline(always)]
    fn side_by_side<const N: usize>(&self, s: &[f64; N]) -> ([f64; N], [f64; N]) {
        let x = s.map(|s| 2.0 * s - 1.0);
        let ([mut b1, mut b2], [mut d1, mut d2]) = ([[0.0; N]; 2], [[0.0; N]; 2]);
        for c in self.0.iter().skip(1).rev() {
            for i in 0..N {
                (d1[i], d2[i]) = (2.0 * (b1[i] + x[i] * d1[i]) - d2[i], d1[i]);
                (b1[i], b2[i]) = (c + 2.0 * x[i] * b1[i] - b2[i], b1[i]);
            }
        }
        let first = self.0.first().copied().unwrap_or(0.0);
        let value = std::array::from_fn(|i| first + x[i] * b1[i] - b2[i]);
        (value, std::array::from_fn(|i| 2.0 * (b1[i] + x[i] * d1[i] - d2[i])))
    }

    /// Leaves out the last coefficients that are less than a share of the largest.
    pub(crate) fn cut(&mut self, share: f64) {
        let least = share * largest(&self.0);
        let count = self.0.iter().rposition(|c| c.abs() >= least).map_or(0, |last| last + 1);
        self.0.truncate(count);
    }

    /// Its number of coefficients.
    pub(crate) fn len(&self) -> usize {
        self.0.len()
    }

    /// How much of the largest coefficient the last few are: what the series misses is about as much.
    pub(crate) fn tail(&self) -> f64 {
        let all = largest(&self.0);
        if all > 0.0 { self.last() / all } else { 0.0 }
    }

    /// What it misses and what rounding makes of it, the same everywhere.
    pub(crate) fn missed(&self, rounding: f64) -> f64 {
        self.last() + rounding * largest(&self.0)
    }

    /// What those left out may add up to where they fall off like a power, as beside a singularity; `None` where they
    /// do so geometrically, or are of rounding. (Through points the last ones are too small: what is beyond them is
    /// taken off.)
    pub(crate) fn left_of_power(&self) -> Option<f64> {
        const ROUNDING: f64 = 1e-14;
        /// Of a power they fall by more than a half; those that hardly fall are of noise.
        const MOST: f64 = 0.55;
        /// Over the last octave those of a power fall as over the one before, those of a geometric series by the square
        /// of that.
        const BETWEEN: f64 = 1.5;
        let count = self.len();
        if count < 8 || self.last() <= ROUNDING * largest(&self.0) {
            return None;
        }
        let [early, middle, late] = [(count / 8, count / 4), (count / 4, count / 2), (count / 2, count)]
            .map(|(from, to)| largest(&self.0[from..to]));
        let (before, falls) = (middle / early, late / middle);
        // From the middle to the end, and as much less over the next half.
        let each = falls.sqrt();
        (falls > before.powf(BETWEEN) && falls < MOST).then(|| late * falls * count as f64 * each / (1.0 - each))
    }

    /// How large the last few are.
    pub(crate) fn last(&self) -> f64 {
        largest(&self.0[self.0.len().saturating_sub(3)..])
    }
}

/// See [`Series::values_and_slopes`].
struct InLanes<'a> {
    series: &'a Series,
    s: &'a Lanes,
}

impl WithSimd for InLanes<'_> {
    type Output = (Lanes, Lanes);

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> (Lanes, Lanes) {
        self.series.side_by_side(self.s)
    }
}

pub(crate) fn largest(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |most, number| most.max(number.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smooth_function_and_its_slope_come_back() {
        let points = Points::get(18);
        let f = |s: f64| (2.0 * s).exp() / (1.0 + s);
        let values: Vec<f64> = points.at.iter().map(|s| f(*s)).collect();
        let series = points.through(&values);
        // The pole at -1 is rho = 3 + sqrt 8 away: 5.8^-18 = 2e-14.
        assert!(series.tail() < 1e-11, "{}", series.tail());
        for s in [0.0, 1e-3, 0.3, 0.77, 1.0, points.at[4]] {
            let (value, slope) = series.value_and_slope(s);
            let exact = 2.0 * f(s) - f(s) / (1.0 + s);
            assert!((value - f(s)).abs() < 1e-12 && (slope - exact).abs() < 1e-10, "{value}, {slope} at {s}");
            let (values, slopes) = series.values_and_slopes(&std::array::from_fn(|i| s / (1 + i) as f64));
            assert_eq!((values[0], slopes[0]), (value, slope), "the same side by side with others");
            assert_eq!((values[2], slopes[2]), series.value_and_slope(s / 3.0));
        }
        assert!((points.at[0] - (0.5 * FRAC_PI_2 / 18.0).cos().powi(2)).abs() < 1e-15);
    }
}
