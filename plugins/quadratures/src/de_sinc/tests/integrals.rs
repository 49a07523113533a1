//! The operator's rows applied to densities whose integrals are known.

use super::*;
use crate::fixtures::{apply, jump, logarithm};
use std::f64::consts::PI;

/// Steps at which only rounding is left for polynomials of low degree over the root.
const FINE: usize = 56;

#[test]
fn cauchy_integrals_of_chebyshev_polynomials() {
    // (1/pi) PV int T_k/sqrt(1 - t^2) dt/(x - t) = -U_{k-1}(x); of U_k sqrt(1 - t^2), T_{k+1}(x).
    for (parity, edge, k) in [
        (Parity::Even, Edge::Sharp, 4),
        (Parity::Odd, Edge::Sharp, 5),
        (Parity::Even, Edge::Smooth, 4),
        (Parity::Odd, Edge::Smooth, 5),
        (Parity::Odd, Edge::Continued, 3),
    ] {
        let mut rule = rule(2.5, parity, edge, FINE);
        let order = f64::from(k);
        let density = |(x, s): (f64, f64)| match edge {
            Edge::Sharp => (order * x.acos()).cos(),
            Edge::Smooth | Edge::Continued => ((order + 1.0) * s.atan2(x)).sin() * s,
        };
        let unknowns: Vec<f64> = nodes(parity, edge, FINE).into_iter().map(density).collect();
        let got = apply(&operator(rule.as_mut(), None), &unknowns);
        let scale = rule.row_scale().expect("rows are scaled");
        for ((got, at), scale) in got.iter().zip(rule.collocation()).zip(scale) {
            let angle = (at.gap * (5.0 - at.gap)).sqrt().atan2(at.x);
            let exact = match edge {
                Edge::Sharp => -(order * angle).sin() / angle.sin(),
                Edge::Smooth | Edge::Continued => ((order + 1.0) * angle).cos(),
            };
            // Some fifty terms of order 10, row by row.
            assert_close(*got, scale * exact, 3e-13, &format!("{parity:?} {edge:?} at gap {:e}", at.gap));
        }
    }
}

#[test]
fn jump_and_logarithm_are_integrated_exactly() {
    // With F = T_k: int sign(x - r) f dr = -2 c sin(k a)/k, int log|x - r| f dr = -pi c cos(k a)/k, cos a = x/c.
    let c = 2.5;
    // Said to be short, they are summed on a finer grid.
    let (long_jump, short_jump, long_log, short_log) = (jump(10.0), jump(0.8), logarithm(10.0), logarithm(0.8));
    for (parity, k) in [(Parity::Even, 4.0), (Parity::Odd, 5.0)] {
        let unknowns: Vec<f64> = nodes(parity, Edge::Sharp, FINE).iter().map(|(x, _)| (k * x.acos()).cos()).collect();
        let mut rule = rule(c, parity, Edge::Sharp, FINE);
        let cauchy = apply(&operator(rule.as_mut(), None), &unknowns);
        let kernels: [(&dyn KernelTable, bool); 4] =
            [(&long_jump, true), (&short_jump, true), (&long_log, false), (&short_log, false)];
        for (kernel, jumps) in kernels {
            let got = apply(&operator(rule.as_mut(), Some((kernel, Component::NormalSlope))), &unknowns);
            for (i, at) in rule.collocation().iter().enumerate() {
                let angle = (at.gap * (2.0 * c - at.gap)).sqrt().atan2(at.x);
                let exact = if jumps { -2.0 * c * (k * angle).sin() / k } else { -PI * c * (k * angle).cos() / k };
                let scale = rule.row_scale().expect("rows are scaled")[i];
                assert_close(
                    got[i] - cauchy[i],
                    scale * exact / PI,
                    1e-12,
                    &format!("{parity:?} jump: {jumps} at {at:?}"),
                );
            }
        }
    }
}

