//! An even analytic function on `[-reach, reach]`: interpolated once, evaluated often.

use std::f64::consts::PI;

/// The `n` abscissae in `(0, reach)` at which [`EvenTable::through`] wants its function.
///
/// They are Chebyshev nodes in `(t/reach)^2`: parity is built in and halves their number.
pub(crate) fn nodes(reach: f64, n: usize) -> Vec<f64> {
    // (1 + cos a)/2 = cos^2(a/2): the square root costs no digits.
    (0..n).map(|j| reach * (PI * (2 * j + 1) as f64 / (4 * n) as f64).cos()).collect()
}

/// Terms of each panel's polynomial.
const TERMS: usize = 14;
/// Phase `S t` that a panel covers: `cos(x)` over this range has Chebyshev coefficients below 1e-15 from
/// the term after the last on.
const PANEL_PHASE: f64 = 2.0;

/// A function of band `S` on equal panels of `|t|`, each a Chebyshev series of fixed length.
///
/// A global series needs about `S reach/2` terms a value; a panel needs 14 whatever the band.
#[derive(Clone, Debug)]
pub(crate) struct EvenTable {
    panels_per_length: f64,
    panels: Vec<[f64; TERMS]>,
}

impl EvenTable {
    /// Tabulates the function with these `values` at [`nodes`]; `band` is its highest wave number.
    pub(crate) fn through(reach: f64, band: f64, values: &[f64]) -> Self {
        let y_series = chebyshev(values);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a positive count; `as` saturates
        let count = ((band * reach / PANEL_PHASE).ceil() as usize).max(1);
        let panel = |k: usize| {
            let value = |j: usize| {
                let z = (PI * (2 * j + 1) as f64 / (2 * TERMS) as f64).cos();
                let tau = (k as f64 + 0.5 * (1.0 + z)) / count as f64;
                clenshaw(&y_series, 2.0 * tau * tau - 1.0)
            };
            let series = chebyshev(&std::array::from_fn::<f64, TERMS, _>(value));
            std::array::from_fn(|k| series[k])
        };
        Self { panels_per_length: count as f64 / reach, panels: (0..count).map(panel).collect() }
    }

    /// The function at `t`, of either sign, within the reach.
    pub(crate) fn at(&self, t: f64) -> f64 {
        let place = t.abs() * self.panels_per_length;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // not negative, and bounded
        let panel = (place as usize).min(self.panels.len() - 1);
        clenshaw(&self.panels[panel], 2.0 * (place - panel as f64) - 1.0)
    }
}

/// Chebyshev coefficients of the interpolant through values at `cos((2j + 1) pi/2n)`.
pub(crate) fn chebyshev(values: &[f64]) -> Vec<f64> {
    let n = values.len();
    let cosines: Vec<f64> = (0..4 * n).map(|m| (PI * m as f64 / (2 * n) as f64).cos()).collect();
    let coefficient = |k: usize| {
        let sum: f64 = values.iter().enumerate().map(|(j, v)| v * cosines[k * (2 * j + 1) % (4 * n)]).sum();
        sum * if k == 0 { 1.0 } else { 2.0 } / n as f64
    };
    (0..n).map(coefficient).collect()
}

/// `sum_k series[k] T_k(y)`.
pub(crate) fn clenshaw(series: &[f64], y: f64) -> f64 {
    let [sum] = clenshaw_in_lanes(series, [y]);
    sum
}

/// The same at some places, side by side.
#[inline(always)]
pub(crate) fn clenshaw_in_lanes<const N: usize>(series: &[f64], y: [f64; N]) -> [f64; N] {
    let (mut older, mut newer) = ([0.0; N], [0.0; N]);
    for c in series[1..].iter().rev() {
        let next = std::array::from_fn(|i| 2.0 * y[i] * newer[i] - older[i] + c);
        (older, newer) = (newer, next);
    }
    std::array::from_fn(|i| y[i] * newer[i] - older[i] + series[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn resolves_a_band_limited_function_to_round_off() {
        let (reach, band) = (2.0, 30.0);
        let f = |t: f64| (band * t).cos();
        let values: Vec<f64> = nodes(reach, 60).into_iter().map(f).collect();
        let table = EvenTable::through(reach, band, &values);
        for i in 0..=100 {
            let t = -reach + 2.0 * reach * f64::from(i) / 100.0;
            // 60 terms of order one; rounding of the phase 60 adds 1e-14.
            assert!((table.at(t) - f(t)).abs() < 5e-14, "t = {t}: {}", table.at(t));
        }
    }
}
