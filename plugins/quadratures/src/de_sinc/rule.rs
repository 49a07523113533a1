//! One density on one interval.

use super::fine::Fine;
use super::fold::Folding;
use super::grid::Grid;
use super::potential::Potential;
use super::resolution::{Resolution, fine_grid};
use super::series::{Series, alternating};
use super::shape::Shape;
use super::sums::{dot, dots};
use pulp::Arch;
use slipzone_api::{Component, Densities, Edge, KernelTable, Rule, Station, lend};
use std::cell::Cell;
use std::f64::consts::PI;
use std::sync::Arc;

/// Rows that are gathered from the fine grid together.
const ROWS: usize = 8;

pub(super) struct DeSincRule {
    half_width: f64,
    resolution: Resolution,
    grid: Arc<Grid>,
    /// Where the kernel is summed, and the interval over the kernel's length that it serves.
    fine: Option<(f64, Arc<Fine>)>,
    stations: Vec<Station>,
}

thread_local! {
    /// Those of this thread, unless they are in use: one rule after another takes the same.
    static SCRATCH: Cell<Scratch> = Cell::default();
    static DENSITY: Cell<Vec<f64>> = const { Cell::new(Vec::new()) };
}

/// Room for the kernel part.
#[derive(Default)]
struct Scratch {
    /// Kernel against a fine node and its mirror image, product weights included.
    folded: Vec<f64>,
    /// Density times step at the fine nodes.
    spread: Vec<f64>,
    /// Where densities are given, and these.
    nodes: Vec<Station>,
    given: Vec<[f64; 2]>,
}

impl DeSincRule {
    pub(super) fn new(half_width: f64, resolution: Resolution, grid: Arc<Grid>) -> Self {
        let stations = vec![Station { x: 0.0, gap: 0.0 }; grid.staggered.len()];
        let mut rule = Self { half_width, resolution, grid, fine: None, stations };
        rule.stretch(half_width);
        rule
    }

    /// The grid on which a kernel of this length is resolved.
    fn fine(&mut self, length: f64) -> Arc<Fine> {
        let thinness = self.half_width / length;
        let known = self.fine.as_ref();
        if let Some((_, fine)) = known.filter(|(served, _)| served.to_bits() == thinness.to_bits()) {
            return Arc::clone(fine);
        }
        let factor = self.resolution.oversampling(thinness);
        let fine = match known {
            Some((_, fine)) if fine.factor == factor => Arc::clone(fine),
            _ => fine_grid(self.resolution, &self.grid, factor),
        };
        self.fine = Some((thinness, Arc::clone(&fine)));
        fine
    }

    /// A kernel summed over fine nodes.
    fn folding<'a>(&self, fine: &'a Fine, kernel: (&'a dyn KernelTable, Component)) -> Folding<'a> {
        Folding {
            fine,
            half_width: self.half_width,
            mirror: if self.grid.odd { -1.0 } else { 1.0 },
            kernel,
            whole: false,
        }
    }

    /// Lends a density made ready for evaluation.
    fn shaped<T>(&self, unknowns: &[f64], work: impl FnOnce(Shape) -> T) -> T {
        lend(&DENSITY, |room| work(Shape::new(&self.grid, unknowns, room)))
    }
}

impl Rule for DeSincRule {
    fn lost_for_room(&self, thinness: f64) -> f64 {
        self.resolution.lost_for_room(thinness)
    }

    fn multiplications_beside(&self, thinness: f64) -> u64 {
        let (rows, finer) = (self.stations.len(), self.resolution.oversampling(thinness) - 1);
        (rows * rows * finer * self.unknowns()) as u64
    }

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
        let (n, length) = (self.unknowns(), rows.len() / self.stations.len());
        assert_eq!(rows.len(), length * self.stations.len(), "a row for each collocation point");
        let Some(kernel) = kernel else {
            let cauchy = self.grid.cauchy.chunks_exact(n);
            rows.chunks_exact_mut(length).zip(cauchy).for_each(|(row, cauchy)| row[..n].copy_from_slice(cauchy));
            return;
        };
        let fine = self.fine(kernel.0.length());
        let folding = self.folding(&fine, kernel);
        let mut scale = [0.0; ROWS];
        lend(&SCRATCH, |Scratch { folded, .. }| {
            for (block, rows) in rows.chunks_mut(ROWS * length).enumerate() {
                let here = block * ROWS..block * ROWS + rows.len() / length;
                for (scale, row) in scale.iter_mut().zip(&self.grid.scale[here.clone()]) {
                    *scale = self.half_width / PI * row;
                }
                let cauchy = &self.grid.cauchy[here.start * n..here.end * n];
                let folded = folding.fold(here, folded);
                fine.gather(&self.grid, (cauchy, folded), &scale, (block * ROWS, rows, length));
            }
        });
    }

