//! The frictionless normal problem at one resolution: pressure under a punch on a contact of given half-width.

use super::lookout::Lookout;
use crate::engine::accuracy::quantity::{Numbers, Quantity, Traces};
use crate::engine::foreign;
use crate::engine::numerics::dense::Dense;
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::problem::{LoadInLayerUnits, Problem};
use crate::engine::work::Work;
use slipzone_api::double_exponential::{self, Node};
use slipzone_api::{Component, Edge, Parity, Quadrature, Refusal, Rule, Station};
use std::f64::consts::FRAC_2_PI;

/// Nodes on either side of an integral against a datum,
const DATUM_NODES: f64 = 24.0;
/// and more of them for each unit of its variable: the kernel's singularities lie `pi/2` off it.
const DATUM_NODES_PER_UNIT: f64 = 6.0;
/// and for each unknown of the pressure.
const DATUM_NODES_PER_UNKNOWN: f64 = 0.5;

/// An edge factor that is a smaller part of the mean pressure shows only closer to the edge than a two-hundredth of the
/// half-width.
const FAINT_EDGE: f64 = 0.1;

/// The pressure under one punch, in layer units; solved again for each load, in the same memory.
pub(crate) struct Normal {
    pub(crate) half_width: f64,
    pub(crate) force: f64,
    /// `lim p sqrt(b^2 - x^2)` at the edge; 0 at a smooth one.
    pub(crate) edge_factor: f64,
    edge: Edge,
    rule: Box<dyn Rule>,
    system: Dense,
    unknowns: Vec<f64>,
    /// The half-width at which the system of a sharp punch was solved.
    solved_at: Option<f64>,
    /// Depths of what was solved there, of the force and of the shape, once they were asked for.
    depths: Option<[f64; 2]>,
    /// Whether the punch is flat there: the pressure then grows with the force and does not change otherwise.
    pub(crate) is_flat: bool,
}

impl Normal {
    /// Room for the pressure under a punch whose corners fix the contact (`Sharp`) or that has none (`Smooth`).
    pub(crate) fn new(quadrature: &dyn Quadrature, edge: Edge) -> Result<Self, Refusal> {
        let rule = foreign::rule(quadrature, Parity::Even, edge)?;
        let n = rule.unknowns();
        Ok(Self {
            half_width: 1.0,
            force: 0.0,
            edge_factor: 0.0,
            edge,
            rule,
            system: Dense::new(n, 2),
            unknowns: vec![0.0; n],
            solved_at: None,
            depths: None,
            is_flat: false,
        })
    }

    /// The pressure under a punch with sharp corners: the sum of a flat punch that carries the force and of a
    /// curved face that carries none.
    pub(crate) fn press_sharp(
        &mut self,
        layer: &PreparedLayer,
        problem: &Problem,
        half_width: f64,
    ) -> Result<(), Refusal> {
        if self.solved_at != Some(half_width) {
            self.forget();
            let n = self.size();
            layer.room_for((n, 2), &*self.rule, half_width)?;
            self.stretch(half_width);
            let Self { rule, system, is_flat, .. } = self;
            system.solve(|rows, columns| {
                let (force, shape) = columns.split_at_mut(n);
                assemble(&mut **rule, layer, rows, shape, |_, at| problem.slope(at.x) / problem.elastic.a0());
                rule.resultant_into(&mut rows[n * (n - 1)..]);
                force.fill(0.0);
                force[n - 1] = 1.0;
                *is_flat = shape.iter().all(|slope| *slope == 0.0);
                if *is_flat { 1 } else { 2 }
            })?;
            self.solved_at = Some(half_width);
        }
        let load = match problem.load {
            LoadInLayerUnits::Force(force) => force,
            LoadInLayerUnits::Indentation(depth) => self.force_at(layer, problem, depth).unwrap_or(f64::NAN),
            LoadInLayerUnits::HalfWidth(_) => f64::NAN,
        };
        if !(load.is_finite() && load > 0.0) {
            return Err(Refusal::OutOfReach {
                method: "load",
                why: "no pressing force belongs to it under a punch of this width".into(),
                remedy: "prescribe the force",
            });
        }
        self.force = load;
        for (i, unknown) in self.unknowns.iter_mut().enumerate() {
            *unknown = load * self.system.column(0)[i] + self.system.column(1)[i];
        }
        self.edge_factor = self.rule.edge_factor(&self.unknowns);
        Ok(())
    }

