//! For tests: a made-up layer with `s F/A0 = s/(1 + s)`, whose kernels are the auxiliary functions of Si and Ci.

use slipzone_api::{Component, Elastic, LayerResponse, Plane, Poisson, Refusal, SurfaceFlexibility};
use spec_math::cephes64::sici;
use std::f64::consts::FRAC_PI_2;
use std::sync::atomic::{AtomicUsize, Ordering};

/// `M = -1/(1 + s)` in every entry, in the coupling `+1/(1 + s)`.
#[derive(Default)]
pub(crate) struct Rational {
    /// Terms of its tail that it knows.
    pub(crate) terms: usize,
    /// How often it was asked.
    pub(crate) asked: AtomicUsize,
}

impl Rational {
    pub(crate) fn knowing(terms: usize) -> Self {
        Self { terms, ..Self::default() }
    }
}

impl LayerResponse for Rational {
    fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        self.asked.fetch_add(1, Ordering::Relaxed);
        let f = s / (1.0 + s);
        Ok(SurfaceFlexibility { vv: f, uu: f, uv: 1.0 - f - self.elastic().beta() })
    }

    fn elastic(&self) -> Elastic {
        Elastic::new(Plane::Strain, Poisson::new(0.3).expect("in range"))
    }

    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        let term = |k: usize| if k.is_multiple_of(2) { -1.0 } else { 1.0 };
        (0..terms.min(self.terms)).map(|k| SurfaceFlexibility { vv: term(k), uu: term(k), uv: -term(k) }).collect()
    }

    fn depth(&self) -> Option<f64> {
        Some(1.0)
    }
}

/// `-int sin(st)/(1 + s) ds` or `int cos(st)/(1 + s) ds`.
pub(crate) fn exact(component: Component, t: f64) -> f64 {
    let (si, ci) = sici(t.abs());
    let (sin, cos) = t.abs().sin_cos();
    if component.is_odd() {
        -t.signum() * (ci * sin + (FRAC_PI_2 - si) * cos)
    } else {
        (FRAC_PI_2 - si) * sin - ci * cos
    }
}
