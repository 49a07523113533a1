//! Values against the standard library, derivatives against differences, faults against their places.

#![allow(clippy::float_cmp)] // where equality is asserted, it is exact by construction

use crate::{DEEPEST, FUNCTIONS, Formula, LONGEST};
use proptest::prelude::*;
use slipzone_api::{Fault, Place};
use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

fn parse(text: &str) -> Result<Formula, Fault> {
    let occurring = |name: &str| text.split(|c: char| !c.is_alphanumeric()).any(|word| word == name);
    let parameters = [("R", 10.0), ("a2", 2.0)].into_iter().filter(|(name, _)| occurring(name));
    Formula::parse("height", text, "x", &parameters.map(|(name, value)| (name.to_owned(), value)).collect())
}

fn singular(formula: &Formula, scale: f64) -> Vec<f64> {
    formula.singular_points(scale, 64, &formula.narrow_places(4.0 * scale))
}

fn value(text: &str, x: f64) -> f64 {
    parse(text).unwrap_or_else(|fault| panic!("{text}: {fault}")).at(x).value
}

#[test]
fn signs_and_powers_bind_as_on_paper() {
    for (text, at_three) in [
        ("x", 3.0),
        ("-x^2", -9.0),
        ("(-x)^2", 9.0),
        ("x^-2", 1.0 / 9.0),
        ("2^3^x/2^27", 1.0),
        ("2-3-x", -4.0),
        ("12/2/x", 2.0),
        ("2*x^2", 18.0),
        ("--x", 3.0),
        ("-+-x", 3.0),
        ("1-(-x)", 4.0),
        ("x*-2", -6.0),
        ("1.5e1*x", 45.0),
        (".5*x", 1.5),
        ("5.*x", 15.0),
        ("2e-1 * x", 0.6),
        ("x ^ 2 / ( 2 * R )", 0.45),
        ("max(x, 1, 5, 2)", 5.0),
        ("min(x, 1, -x)", -3.0),
        ("a2*x + pi - pi + e - e", 6.0),
        ("abs(x - 5)^2", 4.0),
        ("abs(x - 5)^3", 8.0),
    ] {
        assert!((value(text, 3.0) - at_three).abs() < 1e-14 * at_three.abs(), "{text} = {}", value(text, 3.0));
    }
}

#[test]
fn every_function_is_there_with_its_derivative() {
    for (name, arguments) in FUNCTIONS {
        // acosh needs an argument above 1, its inverse pairs one below.
        let x = if name == "acosh" { 1.7 } else { 0.4 };
        let text = if arguments > 1 { format!("{name}(x^2, 0.3*x)") } else { format!("{name}(x)") };
        let formula = parse(&text).unwrap_or_else(|fault| panic!("{text}: {fault}"));
        let step = 1e-5;
        let difference = (formula.at(x + step).value - formula.at(x - step).value) / (2.0 * step);
        let slope = formula.at(x).slope;
        // Truncation 1e-10 times the third derivative, rounding 1e-11.
        assert!((difference - slope).abs() < 1e-8 * (1.0 + slope.abs()), "{text}: {slope}, but {difference}");
    }
    assert_eq!(value("log(x)", 3.0), 3_f64.ln());
    assert_eq!(value("ln(x)", 3.0), 3_f64.ln());
    assert_eq!(value("log10(x)", 100.0), 2.0);
}

proptest! {
    /// The derivative is exact, whatever is composed.
    #[test]
    fn derivatives_of_compositions(c in 0.1..3.0_f64, x in 0.05..2.0_f64) {
        for text in ["sqrt(1+(c*x)^2)-1", "exp(-c*x)*sin(c*x)", "ln(cosh(c*x))", "(1+c*x)^(2+c)", "x^(c*x)", "atan(x)/(1+c*x^4)"] {
            let formula = Formula::parse("f", text, "x", &[("c".to_owned(), c)].into()).unwrap();
            let step = 1e-5;
            let difference = (formula.at(x + step).value - formula.at(x - step).value) / (2.0 * step);
            let slope = formula.at(x).slope;
            // The third derivative of these is below 1e4 in size here, of x^(3x) included.
            prop_assert!((difference - slope).abs() < 1e-5 * (1.0 + slope.abs()), "{}: {} but {}", text, slope, difference);
        }
    }

    /// No text makes it panic, and every fault lies in the text.
    #[test]
    fn any_text_is_a_formula_or_a_fault(text in "[x0-9a-zR.,+*/^() \u{b2}-]{0,60}") {
        match Formula::parse("height", &text, "x", &BTreeMap::new()) {
            Ok(formula) => { formula.at(0.3); formula.singular_points(1.0, 64, &formula.narrow_places(4.0)); }
            Err(fault) => if let Place::Text(span) = fault.place { prop_assert!(text.get(span).is_some()); },
        }
    }
}