    /// The pressure under a punch whose contact ends smoothly.
    pub(crate) fn press_smooth(
        &mut self,
        layer: &PreparedLayer,
        problem: &Problem,
        half_width: f64,
    ) -> Result<(), Refusal> {
        let n = self.size();
        layer.room_for((n, 1), &*self.rule, half_width)?;
        self.stretch(half_width);
        let Self { rule, system, .. } = self;
        system.solve(|rows, columns| {
            assemble(&mut **rule, layer, rows, columns, |_, at| problem.slope(at.x) / problem.elastic.a0());
            if let Some(condition) = rule.edge_condition() {
                rows[n * (n - 1)..].copy_from_slice(condition);
                columns[n - 1] = 0.0;
            }
            1
        })?;
        let (solution, resultant) = self.system.single();
        self.unknowns.copy_from_slice(solution);
        self.rule.resultant_into(resultant);
        self.force = resultant.iter().zip(&self.unknowns).map(|(r, u)| r * u).sum();
        self.edge_factor = 0.0;
        Ok(())
    }

    /// The pressure of unit force under a flat face with sharp corners; the surface has a slope of its own there, `A0`
    /// times what is given at each collocation point.
    pub(crate) fn press_flat(
        &mut self,
        layer: &PreparedLayer,
        half_width: f64,
        slope: impl Fn(usize) -> f64,
    ) -> Result<(), Refusal> {
        let n = self.size();
        layer.room_for((n, 1), &*self.rule, half_width)?;
        self.forget();
        self.stretch(half_width);
        let Self { rule, system, .. } = self;
        system.solve(|rows, columns| {
            assemble(&mut **rule, layer, rows, columns, |i, _| slope(i));
            rule.resultant_into(&mut rows[n * (n - 1)..]);
            columns[n - 1] = 1.0;
            1
        })?;
        self.unknowns.copy_from_slice(self.system.column(0));
        self.force = 1.0;
        self.edge_factor = self.rule.edge_factor(&self.unknowns);
        Ok(())
    }

    /// Takes the pressure of a unit force under a flat face with sharp corners for solved.
    pub(crate) fn take_flat(&mut self, half_width: f64, unknowns: impl Iterator<Item = f64>) {
        self.forget();
        self.stretch(half_width);
        self.system.take(unknowns);
        (self.solved_at, self.is_flat) = (Some(half_width), true);
    }

    /// Takes what was solved for unsolved: it was with other kernels.
    pub(crate) fn forget(&mut self) {
        (self.solved_at, self.depths) = (None, None);
    }

    fn stretch(&mut self, half_width: f64) {
        self.half_width = half_width;
        self.rule.stretch(half_width);
    }

    /// What its rule loses of kernels of such a length for want of room, relative.
    pub(crate) fn lost_for_room(&self, half_width: f64, length: f64) -> f64 {
        self.rule.lost_for_room(half_width / length)
    }

    /// Force that gives an indentation; `None` on a half-plane without a datum.
    fn force_at(&mut self, layer: &PreparedLayer, problem: &Problem, indentation: f64) -> Option<f64> {
        let [by_force, by_shape] = self.depths(layer, problem)?;
        Some((indentation - by_shape - problem.height(0.0)) / by_force)
    }

    /// The depth under a unit force, and that of the shape: they are the same under every load.
    fn depths(&mut self, layer: &PreparedLayer, problem: &Problem) -> Option<[f64; 2]> {
        if self.depths.is_none() {
            let mut sunk =
                |column| sunk(&mut *self.rule, self.half_width, (layer, problem), self.system.column(column));
            self.depths = Some([sunk(0)?, if self.is_flat { 0.0 } else { sunk(1)? }]);
        }
        self.depths
    }

    /// Depth of the punch, `delta = v(0) + g(0)`; `None` on a half-plane without a datum.
    pub(crate) fn depth(&mut self, layer: &PreparedLayer, problem: &Problem) -> Option<f64> {
        let sunk = if self.depths.is_some() || self.is_flat && self.solved_at.is_some() {
            let [by_force, by_shape] = self.depths(layer, problem)?;
            self.force * by_force + by_shape
        } else {
            sunk(&mut *self.rule, self.half_width, (layer, problem), &self.unknowns)?
        };
        Some(sunk + problem.height(0.0))
    }

