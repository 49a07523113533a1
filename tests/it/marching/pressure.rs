//! Pressure without friction: the half-plane's in closed form, what the layer adds by the scheme of Erdogan and Gupta.
//!
//! F. Erdogan, G. D. Gupta, Q. Appl. Math. 29 (1972) 525: Gauss and Chebyshev, density `sqrt(1 - t^2)` times a
//! polynomial, collocation at the zeros between. With the closed form taken off, what is left is smooth but for the
//! weak singularities of a graded layer's kernel, an error of the order `n^-2` of the small share that the layer adds.

use super::dense::solve;
use super::surface::{GAUSS, Surface, crowded};
use slipzone::api::Component;
use std::f64::consts::PI;

/// Nodes over the whole contact, even.
const NODES: usize = 96;

/// The pressure of one half-width.
pub(super) struct Pressure {
    half_width: f64,
    /// What the layer adds, over `sqrt(1 - t^2)`, at the nodes `t > 0`.
    added: Vec<f64>,
}

fn node(j: usize) -> f64 {
    (PI * j as f64 / (NODES + 1) as f64).cos()
}

impl Pressure {
    /// `half_plane(x, b)` is the pressure of the same punch on a half-plane.
    pub(super) fn new(surface: &Surface, half_plane: &dyn Fn(f64, f64) -> f64, half_width: f64) -> Self {
        let (b, half) = (half_width, NODES / 2);
        let points: Vec<f64> = (0..half).map(|i| (PI * (i as f64 + 0.5) / (NODES + 1) as f64).cos()).collect();
        let nodes: Vec<f64> = (1..=half).map(node).collect();
        let pairs = points.iter().flat_map(|x| nodes.iter().flat_map(move |t| [b * (x - t), b * (x + t)]));
        let kernel = surface.kernel(Component::NormalSlope, &pairs.collect::<Vec<_>>());
        let (mut matrix, mut right) = (vec![0.0; half * half], vec![0.0; half]);
        for (i, x) in points.iter().enumerate() {
            for (j, t) in nodes.iter().enumerate() {
                let weight = (1.0 - t * t) / (NODES + 1) as f64;
                let at = i * half + j;
                let layer = b * (kernel[2 * at] + kernel[2 * at + 1]);
                matrix[at] = weight * (1.0 / (x - t) + 1.0 / (x + t) + layer);
                right[i] -= weight * layer * half_plane(b * t, b) / (1.0 - t * t).sqrt();
            }
        }
        solve(&mut matrix, &mut right);
        Self { half_width, added: right }
    }

    /// What the layer adds at `x = b s`, `root = sqrt(1 - s^2)`; barycentric.
    fn added(&self, s: f64, root: f64) -> f64 {
        let (mut above, mut below) = (0.0, 0.0);
        for (j, value) in self.added.iter().enumerate() {
            let t = node_table()[j];
            let weight = SIGNS[j % 2] * (1.0 - t * t) * t / (s * s - t * t);
            above += weight * value;
            below += weight;
        }
        root * above / below
    }

    /// `int p dx` over each of `count` pieces of the given `width` from the middle to the edge.
    pub(super) fn masses(&self, half_plane: &dyn Fn(f64, f64) -> f64, width: f64, count: usize) -> Vec<f64> {
        let b = self.half_width;
        // x = b sin: the edge's square root becomes a cosine.
        let angle = |piece: usize| (piece as f64 * width / b).min(1.0).asin();
        let mass = |piece: usize| {
            let (from, to) = (angle(piece), angle(piece + 1));
            let each = GAUSS.iter().map(|(node, weight)| {
                let (part, weight) = crowded(piece, *node, *weight);
                let (sin, cos) = (from + part * (to - from)).sin_cos();
                (to - from) * weight * b * cos * (half_plane(b * sin, b) + self.added(sin, cos))
            });
            each.sum()
        };
        (0..count).map(mass).collect()
    }
}

const SIGNS: [f64; 2] = [1.0, -1.0];

fn node_table() -> &'static [f64] {
    static TABLE: std::sync::OnceLock<Vec<f64>> = std::sync::OnceLock::new();
    TABLE.get_or_init(|| (1..=NODES / 2).map(node).collect())
}
