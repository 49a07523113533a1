//! The rule against integrals in closed form, and whole equations against themselves.

mod equations;
mod integrals;
mod values;

use super::*;
use crate::fixtures::{Made, assert_close, operator};
use slipzone_api::testkit::solve;
use slipzone_api::{Component, KernelTable, Parts, Station};
use sums::dot;

/// As over a graded layer of thickness `h`: a smooth part, a jump and a logarithm, poles at `h` and `2 h`.
fn graded(h: f64) -> Made<impl Fn(f64) -> Parts + Send + Sync> {
    let parts = move |t: f64| {
        let z = t / h;
        let (near, far) = (1.0 / (1.0 + z * z), 1.0 / (4.0 + z * z));
        Parts { smooth: -0.6 * z * near / h, sign: 0.8 * far / h, log: 0.6 * z * far / h }
    };
    Made { parts, length: 1.3 * h }
}

fn rule(c: f64, parity: Parity, edge: Edge, n: usize) -> Box<dyn Rule> {
    let quadrature = DeSinc { n: Some(Count(n)), ..DeSinc::default() };
    quadrature.rule(&Span::symmetric(c, parity, edge)).expect("a symmetric span")
}

/// The nodes' `x/c` and `sqrt(1 - (x/c)^2)`, those of the unknowns only.
fn nodes(parity: Parity, edge: Edge, n: usize) -> Vec<(f64, f64)> {
    let odd = parity == Parity::Odd;
    let grid = resolution::grid(Resolution { n, u_max: reach(n, edge) }, odd, edge);
    grid.nodes[grid.first..].iter().map(|u| (u.x, u.sech)).collect()
}

/// The unknowns under a flat punch pressed on by a unit force.
fn flat_punch(rule: &mut dyn Rule, kernel: Option<&dyn KernelTable>) -> Vec<f64> {
    let n = rule.unknowns();
    let mut rows = operator(rule, kernel.map(|k| (k, Component::NormalSlope)));
    rows.resize(n * n, 0.0);
    rule.resultant_into(&mut rows[n * (n - 1)..]);
    let mut right = vec![0.0; n];
    right[n - 1] = 1.0;
    solve(&rows, &right)
}

fn value(rule: &dyn Rule, unknowns: &[f64], x: f64, gap: f64) -> f64 {
    rule.value(unknowns, Station { x, gap })
}

#[test]
fn steps_stay_within_the_contract_and_its_names() {
    for (parity, edge) in [(Parity::Even, Edge::Sharp), (Parity::Odd, Edge::Continued)] {
        for pinned in [None, Some(Count(4)), Some(Count(25))] {
            let unknowns = |level: u32| {
                let quadrature = DeSinc { n: pinned, ..DeSinc::default() }.refined(level);
                quadrature.rule(&Span::symmetric(1.0, parity, edge)).expect("few enough").unknowns() as f64
            };
            for level in 0..11 {
                let growth = unknowns(level + 1) / unknowns(level);
                assert!((1.25..=2.0).contains(&growth), "{level}: {growth}");
            }
        }
    }
    assert_eq!([0, 1, 2, 3, 4, 5, 6, 7, 8].map(ladder), [6, 8, 11, 16, 22, 32, 45, 64, 90]);
    assert!(DeSinc::default().refined(40).rule(&Span::symmetric(1.0, Parity::Even, Edge::Sharp)).is_err());
}

#[test]
fn what_a_scene_may_not_ask_for() {
    for bad in [0, 3, MOST_PINNED + 1] {
        assert!(Count::<LEAST_STEPS, MOST_PINNED>::try_from(bad).is_err(), "{bad} steps");
    }
    for bad in [0.0, 0.9, -3.0, 6.1, f64::NAN, f64::INFINITY] {
        assert!(Reach::try_from(bad).is_err(), "u_max = {bad}");
    }
    let whole = Span { interval: [0.0, 1.0], parity: None, edge: Edge::Sharp };
    assert!(DeSinc::default().rule(&whole).is_err(), "no parity");
    assert!(DeSinc::default().rule(&Span::symmetric(1.0, Parity::Even, Edge::Continued)).is_err());
}

#[test]
fn the_widest_and_the_narrowest_grid_hold() {
    let kernel = graded(0.5);
    for (n, u_max) in [(LEAST_STEPS, LEAST_REACH), (40, LEAST_REACH), (LEAST_STEPS, MOST_REACH), (40, MOST_REACH)] {
        let quadrature = DeSinc { n: Some(Count(n)), u_max: Some(Reach(u_max)), level: 0 };
        let mut rule = quadrature.rule(&Span::symmetric(1.0, Parity::Even, Edge::Sharp)).expect("in range");
        assert!(operator(rule.as_mut(), Some((&kernel, Component::NormalSlope))).iter().all(|a| a.is_finite()));
        let unknowns = flat_punch(rule.as_mut(), None);
        let p = value(rule.as_ref(), &unknowns, 0.5, 0.5) * std::f64::consts::PI * 0.75_f64.sqrt();
        // Exact for F = const by construction; entries span 250 orders of magnitude.
        assert_close(p, 1.0, 1e-12, &format!("flat punch at n = {n}, u_max = {u_max}"));
        let smooth = quadrature.rule(&Span::symmetric(1.0, Parity::Even, Edge::Smooth));
        assert_eq!(smooth.is_ok(), u_max == LEAST_REACH, "singular systems at u_max = {u_max}");
    }
}
