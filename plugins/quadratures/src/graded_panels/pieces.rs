//! Where integrals over the density are summed: Gauss points on the panels.

use super::basis::Basis;
use super::legendre::Gauss;
use super::mesh::{Mesh, Place};

/// A panel, as far as integrals see it, or a part of one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) lower: f64,
    pub(super) half_length: f64,
}

impl Piece {
    /// A place measured from the piece's middle in half-lengths.
    pub(super) fn local(&self, u: f64) -> f64 {
        (u - self.lower) / self.half_length - 1.0
    }
}

/// Gauss points on each panel, and the density there in terms of the unknowns.
pub(super) struct Pieces {
    pub(super) list: Vec<Piece>,
    /// The Gauss points, panel by panel.
    pub(super) at: Vec<f64>,
    /// Measure of the density at these points: `f dx = c F measure dtheta`.
    pub(super) measure: Vec<f64>,
    /// `measure` times how the angle rises along the panel, in half-lengths.
    pub(super) slope: Vec<f64>,
    /// Sine and cosine of half the angle at these points.
    pub(super) half_angles: Vec<[f64; 2]>,
    /// `degree + 1` basis values for each Gauss point.
    basis: Vec<f64>,
}

impl Pieces {
    pub(super) fn new(mesh: &Mesh, gauss: &Gauss, basis: Basis) -> Self {
        let points = gauss.z.len() * mesh.panels();
        let width = mesh.degree + 1;
        let mut pieces = Self {
            list: Vec::with_capacity(mesh.panels()),
            at: Vec::with_capacity(points),
            measure: Vec::with_capacity(points),
            slope: Vec::with_capacity(points),
            half_angles: Vec::with_capacity(points),
            basis: Vec::with_capacity(points * width),
        };
        let mut row = vec![0.0; width];
        for panel in 0..mesh.panels() {
            pieces.list.push(Piece { lower: mesh.breaks[panel], half_length: mesh.half_length(panel) });
            for z in &gauss.z {
                let offset = 1.0 + z;
                let u = mesh.at(Place { panel, offset });
                let measure = basis.measure_at(mesh, u, mesh.angle(u).sin());
                pieces.at.push(u);
                pieces.measure.push(measure);
                pieces.slope.push(measure * mesh.slope(u) * mesh.half_length(panel));
                pieces.half_angles.push((0.5 * mesh.angle(u)).sin_cos().into());
                mesh.basis_into(offset, &mut row);
                pieces.basis.extend_from_slice(&row);
            }
        }
        pieces
    }

    /// Adds to `of_nodes` what the nodes of a panel contribute to the sum over its Gauss points of `summand`, in
    /// half-lengths.
    pub(super) fn add_panel_into(&self, panel: usize, summand: &[f64], of_nodes: &mut [f64]) {
        let (q, width) = (summand.len(), of_nodes.len());
        let points = panel * q..(panel + 1) * q;
        let rows = self.basis[points.start * width..].chunks_exact(width);
        for ((summand, slope), row) in summand.iter().zip(&self.slope[points]).zip(rows) {
            let weight = summand * slope;
            of_nodes.iter_mut().zip(row).for_each(|(sum, entry)| *sum += weight * entry);
        }
    }

    /// `row[j]` = sum over the Gauss points of `summand` times what the `j`-th unknown contributes there.
    pub(super) fn gather_into(&self, summand: &[f64], mesh: &Mesh, basis: Basis, row: &mut [f64]) {
        let per_panel = summand.len() / self.list.len();
        let width = mesh.degree + 1;
        row.fill(0.0);
        let mut of_panel = vec![0.0; width];
        let panels = summand.chunks_exact(per_panel).zip(self.basis.chunks_exact(per_panel * width));
        for (panel, (summand, rows)) in panels.enumerate() {
            of_panel.fill(0.0);
            for (value, basis) in summand.iter().zip(rows.chunks_exact(width)) {
                of_panel.iter_mut().zip(basis).for_each(|(sum, entry)| *sum += value * entry);
            }
            basis.add_into(panel * mesh.degree, &of_panel, row);
        }
    }
}
