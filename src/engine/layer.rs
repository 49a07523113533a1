//! One layer at one resolution: its response, its kernels over a range of lengths, and the work counted.

use super::problem::Problem;
use slipzone_api::{Component, KernelRequest, KernelStrategy, KernelTable, LayerResponse, Parts, Quadrature, Refusal};
use std::cell::Cell;

/// What the normal problem needs: the slope kernel, and the depth for the indentation.
const NORMAL: &[Component] = &[Component::NormalSlope, Component::Depth];
/// What friction adds.
const ALL: &[Component] = &[Component::NormalSlope, Component::ShearStrain, Component::Coupling, Component::Depth];

/// Work done, all resolutions together.
#[derive(Debug, Default)]
pub(crate) struct Work {
    pub(crate) flexibility_evaluations: Cell<usize>,
    pub(crate) factorisations: Cell<usize>,
}

/// The methods at one resolution and what they made of the layer so far.
pub(crate) struct Layer<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) quadrature: &'a dyn Quadrature,
    response: &'a dyn LayerResponse,
    strategy: &'a dyn KernelStrategy,
    kernels: Option<Box<dyn KernelTable>>,
    reach: f64,
    pub(crate) work: &'a Work,
}

impl<'a> Layer<'a> {
    pub(crate) fn new(
        problem: &'a Problem,
        response: &'a dyn LayerResponse,
        strategy: &'a dyn KernelStrategy,
        quadrature: &'a dyn Quadrature,
        work: &'a Work,
    ) -> Self {
        Self { problem, quadrature, response, strategy, kernels: None, reach: 0.0, work }
    }

    /// Makes the kernels valid for contacts up to `half_width`; tables that reach that far are kept.
    pub(crate) fn reach(&mut self, half_width: f64) -> Result<(), Refusal> {
        let reach = 2.0 * half_width;
        if self.response.depth().is_none() || reach <= self.reach {
            return Ok(());
        }
        let components = if self.problem.friction.is_some() { ALL } else { NORMAL };
        let table = self.strategy.tabulate(self.response, &KernelRequest { reach, components })?;
        let evaluations = &self.work.flexibility_evaluations;
        evaluations.set(evaluations.get() + table.flexibility_evaluations());
        (self.kernels, self.reach) = (Some(table), reach);
        Ok(())
    }

    /// A kernel for the quadratures; `None` on a homogeneous half-plane, which has none.
    pub(crate) fn kernel(&self, component: Component) -> Option<(&dyn KernelTable, Component)> {
        self.kernels.as_deref().map(|table| (table, component))
    }

    /// A kernel at each distance; zeros on a homogeneous half-plane.
    pub(crate) fn kernel_values(&self, component: Component, distances: &[f64]) -> Vec<f64> {
        let Some(table) = &self.kernels else { return vec![0.0; distances.len()] };
        let mut parts = vec![Parts::default(); distances.len()];
        table.parts_into(component, distances, &mut parts);
        distances.iter().zip(parts).map(|(t, parts)| parts.value(*t)).collect()
    }

    /// Whether depths are defined: not on a half-plane.
    pub(crate) fn has_depth(&self) -> bool {
        self.response.depth().is_some()
    }

    /// Solves a dense system and counts it.
    pub(crate) fn solve(&self, rows: &[f64], right: &[&[f64]]) -> Result<Vec<Vec<f64>>, Refusal> {
        self.work.factorisations.set(self.work.factorisations.get() + 1);
        super::lu::solve(rows, right).ok_or_else(|| Refusal::OutOfReach {
            method: "engine",
            why: format!("the system of {} equations is singular to working precision", right[0].len()),
            remedy: "take fewer nodes, or report the scene",
        })
    }
}
