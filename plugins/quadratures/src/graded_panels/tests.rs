//! The rule against integrals in closed form, and small problems solved with it.

mod exactness;
mod kernels;
mod layer;
mod solved;

use super::mesh::Mesh;
use super::*;
use slipzone_api::testkit::solve;
use slipzone_api::{Component, Edge, KernelTable, Parity, Parts, PartsMut, Station};
use std::f64::consts::PI;

fn rule(c: f64, parity: Parity, edge: Edge, nodes: usize, panels: usize) -> Box<dyn Rule> {
    let quadrature = GradedPanels { nodes: Some(Count(nodes)), panels: Some(Count(panels)), ..GradedPanels::default() };
    quadrature.rule(&Span::symmetric(c, parity, edge)).expect("a symmetric span")
}

/// Unknowns of the density whose piecewise polynomial `F` is this function of the angle.
fn unknowns(parity: Parity, edge: Edge, nodes: usize, panels: usize, polynomial: impl Fn(f64) -> f64) -> Vec<f64> {
    let (mesh, basis) = (Mesh::new(nodes, panels, 1, false), Basis { parity, edge });
    let count = basis.unknowns(mesh.nodes());
    let kept = (0..mesh.nodes()).filter(|i| basis.unknown(*i).is_some_and(|j| j < count));
    kept.map(|i| polynomial(mesh.node(i))).collect()
}

fn operator(rule: &mut dyn Rule, kernel: Option<(&dyn KernelTable, Component)>) -> Vec<f64> {
    let mut rows = vec![0.0; rule.unknowns() * rule.collocation().len()];
    rule.operator_into(kernel, &mut rows);
    rows
}

/// Factor of each row.
fn row_scale(rule: &dyn Rule) -> Vec<f64> {
    rule.row_scale().map_or_else(|| vec![1.0; rule.collocation().len()], <[f64]>::to_vec)
}

fn apply(rows: &[f64], unknowns: &[f64]) -> Vec<f64> {
    rows.chunks(unknowns.len()).map(|row| row.iter().zip(unknowns).map(|(a, u)| a * u).sum()).collect()
}

fn value(rule: &dyn Rule, unknowns: &[f64], at: Station) -> f64 {
    rule.value(unknowns, at)
}

#[track_caller]
fn assert_close(got: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((got - expected).abs() <= tolerance, "{what}: {got:e} instead of {expected:e}");
}

/// A kernel of three parts, by functions of the distance and its own length.
#[derive(Clone, Copy)]
struct Made {
    parts: fn(f64, f64) -> Parts,
    length: f64,
}

impl KernelTable for Made {
    fn parts_into(&self, _: Component, distances: &[f64], out: PartsMut) {
        out.fill(distances, |t| (self.parts)(t, self.length));
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn flexibility_evaluations(&self) -> usize {
        0
    }
}

const JUMP: Made = Made { parts: |_, _| Parts { smooth: 0.0, sign: 1.0, log: 0.0 }, length: 1.0 };
const LOGARITHM: Made = Made { parts: |_, _| Parts { smooth: 0.0, sign: 0.0, log: 1.0 }, length: 1.0 };

#[test]
fn counts_out_of_range_are_refused_with_the_range() {
    for bad in [0, 3, 33] {
        let fault = Count::<4, 32>::try_from(bad).expect_err("out of range");
        assert!(fault.contains("from 4 to 32") && fault.contains(&bad.to_string()), "{fault}");
    }
    let pinned = |nodes: Option<usize>, panels: Option<usize>| GradedPanels {
        nodes: nodes.map(Count),
        panels: panels.map(Count),
        ..GradedPanels::default()
    };
    assert!(!pinned(None, None).is_pinned());
    assert!(pinned(Some(8), None).is_pinned() && pinned(None, Some(8)).is_pinned());
    let span = Span::symmetric(1.0, Parity::Even, Edge::Sharp);
    // The first refinement of the largest is its twin, the second is too much.
    assert!(matches!(pinned(Some(32), Some(64)).refined(2).rule(&span), Err(Refusal::OutOfReach { .. })));
    let lopsided = Span { interval: [-1.0, 1.0], parity: None, edge: Edge::Sharp };
    assert!(matches!(pinned(None, None).rule(&lopsided), Err(Refusal::NotBuilt { .. })));
}

#[test]
fn a_level_takes_five_quarters_to_twice_the_unknowns() {
    let span = Span::symmetric(1.0, Parity::Even, Edge::Sharp);
    let mut starts = vec![GradedPanels::default()];
    for (nodes, panels) in [(4, 2), (5, 3), (8, 8), (21, 13)] {
        starts.push(GradedPanels { nodes: Some(Count(nodes)), panels: Some(Count(panels)), ..GradedPanels::default() });
    }
    for start in starts {
        let unknowns = |level| start.refined(level).rule(&span).map(|rule| rule.unknowns());
        for level in 0..4 {
            if let (Ok(coarse), Ok(fine)) = (unknowns(level), unknowns(level + 1)) {
                let factor = fine as f64 / coarse as f64;
                assert!((1.25..=2.0).contains(&factor), "{start:?}, level {level}: {coarse} to {fine}");
            }
        }
    }
}
