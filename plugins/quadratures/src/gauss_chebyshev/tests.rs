//! The rule against integrals in closed form.

use super::*;
use crate::fixtures::{self, Made, apply, assert_close, jump, logarithm, operator};

fn rule(c: f64, parity: Parity, edge: Edge, n: usize) -> Box<dyn Rule> {
    let quadrature = GaussChebyshev { n: Some(EvenCount(n)), level: 0 };
    quadrature.rule(&Span::symmetric(c, parity, edge)).expect("a symmetric span")
}

/// Angles of the positive nodes: of the first kind for sharp edges, of the second for others.
fn angles(edge: Edge, n: usize) -> Vec<f64> {
    let angle = |j: usize| match edge {
        Edge::Sharp => PI * (j as f64 - 0.5) / n as f64,
        Edge::Smooth | Edge::Continued => PI * j as f64 / (n + 1) as f64,
    };
    (1..=n / 2).map(angle).collect()
}

#[test]
fn cauchy_integrals_of_chebyshev_polynomials_are_exact() {
    let (c, n) = (2.5, 24);
    // (1/pi) PV int T_k(t)/((x - t) sqrt(1 - t^2)) dt = -U_{k-1}(x), k = 4 (even) and 5 (odd).
    for (k, parity) in [(4, Parity::Even), (5, Parity::Odd)] {
        let mut rule = rule(c, parity, Edge::Sharp, n);
        let values: Vec<f64> = angles(Edge::Sharp, n).iter().map(|a| (f64::from(k) * a).cos()).collect();
        for (got, at) in apply(&operator(rule.as_mut(), None), &values).iter().zip(rule.collocation()) {
            let alpha = (at.x / c).acos();
            assert_close(*got, -(f64::from(k) * alpha).sin() / alpha.sin(), 1e-12, "T_k");
        }
    }
    // (1/pi) PV int U_k(t) sqrt(1 - t^2)/(x - t) dt = T_{k+1}(x), k = 4 (even) and 5 (odd).
    for (k, parity, edge) in [(4, Parity::Even, Edge::Smooth), (5, Parity::Odd, Edge::Continued)] {
        let mut rule = rule(c, parity, edge, n);
        let values: Vec<f64> = angles(edge, n).iter().map(|a| (f64::from(k + 1) * a).sin() / a.sin()).collect();
        for (got, at) in apply(&operator(rule.as_mut(), None), &values).iter().zip(rule.collocation()) {
            assert_close(*got, (f64::from(k + 1) * (at.x / c).acos()).cos(), 1e-12, "U_k");
        }
    }
}

#[test]
fn values_between_the_nodes_are_those_of_the_polynomial() {
    for (edge, factor) in [(Edge::Sharp, -0.5), (Edge::Smooth, 0.5)] {
        let (c, n) = (2.0, 12);
        let rule = rule(c, Parity::Even, edge, n);
        let polynomial = |t: f64| 1.0 - 3.0 * t * t + 0.5 * t.powi(8);
        let unknowns: Vec<f64> = angles(edge, n).iter().map(|a| polynomial(a.cos())).collect();
        for t in [-0.999, -0.4, 0.0, angles(edge, n)[2].cos(), 0.77] {
            let at = Station { x: c * t, gap: c * (1.0 - t.abs()) };
            let got = rule.value(&unknowns, at);
            assert_close(got, polynomial(t) * (1.0 - t * t).powf(factor), 1e-12, "value");
        }
    }
}

#[test]
fn the_kernel_is_applied_to_what_is_finite_at_the_ends() {
    let mut rule = rule(2.0, Parity::Odd, Edge::Continued, 200);
    fixtures::applies_a_kernel_to_what_is_finite_at_the_ends(rule.as_mut(), 1e-11);
}

#[test]
fn potentials_of_jump_and_logarithm_are_exact_anywhere() {
    let c = 0.5;
    let targets = [-c, -0.31, 0.0, 0.123, 0.499, c];
    // Sharp, F = 1: int log|x - r|/sqrt(c^2 - r^2) dr = pi ln(c/2); int sign = pi - 2 acos(x/c). Smooth,
    // F = 1: int sqrt(1 - t^2) log|x - ct| c dt = c pi/2 (ln(c/2) + t^2 - 1/2).
    let (jump, logarithm) = (jump(1.0), logarithm(1.0));
    for edge in [Edge::Sharp, Edge::Smooth] {
        let mut rule = rule(c, Parity::Even, edge, 10);
        let unknowns = vec![1.0; rule.unknowns()];
        let mut potential = |made: &Made| {
            let (mut samples, mut out) = (Vec::new(), [0.0; 6]);
            let at = targets.map(|x: f64| Station { x, gap: c - x.abs() });
            rule.sample_potential(&unknowns, (made, Component::Coupling), &mut samples);
            rule.potential_into(&samples, (made, Component::Coupling), &at, &mut out);
            out
        };
        for ((x, by_log), by_jump) in targets.iter().zip(potential(&logarithm)).zip(potential(&jump)) {
            let t: f64 = x / c;
            let (log, sign) = if edge == Edge::Sharp {
                (c * (0.5 * c).ln(), c * (1.0 - 2.0 * t.acos() / PI))
            } else {
                let inside = t * (1.0 - t * t).max(0.0).sqrt() + t.asin();
                (0.5 * c * ((0.5 * c).ln() + t * t - 0.5), c * inside / PI)
            };
            assert_close(by_log, log, 1e-13, "logarithm");
            assert_close(by_jump, sign, 1e-13, "jump");
        }
    }
}

#[test]
fn a_kernel_with_a_jump_converges_to_second_order() {
    // The operator sums a jump at staggered points: int_-1^1 sign(x - r)/sqrt(1 - r^2) dr = pi - 2 acos x.
    let jump = jump(1.0);
    let errors: Vec<f64> = [16, 32, 64]
        .iter()
        .map(|&n| {
            let mut rule = rule(1.0, Parity::Even, Edge::Sharp, n);
            let rows = operator(rule.as_mut(), Some((&jump, Component::NormalSlope)));
            let values: Vec<f64> = angles(Edge::Sharp, n).iter().map(|a| a.cos().powi(2)).collect();
            let got = apply(&rows, &values);
            // Density t^2/sqrt(1 - t^2): Cauchy part -U_1/2 = -x, jump part asin x - x sqrt(1 - x^2) over pi.
            let exact = |x: f64| -x + (x.asin() - x * (1.0 - x * x).sqrt()) / PI;
            got.iter().zip(rule.collocation()).map(|(got, s)| (got - exact(s.x)).abs()).fold(0.0, f64::max)
        })
        .collect();
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.2, "order {order:.2}: {errors:?}");
    }
}

#[test]
fn odd_counts_are_not_nodes() {
    for bad in [0, 2, 7, MOST_PINNED + 2] {
        assert!(EvenCount::try_from(bad).is_err(), "{bad}");
    }
}
