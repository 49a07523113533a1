//! The contract is checked by breaking a rule: every fault that it claims to find is committed here once.

use super::quadrature;
use crate::{Component, Densities, Edge, KernelTable, Parity, Quadrature, Refusal, Rule, Span, Station};
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// What is wrong with a rule.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum Fault {
    None,
    OnePointMore,
    Descending,
    GapOfAnotherWidth,
    ScaleOfZero,
    ResultantOfTheOddHalf,
    OperatorOfNothing,
    ResultantOfOneHalf,
    EdgeFactorPerLength,
    ValueAtTheAbscissa,
}

/// Gauss-Chebyshev for sharp edges; of the others as many points as there must be.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Faulty(Fault);

#[typetag::serde(name = "faulty")]
impl Quadrature for Faulty {
    fn rule(&self, span: &Span) -> Result<Box<dyn Rule>, Refusal> {
        let (Self(fault), half_width) = (self, span.interval[1]);
        let count = match span.edge {
            Edge::Sharp => NODES - 1,
            Edge::Smooth => NODES,
            Edge::Continued => NODES + 1,
        } + usize::from(*fault == Fault::OnePointMore);
        let angle = |i: usize| if span.edge == Edge::Sharp { i as f64 / NODES as f64 } else { i as f64 / 12.0 };
        let gap = |x: f64| if *fault == Fault::GapOfAnotherWidth { 2.0 - x } else { half_width - x };
        let point = |i: usize| half_width * (0.5 * PI * angle(i)).cos();
        let mut points: Vec<_> = (1..=count).rev().map(|i| Station { x: point(i), gap: gap(point(i)) }).collect();
        if *fault == Fault::Descending {
            points.reverse();
        }
        Ok(Box::new(FaultyRule { fault: *fault, is_odd: span.parity == Some(Parity::Odd), half_width, points }))
    }

    fn refined(&self, _: u32) -> Box<dyn Quadrature> {
        Box::new(self.clone())
    }

    fn is_pinned(&self) -> bool {
        true
    }
}

/// Nodes of half the contact.
const NODES: usize = 6;

struct FaultyRule {
    fault: Fault,
    is_odd: bool,
    half_width: f64,
    points: Vec<Station>,
}

impl Rule for FaultyRule {
    fn unknowns(&self) -> usize {
        NODES
    }

    fn collocation(&self) -> &[Station] {
        &self.points
    }

    fn row_scale(&self) -> Option<&[f64]> {
        const ZEROS: [f64; NODES + 1] = [0.0; NODES + 1];
        (self.fault == Fault::ScaleOfZero).then(|| &ZEROS[..self.points.len()])
    }

    fn half_width(&self) -> f64 {
        self.half_width
    }

    fn stretch(&mut self, _: f64) {
        unreachable!()
    }

    fn operator_into(&mut self, _: Option<(&dyn KernelTable, Component)>, rows: &mut [f64]) {
        let wanted = if self.fault == Fault::OperatorOfNothing { 0.0 } else { 1.0 };
        for (row, at) in rows.chunks_mut(NODES).zip(&self.points) {
            for (j, entry) in row.iter_mut().enumerate() {
                let node = self.half_width * (PI * (j as f64 + 0.5) / (2 * NODES) as f64).cos();
                *entry = wanted / (2 * NODES) as f64 * (1.0 / (at.x - node) + 1.0 / (at.x + node));
            }
        }
    }

    fn applied_into(&mut self, _: (&dyn KernelTable, Component), _: &[f64], _: &Densities, _: &mut [[f64; 2]]) {
        unreachable!()
    }

    fn resultant_into(&self, row: &mut [f64]) {
        let whole = if self.fault == Fault::ResultantOfOneHalf { 0.5 } else { 1.0 };
        let is_zero = self.is_odd && self.fault != Fault::ResultantOfTheOddHalf;
        row.fill(if is_zero { 0.0 } else { whole * PI / NODES as f64 });
    }

    fn values_into(&self, unknowns: &[f64], at: &[Station], out: &mut [f64]) {
        for (out, at) in out.iter_mut().zip(at) {
            let gap = if self.fault == Fault::ValueAtTheAbscissa { self.half_width - at.x } else { at.gap };
            *out = unknowns[0] / (gap * (2.0 * self.half_width - gap)).sqrt();
        }
    }

    fn edge_factor(&self, unknowns: &[f64]) -> f64 {
        if self.fault == Fault::EdgeFactorPerLength { unknowns[0] / self.half_width } else { unknowns[0] }
    }

    fn sample_potential(&mut self, _: &[f64], _: (&dyn KernelTable, Component), _: &mut Vec<f64>) {
        unreachable!()
    }

    fn potential_into(&mut self, _: &[f64], _: (&dyn KernelTable, Component), _: &[Station], _: &mut [f64]) {
        unreachable!()
    }
}

#[test]
fn faults_of_rules_are_found() {
    assert_eq!(quadrature(&Faulty(Fault::None)), Ok(()));
    for (fault, words) in [
        (Fault::OnePointMore, "Even Sharp: 6 equations for 6 unknowns, not -1 more"),
        (Fault::Descending, "do not ascend"),
        (Fault::GapOfAnotherWidth, "do not add up"),
        (Fault::ScaleOfZero, "row_scale() has factors that are 0 or no number"),
        (Fault::ResultantOfTheOddHalf, "Odd Continued: resultant_into()"),
        (Fault::OperatorOfNothing, "edge_factor() of a flat punch is NaN"),
        (Fault::ResultantOfOneHalf, "edge_factor() of a flat punch is 1.99999"),
        (Fault::EdgeFactorPerLength, "edge_factor() of a flat punch is 0.3333"),
        (Fault::ValueAtTheAbscissa, "at the gap 0.000000000001"),
    ] {
        let found = quadrature(&Faulty(fault)).expect_err("this rule is broken");
        assert!(found.contains(words), "{fault:?}: {found}");
    }
}
