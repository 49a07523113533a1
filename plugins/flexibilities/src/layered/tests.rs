use crate::Compliance;
use crate::fixtures::{Opaque, at, bonded, distance, exponential, on, substrate};
use crate::panels::Panels;
use crate::precision::{FULL, ROUGHNESS};
use crate::surface_tail;
use slipzone_api::{Base, Flexibility, LayerModel, ModulusLaw, Plane, Refusal, SurfaceFlexibility};
use std::sync::Arc;

type Law = fn(f64) -> f64;

fn general(modulus: Law, breakpoints: &'static [f64], nu: f64) -> Arc<LayerModel> {
    bonded(Opaque { modulus, breakpoints }, Plane::Strain, nu)
}

#[test]
fn agrees_with_the_exponential_law_in_disguise() {
    let disguises: [(f64, Law); 5] = [
        (0.0, |_| 3.0),
        (2.0, |y| 5.0 * (2.0 * y).exp()),
        (-2.0, |y| (-2.0 * y).exp()),
        (13.8, |y| (13.8 * y).exp()),
        (-13.8, |y| (-13.8 * y).exp()),
    ];
    for (gamma, modulus) in disguises {
        for nu in [-0.9, 0.3, 0.5] {
            for s in [1e-6, 0.01, 1.0, 12.0, 40.0, 700.0, 1e5] {
                let (open, disguised) = (exponential(gamma, nu), general(modulus, &[], nu));
                let difference = distance(at(&Compliance {}, &disguised, s), at(&Compliance {}, &open, s));
                // Extrapolation ends near round-off; 1e-13 of `exponential` at 13.8 comes on top.
                assert!(difference < 3e-13, "gamma = {gamma}, nu = {nu}, s = {s}: {difference:e}");
            }
        }
    }
}

/// Slices grow with depth: at wave numbers close to each other, so that each kind of slice ends at each place once.
#[test]
fn slices_as_thick_as_they_are_deep_lose_nothing() {
    for (gamma, law) in [(0.0, (|_| 3.0) as Law), (2.0, |y| (2.0 * y).exp()), (-2.0, |y| (-2.0 * y).exp())] {
        let layer = general(law, &[], 0.3);
        let (full, exact) = (Compliance {}.respond(&layer).unwrap(), exponential(gamma, 0.3));
        let exact = Compliance {}.respond(&exact).unwrap();
        let rough = full.roughly(ROUGHNESS).unwrap();
        for i in 0..1500 {
            let s = 10.0_f64.powf(-1.0 + f64::from(i) / 400.0);
            let exact = exact.surface(s).unwrap();
            let [of_full, of_rough] =
                [distance(full.surface(s).unwrap(), exact), distance(rough.surface(s).unwrap(), exact)];
            assert!(of_full < 1e-14 && of_rough < ROUGHNESS, "gamma = {gamma}, s = {s}: {of_full:e}, {of_rough:e}");
        }
    }
}

/// `nu = 0.3`, plane strain, `[vv, uu, uv]` at `s = 0.01, 1, 20`, by mpmath with 60 digits: the propagator as a
/// product of `expm` of the two layers, and of 8 steps of the Taylor series of `z' = K(y) z` to order 40.
#[allow(clippy::excessive_precision, clippy::unreadable_literal)] // as they were computed
const TWO_LAYERS: [[f64; 3]; 3] = [
    [0.0014030652669467727143, 0.0049105789710694541855, 1.8333248922619624069e-6],
    [0.14173485284160875022, 0.40772625291107262004, 0.0061087460323505935931],
    [0.99745009365220761592, 0.99827378205122040048, -0.28361741038994007546],
];
#[allow(clippy::excessive_precision, clippy::unreadable_literal)]
const POWER_LAW: [[f64; 3]; 3] = [
    [0.0027211041091330635755, 0.009523168317859985147, 5.8872948572039376961e-6],
    [0.27732038640847239493, 0.61234724590284362674, 0.0074743399384353587663],
    [0.94274079590762698323, 0.97593453547825306552, -0.26227116594969684214],
];