    /// The same under a flat face.
    pub(crate) fn sunk_flat(&mut self, layer: &PreparedLayer, problem: &Problem) -> Option<f64> {
        sunk(&mut *self.rule, self.half_width, (layer, problem), &self.unknowns)
    }

    /// The same under a flat face as wide as `half_width` and a pressure of other unknowns.
    pub(crate) fn depth_of(
        &mut self,
        half_width: f64,
        unknowns: &[f64],
        (layer, problem): (&PreparedLayer, &Problem),
    ) -> Option<f64> {
        self.rule.stretch(half_width);
        let depth = sunk(&mut *self.rule, half_width, (layer, problem), unknowns);
        self.rule.stretch(self.half_width);
        depth
    }

    /// The points at which its equations are collocated.
    pub(crate) fn collocation(&self) -> &[Station] {
        self.rule.collocation()
    }

    /// Where the pressure is looked at for what happens between the points reported.
    pub(crate) fn look(&self, lookout: &mut Lookout) {
        lookout.at_collocation(self.half_width, self.rule.collocation());
    }

    /// Pressure at points strictly inside the contact.
    pub(crate) fn values_into(&self, at: &[Station], out: &mut [f64]) {
        self.rule.values_into(&self.unknowns, at, out);
    }

    /// Pressure at one such point.
    pub(crate) fn at(&self, station: Station) -> f64 {
        self.rule.value(&self.unknowns, station)
    }

    /// The unknowns of the pressure.
    pub(crate) fn unknowns(&self) -> &[f64] {
        &self.unknowns
    }

    /// `lim p sqrt(b^2 - x^2)/b` of a pressure of other unknowns.
    pub(crate) fn edge_factor_of(&self, unknowns: &[f64]) -> f64 {
        self.rule.edge_factor(unknowns) / self.half_width
    }

    /// A pressure of other unknowns and another half-width, at points strictly inside that contact.
    pub(crate) fn values_of(&mut self, half_width: f64, unknowns: &[f64], at: &[Station], out: &mut [f64]) {
        self.rule.stretch(half_width);
        self.rule.values_into(unknowns, at, out);
        self.rule.stretch(self.half_width);
    }

    /// Prepares `(1/pi) int p(r) k(x - r) dr` for [`Self::potential_into`]; nothing without a kernel.
    pub(crate) fn sample_potential(&mut self, layer: &PreparedLayer, component: Component, samples: &mut Vec<f64>) {
        if let Some(kernel) = layer.kernel(component) {
            self.rule.sample_potential(&self.unknowns, kernel, samples);
        }
    }

    /// That potential within the contact; zeros without a kernel.
    pub(crate) fn potential_into(
        &mut self,
        layer: &PreparedLayer,
        component: Component,
        samples: &[f64],
        at: &[Station],
        out: &mut [f64],
    ) {
        match layer.kernel(component) {
            Some(kernel) => self.rule.potential_into(samples, kernel, at, out),
            None => out.fill(0.0),
        }
    }

    /// About how far a potential of that component is off between its samples.
    pub(crate) fn lost_between_samples(&self, layer: &PreparedLayer, component: Component, samples: &[f64]) -> f64 {
        let lost = layer.kernel(component).and_then(|_| self.rule.lost_between_samples(samples, component));
        // No number is no agreement.
        lost.map_or(0.0, |lost| if lost >= 0.0 { lost } else { self.mean().abs() })
    }

    /// About how far it is off between the nodes, over the pressure there or its mean, up to a distance from the edge
    /// over the half-width; `None` where the rule does not tell.
    pub(crate) fn lost_between(&self, nearest: f64) -> Option<f64> {
        let mean = self.mean().abs();
        // Close to a sharp edge the pressure is the limit's.
        let limit = if self.is_sharp() { (self.edge_factor / self.half_width).abs() } else { mean };
        let lost = self.rule.lost_between(&self.unknowns, nearest * self.half_width)?;
        let lost = lost / limit.min(mean).max(FAINT_EDGE * mean);
        // No number is no agreement, nor is one below nothing.
        Some(if lost >= 0.0 { lost.min(1.0) } else { 1.0 })
    }

