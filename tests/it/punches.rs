//! Growing contacts on a half-plane, against closed forms: what a stack of flat punches adds to flat punches that are
//! right already.

use slipzone::api::reference::cylinder::Cylinder;
use slipzone::api::reference::goodman_shear::Goodman;
use slipzone::api::reference::hyperbola::Hyperbola;
use slipzone::api::reference::power::Power;
use slipzone::api::reference::rounded_flat::RoundedFlat;
use slipzone::api::reference::wedge::Wedge;
use slipzone::engine::{Solution, Status, solve};
use slipzone::scene;

const POISSON: f64 = 0.3;
/// Unit modulus, plane strain.
const COMPLIANCE: f64 = 1.0 - POISSON;
const BETA: f64 = (1.0 - 2.0 * POISSON) / (2.0 - 2.0 * POISSON);
const ETA: f64 = 0.3;
/// Points of the contact, none of them on a kink.
const X: [f64; 6] = [0.03, 0.2, 0.45, 0.7, 0.93, 0.999];

fn solved(punch: &str, friction: bool) -> Solution {
    let friction =
        if friction { format!("friction = {{ type = \"goodman\", coefficient = {ETA} }}") } else { String::new() };
    let text = format!(
        "format = 1\n{friction}\n[layer]\npoisson = {POISSON}\nbase = {{ type = \"infinite\" }}\n\
         grading = {{ type = \"homogeneous\", modulus = 1.0 }}\n[punch]\n{punch}\n[load]\nhalf_width = 1.0\n\
         [solver]\ntolerance = 3e-11\n[output]\nx = {X:?}\n"
    );
    let solution = solve(&scene::parse(punch, &text).expect("a good scene"));
    assert_eq!(solution.status, Status::Converged, "{punch}: {:?}", solution.reason);
    solution
}

/// Compares the force, and the pressure over its largest.
fn compare(punch: &str, force: f64, pressure: impl Fn(f64) -> f64) {
    let solution = solved(punch, false);
    let error = solution.load.force.expect("a number") / force - 1.0;
    assert!(error.abs() < 1e-10, "{punch}: the force is off by {error:e}");
    let exact = X.map(pressure);
    let largest = exact.iter().fold(0.0_f64, |most, p| most.max(*p));
    for ((x, p), exact) in X.into_iter().zip(&solution.profile.pressure).zip(exact) {
        let error = (p.expect("inside") - exact) / largest;
        assert!(error.abs() < 1e-10, "{punch}: p({x}) is off by {error:e}");
    }
}

#[test]
fn pressures_of_the_field() {
    let (half_width, compliance) = (1.0, COMPLIANCE);
    let wedge = Wedge { slope: 0.05, half_width, compliance };
    compare("type = \"wedge\"\nslope = 0.05", wedge.force(), |x| wedge.pressure(x));
    for exponent in [1.2, 1.5, 2.0, 3.0, 4.0, 7.5] {
        let power = Power { coefficient: 0.05, exponent, half_width, compliance };
        let punch = format!("type = \"power\"\ncoefficient = 0.05\nexponent = {exponent}");
        compare(&punch, power.force(), |x| power.pressure(x));
    }
    let rounded = RoundedFlat { flat: 0.375, radius: 5.0, half_width, compliance };
    let punch = "type = \"rounded-flat\"\nhalf_width = 0.375\nradius = 5.0";
    compare(punch, rounded.force(), |x| rounded.pressure(x));
    let cylinder = Cylinder { radius: 10.0, half_width, compliance };
    compare("type = \"cylinder\"\nradius = 10.0", cylinder.force(), |x| cylinder.pressure(x));
}

