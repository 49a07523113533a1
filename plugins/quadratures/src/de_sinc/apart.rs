//! How far staggered points and fine nodes are apart.

use super::map::Place;
use std::f64::consts::PI;

/// `w_i - w_k` for `v_i = (i + 1/2) step` and `u_k = k step/factor`, `factor` being odd: without cancellation it is
/// `pi cosh((v_i + u_k)/2) sinh((v_i - u_k)/2)`, and all halves are odd multiples of `step/(4 factor)`.
pub(super) struct Apart {
    factor: usize,
    /// `(cosh, sinh)` of the odd multiples.
    halves: Vec<(f64, f64)>,
}

impl Apart {
    /// For `n` staggered points and the fine nodes beside them.
    pub(super) fn new(n: usize, factor: usize, step: f64) -> Self {
        let unit = step / (4 * factor) as f64;
        let of = |u: f64| (u.cosh(), u.sinh());
        Self { factor, halves: (0..2 * n * factor).map(|m| of((2 * m + 1) as f64 * unit)).collect() }
    }

    /// `sinh(w_i - w_k)`.
    pub(super) fn sinh(&self, i: usize, k: usize) -> f64 {
        // In halves of a fine step.
        let (v, u) = ((2 * i + 1) * self.factor, 2 * k);
        let (cosh, sinh) = (self.halves[v.midpoint(u)].0, self.halves[v.abs_diff(u) / 2].1);
        let size = (PI * cosh * sinh).sinh();
        if v < u { -size } else { size }
    }

    /// `x_i - x_k`, to full relative precision also where both are near the same end.
    pub(super) fn minus(&self, (i, v): (usize, &Place), (k, u): (usize, &Place)) -> f64 {
        self.sinh(i, k) * v.sech * u.sech
    }
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
                let v = Place::new((i as f64 + 0.5) * step);
                for k in 0..=n * factor {
                    let u = Place::new(k as f64 * step / factor as f64);
                    let ahead = PI * (0.5 * (v.u + u.u)).cosh() * (0.5 * (v.u - u.u)).sinh();
                    let got = apart.minus((i, &v), (k, &u));
                    // Roundings of u grow by up to w = 26 on their way.
                    let ratio = got / (ahead.sinh() * v.sech * u.sech);
                    assert!((ratio - 1.0).abs() < 3e-14, "{ratio}: {factor}, {i}, {k}");
                    assert!((got - (v.x - u.x)).abs() < 3e-14, "{got}: {factor}, {i}, {k}");
                }
            }
        }
    }
}
