//! The shear that a strain `|x|` in the stick zone makes on a half-plane, and what a layer adds.

use crate::engine::prepared_layer::PreparedLayer;
use slipzone_api::double_exponential;
use slipzone_api::{Component, Station};
use std::f64::consts::PI;

/// Fewest nodes on either side of the integrals over the carrier.
const FEWEST_NODES: f64 = 24.0;
/// Those nodes per length of the kernel in the stick zone,
const NODES_PER_LENGTH: f64 = 8.0;
/// as long as that is no more than so many, for each factor of `e` by which it is shorter. The nodes crowd beside the
/// point where the kernel is steep, so that a singularity at its length from there costs the logarithm of that.
const NODES_PER_EXPONENT: f64 = 10.0;

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

/// Nodes on either side of those integrals in a stick zone of that half-width over the kernel's length.
fn nodes_for(lengths: f64) -> usize {
    let most = FEWEST_NODES + NODES_PER_EXPONENT * lengths.max(1.0).ln();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a positive count; `as` saturates
    let nodes = (NODES_PER_LENGTH * lengths).clamp(FEWEST_NODES, most).ceil() as usize;
    nodes
}

/// What stands beside `C/A0` in the tangential equation at each point: the constant that the carrier leaves, and the
/// layer's `(1/pi) int z(r) k_uu(x - r) dr`.
pub(crate) fn equation(layer: &PreparedLayer, a: f64, at: &[Station]) -> Vec<f64> {
    let constant = 2.0 * a / PI;
    if layer.is_plain() {
        return vec![constant; at.len()];
    }
    let nodes = nodes_for(a / layer.length());
    let sums = applied(a, at, nodes, |distances, out| layer.kernel_values(Component::ShearStrain, distances, out));
    sums.into_iter().map(|sum| constant + sum / PI).collect()
}

/// `int z(r) k(x - r) dr` over the stick zone at each point, `k` odd, by so many nodes on either side of both parts that
/// end there.
fn applied(a: f64, at: &[Station], nodes: usize, kernel: impl Fn(&[f64], &mut [f64])) -> Vec<f64> {
    let grid = double_exponential::nodes(1.0, nodes);
    let (mut distances, mut weights, mut values) = (Vec::new(), Vec::new(), vec![0.0; 4 * grid.len()]);
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
        kernel(&distances, &mut values);
        weights.iter().zip(values.chunks_exact(2)).map(|(weight, k)| weight * (k[0] - k[1])).sum()
    };
    at.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a kernel with a pole as near to the axis as its length is short.
    #[test]
    fn as_many_nodes_as_the_logarithm_of_the_length_are_enough() {
        let at = [1e-6, 0.01, 0.3, 0.9, 1.0 - 1e-9].map(|x| Station { x, gap: 1.0 - x });
        for length in [1.0, 0.2, 1e-2, 1e-4, 1e-6] {
            let kernel = |t: &[f64], out: &mut [f64]| {
                out.iter_mut().zip(t).for_each(|(out, t)| *out = t / (t * t + length * length));
            };
            let nodes = nodes_for(1.0 / length);
            assert!(nodes < 170, "{nodes} at {length}");
            let [told, exact] = [nodes, 4 * nodes].map(|nodes| applied(1.0, &at, nodes, kernel));
            let apart = told.iter().zip(&exact).fold(0.0_f64, |most, (told, exact)| most.max((told - exact).abs()));
            assert!(apart < 1e-11, "{apart:e} at {length}");
        }
    }
}
