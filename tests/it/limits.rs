//! Limits and identities: half-plane, vanishing gradient, units, energy release.

use crate::sketch::Sketch;
use slipzone::api::reference::{cylinder, flat_punch, partial_slip};
use slipzone::engine::Solution;

/// `log2` of the ratio of successive deviations under doubling.
fn orders(deviations: &[f64]) -> Vec<f64> {
    deviations.windows(2).map(|d| (d[0] / d[1]).abs().log2()).collect()
}

fn edge(solution: &Solution) -> f64 {
    solution.edge.ratio.expect("a number")
}

fn stick(solution: &Solution) -> f64 {
    solution.stick.as_ref().expect("friction").ratio.expect("a number")
}

const THICK: [f64; 6] = [20.0, 40.0, 80.0, 160.0, 320.0, 640.0];
/// `A0 mu1` at nu = 0.3, plane strain.
const A0: f64 = 0.7;
const BETA: f64 = 2.0 / 7.0;

fn deviations(of: impl Fn(f64) -> f64, limit: f64) -> Vec<f64> {
    let all: Vec<f64> = THICK.iter().map(|&h| of(h) - limit).collect();
    println!("{:?} orders {:?}", all, orders(&all));
    all
}

fn assert_order(deviations: &[f64], expected: f64, slack: f64) {
    for order in orders(deviations) {
        assert!((order - expected).abs() < slack, "order {order:.3} instead of {expected}: {deviations:?}");
    }
}

#[test]
fn a_thick_homogeneous_layer_is_a_half_plane_to_second_order() {
    let flat = deviations(|h| edge(&Sketch::flat(h, 1.0, 0.3).solve()), flat_punch::EDGE_RATIO);
    assert_order(&flat, 2.0, 0.05);
    let round = cylinder::Cylinder { radius: 1.0, half_width: 1.0, compliance: A0 };
    let force = |h: f64| Sketch::flat(h, 1.0, 0.3).cylinder().solve().load.force.expect("a number");
    assert_order(&deviations(force, round.force()), 2.0, 0.05);
    let very_thick = edge(&Sketch::flat(1e4, 1.0, 0.3).solve());
    // flat[0] is the deviation at h = 20: it falls by (20/1e4)^2.
    assert!((very_thick - flat_punch::EDGE_RATIO).abs() < 1.1 * flat[0].abs() * 4e-6 + 1e-13);
}

#[test]
fn its_stick_zone_tends_to_the_half_planes_to_first_order() {
    let limit = partial_slip::stick(0.3, BETA).ratio;
    let thick = deviations(|h| stick(&Sketch::flat(h, 1.0, 0.3).rubbing(0.3).solve()), limit);
    assert_order(&thick, 1.0, 0.2);
}

#[test]
fn a_thick_graded_layer_tends_to_the_half_plane_to_first_order() {
    for ratio in [0.125, 8.0] {
        let flat = deviations(|h| edge(&Sketch::flat(h, ratio, 0.3).solve()), flat_punch::EDGE_RATIO);
        assert_order(&flat[2..], 1.0, 0.2);
    }
}

#[test]
fn a_vanishing_gradient_joins_the_homogeneous_layer_from_both_sides() {
    let published =
        "quadrature = { type = \"gauss-chebyshev\", n = 40 }\nkernel = { type = \"truncated\", cutoff = 80.0 }";
    let own = "quadrature = { type = \"de-sinc\", n = 45 }";
    for methods in [published, own] {
        let fixed = format!("[solver]\ntolerance = 1e-10\n{methods}");
        let at = |excess: f64| {
            let solution = Sketch::flat(5.0, 1.0 / (1.0 + excess), 0.3).rubbing(0.3).with(&fixed).solve();
            [edge(&solution), solution.load.indentation.expect("a number"), stick(&solution)]
        };
        let homogeneous = at(0.0);
        for excess in [1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
            let (above, below) = (at(excess), at(-excess));
            for ((above, below), middle) in above.iter().zip(below).zip(homogeneous) {
                // Derivatives with respect to ln(mu3/mu1) are of order one, second ones too; 1e-12 is rounding
                // of the dense systems, and of the root of the stick zone.
                assert!((above - middle).abs() < excess + 1e-12, "{methods}, {excess}: {above} against {middle}");
                let bend = (above + below - 2.0 * middle).abs();
                assert!(bend < excess * excess + 2e-12, "{methods}, {excess}: a kink at gamma = 0");
            }
        }
    }
}

/// Rate of change of `of(b)` with the half-width at `b = 1`, on the layer of thickness 5.
///
/// Two central differences, extrapolated: what is left is `step^4/30` times a fifth derivative of order one, 2e-12
/// here, and the rounding of `of` over the step, 1e-11.
fn rate(of: impl Fn(f64) -> f64) -> f64 {
    let step = 3e-3;
    let central = |step: f64| (of(1.0 + step) - of(1.0 - step)) / (2.0 * step);
    (4.0 * central(0.5 * step) - central(step)) / 3.0
}

/// A contact `b` on a layer `h` is a contact 1 on a layer `h/b`.
fn at_width(b: f64, ratio: f64) -> Sketch {
    Sketch::flat(5.0 / b, ratio, 0.3).with("[solver]\ntolerance = 1e-11")
}

