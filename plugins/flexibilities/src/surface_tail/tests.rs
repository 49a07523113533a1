use super::*;
use crate::Compliance;
use crate::fixtures::{Exponential, Opaque, Smooth, at, bonded, exponential as exponential_layer};
use nalgebra::{Matrix4, Vector4};
use slipzone_api::{Base, Flexibility, LayerModel, ModulusLaw, Plane, Poisson};
use std::sync::Arc;

const MATERIALS: [(Plane, f64); 5] =
    [(Plane::Strain, -0.99), (Plane::Strain, 0.0), (Plane::Strain, 0.3), (Plane::Strain, 0.5), (Plane::Stress, 0.2)];

fn elastic((plane, nu): (Plane, f64)) -> Elastic {
    Elastic::new(plane, Poisson::new(nu).unwrap())
}

fn entries(x: SurfaceFlexibility) -> [f64; 3] {
    [x.vv, x.uu, x.uv]
}

/// What `s F/A0` is at `s` beyond its limit and the sum of `tail`.
fn rest(layer: &Arc<LayerModel>, tail: &[SurfaceFlexibility], s: f64) -> [f64; 3] {
    let (found, limit) = (entries(at(&Compliance {}, layer, s)), entries(half_plane(layer.elastic)));
    [0, 1, 2].map(|i| found[i] - limit[i] - tail.iter().rev().fold(0.0, |sum, term| (sum + entries(*term)[i]) / s))
}

#[test]
fn the_first_term_in_closed_form() {
    for material in MATERIALS {
        let elastic = elastic(material);
        let half = -2.5 / 2.0;
        let first = exponential(elastic, -2.5, 1)[0];
        let expected =
            SurfaceFlexibility { vv: -half * (elastic.kappa + 5.0) / (elastic.kappa + 1.0), uu: -half, uv: half };
        for (x, y) in entries(first).into_iter().zip(entries(expected)) {
            assert!((x - y).abs() < 4e-15, "{material:?}: {first:?} against {expected:?}"); // a few roundings of 3
        }
    }
}

/// The Sylvester equations in the matrices of the theory's sections 2 and 3, as four linear equations each.
fn by_direct_solve(elastic: Elastic, gradient: f64, terms: usize) -> Vec<SurfaceFlexibility> {
    let a = Matrix2::new(0.0, 1.0, -elastic.lambda(), 0.0);
    let d = Matrix2::new(8.0 / (1.0 + elastic.kappa), 0.0, 0.0, 0.0);
    let mut orders = vec![half_plane_compliance(elastic)];
    let (left, right) = (a - orders[0] * d, a.transpose() - d * orders[0]);
    // vec(L X + X R) = (I x L + R^T x I) vec(X), columns stacked.
    let one = Matrix2::identity();
    let system: Matrix4<f64> = one.kronecker(&left) + right.transpose().kronecker(&one);
    for k in 1..=terms {
        let products: Matrix2<f64> = (1..k).map(|j| orders[j] * d * orders[k - j]).sum();
        let known = products - orders[k - 1] * gradient;
        let solution = system.lu().solve(&Vector4::from_column_slice(known.as_slice())).unwrap();
        orders.push(Matrix2::from_column_slice(solution.as_slice()));
    }
    orders[1..].iter().map(|order| scaled(order, 1.0, elastic)).collect()
}

#[test]
fn closed_form_solves_the_sylvester_equations() {
    for material in MATERIALS {
        let elastic = elastic(material);
        let (closed, direct) = (exponential(elastic, -1.5, 20), by_direct_solve(elastic, -1.5, 20));
        assert_eq!(closed.len(), 20);
        // Some orders are small because all that adds up in them cancels: the one before tells their scale, too.
        let mut before = 1.0;
        for (k, (x, y)) in (1..).zip(closed.iter().zip(&direct)) {
            let own = entries(*y).into_iter().fold(0.0_f64, |size, entry| size.max(entry.abs()));
            let size = own.max(std::mem::replace(&mut before, own));
            for (x, y) in entries(*x).into_iter().zip(entries(*y)) {
                // Twenty steps of a well-conditioned 4x4 system, round-off against the largest entry.
                assert!((x - y).abs() < 1e-13 * size, "{material:?}, order {k}: {x:e} against {y:e}");
            }
        }
    }
}

#[test]
fn the_series_is_the_flexibility_once_the_base_is_out_of_sight() {
    for (material, gamma) in MATERIALS.into_iter().flat_map(|material| [(material, 2.08), (material, -2.08)]) {
        let layer = bonded(Exponential(gamma), material.0, material.1);
        let tail = Compliance {}.respond(&layer).unwrap().tail(20);
        for s in [40.0, 80.0] {
            for rest in rest(&layer, &tail, s) {
                // 20 terms: (2.08/40)^21 = 1e-27. The base: exp(-80) times a polynomial. Round-off of order-one
                // numbers.
                assert!(rest.abs() < 5e-15, "{material:?}, gamma = {gamma}, s = {s}: {rest:e}");
            }
        }
    }
}

