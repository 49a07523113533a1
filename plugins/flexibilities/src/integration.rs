//! Integrals from the lower end of a range to each of its Chebyshev nodes.

use pulp::Simd;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::OnceLock;

/// Half the nodes to rounding: two more than the constants of a panel need, because products of them are integrated.
pub(crate) const HALF: usize = 9;

/// Half the nodes to twelve digits.
pub(crate) const HALF_ROUGH: usize = 7;

/// Values side by side: two components of each of the four unit states.
pub(crate) type Pair = [[f64; 4]; 2];

/// Something at all nodes: those above the middle, from the upper end on, and their mirror images.
pub(crate) type Nodes<T, const H: usize> = [[T; H]; 2];

/// What leads from values at `2 H` nodes to integrals, the even and the odd part of a function apart: the nodes are
/// symmetric.
pub(crate) struct Integration<const H: usize> {
    /// From 0 at the lower end to 1.
    pub(crate) nodes: Nodes<f64, H>,
    /// Rows: from the middle to each node above it, and to the upper end.
    even: [[f64; H]; H],
    odd: [[f64; H]; H],
    even_end: [f64; H],
    odd_end: [f64; H],
}

impl Integration<HALF> {
    /// The rule, made when first asked for.
    pub(crate) fn full() -> &'static Self {
        static RULE: OnceLock<Integration<HALF>> = OnceLock::new();
        RULE.get_or_init(Self::new)
    }
}

impl Integration<HALF_ROUGH> {
    /// The same of fewer nodes.
    pub(crate) fn rough() -> &'static Self {
        static RULE: OnceLock<Integration<HALF_ROUGH>> = OnceLock::new();
        RULE.get_or_init(Self::new)
    }
}

impl<const H: usize> Integration<H> {
    fn new() -> Self {
        let angle = |j: usize| PI * (2 * j + 1) as f64 / (4 * H) as f64;
        let entry = |end: f64, k: usize, first: usize| -> f64 {
            let term = |l: usize| {
                let weight = if l == 0 { 0.5 } else { 1.0 } / (2 * H) as f64;
                weight * (l as f64 * angle(k)).cos() * (primitive(l, end) - primitive(l, FRAC_PI_2))
            };
            (first..2 * H).step_by(2).map(term).sum()
        };
        let row = |end: f64, first: usize| std::array::from_fn(|k| entry(end, k, first));
        let above: [f64; H] = std::array::from_fn(|j| 0.5 * (1.0 + angle(j).cos()));
        Self {
            nodes: [above, above.map(|z| 1.0 - z)],
            even: std::array::from_fn(|j| row(angle(j), 0)),
            odd: std::array::from_fn(|j| row(angle(j), 1)),
            // Angle 0 is the upper end.
            even_end: row(0.0, 0),
            odd_end: row(0.0, 1),
        }
    }

    /// Adds the integrals from the lower end to each node to `start`, which is the same everywhere; returns what that
    /// is at the upper end.
    #[inline(always)]
    pub(crate) fn integrate<S: Simd>(&self, start: &Pair, [above, below]: &mut Nodes<Pair, H>) -> Pair {
        let (mut even, mut odd) = ([Pair::default(); H], [Pair::default(); H]);
        for k in 0..H {
            let (above, below) = (above[k], below[k]);
            even[k] = pair(|c, i| above[c][i] + below[c][i]);
            odd[k] = pair(|c, i| above[c][i] - below[c][i]);
        }
        let half = product::<S, H>(&self.even_end, &even, Pair::default());
        let upper = product::<S, H>(&self.odd_end, &odd, Pair::default());
        let middle = pair(|c, i| start[c][i] + half[c][i] - upper[c][i]);
        for k in 0..H {
            let (even, common) =
                (product::<S, H>(&self.even[k], &even, Pair::default()), product::<S, H>(&self.odd[k], &odd, middle));
            above[k] = pair(|c, i| common[c][i] + even[c][i]);
            below[k] = pair(|c, i| common[c][i] - even[c][i]);
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
fn product<S: Simd, const H: usize>(row: &[f64; H], values: &[Pair; H], mut sum: Pair) -> Pair {
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
        powers_by(Integration::full());
        powers_by(Integration::rough());
    }

    fn powers_by<const H: usize>(rule: &Integration<H>) {
        for power in 0..i32::try_from(2 * H).unwrap() {
            let mut values = rule.nodes.map(|half| half.map(|z| [[z.powi(power), 1.0, 0.0, -z.powi(power)]; 2]));
            let start = [[1.0, 0.0, 3.0, -1.0], [0.0; 4]];
            let whole = rule.integrate::<Scalar>(&start, &mut values);
            let exact = |z: f64| z.powi(power + 1) / f64::from(power + 1);
            for (z, found) in rule.nodes.iter().flatten().zip(values.iter().flatten()).chain([(&1.0, &whole)]) {
                let expected = pair(|c, i| start[c][i] + [exact(*z), *z, 0.0, -exact(*z)][i]);
                for (found, expected) in found.iter().flatten().zip(expected.iter().flatten()) {
                    // A few roundings of sums of order one.
                    assert!((found - expected).abs() < 2e-15, "{power} at {z}: {found} instead of {expected}");
                }
            }
        }
    }
}
