//! What Goodman's approximation costs, estimated.
//!
//! Measured on half-planes (docs/theory.md, "What Goodman's approximation costs"): at a given stick ratio the friction of
//! the coupled equations is larger by a factor of `1/(1 - c beta^2)`, where `c` depends on the ratio. On a layer the
//! surface answers pressure with the strain `beta' p` in place of `beta p`, by the layer's own kernel.

use super::layer::Layer;
use super::problem::Problem;
use slipzone_api::Component;
use std::f64::consts::PI;

/// `a/b`, and `c` there: the largest over Poisson's ratios from 0 to 0.45.
const MEASURED: [(f64, f64); 6] = [(0.1, 0.60), (0.25, 0.66), (0.5, 0.78), (0.75, 1.0), (0.9, 1.36), (0.99, 2.32)];
/// Points in the mean of the kernel over the contact: it varies over the thickness.
const POINTS: usize = 24;
/// A share of the friction beyond which the measurements say nothing.
const MOST: f64 = 0.9;

/// The relative error of the friction coefficient that belongs to a stick zone, all but what is of higher order in `beta`.
pub(super) fn neglected(layer: &Layer, problem: &Problem, half_width: f64, ratio: f64) -> f64 {
    let beta = coupling(layer, problem, half_width);
    let share = (factor(ratio) * beta * beta).min(MOST);
    share / (1.0 - share)
}

/// `beta' = beta - (1/pi) int p k_uv dr/p(0)` under the pressure of a flat punch on a half-plane, which is that of the
/// layer's to the first order.
fn coupling(layer: &Layer, problem: &Problem, b: f64) -> f64 {
    let nodes: [f64; POINTS] = std::array::from_fn(|i| b * (PI * (2 * i + 1) as f64 / (4 * POINTS) as f64).cos());
    let mut kernel = [0.0; POINTS];
    layer.kernel_values(Component::Coupling, &nodes, &mut kernel);
    problem.elastic.beta() - b * kernel.iter().sum::<f64>() / POINTS as f64
}

/// `c`: between the measurements and beyond them along `ln(a/(b - a))`.
fn factor(ratio: f64) -> f64 {
    let lambda = |ratio: f64| (ratio / (1.0 - ratio)).ln();
    let at = lambda(ratio.clamp(MEASURED[0].0, 1.0 - 1e-12));
    let next = MEASURED.iter().skip(1).position(|(ratio, _)| at <= lambda(*ratio)).unwrap_or(MEASURED.len() - 2);
    let ((r0, c0), (r1, c1)) = (MEASURED[next], MEASURED[next + 1]);
    c0 + (c1 - c0) * (at - lambda(r0)) / (lambda(r1) - lambda(r0))
}
