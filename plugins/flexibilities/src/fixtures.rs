//! Layers that the tests of this crate share.

use slipzone_api::{Base, Elastic, Flexibility, LayerModel, ModulusLaw, Plane, Poisson, SurfaceFlexibility};
use std::sync::Arc;

/// `2 exp(gamma y)`: the surface modulus must drop out.
#[derive(Debug)]
pub(crate) struct Exponential(pub(crate) f64);

impl ModulusLaw for Exponential {
    fn modulus(&self, depth: f64) -> f64 {
        2.0 * (self.0 * depth).exp()
    }

    fn exponent(&self) -> Option<f64> {
        Some(self.0)
    }
}

/// A law of which nothing is known but its values and its breakpoints.
#[derive(Debug)]
pub(crate) struct Opaque {
    pub(crate) modulus: fn(f64) -> f64,
    pub(crate) breakpoints: &'static [f64],
}

impl ModulusLaw for Opaque {
    fn modulus(&self, depth: f64) -> f64 {
        (self.modulus)(depth)
    }

    fn breakpoints(&self) -> &[f64] {
        self.breakpoints
    }
}

/// A law that also tells its Taylor series at the surface, which ends after the coefficients given.
#[derive(Debug)]
pub(crate) struct Smooth {
    pub(crate) law: Opaque,
    pub(crate) series: &'static [f64],
}

impl ModulusLaw for Smooth {
    fn modulus(&self, depth: f64) -> f64 {
        self.law.modulus(depth)
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        self.series.iter().copied().chain(std::iter::repeat(0.0)).take(terms).collect()
    }
}

pub(crate) fn bonded(law: impl ModulusLaw + 'static, plane: Plane, nu: f64) -> Arc<LayerModel> {
    let elastic = Elastic::new(plane, Poisson::new(nu).unwrap());
    Arc::new(LayerModel { law: Box::new(law), elastic, base: Base::Rigid })
}

/// Plane strain, rigid base, `exp(gamma y)`.
pub(crate) fn exponential(gamma: f64, nu: f64) -> Arc<LayerModel> {
    bonded(Exponential(gamma), Plane::Strain, nu)
}

/// One wave number by one method.
pub(crate) fn at(method: &dyn Flexibility, layer: &Arc<LayerModel>, s: f64) -> SurfaceFlexibility {
    method.respond(layer).unwrap().surface(s).unwrap()
}

/// Largest difference between two flexibilities: `vv`, `uu` relative to themselves, `uv`, which may pass
/// through zero, to the scale `sqrt(vv uu)` that bounds it.
pub(crate) fn distance(x: SurfaceFlexibility, y: SurfaceFlexibility) -> f64 {
    [(x.vv - y.vv) / y.vv, (x.uu - y.uu) / y.uu, (x.uv - y.uv) / (y.vv * y.uu).sqrt()]
        .into_iter()
        .fold(0.0, |worst, d| worst.max(d.abs()))
}