#[test]
fn faults_are_located_and_helpful() {
    let cases = [
        ("x^2/(2*r)", 7..8, "unknown name `r`", Some("did you mean `R`?")),
        ("sqr(x)", 0..3, "unknown function `sqr`", Some("did you mean `sqrt`?")),
        ("sign(x)", 0..4, "unknown function `sign`", Some("the sign of x is x/abs(x)")),
        ("x*length", 2..8, "unknown name `length`", Some("give it a value: parameters = { length = 1.0 }")),
        ("2x", 1..2, "no formula", Some("a product is written with `*`, as in 2*x")),
        ("2(x)", 1..2, "no formula", Some("a product is written with `*`, as in 2*x")),
        ("0,5*x", 1..2, "no formula", Some("decimals are written with a point, as in 0.5")),
        ("x**2", 2..3, "no formula", Some("a power is written with `^`, as in x^2")),
        ("x\u{b2}", 1..3, "means nothing", Some("a power is written with `^`, as in x^2")),
        ("|x|", 0..1, "means nothing", Some("the absolute value is written abs(...)")),
        ("1 \u{2212} x", 2..5, "means nothing", Some("minus is the plain `-`")),
        ("g = x", 2..3, "means nothing", Some("only the right-hand side is written")),
        ("(x", 2..2, "no formula", None),
        ("x)", 1..2, "no formula", None),
        ("x +", 3..3, "no formula", None),
        ("", 0..0, "no formula", None),
        ("sin x", 4..5, "no formula", Some("as in sin(x)")),
        ("sin(x, 2)", 0..3, "wrong number of arguments", None),
        ("min(x)", 0..3, "wrong number of arguments", None),
        ("sin()", 4..5, "no formula", None),
        ("x(2)", 1..2, "no formula", None),
        ("x + 1/(2-2)", 5..11, "division by zero", None),
        ("1.2.3*x", 3..5, "no formula", None),
        ("1e999*x", 0..5, "not a number", None),
        ("2 + 3", 0..5, "does not contain `x`", None),
    ];
    for (text, span, message, hint) in cases {
        let fault = Formula::parse("height", text, "x", &[("R".to_owned(), 1.0)].into()).unwrap_err();
        assert!(fault.message.contains(message), "{text}: {fault}");
        assert_eq!(fault.place, Place::Text(span), "{text}: {fault}");
        assert_eq!(fault.hint.as_deref(), hint, "{text}: {fault}");
        assert_eq!(fault.path, ["height"]);
    }
}

#[test]
fn parameters_are_checked_each_under_its_key() {
    for (name, value, message) in [
        ("x", 1.0, "is taken"),
        ("pi", 1.0, "is taken"),
        ("sin", 1.0, "is taken"),
        ("R0", f64::NAN, "is not allowed"),
        ("R 0", 1.0, "not a name"),
        ("", 1.0, "not a name"),
        ("2", 1.0, "not a name"),
        ("idle", 1.0, "does not occur"),
    ] {
        let fault = Formula::parse("height", "x", "x", &[(name.to_owned(), value)].into()).unwrap_err();
        assert!(fault.message.contains(message), "{name}: {fault}");
        assert_eq!(fault.path, ["parameters", name]);
    }
}

