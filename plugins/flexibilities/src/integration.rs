//! Integrals from the lower end of a range to each of its Chebyshev nodes.

use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::OnceLock;

/// Nodes: two more than the constants of a panel need, because products of them are integrated.
pub(crate) const NODES: usize = 18;
const HALF: usize = NODES / 2;

/// Values side by side: one for each unit state.
pub(crate) type Lanes = [f64; 4];

/// Values at all nodes.
pub(crate) type Field = [Lanes; NODES];

/// What leads from values at the nodes to integrals, the even and the odd part of a function apart: the nodes are symmetric.
pub(crate) struct Integration {
    /// From 0 at the lower end to 1; the first half are those above the middle, and the others mirror them.
    pub(crate) nodes: [f64; NODES],
    /// Rows: from the middle to each node above it, and to the upper end.
    even: [[f64; HALF]; HALF + 1],
    odd: [[f64; HALF]; HALF + 1],
}

impl Integration {
    /// The rule, made when first asked for.
    pub(crate) fn get() -> &'static Self {
        static RULE: OnceLock<Integration> = OnceLock::new();
        RULE.get_or_init(Self::new)
    }

    fn new() -> Self {
        let angle = |j: usize| PI * (2 * j + 1) as f64 / (2 * NODES) as f64;
        // Angle 0 is the upper end.
        let end = |j: usize| if j < HALF { angle(j) } else { 0.0 };
        let entry = |j: usize, k: usize, first: usize| -> f64 {
            let term = |l: usize| {
                let weight = if l == 0 { 0.5 } else { 1.0 } / NODES as f64;
                weight * (l as f64 * angle(k)).cos() * (primitive(l, end(j)) - primitive(l, FRAC_PI_2))
            };
            (first..NODES).step_by(2).map(term).sum()
        };
        Self {
            nodes: std::array::from_fn(|j| 0.5 * (1.0 + angle(j).cos())),
            even: std::array::from_fn(|j| std::array::from_fn(|k| entry(j, k, 0))),
            odd: std::array::from_fn(|j| std::array::from_fn(|k| entry(j, k, 1))),
        }
    }

    /// The integrals from the lower end to each node, and over the whole range.
    #[inline(always)]
    pub(crate) fn integrals(&self, values: &Field) -> (Field, Lanes) {
        let (mut even, mut odd) = ([[0.0; 4]; HALF], [[0.0; 4]; HALF]);
        for k in 0..HALF {
            let (above, below) = (values[k], values[NODES - 1 - k]);
            even[k] = std::array::from_fn(|i| above[i] + below[i]);
            odd[k] = std::array::from_fn(|i| above[i] - below[i]);
        }
        let (half_even, half_odd) = (product(&self.even[HALF], &even), product(&self.odd[HALF], &odd));
        let mut integrals = [[0.0; 4]; NODES];
        for k in 0..HALF {
            let (even, odd) = (product(&self.even[k], &even), product(&self.odd[k], &odd));
            for i in 0..4 {
                let common = half_even[i] - half_odd[i] + odd[i];
                integrals[k][i] = common + even[i];
                integrals[NODES - 1 - k][i] = common - even[i];
            }
        }
        (integrals, half_even.map(|half| 2.0 * half))
    }
}

/// A primitive of the Chebyshev polynomial of degree `l` at `cos(angle)`.
fn primitive(l: usize, angle: f64) -> f64 {
    let cosine = |order: usize| (order as f64 * angle).cos() / (2 * order) as f64;
    match l {
        0 => angle.cos(),
        1 => cosine(2),
        _ => cosine(l + 1) - cosine(l - 1),
    }
}

#[inline(always)]
fn product(row: &[f64; HALF], values: &[Lanes; HALF]) -> Lanes {
    let mut sum = [0.0; 4];
    for (weight, value) in row.iter().zip(values) {
        for i in 0..4 {
            sum[i] += weight * value[i];
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_are_integrated_exactly() {
        let rule = Integration::get();
        for power in 0..i32::try_from(NODES).unwrap() {
            let values = rule.nodes.map(|z| [z.powi(power), 1.0, 0.0, -z.powi(power)]);
            let (integrals, whole) = rule.integrals(&values);
            let exact = |z: f64| z.powi(power + 1) / f64::from(power + 1);
            for (z, found) in rule.nodes.iter().zip(&integrals).chain([(&1.0, &whole)]) {
                // A few roundings of sums of order one.
                assert!((found[0] - exact(*z)).abs() < 1e-15, "{power} at {z}: {found:?}");
                assert!((found[1] - z).abs() < 1e-15 && found[2] == 0.0 && found[3] == -found[0]);
            }
        }
    }
}
