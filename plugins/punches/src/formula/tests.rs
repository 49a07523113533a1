#![allow(clippy::float_cmp)] // where equality is asserted, it is exact by construction

use super::*;
use crate::{Cylinder, RoundedFlat};
use proptest::prelude::*;
use slipzone_api::Positive;

fn height(text: &str) -> Result<Box<dyn PunchShape>, Refusal> {
    Formula::height(text, BTreeMap::new()).shape()
}

fn slope(text: &str) -> Result<Box<dyn PunchShape>, Refusal> {
    Formula::slope(text, BTreeMap::new()).shape()
}

fn good(shape: Result<Box<dyn PunchShape>, Refusal>) -> Box<dyn PunchShape> {
    shape.unwrap_or_else(|refusal| panic!("{refusal}"))
}

#[test]
fn a_formula_may_be_what_another_punch_is() {
    let round = Cylinder { radius: Positive::new(10.0).unwrap() }.shape().unwrap();
    let (half_width, radius) = (Positive::new(0.5).unwrap(), Positive::new(5.0).unwrap());
    let edges = RoundedFlat { half_width, radius }.shape().unwrap();
    for (shape, reference, kinks) in [
        (height("x^2/20"), &round, vec![]),
        (height("3 + x^2/20"), &round, vec![]),
        (slope("x/10"), &round, vec![]),
        (height("max(0, abs(x)-0.5)^2/10"), &edges, vec![0.5]),
        (slope("max(0, x-0.5)/5 + min(0, x+0.5)/5"), &edges, vec![0.5]),
    ] {
        let shape = good(shape);
        for i in -20..=20 {
            let x = 0.1 * f64::from(i);
            // Rounding of the constant 3 counts with the height.
            assert!((shape.height(x) - reference.height(x)).abs() < 1e-15, "{shape:?} at {x}");
            assert!((shape.slope(x) - reference.slope(x)).abs() < 1e-15, "{shape:?} at {x}");
        }
        assert_eq!(shape.kinks(), kinks, "{shape:?}");
        assert_eq!(shape.face(), reference.face(), "{shape:?}");
        assert_eq!(shape.corners(), [0.0; 0]);
        assert_eq!(shape.flaw(2.0), None);
    }
}

/// Where terms cancel, the level face of such a punch rounds: a dip of one last bit was a punch that leaves the
/// surface.
#[test]
fn rounding_of_terms_that_cancel_is_no_flaw() {
    for i in 1..40 {
        let c = 0.03 * f64::from(i);
        let text = format!("0.05*(abs(x-{c}) + abs(x+{c}))");
        assert_eq!(good(height(&text)).flaw(1.9), None, "{text}");
    }
    assert!(height("0.05*x^2*(x^2 - 1e-9)").is_err(), "a dip of as little is no rounding");
}

#[test]
fn a_height_by_its_slope_is_a_number_however_near_to_a_kink() {
    for text in [
        "0.05*(max(0, x-0.5) - max(0, -x-0.5))",
        "0.1*x*max(0, x^2-0.25)",
        "0.02*x + 0.1*(x/abs(x))*max(0, abs(x)-0.5)^0.1",
    ] {
        let shape = good(slope(text));
        let mut x = 0.5_f64;
        let mut before = shape.height(x);
        for _ in 0..40 {
            x = x.next_up();
            let height = shape.height(x);
            assert!(height >= before, "{text}: {height} after {before} at {x}");
            before = height;
        }
    }
}

#[test]
fn corners_are_kinks_where_the_slope_jumps() {
    for (shape, kinks, corners) in [
        (height("0.1*abs(x)"), vec![0.0], vec![0.0]),
        (slope("0.1*x/abs(x)"), vec![0.0], vec![0.0]),
        (height("abs(x)^1.5"), vec![0.0], vec![]),
        (height("abs(x)^1.05"), vec![0.0], vec![]),
        (height("abs(x)^1.000001"), vec![0.0], vec![]),
        (height("abs(x)^1.0000001"), vec![0.0], vec![]),
        (height("abs(x)^1.02 + abs(x)^1.01"), vec![0.0], vec![]),
        (height("0.03*abs(x) + 0.02*abs(x)^1.05"), vec![0.0], vec![0.0]),
        (height("0.03*abs(x) + abs(x)^1.01 + abs(x)^1.1"), vec![0.0], vec![0.0]),
        (height("0.05*x^2 + 1e-9*abs(x)"), vec![0.0], vec![0.0]),
        (height("0.05*x^2 + 1e-9*abs(x)^1.2"), vec![0.0], vec![]),
        (height("x^2 + max(0, abs(x)-1)"), vec![1.0], vec![1.0]),
        (height("x^2 + 0.1*(abs(x-1) + abs(x+1))"), vec![1.0], vec![1.0]),
        (height("x^2 + max(0, abs(x)-1)^1.5"), vec![1.0], vec![]),
        (height("x^2 + max(0, abs(x)-1)^1.004"), vec![1.0], vec![]),
        (height("x^2 + 1e-6*max(0, abs(x)-1)"), vec![1.0], vec![1.0]),
        (height("0.001*(abs(x-0.16)+abs(x+0.16)+abs(x-0.32)+abs(x+0.32))"), vec![0.16, 0.32], vec![0.16, 0.32]),
        (slope("0.1*x + 0.05*(x-1)/abs(x-1) + 0.05*(x+1)/abs(x+1)"), vec![1.0], vec![1.0]),
    ] {
        let shape = good(shape);
        assert_eq!(shape.kinks(), kinks, "{shape:?}");
        assert_eq!(shape.corners(), corners, "{shape:?}");
        assert_eq!(shape.slope(0.0), 0.0);
    }
    let broken = good(slope("0.1*x + 0.05*(x-1)/abs(x-1) + 0.05*(x+1)/abs(x+1)"));
    assert!((broken.slope(1.0) - 0.15).abs() < 1e-11, "the mean of both sides: {}", broken.slope(1.0));
}