#[test]
fn length_and_depth_are_bounded() {
    let nested = |depth: usize| format!("{}x{}", "(".repeat(depth), ")".repeat(depth));
    assert!(parse(&nested(DEEPEST)).is_ok());
    for deep in [nested(DEEPEST + 1), "sin(".repeat(450), "2^".repeat(900), "1+(1*(1-(".repeat(200)] {
        assert!(parse(&deep).unwrap_err().message.contains("too deeply"), "{deep:.20}");
    }
    let pending = |depth: usize| format!("{}x{}", "x+x*x^(".repeat(depth), ")".repeat(depth));
    assert!(parse(&pending(20)).is_ok());
    assert!(parse(&pending(24)).unwrap_err().message.contains("too deeply"), "no room on the stack");
    let long = |terms: usize| vec!["x"; terms].join("+");
    assert_eq!(value(&long(LONGEST / 2), 1.0), 1000.0);
    assert!(parse(&long(5000)).unwrap_err().message.contains("too long"));
    assert_eq!(value(&format!("{}x", "-".repeat(1998)), 1.0), 1.0);
}

#[test]
fn singular_points_are_found() {
    let points = |text: &str| singular(&parse(text).unwrap(), 1.0);
    for smooth in [
        "x^2",
        "ln(1 + exp(40*x - 9))",
        "sqrt(1+x^2)",
        "exp(-x^2)*cos(x)",
        "abs(x)^2",
        "cosh(x)/(1+x^2)",
        "abs(3)*x^4",
        "ln(2+x)",
    ] {
        assert_eq!(points(smooth), [0.0; 0], "{smooth}");
    }
    for kinked in ["abs(x)", "abs(x)^3", "x^1.5", "sqrt(x^2)", "sqrt(x)", "max(x, -x)", "x^-1", "x*ln(x)", "cbrt(x)"] {
        assert_eq!(points(kinked), [0.0], "{kinked}");
    }
    for (text, places) in [
        ("abs(x-1)", vec![1.0]),
        ("max(0, x-0.3)", vec![0.3]),
        ("sqrt((x-0.7)^2)", vec![0.7]),
        ("max(abs(x), 2*abs(x)-1)", vec![0.0, 1.0]),
        ("x^2 + max(0, abs(x)-0.7)^2", vec![0.7]),
        ("min(x^2, abs(x)+2)", vec![2.0]),
        ("1/(x-0.3)", vec![0.3]),
        ("R - sqrt(R^2-x^2)", vec![10.0]),
        ("asin(x/2)", vec![2.0]),
        ("tan(x)*0.5", vec![FRAC_PI_2, 3.0 * FRAC_PI_2]),
        ("abs(x^2 - 1e-12)", vec![1e-6]),
    ] {
        let found = points(text);
        let found = &found[..found.len().min(places.len())];
        assert!(
            found.len() == places.len() && found.iter().zip(&places).all(|(a, b)| (a - b).abs() <= 4e-16 * b),
            "{text}: {found:?}"
        );
    }
    assert_eq!(points("abs(sin(100*x))").len(), 64, "the first of many");
}

/// Between two samples something may pass zero and come back.
#[test]
fn both_ends_of_a_film_are_found_however_thin() {
    let parameters = [("d".to_owned(), 0.7), ("w".to_owned(), 3e-4)].into();
    for film in [
        "max(0, 1 - ((x-d)/w)^2)",
        "max(0, 1 - abs(x-d)/w)",
        "max(0, 1 - abs(x-d)/w)^3",
        "sqrt(max(0, w^2 - (x-d)^2))",
        "max(0, min(1, 5*(1 - abs(x-d)/w)))",
        "min(1, 5*max(0, 1 - abs(x-d)/w))",
        "exp(-1/max(1e-9, 1 - ((x-d)/w)^2))",
        "max(0, exp(-((x-d)/w)^2) - exp(-1))",
        "abs(1 - ((x-d)/w)^2)",
    ] {
        let found = singular(&Formula::parse("f", film, "x", &parameters).unwrap(), 0.25);
        for end in [0.6997, 0.7003] {
            assert!(found.iter().any(|x| (x - end).abs() < 1e-11), "{film}: {found:?}");
        }
    }
    // Waves too short for the samples: each would find more of them than the one before.
    let waves: Vec<String> = (1..20).map(|k| format!("abs(sin({k}e9*x))")).collect();
    assert_eq!(singular(&parse(&waves.join(" + ")).unwrap(), 0.25).len(), 64);
    let tops = singular(&parse("max(0, sin(20*x) - 0.999)").unwrap(), 0.25);
    assert_eq!(tops.iter().filter(|x| **x < 1.0).count(), 6, "three tops: {tops:?}");
}

