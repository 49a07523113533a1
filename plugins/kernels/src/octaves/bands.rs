//! The flexibility on octaves of wave numbers.

use crate::integrand::Integrand;
use crate::legendre_waves::{add_transforms, values, waves_of};
use bilby::GaussLegendre;
use num_complex::Complex64;
use slipzone_api::{Component, KernelRequest, LayerResponse, Refusal, SurfaceFlexibility, contract};
use spec_math::cephes64::erfc;

/// Gauss nodes of a band: a function that is analytic but at the origin has Legendre coefficients there that fall like
/// `5.8^-l`.
const NODES: usize = 20;
/// Coefficients that must be small at the end of a series.
const LAST: usize = 3;
/// Where a band is looked at beside its nodes: near either end, where a polynomial that misses something is off most.
const BESIDE: [f64; 2] = [-0.999, 0.993];
/// Rounding of `s F`, of order one, in what a band leaves unresolved.
const NOISE: f64 = 4e-14;
/// Share of the accuracy that a band may miss.
const SHARE: f64 = 1e-3;
/// Narrowest band over its upper end.
const NARROWEST: f64 = 1e-3;
/// And at the origin, over the inverse of the extent.
const NEAREST: f64 = 1e-9;
/// Most wave numbers for one table.
const MOST_SAMPLES: usize = 1 << 14;
/// What is faded out is felt by this part of the accuracy at most: by contacts, and by what is as narrow as may be,
/// slip zones and rounded corners.
const FELT: (f64, f64) = (1e-3, 0.1);
/// `W` that is no larger, and over so many octaves gets no smaller than by that factor, is what the flexibility itself
/// is off by. The slowest powers that get that small before the highest wave number take more than half off.
const FLAT: (f64, usize, f64) = (1e-10, 3, 0.9);
/// Highest wave number over the inverse of the extent: shorter waves are for none.
pub(super) const HIGHEST: f64 = 1e30;
/// Steepness of the window over the logarithm of the wave number, and where nothing is left of it.
const STEEP: f64 = 3.0;
const GONE: f64 = 7.2;
/// Phase of the wave at which the window is half gone, where it is the distance that sets it.
pub(super) const PHASE: f64 = 128.0;

/// `W` of each kernel at Gauss nodes of one band after the other.
pub(super) struct Bands {
    all: Vec<Band>,
    rule: Rule,
    /// Where the last window is half gone.
    pub(super) highest: f64,
    /// In the terms of the request.
    pub(super) error: f64,
    /// What an edge feels of waves that are shorter still.
    pub(super) edge_error: f64,
    pub(super) evaluations: usize,
}

struct Band {
    lower: f64,
    upper: f64,
    /// A row for each kernel.
    values: Vec<[f64; NODES]>,
}

/// Transforms of the bands, faded out: what is left below one distance is as good at larger ones.
pub(super) struct Faded {
    /// Middle, half of the width, and the waves of each kernel.
    bands: Vec<(f64, f64, Vec<Vec<f64>>)>,
}

