//! Stable recursion of the compliance from the base to the surface.

use crate::slice::Slice;
use crate::surface_tail;
use nalgebra::Matrix4;
use serde::{Deserialize, Serialize};
use slipzone_api::{Base, Elastic, Flexibility, LayerModel, LayerResponse, Refusal, SurfaceFlexibility};

const METHOD: &str = "compliance";

/// Largest `max(s, |gamma|) delta` of a first slice; see [`Slice::thin`].
const THIN: f64 = 0.25;

/// Largest `|ln(mu3/mu1)|`: the moduli, and squares of what fades with them, stay within the range of floats.
const STEEPEST: f64 = 300.0;

/// The compliance `d = C t` between displacement and traction, carried from the base to the surface.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Compliance {}

slipzone_api::register!(Flexibility, "compliance", "compliance carried from the base to the surface; stable for every wave number and grading",
    example: "type = \"compliance\"",
    parameters: [],
    source: "docs/theory.md section 2");

#[typetag::serde(name = "compliance")]
impl Flexibility for Compliance {
    fn respond<'a>(&self, layer: &'a LayerModel) -> Result<Box<dyn LayerResponse + 'a>, Refusal> {
        let elastic = layer.elastic;
        match (layer.base, layer.law.exponent()) {
            (Base::Infinite, Some(0.0)) => Ok(Box::new(HalfPlane { elastic })),
            (Base::Rigid, Some(gamma)) if gamma.abs() <= STEEPEST => Ok(Box::new(Exponential { elastic, gamma })),
            (Base::Rigid, Some(gamma)) => Err(Refusal::OutOfReach {
                method: METHOD,
                why: format!("ln(mu3/mu1) = {gamma} is beyond +-{STEEPEST}"),
                remedy: "use a modulus at the base that is closer to the one at the surface",
            }),
            (Base::Rigid, None) => Err(not_built("a rigid base under a general grading")),
            (Base::Infinite, _) => Err(not_built("a graded solid without a base")),
            (Base::Frictionless, _) => Err(not_built("a base without friction")),
            (Base::HalfPlane { .. }, _) => Err(not_built("an elastic half-plane as base")),
        }
    }
}

/// Bases that only the layers of a later version stand on.
fn not_built(what: &str) -> Refusal {
    Refusal::NotBuilt {
        what: format!("{what} in flexibility `{METHOD}`"),
        remedy: "it arrives with the general layers; until then use a rigid base".into(),
    }
}

/// A homogeneous solid without a base.
#[derive(Debug)]
struct HalfPlane {
    elastic: Elastic,
}

impl LayerResponse for HalfPlane {
    fn surface_into(&self, wave_numbers: &[f64], out: &mut [SurfaceFlexibility]) -> Result<(), Refusal> {
        assert_eq!(wave_numbers.len(), out.len(), "one flexibility per wave number");
        out.fill(surface_tail::half_plane(self.elastic));
        Ok(())
    }

    fn elastic(&self) -> Elastic {
        self.elastic
    }

    fn leading_tail(&self) -> Option<SurfaceFlexibility> {
        Some(SurfaceFlexibility::default())
    }

    fn depth(&self) -> Option<f64> {
        None
    }
}

/// `mu1 exp(gamma y)` on a rigid base: with stresses in units of the local modulus its coefficients are
/// constant, so that all slices of one thickness are equal and the layer is got by doubling one of them.
#[derive(Debug)]
struct Exponential {
    elastic: Elastic,
    gamma: f64,
}

impl Exponential {
    fn surface(&self, s: f64) -> SurfaceFlexibility {
        let doublings = (s.max(self.gamma.abs()) / THIN).log2().ceil().max(1.0);
        // Depths in units of the first slice: s delta and gamma delta are small whatever s is.
        let delta = (-doublings).exp2();
        let (sigma, gamma) = (s * delta, self.gamma * delta);
        let mut slice = Slice::thin(&generator(self.elastic, sigma, gamma), gamma.exp());
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small whole number, at least 1
        for _ in 1..doublings as u32 {
            slice = slice.doubled();
        }
        surface_tail::scaled(&slice.over(&slice.a), sigma, self.elastic)
    }
}