#[test]
fn golden_values_of_a_stack_and_a_power_law() {
    let stack = general(|y| if y < 0.25 { 1.0 } else { 8.0 }, &[0.25], 0.3);
    let power = general(|y| (1.0 + y / 2.0).powi(2), &[], 0.3);
    assert_eq!(Compliance {}.respond(&stack).unwrap().depth(), Some(0.25));
    for (layer, golden) in [(stack, TWO_LAYERS), (power, POWER_LAW)] {
        for (s, [vv, uu, uv]) in [0.01, 1.0, 20.0].into_iter().zip(golden) {
            let difference = distance(at(&Compliance {}, &layer, s), SurfaceFlexibility { vv, uu, uv });
            // Round-off of a few hundred slices.
            assert!(difference < 1e-13, "s = {s}: {difference:e}");
        }
    }
}

/// `1 + c y^p`.
#[derive(Debug)]
struct Power {
    factor: f64,
    power: f64,
}

impl ModulusLaw for Power {
    fn modulus(&self, depth: f64) -> f64 {
        1.0 + self.factor * depth.powf(self.power)
    }

    fn broken_power(&self) -> Option<f64> {
        Some(self.power)
    }
}

/// Where no wave feels the base, `s` under `1 + c y^p` is `s/l` under `1 + c l^-p y^p`. Panels that shrink towards the
/// surface are no kink.
#[test]
fn a_broken_power_is_followed_to_where_the_shortest_waves_are() {
    for power in [0.2, 0.5, 0.8] {
        let near = bonded(Power { factor: 7.0, power }, Plane::Strain, 0.3);
        // What is left of a law in its twelfth digit is none.
        let is_told = |scale: &f64| 7.0 * scale.powf(-power) > 1e-12;
        for scale in [1e6, 1e10, 1e13, 1e16, 1e28].into_iter().filter(is_told) {
            let far = bonded(Power { factor: 7.0 * f64::powf(scale, -power), power }, Plane::Strain, 0.3);
            for s in [60.0, 1e3] {
                let difference = distance(at(&Compliance {}, &near, s * scale), at(&Compliance {}, &far, s));
                assert!(difference < 4e-12, "p = {power}, s = {s} {scale:e}: {difference:e}");
            }
        }
        let panels = Panels::new(&near, &FULL).unwrap();
        assert!(panels.first_break.to_bits() == 1.0_f64.to_bits(), "p = {power}: {}", panels.first_break);
    }
}

#[test]
fn a_steep_but_smooth_law_is_resolved() {
    // Steps up by a factor of 4 within 2 % of the depth, without a breakpoint: with and without one in
    // the middle of the step the slices differ, the result must not.
    let step = |y: f64| 5.0 + 3.0 * ((y - 0.37) / 0.01).tanh();
    let (plain, split) = (general(step, &[], 0.3), general(step, &[0.37], 0.3));
    for s in [1e-3, 1.0, 10.0, 100.0] {
        let difference = distance(at(&Compliance {}, &plain, s), at(&Compliance {}, &split, s));
        assert!(difference < 1e-11, "s = {s}: {difference:e}"); // TOLERANCE
    }
}