/// A grid that ends soon misses what the density differs by from what it is at the end: of the order of the last gap,
/// where the root of that weighs beyond it.
#[test]
fn a_density_goes_on_beyond_the_last_node() {
    let (c, n, u_max) = (2.5, 32, 2.2);
    let (long_jump, short_jump, long_log, short_log) = (jump(10.0), jump(0.8), logarithm(10.0), logarithm(0.8));
    let kernels: [(&dyn KernelTable, bool); 4] =
        [(&long_jump, true), (&short_jump, true), (&long_log, false), (&short_log, false)];
    for (parity, k) in [(Parity::Even, 2.0), (Parity::Odd, 3.0)] {
        let grid = resolution::grid(Resolution { n, u_max }, parity == Parity::Odd, Edge::Sharp);
        let unknowns: Vec<f64> = grid.nodes[grid.first..].iter().map(|u| (k * u.x.acos()).cos()).collect();
        let least = grid.nodes[n].gap;
        assert!(least < 1e-5, "the root of the gap is far larger");
        let quadrature = DeSinc { n: Some(Count(n)), u_max: Some(Reach(u_max)), ..DeSinc::default() };
        let mut rule = quadrature.rule(&Span::symmetric(c, parity, Edge::Sharp)).expect("a symmetric span");
        let cauchy = apply(&operator(rule.as_mut(), None), &unknowns);
        let inside: Vec<(usize, f64)> =
            rule.collocation().iter().map(|at| at.x / c).take_while(|x| *x < 0.9).enumerate().collect();
        for (i, x) in inside.iter().copied() {
            let exact = -(k * x.acos()).sin() / x.acos().sin();
            let got = cauchy[i] / rule.row_scale().expect("rows are scaled")[i];
            assert_close(got, exact, 30.0 * least, &format!("{parity:?} Cauchy at {x}"));
        }
        for (kernel, jumps) in kernels {
            let rows = operator(rule.as_mut(), Some((kernel, Component::NormalSlope)));
            let got = apply(&rows, &unknowns);
            for (i, x) in inside.iter().copied() {
                let angle = x.acos();
                let exact = if jumps { -2.0 * c * (k * angle).sin() / k } else { -PI * c * (k * angle).cos() / k };
                let got = PI * (got[i] - cauchy[i]) / rule.row_scale().expect("rows are scaled")[i];
                assert_close(got, exact, 0.1 * c * least, &format!("{parity:?} jump: {jumps} at {x}"));
            }
        }
    }
}

#[test]
fn a_rule_stretched_is_a_fresh_rule() {
    let kernel = graded(0.2);
    for (parity, edge) in [(Parity::Even, Edge::Smooth), (Parity::Odd, Edge::Continued)] {
        let mut stretched = rule(0.3, parity, edge, 16);
        operator(stretched.as_mut(), Some((&kernel, Component::NormalSlope)));
        stretched.stretch(1.7);
        let mut fresh = rule(1.7, parity, edge, 16);
        assert_eq!(stretched.collocation(), fresh.collocation());
        let rows = |r: &mut dyn Rule| operator(r, Some((&kernel, Component::NormalSlope)));
        assert!(rows(stretched.as_mut()) == rows(fresh.as_mut()), "bit for bit");
    }
}

#[test]
fn potentials_of_jump_and_logarithm_anywhere() {
    let c = 0.5;
    let targets = [-c, -0.31, 0.0, 0.123, 0.499, c].map(|x: f64| Station { x, gap: c - x.abs() });
    // Sharp, F = 1: int log|x - r| f dr = pi c ln(c/2), int sign(x - r) f dr = 2 c asin(x/c). Smooth, f = s:
    // int log|x - r| f dr = (pi/2) c (ln(c/2) + t^2 - 1/2), int sign(x - r) f dr = c (t s + asin t).
    for length in [5.0, 0.2] {
        let (jump, logarithm) = (jump(length), logarithm(length));
        for edge in [Edge::Sharp, Edge::Smooth] {
            let mut rule = rule(c, Parity::Even, edge, FINE);
            let unknowns: Vec<f64> = nodes(Parity::Even, edge, FINE)
                .iter()
                .map(|(_, s)| if edge == Edge::Sharp { 1.0 } else { s * s })
                .collect();
            let mut potential = |kernel: (&dyn KernelTable, Component)| {
                let (mut samples, mut out) = (Vec::new(), [0.0; 6]);
                rule.sample_potential(&unknowns, kernel, &mut samples);
                rule.potential_into(&samples, kernel, &targets, &mut out);
                out
            };
            let by_log = potential((&logarithm, Component::Coupling));
            let by_jump = potential((&jump, Component::NormalSlope));
            for ((at, by_log), by_jump) in targets.iter().zip(by_log).zip(by_jump) {
                let t = at.x / c;
                let (log, sign) = if edge == Edge::Sharp {
                    (c * (0.5 * c).ln(), 2.0 * c * t.asin() / PI)
                } else {
                    let inside = t * (1.0 - t * t).sqrt() + t.asin();
                    (0.5 * c * ((0.5 * c).ln() + t * t - 0.5), c * inside / PI)
                };
                assert_close(by_log, log, 1e-12, "logarithm");
                // It goes with the root of the gap, which is cut where the grid ends.
                assert_close(by_jump, sign, 5e-12, "jump");
            }
            // |t| = sign(t) t: in the middle c^2/pi times 2 (sharp) or 2/3 (smooth); log|t| as above.
            let distance = Made { parts: |t| Parts { sign: t, ..Parts::default() }, length };
            let middle = rule.potential_at_centre(&unknowns, (&distance, Component::Depth));
            let factor = if edge == Edge::Sharp { 2.0 } else { 2.0 / 3.0 };
            assert_close(middle, factor * c * c / PI, 1e-12, "distance from the middle");
            let middle = rule.potential_at_centre(&unknowns, (&logarithm, Component::Depth));
            let constant = if edge == Edge::Sharp { 0.0 } else { -0.5 };
            let factor = if edge == Edge::Sharp { c } else { 0.5 * c };
            assert_close(middle, factor * ((0.5 * c).ln() + constant), 1e-12, "logarithm from the middle");
        }
    }
}