    fn applied_into(
        &mut self,
        kernel: (&dyn KernelTable, Component),
        rows: &[f64],
        densities: &Densities,
        out: &mut [[f64; 2]],
    ) {
        let (n, length) = (self.unknowns(), rows.len() / self.stations.len());
        let fine = self.fine(kernel.0.length());
        let inner = &self.grid.nodes[self.grid.first..][..n];
        lend(&SCRATCH, |Scratch { spread, nodes, given, .. }| {
            nodes.clear();
            nodes.extend(inner.iter().map(|u| Station { x: self.half_width * u.x, gap: self.half_width * u.gap }));
            given.resize(n, [0.0; 2]);
            densities(nodes, given);
            spread.clear();
            for part in 0..2 {
                spread.extend(inner.iter().zip(&*given).map(|(u, given)| u.sech * given[part]));
                fine.end_finite(&mut spread[part * n..]);
            }
            let (one, other) = spread.split_at(n);
            // What the operator is beside its Cauchy part.
            let rows = rows.chunks_exact(length).zip(self.grid.cauchy.chunks_exact(n));
            for (out, (row, cauchy)) in out.iter_mut().zip(rows) {
                *out = dots((&row[..n], cauchy), [one, other]);
            }
        });
    }

    fn resultant_into(&self, row: &mut [f64]) {
        assert_eq!(row.len(), self.unknowns(), "one entry per unknown");
        for (entry, weight) in row.iter_mut().zip(&self.grid.resultant) {
            *entry = self.half_width * weight;
        }
    }

    fn values_into(&self, unknowns: &[f64], at: &[Station], out: &mut [f64]) {
        assert_eq!(at.len(), out.len(), "one value per point");
        self.shaped(unknowns, |shape| shape.values_into(at, self.half_width, out));
    }

    fn lost_between(&self, unknowns: &[f64], nearest: f64) -> Option<f64> {
        Some(self.shaped(unknowns, |shape| shape.lost_between() + shape.lost_at_end(nearest / self.half_width)))
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
        let folding = Folding { whole: true, ..self.folding(&fine, kernel) };
        let end = self.stations.len();
        samples.clear();
        samples.reserve(end + 1);
        lend(&SCRATCH, |Scratch { folded, spread, .. }| {
            fine.spread(&self.grid, unknowns, spread);
            for first in (0..=end).step_by(ROWS) {
                let rows = folding.fold(first..(end + 1).min(first + ROWS), folded).chunks_exact(spread.len());
                samples.extend(rows.map(|row| self.half_width / PI * dot(row, spread)));
            }
        });
        let odd = self.grid.odd != kernel.1.is_odd();
        let edge = samples[end];
        for (i, (sample, v)) in samples.iter_mut().zip(&self.grid.staggered).enumerate() {
            *sample = alternating(i) * (*sample - edge * if odd { v.x } else { 1.0 });
        }
    }

    fn lost_between_samples(&self, samples: &[f64], component: Component) -> Option<f64> {
        let (_, signed) = samples.split_last()?;
        Some(Series { signed, odd: self.grid.odd != component.is_odd(), offset: 0.5 }.lost_between())
    }

    fn potential_at_centre(&mut self, unknowns: &[f64], (table, component): (&dyn KernelTable, Component)) -> f64 {
        assert_eq!(unknowns.len(), self.unknowns(), "one number per unknown");
        if self.grid.odd != component.is_odd() {
            return 0.0; // its two halves cancel
        }
        let fine = self.fine(table.length());
        let folding = self.folding(&fine, (table, component));
        lend(&SCRATCH, |Scratch { folded, spread, .. }| {
            fine.spread(&self.grid, unknowns, spread);
            folding.fold_centre(folded);
            2.0 * self.half_width / PI * dot(folded, spread)
        })
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
        let (half_width, step) = (self.half_width, self.grid.step);
        Arch::new().dispatch(Potential { half_width, step, odd, edge: *edge, signed: rest, at: targets, out });
    }
}