#[test]
fn noise_and_no_numbers_are_refused() {
    let laws: [(Law, &str); 3] = [
        (|y| 2.0 + (1e7 * y).sin(), "too fast: 32768 slices only reach y = 0.0"),
        (|y| if y < 0.5 { 1.0 } else { f64::NAN }, "no finite numbers somewhere from y = 0 h on"),
        (|y| 1.0 - 1.9 * y, "reach y = 0.52632 h"),
    ];
    for (modulus, told) in laws {
        match (Compliance {}).respond(&general(modulus, &[], 0.3)).err() {
            Some(Refusal::OutOfReach { why, .. }) => assert!(why.contains(told), "{why}"),
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn a_kink_that_is_not_told_is_found() {
    let law: Law = |y| 1.0 + (y - 0.3).abs();
    let (silent, told) = (general(law, &[], 0.3), general(law, &[0.3], 0.3));
    for s in [1e-3, 1.0, 10.0, 100.0] {
        let difference = distance(at(&Compliance {}, &silent, s), at(&Compliance {}, &told, s));
        assert!(difference < 1e-12, "s = {s}: {difference:e}"); // the kink's thinnest panel is 1e-13 thick
    }
    let found = Panels::new(&silent, &FULL).unwrap().first_break;
    assert!((found - 0.3).abs() < 2e-6, "{found}"); // twice the thickness that shows a kink
}

/// `s Fvv/A0` of a homogeneous layer on a base without friction, whatever its Poisson's ratio: `2 sinh^2 w/(2w + sinh
/// 2w)` (theory, section 7).
fn sliding_vv(w: f64) -> f64 {
    let fade = (-2.0 * w).exp();
    // Both times 2 exp(-2w), and sinh^2 without cancellation.
    let rise = (-2.0 * w).exp_m1();
    rise * rise / (4.0 * w * fade - (-4.0 * w).exp_m1())
}

#[test]
fn homogeneous_layer_on_a_base_without_friction() {
    for nu in [-0.99, 0.0, 0.3, 0.5] {
        let layer = on(exponential(0.0, nu), Base::Frictionless);
        for i in 0..=300 {
            let w = 1e-4 * 7e6_f64.powf(f64::from(i) / 300.0);
            let error = at(&Compliance {}, &layer, w).vv / sliding_vv(w) - 1.0;
            assert!(error.abs() < 1e-13, "nu = {nu}, w = {w:e}: {error:e}");
        }
    }
}

#[test]
fn long_waves_stretch_a_layer_that_slides_as_a_membrane() {
    let laws: [Arc<LayerModel>; 3] = [
        exponential(1.5, 0.3),
        general(|y| (1.5 * y).exp(), &[], 0.3),
        general(|y| if y < 0.25 { 1.0 } else { 8.0 }, &[0.25], -0.5),
    ];
    for layer in laws.map(|layer| on(layer, Base::Frictionless)) {
        let response = Compliance {}.respond(&layer).unwrap();
        let (near, limit) = (response.surface(1e-4).unwrap(), response.surface(0.0).unwrap());
        // What follows is smaller by (s h)^2.
        assert!((near.uu * 1e-4 / response.pole() - 1.0).abs() < 1e-7, "{near:?}, {}", response.pole());
        assert!((near.uv / limit.uv - 1.0).abs() < 1e-7, "{near:?} {limit:?}");
        assert!(near.vv < 1e-3 && limit.vv == 0.0);
    }
}

#[test]
fn a_coating_of_the_substrate_s_own_material_is_a_half_plane() {
    // Surface modulus 2: `exponential` is twice the exponential.
    for nu in [-0.99, 0.0, 0.3, 0.5] {
        let layer = on(exponential(0.0, nu), substrate(2.0, nu));
        for s in [0.0, 1e-8, 1e-3, 0.3, 1.0, 7.0, 30.0, 1e3] {
            let difference = distance(at(&Compliance {}, &layer, s), surface_tail::half_plane(layer.elastic));
            assert!(difference < 1e-14, "nu = {nu}, s = {s}: {difference:e}");
        }
    }
}

#[test]
fn a_substrate_is_felt_in_long_waves_alone() {
    let layer = on(exponential(2.0, 0.3), substrate(0.5, 0.2));
    let [origin, near] = [0.0, 1e-9].map(|s| at(&Compliance {}, &layer, s));
    // (1 - 0.2)/0.5 against (1 - 0.3)/2.
    assert!((origin.vv / (0.8 / 0.5 / (0.7 / 2.0)) - 1.0).abs() < 1e-15, "{origin:?}");
    assert!(distance(near, origin) < 1e-7, "{near:?} {origin:?}");
    assert!(distance(at(&Compliance {}, &layer, 60.0), at(&Compliance {}, &exponential(2.0, 0.3), 60.0)) < 1e-14);
}

#[test]
fn a_graded_half_plane_is_a_thick_layer() {
    for (gamma, nu) in [(1.0, 0.3), (1.0, -0.9), (1.0, 0.5), (20.0, 0.0)] {
        let half_plane = on(exponential(gamma, nu), Base::Infinite);
        // 40 times as thick as the length over which the modulus grows; wave numbers in its units.
        let deep = exponential(40.0, nu);
        for s in [1e-3, 0.1, 1.0, 10.0, 1e3] {
            let found = at(&Compliance {}, &half_plane, s * gamma);
            let difference = distance(found, at(&Compliance {}, &deep, s * 40.0));
            // The compliance's round-off at 40.
            assert!(difference < 1e-12, "gamma = {gamma}, nu = {nu}, s = {s}: {difference:e}");
            assert_eq!(found, at(&crate::ClosedForm {}, &half_plane, s * gamma));
        }
    }
}

#[test]
fn poisson_s_ratio_may_vary() {
    #[derive(Debug)]
    struct Varying;
    impl slipzone_api::ModulusLaw for Varying {
        fn modulus(&self, y: f64) -> f64 {
            1.0 + y
        }
        fn poisson(&self, y: f64) -> Option<f64> {
            Some(0.2 + 0.2 * y)
        }
    }
    // Against slices within each of which the constants are those of its middle, extrapolated twice.
    let layer = bonded(Varying, Plane::Strain, 0.0);
    let by_slices = |count: usize, s: f64| {
        let sublayers = (0..count).map(|i| slipzone_api::Sublayer {
            thickness: 1.0 / count as f64,
            law: Box::new(Constant((i as f64 + 0.5) / count as f64)),
        });
        let stack = LayerModel::new(Box::new(Stack(sublayers.collect())), layer.solid, Base::Rigid);
        at(&Compliance {}, &Arc::new(LayerModel { surface_shear: 1.0, elastic: layer.elastic, ..stack }), s)
    };
    for s in [0.01, 1.0, 5.0] {
        let [coarse, middle, fine] = [100, 200, 400].map(|count| by_slices(count, s));
        let extrapolated = |finer: f64, coarser: f64, order: f64| finer + (finer - coarser) / (order.exp2() - 1.0);
        let entry = |of: fn(SurfaceFlexibility) -> f64| {
            let [coarse, middle, fine] = [coarse, middle, fine].map(of);
            extrapolated(extrapolated(fine, middle, 2.0), extrapolated(middle, coarse, 2.0), 4.0)
        };
        let expected = SurfaceFlexibility { vv: entry(|f| f.vv), uu: entry(|f| f.uu), uv: entry(|f| f.uv) };
        let difference = distance(at(&Compliance {}, &layer, s), expected);
        assert!(difference < 1e-11, "s = {s}: {difference:e}");
    }
}

/// The constants of `Varying` at one depth.
#[derive(Debug)]
struct Constant(f64);

impl slipzone_api::ModulusLaw for Constant {
    fn modulus(&self, _: f64) -> f64 {
        1.0 + self.0
    }
    fn poisson(&self, _: f64) -> Option<f64> {
        Some(0.2 + 0.2 * self.0)
    }
    fn exponent(&self) -> Option<f64> {
        Some(0.0)
    }
}

#[derive(Debug)]
struct Stack(Vec<slipzone_api::Sublayer>);

impl slipzone_api::ModulusLaw for Stack {
    fn modulus(&self, depth: f64) -> f64 {
        1.0 + depth
    }
    fn sublayers(&self) -> &[slipzone_api::Sublayer] {
        &self.0
    }
}

/// What a jump is taken for would otherwise be a series of powers of a panel's thickness times the moduli's ratio.
#[test]
fn a_jump_that_is_not_told_may_be_as_high_as_any() {
    let law: Law = |y| if y < 0.3 { 1.0 } else { 1e-40 };
    let (silent, told) = (general(law, &[], 0.3), general(law, &[0.3], 0.3));
    for s in [1e-12, 1e-9, 1e-3, 1.0, 10.0] {
        let difference = distance(at(&Compliance {}, &silent, s), at(&Compliance {}, &told, s));
        assert!(difference < 1e-11, "s = {s}: {difference:e}"); // the plate bends as the third power of its thickness
    }
}

#[test]
fn what_overflows_is_refused() {
    let law: Law = |y| if y < 0.3 { 1e100 } else { 1e-100 };
    let layer = LayerModel { datum: Some(0.2), ..Arc::into_inner(general(law, &[], 0.3)).unwrap() };
    let response = Compliance {}.respond(&Arc::new(layer)).unwrap();
    let mut out = [SurfaceFlexibility::default(); 4];
    for refusal in [
        response.surface(1e-3).err(),
        response.surface_into(&[1e-3, 1.1e-3, 1.2e-3, 1.3e-3], &mut out).err(),
        response.against_datum().unwrap().surface(1e-3).err(),
    ] {
        assert!(matches!(refusal, Some(Refusal::OutOfReach { .. })), "{refusal:?}");
    }
}
