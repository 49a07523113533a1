//! Integrals over the slip zone.

mod rows;
mod unit;

use super::half_plane_shear::HalfPlaneShear;
use super::stick_zone::StickZone;
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::pressure::normal::Normal;
use rows::Nodes;
use slipzone_api::elementary::LANES;
use slipzone_api::{Component, NEAREST_POLE, Station, lend};
use std::cell::Cell;
use std::f64::consts::PI;
use std::sync::Arc;
use unit::Unit;

/// Nodes on either side beside half of the unknowns of the stick zone's rule.
///
/// Measured on layers of one and of five half-widths: the stick zone changes little with two nodes less or more; the
/// shear of a rule of 32 steps was off by ten times more with 15 nodes, by three times more with 16, than with 19 and
/// more.
const NODES_BESIDE: usize = 3;
/// Fewest and most of those.
const FEWEST_NODES: usize = 6;
const MOST_BY_UNKNOWNS: usize = 24;
/// Nodes on either side per kernel length in the slip zone and per unknown of the stick zone's rule: the grid's step
/// then tells the kernel as well as the rule tells the density.
const NODES_PER_LENGTH: f64 = 0.8;
/// Most nodes per kernel length.
const MOST_PER_LENGTH: f64 = 21.0;
/// Most nodes on either side per unknown of the stick zone's rule, however short the kernel: seen from the stick zone
/// it varies over the distance from that, and the nodes crowd beside it. Like the density at an end, a pole so near to
/// the axis costs a logarithm of its distance.
///
/// Measured under flat punches on eight layers of 0.1 to 0.005 of the half-width, two friction coefficients, 1e-5 and
/// 1e-8: `1 - a/b` moves by 1e-5 of its estimate at most from this to as many nodes as there were without. A coating of
/// a thousandth reads its kernel half as often.
const MOST_PER_UNKNOWN: usize = 2;
/// Most nodes on either side.
const MOST_NODES: usize = 1 << 14;
/// Distances at which the kernel is asked for at a time, unless one station has more.
const BATCH: usize = 512;

thread_local! {
    /// Room for the distances of a batch and for the kernel there: to clear one for each grid would cost more than to
    /// fill it.
    static ROOM: Cell<[Vec<f64>; 2]> = const { Cell::new([const { Vec::new() }; 2]) };
}

/// A double-exponential grid over the slip zone `(a, b)`, of unit length.
#[derive(Default)]
pub(crate) struct SlipGrid {
    unit: Arc<Unit>,
    /// The nodes, and the end of the stick zone.
    stations: Vec<Station>,
    /// `p` there.
    pressure: Vec<f64>,
    nodes: Nodes,
    /// How many there were on either side of the middle.
    count: usize,
}

/// Nodes on either side of the middle beside a stick zone whose rule has that many unknowns, for a slip zone of that
/// width over the kernel's length.
fn nodes_for(unknowns: usize, width: f64) -> usize {
    let plain = (NODES_BESIDE + unknowns / 2).clamp(FEWEST_NODES, MOST_BY_UNKNOWNS);
    let per_length = (NODES_PER_LENGTH * unknowns as f64).min(MOST_PER_LENGTH);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a positive count; `as` saturates
    let for_kernel = (per_length * width) as usize;
    let most = MOST_PER_UNKNOWN * unknowns;
    // In powers of two, so that a search changes grids rarely.
    if for_kernel <= plain { plain } else { for_kernel.min(MOST_NODES).next_power_of_two().min(most.max(plain)) }
}

impl SlipGrid {
    fn resize(&mut self, nodes: usize) {
        // The finest grids are for the last digits.
        (self.count, self.unit) = (nodes, Unit::of(nodes, nodes < MOST_BY_UNKNOWNS));
        let n = self.unit.nodes.len();
        self.stations.resize(n + 1, Station { x: 0.0, gap: 0.0 });
        self.pressure.resize(n + 1, 0.0);
        let Nodes { beyond, r, cauchy, beside, kernel, .. } = &mut self.nodes;
        for row in [beyond, r, cauchy, beside, kernel] {
            row.clear();
            row.resize(n.next_multiple_of(LANES), 0.0);
        }
    }

