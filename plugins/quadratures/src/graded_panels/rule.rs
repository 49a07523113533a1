//! One density of a given parity on `[-half_width, half_width]`.

use super::basis::Basis;
use super::layout::Layout;
use super::mesh::Place;
use super::regular::{self, Regular};
use slipzone_api::{Component, Densities, Edge, KernelTable, Parity, Rule, Station};
use std::f64::consts::PI;
use std::sync::Arc;

/// Multiplications, of those that run side by side, that a point costs a target beside the kernel there: its distance,
/// its weight, and a panel's polynomials, one after the other. Measured under 3,000 thicknesses, 16e6 points: 20 ns,
/// where one of an elimination takes 0.5 and one of these counts a quarter of it.
const PER_POINT: u64 = 160;

/// The layout, stretched.
pub(super) struct PanelRule {
    layout: Arc<Layout>,
    half_width: f64,
    stations: Vec<Station>,
    regular: Regular,
}

impl PanelRule {
    pub(super) fn new(half_width: f64, layout: Arc<Layout>) -> Self {
        let stations = layout.angles.iter().map(|angle| station(*angle, half_width)).collect();
        Self { layout, half_width, stations, regular: Regular::default() }
    }

    fn basis(&self) -> Basis {
        self.layout.basis
    }

    /// Whether a kernel's integral over the density may be singular at the contact's end: it is sampled times
    /// `sin(theta)`.
    fn is_singular(&self, table: &dyn KernelTable) -> bool {
        self.basis().edge == Edge::Sharp && table.power().is_some()
    }

    /// Where `|x|` is on the mesh.
    fn place(&self, at: Station) -> Place {
        let angle = (2.0 * (at.gap / (2.0 * self.half_width)).max(0.0).sqrt().min(1.0).asin()).min(0.5 * PI);
        self.layout.mesh.locate(self.layout.mesh.place_of(angle))
    }
}

/// `sin(theta)` at a gap over the half-width.
fn sine(gap: f64) -> f64 {
    (gap * (2.0 - gap)).sqrt()
}

/// `x = c cos(theta)`, its gap `2 c sin^2(theta/2)` without cancellation.
fn station(angle: f64, half_width: f64) -> Station {
    Station { x: half_width * (0.5 * PI - angle).sin(), gap: 2.0 * half_width * (0.5 * angle).sin().powi(2) }
}

impl Rule for PanelRule {
    fn unknowns(&self) -> usize {
        self.layout.resultant.len()
    }

    fn collocation(&self) -> &[Station] {
        &self.stations
    }

    fn row_scale(&self) -> Option<&[f64]> {
        (self.basis().edge != Edge::Smooth).then_some(&self.layout.row_scale)
    }

    fn half_width(&self) -> f64 {
        self.half_width
    }

    fn multiplications_beside(&self, thinness: f64) -> u64 {
        let points = regular::points(&self.layout, thinness) as u64;
        PER_POINT * self.stations.len() as u64 * points
    }

    fn stretch(&mut self, half_width: f64) {
        self.half_width = half_width;
        for (out, angle) in self.stations.iter_mut().zip(&self.layout.angles) {
            *out = station(*angle, half_width);
        }
    }

    fn operator_into(&mut self, kernel: Option<(&dyn KernelTable, Component)>, rows: &mut [f64]) {
        let layout = &self.layout;
        let (n, length) = (layout.resultant.len(), rows.len() / layout.angles.len());
        assert_eq!(rows.len(), length * layout.angles.len(), "a row for each collocation point");
        let rows = rows.chunks_exact_mut(length).map(|row| &mut row[..n]).zip(layout.cauchy.chunks_exact(n));
        let Some(kernel) = kernel else {
            rows.for_each(|(row, cauchy)| row.copy_from_slice(cauchy));
            return;
        };
        for ((row, cauchy), (target, scale)) in rows.zip(layout.targets.iter().zip(&layout.row_scale)) {
            self.regular.row_into(*target, layout, self.half_width, kernel, row);
            for (out, cauchy) in row.iter_mut().zip(cauchy) {
                *out = cauchy + scale * *out;
            }
        }
    }

