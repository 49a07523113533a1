use super::*;
use crate::Compliance;
use crate::exponential::STEEPEST;
use crate::fixtures::{Exponential, GOLDEN, Opaque, at, bonded, bonded_vv, distance, exponential};
use crate::surface_tail;
use proptest::prelude::*;
use slipzone_api::{Elastic, Plane, Poisson, Positive, SurfaceFlexibility};

const RATIOS: [f64; 8] = [-0.99, -0.5, -1e-9, 0.0, 0.3, 0.45, 0.499_999, 0.5];

fn closed(layer: &Arc<LayerModel>, s: f64) -> SurfaceFlexibility {
    at(&ClosedForm {}, layer, s)
}

#[test]
fn agrees_with_the_compliance() {
    let sizes = [0.0, 1e-16, 1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0, 1.19, 1.21, 2.08, 4.0, 9.21, 13.8];
    let ratios = RATIOS.map(|nu| (Plane::Strain, nu)).into_iter().chain(RATIOS.map(|nu| (Plane::Stress, nu)));
    for ((plane, nu), size) in ratios.flat_map(|ratio| sizes.map(|size| (ratio, size))) {
        for gamma in [size, -size] {
            let layer = bonded(Exponential(gamma), plane, nu);
            // Of these most is the round-off of the compliance's doublings; in plates towards nu = -1 both lose.
            let tolerance = if nu < -0.9 && plane == Plane::Stress { 2e-13 } else { 1e-13 };
            for k in 0..=130 {
                let s = 10.0_f64.powf(-8.0 + f64::from(k) / 10.0);
                let error = distance(closed(&layer, s), at(&Compliance {}, &layer, s));
                assert!(error < tolerance, "{plane:?}, nu = {nu}, gamma = {gamma}, s = {s:e}: {error:e}");
            }
        }
    }
}

#[test]
fn homogeneous_bonded_layer_in_closed_form() {
    for nu in RATIOS {
        let layer = exponential(0.0, nu);
        for i in 0..=400 {
            let w = 1e-6 * 7e8_f64.powf(f64::from(i) / 400.0);
            let error = closed(&layer, w).vv / bonded_vv(w, nu) - 1.0;
            // `bonded_vv` cancels in kappa - 1 and, like this form, in sinh x - x; exp(-2w) carries 2w roundings.
            assert!(error.abs() < 2e-14, "nu = {nu}, w = {w:e}: {error:e}");
        }
    }
}

#[test]
fn golden_values_of_strong_gradings() {
    for (nu, gamma, s, [vv, uu, uv]) in GOLDEN {
        let error = distance(closed(&exponential(gamma, nu), s), SurfaceFlexibility { vv, uu, uv });
        // Round-off, that of kappa and of exp(13.8) included.
        assert!(error < 5e-15, "nu = {nu}, gamma = {gamma}, s = {s}: {error:e}");
    }
}

/// `(kappa, gamma, s, [vv, uu, uv])` where exponents meet or differ as much as they can: by the propagator of `GOLDEN`
/// with 400 digits.
#[allow(clippy::excessive_precision, clippy::unreadable_literal)] // as they were computed
const EXTREME: [(f64, f64, f64, [f64; 3]); 10] = [
    (399.0, -5.25, 0.15625, [0.058019470375228069175, 0.058139816159063589084, -0.014387101284388251281]),
    (399.0, -4.0, 2.0, [1.3243003964367965595, 1.297996733896459321, -1.2911978981585413929]),
    (399.0, 13.75, 6.875, [0.030049525394031034295, 0.030194508770128926752, -0.027623494460604997158]),
    (6.96, -13.75, 6.875, [6.0788922929750184635, 2.3069972565968710717, -2.7641703698937800846]),
    (3.0, -2.0, 50.0, [1.0410161399880021995, 1.0201999800039990003, -0.52040399960007998001]),
    (1.0, -300.0, 9.5367431640625e-07, [1.5564440312192435749e+25, 3.1457280000000000636e+8, -4.9478023249920002e+16]),
    (1.75, -300.0, 30.0, [533.18439601998751618, 10.141006998111584179, -51.407715217917475714]),
    (1.75, 300.0, 150.0, [0.20126096812785885796, 0.48527619596863346842, 0.00650354493030625056]),
    (
        7.0,
        0.0,
        9.5367431640625e-07,
        [0.00000035762786865243410018, 0.00000047683715820316114007, -2.8421709430400130026e-13],
    ),
    (1.0, 1.1875, 0.5, [0.027009897476396903737, 0.47437870688827481997, 0.088127533285524675741]),
];

#[test]
fn golden_values_at_the_ends() {
    for (kappa, gamma, s, [vv, uu, uv]) in EXTREME {
        let error = distance(Minors::new(Elastic { kappa }, gamma).surface(s), SurfaceFlexibility { vv, uu, uv });
        // Round-off, that of exp(gamma) included; as kappa grows, a meets |b| around s = |gamma|/2.
        let tolerance = if kappa > 10.0 && (2.0 * s - gamma.abs()).abs() < 1.0 { 1e-13 } else { 1e-14 };
        assert!(error < tolerance, "kappa = {kappa}, gamma = {gamma}, s = {s}: {error:e}");
    }
}

