//! What holds for every closed form, at random sizes.

use crate::{Coefficients, Cylinder, Exponent, Polynomial, Power, RoundedFlat, RoundedWedge, Wedge};
use proptest::prelude::*;
use slipzone_api::{Positive, PunchProfile, PunchShape, double_exponential};

#[test]
fn plugins_conform() {
    super::link();
    slipzone_api::testkit::check_crate(env!("CARGO_PKG_NAME"));
}

fn positive(value: f64) -> Positive {
    Positive::new(value).unwrap()
}

fn shape(punch: &dyn PunchProfile) -> Box<dyn PunchShape> {
    punch.shape().unwrap_or_else(|refusal| panic!("{refusal}"))
}

/// Load on a half-plane with `A0 = 1`: `P = int x g'(x)/sqrt(b^2 - x^2) dx`, split at the kinks.
fn load(shape: &dyn PunchShape, b: f64) -> f64 {
    let mut edges = vec![0.0];
    edges.extend(shape.kinks().iter().filter(|&&kink| kink > 0.0 && kink < b));
    edges.push(b);
    let panel = |ends: &[f64]| -> f64 {
        let nodes = double_exponential::nodes(ends[1] - ends[0], 48);
        let node = |node: &double_exponential::Node| {
            let x = ends[0] + node.from_lower;
            let to_edge = (b - ends[1]) + node.to_upper;
            node.weight * x * shape.slope(x) / ((b + x) * to_edge).sqrt()
        };
        nodes.iter().map(node).sum()
    };
    2.0 * edges.windows(2).map(panel).sum::<f64>()
}

proptest! {
    #[test]
    fn slopes_are_derivatives(a in 0.1..10.0_f64, c in 0.1..10.0_f64, m in 1.0..12.0_f64, x in 0.01..5.0_f64) {
        let shapes = [
            shape(&Cylinder { radius: positive(a) }),
            shape(&Wedge { slope: positive(a) }),
            shape(&Power { coefficient: positive(a), exponent: Exponent::new(m).unwrap() }),
            shape(&RoundedFlat { half_width: positive(a), radius: positive(c) }),
            shape(&RoundedWedge { slope: positive(a), radius: positive(c) }),
            shape(&Polynomial { coefficients: Coefficients::try_from(vec![a, c, -0.5]).unwrap() }),
        ];
        for shape in shapes {
            let step = 1e-5 * x;
            prop_assume!(shape.kinks().iter().all(|kink| (kink - x).abs() > step));
            let difference = (shape.height(x + step) - shape.height(x - step)) / (2.0 * step);
            // Third derivatives count with (step/x)^2 m^2 = 1e-8 beside terms that may cancel; rounding of heights with
            // 1e-10.
            let size = shape.slope(x).abs() + shape.height(x).abs() / x + 20.0 * x.powi(5);
            prop_assert!((difference - shape.slope(x)).abs() <= 1e-7 * size, "{:?}: {}", shape, difference);
            prop_assert!((shape.slope(-x) + shape.slope(x)).abs() == 0.0);
            prop_assert!((shape.height(-x) - shape.height(x)).abs() == 0.0);
        }
    }

    /// The loads that the plugins quote, and those of shapes that hold others as special cases.
    #[test]
    fn loads_on_a_half_plane(a in 0.1..10.0_f64, c in 0.1..10.0_f64, b in 0.1..10.0_f64) {
        let pi = std::f64::consts::PI;
        let near = |got: f64, want: f64| (got / want - 1.0).abs() < 1e-12; // some 200 terms of one sign
        let wedge = load(&*shape(&Wedge { slope: positive(a) }), b);
        prop_assert!(near(wedge, 2.0 * b * a));
        let coefficients = Coefficients::try_from(vec![a, c, 0.3]).unwrap();
        let polynomial = pi * (a * b.powi(2) + 1.5 * c * b.powi(4) + 1.875 * 0.3 * b.powi(6));
        let sum = load(&*shape(&Polynomial { coefficients }), b);
        prop_assert!(near(sum, polynomial));
        let power = |m: f64| shape(&Power { coefficient: positive(a), exponent: Exponent::new(m).unwrap() });
        // B(2, 1/2) = 4/3, B(5/2, 1/2) = 3 pi/8.
        prop_assert!(near(load(&*power(3.0), b), 3.0 * a * b.powi(3) * 4.0 / 3.0));
        prop_assert!(near(load(&*power(4.0), b), 4.0 * a * b.powi(4) * 3.0 * pi / 8.0));
        // Rounded flat of face a: (R A0) P = b^2 (arccos u - u sqrt(1 - u^2)), u = a/b (Ciavarella, Hills, Monno).
        let face = 0.9 * b * a / 10.0;
        let u: f64 = face / b;
        let rounded = b * b * (u.acos() - u * (1.0 - u * u).sqrt()) / c;
        let flat = load(&*shape(&RoundedFlat { half_width: positive(face), radius: positive(c) }), b);
        prop_assert!(near(flat, rounded));
        // A rounded wedge is a cylinder up to its flanks, and a wedge far beyond.
        let tip = RoundedWedge { slope: positive(1.1 * b / c), radius: positive(c) };
        let cylinder = load(&*shape(&Cylinder { radius: positive(c) }), b);
        prop_assert!(near(load(&*shape(&tip), b), cylinder));
        let tip = RoundedWedge { slope: positive(a), radius: positive(1e-7 * b / a) };
        prop_assert!(near(load(&*shape(&tip), b), wedge));
    }
}
