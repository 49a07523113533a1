//! How many terms of a series are told by its coefficients, and what is beside them.

use crate::even_table::clenshaw;

/// Fewest terms that may do, and how many are left over for what is beside them.
const FEWEST: usize = 4;
const LEFT: usize = 2;
/// So many terms more and fewer tell the error.
const MORE: usize = 2;

/// A Chebyshev series that is to be true at the origin, beyond the places where it was found.
pub(super) struct Told {
    pub(super) coefficients: Vec<f64>,
    /// Of what is beside it.
    pub(super) analytic: f64,
    /// By how much series of some terms more and fewer differ from it at the origin.
    pub(super) off_at_origin: f64,
}

impl Told {
    /// So many terms that the last of them are least at the `origin`, a place beyond `[-1, 1]`: fewer miss what is
    /// there, and more are noise, which grows towards it. One of them may be small by chance, so that others tell the
    /// error: no less than what is off where the function is no such series, but one in other powers or with
    /// logarithms.
    ///
    /// `beside` are the coefficients of what no series tells. The coefficients left over meet it: next to the places of
    /// a whole interpolant it would differ from that by less than the noise.
    pub(super) fn by(all: &[f64], beside: Option<&[f64]>, origin: f64) -> Self {
        // There `T_k` is `cosh(k growth)`, but for its sign.
        let growth = origin.abs().acosh();
        let told = |terms: usize| {
            let analytic = beside.map_or(0.0, |beside| met(&all[terms..], &beside[terms..]));
            let coefficient = |k: usize| all[k] - beside.map_or(0.0, |beside| analytic * beside[k]);
            let coefficients: Vec<f64> = (0..terms).map(coefficient).collect();
            let last = (terms - 2..terms).map(|k| coefficients[k].abs() * (k as f64 * growth).cosh());
            Self { off_at_origin: last.fold(0.0, f64::max), coefficients, analytic }
        };
        let mut all: Vec<Self> = (FEWEST..=all.len() - LEFT).map(told).collect();
        let by_last_terms = |one: &usize, other: &usize| all[*one].off_at_origin.total_cmp(&all[*other].off_at_origin);
        let least = (0..all.len()).min_by(by_last_terms).expect("a few");
        let there = |told: &Self| clenshaw(&told.coefficients, origin);
        let others = &all[least.saturating_sub(MORE)..(least + MORE + 1).min(all.len())];
        let apart = others.iter().map(|other| (there(other) - there(&all[least])).abs()).fold(0.0, f64::max);
        Self { off_at_origin: apart, ..all.swap_remove(least) }
    }
}

/// How much of something there is, by least squares.
fn met(all: &[f64], of: &[f64]) -> f64 {
    let (sum, square) = all.iter().zip(of).fold((0.0, 0.0), |(sum, square), (c, of)| (sum + c * of, square + of * of));
    if square > 0.0 { sum / square } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::even_table::chebyshev;
    use std::f64::consts::PI;

    const NODES: usize = 12;

    /// From 0.1 to 1.
    fn place(z: f64) -> f64 {
        (z - 0.55) / 0.45
    }

    fn at(i: usize) -> f64 {
        0.55 + 0.45 * (PI * (2 * i + 1) as f64 / (2 * NODES) as f64).cos()
    }

    /// With noise in the last digits.
    #[test]
    fn a_series_and_what_is_beside_it_are_true_at_the_origin() {
        let (series, beside) = (|z: f64| 1.0 / (5.0 - z), |z: f64| z.powi(3) * z.ln());
        let noise = |i: usize| 1e-13 * ((7 * i % 5) as f64 - 2.0);
        let values: Vec<f64> = (0..NODES).map(|i| series(at(i)) + 3e-4 * beside(at(i)) + noise(i)).collect();
        let of_beside = chebyshev(&(0..NODES).map(|i| beside(at(i))).collect::<Vec<_>>());
        let told = Told::by(&chebyshev(&values), Some(&of_beside), place(0.0));
        let off = (clenshaw(&told.coefficients, place(0.0)) - series(0.0)).abs();
        assert!(off < 3e-10 && off < told.off_at_origin, "off by {off:e}, said {:e}", told.off_at_origin);
        assert!((told.analytic / 3e-4 - 1.0).abs() < 1e-2, "{:e}", told.analytic);
    }

    /// Other powers of `z` and logarithms, `z` times what is told: nearer to the origin than 0.1 it is off by hardly
    /// more than is said.
    #[test]
    fn what_is_no_series_is_not_said_to_be_one() {
        let powers = [0.5, 0.9, 0.99, 1.001, 1.034, 1.25, 1.5, 2.5, 3.3];
        let by_powers =
            powers.into_iter().map(|power| -> Box<dyn Fn(f64) -> f64> { Box::new(move |z| z + z.powf(power)) });
        let by_logarithms: [Box<dyn Fn(f64) -> f64>; 4] = [
            Box::new(|z| z * z.ln()),
            Box::new(|z| z * z.ln() * z.ln()),
            Box::new(|z| 1.0 / (50.0 - 20.0 * z.ln())),
            Box::new(|z| 1.0 / (1.0 - 20.0 * z.ln())),
        ];
        for (i, kernel) in by_powers.chain(by_logarithms).enumerate() {
            let values: Vec<f64> = (0..NODES).map(|i| kernel(at(i)) / at(i)).collect();
            let told = Told::by(&chebyshev(&values), None, place(0.0));
            let off = |z: f64| (z * clenshaw(&told.coefficients, place(z)) - kernel(z)).abs();
            let most = (1..=400).map(|k| off(0.1 / 400.0 * f64::from(k))).fold(off(1e-9), f64::max);
            let said = 0.1 * told.off_at_origin;
            assert!(most < 1.3 * said && said < 20.0 * most, "kernel {i}: off by {most:e}, said {said:e}");
        }
    }
}
