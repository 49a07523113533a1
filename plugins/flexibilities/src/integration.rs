//! Integrals from the lower end of a range to each of its Chebyshev nodes.

use pulp::Simd;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::OnceLock;

/// Nodes: two more than the constants of a panel need, because products of them are integrated.
pub(crate) const NODES: usize = 18;
const HALF: usize = NODES / 2;

/// Values side by side: two components of each of the four unit states.
pub(crate) type Pair = [[f64; 4]; 2];

/// Values at all nodes.
pub(crate) type Field = [Pair; NODES];

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

    /// Adds the integrals from the lower end to each node to `start`, which is the same everywhere; returns what that is at
    /// the upper end.
    #[inline(always)]
    pub(crate) fn integrate<S: Simd>(&self, start: &Pair, values: &mut Field) -> Pair {
        let (mut even, mut odd) = ([Pair::default(); HALF], [Pair::default(); HALF]);
        for k in 0..HALF {
            let (above, below) = (values[k], values[NODES - 1 - k]);
            even[k] = pair(|c, i| above[c][i] + below[c][i]);
            odd[k] = pair(|c, i| above[c][i] - below[c][i]);
        }
        let half = product::<S>(&self.even[HALF], &even, Pair::default());
        let upper = product::<S>(&self.odd[HALF], &odd, Pair::default());
        let middle = pair(|c, i| start[c][i] + half[c][i] - upper[c][i]);
        for k in 0..HALF {
            let (even, common) =
                (product::<S>(&self.even[k], &even, Pair::default()), product::<S>(&self.odd[k], &odd, middle));
            values[k] = pair(|c, i| common[c][i] + even[c][i]);
            values[NODES - 1 - k] = pair(|c, i| common[c][i] - even[c][i]);
        }
        pair(|c, i| start[c][i] + 2.0 * half[c][i])
    }
}

#[inline(always)]
pub(crate) fn pair(value: impl Fn(usize, usize) -> f64) -> Pair {
    std::array::from_fn(|c| std::array::from_fn(|i| value(c, i)))
}

/// `a b + c`, rounded once where the machine's vectors can.
#[inline(always)]
pub(crate) fn fused<S: Simd>(a: f64, b: f64, c: f64) -> f64 {
    if S::IS_SCALAR { a * b + c } else { a.mul_add(b, c) }
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
fn product<S: Simd>(row: &[f64; HALF], values: &[Pair; HALF], mut sum: Pair) -> Pair {
    for (weight, value) in row.iter().zip(values) {
        sum = pair(|c, i| fused::<S>(*weight, value[c][i], sum[c][i]));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use pulp::Scalar;

    #[test]
    fn powers_are_integrated_exactly() {
        let rule = Integration::get();
        for power in 0..i32::try_from(NODES).unwrap() {
            let mut values = rule.nodes.map(|z| [[z.powi(power), 1.0, 0.0, -z.powi(power)]; 2]);
            let start = [[1.0, 0.0, 3.0, -1.0], [0.0; 4]];
            let whole = rule.integrate::<Scalar>(&start, &mut values);
            let exact = |z: f64| z.powi(power + 1) / f64::from(power + 1);
            for (z, found) in rule.nodes.iter().zip(&values).chain([(&1.0, &whole)]) {
                let expected = pair(|c, i| start[c][i] + [exact(*z), *z, 0.0, -exact(*z)][i]);
                for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
                    // A few roundings of sums of order one.
                    assert!((found - expected).abs() < 2e-15, "{power} at {z}: {found} instead of {expected}");
                }
            }
        }
    }
}