#[test]
fn slopes_at_a_corner_are_the_mean_of_both_sides() {
    let slope = |text: &str, x: f64| parse(text).unwrap().at(x).slope;
    assert_eq!(slope("abs(x-1) + 3*x", 1.0), 3.0);
    assert_eq!(slope("max(x, 3*x-2)", 1.0), 2.0);
    assert_eq!(slope("min(x, 3*x-2)", 1.0), 2.0);
    assert!(parse("max(x, ln(-x))").unwrap().at(1.0).value.is_nan(), "what is no number does not get lost");
}

#[test]
fn series_are_the_closed_ones() {
    for (text, x, expected) in [
        ("exp(x)", 0.0, vec![1.0, 1.0, 0.5, 1.0 / 6.0]),
        ("1/(1-x)", 0.0, vec![1.0; 4]),
        ("2^x", 0.0, vec![1.0, 2_f64.ln(), 2_f64.ln().powi(2) / 2.0, 2_f64.ln().powi(3) / 6.0]),
        ("abs(x-1)", 0.0, vec![1.0, -1.0, 0.0, 0.0]),
        ("1 + min(x, 2*x) - max(x, x^2)", 0.0, vec![1.0, 0.0, 0.0, 0.0]),
        ("1 + x^2.5", 0.0, vec![1.0, 0.0, 0.0]),
        ("1 + sqrt(x)", 0.0, vec![1.0]),
        ("sin(x)/x + 1 - cos(x)/1", 0.0, vec![1.0, 0.0, 1.0 / 3.0, 0.0]),
        ("ln(x)", 0.0, vec![]),
        ("(1+x)^3/R*10", 1.0, vec![8.0, 12.0, 6.0, 1.0]),
    ] {
        let series = parse(text).unwrap_or_else(|fault| panic!("{text}: {fault}")).series(x, 4);
        assert_eq!(series.len(), expected.len(), "{text}: {series:?}");
        assert!(
            series.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-14 * (1.0 + b.abs())),
            "{text}: {series:?}"
        );
    }
}

/// Every function's second coefficient is the derivative that the dual numbers carry.
#[test]
fn series_and_derivatives_agree() {
    for (name, arguments) in FUNCTIONS {
        let x = if name == "acosh" { 1.7 } else { 0.4 };
        let text = if arguments > 1 { format!("{name}(x^2, 0.3*x)") } else { format!("{name}(1.1*x)") };
        let formula = parse(&text).unwrap_or_else(|fault| panic!("{text}: {fault}"));
        let (series, dual) = (formula.series(x, 2), formula.at(x));
        assert_eq!(series[0], dual.value, "{text}");
        assert!((series[1] - dual.slope).abs() < 1e-14 * (1.0 + dual.slope.abs()), "{text}: {series:?}");
    }
}

#[test]
fn formulas_share_their_parameters() {
    let parameters: BTreeMap<_, _> = [("a".to_owned(), 2.0)].into();
    let parse = |first: &str, second: &str, given: &[(&str, f64)]| {
        Formula::parse_each(&[("one", first), ("two", second)], "x", &parameters, given)
    };
    let both = parse("a*x", "x/h", &[("h", 4.0)]).unwrap();
    assert_eq!(both.iter().map(|formula| formula.at(1.0).value).collect::<Vec<_>>(), [2.0, 0.25]);
    assert!(parse("a*x", "x", &[("h", 4.0)]).is_ok(), "what is given need not occur");
    let fault = parse("x", "x^2", &[]).unwrap_err();
    assert_eq!((fault.path, fault.found.unwrap().as_str()), (vec!["parameters".into(), "a".into()], "`x` and `x^2`"));
    let fault = parse("a*x", "x", &[("a", 4.0)]).unwrap_err();
    assert_eq!((fault.path, fault.message.as_str()), (vec!["parameters".into(), "a".into()], "the name `a` is taken"));
    assert_eq!(parse("a*x", "x +", &[]).unwrap_err().path, ["two"]);
}