/// Smooth, but no grid over the whole contact sees a tip so sharp: flat punches are stacked.
#[test]
#[cfg(feature = "formula")]
fn pressures_under_tips_rounded_off() {
    for rounding in [0.5, 0.1, 1e-2, 1e-4, 1e-7, 1e-11] {
        let tip = Hyperbola { slope: 0.05, rounding, half_width: 1.0, compliance: COMPLIANCE };
        let punch =
            format!("type = \"formula\"\nheight = \"0.05*sqrt(x^2 + c^2)\"\nparameters = {{ c = {rounding:e} }}");
        compare(&punch, tip.force(), |x| tip.pressure(x));
        let centre = solved(&punch, false).pressure.centre.expect("a number");
        let error = centre / tip.pressure(0.0) - 1.0;
        assert!(error.abs() < 1e-10, "{punch}: p(0) is off by {error:e}");
    }
}

/// On a graded layer a grid over all of the contact does tell a tip and a shoulder that are not too sharp, with
/// hundreds of unknowns.
#[test]
#[cfg(feature = "formula")]
fn details_of_a_smooth_shape_on_a_layer() {
    let tip = "0.05*sqrt(x^2 + 0.0025)";
    let shoulder = "0.05*x^2 + 0.001*(ln(1 + exp(20*x - 10)) + ln(1 + exp(-20*x - 10)))";
    for height in [tip, shoulder] {
        let solved = |friction: &str, quadrature: &str| {
            let text = format!(
                "format = 1\nload = {{ force = 0.1 }}\n{friction}\n[layer]\nthickness = 2.0\npoisson = {POISSON}\n\
                 grading = {{ type = \"exponential\", surface = 1.0, base = 4.0 }}\n[punch]\ntype = \"formula\"\n\
                 height = \"{height}\"\n[solver]\n{quadrature}\n"
            );
            solve(&scene::parse(height, &text).expect("a good scene"))
        };
        let exact = solved("", "quadrature = { type = \"de-sinc\", n = 512 }");
        for friction in ["", "friction = { type = \"goodman\", coefficient = 0.3 }"] {
            let solution = solved(friction, "");
            assert_eq!(solution.status, Status::Converged, "{height}: {:?}", solution.reason);
            for (number, exact) in [
                (solution.pressure.centre, exact.pressure.centre),
                (solution.pressure.peak, exact.pressure.peak),
                (solution.load.half_width, exact.load.half_width),
                (solution.load.indentation, exact.load.indentation),
            ] {
                let error = number.expect("a number") / exact.expect("a number") - 1.0;
                assert!(error.abs() < 1e-8, "{height}, {friction}: off by {error:e}");
            }
        }
    }
}

/// The stick zone of each is that of the flat punch; the shear, over its largest, that of the stack integrated in
/// closed form.
#[test]
fn shears_of_the_field() {
    let goodman = Goodman { eta: ETA, beta: BETA };
    let (half_width, compliance) = (1.0, COMPLIANCE);
    let compare = |punch: &str, kinks: &[f64], rate: &dyn Fn(f64) -> f64| {
        let solution = solved(punch, true);
        let ratio = solution.stick.as_ref().and_then(|stick| stick.ratio).expect("a stick zone");
        let error = ratio / goodman.stick().ratio - 1.0;
        assert!(error.abs() < 1e-10, "{punch}: a/b is off by {error:e}");
        let shear = solution.profile.shear.as_ref().expect("friction");
        let exact = X.map(|x| goodman.grown(rate, kinks, half_width, x));
        let largest = exact.iter().fold(0.0_f64, |most, q| most.max(q.abs()));
        for ((x, q), exact) in X.into_iter().zip(shear).zip(exact) {
            let error = (q.expect("inside") - exact) / largest;
            assert!(error.abs() < 1e-10, "{punch}: q({x}) is off by {error:e}");
        }
    };
    compare("type = \"cylinder\"\nradius = 10.0", &[], &|b| {
        Cylinder { radius: 10.0, half_width: b, compliance }.force_rate()
    });
    #[cfg(feature = "formula")]
    for rounding in [0.4, 1e-3] {
        let punch =
            format!("type = \"formula\"\nheight = \"0.05*sqrt(x^2 + c^2)\"\nparameters = {{ c = {rounding:e} }}");
        compare(&punch, &[rounding], &|b| Hyperbola { slope: 0.05, rounding, half_width: b, compliance }.force_rate());
    }
    compare("type = \"wedge\"\nslope = 0.05", &[], &|b| Wedge { slope: 0.05, half_width: b, compliance }.force_rate());
    compare("type = \"power\"\ncoefficient = 0.05\nexponent = 2.7", &[], &|b| {
        Power { coefficient: 0.05, exponent: 2.7, half_width: b, compliance }.force_rate()
    });
    compare("type = \"rounded-flat\"\nhalf_width = 0.375\nradius = 5.0", &[0.375], &|b| {
        RoundedFlat { flat: 0.375, radius: 5.0, half_width: b, compliance }.force_rate()
    });
}