#[test]
fn a_truncated_series_errs_by_its_next_term() {
    let law = Opaque { modulus: |y| (1.0 + y / 2.0).powi(2), breakpoints: &[] };
    // As the exponential laws its coefficients are below 3 g^k, with g = 1 (mu'/mu at the surface) up to k = 10.
    let power = bonded(Smooth { law, series: &[1.0, 1.0, 0.25] }, Plane::Strain, 0.3);
    for (layer, g) in [(power, 1.0), (exponential_layer(2.08, 0.3), 2.08), (exponential_layer(-2.08, 0.5), 2.08_f64)] {
        let tail = Compliance {}.respond(&layer).unwrap().tail(10);
        for (s, terms) in [40.0, 80.0, 160.0].into_iter().flat_map(|s| (1..=10).map(move |terms| (s, terms))) {
            for rest in rest(&layer, &tail[..terms], s) {
                let next = 3.0 * (g / s).powi(i32::try_from(terms).unwrap() + 1);
                // On top the round-off of order-one numbers, and of some thousand slices.
                assert!(rest.abs() < next + 5e-14, "g = {g}, s = {s}, {terms} terms: {rest:e} against {next:e}");
            }
        }
    }
}

#[test]
fn a_smooth_law_that_is_exponential_has_the_exponential_series() {
    for material in MATERIALS {
        let elastic = elastic(material);
        for gamma in [-2.0, 0.0, 1e-9, 0.7, 9.0] {
            let modulus: Vec<f64> = (0..=16)
                .scan(1.0, |term, k| {
                    let here = *term;
                    *term *= gamma / f64::from(k + 1);
                    Some(here)
                })
                .collect();
            let (general, special) =
                (smooth(elastic, &modulus, &[elastic.beta()], 16), exponential(elastic, gamma, 16));
            assert_eq!(general.len(), 16);
            for (k, (x, y)) in (1..).zip(general.iter().zip(&special)) {
                // w is gamma up to round-off, eps gamma^i in its coefficient of y^i, which the k derivatives
                // behind order k multiply by at most k!/(k - i)!.
                for (x, y) in entries(*x).into_iter().zip(entries(*y)) {
                    let size = gamma.abs().powi(k);
                    assert!((x - y).abs() <= 1e-13 * size, "{material:?}, {gamma}, order {k}: {x:e} against {y:e}");
                }
            }
        }
    }
}

#[test]
fn as_many_terms_as_the_derivatives_give() {
    let elastic = elastic(MATERIALS[2]);
    for (modulus, terms, given) in [(&[][..], 3, 0), (&[1.0], 3, 0), (&[1.0, 0.5], 3, 1), (&[1.0, 0.5, 2.0, 1.0], 2, 2)]
    {
        assert_eq!(smooth(elastic, modulus, &[elastic.beta()], terms).len(), given);
    }
    // A term does not change when more are asked for.
    let modulus = [1.0, 0.5, 2.0, 1.0, -3.0];
    assert_eq!(
        smooth(elastic, &modulus, &[elastic.beta()], 4)[..2],
        smooth(elastic, &modulus[..3], &[elastic.beta()], 2)
    );
    assert_eq!(exponential(elastic, 0.0, 3), [SurfaceFlexibility::default(); 3]);
}

#[test]
fn the_series_knows_how_poisson_s_ratio_varies() {
    #[derive(Debug)]
    struct Varying;
    impl ModulusLaw for Varying {
        fn modulus(&self, depth: f64) -> f64 {
            1.0 + depth
        }
        fn poisson(&self, depth: f64) -> Option<f64> {
            Some(0.2 + 0.25 * depth)
        }
        fn surface_series(&self, terms: usize) -> Vec<f64> {
            [1.0, 1.0].into_iter().chain(std::iter::repeat(0.0)).take(terms).collect()
        }
        fn poisson_series(&self, terms: usize) -> Vec<f64> {
            [0.2, 0.25].into_iter().chain(std::iter::repeat(0.0)).take(terms).collect()
        }
    }
    let poisson = Poisson::new(0.2).unwrap();
    let kinds = [Plane::Strain, Plane::Stress].map(|plane| [Moduli::Shear, Moduli::Young].map(|kind| (plane, kind)));
    for (plane, moduli) in kinds.into_iter().flatten() {
        let layer = Arc::new(LayerModel::new(Box::new(Varying), Solid { plane, poisson, moduli }, Base::Rigid));
        let tail = of(&layer, 12).expect("all coefficients are told");
        assert_eq!(tail.len(), 12);
        for rest in rest(&layer, &tail, 80.0) {
            // The thirteenth term, 13!/(2 80)^13 at most as the moduli vary over lengths of 1, and round-off.
            assert!(rest.abs() < 1e-14, "{plane:?}, {moduli:?}: {rest:e}");
        }
        // Without the last terms it would be seen.
        assert!(self::rest(&layer, &tail[..3], 80.0).iter().any(|rest| rest.abs() > 1e-10), "{plane:?}, {moduli:?}");
    }
}