    fn applied_into(
        &mut self,
        _: (&dyn KernelTable, Component),
        rows: &[f64],
        densities: &Densities,
        out: &mut [[f64; 2]],
    ) {
        let (n, length) = (self.unknowns(), rows.len() / self.stations.len());
        let first = self.basis().first();
        let mesh = &self.layout.mesh;
        let nodes: Vec<f64> = (first..first + n).map(|node| mesh.node(node)).collect();
        let at: Vec<Station> = nodes.iter().map(|u| station(mesh.angle(*u), self.half_width)).collect();
        let mut given = vec![[0.0; 2]; n];
        densities(&at, &mut given);
        for (given, u) in given.iter_mut().zip(nodes) {
            let sine = if self.basis().edge == Edge::Smooth { 1.0 } else { mesh.angle(u).sin() };
            *given = given.map(|density| sine / self.basis().factor(mesh, u) * density);
        }
        // What the operator is beside its Cauchy part.
        let rows = rows.chunks_exact(length).zip(self.layout.cauchy.chunks_exact(n));
        for (out, (row, cauchy)) in out.iter_mut().zip(rows) {
            let terms = || row.iter().zip(cauchy).map(|(row, cauchy)| row - cauchy).zip(&given);
            *out = [0, 1].map(|part| terms().map(|(k, given)| k * given[part]).sum());
        }
    }

    fn resultant_into(&self, row: &mut [f64]) {
        assert_eq!(row.len(), self.unknowns(), "one entry per unknown");
        for (out, per_width) in row.iter_mut().zip(&self.layout.resultant) {
            *out = self.half_width * per_width;
        }
    }

    fn values_into(&self, unknowns: &[f64], at: &[Station], out: &mut [f64]) {
        assert_eq!(at.len(), out.len(), "one value per point");
        let mut scratch = Vec::new();
        let basis = self.basis();
        for (out, at) in out.iter_mut().zip(at) {
            let place = self.place(*at);
            let coefficient = |node| basis.coefficient(node, unknowns);
            let mesh = &self.layout.mesh;
            let polynomial = basis.factor(mesh, mesh.at(place)) * mesh.interpolate(coefficient, place, &mut scratch);
            let value =
                if basis.edge == Edge::Smooth { polynomial } else { polynomial / sine(at.gap / self.half_width) };
            *out = if at.x < 0.0 { basis.parity.mirror() * value } else { value };
        }
    }

    fn edge_factor(&self, unknowns: &[f64]) -> f64 {
        // f sqrt(gap (2c - gap)) = f c sin(theta).
        if self.basis().edge == Edge::Sharp { self.half_width * unknowns[0] } else { 0.0 }
    }

    fn sample_potential(&mut self, unknowns: &[f64], kernel: (&dyn KernelTable, Component), samples: &mut Vec<f64>) {
        let is_singular = self.is_singular(kernel.0);
        let layout = &self.layout;
        let mut row = vec![0.0; unknowns.len()];
        samples.clear();
        for node in 0..layout.mesh.nodes() {
            let u = layout.mesh.node(node);
            let scale = if is_singular { layout.mesh.angle(u).sin() } else { 1.0 };
            if scale == 0.0 {
                samples.push(0.0);
                continue;
            }
            self.regular.row_into(u, layout, self.half_width, kernel, &mut row);
            samples.push(scale * row.iter().zip(unknowns).map(|(weight, f)| weight * f).sum::<f64>());
        }
    }

    fn potential_into(
        &mut self,
        samples: &[f64],
        (table, component): (&dyn KernelTable, Component),
        targets: &[Station],
        out: &mut [f64],
    ) {
        assert_eq!(targets.len(), out.len(), "one value per target");
        let is_singular = self.is_singular(table);
        let odd = component.is_odd() == (self.basis().parity == Parity::Even);
        let mut scratch = Vec::new();
        for (out, at) in out.iter_mut().zip(targets) {
            let place = self.place(*at);
            let value = self.layout.mesh.interpolate(|node| samples[node], place, &mut scratch);
            let value = if is_singular { value / sine(at.gap / self.half_width) } else { value };
            *out = if odd && at.x < 0.0 { -value } else { value };
        }
    }
}