/// `0.1 x^2`, and `0.3 (|x| - 0.4)` beyond 0.4, on a half-plane: the pressure has a logarithm at the corner, on either
/// side of it.
#[test]
fn beside_a_corner_the_pressure_follows_the_closed_form() {
    slipzone::link_plugins();
    let (a0, b, c) = (0.7, 0.7_f64, 0.4_f64);
    let exact = |x: f64| {
        let root = |x: f64| ((b - x) * (b + x)).sqrt();
        let logarithm = ((root(c) + root(x)) / ((x - c).abs() * (x + c)).sqrt()).ln();
        0.2 / a0 * root(x) + 0.6 / (std::f64::consts::PI * a0) * logarithm
    };
    for (tolerance, most) in [("1e-4", 1e-6), ("1e-6", 1e-8), ("1e-9", 1e-10)] {
        let distances = [-1e-2, -1e-4, -1e-7, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2, 0.1];
        let x = distances.map(|distance| (c + distance) / b);
        let text = format!(
            "format = 1\nlayer = {{ poisson = 0.3, base = {{ type = \"infinite\" }}, \
             grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"formula\", height = \"0.1*x^2 + 0.3*max(abs(x) - 0.4, 0)\" }}\nload = {{ half_width = {b:?} }}\n\
             solver = {{ tolerance = {tolerance} }}\noutput = {{ x = {x:?} }}\n"
        );
        let solution = slipzone::engine::solve(&slipzone::scene::parse("corner.toml", &text).expect("a scene"));
        let mean = solution.pressure.mean.expect("a load");
        for (x, p) in solution.profile.x.iter().zip(&solution.profile.pressure) {
            let error = (p.expect("a pressure") - exact(*x)).abs() / mean;
            // Closer than 1e-6 positions themselves are rounded.
            let allowed = if (x - c).abs() < 1e-6 { most + 1e-9 } else { most };
            assert!(error < allowed, "{error:.1e} at {:.0e} beside the corner, tolerance {tolerance}", x - c);
        }
    }
}

/// A flat face, a short rounding, a straight flank. Beyond the second kink the force remembers the first, over the
/// distance of both: a series that did not know was off by up to 1e-4 of the pressure there, and 6e-7 in the middle.
/// Expected: `int F'(t)/(pi sqrt(t^2 - x^2)) dt` with `F'(t) = (2 t/A0) int g''(s)/sqrt(t^2 - s^2) ds`, in 30 digits.
#[test]
fn a_rounding_however_short_is_told_from_a_corner() {
    let x = [0.0, 0.1, 0.5];
    for (width, exact, beside) in [
        (1e-6, [0.059_885_764_389_507, 0.060_691_593_897_818, 0.361_830_169_054_87], 0.361_830_131_144_31),
        (1e-4, [0.059_880_566_378_944, 0.060_686_206_474_701, 0.257_123_207_708_08], 0.257_119_418_279_43),
    ] {
        let text = format!(
            "format = 1\nlayer = {{ poisson = 0.3, base = {{ type = \"infinite\" }}, grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"formula\", slope = \"0.05*x/abs(x)*max(0, min(1, (abs(x) - 0.5)/{width:e}))\" }}\n\
             load = {{ half_width = 1.0 }}\nsolver = {{ tolerance = 1e-7 }}\noutput = {{ x = [0.0, 0.1, 0.5, {:?}] }}\n",
            0.5 + width
        );
        let solution = solve(&slipzone::scene::parse("rounding.toml", &text).expect("a good scene"));
        for (i, exact) in exact.into_iter().chain([beside]).enumerate() {
            let pressure = solution.profile.pressure[i].expect("a pressure");
            let error = (pressure / exact - 1.0).abs();
            println!("width {width:.0e}, point {i}: {error:.1e}");
            assert!(error < 1e-8, "{pressure} for {exact} at {:?}", x.get(i));
        }
    }
}