#[test]
fn wider_punches_release_energy_through_their_edges() {
    // dD/db = -pi A0 f^2: the indentation knows nothing of how the edge factor was computed.
    for ratio in [0.125, 1.0, 8.0] {
        let rate = rate(|b| at_width(b, ratio).solve().load.indentation.expect("a number"));
        let f = edge(&at_width(1.0, ratio).solve());
        let released = -std::f64::consts::PI * A0 * f * f;
        assert!((rate / released - 1.0).abs() < 1e-9, "mu1/mu3 = {ratio}: {rate} against {released}");
    }
}

#[test]
fn a_cylinder_stiffens_like_the_flat_punch_of_its_width() {
    // ddelta/dP = D(b). Force and depth of radius 1 at half-width b are b^2 times those at half-width 1.
    for ratio in [0.125, 1.0, 8.0] {
        let scaled = |of: fn(&Solution) -> Option<f64>| {
            move |b: f64| b * b * of(&at_width(b, ratio).cylinder().solve()).expect("a number")
        };
        let (depth, force) = (rate(scaled(|s| s.load.indentation)), rate(scaled(|s| s.load.force)));
        let flat = at_width(1.0, ratio).solve().load.indentation.expect("a number");
        assert!((depth / force / flat - 1.0).abs() < 1e-9, "mu1/mu3 = {ratio}: {} against {flat}", depth / force);
    }
}

#[test]
fn force_half_width_and_indentation_say_the_same() {
    for ratio in [1.0, 8.0] {
        let sketch = Sketch::flat(5.0, ratio, 0.3).cylinder();
        let by_width = sketch.solve();
        let (force, depth) = (by_width.load.force.expect("a number"), by_width.load.indentation.expect("a number"));
        for load in [format!("force = {force:?}"), format!("indentation = {depth:?}")] {
            let other = sketch.clone().loaded(&load).solve();
            let width = other.load.half_width.expect("a number");
            let estimate = other.error.each["load.half_width"] + by_width.error.each["load.force"];
            assert!(
                (width - 1.0).abs() < 3.0 * estimate + 1e-12,
                "{load}: half-width {width}, estimate {estimate:.1e}"
            );
        }
        let flat = Sketch::flat(5.0, ratio, 0.3);
        let by_force = flat.solve();
        let depth = by_force.load.indentation.expect("a number");
        let by_depth = flat.loaded(&format!("indentation = {depth:?}")).solve();
        let force = by_depth.load.force.expect("a number");
        let estimate = by_force.error.each["load.indentation"] + by_depth.error.each["load.force"];
        assert!((force - 1.0).abs() < estimate, "force {force} for 1, estimate {estimate:.1e}");
    }
}

#[test]
fn units_change_nothing_but_units() {
    let scene = |length: f64, stress: f64| {
        let text = format!(
            "format = 1\n[layer]\nthickness = {:?}\npoisson = 0.3\n\
             grading = {{ type = \"exponential\", surface = {:?}, base = {:?} }}\n\
             [punch]\ntype = \"flat\"\nhalf_width = {:?}\n\
             [friction]\ntype = \"goodman\"\ncoefficient = 0.3\n[load]\nforce = {:?}\n",
            5.0 * length,
            stress,
            8.0 * stress,
            length,
            stress * length
        );
        slipzone::engine::solve(&slipzone::scene::parse("units.toml", &text).expect("a good scene"))
    };
    slipzone::link_plugins();
    let plain = scene(1.0, 1.0);
    for (length, stress) in [(1e-6, 1e9), (25.4, 6895.0), (1e40, 1e-40)] {
        let scaled = scene(length, stress);
        let close = |got: Option<f64>, expected: Option<f64>, unit: f64| {
            let (got, expected) = (got.expect("a number"), expected.expect("a number") * unit);
            // Rounding of the scaled inputs, amplified by at most a few orders in the root of the stick zone.
            assert!((got / expected - 1.0).abs() < 1e-11, "{got} against {expected} at {length:e}, {stress:e}");
        };
        close(scaled.load.indentation, plain.load.indentation, length);
        close(scaled.edge.stress_intensity, plain.edge.stress_intensity, stress * length.sqrt());
        close(scaled.pressure.centre, plain.pressure.centre, stress);
        close(Some(stick(&scaled)), Some(stick(&plain)), 1.0);
    }
}

/// Linear elasticity answers any load; where its strains are not small the result says so.
#[test]
fn strains_that_are_not_small_are_named() {
    let said = |punch: &str, load: &str| {
        let text = format!(
            "format = 1\nlayer = {{ thickness = 2.0, poisson = 0.3, grading = {{ type = \"exponential\", surface = 1.0, base = 8.0 }} }}\n\
             punch = {{ {punch} }}\nload = {{ {load} }}\nsolver = {{ tolerance = 1e-4 }}\n"
        );
        let solution = slipzone::engine::solve(&slipzone::scene::parse("large.toml", &text).unwrap());
        solution.assumptions.into_iter().find(|what| what.contains("strains are not small"))
    };
    let (flat, cylinder) = ("type = \"flat\", half_width = 1.0", "type = \"cylinder\", radius = 1.0");
    assert_eq!(said(flat, "indentation = 0.19"), None);
    assert!(said(flat, "indentation = 0.24").unwrap().starts_with("the punch sinks in by 0.12 of the thickness"));
    assert_eq!(said(cylinder, "half_width = 0.29"), None);
    assert!(
        said(cylinder, "half_width = 0.4").unwrap().starts_with("the punch has a slope of 0.40 at the contact's edge")
    );
}
