//! One density on one interval.

use super::fine::Fine;
use super::grid::Grid;
use super::map::locate;
use super::resolution::{Resolution, fine_grid};
use super::series::{alternating, at_halves};
use super::shape::Shape;
use slipzone_api::{Component, Density, Edge, KernelTable, Parts, Rule, Station};
use std::f64::consts::PI;
use std::sync::Arc;

/// Fine nodes whose kernel values are asked for at a time, together with their mirror images.
const BATCH: usize = 256;

/// Rows that are gathered from the fine grid together.
const ROWS: usize = 8;

pub(super) struct DeSincRule {
    half_width: f64,
    resolution: Resolution,
    grid: Arc<Grid>,
    /// Where the kernel is summed; changes when the interval or the kernel do.
    fine: Option<Arc<Fine>>,
    stations: Vec<Station>,
    scratch: Scratch,
}

/// Room for the kernel values of one row.
struct Scratch {
    distances: Vec<f64>,
    parts: Vec<Parts>,
    /// Kernel against a fine node and its mirror image, product weights included.
    folded: Vec<f64>,
    /// Density times step at the fine nodes.
    spread: Vec<f64>,
}

impl DeSincRule {
    pub(super) fn new(half_width: f64, resolution: Resolution, grid: Arc<Grid>) -> Self {
        let scratch = Scratch {
            distances: vec![0.0; 2 * BATCH],
            parts: vec![Parts::default(); 2 * BATCH],
            folded: Vec::new(),
            spread: Vec::new(),
        };
        let mut rule = Self { half_width, resolution, grid, fine: None, stations: Vec::new(), scratch };
        rule.stations = vec![Station { x: 0.0, gap: 0.0 }; rule.grid.staggered.len()];
        rule.stretch(half_width);
        rule
    }

    fn mirror(&self) -> f64 {
        if self.grid.odd { -1.0 } else { 1.0 }
    }

    /// The grid on which a kernel of this length is resolved.
    fn fine(&mut self, length: f64) -> Arc<Fine> {
        let factor = self.resolution.oversampling(self.half_width / length);
        match &self.fine {
            Some(fine) if fine.factor == factor => Arc::clone(fine),
            _ => {
                let fine = fine_grid(self.resolution, &self.grid, factor);
                self.fine = Some(Arc::clone(&fine));
                fine
            }
        }
    }

    /// Appends to `scratch.folded` the kernel's part of the `i`-th row, over as many fine nodes as `reach` says.
    fn fold_kernel(&mut self, fine: &Fine, i: usize, reach: usize, (table, component): (&dyn KernelTable, Component)) {
        let (c, log_c, mirror) = (self.half_width, self.half_width.ln(), self.mirror());
        let here = self.grid.staggered.get(i).map_or(1.0, |v| v.x);
        let row = fine.row(i);
        let Scratch { distances, parts, folded, .. } = &mut self.scratch;
        for start in (0..reach).step_by(BATCH) {
            let count = BATCH.min(reach - start);
            let range = start..start + count;
            for (t, minus) in distances[..count].iter_mut().zip(&row.minus[range.clone()]) {
                *t = c * minus;
            }
            for (t, x) in distances[count..2 * count].iter_mut().zip(&fine.x[range.clone()]) {
                *t = c * (here + x);
            }
            table.parts_into(component, &distances[..2 * count], &mut parts[..2 * count]);
            let (near, far) = parts[..2 * count].split_at(count);
            let near = near.iter().zip(&row.sign_minus[range.clone()]).zip(&row.log_minus[range.clone()]);
            let far = far.iter().zip(&row.sign_plus[range.clone()]).zip(&row.log_plus[range]);
            folded.extend(near.zip(far).map(|(((p, s), l), ((q, t), m))| {
                let near = p.smooth + p.sign * s + p.log * (log_c + l);
                let far = q.smooth + q.sign * t + q.log * (log_c + m);
                near + mirror * far
            }));
        }
    }
}

impl Rule for DeSincRule {
    fn unknowns(&self) -> usize {
        self.grid.unknowns()
    }

    fn collocation(&self) -> &[Station] {
        &self.stations
    }

    fn half_width(&self) -> f64 {
        self.half_width
    }

    fn stretch(&mut self, half_width: f64) {
        self.half_width = half_width;
        for (station, v) in self.stations.iter_mut().zip(&self.grid.staggered) {
            *station = Station { x: half_width * v.x, gap: half_width * v.gap };
        }
    }

    fn edge_condition(&self) -> Option<&[f64]> {
        (self.grid.edge != Edge::Sharp).then_some(self.grid.edge_row.as_slice())
    }

    fn row_scale(&self) -> Option<&[f64]> {
        Some(&self.grid.scale)
    }