#[test]
fn what_is_wrong_at_the_tip_is_refused() {
    for (shape, words) in [
        (height("x^3"), "not symmetric at x = "),
        (height("x^1.5"), "write `abs(x)` for `x`"),
        (slope("x^2"), "opposite slopes"),
        (height("x^2 + 1e-3*x"), "not symmetric"),
        (height("-x^2"), "leaves the surface"),
        (height("sqrt(abs(x))"), "not convex from its tip on"),
        (height("1/x^2"), "no finite value at x = 0"),
        (height("sin(x)/x"), "height(0) = NaN"),
        (height("ln(abs(x))"), "height(0) = -inf"),
        (height("0*x"), "gives no punch"),
        (slope("sqrt(-1-x^2)"), "gives no punch"),
        (slope("1/x"), "not convex"),
        (height("x^2/(2*R)"), "unknown name `R`"),
    ] {
        let refusal = shape.expect_err(words).to_string();
        assert!(refusal.contains(words), "{words}: {refusal}");
    }
}

#[test]
fn what_is_wrong_further_out_is_named_with_its_place() {
    for (shape, half_width, x, words) in [
        (height("1 - cos(x)"), 3.0, std::f64::consts::FRAC_PI_2, "not convex"),
        (height("x^2 - x^4"), 2.0, 6_f64.sqrt().recip(), "not convex"),
        (height("10 - sqrt(100-x^2)"), 11.0, 10.0, "no finite"),
        (height("x^2 + 1e-9/abs(abs(x)-0.3) - 1e-9/0.3"), 0.5, 0.3, ""),
        (height("x^2 + max(0, x-0.7)^2"), 1.0, 0.7, "not symmetric"),
    ] {
        let flaw = match shape {
            Ok(shape) => shape.flaw(half_width).unwrap_or_else(|| panic!("{words} at {x}")),
            // Within twice the natural length it is found before.
            Err(refusal) => {
                assert!(refusal.to_string().contains(words), "{refusal}");
                continue;
            }
        };
        assert!(flaw.what.contains(words), "{flaw:?}");
        assert!((flaw.x / x - 1.0).abs() < 0.02, "{flaw:?}, not at {x}");
    }
    assert_eq!(good(height("10 - sqrt(100-x^2)")).flaw(9.9), None);
    assert_eq!(good(height("10 - sqrt(100-x^2)")).kinks(), [10.0]);
}

#[test]
fn far_out_there_may_be_no_number_but_never_a_panic() {
    for text in ["x^2", "cosh(x)-1", "10 - sqrt(100-x^2)", "tan(x)*x", "abs(x)^1.5", "exp(x^2)"] {
        let shape = good(height(text));
        for x in [1e3, 1e10, 1e100, 1e300, f64::MAX, f64::INFINITY, f64::NAN] {
            let _ = (shape.height(x), shape.slope(x), shape.height(-x), shape.slope(-x));
        }
    }
    let shape = good(slope("sinh(x)"));
    for x in [1e3, 1e100, f64::MAX, f64::INFINITY, f64::NAN] {
        let _ = (shape.height(x), shape.slope(-x));
    }
}

/// Natural lengths are neither tiny nor huge beside what the formula is about.
#[test]
fn the_scale_is_that_of_the_shape() {
    for (shape, from, to) in [
        (height("x^2/20"), 2.0, 10.0),
        (height("1e6*x^2"), 1e-7, 1e-6),
        (height("x^2/2e40"), 1e39, 1e40),
        (height("10 - sqrt(100-x^2)"), 2.0, 10.0),
        (height("0.1*(sqrt(1+x^2)-1)"), 0.2, 1.0),
        (height("0.1*abs(x)"), 1.0, 1.0),
        (height("1 - cos(x)"), 0.2, 1.0),
    ] {
        let shape = good(shape);
        let length = shape.natural_length();
        assert!((from..=to).contains(&length), "{shape:?}: {length}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// Height by the integral of the slope, against the height itself.
    #[test]
    fn a_slope_is_integrated_to_rounding(x in 0.01..4.0_f64) {
        for (by_slope, by_height) in [
            ("x^3", "x^4/4"),
            ("sinh(x)", "2*sinh(x/2)^2"),
            ("x*abs(x)^(-0.5)", "abs(x)^1.5/1.5"),
            ("0.2*x + 0.1*max(0, x-1) + 0.1*min(0, x+1)", "0.1*x^2 + 0.05*max(0, abs(x)-1)^2"),
            ("tanh(20*x)", "ln(cosh(20*x))/20"),
        ] {
            let (integral, exact) = (good(slope(by_slope)).height(x), good(height(by_height)).height(x));
            prop_assert!((integral / exact - 1.0).abs() < 1e-13, "{}: {} for {}", by_slope, integral, exact);
        }
    }
}
