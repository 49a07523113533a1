//! What the unknowns of a rule say of a density.

use super::mesh::Mesh;
use slipzone_api::{Edge, Parity};

/// How the numbers at the mesh's nodes describe a density.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Basis {
    pub(super) parity: Parity,
    pub(super) edge: Edge,
}

impl Basis {
    /// Factor of the row at a collocation point: 1 if the density is bounded as `F` itself is, otherwise
    /// `sin(theta)`, which turns the operator into a Hilbert transform of `F`.
    ///
    /// With it the condition number (row-sum norm, half-plane) is 18 to 63 for 18 to 162 sharp or smooth unknowns
    /// and 64 to 210 for continued ones; with the other choice it passes 1e6 at 105.
    pub(super) fn row_scale(self, angle: f64) -> f64 {
        if self.edge == Edge::Smooth { 1.0 } else { angle.sin() }
    }

    /// `F` vanishes at the contact's end unless the edge is sharp.
    pub(super) fn first(self) -> usize {
        usize::from(self.edge != Edge::Sharp)
    }

    /// Number of unknowns on `nodes` nodes; an odd density also vanishes in the middle.
    pub(super) fn unknowns(self, nodes: usize) -> usize {
        nodes - self.first() - usize::from(self.parity == Parity::Odd)
    }

    /// The unknown at a node, counted from the contact's end; `None` at the end itself where `F` vanishes. The
    /// middle node of an odd density gets a number beyond the last unknown.
    pub(super) fn unknown(self, node: usize) -> Option<usize> {
        node.checked_sub(self.first())
    }

    /// Adds what the nodes from the `first` on contribute to a row of the unknowns.
    pub(super) fn add_into(self, first: usize, of_nodes: &[f64], row: &mut [f64]) {
        for (node, sum) in (first..).zip(of_nodes) {
            if let Some(out) = self.unknown(node).and_then(|j| row.get_mut(j)) {
                *out += sum;
            }
        }
    }

    /// What `F` is beside its polynomial.
    pub(super) fn factor(self, mesh: &Mesh, u: f64) -> f64 {
        if self.edge == Edge::Sharp { 1.0 } else { mesh.vanishing(u) }
    }

    /// `f sin(theta)` over the polynomial, where the angle has that sine: of `f = F/sin(theta)` that is what `F` is
    /// over it.
    pub(super) fn measure_at(self, mesh: &Mesh, u: f64, sine: f64) -> f64 {
        self.factor(mesh, u) * if self.edge == Edge::Smooth { sine } else { 1.0 }
    }

    /// The polynomial at a node.
    pub(super) fn coefficient(self, node: usize, unknowns: &[f64]) -> f64 {
        self.unknown(node).and_then(|j| unknowns.get(j)).copied().unwrap_or(0.0)
    }
}