impl Bands {
    /// Bands up to where nothing more is felt, or to where all is `known` from, as accurate as is asked for.
    pub(super) fn new(
        integrands: &[Integrand],
        response: &dyn LayerResponse,
        extent: f64,
        request: &KernelRequest,
        known: Option<f64>,
    ) -> Result<Self, Refusal> {
        let (highest, error) = (f64::INFINITY, 0.0);
        let mut bands = Self { all: Vec::new(), rule: Rule::new(), highest, error, edge_error: 0.0, evaluations: 0 };
        // For the end of each octave: what a wave there adds to all that is felt.
        let mut ends: Vec<(f64, [f64; 2])> = Vec::new();
        let mut lower = 0.0;
        // No window is felt within the first.
        let first = extent.recip().min(PHASE / (GONE * request.reach));
        while lower < GONE * bands.highest {
            let upper = if lower == 0.0 { first } else { 2.0 * lower };
            bands.add(integrands, response, (lower, upper), (extent, request))?;
            lower = upper;
            if bands.highest < f64::INFINITY {
                continue;
            }
            if let Some(known) = known {
                if upper >= known {
                    bands.highest = upper;
                }
                continue;
            }
            let f = response.surface(upper)?;
            contract::numbers(&[upper], &[f])?;
            bands.evaluations += 1;
            // By the contact as a whole, and by a part of it that is as narrow as may be.
            let felt = |integrand: &Integrand| {
                let (size, width) = (integrand.weight(upper, &f).abs(), (upper * request.reach).recip());
                // Of the depth no more than it is.
                if integrand.component == Component::Depth {
                    let felt = upper * size * width.min(1.0);
                    [felt, felt]
                } else {
                    [size * width, size]
                }
            };
            let both = integrands.iter().map(felt).reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1])]);
            let both = both.unwrap_or_default();
            ends.push((upper, both));
            // All that a window here would take away.
            let [whole, narrow] =
                [0, 1].map(|of| ends.iter().map(|(s, felt)| felt[of] * window(upper / s)).sum::<f64>());
            let is_enough = whole <= FELT.0 * request.accuracy && narrow <= FELT.1 * request.accuracy;
            let (size, octaves, least) = FLAT;
            let before = ends.iter().rev().nth(octaves).map_or(f64::INFINITY, |(_, felt)| felt[1]);
            let is_flat = both[1] <= size && both[1] >= least * before;
            if is_enough || is_flat || upper * extent >= HIGHEST {
                bands.highest = upper;
                bands.error += whole;
                bands.edge_error = if is_enough { 0.0 } else { narrow };
            }
        }
        Ok(bands)
    }

    /// Adds what lies between two wave numbers, halved until it is resolved.
    fn add(
        &mut self,
        integrands: &[Integrand],
        response: &dyn LayerResponse,
        whole: (f64, f64),
        (extent, request): (f64, &KernelRequest),
    ) -> Result<(), Refusal> {
        let mut stack = vec![whole];
        while let Some((lower, upper)) = stack.pop() {
            let (middle, half) = (f64::midpoint(lower, upper), 0.5 * (upper - lower));
            let place = |i: usize| if i < NODES { self.rule.nodes[i] } else { BESIDE[i - NODES] };
            let at: [f64; NODES + BESIDE.len()] = std::array::from_fn(|i| middle + half * place(i));
            let mut f = [SurfaceFlexibility::default(); NODES + BESIDE.len()];
            response.surface_into(&at, &mut f)?;
            contract::numbers(&at, &f)?;
            self.evaluations += at.len();
            let (mut values, mut error, mut is_resolved) = (Vec::with_capacity(integrands.len()), 0.0_f64, true);
            for integrand in integrands {
                let own: [f64; NODES + BESIDE.len()] = std::array::from_fn(|i| integrand.weight(at[i], &f[i]));
                let of_nodes: [f64; NODES] = std::array::from_fn(|i| own[i]);
                let off = self.rule.unresolved(&of_nodes, &own[NODES..]);
                let largest = own.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
                // An error over the band makes one of the kernel that is as wide up to `t = 1/half` and falls like 1/t
                // from there on. A pole that is taken off leaves the rounding of what it was.
                let (felt, size) = if integrand.component == Component::Depth {
                    (2.0 * half, largest.max(middle.recip()))
                } else {
                    let phase = half * request.reach;
                    (phase.min(1.0) + phase.ln_1p(), largest.max(1.0 + integrand.pole / at[NODES]))
                };
                is_resolved &= off * felt <= SHARE * request.accuracy || off <= NOISE * size;
                error = error.max(off * felt);
                values.push(of_nodes);
            }
            let width = if lower == 0.0 { upper * extent / NEAREST } else { (upper - lower) / (NARROWEST * upper) };
            if !is_resolved && width > 1.0 && self.evaluations < MOST_SAMPLES {
                stack.extend([(middle, upper), (lower, middle)]);
                continue;
            }
            self.error += error;
            self.all.push(Band { lower, upper, values });
        }
        Ok(())
    }

    /// The bands as far as they are felt at a distance and beyond.
    pub(super) fn faded(&self, distance: f64) -> Faded {
        let scale = (PHASE / distance).min(self.highest);
        let fade = |band: &Band| {
            let (middle, half) = (f64::midpoint(band.lower, band.upper), 0.5 * (band.upper - band.lower));
            let window: [f64; NODES] = std::array::from_fn(|i| window((middle + half * self.rule.nodes[i]) / scale));
            let waves = |values: &[f64; NODES]| {
                let coefficients = self.rule.coefficients(&std::array::from_fn(|i| window[i] * values[i]));
                waves_of(&coefficients, half).collect()
            };
            (middle, half, band.values.iter().map(waves).collect())
        };
        Faded { bands: self.all.iter().take_while(|band| band.lower < GONE * scale).map(fade).collect() }
    }
}

impl Faded {
    /// The transforms at a distance: of odd kernels the imaginary part, of even ones the real one.
    pub(super) fn at(&self, t: f64, out: &mut [Complex64]) {
        out.fill(Complex64::default());
        let mut bessel = [0.0; NODES];
        for (middle, half, waves) in &self.bands {
            add_transforms((*middle, *half), waves.iter().map(Vec::as_slice), t, &mut bessel, out);
        }
    }
}

/// What is left of a wave number over that at which half is.
fn window(x: f64) -> f64 {
    0.5 * erfc(STEEP * x.ln())
}

/// Gauss's nodes, and what leads from values there to Legendre coefficients.
struct Rule {
    nodes: Vec<f64>,
    /// `(l + 1/2) w_i P_l(x_i)`, a row for each `l`.
    projector: Vec<[f64; NODES]>,
}

impl Rule {
    fn new() -> Self {
        let gauss = GaussLegendre::new(NODES).expect("at least one node").rule().clone();
        let mut projector = vec![[0.0; NODES]; NODES];
        for (i, (x, weight)) in gauss.nodes.iter().zip(&gauss.weights).enumerate() {
            for (l, (row, p)) in projector.iter_mut().zip(values(*x)).enumerate() {
                row[i] = (l as f64 + 0.5) * weight * p;
            }
        }
        Self { nodes: gauss.nodes, projector }
    }

    fn coefficients(&self, values: &[f64; NODES]) -> [f64; NODES] {
        std::array::from_fn(|l| self.projector[l].iter().zip(values).map(|(p, v)| p * v).sum())
    }

    /// What a series through these values leaves: the last of its terms, and how far off it is beside the nodes.
    fn unresolved(&self, values: &[f64; NODES], beside: &[f64]) -> f64 {
        let coefficients = self.coefficients(values);
        let last = coefficients[NODES - LAST..].iter().fold(0.0_f64, |most, c| most.max(c.abs()));
        let seen = BESIDE.iter().zip(beside).map(|(x, value)| (series(&coefficients, *x) - value).abs());
        seen.fold(last, f64::max)
    }
}

/// A Legendre series at a point.
fn series(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().zip(values(x)).map(|(c, p)| c * p).sum()
}