    /// What is known of the tangential equation at each station of the stick zone, but for what the kernel makes of the
    /// half-plane's shear there: per unit of friction, and per unit of what does not go with it.
    ///
    /// The first is `(1/pi) int p(r) sign(r) [1/(x - r) + k_uu(x - r)] dr` over the slip zones, with `(1/pi) int p(a)
    /// Y(r)/(x - r) dr` over the stick zone; the second `(1/pi) int Z(r)/(x - r) dr` over the latter; `Y` and `Z` are
    /// those of [`HalfPlaneShear`]. Beside the stick zone's edge the Cauchy kernel is steep; what it makes of `Y` and
    /// `Z` in all of the contact is known, and what is left of `p` once they are taken off vanishes at that edge. The
    /// stations are those of a rule of so many unknowns; returns `p(a)`.
    pub(crate) fn potential_into(
        &mut self,
        layer: &PreparedLayer,
        normal: &Normal,
        known: HalfPlaneShear,
        (unknowns, at): (usize, &[Station]),
        out: &mut [[f64; 2]],
    ) -> f64 {
        let zone = known.zone;
        let nodes = nodes_for(unknowns, zone.slip_width / layer.length());
        if nodes != self.count {
            self.resize(nodes);
        }
        let at_end = self.see(normal, known);
        self.see_from_afar(zone, layer.length());

        let per_station = self.nodes.distances();
        let stations = (BATCH / per_station).clamp(1, at.len().max(1));
        lend(&ROOM, |[all_distances, all_kernel]| {
            if all_distances.len() < stations * per_station {
                all_distances.resize(stations * per_station, 0.0);
                all_kernel.resize(stations * per_station, 0.0);
            }
            for (at, out) in at.chunks(stations).zip(out.chunks_mut(stations)) {
                let distances = &mut all_distances[..at.len() * per_station];
                let kernel = &mut all_kernel[..at.len() * per_station];
                self.nodes.distances_into(at, distances);
                layer.kernel_values(Component::ShearStrain, distances, kernel);
                self.nodes.sums_into(at, distances, kernel, out);
            }
        });
        for (out, at) in out.iter_mut().zip(at) {
            let [by_friction, beside] = known.strain(*at);
            *out = [out[0] / PI + at_end * by_friction, out[1] / PI + beside];
        }
        at_end
    }

    /// The nodes of a zone and the pressure there; returns that at the end of the stick zone.
    fn see(&mut self, normal: &Normal, known: HalfPlaneShear) -> f64 {
        let zone = known.zone;
        let (a, width) = (zone.half_width, zone.slip_width);
        let (edge, inside) = self.stations.split_last_mut().expect("the end of the stick zone");
        *edge = Station { x: a, gap: width };
        for (station, node) in inside.iter_mut().zip(&self.unit.nodes) {
            *station = zone.in_slip(node);
        }
        normal.values_into(&self.stations, &mut self.pressure);
        let (at_end, inside) = self.pressure.split_last().expect("that at the end of the stick zone");
        self.nodes.weigh(&self.unit.nodes, inside, *at_end, known);
        // What fills the nodes up stands anywhere within the reach and weighs nothing.
        self.nodes.r[self.unit.nodes.len()..].fill(a);
        self.nodes.beyond[self.unit.nodes.len()..].fill(0.0);
        *at_end
    }

    /// Where the kernel is asked for on the other side of the contact, and what multiplies it there.
    fn see_from_afar(&mut self, zone: StickZone, length: f64) {
        let (a, width) = (zone.half_width, zone.slip_width);
        let Nodes { r, kernel, far, far_kernel, .. } = &mut self.nodes;
        far.clear();
        far_kernel.clear();
        if a.min(NEAREST_POLE * length) > unit::APART * width {
            far.extend(self.unit.points.iter().map(|point| a + width * point));
            far_kernel.extend(
                self.unit.shares.iter().map(|share| share.iter().zip(&*kernel).map(|(s, k)| s * k).sum::<f64>()),
            );
        } else {
            far.extend_from_slice(r);
            far_kernel.extend_from_slice(kernel);
        }
    }
}
