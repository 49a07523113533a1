//! Depths counted from a datum, which sinks as well.

use slipzone::engine::{Solution, Status, solve};
use slipzone::scene::parse;

fn solved(text: &str) -> Solution {
    slipzone::link_plugins();
    solve(&parse("datum.toml", &format!("format = 1\n{text}")).expect("a scene"))
}

fn half_plane(nu: f64, datum: f64) -> String {
    format!(
        "layer = {{ poisson = {nu:?}, base = {{ type = \"infinite\" }}, datum = {datum:?}, \
         grading = {{ type = \"homogeneous\", modulus = 1.0 }} }}\n"
    )
}

/// `2 s/pi [b asinh(d/b) + beta d asinh(b/d)]` under a wedge of slope `s` on a half-plane: flat punches in closed form,
/// stacked at the rate `dP/db = 2 s/A0`.
fn depth_of_wedge(nu: f64, datum: f64, b: f64) -> f64 {
    let beta = (1.0 - 2.0 * nu) / (2.0 - 2.0 * nu);
    0.2 / std::f64::consts::PI * (b * (datum / b).asinh() + beta * datum * (b / datum).asinh())
}

/// However shallow the datum, and to the tolerance: it varies with the half-width as nothing else of the half-plane does.
#[test]
fn a_wedge_over_a_shallow_datum_sinks_as_the_closed_form_says() {
    for (nu, datum, tolerance) in
        [(0.3, 0.22, 1e-8), (0.3, 0.15, 1e-6), (0.0, 0.02, 1e-4), (0.45, 1e-3, 1e-8), (0.3, 30.0, 1e-10)]
    {
        let text = half_plane(nu, datum)
            + &format!(
                "punch = {{ type = \"wedge\", slope = 0.1 }}\nload = {{ half_width = 1.0 }}\nsolver = {{ tolerance = {tolerance:?} }}\n"
            );
        let solution = solved(&text);
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        let (depth, exact) = (solution.load.indentation.expect("a datum"), depth_of_wedge(nu, datum, 1.0));
        let error = (depth / exact - 1.0).abs();
        println!("nu {nu} datum {datum}: {error:.1e} at {tolerance:.0e}");
        assert!(error < 0.1 * f64::min(tolerance, 1e-6), "{depth} for {exact} at {datum}");
    }
}

/// Deep below a wedge that is wider than the datum is deep, what sinks grows like a logarithm.
#[test]
fn a_wedge_is_pressed_in_however_wide_it_gets() {
    for b in [0.3, 3.0, 900.0] {
        let depth = depth_of_wedge(0.3, 1.0, b);
        let text = half_plane(0.3, 1.0)
            + &format!("punch = {{ type = \"wedge\", slope = 0.1 }}\nload = {{ indentation = {depth:?} }}\n");
        let solution = solved(&text);
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        let found = solution.load.half_width.expect("a contact");
        assert!((found / b - 1.0).abs() < 1e-8, "{found} for {b}");
    }
}

/// Above a base that gives way what sinks grows, shrinks and grows again. The load grew from nothing: it is the first.
#[test]
fn the_first_contact_that_sinks_so_far_is_met() {
    let cylinder = "layer = { thickness = 1.0, poisson = 0.3, base = { type = \"half-plane\", shear = 0.3, poisson = 0.3 }, \
        datum = 0.1, grading = { type = \"homogeneous\", modulus = 1.0 } }\n\
        punch = { type = \"cylinder\", radius = 10.0 }\n";
    let power = "layer = { thickness = 0.85, poisson = 0.1, grading = { type = \"linear\", surface = 1.56, base = 0.725 }, \
        base = { type = \"half-plane\", young = 0.124, poisson = 0.5 }, datum = 0.745 }\n\
        punch = { type = \"power\", coefficient = 0.1, exponent = 1.378 }\n";
    for (layer, widths) in [(cylinder, [0.3, 0.43, 0.65]), (power, [0.5, 0.6, 0.66])] {
        let depths = widths.map(|b| {
            let solution = solved(&format!("{layer}load = {{ half_width = {b:?} }}\n"));
            solution.load.indentation.expect("a datum")
        });
        assert!(depths.is_sorted(), "on the first rise: {depths:?}");
        for (depth, b) in depths.iter().zip(widths) {
            let solution = solved(&format!("{layer}load = {{ indentation = {depth:?} }}\n"));
            assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
            let found = solution.load.half_width.expect("a contact");
            assert!((found / b - 1.0).abs() < 1e-6, "{found} for {b}");
        }
        // Whatever comes after it on a path.
        for last in [depths[2], 1.2 * depths[2]] {
            let [one, two, _] = depths;
            let text = format!("{layer}load = {{ path = {{ indentation = [{one:?}, {two:?}, {last:?}] }} }}\n");
            let path = solved(&text).path.expect("a path");
            let found = path.half_width[1].expect("a contact");
            assert!((found / widths[1] - 1.0).abs() < 1e-6, "{found} for {} before {last}", widths[1]);
        }
    }
}

/// Close to the greatest depth the contact is met, though one not much wider has risen above its datum.
#[test]
fn close_to_the_greatest_depth_the_contact_is_met() {
    let layer = "layer = { thickness = 2.93, poisson = 0.3, datum = 0.468, base = { type = \"half-plane\", shear = 0.109, poisson = 0.3 }, \
        grading = { type = \"homogeneous\", modulus = 1.0 } }\npunch = { type = \"power\", coefficient = 0.05, exponent = 8.0 }\n";
    let depth =
        |b: f64| solved(&format!("{layer}load = {{ half_width = {b:?} }}\n")).load.indentation.expect("a datum");
    let depths = [0.85, 0.9, 0.93].map(depth);
    assert!(depths.is_sorted() && depth(1.2) < 0.0, "{depths:?}");
    for (b, depth) in [0.85, 0.9, 0.93].into_iter().zip(depths) {
        let solution = solved(&format!("{layer}load = {{ indentation = {depth:?} }}\n"));
        assert_eq!(solution.status, Status::Converged, "{:?}", solution.reason);
        assert!((solution.load.half_width.expect("a contact") / b - 1.0).abs() < 1e-5, "{:?} for {b}", solution.load);
    }
}
