//! Densities between and beyond the nodes.

use super::*;
use std::f64::consts::PI;

#[test]
fn nothing_is_lost_beyond_the_last_node() {
    // At six steps the grid ends at u = 2.3, and 4e-4 of the flat punch's force lie beyond.
    for length in [10.0, 1.0] {
        let constant = Made { parts: |_| Parts { smooth: 1.0, ..Parts::default() }, length };
        let mut rule = rule(2.0, Parity::Even, Edge::Sharp, 6);
        let (mut samples, mut out) = (Vec::new(), [0.0; 2]);
        rule.sample_potential(&[1.0; 7], (&constant, Component::Coupling), &mut samples);
        let at = [Station { x: 0.3, gap: 1.7 }, Station { x: 2.0, gap: 0.0 }];
        rule.potential_into(&samples, (&constant, Component::Coupling), &at, &mut out);
        for got in out {
            assert_close(got, 2.0, 2e-5, "(1/pi) int f dr, half the force's 1e-5 by interpolation of P");
        }
    }
}

#[test]
fn values_between_the_nodes() {
    let (c, n) = (2.0, 48);
    let polynomial = |t: f64| 1.0 - 3.0 * t * t + 0.5 * t.powi(8);
    for (parity, edge, power) in [
        (Parity::Even, Edge::Sharp, -1),
        (Parity::Even, Edge::Smooth, 1),
        (Parity::Odd, Edge::Sharp, -1),
        (Parity::Odd, Edge::Smooth, 1),
    ] {
        let odd = |t: f64| if parity == Parity::Odd { t } else { 1.0 };
        let rule = rule(c, parity, edge, n);
        let at_nodes = nodes(parity, edge, n);
        let unknowns: Vec<f64> = at_nodes.iter().map(|(x, s)| odd(*x) * polynomial(*x) * s.powi(power + 1)).collect();
        for t in [-0.999, -0.4, 0.0, at_nodes[3].0, 0.77, 0.999_999] {
            let gap = c * (1.0 - t.abs());
            let s = (gap * (2.0 * c - gap)).sqrt() / c;
            let exact = odd(t) * polynomial(t) * s.powi(power);
            // At u_max = 4 the strip in which t^8 stays moderate leaves 1e-11 at 48 steps.
            assert_close(
                value(rule.as_ref(), &unknowns, c * t, gap) / s.powi(power),
                exact / s.powi(power),
                1e-10,
                &format!("{parity:?} {edge:?} t = {t}"),
            );
        }
    }
}

/// Told from the values at the nodes alone, how far those between are off: at most by three times that, and by a tenth
/// of it at least.
#[test]
fn what_is_lost_between_the_nodes_is_told() {
    let c = 2.0;
    for (parity, edge, power) in [
        (Parity::Even, Edge::Sharp, -1),
        (Parity::Even, Edge::Smooth, 1),
        (Parity::Odd, Edge::Sharp, -1),
        (Parity::Odd, Edge::Continued, 1),
    ] {
        // Poles across from the middle and from near the ends, as thin layers have them.
        for (real, imaginary) in [(0.1, 0.3), (0.5, 0.2), (0.9, 0.3)] {
            for n in [24, 33, 48] {
                let pole = |t: f64| 1.0 / ((t - real).powi(2) + imaginary * imaginary);
                let told = |t: f64| if parity == Parity::Odd { pole(t) - pole(-t) } else { pole(t) + pole(-t) };
                let rule = rule(c, parity, edge, n);
                let density = nodes(parity, edge, n).into_iter().map(|(x, s)| told(x) * s.powi(power + 1));
                let unknowns: Vec<f64> = density.collect();
                let off = |i: u32| {
                    let t = f64::from(i) / 400.0;
                    let gap = c * (1.0 - t);
                    let s = (gap * (2.0 * c - gap)).sqrt() / c;
                    let scale = if edge == Edge::Sharp { s } else { 1.0 };
                    scale * (value(rule.as_ref(), &unknowns, c * t, gap) - told(t) * s.powi(power)).abs()
                };
                let off = (0..400).map(off).fold(0.0, f64::max);
                let lost = rule.lost_between(&unknowns, c).expect("told");
                let case = format!("{parity:?} {edge:?}, poles at {real} + {imaginary} i, {n} steps");
                assert!(off <= 3.0 * lost && lost <= 10.0 * off, "{off:.1e} off, {lost:.1e} told: {case}");
            }
        }
        let rule = rule(c, parity, edge, 12);
        assert_eq!(rule.lost_between(&vec![0.0; rule.unknowns()], 0.0), Some(0.0), "of nothing nothing is lost");
    }
}

