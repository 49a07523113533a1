//! Stable recursion of the compliance from the base to the surface.

use crate::by_need::ByNeed;
use crate::exponential::{STEEPEST, too_steep};
use crate::graded_half_plane;
use crate::layered::Layered;
use crate::precision::FULL;
use serde::{Deserialize, Serialize};
use slipzone_api::{Base, Flexibility, LayerModel, LayerResponse, Refusal};
use std::sync::Arc;

const METHOD: &str = "compliance";

/// The compliance `d = C t` between displacement and traction, carried from the base to the surface.
///
/// Good to about 1e-14 for every wave number, gradient (none included) and Poisson's ratio: small entries keep their
/// relative precision too, up to 5e-14 where the moduli differ by a factor of 1e6. A law that is `exp(gamma y)` costs
/// less than a microsecond per wave number, any other little more once the slices are made that all wave numbers share
/// (`cargo bench --bench main -- flexibility/compliance`).
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Compliance {}

slipzone_api::register!(Flexibility, "compliance", "compliance carried from the base to the surface; stable for every wave number and grading",
    example: "type = \"compliance\"",
    parameters: [],
    source: "docs/theory.md section 2");

#[typetag::serde(name = "compliance")]
impl Flexibility for Compliance {
    fn respond(&self, layer: &Arc<LayerModel>) -> Result<Box<dyn LayerResponse>, Refusal> {
        match (layer.base, layer.exponent()) {
            (Base::Infinite, Some(gamma)) => graded_half_plane::response(layer, gamma, METHOD),
            (Base::Infinite, None) => Err(Refusal::NotBuilt {
                what: format!("a graded solid without a base, but for the exponential one, in flexibility `{METHOD}`"),
                remedy: "give the layer a thickness, and a base such as { type = \"half-plane\", ... }".into(),
            }),
            (_, Some(gamma)) if gamma.abs() > STEEPEST => Err(too_steep(METHOD, gamma)),
            // Neither asks for polynomials: less precision would save nothing.
            _ if layer.law.stretches().iter().all(|stretch| stretch.law.exponent().is_some()) => {
                Ok(Box::new(Layered::new(Arc::clone(layer), &FULL, METHOD)?))
            }
            _ => Ok(Box::new(ByNeed::new(Arc::clone(layer), METHOD)?)),
        }
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::{Exponential as Law, GOLDEN, Opaque, at, bonded, bonded_vv, distance, exponential, on};
    use crate::surface_tail;
    use proptest::prelude::*;
    use slipzone_api::{Plane, SurfaceFlexibility};

    fn compliance(layer: &Arc<LayerModel>, s: f64) -> SurfaceFlexibility {
        at(&Compliance {}, layer, s)
    }

    fn entries(x: SurfaceFlexibility) -> [f64; 3] {
        [x.vv, x.uu, x.uv]
    }

    #[test]
    fn homogeneous_bonded_layer_in_closed_form() {
        for nu in [-0.99, -0.5, 0.0, 0.3, 0.45, 0.499_999, 0.5] {
            let layer = exponential(0.0, nu);
            for i in 0..=400 {
                let w = 1e-6 * 7e8_f64.powf(f64::from(i) / 400.0);
                let error = compliance(&layer, w).vv / bonded_vv(w, nu) - 1.0;
                // A few roundings in each of at most 12 doublings, and about as many in the closed form.
                assert!(error.abs() < 2e-14, "nu = {nu}, w = {w:e}: {error:e}");
            }
        }
    }

    #[test]
    fn golden_values_of_strong_gradings() {
        for (nu, gamma, s, [vv, uu, uv]) in GOLDEN {
            let error = distance(compliance(&exponential(gamma, nu), s), SurfaceFlexibility { vv, uu, uv });
            // exp(13.8) is reached by 6 squarings, each of which doubles the relative error.
            assert!(error < 1e-13, "nu = {nu}, gamma = {gamma}, s = {s}: {error:e}");
        }
    }

    #[test]
    fn a_vanishing_gradient_joins_the_homogeneous_layer() {
        for (nu, s) in [(0.3, 1e-3), (0.3, 1.0), (0.3, 30.0), (0.5, 0.1), (-0.9, 3.0), (0.0, 1.0)] {
            let homogeneous = compliance(&exponential(0.0, nu), s);
            for k in 1..=16 {
                let gamma = 10.0_f64.powi(-k);
                let [rising, falling] = [gamma, -gamma].map(|gamma| compliance(&exponential(gamma, nu), s));
                // d ln F/d gamma is at most 1, the first moment of the layer.
                let [up, down] = [rising, falling].map(|graded| distance(graded, homogeneous));
                assert!(up < gamma + 1e-14 && down < 1.1 * gamma + 1e-14, "gamma = {gamma:e}: {up:e}, {down:e}");
                // Smooth: what is even in gamma is of second order.
                let mean = SurfaceFlexibility {
                    vv: f64::midpoint(rising.vv, falling.vv),
                    uu: f64::midpoint(rising.uu, falling.uu),
                    uv: f64::midpoint(rising.uv, falling.uv),
                };
                let even = distance(mean, homogeneous);
                assert!(even < gamma * gamma + 1e-14, "gamma = {gamma:e}: {even:e}");
            }
        }
    }

    /// Found by random scenes: a sublayer of 1e26 was halved 86 times, and the parts counted in 64 bits.
    #[test]
    fn a_wave_however_short_feels_the_surface() {
        let layer = bonded(Opaque { modulus: |depth| 1.0 + depth, breakpoints: &[] }, Plane::Strain, 0.3);
        let limit = surface_tail::half_plane(layer.elastic);
        for s in [1e6, 1e12, 1e18, 1e20, 1e26, 1e40, 1e100] {
            let error = distance(compliance(&layer, s), limit);
            assert!(error < 2.0 / s + 1e-14, "s = {s:e}: {error:e}");
        }
    }

    #[test]
    fn limit_and_tail_at_large_wave_numbers() {
        for (gamma, nu) in [(2.0, 0.3), (-2.0, 0.3), (1.0, 0.5), (-4.0, -0.9)] {
            let layer = exponential(gamma, nu);
            let tail = Compliance {}.respond(&layer).unwrap().tail(1)[0];
            let rest = |s: f64| {
                let (found, limit) = (entries(compliance(&layer, s)), entries(surface_tail::half_plane(layer.elastic)));
                let tail = entries(tail);
                [0, 1, 2].map(|i| (found[i] - limit[i] - tail[i] / s) * s * s)
            };
            // rest(s) = c2 gamma^2 + O(gamma^3/s): it tends to a number, at first order at least (at second
            // where the next coefficient vanishes). Its round-off is 1e-16 s^2.
            let [coarse, middle, fine] = [200.0, 400.0, 800.0].map(rest);
            for i in 0..3 {
                let (before, after) = ((coarse[i] - middle[i]).abs(), (middle[i] - fine[i]).abs());
                assert!(fine[i].abs() < 2.0 * gamma * gamma, "gamma = {gamma}, nu = {nu}: {fine:?}");
                assert!(after < 0.51 * before + 1e-9, "gamma = {gamma}, nu = {nu}, entry {i}: {before:e}, {after:e}");
            }
        }
    }

    #[test]
    fn limits_at_small_wave_numbers() {
        for (gamma, nu) in [(0.0, 0.3), (2.0, 0.3), (-13.8, 0.3), (13.8, -0.99), (-2.0, 0.5)] {
            let layer = exponential(gamma, nu);
            let elastic = layer.elastic;
            let s = 1e-8;
            let found = compliance(&layer, s);
            // int_0^1 exp(-gamma y) dy
            let softness = if gamma == 0.0 { 1.0 } else { -(-gamma).exp_m1() / gamma };
            // The next terms are smaller by s^2 times a ratio of moduli: 1e-16 * 1e6.
            assert!((found.uu / (s * softness / elastic.a0()) - 1.0).abs() < 1e-9, "gamma = {gamma}, nu = {nu}");
            if nu < 0.5 {
                let exact = s * elastic.beta() * softness / elastic.a0();
                assert!((found.vv / exact - 1.0).abs() < 1e-9, "gamma = {gamma}, nu = {nu}");
            } else {
                // Incompressible: only bending out of the layer is left, Fvv ~ s^2.
                let twice = compliance(&layer, 2.0 * s);
                assert!((twice.vv / found.vv - 8.0).abs() < 1e-12, "gamma = {gamma}");
            }
        }
    }

    #[test]
    fn exactly_zero_at_the_origin() {
        let general = bonded(Opaque { modulus: |y| 1.0 + y, breakpoints: &[] }, Plane::Strain, 0.3);
        for layer in [exponential(0.0, 0.3), exponential(-3.0, 0.5), exponential(13.8, -0.99), general] {
            assert_eq!(compliance(&layer, 0.0), SurfaceFlexibility::default());
        }
    }

    #[test]
    fn a_solid_without_base_is_its_limit_bit_for_bit() {
        let layer = on(exponential(0.0, 0.3), Base::Infinite);
        let response = Compliance {}.respond(&layer).unwrap();
        let mut out = [SurfaceFlexibility::default(); 3];
        response.surface_into(&[0.0, 1.0, 1e6], &mut out).unwrap();
        assert_eq!(out, [SurfaceFlexibility { vv: 1.0, uu: 1.0, uv: -layer.elastic.beta() }; 3]);
        assert_eq!((response.depth(), response.tail(1)), (None, vec![SurfaceFlexibility::default()]));
    }

    #[test]
    fn a_batch_is_its_wave_numbers_one_by_one() {
        let layer = exponential(1.0, 0.3);
        let wave_numbers = [3.0, 0.0, 700.0];
        let mut out = [SurfaceFlexibility::default(); 3];
        Compliance {}.respond(&layer).unwrap().surface_into(&wave_numbers, &mut out).unwrap();
        for (out, s) in out.into_iter().zip(wave_numbers).filter(|(_, s)| *s > 0.0) {
            assert!(distance(out, compliance(&layer, s)) < 1e-14);
        }
    }

    #[test]
    fn refuses_what_it_cannot_treat() {
        let opaque = bonded(Opaque { modulus: |y| 1.0 + y, breakpoints: &[] }, Plane::Strain, 0.3);
        assert!(matches!(Compliance {}.respond(&on(opaque, Base::Infinite)), Err(Refusal::NotBuilt { .. })));
        let softening = on(exponential(-1.0, 0.3), Base::Infinite);
        assert!(matches!(Compliance {}.respond(&softening), Err(Refusal::OutOfReach { .. })));
        let steep = exponential(1.01 * STEEPEST, 0.3);
        assert!(matches!(Compliance {}.respond(&steep), Err(Refusal::OutOfReach { .. })));
    }

    #[test]
    fn finite_up_to_the_steepest_grading() {
        for gamma in [-STEEPEST, STEEPEST] {
            for s in [1e-6, 1.0, 1e3, 1e9] {
                let found = compliance(&exponential(gamma, 0.3), s);
                assert!(found.vv > 0.0 && found.uu > 0.0 && found.uv.is_finite(), "{gamma}, {s}: {found:?}");
            }
        }
    }

    proptest! {
        /// The surface gives way to any load: `F` is positive definite.
        #[test]
        fn positive_definite(nu in -0.99..=0.5, gamma in -13.8..13.8, decade in -3.0..3.0, stress: bool) {
            let plane = if stress { Plane::Stress } else { Plane::Strain };
            let found = compliance(&bonded(Law(gamma), plane, nu), 10.0_f64.powf(decade));
            prop_assert!(found.vv > 0.0 && found.uu > 0.0);
            prop_assert!(found.vv * found.uu > found.uv * found.uv);
        }
    }
}
