//! Integrals over the slip zone.

use super::layer::Layer;
use super::normal::Normal;
use super::stick_zone::StickZone;
use slipzone_api::double_exponential::{self, Node};
use slipzone_api::{Component, Station};
use std::f64::consts::PI;

/// Nodes on either side: at least, at most, and beside a third of the unknowns of the stick zone's rule.
///
/// Measured on half-planes with a/b from 1e-4 to 1 - 1e-11: errors of eta of 1e-8, 1e-10, 1e-11, 1e-12 with 10,
/// 12, 14, 16 nodes up to [`END`].
const NODES: (usize, usize, usize) = (8, 24, 6);
/// Where the grid ends in `u`; what is left out, `exp(-(pi/2) sinh u)`, is 3e-13 of the pressure.
const END: f64 = 3.6;
/// Nodes on either side per kernel length in the slip zone and per unknown of the stick zone's rule, and what
/// that grows to: the grid's step then tells the kernel as well as the rule tells the density.
const NODES_PER_LENGTH: (f64, f64) = (0.8, 21.0);
/// Most nodes on either side.
const MOST_NODES: usize = 1 << 14;

/// A double-exponential grid over the slip zone `(a, b)`, of unit length, and room for what is summed over it.
pub(crate) struct SlipGrid {
    resolution: usize,
    grid: Vec<Node>,
    pressure_at_stick_edge: f64,
    stations: Vec<Station>,
    /// `p` at the nodes.
    pressure: Vec<f64>,
    distances: Vec<f64>,
    kernel: Vec<f64>,
}

impl SlipGrid {
    /// A grid as fine as a rule of that many unknowns.
    pub(crate) fn new(unknowns: usize) -> Self {
        let mut empty = Self {
            resolution: unknowns,
            grid: Vec::new(),
            pressure_at_stick_edge: 0.0,
            stations: Vec::new(),
            pressure: Vec::new(),
            distances: Vec::new(),
            kernel: Vec::new(),
        };
        empty.resize(empty.nodes_for(0.0));
        empty
    }

    /// Nodes on either side for a slip zone of that width over the kernel's length.
    fn nodes_for(&self, width: f64) -> usize {
        let (least, most, beside) = NODES;
        let plain = (beside + self.resolution / 3).clamp(least, most);
        let per_length = (NODES_PER_LENGTH.0 * self.resolution as f64).min(NODES_PER_LENGTH.1);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a positive count; `as` saturates
        let for_kernel = (per_length * width) as usize;
        // In powers of two, so that a search changes grids rarely.
        if for_kernel <= plain { plain } else { for_kernel.next_power_of_two().min(MOST_NODES) }
    }

    fn resize(&mut self, nodes: usize) {
        // The finest grids are for the last digits.
        let end = if nodes < NODES.1 { END } else { double_exponential::U_MAX };
        self.grid = double_exponential::nodes_up_to(1.0, nodes, end);
        let n = self.grid.len();
        self.stations = vec![Station { x: 0.0, gap: 0.0 }; n];
        self.pressure = vec![0.0; n];
        self.distances = vec![0.0; 2 * n];
        self.kernel = vec![0.0; 2 * n];
    }

    /// `p(a)` of the zone last seen.
    pub(crate) fn pressure_at_stick_edge(&self) -> f64 {
        self.pressure_at_stick_edge
    }

    /// `(1/pi) int over the slip zones of p(r) sign(r) [1/(x - r) + k_uu(x - r)] dr` at each station of the
    /// stick zone.
    ///
    /// Beside the stick zone's edge the Cauchy kernel is steep; what it makes of the constant `p(a)` is
    /// `-p(a) ln((b^2 - x^2)/(a^2 - x^2))`, and what is left of `p` vanishes at that edge.
    pub(crate) fn potential_into(
        &mut self,
        layer: &Layer,
        normal: &Normal,
        zone: StickZone,
        at: &[Station],
        out: &mut [f64],
    ) {
        let nodes = self.nodes_for(zone.slip_width / layer.length());
        if 2 * nodes + 1 != self.grid.len() {
            self.resize(nodes);
        }
        let (a, width) = (zone.half_width, zone.slip_width);
        for (station, node) in self.stations.iter_mut().zip(&self.grid) {
            *station = zone.in_slip(node);
        }
        normal.values_into(&self.stations, &mut self.pressure);
        let edge = normal.at(Station { x: a, gap: width });
        self.pressure_at_stick_edge = edge;

        let n = self.grid.len();
        for (out, station) in out.iter_mut().zip(at) {
            let (x, gap) = (station.x, station.gap);
            for (k, (node, r)) in self.grid.iter().zip(&self.stations).enumerate() {
                self.distances[k] = -(width * node.from_lower + gap);
                self.distances[n + k] = x + r.x;
            }
            layer.kernel_values(Component::ShearStrain, &self.distances, &mut self.kernel);
            let mut sum = 0.0;
            for (k, (node, p)) in self.grid.iter().zip(&self.pressure).enumerate() {
                let r = a + width * node.from_lower;
                // 1/(x - r) - 1/(x + r), with r - x from distances to the stick zone's edge.
                let cauchy = -2.0 * r / ((width * node.from_lower + gap) * (r + x));
                sum += node.weight * ((p - edge) * cauchy + p * (self.kernel[k] - self.kernel[n + k]));
            }
            let constant = -(width * (2.0 * a + width) / (gap * (2.0 * a - gap))).ln_1p();
            *out = (width * sum + edge * constant) / PI;
        }
    }
}
