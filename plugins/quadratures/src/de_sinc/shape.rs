//! The density between its nodes.

use super::grid::Grid;
use super::map::locate;
use super::rule::dot;
use super::series::{alternating, at_nodes};
use slipzone_api::{Density, Edge, Station};

/// From here on `F` is its own limit to rounding: what is left is `gap log gap`, `gap/c = 2 exp(-2 w)`.
const PLATEAU: f64 = 20.0;

/// Where the last useful value of `F cosh^2 w` lies: `F` carries an error of a rounding times `exp(-w)`,
/// and the value differs from its limit by `exp(-2 w)`; both are 1e-11 here.
const USEFUL: f64 = 12.3;

/// A density made ready for evaluation: `f = carrier x/c + y(u) cosh(w)^(1 - power)`.
pub(super) struct Shape<'a> {
    grid: &'a Grid,
    edge: Edge,
    carrier: f64,
    /// Limit of `y` at the upper end.
    limit: f64,
    /// `(-1)^j (y_j - limit)` or, when odd, `(-1)^j (y_j - limit x_j)`; only where that is no rounding noise.
    signed: Vec<f64>,
}

impl<'a> Shape<'a> {
    pub(super) fn new(grid: &'a Grid, edge: Edge, density: Density) -> Self {
        assert_eq!(density.unknowns.len(), grid.unknowns(), "one number per unknown");
        let odd = grid.odd;
        let end_shape = |x: f64| if odd { x } else { 1.0 };
        let value = |j: usize| if j < grid.first { 0.0 } else { density.unknowns[j - grid.first] };
        let last = |w: f64| grid.nodes.iter().take_while(|u| u.w < w).count() - 1;
        let (limit, signed);
        if edge == Edge::Sharp {
            limit = dot(&grid.edge_row, density.unknowns);
            let rest = |(j, x): (usize, f64)| alternating(j) * (value(j) - limit * end_shape(x));
            signed = grid.nodes[..=last(PLATEAU)].iter().map(|u| u.x).enumerate().map(rest).collect();
        } else {
            // The 1/sqrt(gap) that is to be absent is absent to a rounding of F, nearly the same at all nodes.
            let noise = grid.nodes.get(last(PLATEAU) + 1).map_or(0.0, |_| value(last(PLATEAU) + 1));
            let y = |j: usize| {
                let node = &grid.nodes[j];
                let bounded = value(j) - noise * end_shape(node.x);
                (bounded / node.sech - density.carrier * node.x) / node.sech
            };
            let end = last(USEFUL);
            limit = y(end) / end_shape(grid.nodes[end].x);
            signed = (0..=end).map(|j| alternating(j) * (y(j) - limit * end_shape(grid.nodes[j].x))).collect();
        }
        Self { grid, edge, carrier: density.carrier, limit, signed }
    }

    pub(super) fn value(&self, at: Station, half_width: f64) -> f64 {
        let (_, u) = locate(at, half_width);
        let t = at.x / half_width;
        let varying = at_nodes(&self.signed, self.grid.odd, u / self.grid.step);
        let y = if self.grid.odd { self.limit * t + varying * t.signum() } else { self.limit + varying };
        let relative = at.gap / half_width;
        let root = (relative * (2.0 - relative)).sqrt();
        match self.edge {
            Edge::Sharp => y / root,
            Edge::Smooth | Edge::Continued => self.carrier * t + y * root,
        }
    }
}