/// The same of potentials, known at the staggered points alone, whose own features a density does not tell.
#[test]
fn what_potentials_lose_between_their_samples_is_told() {
    let c = 2.0;
    let peak = |d: f64, t: f64| d / (d * d + t * t);
    let kernel =
        |component: Component, d: f64, t: f64| if component.is_odd() { t / d * peak(d, t) } else { peak(d, t) };
    for d in [0.3, 0.5] {
        let told = |component: Component| move |t: f64| Parts { smooth: kernel(component, d, t), ..Parts::default() };
        for (parity, edge, n) in
            [(Parity::Even, Edge::Sharp, 16), (Parity::Even, Edge::Smooth, 24), (Parity::Odd, Edge::Continued, 24)]
        {
            for component in [Component::Coupling, Component::NormalSlope] {
                let table = Made { parts: told(component), length: d };
                let potential = |n: usize, at: &[Station]| {
                    let mut rule = rule(c, parity, edge, n);
                    let power = if edge == Edge::Sharp { 0 } else { 2 };
                    let odd = |x: f64| if parity == Parity::Odd { x } else { 1.0 };
                    let density = nodes(parity, edge, n).into_iter().map(|(x, s)| odd(x) * s.powi(power));
                    let unknowns: Vec<f64> = density.collect();
                    let (mut samples, mut out) = (Vec::new(), vec![0.0; at.len()]);
                    rule.sample_potential(&unknowns, (&table, component), &mut samples);
                    rule.potential_into(&samples, (&table, component), at, &mut out);
                    (out, rule.lost_between_samples(&samples, component).expect("told"))
                };
                let gaps = (1..400).map(|i| c * f64::from(i) / 400.0);
                let at: Vec<Station> = gaps.map(|gap| Station { x: c - gap, gap }).collect();
                let ((found, lost), (exact, _)) = (potential(n, &at), potential(120, &at));
                let off = found.iter().zip(&exact).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max);
                let case = format!("{parity:?} {edge:?} {component:?}, peaks of {d}, {n} steps");
                assert!(off <= 3.0 * lost && lost <= 10.0 * off, "{off:.1e} off, {lost:.1e} told: {case}");
            }
        }
    }
}

#[test]
fn a_continued_density_is_a_root_and_more() {
    // f = t (1 - t^2)^(1/2) (1 + (1 - t^2)^(1/2)/2): both parts of what is left in a stick zone.
    let (c, n) = (2.0, 45);
    let rule = rule(c, Parity::Odd, Edge::Continued, n);
    let unknowns: Vec<f64> =
        nodes(Parity::Odd, Edge::Continued, n).iter().map(|(x, s)| s * s * x * (1.0 + 0.5 * s)).collect();
    for gap in [2.0, 1.1, 0.3, 1e-4, 1e-9, 1e-14, 0.0] {
        let t = 1.0 - gap / c;
        let root = (gap * (2.0 * c - gap)).sqrt() / c;
        let exact = t * root * (1.0 + 0.5 * root);
        assert_close(rule.value(&unknowns, Station { x: c * t, gap }), exact, 1e-11, "upper half");
        assert_close(rule.value(&unknowns, Station { x: -c * t, gap }), -exact, 1e-11, "lower half");
    }
}

#[test]
fn the_edge_functional_is_the_limit() {
    // F = T_k: 1 at the upper end; f = U_k s: no singular part.
    for (parity, k) in [(Parity::Even, 4.0), (Parity::Odd, 3.0)] {
        let n = 56;
        let sharp = rule(0.5, parity, Edge::Sharp, n);
        let unknowns: Vec<f64> = nodes(parity, Edge::Sharp, n).iter().map(|(x, _)| (k * x.acos()).cos()).collect();
        assert_close(sharp.edge_factor(&unknowns), 0.5, 1e-13, "T_k");
        let smooth = rule(0.5, parity, Edge::Smooth, n);
        let unknowns: Vec<f64> =
            nodes(parity, Edge::Smooth, n).iter().map(|(x, s)| ((k + 1.0) * s.atan2(*x)).sin() * s).collect();
        assert_close(dot(smooth.edge_condition().expect("a condition"), &unknowns), 0.0, 1e-13, "U_k s");
        assert_close(smooth.edge_factor(&unknowns), 0.0, 0.0, "not singular");
    }
}

#[test]
fn resultants() {
    let c = 1.5;
    // int_-c^c 1/sqrt(1 - t^2) dx = pi c, int sqrt(1 - t^2) dx = pi c/2.
    for (edge, exact) in [(Edge::Sharp, PI * c), (Edge::Smooth, 0.5 * PI * c)] {
        let rule = rule(c, Parity::Even, edge, 40);
        let mut row = vec![0.0; rule.unknowns()];
        rule.resultant_into(&mut row);
        let unknowns =
            nodes(Parity::Even, edge, 40).into_iter().map(|(_, s)| if edge == Edge::Sharp { 1.0 } else { s * s });
        assert_close(dot(&row, &unknowns.collect::<Vec<_>>()), exact, 1e-13, "resultant");
    }
}
