//! The kernels next to the origin, of laws that begin with a broken power of the depth.

use crate::integrand::Integrand;
use num_complex::Complex64;
use slipzone_api::Component;
use std::f64::consts::PI;

/// Powers of `z` that are told.
const POWERS: usize = 12;
/// Share of the accuracy that may be missed, there and at the origin.
const SHARE: f64 = 0.1;
/// Noise of the transforms.
const NOISE: f64 = 1e-13;

/// `t k = sum c_j z^j`, `z = t^p`, `p` the power with which the law begins; in even kernels with `c t` beside it, for what is analytic there. Of the
/// depth it is `k` itself that is such a series, with a constant.
///
/// Found between two distances, and true down to 0, where all of it but that constant vanishes: past the last wave number nothing else tells.
#[derive(Clone, Debug)]
pub(crate) struct Origin {
    pub(crate) power: f64,
    /// Up to which distance.
    pub(crate) end: f64,
    /// Of `z` where it was found: the middle, and half of the width.
    within: (f64, f64),
    beside: Beside,
    series: Vec<Series>,
}

/// What is beside the powers of `z` in an even kernel.
#[derive(Clone, Copy, Debug)]
enum Beside {
    /// `t`.
    Distance,
    /// `t log t`, where `t` is one of the powers, and is met by what is analytic.
    Logarithm,
}

impl Beside {
    fn new(power: f64) -> Self {
        const WHOLE: f64 = 1e-7;
        let powers = power.recip();
        if (powers - powers.round()).abs() < WHOLE * powers { Self::Logarithm } else { Self::Distance }
    }

    fn at(self, t: f64) -> f64 {
        match self {
            Self::Distance => t,
            Self::Logarithm => t * t.ln(),
        }
    }
}

/// One kernel's.
#[derive(Clone, Debug)]
struct Series {
    /// Chebyshev's, of what is left if the first power is divided out; of the depth nothing is.
    coefficients: [f64; POWERS],
    /// `c`.
    analytic: f64,
    is_depth: bool,
}

impl Origin {
    /// Found from their transforms between two distances; `None` where the kernels are no such series to within the accuracy, in the terms of the request.
    pub(crate) fn new(
        integrands: &[Integrand],
        mut transforms_at: impl FnMut(f64, &mut [Complex64]),
        (beginning, end): (f64, f64),
        power: f64,
        accuracy: f64,
    ) -> Option<Self> {
        let (first, last) = (beginning.powf(power), end.powf(power));
        let within = (f64::midpoint(first, last), 0.5 * (last - first));
        let node = |i: usize| (PI * (i as f64 + 0.5) / POWERS as f64).cos();
        let between = |i: usize| (PI * i as f64 / POWERS as f64).cos();
        let places = (0..POWERS).map(node).chain([0, 1, POWERS / 2, POWERS - 1, POWERS].map(between));
        let at: Vec<(f64, f64)> =
            places.map(|x| within.1.mul_add(x, within.0)).map(|z| (z.powf(power.recip()), z)).collect();
        let mut transforms = vec![Complex64::default(); integrands.len()];
        let mut values = vec![Vec::with_capacity(at.len()); integrands.len()];
        for (t, z) in &at {
            transforms_at(*t, &mut transforms);
            for ((values, transform), integrand) in values.iter_mut().zip(&transforms).zip(integrands) {
                values.push(match integrand.component {
                    Component::Depth => transform.re,
                    component => t / z * if component.is_odd() { transform.im } else { transform.re },
                });
            }
        }
        let mut origin =
            Self { power, end, within, beside: Beside::new(power), series: Vec::with_capacity(integrands.len()) };
        let beside = Beside::new(power);
        let of_distance: Vec<f64> = at.iter().map(|(t, z)| beside.at(*t) / z).collect();
        let distance = coefficients(&of_distance[..POWERS]);
        for (values, integrand) in values.iter().zip(integrands) {
            let is_depth = integrand.component == Component::Depth;
            let mut series = Series { coefficients: coefficients(&values[..POWERS]), analytic: 0.0, is_depth };
            let left = |of: &[f64; POWERS], values: &[f64], i: usize| values[i] - sum(of, origin.place(at[i].1));
            if !is_depth && !integrand.component.is_odd() {
                let off = |i: &usize| left(&distance, &of_distance, *i);
                let most = (POWERS..at.len()).max_by(|a, b| off(a).abs().total_cmp(&off(b).abs()))?;
                if off(&most).abs() > f64::EPSILON.sqrt() * of_distance[0].abs() {
                    series.analytic = left(&series.coefficients, values, most) / off(&most);
                    for (c, of) in series.coefficients.iter_mut().zip(&distance) {
                        *c -= series.analytic * of;
                    }
                }
            }
            let missed = |i: usize| {
                let (t, z) = at[i];
                let told = sum(&series.coefficients, origin.place(z)) + series.analytic * beside.at(t) / z;
                (told - values[i]).abs() * if is_depth { 1.0 } else { z }
            };
            let here = (POWERS..at.len()).map(missed).fold(0.0, f64::max);
            // A term less, at the origin: felt no farther than to where it was found.
            let last = series.coefficients[POWERS - 1] * sum(&unit(), origin.place(0.0));
            let there = last.abs() * if is_depth { beginning } else { first };

            if !(here <= SHARE.mul_add(accuracy, 10.0 * NOISE) && there < 1e-4) {
                return None;
            }
            origin.series.push(series);
        }
        Some(origin)
    }

    fn place(&self, z: f64) -> f64 {
        (z - self.within.0) / self.within.1
    }

    /// The transform that makes one of the kernels, at a distance.
    pub(crate) fn transform(&self, kernel: usize, t: f64) -> f64 {
        let series = &self.series[kernel];
        let z = t.powf(self.power);
        let told = sum(&series.coefficients, self.place(z));
        if series.is_depth { told } else { z / t * told + series.analytic * self.beside.at(t) / t }
    }
}

/// Of the last of Chebyshev's polynomials.
fn unit() -> [f64; POWERS] {
    std::array::from_fn(|k| if k == POWERS - 1 { 1.0 } else { 0.0 })
}

/// From values at Chebyshev's nodes.
fn coefficients(values: &[f64]) -> [f64; POWERS] {
    let n = POWERS as f64;
    std::array::from_fn(|k| {
        let wave = |i: usize| (PI * k as f64 * (i as f64 + 0.5) / n).cos();
        let sum: f64 = values.iter().enumerate().map(|(i, value)| value * wave(i)).sum();
        sum * if k == 0 { 1.0 } else { 2.0 } / n
    })
}

/// Clenshaw's sum.
fn sum(coefficients: &[f64; POWERS], x: f64) -> f64 {
    let (first, later) = coefficients.split_first().expect("some");
    let (a, b) = later.iter().rev().fold((0.0, 0.0), |(a, b), c| (2.0 * x * a - b + c, a));
    x * a - b + first
}
