//! Double-exponential grids (H. Takahasi, M. Mori, Publ. RIMS 9 (1974) 721) that know the distance of
//! each node to both ends.
//!
//! `x = lower + length/(1 + exp(-pi sinh u))` turns an integral over `[lower, lower + length]` into one
//! over all `u`, whose integrand decays double-exponentially even where the original has an integrable
//! singularity at an end. The trapezoidal rule in `u` then converges exponentially. Nodes crowd at the
//! ends far more closely than floating point numbers do, which is why a node says how far it is from
//! each end and not where it is.

use crate::Station;
use crate::elementary::{asinh, ln_1p};
use std::f64::consts::PI;

/// A quadrature node: `int f dx = sum weight f`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// Distance to the lower end, to full relative precision.
    pub from_lower: f64,
    /// Distance to the upper end, to full relative precision.
    pub to_upper: f64,
    /// Weight, a length.
    pub weight: f64,
}

/// Where [`nodes`] ends in `u`: the outermost gap is `6e-38 length`, so that an end singularity
/// `gap^(-1/2)` loses 2.4e-19 of its integral, below rounding.
pub const U_MAX: f64 = 4.0;

/// The largest `u` that [`nodes_up_to`] accepts; the gaps are then `1e-275 length`.
const U_LIMIT: f64 = 6.0;

/// A grid of `n` nodes on each side of the middle, `2 n + 1` in all, ascending.
///
/// Doubling `n` about squares the error; `n = 24` integrates a function that varies slowly inside to
/// rounding, whatever its algebraic or logarithmic singularities at the ends. Oscillations and a
/// singularity close outside cost more nodes.
///
/// # Panics
/// When `n` is 0 or `length` is not finite and positive.
pub fn nodes(length: f64, n: usize) -> Vec<Node> {
    nodes_up_to(length, n, U_MAX)
}

/// As [`nodes`], with the outermost nodes at `u = +-u_max`.
///
/// A smaller `u_max` spends its nodes on the inside, which pays where only a few digits are wanted.
///
/// # Panics
/// When `n` is 0, `length` is not finite and positive, or `u_max` not in `(0, 6]`.
pub fn nodes_up_to(length: f64, n: usize, u_max: f64) -> Vec<Node> {
    assert!(n > 0, "a double-exponential grid needs nodes beside the middle");
    assert!(length > 0.0 && length < f64::INFINITY, "length = {length} is no interval");
    assert!(u_max > 0.0 && u_max <= U_LIMIT, "u_max = {u_max} is outside (0, {U_LIMIT}]");
    let step = u_max / n as f64;
    let half: Vec<_> = (0..=n).map(|j| upper_half_node(length, step, j)).collect();
    let mirrored = half[1..].iter().rev().map(|node| Node {
        from_lower: node.to_upper,
        to_upper: node.from_lower,
        weight: node.weight,
    });
    mirrored.chain(half.iter().copied()).collect()
}

/// The node at `u = j step >= 0`.
fn upper_half_node(length: f64, step: f64, j: usize) -> Node {
    let u = j as f64 * step;
    // Only decaying exponentials: nothing overflows, and the small distance keeps its digits.
    let ratio = (-PI * u.sinh()).exp(); // to_upper : from_lower
    let fraction = 1.0 / (1.0 + ratio);
    let from_lower = length * fraction;
    let to_upper = from_lower * ratio;
    // dx/du = pi cosh(u) from_lower to_upper / length
    Node { from_lower, to_upper, weight: step * PI * u.cosh() * fraction * to_upper }
}