/// Also where it begins so level that neither its slope nor its bend tell.
#[test]
fn narrow_places_are_as_wide_as_the_function_takes() {
    for (text, place, width) in [
        ("exp(-(x/0.05)^2)", 0.0, 0.05),
        ("exp(-(x/0.05)^4)", 0.0, 0.05),
        ("exp(-(x/1e-6)^6)", 0.0, 1e-6),
        ("exp(-((x - 0.3)/0.01)^4)", 0.3, 0.01),
        ("exp(-abs(x - 0.3)/0.01)", 0.3, 0.01),
        ("1/(1 + (x/0.03)^2)^6", 0.0, 0.03),
        ("1/cosh(x/0.003)", 0.0, 0.003),
        ("tanh((x - 0.3)/0.001)", 0.3, 0.001),
        ("sin(pi*x)^10000", 0.5, 0.0045),
        ("(4*x*(1 - x))^1e6", 0.5, 0.0005),
        // A power whose exponent varies is an exponential.
        ("e^(-((x - 0.33)/0.004)^2)", 0.33, 0.004),
        ("10^(-((x - 0.33)/0.004)^2)", 0.33, 0.0026),
        ("0.5^(((x - 0.33)/0.004)^2)", 0.33, 0.0048),
        ("10^(-3*10^(-((x - 0.33)/0.004)^2))", 0.33, 0.0026),
        ("(2 + x)^(-((x - 0.33)/0.004)^2)", 0.33, 0.0044),
        // Where an exponential outgrows what is beside it there is a step.
        ("1/(1 + exp(-(x - 0.37)/0.0005))", 0.37, 0.0005),
        ("1/(1 + e^((0.37 - x)/0.0005))", 0.37, 0.0005),
        ("exp(x/0.001)/(exp(x/0.001) + exp(0.37/0.001))", 0.37, 0.001),
        ("2/(3*exp(-(x - 0.37)/0.0005) + 3)", 0.37, 0.0005),
        ("1/(1 + (x/0.37)^1000)", 0.37, 0.00037),
        ("exp(-exp((x - 0.37)/0.0005))", 0.37, 0.0005),
        ("atan(exp((x - 0.37)/0.0005))", 0.37, 0.0005),
        ("ln(1 + exp((x - 0.37)/0.0005))", 0.37, 0.0005),
    ] {
        let found = parse(text).unwrap().narrow_places(1.0);
        let is_it = |(x, w): &(f64, f64)| (x - place).abs() < 1e-9 && *w > 0.4 * width && *w < 2.1 * width;
        assert!(found.iter().any(is_it), "{text}: {found:?}");
    }
}

/// A film is where the argument of an exponential turns around: of a parabola once, of a quartic three times. A step is
/// where that of a hyperbolic tangent passes through zero, which a straight one does once and another as often as it
/// likes.
#[test]
fn narrow_places_are_found_wherever_an_argument_turns_or_passes_through_zero() {
    for (text, places) in [
        ("exp(-((x - 0.3)/0.001)^2)", &[0.3][..]),
        ("exp(-((x - 0.3)*(x - 0.7)/0.001)^2)", &[0.3, 0.5, 0.7]),
        ("tanh((x - 0.3)/0.001)", &[0.3]),
        ("tanh(2*(0.3 - x)/0.001 + 1)", &[0.3005]),
        ("tanh((x - 0.3)*(x - 0.7)/0.001)", &[0.3, 0.5, 0.7]),
        ("1/(0.001 + (x - 0.3)*(x - 0.3))", &[0.3]),
        ("exp(-x/0.001)", &[]),
        ("e^(-x/0.001)", &[]),
        ("1/(1 + x^8)", &[]),
        // Both summands are one nearly everywhere: that they are equal there is rounding.
        ("1/(1 + exp(-(x - 0.3)/0.001)) - 1/(1 + exp(-(x - 0.4)/0.001))", &[0.3, 0.4]),
        ("exp(-((x - 0.5)/0.001)^2)", &[0.5]),
    ] {
        let mut inside: Vec<f64> = parse(text)
            .unwrap()
            .narrow_places(1.0)
            .into_iter()
            .filter(|(x, width)| *x > 0.0 && *x < 1.0 && *width < 0.1)
            .map(|(x, _)| x)
            .collect();
        inside.sort_by(f64::total_cmp);
        // Two functions may take the same argument.
        inside.dedup_by(|one, other| (*one - *other).abs() < 1e-6);
        assert_eq!(inside.len(), places.len(), "{text}: {inside:?}");
        for (found, place) in inside.iter().zip(places) {
            assert!((found - place).abs() < 1e-6, "{text}: {inside:?}");
        }
    }
}
