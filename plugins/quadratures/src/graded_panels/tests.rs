//! The rule against integrals in closed form, and small problems solved with it.

mod exactness;
mod kernels;
mod layer;
mod solved;

use super::mesh::Mesh;
use super::*;
use crate::fixtures::{Made, apply, assert_close, jump, logarithm, operator, row_scale};
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

fn value(rule: &dyn Rule, unknowns: &[f64], at: Station) -> f64 {
    rule.value(unknowns, at)
}

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
