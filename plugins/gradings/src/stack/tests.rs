#![allow(clippy::float_cmp)] // where equality is asserted, it is exact by construction

use super::*;
use crate::volume_fraction::{MixingRule, Phase};
use crate::{Exponential, Homogeneous, Linear, VolumeFraction};
use slipzone_api::{Finite, NoFiles};

fn positive(value: f64) -> Positive {
    Positive::new(value).unwrap()
}

fn piece(thickness: f64, poisson: Option<f64>, grading: impl Grading + 'static) -> Piece {
    let poisson = poisson.map(|nu| Poisson::new(nu).unwrap());
    Piece { thickness: positive(thickness), poisson, grading: Box::new(grading) }
}

fn level(modulus: f64) -> Homogeneous {
    Homogeneous { modulus: positive(modulus) }
}

fn line(surface: f64, base: f64) -> Linear {
    Linear { surface: positive(surface), base: positive(base) }
}

fn law(stack: &Stack) -> Box<dyn ModulusLaw> {
    stack.law(&Setting::thick(stack.thickness().unwrap())).unwrap_or_else(|refusal| panic!("{refusal}"))
}

#[test]
fn pieces_of_a_law_are_the_law() {
    let whole = line(2.0, 12.0).law(&Setting::thick(positive(5.0))).unwrap();
    let layers = (0..5).map(|i| piece(1.0, None, line(2.0 + 2.0 * f64::from(i), 4.0 + 2.0 * f64::from(i)))).collect();
    let stack = law(&Stack { layers });
    for i in 0..=100 {
        let depth = f64::from(i) / 100.0;
        assert!((stack.modulus(depth) / whole.modulus(depth) - 1.0).abs() < 1e-14, "{depth}");
    }
    assert_eq!(stack.surface_series(3), whole.surface_series(3));
    assert!(stack.breakpoints().iter().zip([0.2, 0.4, 0.6, 0.8]).all(|(a, b)| (a - b).abs() < 1e-15));
    assert_eq!((stack.sublayers().len(), stack.breakpoints().len(), stack.poisson(0.3)), (5, 4, None));
}

#[test]
fn series_are_rescaled() {
    let steep = Exponential::by_gradient(positive(1.0), Finite::new(3.0).unwrap());
    let stack = law(&Stack { layers: vec![piece(0.5, Some(0.1), steep), piece(1.5, None, level(1.0))] });
    // exp(0.5 * 3 * local), local = 4 depth.
    let series = stack.surface_series(4);
    for (found, exact) in series.iter().zip([1.0, 6.0, 18.0, 36.0]) {
        assert!((found - exact).abs() < 1e-13, "{series:?}");
    }
    assert_eq!(stack.poisson_series(3), [0.1, 0.0, 0.0]);
    assert_eq!((stack.poisson(0.1), stack.poisson(0.9), stack.exponent()), (Some(0.1), None, None));
    assert_eq!(stack.sublayers()[0].law.exponent(), Some(1.5));
}

#[test]
fn a_stack_of_one_is_that_one() {
    let law = law(&Stack { layers: vec![piece(2.0, Some(0.2), level(3.0))] });
    assert_eq!((law.exponent(), law.poisson(0.5), law.sublayers().len()), (Some(0.0), Some(0.2), 0));
}

#[test]
fn stacks_nest() {
    let inner = Stack { layers: vec![piece(1.0, Some(0.4), level(2.0)), piece(1.0, None, line(3.0, 5.0))] };
    let mut outer = Stack { layers: vec![piece(2.0, None, level(1.0)), piece(2.0, Some(0.1), inner)] };
    outer.read(&NoFiles).unwrap();
    assert_eq!(outer.thickness(), Some(positive(4.0)));
    let law = law(&outer);
    for (depth, modulus, poisson) in [
        (0.25, 1.0, None),
        (0.5, 2.0, Some(0.4)),
        (0.7, 2.0, Some(0.4)),
        (0.875, 4.0, Some(0.1)),
        (1.0, 5.0, Some(0.1)),
    ] {
        assert!((law.modulus(depth) - modulus).abs() < 1e-14, "{depth}");
        assert_eq!(law.poisson(depth), poisson, "{depth}");
    }
    assert_eq!(law.breakpoints(), [0.5, 0.75]);
    // What the sublayers tell knows of the outer ratio too.
    let nested = law.sublayers()[1].law.sublayers();
    assert_eq!((nested[0].law.poisson(0.5), nested[1].law.poisson(0.5)), (Some(0.4), Some(0.1)));
    assert_eq!(nested[1].law.poisson_series(2), [0.1, 0.0]);
}

#[test]
fn faults_lead_to_their_place() {
    let inner = Stack { layers: vec![piece(1.0, None, level(2.0))] };
    let mut outer = Stack { layers: vec![piece(1.0, None, level(1.0)), piece(1.5, None, inner)] };
    let fault = outer.read(&NoFiles).unwrap_err();
    assert_eq!(fault.path, ["layers", "1", "thickness"]);
    let nothing = Stack { layers: Vec::new() };
    let mut outer = Stack { layers: vec![piece(1.0, None, level(1.0)), piece(1.5, None, nothing)] };
    assert_eq!(outer.read(&NoFiles).unwrap_err().path, ["layers", "1", "grading", "layers"]);
    let many = vec![piece(1.0, None, level(1.0)); MOST + 1];
    assert_eq!(Stack { layers: many }.read(&NoFiles).unwrap_err().message, "too many sublayers");
    let refusal = |stack: &Stack, setting| stack.law(&setting).unwrap_err();
    let two = Stack { layers: vec![piece(1.0, None, level(1.0)); 2] };
    assert!(matches!(refusal(&two, Setting::default()), Refusal::NotBuilt { .. }));
    assert!(matches!(refusal(&two, Setting::thick(positive(3.0))), Refusal::Unusable { .. }));
    assert!(matches!(refusal(&Stack { layers: vec![] }, Setting::default()), Refusal::Unusable { .. }));
}

#[test]
fn ten_thousand_sublayers() {
    let layers = (0..10_000).map(|i| piece(1e-3, None, level(1.0 + f64::from(i)))).collect();
    let law = law(&Stack { layers });
    assert_eq!((law.sublayers().len(), law.breakpoints().len()), (10_000, 9_999));
    assert_eq!(law.modulus(0.500_05), 5001.0);
}

/// How a law begins at the surface is how its uppermost sublayer does.
#[test]
fn a_stack_begins_as_its_top_does() {
    let phase = |modulus: f64| Phase { modulus: positive(modulus), poisson: Poisson::new(0.3).unwrap() };
    let [surface, base] = [1.0, 3.0].map(phase);
    let broken = VolumeFraction { surface, base, exponent: positive(0.3), rule: MixingRule::Mixture };
    let stacked = |layers| law(&Stack { layers }).broken_power();
    assert_eq!(stacked(vec![piece(1.0, None, broken.clone()), piece(1.0, Some(0.3), level(3.0))]), Some(0.3));
    assert_eq!(stacked(vec![piece(1.0, Some(0.3), level(1.0)), piece(1.0, None, broken)]), None);
}
