//! The shear that a strain `|x|` in the stick zone makes on a half-plane, and what a layer adds.

use crate::engine::prepared_layer::PreparedLayer;
use slipzone_api::double_exponential;
use slipzone_api::{Component, Station};
use std::f64::consts::PI;

/// Fewest nodes on either side of the integrals over the carrier.
const FEWEST_NODES: f64 = 24.0;
/// Those nodes per length of the kernel.
const NODES_PER_LENGTH: f64 = 8.0;
/// The shear that `|x|` alone makes: `z` with `(1/pi) PV int z(r)/(x - r) dr = -(|x| - 2 a/pi)` within `(-a, a)`,
/// `z = (x/pi) ln((a - w)/(a + w))`, `w = sqrt(a^2 - x^2)`. The constant is what makes it bounded.
pub(crate) fn shear(a: f64, at: Station) -> f64 {
    let x = at.x.abs();
    if x == 0.0 {
        return 0.0;
    }
    let w = (at.gap * (2.0 * a - at.gap)).max(0.0).sqrt();
    let logarithm = if at.gap < 0.5 * a { (-(at.gap + w) / (a + w)).ln_1p() } else { (x / (a + w)).ln() };
    2.0 * at.x / PI * logarithm
}

/// What stands beside `C/A0` in the tangential equation at each point: the constant that the carrier leaves, and the
/// layer's `(1/pi) int z(r) k_uu(x - r) dr`.
pub(crate) fn equation(layer: &PreparedLayer, a: f64, at: &[Station]) -> Vec<f64> {
    let constant = 2.0 * a / PI;
    if layer.is_plain() {
        return vec![constant; at.len()];
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a positive count; `as` saturates
    let grid = double_exponential::nodes(1.0, FEWEST_NODES.max(NODES_PER_LENGTH * a / layer.length()).ceil() as usize);
    let (mut distances, mut weights, mut kernel) = (Vec::new(), Vec::new(), vec![0.0; 4 * grid.len()]);
    let one = |at: &Station| {
        distances.clear();
        weights.clear();
        for node in &grid {
            let (below, above) = (at.x * node.to_upper, at.gap * node.from_lower);
            let inner = Station { x: at.x * node.from_lower, gap: at.gap + below };
            let outer = Station { x: at.x + above, gap: at.gap * node.to_upper };
            distances.extend([below, at.x + inner.x, -above, at.x + outer.x]);
            weights.extend([at.x * node.weight * shear(a, inner), at.gap * node.weight * shear(a, outer)]);
        }
        layer.kernel_values(Component::ShearStrain, &distances, &mut kernel);
        let sum: f64 = weights.iter().zip(kernel.chunks_exact(2)).map(|(weight, k)| weight * (k[0] - k[1])).sum();
        constant + sum / PI
    };
    at.iter().map(one).collect()
}
