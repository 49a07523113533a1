#![allow(clippy::float_cmp)] // where equality is asserted, it is exact by construction

use super::*;
use slipzone_api::{Moduli, Poisson};

const RULES: [MixingRule; 2] = [MixingRule::Mixture, MixingRule::MoriTanaka];
const KINDS: [Moduli; 2] = [Moduli::Shear, Moduli::Young];

fn phase(modulus: f64, poisson: f64) -> Phase {
    Phase { modulus: Positive::new(modulus).unwrap(), poisson: Poisson::new(poisson).unwrap() }
}

fn grading(surface: Phase, base: Phase, exponent: f64, rule: MixingRule) -> VolumeFraction {
    VolumeFraction { surface, base, exponent: Positive::new(exponent).unwrap(), rule }
}

fn law(grading: &VolumeFraction, moduli: Moduli) -> Box<dyn ModulusLaw> {
    let thickness = Positive::new(2.0).ok();
    grading.law(&Setting { thickness, moduli }).unwrap_or_else(|refusal| panic!("{refusal}"))
}

#[test]
fn ends_are_the_materials() {
    for rule in RULES {
        for moduli in KINDS {
            for (a, b) in [(0.3, 0.2), (0.5, 0.3), (0.1, 0.5), (0.5, 0.5), (-0.5, 0.45)] {
                let law = law(&grading(phase(1.0, a), phase(70.0, b), 5.7, rule), moduli);
                for (depth, modulus, nu) in [(0.0, 1.0, a), (1.0, 70.0, b)] {
                    let (found, ratio) = (law.modulus(depth), law.poisson(depth).unwrap());
                    assert!((found / modulus - 1.0).abs() < 1e-14, "{rule:?} {moduli:?} {a} {b}: {found}");
                    assert!((ratio - nu).abs() < 1e-15, "{rule:?} {moduli:?} {a} {b}: {ratio}");
                }
                for i in 0..=50 {
                    assert!(Poisson::new(law.poisson(f64::from(i) / 50.0).unwrap()).is_ok());
                }
            }
        }
    }
}

#[test]
fn equal_materials_are_homogeneous() {
    let law = law(&grading(phase(3.0, 0.3), phase(3.0, 0.3), 0.5, MixingRule::MoriTanaka), Moduli::Young);
    assert_eq!((law.exponent(), law.modulus(0.4), law.poisson(0.4)), (Some(0.0), 3.0, Some(0.3)));
    assert_eq!((law.surface_series(3), law.poisson_series(3)), (vec![1.0, 0.0, 0.0], vec![0.3, 0.0, 0.0]));
}

/// Benveniste's formulas as printed, with `K` and `G`.
#[test]
fn mori_tanaka_as_printed() {
    let (g1, nu1, g2, nu2) = (1.0, 0.3, 8.0, 0.2);
    let bulk = |g: f64, nu: f64| 2.0 * g * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu));
    let (k1, k2) = (bulk(g1, nu1), bulk(g2, nu2));
    let law = law(&grading(phase(g1, nu1), phase(g2, nu2), 1.0, MixingRule::MoriTanaka), Moduli::Shear);
    for v in [0.1, 0.5, 0.8] {
        let k = k1 + v * (k2 - k1) / (1.0 + (1.0 - v) * (k2 - k1) / (k1 + 4.0 * g1 / 3.0));
        let f = g1 * (9.0 * k1 + 8.0 * g1) / (6.0 * (k1 + 2.0 * g1));
        let g = g1 + v * (g2 - g1) / (1.0 + (1.0 - v) * (g2 - g1) / (g1 + f));
        assert!((law.modulus(v) / g - 1.0).abs() < 1e-14);
        let nu = (3.0 * k - 2.0 * g) / (2.0 * (3.0 * k + g));
        assert!((law.poisson(v).unwrap() / nu - 1.0).abs() < 1e-13);
    }
}

/// The same two materials, called by Young's moduli or by shear moduli, are the same mixture.
#[test]
fn mori_tanaka_knows_both_kinds_of_modulus() {
    let young = |g: f64, nu: f64| 2.0 * g * (1.0 + nu);
    let by_shear = law(&grading(phase(1.0, 0.35), phase(9.0, 0.2), 2.0, MixingRule::MoriTanaka), Moduli::Shear);
    let phases = (phase(young(1.0, 0.35), 0.35), phase(young(9.0, 0.2), 0.2));
    let by_young = law(&grading(phases.0, phases.1, 2.0, MixingRule::MoriTanaka), Moduli::Young);
    for depth in [0.0, 0.3, 0.7, 1.0] {
        let nu = by_shear.poisson(depth).unwrap();
        assert!((by_young.poisson(depth).unwrap() - nu).abs() < 1e-15);
        assert!((by_young.modulus(depth) / young(by_shear.modulus(depth), nu) - 1.0).abs() < 1e-14);
    }
}

/// Of spheres in a matrix that nothing compresses, Mori-Tanaka makes at first order what Einstein made of a suspension:
/// rigid spheres add 5/2 of their volume to the shear modulus.
#[test]
fn einsteins_suspension() {
    let law = law(&grading(phase(1.0, 0.5), phase(1e12, 0.3), 1.0, MixingRule::MoriTanaka), Moduli::Shear);
    assert!((law.surface_series(2)[1] - 2.5).abs() < 1e-10, "{:?}", law.surface_series(2));
}

#[test]
fn series_add_up_to_the_law() {
    for rule in RULES {
        for moduli in KINDS {
            let law = law(&grading(phase(2.0, 0.4), phase(3.0, 0.2), 2.0, rule), moduli);
            let (modulus, poisson) = (law.surface_series(30), law.poisson_series(30));
            for depth in [0.05, 0.2] {
                let sum = |series: &[f64]| series.iter().rev().fold(0.0, |sum, c| sum * depth + c);
                assert!((sum(&modulus) - law.modulus(depth) / 2.0).abs() < 1e-14);
                assert!((sum(&poisson) - law.poisson(depth).unwrap()).abs() < 1e-14);
            }
        }
    }
}

#[test]
fn broken_powers_have_the_derivatives_that_exist() {
    let law = law(&grading(phase(2.0, 0.4), phase(3.0, 0.2), 5.5, MixingRule::MoriTanaka), Moduli::Shear);
    assert_eq!(law.surface_series(9), [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(law.poisson_series(9).len(), 6);
    assert_eq!(law.broken_power(), Some(5.5));
}

/// The share is the power itself, down to where the layer is followed; whole powers break nothing.
#[test]
fn broken_powers_are_told_as_they_are() {
    for p in [0.2_f64, 0.7, 1.5, 3.0] {
        let law = law(&grading(phase(1.0, 0.3), phase(2.0, 0.3), p, MixingRule::Mixture), Moduli::Shear);
        for depth in [0.0_f64, 1e-13, 1e-6, 0.01, 1.0] {
            assert!((law.modulus(depth) - 1.0 - depth.powf(p)).abs() < 1e-15, "p = {p} at {depth}");
        }
        assert_eq!(law.broken_power(), (p != 3.0).then_some(p));
    }
}
