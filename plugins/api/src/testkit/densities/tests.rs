//! The contract is checked by breaking a rule: every fault that it claims to find is committed here once.

use super::quadrature;
use crate::{Component, Densities, Edge, KernelTable, Parity, Quadrature, Refusal, Rule, Span, Station};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// What is wrong with a rule.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum Fault {
    None,
    NoFinerRule,
    ValuesOfShear,
    OperatorOfShear,
    OddConstant,
    ResultantOfSmooth,
    NoKernel,
    ShallowMiddle,
}

/// Gauss-Chebyshev of the first kind for sharp edges, of the second for all others.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Faulty(Fault);

/// Nodes of half an interval.
const NODES: usize = 6;

#[typetag::serde(name = "faulty-densities")]
impl Quadrature for Faulty {
    fn rule(&self, span: &Span) -> Result<Box<dyn Rule>, Refusal> {
        if self.0 == Fault::NoFinerRule {
            return Err(Refusal::NotBuilt { what: "this".into(), remedy: "do without".into() });
        }
        let is_sharp = span.edge == Edge::Sharp;
        let half_width = span.interval[1];
        let whole = if is_sharp { 2 * NODES } else { 2 * NODES + 1 } as f64;
        let angle = |i: usize, offset: f64| (i as f64 - offset) * PI / whole;
        let nodes = (1..=2 * NODES).map(|k| angle(k, if is_sharp { 0.5 } else { 0.0 }));
        let weight = |angle: f64| if is_sharp { 1.0 / whole } else { angle.sin().powi(2) / whole };
        let points = match span.edge {
            Edge::Sharp => NODES - 1,
            Edge::Smooth => NODES,
            Edge::Continued => NODES + 1,
        };
        let place = |i: usize| angle(i, if is_sharp { 0.0 } else { 0.5 }).cos() * half_width;
        let station = |x: f64| Station { x, gap: half_width - x };
        Ok(Box::new(FaultyRule {
            fault: self.0,
            span: *span,
            nodes: nodes.map(|angle| (angle.cos(), weight(angle))).collect(),
            points: (1..=points).rev().map(|i| station(place(i))).collect(),
        }))
    }

    fn refined(&self, _: u32) -> Box<dyn Quadrature> {
        Box::new(self.clone())
    }

    fn is_pinned(&self) -> bool {
        true
    }
}

struct FaultyRule {
    fault: Fault,
    span: Span,
    /// On `[-1, 1]`, with their weights, from the upper end down.
    nodes: Vec<(f64, f64)>,
    points: Vec<Station>,
}

impl FaultyRule {
    fn mirror(&self) -> f64 {
        self.span.parity.map_or(1.0, Parity::mirror)
    }

    /// `(1/pi) int f(r) k(x - r) dr` of each unknown.
    fn row(&self, kernel: impl Fn(f64) -> f64, x: f64, row: &mut [f64]) {
        row.fill(0.0);
        for (k, (t, weight)) in self.nodes.iter().enumerate() {
            let (own, mirror) = if k < NODES { (k, 1.0) } else { (2 * NODES - 1 - k, self.mirror()) };
            row[own] += mirror * weight * self.half_width() * kernel(x - t * self.half_width());
        }
    }
}

impl Rule for FaultyRule {
    fn unknowns(&self) -> usize {
        NODES
    }

    fn collocation(&self) -> &[Station] {
        &self.points
    }

    fn half_width(&self) -> f64 {
        self.span.interval[1]
    }

    fn stretch(&mut self, _: f64) {
        unreachable!()
    }

    fn operator_into(&mut self, kernel: Option<(&dyn KernelTable, Component)>, rows: &mut [f64]) {
        let kernel = kernel.filter(|_| self.fault != Fault::NoKernel);
        let is_shear = self.span.edge == Edge::Continued;
        let factor = if is_shear && self.fault == Fault::OperatorOfShear { 1.05 } else { 1.0 };
        let more = if is_shear && self.fault == Fault::OddConstant { 0.1 } else { 0.0 };
        let whole = |t: f64| {
            factor / t + more * t * t + kernel.map_or(0.0, |(table, component)| table.parts(component, t).value(t))
        };
        for (row, at) in rows.chunks_mut(NODES).zip(&self.points) {
            self.row(whole, at.x, row);
        }
    }

    fn applied_into(&mut self, _: (&dyn KernelTable, Component), _: &[f64], _: &Densities, _: &mut [[f64; 2]]) {
        unreachable!()
    }

    fn resultant_into(&self, row: &mut [f64]) {
        self.row(|_| PI, 0.0, row);
        if self.span.edge == Edge::Smooth && self.fault == Fault::ResultantOfSmooth {
            for weight in row {
                *weight *= 0.5;
            }
        }
    }

    fn values_into(&self, unknowns: &[f64], at: &[Station], out: &mut [f64]) {
        let all = |k: usize| if k < NODES { unknowns[k] } else { self.mirror() * unknowns[2 * NODES - 1 - k] };
        let is_shear = self.span.edge == Edge::Continued;
        for (out, at) in out.iter_mut().zip(at) {
            let x = at.x / self.half_width();
            let others = |k: usize| self.nodes.iter().enumerate().filter(move |(j, _)| *j != k);
            let part = |k: usize| -> f64 { others(k).map(|(_, (t, _))| (x - t) / (self.nodes[k].0 - t)).product() };
            let smooth: f64 = (0..2 * NODES).map(|k| all(k) * part(k)).sum();
            let root = (1.0 - x * x).sqrt();
            *out = if self.span.edge == Edge::Sharp { smooth / root } else { smooth * root };
            if is_shear && self.fault == Fault::ValuesOfShear {
                *out *= 1.5;
            }
        }
    }

    fn edge_factor(&self, _: &[f64]) -> f64 {
        unreachable!()
    }

    fn sample_potential(&mut self, _: &[f64], _: (&dyn KernelTable, Component), _: &mut Vec<f64>) {
        unreachable!()
    }

    fn potential_at_centre(&mut self, unknowns: &[f64], (table, component): (&dyn KernelTable, Component)) -> f64 {
        let mut row = [0.0; NODES];
        self.row(|t| table.parts(component, t).value(t), 0.0, &mut row);
        let part = if self.fault == Fault::ShallowMiddle { 0.9 } else { 1.0 };
        part * row.iter().zip(unknowns).map(|(weight, unknown)| weight * unknown).sum::<f64>()
    }

    fn potential_into(&mut self, _: &[f64], _: (&dyn KernelTable, Component), _: &[Station], _: &mut [f64]) {
        unreachable!()
    }
}

#[test]
fn every_fault_is_found() {
    assert_eq!(quadrature(&Faulty(Fault::None)), Ok(()));
    for (fault, words) in [
        (Fault::NoFinerRule, "there is no rule for Even Smooth"),
        (Fault::ValuesOfShear, "Odd Continued: the density at -2.7 is -5.29"),
        (Fault::OperatorOfShear, "Odd Continued: the density at -2.7 is -3.36"),
        (Fault::OddConstant, "Odd Continued: "),
        (Fault::ResultantOfSmooth, "Even Smooth: the resultant is 7.06"),
        (Fault::NoKernel, "Even Sharp: the density at -2.7 is 0.24"),
        (Fault::ShallowMiddle, "Even Sharp: the potential of k = 1 + t^2 in the middle is"),
    ] {
        let found = quadrature(&Faulty(fault)).expect_err("this rule is broken");
        assert!(found.contains(words), "{fault:?}: {found}");
    }
}