    /// The numbers of the pressure, and the pressure at [`Traces::AT`] over its mean.
    pub(crate) fn numbers(&mut self, layer: &PreparedLayer, problem: &Problem) -> (Numbers, [f64; Traces::AT.len()]) {
        let mut numbers = Numbers::default();
        let depth = if problem.wants_depth() { self.depth(layer, problem) } else { None };
        let (b, mean) = (self.half_width, self.mean());
        let ([first, second, third], mut pressure) = (Traces::stations(b), [0.0; 1 + Traces::AT.len()]);
        self.values_into(&[Station { x: 0.0, gap: b }, first, second, third], &mut pressure);
        let [centre, traced @ ..] = pressure;
        numbers.set(Quantity::Force, self.force);
        numbers.set(Quantity::HalfWidth, b);
        if problem.wishes.judges(Quantity::Centre) {
            numbers.set(Quantity::Centre, centre);
        }
        numbers.set(Quantity::Mean, mean);
        numbers.set(Quantity::StressIntensity, self.edge_factor / b.sqrt());
        numbers.set(Quantity::EdgeRatio, self.edge_factor / self.force);
        if let Some(depth) = depth {
            numbers.set(Quantity::Indentation, depth);
        }
        if problem.wishes.reports(Quantity::Peak) && !self.is_sharp() {
            let peak = Lookout::lend(|lookout| {
                self.look(lookout);
                lookout.peak(|at, out| self.values_into(at, out))
            });
            numbers.set(Quantity::Peak, peak);
        }
        (numbers, traced.map(|p| p / mean))
    }

    /// Mean pressure.
    pub(crate) fn mean(&self) -> f64 {
        self.force / (2.0 * self.half_width)
    }

    /// Number of unknowns.
    pub(crate) fn size(&self) -> usize {
        self.unknowns.len()
    }

    /// Work in its systems so far.
    pub(crate) fn work(&self) -> Work {
        self.system.work
    }

    /// Whether the contact's edge is sharp.
    pub(crate) fn is_sharp(&self) -> bool {
        self.edge == Edge::Sharp
    }
}

/// Writes the collocated equations, and slopes over `A0` as their right-hand side.
fn assemble(
    rule: &mut dyn Rule,
    layer: &PreparedLayer,
    rows: &mut [f64],
    right: &mut [f64],
    slope: impl Fn(usize, &Station) -> f64,
) {
    let collocated = rule.collocation().len() * rule.unknowns();
    rule.operator_into(layer.kernel(Component::NormalSlope), &mut rows[..collocated]);
    right.fill(0.0);
    for (i, (right, station)) in right.iter_mut().zip(rule.collocation()).enumerate() {
        *right = slope(i, station);
    }
    if let Some(scale) = rule.row_scale() {
        right.iter_mut().zip(scale).for_each(|(right, scale)| *right *= scale);
    }
}

/// How far the middle sinks under a pressure of these unknowns; `None` where depths have no meaning.
///
/// A pressure on a layer is as rough as the kernel, and the rule resolves both alike. That on a half-plane knows
/// nothing of a datum, however near: there `x = l sinh(t)`, of which the kernel of length `l` is a smooth function, by
/// a double-exponential grid in `t`.
fn sunk(
    rule: &mut dyn Rule,
    half_width: f64,
    (layer, problem): (&PreparedLayer, &Problem),
    unknowns: &[f64],
) -> Option<f64> {
    let (table, component) = layer.kernel(Component::Depth)?;
    let a0 = problem.elastic.a0();
    if problem.layer.is_grounded() {
        return Some(a0 * rule.potential_at_centre(unknowns, (table, component)));
    }
    let length = table.length();
    let end = (half_width / length).asinh();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // at most some thousand
    let grid = double_exponential::nodes(
        end,
        (DATUM_NODES + DATUM_NODES_PER_UNIT * end + DATUM_NODES_PER_UNKNOWN * unknowns.len() as f64) as usize,
    );
    let station = |node: &Node| Station {
        x: length * node.from_lower.sinh(),
        gap: 2.0 * length * (0.5 * (end + node.from_lower)).cosh() * (0.5 * node.to_upper).sinh(),
    };
    let stations: Vec<Station> = grid.iter().map(station).collect();
    let distances: Vec<f64> = stations.iter().map(|at| at.x).collect();
    let (mut pressure, mut kernel) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
    rule.values_into(unknowns, &stations, &mut pressure);
    table.values_into(component, &distances, &mut kernel);
    let terms = grid.iter().zip(&pressure).zip(&kernel);
    let sum: f64 = terms.map(|((node, p), k)| node.weight * length * node.from_lower.cosh() * p * k).sum();
    Some(a0 * (FRAC_2_PI * sum))
}
