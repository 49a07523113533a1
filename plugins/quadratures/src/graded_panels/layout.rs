//! What a rule knows before it knows the contact's half-width.

use super::basis::Basis;
use super::cauchy;
use super::legendre::Gauss;
use super::mesh::Mesh;
use super::pieces::Pieces;
use super::shares::Shares;
use slipzone_api::{Edge, Shelf};
use std::f64::consts::PI;
use std::sync::Arc;

/// Mesh, collocation points and Cauchy matrix: all that does not change with the half-width.
pub(super) struct Layout {
    pub(super) mesh: Mesh,
    pub(super) gauss: Gauss,
    pub(super) basis: Basis,
    /// The panels, each in one piece.
    pub(super) pieces: Pieces,
    pub(super) shares: Shares,
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
        let shares = Shares::new(degree);
        let unknowns = basis.unknowns(mesh.nodes());

        let mut cauchy = vec![0.0; angles.len() * unknowns];
        let mut summand = vec![0.0; pieces.at.len()];
        for (row, (target, scale)) in cauchy.chunks_mut(unknowns).zip(targets.iter().zip(&row_scale)) {
            let factor = scale / mesh.angle(*target).sin();
            cauchy::row_into(*target, factor, basis, (&mesh, &pieces, &gauss), &mut summand, row);
        }

        let mut resultant = vec![0.0; unknowns];
        for (out, (slope, w)) in summand.iter_mut().zip(pieces.slope.iter().zip(gauss.w.iter().cycle())) {
            *out = w * slope * (1.0 + basis.parity.mirror());
        }
        pieces.gather_into(&summand, &mesh, basis, &mut resultant);
        Self { mesh, gauss, basis, pieces, shares, targets, angles, row_scale, cauchy, resultant }
    }

    /// The layout of these numbers, made once per process: a solver asks for the same one at every trial stick zone.
    pub(super) fn shared(counts: (usize, usize), root: u32, basis: Basis) -> Arc<Self> {
        static LAYOUTS: Shelf<((usize, usize), u32, Basis), Layout> = Shelf::new(KEPT, |layout| layout.cauchy.len());
        LAYOUTS.get((counts, root, basis), || Self::new(counts, root, basis))
    }
}
