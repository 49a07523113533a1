//! What stands before the wave in each kernel, freed of what is singular at long waves.

use slipzone_api::{Component, LayerResponse, Parts, SurfaceFlexibility};
use std::f64::consts::FRAC_PI_2;

/// `W(s)` in `k(t) = int_0^inf W(s) {sin, cos}(st) ds`, and what is to be added to that.
///
/// A layer that slides on its base brings a pole `c/s` at the origin: `int_0^inf (c/s) sin(st) ds = c (pi/2) sign(t)`.
/// The depth's own `1/s` beyond is that of `[1 - exp(-s)]/s`, with `int_0^inf [1 - exp(-s)] cos(st)/s ds = log(1 +
/// 1/t^2)/2`.
#[derive(Clone, Debug)]
pub(crate) struct Integrand {
    pub(crate) component: Component,
    /// `c`.
    pub(crate) pole: f64,
    beta: f64,
}

impl Integrand {
    pub(crate) fn new(component: Component, response: &dyn LayerResponse) -> Self {
        let pole = if component == Component::ShearStrain { response.pole() } else { 0.0 };
        Self { component, pole, beta: response.elastic().beta() }
    }

    /// `W(s)`, `s > 0`.
    pub(crate) fn weight(&self, s: f64, f: &SurfaceFlexibility) -> f64 {
        match self.component {
            Component::NormalSlope => f.vv - 1.0,
            Component::ShearStrain => f.uu - 1.0 - self.pole / s,
            Component::Coupling => f.uv + self.beta,
            Component::Depth => (f.vv + (-s).exp_m1()) / s,
        }
    }

    /// The kernel at `t >= 0`, of which the transform of `W` is known.
    pub(crate) fn parts(&self, t: f64, transform: f64) -> Parts {
        let (smooth, log) = match self.component {
            Component::Depth => (transform + 0.5 * (t * t).ln_1p(), -1.0),
            _ => (transform, 0.0),
        };
        Parts { smooth, sign: FRAC_PI_2 * self.pole, log }
    }
}
