//! What `slipzone verify` leaves of limits and identities: the vanishing gradient by the published methods, units,
//! strains.

use crate::sketch::Sketch;
use slipzone::engine::Solution;

fn edge(solution: &Solution) -> f64 {
    solution.edge.ratio.expect("a number")
}

fn stick(solution: &Solution) -> f64 {
    solution.stick.as_ref().expect("friction").ratio.expect("a number")
}

#[test]
fn a_vanishing_gradient_joins_the_homogeneous_layer_from_both_sides() {
    let methods =
        "quadrature = { type = \"gauss-chebyshev\", n = 40 }\nkernel = { type = \"truncated\", cutoff = 80.0 }";
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
            assert!((above - middle).abs() < excess + 1e-12, "{excess}: {above} against {middle}");
            let bend = (above + below - 2.0 * middle).abs();
            assert!(bend < excess * excess + 2e-12, "{excess}: a kink at gamma = 0");
        }
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
    let said_on = |base: &str, punch: &str, load: &str| {
        let text = format!(
            "format = 1\nlayer = {{ {base} poisson = 0.3, grading = {{ type = \"homogeneous\", modulus = 2.0 }} }}\n\
             punch = {{ {punch} }}\nload = {{ {load} }}\nsolver = {{ tolerance = 1e-4 }}\n"
        );
        let solution = slipzone::engine::solve(&slipzone::scene::parse("large.toml", &text).unwrap());
        solution.assumptions.into_iter().find(|what| what.contains("strains are not small"))
    };
    let said = |punch: &str, load: &str| said_on("thickness = 2.0,", punch, load);
    let (flat, cylinder) = ("type = \"flat\", half_width = 1.0", "type = \"cylinder\", radius = 1.0");
    assert_eq!(said(flat, "indentation = 0.19"), None);
    assert!(said(flat, "indentation = 0.24").unwrap().starts_with("the indentation is 0.12 times the thickness"));
    assert_eq!(said(cylinder, "half_width = 0.29"), None);
    assert!(
        said(cylinder, "half_width = 0.4").unwrap().starts_with("the punch has a slope of 0.40 at the contact's edge")
    );
    // Where depths are unknown a force in the wrong unit shows in the pressure.
    let bases = [
        ("base = { type = \"infinite\" },", 2.0),
        ("thickness = 2.0, base = { type = \"half-plane\", shear = 1.0, poisson = 0.3 },", 2.0),
        ("thickness = 2.0, base = { type = \"half-plane\", shear = 5.0, poisson = 0.3 },", 5.0),
    ];
    for (base, shear) in bases {
        assert_eq!(said_on(base, flat, &format!("force = {:?}", 1.9 * shear)), None);
        let found = said_on(base, flat, &format!("force = {:?}", 3.0 * shear)).expect("more than the modulus");
        assert!(found.starts_with("the mean pressure is 1.50 times the shear modulus"), "{base} {found}");
    }
}
