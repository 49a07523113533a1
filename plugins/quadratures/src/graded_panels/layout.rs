//! What a rule knows before it knows the contact's half-width.

use super::cauchy;
use super::legendre::Gauss;
use super::mesh::Mesh;
use super::pieces::Pieces;
use slipzone_api::{Edge, Parity, Shelf};
use std::f64::consts::PI;
use std::sync::Arc;

/// How the numbers at the mesh's nodes describe a density.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Basis {
    pub(super) parity: Parity,
    pub(super) edge: Edge,
}

impl Basis {
    /// `+1` or `-1`: the density at `-x` over that at `x`.
    pub(super) fn mirror(self) -> f64 {
        if self.parity == Parity::Even { 1.0 } else { -1.0 }
    }

    /// `f sin(theta)/F`, `F` being the piecewise polynomial: 1 where `f = F/sin(theta)`, `sin(theta)` where `f = F`.
    pub(super) fn measure(self, angle: f64) -> f64 {
        if self.edge == Edge::Smooth { angle.sin() } else { 1.0 }
    }

    /// Factor of the row at a collocation point: 1 if the density is bounded as `F` itself is, otherwise
    /// `sin(theta)`, which turns the operator into a Hilbert transform of `F`.
    ///
    /// With it the condition number (row-sum norm, half-plane) is 18 to 63 for 18 to 162 sharp or smooth unknowns
    /// and 64 to 210 for continued ones; with the other choice it passes 1e6 at 105.
    fn row_scale(self, angle: f64) -> f64 {
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

    /// `f sin(theta)` over the polynomial.
    pub(super) fn measure_at(self, mesh: &Mesh, u: f64) -> f64 {
        self.factor(mesh, u) * self.measure(mesh.angle(u))
    }

    /// The polynomial at a node.
    pub(super) fn coefficient(self, node: usize, unknowns: &[f64]) -> f64 {
        self.unknown(node).and_then(|j| unknowns.get(j)).copied().unwrap_or(0.0)
    }
}

/// Mesh, collocation points and Cauchy matrix: all that does not change with the half-width.
pub(super) struct Layout {
    pub(super) mesh: Mesh,
    pub(super) gauss: Gauss,
    pub(super) basis: Basis,
    /// The panels, each in one piece.
    pub(super) pieces: Pieces,
    /// The collocation points in `u`, descending (`x` ascends), and their angles.
    pub(super) targets: Vec<f64>,
    pub(super) angles: Vec<f64>,
    /// Factor of each row.
    pub(super) row_scale: Vec<f64>,
    /// Scaled Cauchy part of the operator: `rows[i * unknowns + j]`.
    pub(super) cauchy: Vec<f64>,
    /// Resultant over the half-width.
    pub(super) resultant: Vec<f64>,
}

/// Gauss points per piece, for polynomials of degree `degree` times what they are integrated with.
///
/// Twelve more than the degree: `sin(theta)` over the longest panel (half-length 0.39) leaves
/// `0.2^12/12! = 1e-17` of itself, a kernel part what is measured at [`super::regular::PIECE`].
pub(super) fn gauss_points(degree: usize, root: u32) -> usize {
    degree + 11 + root as usize
}

/// Entries of matrices kept, 64 MB.
const KEPT: usize = 1 << 23;

impl Layout {
    fn new((degree, panels): (usize, usize), root: u32, basis: Basis) -> Self {
        let mesh = Mesh::new(degree, panels, root, basis.edge == Edge::Continued);
        let gauss = Gauss::new(gauss_points(degree, root));
        // Between the nodes: the zeros of the Chebyshev polynomial whose extrema the nodes are.
        let middle = |panel: usize, i: usize| {
            let offset = 2.0 * (0.5 * PI * (i as f64 + 0.5) / degree as f64).sin().powi(2);
            mesh.breaks[panel] + mesh.half_length(panel) * offset
        };
        let targets: Vec<f64> = (0..panels)
            .rev()
            .flat_map(|panel| (0..degree).rev().map(move |i| (panel, i)))
            .map(|(p, i)| middle(p, i))
            .collect();
        let angles: Vec<f64> = targets.iter().map(|u| mesh.angle(*u)).collect();
        let row_scale: Vec<f64> = angles.iter().map(|a| basis.row_scale(*a)).collect();
        let pieces = Pieces::new(&mesh, &gauss, basis);
        let unknowns = basis.unknowns(mesh.nodes());

        let mut cauchy = vec![0.0; angles.len() * unknowns];
        let mut summand = vec![0.0; pieces.at.len()];
        for (row, (target, scale)) in cauchy.chunks_mut(unknowns).zip(targets.iter().zip(&row_scale)) {
            let factor = scale / mesh.angle(*target).sin();
            cauchy::row_into(*target, factor, basis, (&mesh, &pieces, &gauss), &mut summand, row);
        }

        let mut resultant = vec![0.0; unknowns];
        for (piece, chunk) in pieces.list.iter().zip(summand.chunks_mut(gauss.z.len())) {
            for (out, w) in chunk.iter_mut().zip(&gauss.w) {
                *out = w * piece.half_length * (1.0 + basis.mirror());
            }
        }
        for (out, (measure, u)) in summand.iter_mut().zip(pieces.measure.iter().zip(&pieces.at)) {
            *out *= measure * mesh.slope(*u);
        }
        pieces.gather_into(&summand, &mesh, basis, &mut resultant);
        Self { mesh, gauss, basis, pieces, targets, angles, row_scale, cauchy, resultant }
    }

    /// The layout of these numbers, made once per process: a solver asks for the same one at every trial stick zone.
    pub(super) fn shared(counts: (usize, usize), root: u32, basis: Basis) -> Arc<Self> {
        static LAYOUTS: Shelf<((usize, usize), u32, Basis), Layout> = Shelf::new(KEPT, |layout| layout.cauchy.len());
        LAYOUTS.get((counts, root, basis), || Self::new(counts, root, basis))
    }
}