/// Half a row further in, nobody was told that the shape was the program's own between two rows.
#[test]
fn few_rows_of_a_table_under_the_contact_are_among_the_assumptions() {
    slipzone::link_plugins();
    let said = |half_width: f64| {
        let text = format!(
            "format = 1\nlayer = {{ thickness = 5.0, poisson = 0.3, grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"table\", points = [[0.0, 0.0], [0.5, 0.0125], [1.0, 0.05], [1.5, 0.1125], [2.0, 0.2]] }}\n\
             load = {{ half_width = {half_width} }}\n"
        );
        let solution = solve(&slipzone::scene::parse("rows.toml", &text).expect("a scene"));
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        solution.assumptions.into_iter().filter(|said| said.contains("few rows")).collect::<Vec<_>>()
    };
    // 0.05 x^2 between rows half apart: 0.003125 of 0.018.
    let told = said(0.6);
    assert!(told.len() == 1 && told[0].contains("up to 17 % of its height"), "{told:?}");
    assert!(said(1.2).is_empty(), "{:?}", said(1.2));
}

/// Seven clean rows of `x^4`, four of them under the contact: the force was 1.7 times too large, and converged.
#[test]
fn a_curve_that_rows_beyond_the_contact_bend_is_not_believed() {
    slipzone::link_plugins();
    let pressed = |last: f64, count: u32| {
        let rows = (0..count).map(|i| last * f64::from(i) / f64::from(count - 1)).map(|x| vec![x, 0.02 * x.powi(4)]);
        let rows = serde_json::to_string(&rows.collect::<Vec<_>>()).unwrap();
        let text = format!(
            "format = 1\nlayer = {{ thickness = 1.0, poisson = 0.3, grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n\
             punch = {{ type = \"table\", points = {rows} }}\nload = {{ half_width = 1.0 }}\nsolver = {{ tolerance = 1e-6 }}\n"
        );
        solve(&slipzone::scene::parse("rows.toml", &text).expect("a scene"))
    };
    let sparse = pressed(2.0, 7);
    assert_eq!(sparse.status, Status::AssumptionViolated);
    let reason = sparse.reason.as_ref().expect("why");
    assert!(
        reason.contains("is uncertain under the contact, by up to") && reason.contains("leave out those far"),
        "{reason}"
    );
    let says = |solution: &Solution, what: &str| solution.assumptions.iter().any(|said| said.contains(what));
    assert!(says(&sparse, "of its height at the contact's edge, around the fitted shape"), "{:?}", sparse.assumptions);
    let near = pressed(1.02, 7);
    assert_eq!(near.status, Status::Converged, "{:?}", near.reason);
    assert!(says(&near, "is uncertain under the contact"), "{:?}", near.assumptions);
    let dense = pressed(2.0, 100);
    assert_eq!(dense.status, Status::Converged, "{:?}", dense.reason);
    assert!(!says(&dense, "unsure") && !says(&dense, "of its height"), "{:?}", dense.assumptions);
    // Of a height of 0 nothing is a share: "inf %" was said.
    let tiny = "format = 1\nlayer = { thickness = 5.0, poisson = 0.5, grading = { type = \"homogeneous\", modulus = 1.0 } }\n\
        punch = { type = \"table\", x_unit = 1e99, height_unit = 1e-50, points = [[0.0, 0.0], [0.7, 0.01], [1.3, 0.15], [2.0, 0.8]] }\n\
        load = { half_width = 1.0 }\n";
    let tiny = solve(&slipzone::scene::parse("rows.toml", tiny).expect("a scene"));
    assert!(
        says(&tiny, "more than its height at the contact's edge, around the fitted shape"),
        "{:?}",
        tiny.assumptions
    );
}
