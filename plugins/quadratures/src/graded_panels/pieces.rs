//! Where integrals over the density are summed: Gauss points on pieces of the panels.

use super::layout::Basis;
use super::legendre::Gauss;
use super::mesh::{Mesh, Place};

/// An interval of the angle inside one panel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) panel: usize,
    pub(super) lower: f64,
    pub(super) half_length: f64,
}

impl Piece {
    /// `angle` measured from the piece's middle in half-lengths.
    pub(super) fn local(&self, angle: f64) -> f64 {
        (angle - self.lower) / self.half_length - 1.0
    }
}

/// Gauss points on each piece, and the density there in terms of the unknowns.
pub(super) struct Pieces {
    pub(super) list: Vec<Piece>,
    /// Angles of the Gauss points, piece by piece.
    pub(super) angle: Vec<f64>,
    /// Sines and cosines of half these angles.
    pub(super) half: Vec<(f64, f64)>,
    /// Measure of the density at these points: `f dx = c unknown-polynomial * measure dtheta`.
    pub(super) measure: Vec<f64>,
    /// `degree + 1` basis values for each Gauss point.
    basis: Vec<f64>,
}

impl Pieces {
    /// Each panel cut into `cuts[panel]` equal pieces.
    pub(super) fn new(mesh: &Mesh, gauss: &Gauss, basis: Basis, cuts: &[usize]) -> Self {
        let points = gauss.z.len() * cuts.iter().sum::<usize>();
        let width = mesh.degree + 1;
        let mut pieces = Self {
            list: Vec::new(),
            angle: Vec::with_capacity(points),
            half: Vec::with_capacity(points),
            measure: Vec::with_capacity(points),
            basis: Vec::with_capacity(points * width),
        };
        let mut row = vec![0.0; width];
        for (panel, &cuts) in cuts.iter().enumerate() {
            let half_length = mesh.half_length(panel) / cuts as f64;
            for cut in 0..cuts {
                let lower = mesh.breaks[panel] + 2.0 * half_length * cut as f64;
                pieces.list.push(Piece { panel, lower, half_length });
                for z in &gauss.z {
                    let offset = (1.0 + z + 2.0 * cut as f64) / cuts as f64;
                    let angle = mesh.angle(Place { panel, offset });
                    pieces.angle.push(angle);
                    pieces.half.push((0.5 * angle).sin_cos());
                    pieces.measure.push(basis.measure(angle));
                    mesh.basis_into(offset, &mut row);
                    pieces.basis.extend_from_slice(&row);
                }
            }
        }
        pieces
    }

    /// `row[j]` = sum over the Gauss points of `summand` times what the `j`-th unknown contributes there.
    pub(super) fn gather_into(&self, summand: &[f64], mesh: &Mesh, basis: Basis, row: &mut [f64]) {
        let per_piece = summand.len() / self.list.len();
        let width = mesh.degree + 1;
        row.fill(0.0);
        let mut points = summand.iter().zip(self.basis.chunks_exact(width));
        let mut of_panel = vec![0.0; width];
        for pieces in self.list.chunk_by(|one, next| one.panel == next.panel) {
            of_panel.fill(0.0);
            for (value, basis) in points.by_ref().take(per_piece * pieces.len()) {
                of_panel.iter_mut().zip(basis).for_each(|(sum, entry)| *sum += value * entry);
            }
            let first = pieces[0].panel * mesh.degree;
            for (i, sum) in of_panel.iter().enumerate() {
                if let Some(j) = basis.unknown(first + i)
                    && j < row.len()
                {
                    row[j] += sum;
                }
            }
        }
    }

    /// `out[k]` = the piecewise polynomial at each Gauss point.
    pub(super) fn density_into(&self, unknowns: &[f64], mesh: &Mesh, basis: Basis, out: &mut Vec<f64>) {
        let width = mesh.degree + 1;
        let per_piece = self.angle.len() / self.list.len();
        out.clear();
        for (k, row) in self.basis.chunks(width).enumerate() {
            let first = self.list[k / per_piece].panel * mesh.degree;
            out.push(row.iter().enumerate().map(|(i, b)| b * basis.coefficient(first + i, unknowns)).sum());
        }
    }
}
