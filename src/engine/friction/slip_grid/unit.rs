//! A double-exponential grid of unit length over a slip zone.

use slipzone_api::Shelf;
use slipzone_api::double_exponential::{self, Node};
use std::f64::consts::PI;
use std::sync::Arc;

/// Where the grid ends in `u`; what is left out, `exp(-(pi/2) sinh u)`, is 3e-13 of the pressure.
pub(super) const END: f64 = 3.6;
/// Points that stand for all nodes where a function hardly varies over the slip zone: whole vectors of them.
const POINTS: usize = 8;
/// A function does where it is analytic up to this many widths of the slip zone from it: of a pole there the
/// interpolant misses `2 58^-8`, or 2e-14, and less of what is milder.
pub(super) const APART: f64 = 14.0;

/// The grid, and how to do with a few points.
#[derive(Default)]
pub(super) struct Unit {
    pub(super) nodes: Vec<Node>,
    /// Chebyshev points.
    pub(super) points: [f64; POINTS],
    /// For each of them its Lagrange polynomial at the nodes.
    pub(super) shares: [Vec<f64>; POINTS],
}

/// Nodes kept of each kind.
const KEPT: usize = 1 << 15;

static ROUGH: Shelf<usize, Unit> = Shelf::new(KEPT, |unit| unit.nodes.len());
static FINE: Shelf<usize, Unit> = Shelf::new(KEPT, |unit| unit.nodes.len());

impl Unit {
    /// The grid with so many nodes on either side of the middle; a `rough` one ends at [`END`].
    pub(super) fn of(count: usize, rough: bool) -> Arc<Self> {
        if rough {
            ROUGH.get(count, || Self::new(count, END))
        } else {
            FINE.get(count, || Self::new(count, double_exponential::U_MAX))
        }
    }

    fn new(count: usize, end: f64) -> Self {
        let mut nodes = double_exponential::nodes_up_to(1.0, count, end);
        // Beside the stick zone the pressure is finite: nodes there matter as little as what is left out at the
        // contact's edge once they are as near as the root of its gap.
        let least = nodes[0].from_lower.sqrt();
        nodes.retain(|node| node.from_lower > least);
        let points = std::array::from_fn(|i| 0.5 - 0.5 * (PI * (2 * i + 1) as f64 / (2 * POINTS) as f64).cos());
        let share = |i: usize| {
            let others = || (0..POINTS).filter(|j| *j != i).map(|j| points[j]);
            let scale: f64 = others().map(|other| points[i] - other).product();
            nodes.iter().map(|node| others().map(|other| node.from_lower - other).product::<f64>() / scale).collect()
        };
        let shares = std::array::from_fn(share);
        Self { nodes, points, shares }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_few_points_tell_what_hardly_varies() {
        let Unit { nodes, points, shares } = Unit::new(16, END);
        for far in [|t: f64| t.ln(), |t: f64| 1.0 / t, |t: f64| 1.0 / (t * t + APART * APART)] {
            for (k, node) in nodes.iter().enumerate() {
                let exact = far(APART + node.from_lower);
                let told: f64 = points.iter().zip(&shares).map(|(at, share)| share[k] * far(APART + at)).sum();
                assert!((told / exact - 1.0).abs() < 2e-14, "{told} for {exact}");
            }
        }
    }

    /// Beside the pressure at the contact's edge.
    #[test]
    fn what_is_left_out_beside_the_stick_zone_does_not_matter() {
        for count in [8, 9, 11, 13, 16] {
            let Unit { nodes, .. } = Unit::new(count, END);
            assert!(nodes.len() < 2 * count + 1, "{count}");
            let all: f64 = nodes.iter().map(|node| node.weight / node.to_upper.sqrt()).sum();
            let left_out = double_exponential::nodes_up_to(1.0, count, END)
                .iter()
                .map(|node| node.weight / node.to_upper.sqrt())
                .sum::<f64>()
                - all;
            assert!(left_out.abs() < 4e-12 * all, "{count}: {left_out:e}");
        }
    }
}