/// The equations of plane elasticity over depth, `z' = K z` for `z = (u, v, sigma_xy/mu, sigma_yy/mu)`, `mu(y) = exp(gamma y)`.
fn generator(elastic: Elastic, s: f64, gamma: f64) -> Matrix4<f64> {
    let (lambda, beta) = (elastic.lambda(), elastic.beta());
    #[rustfmt::skip]
    let k = Matrix4::new(
        0.0, s, 1.0, 0.0,
        -lambda * s, 0.0, 0.0, beta,
        8.0 * s * s / (1.0 + elastic.kappa), 0.0, -gamma, lambda * s,
        0.0, 0.0, -s, -gamma,
    );
    k
}

impl LayerResponse for Exponential {
    fn surface_into(&self, wave_numbers: &[f64], out: &mut [SurfaceFlexibility]) -> Result<(), Refusal> {
        assert_eq!(wave_numbers.len(), out.len(), "one flexibility per wave number");
        for (&s, out) in wave_numbers.iter().zip(out) {
            *out = self.surface(s);
        }
        Ok(())
    }

    fn elastic(&self) -> Elastic {
        self.elastic
    }

    fn leading_tail(&self) -> Option<SurfaceFlexibility> {
        Some(surface_tail::leading_tail(self.elastic, self.gamma))
    }

    fn depth(&self) -> Option<f64> {
        Some(1.0)
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests {
    use super::*;
    use slipzone_api::{ModulusLaw, Plane, Poisson};

    #[derive(Debug)]
    struct Law(f64);
    impl ModulusLaw for Law {
        fn modulus(&self, depth: f64) -> f64 {
            2.0 * (self.0 * depth).exp()
        }
        fn exponent(&self) -> Option<f64> {
            Some(self.0)
        }
    }

    fn layer(gamma: f64, nu: f64) -> LayerModel {
        let elastic = Elastic::new(Plane::Strain, Poisson::new(nu).unwrap());
        LayerModel { law: Box::new(Law(gamma)), elastic, base: Base::Rigid }
    }

    fn at(layer: &LayerModel, s: f64) -> SurfaceFlexibility {
        let mut out = [SurfaceFlexibility::default()];
        Compliance {}.respond(layer).unwrap().surface_into(&[s], &mut out).unwrap();
        out[0]
    }

    /// `s Fvv/A0` of a homogeneous layer bonded to a rigid base, plane strain (theory, section 2), times
    /// `exp(-2w)` above and below so that it does not overflow.
    fn bonded_vv(w: f64, nu: f64) -> f64 {
        let kappa = 3.0 - 4.0 * nu;
        let fade = (-2.0 * w).exp();
        // kappa sinh 2w - 2w = (kappa - 1) sinh 2w + (sinh 2w - 2w), the last by its series for small w.
        let x = 2.0 * w;
        let rest = if x < 0.5 {
            let terms = (1..12).rev().fold(0.0, |sum, k| (1.0 + sum) * x * x / f64::from((2 * k) * (2 * k + 1)));
            fade * x * terms
        } else {
            -(-2.0 * x).exp_m1() / 2.0 - x * fade
        };
        let sinh = -(-2.0 * x).exp_m1() / 2.0;
        let cosh = (1.0 + fade * fade) / 2.0;
        ((kappa - 1.0) * sinh + rest) / (kappa * cosh + fade * (2.0 * w * w + 5.0 - 12.0 * nu + 8.0 * nu * nu))
    }

    #[test]
    fn homogeneous_bonded_layer_in_closed_form() {
        let mut worst = 0.0_f64;
        for nu in [-0.99, -0.5, 0.0, 0.3, 0.45, 0.499_999, 0.5] {
            let layer = layer(0.0, nu);
            for i in 0..=400 {
                let w = 1e-6 * 7e8_f64.powf(f64::from(i) / 400.0);
                let (vv, exact) = (at(&layer, w).vv, bonded_vv(w, nu));
                worst = worst.max((vv / exact - 1.0).abs());
            }
        }
        assert!(worst < 2e-14, "{worst:e}");
    }
}
