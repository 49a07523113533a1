//! The density between its nodes.

use super::grid::Grid;
use super::map::locate;
use super::series::{alternating, at_nodes};
use super::sums::dot;
use slipzone_api::{Density, Edge, Station};

/// From here on `F` of a sharp edge is its own limit to rounding: what is left is `gap log gap`,
/// `gap/c = 2 exp(-2 w)`.
const PLATEAU: f64 = 20.0;

/// A density made ready for evaluation, with `s = sqrt(1 - x^2)` and `y` a sum of sinc functions:
/// `f = (limit + y)/s` at sharp edges, `s limit + sqrt(s) y` at smooth ones, `carrier x + s limit + y` at continued
/// ones; `limit` times `x` where `f` is odd. The root of `s` shares the error of a series cut short between the
/// middle, where it rings, and the end, where `f` is small.
pub(super) struct Shape<'a> {
    grid: &'a Grid,
    carrier: f64,
    limit: f64,
    /// `(-1)^j y_j`, up to where it is all rounding.
    signed: &'a [f64],
}

impl<'a> Shape<'a> {
    /// `room` is scratch.
    pub(super) fn new(grid: &'a Grid, density: Density, room: &'a mut Vec<f64>) -> Self {
        assert_eq!(density.unknowns.len(), grid.unknowns(), "one number per unknown");
        let value = |j: usize| if j < grid.first { 0.0 } else { density.unknowns[j - grid.first] };
        let y = room;
        y.clear();
        y.extend((0..grid.nodes.len()).map(value));
        let limit = if grid.edge == Edge::Sharp {
            y.truncate(grid.nodes.iter().take_while(|u| u.w < PLATEAU).count());
            dot(&grid.edge_row, density.unknowns)
        } else {
            bound(y, grid, density.carrier)
        };
        for (j, (y, u)) in y.iter_mut().zip(&grid.nodes).enumerate() {
            let ending = limit * grid.ending(u.x);
            *y = alternating(j)
                * match grid.edge {
                    Edge::Sharp => *y - ending,
                    Edge::Smooth => (*y / (u.sech * u.sech) - ending) * u.sech.sqrt(),
                    Edge::Continued => *y / u.sech - ending * u.sech,
                };
        }
        Self { grid, carrier: density.carrier, limit, signed: y.as_slice() }
    }

    pub(super) fn value(&self, at: Station, half_width: f64) -> f64 {
        let t = at.x / half_width;
        let (limit, sign) = if self.grid.odd { (self.limit * t, t.signum()) } else { (self.limit, 1.0) };
        let varying = sign * at_nodes(self.signed, self.grid.odd, locate(at, half_width) / self.grid.step);
        let relative = at.gap / half_width;
        let root = (relative * (2.0 - relative)).sqrt();
        match self.grid.edge {
            Edge::Sharp => (limit + varying) / root,
            Edge::Smooth => root * limit + root.sqrt() * varying,
            Edge::Continued => self.carrier * t + root * limit + varying,
        }
    }
}

/// Takes the carrier and the noise off `F` and cuts it where nothing else is left; returns `lim F/(1 - x^2)`.
///
/// The singular density that is to be absent is absent up to an error `e` only, and adds nearly the same
/// number to `F` at all nodes; what stays of it once that is taken off is half of `e` or less. It counts as
/// `e exp(w)` in `f`. The first term left out behind the cut counts as `exp(-2 w)` (continued: `f` is
/// regular `+ sqrt(gap)`) or `exp(-3 w)` (smooth), which is as much where `F ~ exp(-2 w)` is `e^(2/3)` or `e^(1/2)`.
fn bound(f: &mut Vec<f64>, grid: &Grid, carrier: f64) -> f64 {
    for (f, u) in f.iter_mut().zip(&grid.nodes) {
        *f -= carrier * u.x * u.sech;
    }
    // The very last nodes feel the missing ones.
    let n = f.len() - 1;
    let noise = f[n - 1 - n / 16];
    for (f, u) in f.iter_mut().zip(&grid.nodes) {
        *f -= noise * grid.ending(u.x);
    }
    let largest = f.iter().fold(0.0_f64, |most, f| most.max(f.abs()));
    let rest = 0.5 * noise.abs() + 0.2 * f64::EPSILON * largest;
    let exponent = if grid.edge == Edge::Smooth { 0.5 } else { 2.0 / 3.0 };
    let least = largest * (rest / largest).powf(exponent);
    let end = (1..n).rev().find(|j| f[*j].abs() > least).unwrap_or(1);
    f.truncate(end + 1);
    f[end] / (grid.nodes[end].sech.powi(2) * grid.ending(grid.nodes[end].x))
}
