//! Layers that the tests of this crate share.

use slipzone_api::{
    Base, Flexibility, LayerModel, Moduli, ModulusLaw, Plane, Poisson, Positive, Solid, SurfaceFlexibility,
};
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

/// A law that is looked at, too, at depths that it names.
#[derive(Debug)]
pub(crate) struct Probed {
    pub(crate) law: Opaque,
    pub(crate) probes: Vec<f64>,
}

impl ModulusLaw for Probed {
    fn modulus(&self, depth: f64) -> f64 {
        self.law.modulus(depth)
    }

    fn probes(&self) -> &[f64] {
        &self.probes
    }
}

pub(crate) fn bonded(law: impl ModulusLaw + 'static, plane: Plane, nu: f64) -> Arc<LayerModel> {
    let solid = Solid { plane, poisson: Poisson::new(nu).unwrap(), moduli: Moduli::Shear };
    Arc::new(LayerModel::new(Box::new(law), solid, Base::Rigid))
}

/// The same layer on another base.
pub(crate) fn on(layer: Arc<LayerModel>, base: Base) -> Arc<LayerModel> {
    Arc::new(LayerModel { base, ..Arc::into_inner(layer).unwrap() })
}

/// Bonded to a half-plane of that shear modulus and Poisson's ratio.
pub(crate) fn substrate(shear: f64, nu: f64) -> Base {
    Base::HalfPlane { shear: Positive::new(shear).unwrap(), poisson: Poisson::new(nu).unwrap() }
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

/// `s Fvv/A0` of a homogeneous bonded layer in plane strain (theory, section 2), numerator and denominator
/// times `exp(-2w)` so that neither overflows.
pub(crate) fn bonded_vv(w: f64, nu: f64) -> f64 {
    let (kappa, x) = (3.0 - 4.0 * nu, 2.0 * w);
    let fade = (-x).exp();
    let (sinh, cosh) = (-(-2.0 * x).exp_m1() / 2.0, f64::midpoint(1.0, fade * fade));
    // sinh x - x, whose difference cancels for small x: by its series there.
    let rest = if x < 0.5 {
        let series = (1..12).rev().fold(0.0, |sum, k| (1.0 + sum) * x * x / f64::from(2 * k * (2 * k + 1)));
        fade * x * series
    } else {
        sinh - x * fade
    };
    ((kappa - 1.0) * sinh + rest) / (kappa * cosh + fade * (2.0 * w * w + 5.0 - 12.0 * nu + 8.0 * nu * nu))
}

/// `(nu, gamma, s, [vv, uu, uv])` in plane strain: `s F/A0 = s P11^-1 P12 4/(kappa + 1)` with the
/// propagator `P = exp(K)`, `K` from `slice::generator`, by mpmath's `expm` with 80 digits.
#[allow(clippy::excessive_precision, clippy::unreadable_literal)] // as they were computed
pub(crate) const GOLDEN: [(f64, f64, f64, [f64; 3]); 12] = [
    (0.3, -13.8, 0.001, [29.121806940410983281, 100.44260076766072412, 0.013278462999273003777]),
    (0.3, -13.8, 0.7, [3298.889754314275008, 18.260828391357123084, -165.58691006543329935]),
    (0.3, -13.8, 12.0, [4.1140074734761803339, 1.7707140069300995418, -1.4029818260883636241]),
    (0.3, 13.8, 0.001, [0.000029577018237761163822, 0.00010351956189088842097, 1.0716159995293210832e-9]),
    (0.3, 13.8, 12.0, [0.33276676194621012759, 0.62071400695351779863, -0.027910718141172957056]),
    (0.3, -2.0, 0.7, [0.92872566810172342688, 1.4255887737036690297, 0.00070881539855525276564]),
    (0.5, -13.8, 0.7, [332.29028540707994518, 10.203580001549805437, -10.386545099672280155]),
    (0.5, 13.8, 0.001, [1.5218581329435147698e-12, 0.00014492738447308798203, 1.0501836858439994167e-8]),
    (0.5, 2.0, 5.0, [0.56611563863712319894, 0.83687954819652376388, 0.13141612251042790576]),
    (-0.99, -13.8, 12.0, [2.5986360921612935031, 1.6671172043167634852, -1.5694311867380075783]),
    (-0.99, 13.8, 0.001, [0.000027264691743340821134, 0.000036413917128313438483, -3.2883711433174903083e-9]),
    (-0.99, 13.8, 12.0, [0.42749053583324553211, 0.51711728654663953695, -0.31349647484503867]),
];
