//! What Goodman's approximation costs, estimated.
//!
//! Measured on half-planes (docs/theory.md, "What Goodman's approximation costs"): at a given stick ratio `k` the friction of
//! the coupled equations is larger by a factor of `1/(1 - c beta^2)`, where `c` depends on the ratio. What is left out of
//! the pressure's equation is `beta q`, and `q` is of the size of `eta p`; on a half-plane `eta = beta K(k)/K'(k)`. So
//! `c beta^2 = c (K'/K) beta eta`, which is taken for layers as well.

use super::problem::Problem;
use super::stick_zone::StickZone;

/// `a/b`, and `c` there: the largest over Poisson's ratios from 0 to 0.45 (`tests/data/coupled_half_plane.csv`).
const MEASURED: [(f64, f64); 6] = [(0.1, 0.60), (0.25, 0.66), (0.5, 0.78), (0.75, 1.0), (0.9, 1.36), (0.99, 2.32)];
/// A share of the friction beyond which the measurements say nothing.
const MOST: f64 = 0.9;

/// The relative error of the friction coefficient that belongs to a stick zone, as far as the surface's own coupling goes;
/// `None` without friction.
pub(super) fn neglected(problem: &Problem, zone: StickZone) -> Option<f64> {
    let (k, rest) = (zone.ratio(), zone.one_minus_ratio());
    let complement = (rest * (1.0 + k)).sqrt();
    // K = (pi/2)/agm(1, k'), and K' likewise.
    let quotient = mean(complement) / mean(k);
    let share = factor(k, rest) * quotient * problem.elastic.beta().abs() * problem.friction?;
    let share = share.min(MOST);
    Some(share / (1.0 - share))
}

/// `c`: between the measurements and beyond them along `ln(a/(b - a))`.
fn factor(ratio: f64, rest: f64) -> f64 {
    let lambda = |(ratio, _): (f64, f64)| (ratio / (1.0 - ratio)).ln();
    let at = (ratio / rest).ln().max(lambda(MEASURED[0]));
    let pair = MEASURED.windows(2).find(|pair| at <= lambda(pair[1])).unwrap_or(&MEASURED[MEASURED.len() - 2..]);
    let (from, to) = (lambda(pair[0]), lambda(pair[1]));
    pair[0].1 + (pair[1].1 - pair[0].1) * (at - from) / (to - from)
}

/// The arithmetic-geometric mean of 1 and a number in (0, 1].
fn mean(other: f64) -> f64 {
    const STEPS: usize = 12;
    let (mut a, mut g) = (1.0, other.max(f64::MIN_POSITIVE));
    for _ in 0..STEPS {
        (a, g) = (0.5 * (a + g), (a * g).sqrt());
    }
    a
}
