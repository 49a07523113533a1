//! One kernel as an integral: what stands before the wave, and its series.

use slipzone_api::{Component, LayerResponse, SurfaceFlexibility};

/// `k(t) = int_0^inf W(s) {sin, cos}(st) ds` with `W ~ sum_k series[k - 1] s^-k` as `s` grows.
///
/// The depth needs no special treatment here: `W = s Fvv/(A0 s)` is finite at `s = 0` on a rigid base, and its
/// logarithm comes from the leading term of its series, which is 1. Of a pole `c/s` at the origin, which a layer that
/// slides on its base brings, `W` and its series are freed: `int_0^inf (c/s) sin(st) ds = c (pi/2) sign(t)` is added at
/// the end.
#[derive(Clone, Debug)]
pub(super) struct Column {
    pub(super) component: Component,
    /// All coefficients that are known.
    pub(super) series: Vec<f64>,
    /// Error aimed at, in the kernel's own unit.
    pub(super) aim: f64,
    /// `c`.
    pub(super) pole: f64,
    /// Relative error that the flexibility was allowed.
    pub(super) roughness: f64,
    beta: f64,
}

impl Column {
    /// `accuracy` is in the terms of [`slipzone_api::KernelRequest`].
    pub(super) fn new(
        component: Component,
        response: &dyn LayerResponse,
        tail: &[SurfaceFlexibility],
        accuracy: f64,
        reach: f64,
    ) -> Self {
        let (mut series, aim): (Vec<f64>, f64) = match component {
            Component::NormalSlope => (tail.iter().map(|c| c.vv).collect(), accuracy / reach),
            Component::ShearStrain => (tail.iter().map(|c| c.uu).collect(), accuracy / reach),
            Component::Coupling => (tail.iter().map(|c| c.uv).collect(), accuracy / reach),
            Component::Depth => (std::iter::once(1.0).chain(tail.iter().map(|c| c.vv)).collect(), accuracy),
        };
        // Of a kernel of order one, coarser than this is no answer at all.
        let aim = aim.min(COARSEST);
        let pole = if component == Component::ShearStrain { response.pole() } else { 0.0 };
        if pole != 0.0 {
            series.resize(series.len().max(1), 0.0);
            series[0] -= pole;
        }
        Self { component, series, aim, pole, roughness: 0.0, beta: response.elastic().beta() }
    }

    /// The same of a flexibility that may err by as much, relatively.
    pub(super) fn roughened(self, roughness: f64) -> Self {
        Self { roughness, ..self }
    }

    /// `W(s)`, `s > 0`.
    pub(super) fn weight(&self, s: f64, f: &SurfaceFlexibility) -> f64 {
        match self.component {
            Component::NormalSlope => f.vv - 1.0,
            Component::ShearStrain => f.uu - 1.0 - if self.pole == 0.0 { 0.0 } else { self.pole / s },
            Component::Coupling => f.uv + self.beta,
            Component::Depth => f.vv / s,
        }
    }

    /// What a relative error of the flexibility is multiplied by in `W(s)`.
    pub(super) fn exposed(&self, s: f64, f: &SurfaceFlexibility) -> f64 {
        match self.component {
            Component::NormalSlope => f.vv.abs(),
            Component::ShearStrain => f.uu.abs(),
            Component::Coupling => (f.vv * f.uu).abs().sqrt(),
            Component::Depth => (f.vv / s).abs(),
        }
    }

    /// The terms of the series to use beyond the cut when `terms` of `s F` are: the depth has one more.
    pub(super) fn used(&self, terms: usize) -> &[f64] {
        let terms = if self.component == Component::Depth { terms + 1 } else { terms };
        &self.series[..terms.min(self.series.len())]
    }

    /// Whether jump and logarithm stay of the kernel's order on `[0, reach]`: the sum of the sizes of their powers.
    pub(super) fn is_moderate(&self, terms: usize, reach: f64) -> bool {
        let mut power = 1.0;
        let sizes = (1..).zip(self.used(terms)).map(|(k, c)| {
            let size = c.abs() * power;
            power *= reach / f64::from(k);
            size
        });
        sizes.sum::<f64>() <= MODERATE * self.series.first().map_or(1.0, |c| c.abs().max(1.0))
    }

    /// The number of terms up to the first beyond `terms` that is not known to vanish: what is left falls like one
    /// power more.
    pub(super) fn vanishing(&self, terms: usize) -> usize {
        self.series[terms..].iter().position(|c| *c != 0.0).map_or(self.series.len(), |more| terms + more)
    }

    /// The number of terms up to the smallest at `s`: all that an asymptotic series can give there.
    pub(super) fn best(&self, s: f64) -> usize {
        let (mut best, mut least, mut power) = (0, f64::INFINITY, 1.0);
        for (k, c) in (1..).zip(&self.series) {
            power /= s;
            let size = (c * power).abs();
            if size <= least || *c == 0.0 {
                (best, least) = (k, if *c == 0.0 { least } else { size });
            }
        }
        best
    }

    /// `W(s)` less the first `terms` of its series.
    pub(super) fn rest(&self, terms: usize, s: f64, f: &SurfaceFlexibility) -> f64 {
        self.weight(s, f) - self.series[..terms].iter().rev().fold(0.0, |sum, c| (sum + c) / s)
    }
}

/// Coarsest error aimed at in a kernel: narrow contacts hardly feel it, but its own shape should be right.
const COARSEST: f64 = 1e-2;

/// How much larger than the kernel's order of magnitude jump and logarithm may be.
pub(super) const MODERATE: f64 = 3.0;