    fn operator_into(&mut self, kernel: Option<(&dyn KernelTable, Component)>, rows: &mut [f64]) {
        let n = self.unknowns();
        assert_eq!(rows.len(), n * self.stations.len(), "rows = collocation points, columns = unknowns");
        rows.copy_from_slice(&self.grid.cauchy);
        let Some(kernel) = kernel else { return };
        let fine = self.fine(kernel.0.length());
        for (block, rows) in rows.chunks_mut(ROWS * n).enumerate() {
            self.scratch.folded.clear();
            let mut scale = [0.0; ROWS];
            for (within, scale) in scale[..rows.len() / n].iter_mut().enumerate() {
                let i = block * ROWS + within;
                *scale = self.half_width / PI * self.grid.scale[i];
                self.fold_kernel(&fine, i, fine.reach(i), kernel);
                self.scratch.folded.resize((within + 1) * fine.x.len(), 0.0);
            }
            fine.gather(&self.grid, &self.scratch.folded, &scale, rows);
        }
    }

    fn resultant_into(&self, row: &mut [f64]) {
        assert_eq!(row.len(), self.unknowns(), "one entry per unknown");
        for (entry, weight) in row.iter_mut().zip(&self.grid.resultant) {
            *entry = self.half_width * weight;
        }
    }

    fn values_into(&self, density: Density, at: &[Station], out: &mut [f64]) {
        assert_eq!(at.len(), out.len(), "one value per point");
        let shape = Shape::new(&self.grid, density);
        for (out, at) in out.iter_mut().zip(at) {
            *out = shape.value(*at, self.half_width);
        }
    }

    fn edge_factor(&self, unknowns: &[f64]) -> f64 {
        match self.grid.edge {
            Edge::Sharp => self.half_width * dot(&self.grid.edge_row, unknowns),
            Edge::Smooth | Edge::Continued => 0.0,
        }
    }

    fn sample_potential(&mut self, unknowns: &[f64], kernel: (&dyn KernelTable, Component), samples: &mut Vec<f64>) {
        assert_eq!(unknowns.len(), self.unknowns(), "one number per unknown");
        let fine = self.fine(kernel.0.length());
        let mut spread = std::mem::take(&mut self.scratch.spread);
        fine.spread(&self.grid, unknowns, &mut spread);
        let end = self.stations.len();
        samples.clear();
        for i in 0..=end {
            self.scratch.folded.clear();
            self.fold_kernel(&fine, i, fine.reach(end), kernel);
            samples.push(self.half_width / PI * dot(&self.scratch.folded, &spread));
        }
        self.scratch.spread = spread;
        let odd = self.grid.odd != kernel.1.is_odd();
        let edge = samples[end];
        for (i, (sample, v)) in samples.iter_mut().zip(&self.grid.staggered).enumerate() {
            *sample = alternating(i) * (*sample - edge * if odd { v.x } else { 1.0 });
        }
    }

    fn potential_at_centre(&mut self, unknowns: &[f64], (table, component): (&dyn KernelTable, Component)) -> f64 {
        assert_eq!(unknowns.len(), self.unknowns(), "one number per unknown");
        if self.grid.odd != component.is_odd() {
            return 0.0; // its two halves cancel
        }
        let fine = self.fine(table.length());
        let Scratch { distances, parts, spread, .. } = &mut self.scratch;
        fine.spread(&self.grid, unknowns, spread);
        let (c, log_c) = (self.half_width, self.half_width.ln());
        let reach = fine.reach(self.stations.len());
        let mut sum = 0.0;
        for start in (0..reach).step_by(BATCH) {
            let range = start..reach.min(start + BATCH);
            let count = range.len();
            for (t, x) in distances[..count].iter_mut().zip(&fine.x[range.clone()]) {
                *t = -c * x;
            }
            table.parts_into(component, &distances[..count], &mut parts[..count]);
            let terms = parts[..count].iter().zip(&fine.centre[range.clone()]).zip(&spread[range]);
            sum += terms.map(|((p, (s, l)), f)| f * (p.smooth - p.sign * s + p.log * (log_c + l))).sum::<f64>();
        }
        2.0 * c / PI * sum
    }

    fn potential_into(
        &mut self,
        samples: &[f64],
        kernel: (&dyn KernelTable, Component),
        targets: &[Station],
        out: &mut [f64],
    ) {
        assert_eq!(targets.len(), out.len(), "one value per target");
        let odd = self.grid.odd != kernel.1.is_odd();
        let (edge, rest) = samples.split_last().expect("samples of a potential");
        for (out, at) in out.iter_mut().zip(targets) {
            let varying = at_halves(rest, odd, locate(*at, self.half_width) / self.grid.step);
            *out = if odd { edge * at.x / self.half_width + varying * at.x.signum() } else { edge + varying };
        }
    }
}

/// Sum of products over the shorter of two slices.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
