//! How far staggered points and fine nodes are apart.

use super::map::Place;
use slipzone_api::elementary::sinh;
use std::f64::consts::PI;

/// `w_i - w_k` for `v_i = (i + 1/2) step` and `u_k = k step/factor`, `factor` being odd: without cancellation it is
/// `pi cosh((v_i + u_k)/2) sinh((v_i - u_k)/2)`, and all halves are odd multiples of `step/(4 factor)`.
pub(super) struct Apart {
    factor: usize,
    /// `cosh` of the multiples `1, 3, ...`.
    cosh: Vec<f64>,
    /// `pi sinh` of the multiples from the largest down to its negative.
    sinh: Vec<f64>,
}

impl Apart {
    /// For `n` staggered points and the fine nodes beside them.
    pub(super) fn new(n: usize, factor: usize, step: f64) -> Self {
        let unit = step / (4 * factor) as f64;
        let sinh: Vec<f64> = (0..2 * n * factor).map(|m| sinh((2 * m + 1) as f64 * unit)).collect();
        let cosh = sinh.iter().map(|sinh| (1.0 + sinh * sinh).sqrt()).collect();
        let pi_sinh: Vec<f64> = sinh.iter().map(|sinh| PI * sinh).collect();
        Self { factor, cosh, sinh: descending(&pi_sinh, n * factor - factor / 2, -1.0) }
    }

    /// Writes `x_i - x_k` for the first fine nodes, of which the factors `sech w_k` are given, to full relative
    /// precision also where both are near the same end.
    #[inline(always)]
    pub(super) fn minus_into(&self, (i, v): (usize, &Place), sech: &[f64], out: &mut [f64]) {
        let (rows, factor) = (self.cosh.len() / (2 * self.factor), self.factor);
        let halves = self.cosh[i * factor + factor / 2..].iter().zip(&self.sinh[(rows - 1 - i) * factor..]);
        for ((out, (cosh, pi_sinh)), sech) in out.iter_mut().zip(halves).zip(sech) {
            *out = sinh(pi_sinh * cosh) * v.sech * sech;
        }
    }
}

/// What is given at half-integer distances `1/2, 3/2, ...`, from the `farthest` of them down and on to negative ones,
/// where it is `mirror` times as much.
pub(super) fn descending(ascending: &[f64], farthest: usize, mirror: f64) -> Vec<f64> {
    let positive = ascending[..farthest].iter().rev().copied();
    positive.chain(ascending.iter().map(|value| mirror * value)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_as_for_one_pair() {
        let (n, step) = (7, 0.5);
        for factor in [1, 3, 7] {
            let apart = Apart::new(n, factor, step);
            for i in 0..n {
                let at_v = (i as f64 + 0.5) * step;
                let at_u = |k: usize| k as f64 * step / factor as f64;
                let v = Place::new(at_v);
                let nodes: Vec<Place> = (0..=n * factor).map(|k| Place::new(at_u(k))).collect();
                let sech: Vec<f64> = nodes.iter().map(|u| u.sech).collect();
                let mut row = vec![0.0; nodes.len()];
                apart.minus_into((i, &v), &sech, &mut row);
                for ((k, u), got) in nodes.iter().enumerate().zip(row) {
                    let ahead = PI * (0.5 * (at_v + at_u(k))).cosh() * (0.5 * (at_v - at_u(k))).sinh();
                    // Roundings of u grow by up to w = 26 on their way.
                    let ratio = got / (ahead.sinh() * v.sech * u.sech);
                    assert!((ratio - 1.0).abs() < 3e-14, "{ratio}: {factor}, {i}, {k}");
                    assert!((got - (v.x - u.x)).abs() < 3e-14, "{got}: {factor}, {i}, {k}");
                }
            }
        }
    }
}
