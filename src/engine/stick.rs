//! The stick zone of a flat punch under Goodman friction: for each half-width `a` the friction
//! coefficient that belongs to it is explicit (docs/theory.md, "Stick zone").

use super::layer::Layer;
use super::normal::Pressure;
use slipzone_api::double_exponential::{self, Node};
use slipzone_api::{Component, Density, Edge, Parity, Refusal, Rule, Span, Station};
use std::f64::consts::PI;

/// A stick zone `|x| <= a`, with the width of the slip zone kept exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StickZone {
    /// `a`.
    pub(crate) half_width: f64,
    /// `b - a`.
    pub(crate) slip_width: f64,
}

impl StickZone {
    /// From `lambda = ln(a/(b - a))`, the unknown in which both ends are far away.
    pub(crate) fn from_log(lambda: f64, b: f64) -> Self {
        Self { half_width: b / (1.0 + (-lambda).exp()), slip_width: b / (1.0 + lambda.exp()) }
    }

    /// The gap to the contact's edge of a point at `gap` from the stick zone's.
    pub(crate) fn in_contact(self, station: Station) -> Station {
        Station { x: station.x, gap: station.gap + self.slip_width }
    }

    /// A point of the slip zone on a double-exponential grid over it.
    pub(crate) fn in_slip(self, node: &Node) -> Station {
        Station { x: self.half_width + node.from_lower, gap: node.to_upper }
    }
}

/// The shear traction that belongs to a stick zone.
pub(crate) struct Shear {
    pub(crate) zone: StickZone,
    /// Friction coefficient: positive for inward slip, negative for outward.
    pub(crate) friction: f64,
    rule: Box<dyn Rule>,
    unknowns: Vec<f64>,
    /// `eta p(a)`.
    at_edge: f64,
}

impl Shear {
    /// The same stick zone under another friction coefficient, `q` in proportion: right in the slip zone,
    /// and in the stick zone only where that is too narrow to matter.
    pub(crate) fn rescaled(mut self, friction: f64) -> Self {
        let factor = if friction == 0.0 { 0.0 } else { friction / self.friction };
        self.unknowns.iter_mut().for_each(|unknown| *unknown *= factor);
        Self { friction, at_edge: factor * self.at_edge, ..self }
    }

    /// The same shear in the stick zone, and another friction coefficient in the slip zone.
    pub(crate) fn sliding_at(self, friction: f64) -> Self {
        Self { friction, ..self }
    }

    /// The same densities taken to live on another zone: for a shear that vanishes.
    pub(crate) fn over(self, zone: StickZone) -> Self {
        Self { zone, ..self }
    }

    /// Shear traction in the stick zone.
    pub(crate) fn in_stick(&self, station: Station) -> f64 {
        self.rule.value(Density { unknowns: &self.unknowns, carrier: self.at_edge }, station)
    }

    /// Shear traction at any point strictly inside the contact.
    pub(crate) fn at(&self, pressure: &Pressure, station: Station) -> f64 {
        let gap = station.gap - self.zone.slip_width;
        let x = station.x.abs();
        let right = if gap > 0.0 {
            self.in_stick(Station { x, gap })
        } else {
            self.friction * pressure.at(Station { x, gap: station.gap })
        };
        if station.x < 0.0 { -right } else { right }
    }
}

/// Solves the tangential equation with the friction coefficient as one more unknown.
///
/// Inside the stick zone `q` is odd and meets `eta p(a)` at its ends; outside `q = eta p sign(x)`. The
/// equation at one collocation point more than `q` has unknowns makes the square system
/// `[ T | p(a) carrier + slip ] (q, eta) = -beta p + (1/pi) int p k_uv`. `slip_nodes`: nodes on either
/// side of the slip zone's grid.
pub(crate) fn shear(layer: &Layer, pressure: &Pressure, zone: StickZone, slip_nodes: usize) -> Result<Shear, Refusal> {
    let rule = layer.quadrature.rule(&Span::symmetric(zone.half_width, Parity::Odd, Edge::Continued))?;
    let n = rule.unknowns();
    let stations = rule.collocation().to_vec();
    let kernel = layer.kernel(Component::ShearStrain);
    let mut stick_rows = vec![0.0; n * (n + 1)];
    rule.operator_into(kernel, &mut stick_rows);
    let mut carrier = vec![0.0; n + 1];
    rule.carrier_into(kernel, &mut carrier);

    let p_edge = pressure.at(Station { x: zone.half_width, gap: zone.slip_width });
    let by_slip = slip_potential(layer, pressure, zone, &stations, slip_nodes);
    let x: Vec<f64> = stations.iter().map(|s| s.x).collect();
    let coupled = pressure.potential(layer, Component::Coupling, &x);
    let beta = layer.problem.elastic.beta();

    let mut rows = Vec::with_capacity((n + 1) * (n + 1));
    let mut right = Vec::with_capacity(n + 1);
    for (i, station) in stations.iter().enumerate() {
        rows.extend_from_slice(&stick_rows[i * n..(i + 1) * n]);
        rows.push(p_edge * carrier[i] + by_slip[i]);
        right.push(coupled[i] - beta * pressure.at(zone.in_contact(*station)));
    }
    let mut unknowns = layer.solve(&rows, &[&right])?.pop().expect("one right-hand side");
    let friction = unknowns.pop().expect("the last unknown");
    Ok(Shear { zone, friction, rule, unknowns, at_edge: friction * p_edge })
}

/// `(1/pi) int over the slip zones of p(r) sign(r) [1/(x - r) + k_uu(x - r)] dr` at each station of the
/// stick zone.
fn slip_potential(layer: &Layer, pressure: &Pressure, zone: StickZone, stations: &[Station], nodes: usize) -> Vec<f64> {
    let grid = double_exponential::nodes(zone.slip_width, nodes);
    let weighted: Vec<f64> = grid.iter().map(|node| node.weight * pressure.at(zone.in_slip(node))).collect();
    let r: Vec<f64> = grid.iter().map(|node| zone.half_width + node.from_lower).collect();
    let mut out = Vec::with_capacity(stations.len());
    for station in stations {
        let distances: Vec<f64> = r.iter().flat_map(|r| [station.x - r, station.x + r]).collect();
        let kernel = layer.kernel_values(Component::ShearStrain, &distances);
        let sum: f64 = grid
            .iter()
            .zip(&r)
            .zip(&weighted)
            .zip(kernel.chunks_exact(2))
            .map(|(((node, r), weighted), k)| {
                // 1/(x - r) - 1/(x + r), with r - x from distances to the stick zone's edge.
                weighted * (k[0] - k[1] - 2.0 * r / ((node.from_lower + station.gap) * (r + station.x)))
            })
            .sum();
        out.push(sum / PI);
    }
    out
}
