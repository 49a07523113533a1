//! Chebyshev interpolant of an even analytic function on `[-reach, reach]`.

use std::f64::consts::PI;

/// Values summed side by side, so that the recurrence runs in vector registers.
const LANES: usize = 8;

/// `f(t) = sum_k c_k T_k(2 (t/reach)^2 - 1)`: parity is built in and halves the terms.
#[derive(Clone, Debug)]
pub(crate) struct EvenSeries {
    reach: f64,
    coefficients: Vec<f64>,
}

impl EvenSeries {
    /// The `n` abscissae in `(0, reach)` at which an interpolant wants its function.
    pub(crate) fn nodes(reach: f64, n: usize) -> Vec<f64> {
        // (1 + cos a)/2 = cos^2(a/2): the square root costs no digits.
        (0..n).map(|j| reach * (PI * (2 * j + 1) as f64 / (4 * n) as f64).cos()).collect()
    }

    /// The interpolant through `values` at [`Self::nodes`].
    ///
    /// Trailing coefficients below round-off of the largest are dropped.
    pub(crate) fn through(reach: f64, values: &[f64]) -> Self {
        let n = values.len();
        let cosines: Vec<f64> = (0..4 * n).map(|m| (PI * m as f64 / (2 * n) as f64).cos()).collect();
        let mut coefficients: Vec<f64> = (0..n)
            .map(|k| {
                let sum: f64 = values.iter().enumerate().map(|(j, v)| v * cosines[k * (2 * j + 1) % (4 * n)]).sum();
                sum * if k == 0 { 1.0 } else { 2.0 } / n as f64
            })
            .collect();
        let largest = coefficients.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
        let kept = coefficients.iter().rposition(|c| c.abs() > 0.5 * f64::EPSILON * largest).map_or(1, |k| k + 1);
        coefficients.truncate(kept);
        Self { reach, coefficients }
    }

    /// `out[i] = f(t[i])` (Clenshaw).
    pub(crate) fn eval_into(&self, t: &[f64], out: &mut [f64]) {
        for (t, out) in t.chunks(LANES).zip(out.chunks_mut(LANES)) {
            let mut twice_y = [0.0; LANES];
            for (y, t) in twice_y.iter_mut().zip(t) {
                let tau = t / self.reach;
                *y = 4.0 * tau * tau - 2.0;
            }
            let (mut older, mut newer) = ([0.0; LANES], [0.0; LANES]);
            for &c in self.coefficients.iter().skip(1).rev() {
                for lane in 0..LANES {
                    let next = twice_y[lane] * newer[lane] - older[lane] + c;
                    older[lane] = newer[lane];
                    newer[lane] = next;
                }
            }
            for (lane, out) in out.iter_mut().enumerate() {
                *out = 0.5 * twice_y[lane] * newer[lane] - older[lane] + self.coefficients[0];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resolves_a_band_limited_function_to_round_off() {
        let (reach, s) = (2.0, 30.0);
        let f = |t: f64| (s * t).cos();
        let values: Vec<f64> = EvenSeries::nodes(reach, 60).into_iter().map(f).collect();
        let series = EvenSeries::through(reach, &values);
        let t: Vec<f64> = (0..=100).map(|i| -reach + 2.0 * reach * f64::from(i) / 100.0).collect();
        let mut out = vec![0.0; t.len()];
        series.eval_into(&t, &mut out);
        for (t, got) in t.iter().zip(out) {
            // 60 terms of order one in s t: rounding of the argument s t = 60 dominates.
            assert!((got - f(*t)).abs() < 1e-13, "t = {t}: {got}");
        }
    }

    #[test]
    fn drops_terms_that_carry_nothing() {
        let values: Vec<f64> = EvenSeries::nodes(1.0, 40).into_iter().map(|t| 3.0 + t * t).collect();
        assert!(EvenSeries::through(1.0, &values).coefficients.len() <= 3);
    }
}