/// `u` of `|x|` on an interval `[-c, c]` with that gap, `x = c tanh((pi/2) sinh u)`; beyond all grids at the end.
#[inline(always)]
pub fn locate(at: Station) -> f64 {
    // With x + gap = c all digits are kept: tanh w = x/c is exp(2 w) = 1 + 2 x/gap.
    asinh(ln_1p(2.0 * at.x.abs() / at.gap) / PI)
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // where equality is asserted, it is exact by construction
mod tests {
    use super::*;

    fn integral(grid: &[Node], f: impl Fn(&Node) -> f64) -> f64 {
        grid.iter().map(|node| node.weight * f(node)).sum()
    }

    /// Relative error allowed where only rounding is left: about a hundred terms of one sign.
    const ROUNDING: f64 = 2e-15;

    #[test]
    fn distances_add_up_and_ascend() {
        for (length, n) in [(1.0, 1), (1e-200, 20), (3.7e5, 33)] {
            let grid = nodes(length, n);
            assert_eq!(grid.len(), 2 * n + 1);
            for node in &grid {
                let sum = node.from_lower + node.to_upper;
                assert!((sum / length - 1.0).abs() <= 2.0 * f64::EPSILON, "two roundings: {sum} of {length}");
                assert!(node.from_lower > 0.0 && node.to_upper > 0.0 && node.weight > 0.0, "{node:?}");
            }
            assert!(grid.windows(2).all(|w| w[0].from_lower <= w[1].from_lower && w[0].to_upper >= w[1].to_upper));
        }
    }

    #[test]
    fn the_grid_is_its_own_mirror_image() {
        let grid = nodes(2.0, 9);
        for (node, twin) in grid.iter().zip(grid.iter().rev()) {
            assert_eq!((node.from_lower, node.weight), (twin.to_upper, twin.weight));
        }
    }

    #[test]
    fn a_tiny_interval_is_a_scaled_large_one() {
        // A power of two scales every digit exactly.
        let scale = 2.0_f64.powi(-300);
        for (small, large) in nodes(scale, 12).iter().zip(nodes(1.0, 12)) {
            assert_eq!(small.from_lower, scale * large.from_lower);
            assert_eq!(small.weight, scale * large.weight);
        }
    }

    #[test]
    fn integrals_known_in_closed_form() {
        let grid = nodes(1.0, 24);
        let cases: [(&str, f64, f64); 6] = [
            ("1", integral(&grid, |_| 1.0), 1.0),
            ("exp x", integral(&grid, |x| x.from_lower.exp()), 1.0_f64.exp_m1()),
            ("x^-1/2", integral(&grid, |x| x.from_lower.powf(-0.5)), 2.0),
            ("(1 - x)^-1/2", integral(&grid, |x| x.to_upper.powf(-0.5)), 2.0),
            ("(x (1 - x))^-1/2", integral(&grid, |x| (x.from_lower * x.to_upper).powf(-0.5)), PI),
            ("log x", integral(&grid, |x| x.from_lower.ln()), -1.0),
        ];
        for (name, got, exact) in cases {
            assert!((got / exact - 1.0).abs() < ROUNDING, "int {name}: {got}, exact {exact}");
        }
    }

    /// What `U_MAX` is for: the pieces cut off are below rounding, and they are not with a smaller one.
    #[test]
    fn where_the_grid_ends_matters() {
        let error = |u_max| (integral(&nodes_up_to(1.0, 2000, u_max), |x| x.from_lower.powf(-0.5)) / 2.0 - 1.0).abs();
        // Thousands of terms of one sign: rounding grows like the square root of their number.
        assert!(error(U_MAX) < 5.0 * ROUNDING, "{}", error(U_MAX));
        // int_0^gap x^-1/2 dx = 2 sqrt(gap) with gap = exp(-pi sinh 3). The rule's last node stands for half a
        // step beyond it, 1.2 % of that piece.
        let cut = (-0.5 * PI * 3.0_f64.sinh()).exp();
        assert!((error(3.0) / cut - 1.0).abs() < 2e-2, "error {} against the piece cut off, {cut}", error(3.0));
        assert!(error(U_LIMIT) < 5.0 * ROUNDING, "nothing underflows at the limit");
    }

    #[test]
    fn a_singularity_just_outside_only_costs_nodes() {
        let outside = 1e-8_f64;
        let exact = ((1.0 + outside) / outside).ln();
        let error = |n| (integral(&nodes(1.0, n), |x| 1.0 / (x.from_lower + outside)) / exact - 1.0).abs();
        assert!(error(140) < ROUNDING, "{}", error(140));
        // The pole x = -1e-8 stands at sinh u = (ln 1e-8 + i pi)/pi, Im u = 0.167; a trapezoidal rule
        // converges like exp(-2 pi Im u/step).
        let rate = (error(40) / error(80)).ln() / (40.0 / U_MAX);
        assert!((rate / (2.0 * PI * 0.167) - 1.0).abs() < 0.1, "observed rate {rate}");
    }

    /// The number of digits grows almost in proportion to `n`, as theory has it: `exp(-c n/log n)`.
    #[test]
    fn convergence_is_exponential() {
        let f = |x: &Node| (5.0 * x.from_lower).cos() * x.to_upper.powf(-0.5);
        let exact = integral(&nodes(1.0, 100), f);
        let digits: Vec<f64> =
            [6, 12, 24].iter().map(|&n| -(integral(&nodes(1.0, n), f) / exact - 1.0).abs().log10()).collect();
        assert!(digits[1] > 1.8 * digits[0] && digits[2] > 1.8 * digits[1] && digits[2] > 11.0, "digits {digits:?}");
    }

    #[test]
    #[should_panic(expected = "no interval")]
    fn an_interval_has_a_length() {
        nodes(f64::NAN, 4);
    }
}
