//! Functions against their inverses, against known series, and against each other's derivatives.

use super::Taylor;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

const TERMS: usize = 12;

/// Whether two series agree to rounding of the largest coefficient before each.
#[track_caller]
fn same(a: &Taylor, b: &Taylor, what: &str) {
    assert_eq!(a.coefficients().len(), b.coefficients().len(), "{what}: {a:?} {b:?}");
    let mut size: f64 = 1.0;
    for (k, (a, b)) in a.coefficients().iter().zip(b.coefficients()).enumerate() {
        size = size.max(a.abs());
        assert!((a - b).abs() < 1e-10 * size, "{what}, term {k}: {a} is not {b}");
    }
}

fn line(value: f64) -> Taylor {
    Taylor::line(value, 1.0, TERMS)
}

#[test]
fn known_series() {
    let factorial = |k: usize| (1..=k).map(|j| j as f64).product::<f64>();
    let even = |k: usize| if k.is_multiple_of(2) { 1.0 } else { 0.0 };
    let turn = |k: usize| if (k / 2).is_multiple_of(2) { 1.0 } else { -1.0 };
    let series = |f: &dyn Fn(usize) -> f64| Taylor::new((0..TERMS).map(f).collect());
    same(&line(0.0).exp(), &series(&|k| 1.0 / factorial(k)), "exp");
    same(&line(0.0).sin(), &series(&|k| (1.0 - even(k)) * turn(k) / factorial(k)), "sin");
    same(&line(0.0).cos(), &series(&|k| even(k) * turn(k) / factorial(k)), "cos");
    same(&line(0.0).sinh(), &series(&|k| (1.0 - even(k)) / factorial(k)), "sinh");
    same(&line(0.0).cosh(), &series(&|k| even(k) / factorial(k)), "cosh");
    same(&line(1.0).ln(), &series(&|k| if k == 0 { 0.0 } else { (2.0 * even(k + 1) - 1.0) / k as f64 }), "ln");
    same(&line(0.0).atan(), &series(&|k| (1.0 - even(k)) * turn(k) / (k.max(1)) as f64), "atan");
    same(&line(0.0).atanh(), &series(&|k| (1.0 - even(k)) / (k.max(1)) as f64), "atanh");
    let tangent = [0.0, 1.0, 0.0, 1.0 / 3.0, 0.0, 2.0 / 15.0, 0.0, 17.0 / 315.0];
    same(&Taylor::line(0.0, 1.0, 8).tan(), &Taylor::new(tangent.to_vec()), "tan");
    let error = |k: usize| {
        let (n, sign) = (k / 2, turn(k));
        (1.0 - even(k)) * 2.0 / PI.sqrt() * sign / (factorial(n) * (2 * n + 1) as f64)
    };
    same(&line(0.0).erf(), &series(&error), "erf");
    let binomial = |k: usize| (0..k).map(|j| (2.5 - j as f64) / (j + 1) as f64).product::<f64>();
    same(&line(1.0).powf(2.5), &series(&binomial), "(1 + t)^2.5");
}

