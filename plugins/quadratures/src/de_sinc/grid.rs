//! What a resolution and a parity fix, whatever the half-width: nodes, Cauchy matrix, edge functional.

use super::map::Place;
use super::shelf::Size;
use std::f64::consts::{FRAC_PI_2, PI};

/// `n + 1` nodes `u_j = j step` and `n` staggered points `v_i = (i + 1/2) step` on half of `[-1, 1]`.
///
/// Unknowns are `F_j = f(x_j) sqrt(1 - x_j^2)`, `j = first..=n`. Rows are multiplied by
/// `x'(v_i)/sqrt(1 - x_i^2)`: both ways of scaling leave entries and unknowns of order one at the edge.
pub(super) struct Grid {
    pub(super) odd: bool,
    pub(super) step: f64,
    /// Nodes, the middle one included.
    pub(super) nodes: Vec<Place>,
    /// Collocation points.
    pub(super) staggered: Vec<Place>,
    /// Index of the node of the first unknown: an odd density has none in the middle.
    pub(super) first: usize,
    /// `x'(v_i)/sqrt(1 - x_i^2)`, the factor of each row.
    pub(super) scale: Vec<f64>,
    /// Cauchy part of the operator.
    pub(super) cauchy: Vec<f64>,
    /// `lim F` at the upper end as a sum over the unknowns.
    pub(super) edge_row: Vec<f64>,
    /// `int f dx` on `[-1, 1]` as a sum over the unknowns.
    pub(super) resultant: Vec<f64>,
}

impl Grid {
    pub(super) fn new(n: usize, u_max: f64, odd: bool) -> Self {
        let step = u_max / n as f64;
        let nodes: Vec<Place> = (0..=n).map(|j| Place::new(j as f64 * step)).collect();
        let staggered: Vec<Place> = (0..n).map(|i| Place::new((i as f64 + 0.5) * step)).collect();
        let first = usize::from(odd);
        let scale: Vec<f64> = staggered.iter().map(|v| v.slope).collect();
        let cauchy = staggered.iter().flat_map(|v| nodes[first..].iter().map(move |u| entry(v, u, step, odd))).collect();
        let fold = |j: usize| if j == 0 { 1.0 } else { 2.0 };
        let resultant = nodes.iter().enumerate().map(|(j, u)| if odd { 0.0 } else { fold(j) * step * u.slope });
        let resultant = resultant.skip(first).collect();
        let mut grid =
            Self { odd, step, nodes, staggered, first, scale, cauchy, edge_row: Vec::new(), resultant };
        grid.edge_row = grid.edge_functional();
        grid
    }

    pub(super) fn unknowns(&self) -> usize {
        self.nodes.len() - self.first
    }

    /// `pi F(1) = int f dx - int sqrt((1 + t)/(1 - t)) C(t) dt` with `C = (1/pi) PV int f(r)/(t - r) dr`.
    ///
    /// Folded by parity the second integrand is `t C/sqrt(1 - t^2)` for even densities and
    /// `C/sqrt(1 - t^2)` for odd ones; the rows of the Cauchy matrix are its samples at the staggered points.
    fn edge_functional(&self) -> Vec<f64> {
        let mut row: Vec<f64> = self.resultant.iter().map(|r| r / PI).collect();
        for (v, cauchy) in self.staggered.iter().zip(self.cauchy.chunks(row.len())) {
            let weight = -2.0 / PI * self.step * if self.odd { 1.0 } else { v.x };
            for (entry, c) in row.iter_mut().zip(cauchy) {
                *entry += weight * c;
            }
        }
        row
    }
}

/// `(1/pi) scale_i step P_j [1/(x_i - x_j) +- 1/(x_i + x_j)]` per unit of `F_j`.
///
/// With `x_i - x_j = sinh(w_i - w_j)/(cosh w_i cosh w_j)` all that is left is
/// `(pi/4) step cosh u_j cosh v_i [1/sinh(w_i - w_j) +- 1/sinh(w_i + w_j)]`; the bracket is taken as one fraction.
fn entry(v: &Place, u: &Place, step: f64, odd: bool) -> f64 {
    let jacobian = 0.5 * FRAC_PI_2 * step * u.u.cosh() * v.u.cosh();
    let difference = v.ahead_of(u).sinh();
    if u.w == 0.0 {
        return jacobian / difference;
    }
    let sum = (v.w + u.w).sinh();
    let (a, b) = if odd { (u.w.sinh(), v.w.cosh()) } else { (v.w.sinh(), u.w.cosh()) };
    2.0 * jacobian * (a / sum) * (b / difference)
}

impl Size for Grid {
    fn numbers(&self) -> usize {
        self.cauchy.len()
    }
}
