//! Rational interpolation without poles (M. Floater, K. Hormann, Numer. Math. 107 (2007) 315).

use slipzone_api::taylor::Taylor;

/// The highest blending degree: that of the polynomials that are reproduced. A higher one gains an order, and loses a
/// factor of two in what the scatter of the values is magnified by.
pub(super) const DEGREE: usize = 4;

/// What lies as near to a node, over its depth, is that node: a depth in other units and back.
const ROUNDING: f64 = 2.0 * f64::EPSILON;

/// Nodes and their barycentric weights; the values are given each time, as two functions share the nodes.
#[derive(Clone, Debug)]
pub(super) struct Interpolant {
    nodes: Vec<f64>,
    weights: Vec<f64>,
}

impl Interpolant {
    /// For ascending nodes, more of them than the degree. Time: linear in their number.
    pub(super) fn new(nodes: Vec<f64>, degree: usize) -> Self {
        let last = nodes.len() - 1;
        // In units of the mean distance the products neither overflow nor vanish.
        let unit = (nodes[last] - nodes[0]) / last as f64;
        let weight = |k: usize| -> f64 {
            let of_blend = |from: usize| -> f64 {
                let others = (from..=from + degree).filter(|j| *j != k);
                others.map(|j| unit / (nodes[k] - nodes[j]).abs()).product()
            };
            let sum: f64 = (k.saturating_sub(degree)..=k.min(last - degree)).map(of_blend).sum();
            if k.is_multiple_of(2) { sum } else { -sum }
        };
        let weights = (0..nodes.len()).map(weight).collect();
        Self { nodes, weights }
    }

    /// The nodes.
    pub(super) fn nodes(&self) -> &[f64] {
        &self.nodes
    }

    /// The interpolant of the values at the nodes. At a node it takes no sum: all of them may be asked for.
    pub(super) fn at(&self, x: f64, values: &[f64]) -> f64 {
        self.magnified(x, values).0
    }

    /// The same, and how many times the errors of the values it may be off by.
    ///
    /// The value at the nearest node is taken out first: what the sums round is beside what the others differ from it,
    /// so that values that are all the same come back exactly, whatever their size and however uneven the nodes.
    #[inline(always)]
    pub(super) fn magnified(&self, x: f64, values: &[f64]) -> (f64, f64) {
        let near = self.nodes.partition_point(|node| *node < x * (1.0 - ROUNDING));
        if self.nodes.get(near).is_some_and(|node| *node <= x * (1.0 + ROUNDING)) {
            return (values[near], 1.0);
        }
        let is_beyond = near == self.nodes.len() || near > 0 && x - self.nodes[near - 1] < self.nodes[near] - x;
        let nearest = values[if is_beyond { near - 1 } else { near }];
        let (mut above, mut below, mut size) = (0.0, 0.0, 0.0);
        for ((node, weight), value) in self.nodes.iter().zip(&self.weights).zip(values) {
            let share = weight / (x - node);
            if !share.is_finite() {
                return (*value, 1.0);
            }
            above += share * (value - nearest);
            below += share;
            size += share.abs();
        }
        (nearest + above / below, size / below.abs())
    }

    /// The Taylor series about the first node over `x/unit`: multiplied by `x`, numerator and denominator have no pole
    /// there. The value is taken out first, so that its size does not drown the rest.
    pub(super) fn series(&self, values: &[f64], unit: f64, terms: usize) -> Taylor {
        let first = self.nodes[0];
        let mut above = vec![0.0; terms];
        let mut below = vec![0.0; terms];
        for coefficient in below.iter_mut().take(1) {
            *coefficient = self.weights[0];
        }
        for ((node, weight), value) in self.nodes.iter().zip(&self.weights).zip(values).skip(1) {
            let rate = unit / (node - first);
            // x/(x - node) = -(x/node + (x/node)^2 + ...)
            let mut share = -weight * rate;
            for k in 1..terms {
                below[k] += share;
                above[k] += share * (value - values[0]);
                share *= rate;
            }
        }
        Taylor::new(above) / Taylor::new(below) + values[0]
    }
}