#[test]
fn from_zero_on_there_are_so_many_terms_as_exist() {
    let t = Taylor::line(0.0, 1.0, 5);
    let terms = |series: Taylor| series.coefficients().to_vec();
    assert_eq!(terms(t.clone().powf(2.5)), [0.0; 3]);
    assert_eq!(terms(t.clone().powf(2.0)), [0.0, 0.0, 1.0, 0.0, 0.0]);
    assert_eq!(terms(t.clone().powf(7.5)), [0.0; 5]);
    assert_eq!(terms(t.clone().sqrt()), [0.0]);
    assert_eq!(terms(t.clone().powf(-1.0)), [0.0; 0]);
    assert_eq!(terms(t.clone().powf(0.0)), [1.0, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(terms((t.clone() * t.clone() * 9.0).sqrt()), [0.0, 3.0, 0.0, 0.0]);
    assert_eq!(terms((-(t.clone().powf(3.0)) * 8.0).cbrt()), [0.0, -2.0, 0.0]);
    assert_eq!(terms(t.clone().cbrt()), [0.0]);
    assert_eq!(terms(Taylor::constant(1.0, 5) / t.clone()), [0.0; 0]);
    assert_eq!(terms(t.clone().sin() / t.clone())[..3], [1.0, 0.0, -1.0 / 6.0]);
    assert_eq!(terms((t.clone() + 1.0).asin()), [FRAC_PI_2]);
    assert_eq!(terms(t.clone().ln().exp()).len(), 1, "no value, and certainly no slope");
    assert_eq!(terms(Taylor::new(vec![1.0, f64::NAN, 2.0]).exp()).len(), 3);
    assert_eq!(Taylor::new(vec![1.0, f64::NAN, 2.0]).exp().into_finite(), [1_f64.exp()]);
}

#[test]
fn rescaling_is_another_slope() {
    same(&Taylor::line(0.3, 1.0, TERMS).exp().rescaled(0.7), &Taylor::line(0.3, 0.7, TERMS).exp(), "rescaled");
}

#[test]
fn choices_are_made_right_of_the_point() {
    let t = line(0.0);
    same(&(-t.clone()).abs(), &t, "abs");
    let bent = t.clone() + -(t.clone() * t.clone());
    same(&t.clone().max(bent.clone()), &t, "max");
    same(&t.clone().min(bent.clone()), &bent, "min");
    assert!(t.clone().max(Taylor::constant(f64::NAN, TERMS)).coefficients()[0].is_nan());
    assert!(Taylor::constant(f64::NAN, TERMS).max(t).coefficients()[0].is_nan());
}

proptest! {
    #[test]
    fn inverses_undo(c in -0.8..0.8_f64, rest in prop::collection::vec(-0.7..0.7_f64, TERMS - 1)) {
        let u = Taylor::new(std::iter::once(c).chain(rest).collect());
        let above = u.clone() + 2.0;
        same(&u.clone().exp().ln(), &u, "exp, ln");
        same(&(u.clone().exp().log10() * std::f64::consts::LN_10), &u, "exp, log10");
        same(&u.clone().asin().sin(), &u, "asin, sin");
        same(&(-(u.clone().acos()) + FRAC_PI_2).sin(), &u, "acos, sin");
        same(&u.clone().atan().tan(), &u, "atan, tan");
        same(&u.clone().asinh().sinh(), &u, "asinh, sinh");
        same(&above.clone().acosh().cosh(), &above, "acosh, cosh");
        same(&u.clone().tanh().atanh(), &u, "tanh, atanh");
        same(&(above.clone().sqrt() * above.clone().sqrt()), &above, "sqrt");
        same(&(-above.clone()).cbrt().powf(3.0), &-above.clone(), "cbrt");
        same(&(u.clone() / above.clone() * above.clone()), &u, "quotient");
        same(&above.clone().pow(u.clone()), &(above.clone().ln() * u.clone()).exp(), "pow");
        same(&above.clone().powf(-2.3), &(above.ln() * -2.3).exp(), "powf");
        same(&(u.clone().sin() / u.clone().cos()), &u.clone().tan(), "tan");
        same(&(u.clone().sinh() / u.clone().cosh()), &u.clone().tanh(), "tanh");
    }

    /// A series adds up to the function's values, which the standard library has.
    #[test]
    fn values_nearby(c in 0.1..0.9_f64, t in 0.0..0.02_f64) {
        type Pair = (&'static str, fn(Taylor) -> Taylor, fn(f64) -> f64);
        let functions: [Pair; 10] = [
            ("sin", Taylor::sin, f64::sin),
            ("cos", Taylor::cos, f64::cos),
            ("exp", Taylor::exp, f64::exp),
            ("ln", Taylor::ln, f64::ln),
            ("tanh", Taylor::tanh, f64::tanh),
            ("asin", Taylor::asin, f64::asin),
            ("acos", Taylor::acos, f64::acos),
            ("sqrt", Taylor::sqrt, f64::sqrt),
            ("cbrt", Taylor::cbrt, f64::cbrt),
            ("erf", Taylor::erf, spec_math::cephes64::erf),
        ];
        for (name, series, function) in functions {
            // Singularities are 0.1 away at least: 12 terms leave 0.2^12 of t.
            let sum = series(line(c)).coefficients().iter().rev().fold(0.0, |sum, c| sum * t + c);
            prop_assert!((sum - function(c + t)).abs() < 1e-8, "{}", name);
        }
    }
}