#[test]
fn series_and_exponentials_overlap() {
    for nu in RATIOS {
        let elastic = Elastic::new(Plane::Strain, Poisson::new(nu).unwrap());
        for (s, gamma) in [(0.6, 0.0), (0.6, 1.2), (0.6, -1.2), (0.6, 1e-7), (0.3, -1.2), (1e-4, 1.2), (1e-4, -1.2)] {
            let minors = Minors::new(elastic, gamma);
            let error = distance(minors.thin(s), minors.thick(s));
            // A factor of 20 is lost in the exponentials, one of exp(1.2) in the series.
            assert!(error < 1e-14, "nu = {nu}, gamma = {gamma}, s = {s}: {error:e}");
        }
    }
}

#[test]
fn a_vanishing_gradient_joins_the_homogeneous_layer() {
    for (nu, s) in [(0.3, 1e-3), (0.3, 1.0), (0.3, 30.0), (0.5, 0.1), (-0.9, 3.0), (0.0, 1.0), (-0.5, 600.0)] {
        let homogeneous = closed(&exponential(0.0, nu), s);
        for gamma in (1..=300).step_by(13).map(|k| 10.0_f64.powi(-k)) {
            for gamma in [gamma, -gamma] {
                let change = distance(closed(&exponential(gamma, nu), s), homogeneous);
                // d ln F/d gamma is at most 1, the first moment of the layer.
                assert!(change < 1.1 * gamma.abs() + 2e-15, "nu = {nu}, s = {s}, gamma = {gamma:e}: {change:e}");
            }
        }
    }
}

#[test]
fn neither_overflow_nor_underflow() {
    for gamma in [-STEEPEST, -1.0, 0.0, 1e-200, 1.0, STEEPEST] {
        for nu in [-0.99, 0.3, 0.5] {
            let layer = exponential(gamma, nu);
            assert_eq!(closed(&layer, 0.0), SurfaceFlexibility::default());
            for s in [1e-40, 1e-8, 1.0, 1e3, 1e9, 1e80, 1e300] {
                let found = closed(&layer, s);
                assert!(found.vv > 0.0 && found.uu > 0.0 && found.uv.is_finite(), "{gamma}, {nu}, {s}: {found:?}");
            }
            // At 1e9 the first term of the series, below 1e3/1e9, is all that is left; at 1e300 nothing is.
            let limit = surface_tail::half_plane(layer.elastic);
            let first = ClosedForm {}.respond(&layer).unwrap().tail(1)[0];
            assert!((closed(&layer, 1e9).vv - limit.vv - first.vv / 1e9).abs() < 1e-12, "{gamma}, {nu}");
            assert!(distance(closed(&layer, 1e300), limit) < 4e-16, "{gamma}, {nu}");
        }
    }
}

#[test]
fn a_solid_without_base_is_that_of_the_compliance() {
    let layer = Arc::new(LayerModel { base: Base::Infinite, ..Arc::into_inner(exponential(0.0, 0.3)).unwrap() });
    let response = ClosedForm {}.respond(&layer).unwrap();
    assert_eq!(response.surface(3.0), Compliance {}.respond(&layer).unwrap().surface(3.0));
    assert_eq!((response.depth(), response.tail(2)), (None, vec![SurfaceFlexibility::default(); 2]));
}

#[test]
fn refuses_what_it_cannot_treat() {
    let substrate = Base::HalfPlane { shear: Positive::new(1.0).unwrap(), poisson: Poisson::new(0.3).unwrap() };
    let on = |base| Arc::new(LayerModel { base, ..Arc::into_inner(exponential(1.0, 0.3)).unwrap() });
    let general = bonded(Opaque { modulus: |y| 1.0 + y, breakpoints: &[] }, Plane::Strain, 0.3);
    for layer in [general, on(Base::Frictionless), on(substrate)] {
        let refusal = ClosedForm {}.respond(&layer).err();
        let Some(Refusal::NotBuilt { what, remedy }) = refusal else { panic!("{refusal:?}") };
        assert!(what.contains(METHOD) && remedy.contains("compliance"), "{what}: {remedy}");
    }
    let steep = exponential(-1.01 * STEEPEST, 0.3);
    assert!(matches!(ClosedForm {}.respond(&steep), Err(Refusal::OutOfReach { .. })));
}

proptest! {
    /// The surface gives way to any load: `F` is positive definite.
    #[test]
    fn positive_definite(nu in -0.99..=0.5, gamma in -13.8..13.8, decade in -3.0..3.0, stress: bool) {
        let plane = if stress { Plane::Stress } else { Plane::Strain };
        let found = closed(&bonded(Exponential(gamma), plane, nu), 10.0_f64.powf(decade));
        prop_assert!(found.vv > 0.0 && found.uu > 0.0);
        prop_assert!(found.vv * found.uu > found.uv * found.uv);
    }
}
