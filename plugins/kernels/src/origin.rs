//! The kernels next to the origin, of laws that begin with a broken power of the depth.

mod told;

use crate::even_table::{chebyshev, clenshaw, clenshaw_in_lanes};
use crate::integrand::Integrand;
use crate::piece::Variable;
use num_complex::Complex64;
use slipzone_api::{Component, elementary::ln};
use std::f64::consts::PI;
use told::Told;

/// Places at which a series is found; no more powers of `z` are told.
const POWERS: usize = 12;
/// Share of the accuracy that may be missed, there and at the origin.
const SHARE: f64 = 0.1;
/// Noise of the transforms.
const NOISE: f64 = 1e-13;
/// By how many times what is off at the origin may be felt. Under two powers that differ little, where the kernels are
/// no such series, stick zones were off by up to 500 times that, and edges by less than it.
const FELT: f64 = 1e2;
/// Distances at a time.
const LANES: usize = 8;

/// `t k = sum c_j z^j`, `z = t^p`, `p` the power with which the law begins; in even kernels with `c t` beside it, for
/// what is analytic there. Of the depth it is `k` itself that is such a series, with a constant.
///
/// Found between two distances, and true down to 0, where all of it but that constant vanishes: past the last wave
/// number nothing else tells.
#[derive(Clone, Debug)]
pub(crate) struct Origin {
    pub(crate) power: f64,
    /// Up to which distance.
    pub(crate) end: f64,
    /// By how much the kernels were missed where they were found, in the terms of the request.
    missed: f64,
    /// The same of all that is told by them.
    pub(crate) error: f64,
    /// And at the origin, over what an edge feels.
    pub(crate) edge_error: f64,
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
    integrand: Integrand,
    /// Chebyshev's, of what is left if the first power is divided out; of the depth nothing is.
    coefficients: Vec<f64>,
    /// `c`.
    analytic: f64,
}

impl Series {
    fn is_of_depth(&self) -> bool {
        self.integrand.component == Component::Depth
    }
}

impl Origin {
    /// Found from their transforms between two distances.
    pub(crate) fn new(
        integrands: &[Integrand],
        mut transforms_at: impl FnMut(f64, &mut [Complex64]),
        (beginning, end): (f64, f64),
        power: f64,
    ) -> Self {
        let (first, last) = (beginning.powf(power), end.powf(power));
        let within = (f64::midpoint(first, last), 0.5 * (last - first));
        let between = |i: usize| (PI * i as f64 / POWERS as f64).cos();
        let places = Variable::chebyshev(POWERS, &[0, 1, POWERS / 2, POWERS - 1, POWERS].map(between)).all;
        let distances = places.iter().map(|x| within.1.mul_add(*x, within.0)).map(|z| (z.powf(power.recip()), z));
        let at: Vec<(f64, f64)> = distances.collect();
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
        let beside = Beside::new(power);
        let series = Vec::with_capacity(integrands.len());
        let mut origin = Self { power, end, missed: 0.0, error: 0.0, edge_error: 0.0, within, beside, series };
        let of_distance: Vec<f64> = at.iter().map(|(t, z)| beside.at(*t) / z).collect();
        let distance = chebyshev(&of_distance[..POWERS]);
        for (values, integrand) in values.iter().zip(integrands) {
            let is_depth = integrand.component == Component::Depth;
            let beside_it = !is_depth && !integrand.component.is_odd();
            let all = chebyshev(&values[..POWERS]);
            let Told { coefficients, analytic, off_at_origin } =
                Told::by(&all, beside_it.then_some(&distance), origin.place(0.0));
            let series = Series { integrand: integrand.clone(), coefficients, analytic };
            let missed = |i: usize| {
                let (t, z) = at[i];
                let told = clenshaw(&series.coefficients, places[i]) + series.analytic * beside.at(t) / z;
                (told - values[i]).abs() * if is_depth { 1.0 } else { z }
            };
            let here = (POWERS..at.len()).map(missed).fold(0.0, f64::max);
            // Felt no farther than to where it was found.
            let there = off_at_origin * if is_depth { beginning } else { first };
            // What an even kernel makes of a density there is in proportion to it, however near that is.
            let of_all = if beside_it { there / power } else { 0.0 };
            if !is_depth {
                origin.edge_error = origin.edge_error.max(there);
            }
            origin.missed = origin.missed.max(here);
            origin.error = origin.error.max(here).max(of_all);
            origin.series.push(series);
        }
        origin
    }

    /// Whether the kernels are such series, to within the accuracy in the terms of the request.
    pub(crate) fn is_within(&self, accuracy: f64) -> bool {
        self.missed <= SHARE.mul_add(accuracy, 10.0 * NOISE) && self.felt() <= accuracy.max(FELT * 1e2 * NOISE)
    }

    /// What a contact may feel of its errors.
    pub(crate) fn felt(&self) -> f64 {
        self.error.max(FELT * self.edge_error)
    }

    fn place(&self, z: f64) -> f64 {
        (z - self.within.0) / self.within.1
    }

    /// Writes the parts of one of the kernels at distances of either sign.
    #[inline(always)]
    pub(crate) fn parts_into(&self, component: Component, distances: &[f64], [smooth, sign, log]: [&mut [f64]; 3]) {
        let series = self.series.iter().find(|series| series.integrand.component == component).expect("requested");
        for (here, out) in distances.chunks(LANES).zip(smooth.chunks_mut(LANES)) {
            // At the origin itself it is as large as next to it.
            let mut t = [1.0; LANES];
            t.iter_mut().zip(here).for_each(|(t, distance)| *t = distance.abs().max(f64::MIN_POSITIVE));
            out.copy_from_slice(&self.transforms(series, t)[..here.len()]);
        }
        for (((smooth, sign), log), distance) in smooth.iter_mut().zip(sign).zip(log).zip(distances) {
            let parts = series.integrand.parts(distance.abs(), *smooth);
            *smooth = if component.is_odd() { parts.smooth * distance.signum() } else { parts.smooth };
            *sign = parts.sign;
            *log = parts.log;
        }
    }

    /// The transforms that make a kernel, at some distances.
    #[inline(always)]
    fn transforms(&self, series: &Series, t: [f64; LANES]) -> [f64; LANES] {
        let z = t.map(|t| (self.power * ln(t)).exp());
        let told = clenshaw_in_lanes(&series.coefficients, z.map(|z| self.place(z)));
        if series.is_of_depth() {
            return told;
        }
        let beside = if series.analytic == 0.0 { [0.0; LANES] } else { t.map(|t| series.analytic * self.beside.at(t)) };
        std::array::from_fn(|i| (z[i] * told[i] + beside[i]) / t[i])
    }
}
