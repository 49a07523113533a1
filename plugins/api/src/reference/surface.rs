//! The surface of a half-plane under tractions given as functions: what the references are checked with.

use crate::double_exponential::nodes;
use std::f64::consts::PI;

/// `(1/pi) PV int_-b^b f(r)/(x - r) dr` for `x > 0`, not at a cut.
///
/// The pole is taken off with `f(x)`, whose own integral is `f(x) log((b + x)/(b - x))`; the interval is cut at `x`
/// and at `cuts`, of which those at negative `x` must be named too, so that whatever happens there happens at the end
/// of a double-exponential grid.
pub(super) fn cauchy(f: impl Fn(f64) -> f64, half_width: f64, cuts: &[f64], x: f64) -> f64 {
    let b = half_width;
    let mut ends: Vec<f64> = cuts.iter().copied().chain([-b, x, b]).collect();
    ends.sort_by(f64::total_cmp);
    let here = f(x);
    let mut sum = here * ((b + x) / (b - x)).ln();
    for piece in ends.windows(2) {
        let (lower, upper) = (piece[0], piece[1]);
        for node in nodes(upper - lower, 60) {
            // Beside the pole the difference is all rounding, on nodes whose weights are as small as their
            // distance: relative distances below 1e-12 are left out, and with them as much of the integral.
            let near = if upper <= x { x - upper + node.to_upper } else { lower - x + node.from_lower };
            if near < 1e-12 * b {
                continue;
            }
            // Measured from the nearer end, so that a node never lands beyond it.
            let r = if node.from_lower < node.to_upper { lower + node.from_lower } else { upper - node.to_upper };
            let distance = if upper <= x { near } else { -near };
            sum += node.weight * (f(r) - here) / distance;
        }
    }
    sum / PI
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pole_of_a_constant_and_of_a_line() {
        for x in [0.1, 0.7_f64] {
            let log = ((1.0 + x) / (1.0 - x)).ln() / PI;
            assert!((cauchy(|_| 1.0, 1.0, &[0.3], x) - log).abs() < 1e-15, "exact by construction");
            // r/(x - r) = x/(x - r) - 1
            let line = cauchy(|r| r, 1.0, &[-0.3, 0.3], x);
            assert!((line - (x * log - 2.0 / PI)).abs() < 1e-11, "the gap left out beside the pole: {line}");
        }
    }
}
