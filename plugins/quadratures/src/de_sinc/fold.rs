//! The kernel between staggered points and fine nodes, each node together with its mirror image.

use super::fine::{Fine, Row};
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::{Component, KernelTable, PartsVec};
use std::ops::Range;

/// Distances that a table is asked for at a time: they and the parts stay in the fastest memory.
const BATCH: usize = 512;

/// What is folded.
#[derive(Clone, Copy)]
pub(super) struct Scene<'a> {
    pub(super) fine: &'a Fine,
    pub(super) half_width: f64,
    /// Factor of the mirror image.
    pub(super) mirror: f64,
    pub(super) kernel: (&'a dyn KernelTable, Component),
}

/// Room for a batch.
pub(super) struct Folder {
    /// Near distances of each stretch, then its far ones.
    distances: Vec<f64>,
    parts: PartsVec,
    waiting: Vec<Stretch>,
}

/// Some nodes of a row, and where their distances begin in the batch.
struct Stretch {
    row: usize,
    nodes: Range<usize>,
    start: usize,
}

impl Folder {
    pub(super) fn new() -> Self {
        Self { distances: vec![0.0; BATCH], parts: PartsVec::new(BATCH), waiting: Vec::new() }
    }

    /// For each of the `rows` of `fine` writes as many numbers as there are fine nodes: `k` there and `mirror k` at the
    /// mirror image, product weights included, as far as `reach` says and zeros beyond.
    pub(super) fn fold(
        &mut self,
        scene: Scene,
        rows: Range<usize>,
        reach: impl Fn(usize) -> usize,
        out: &mut Vec<f64>,
    ) {
        let count = scene.fine.x.len();
        out.resize(rows.len() * count, 0.0);
        let mut asked = 0;
        for row in rows.clone() {
            let reach = reach(row);
            out[(row - rows.start) * count..][reach..count].fill(0.0);
            for start in (0..reach).step_by(BATCH / 2) {
                let nodes = start..reach.min(start + BATCH / 2);
                if asked + 2 * nodes.len() > BATCH {
                    self.flush(scene, asked, rows.start, out);
                    asked = 0;
                }
                self.waiting.push(Stretch { row, nodes: nodes.clone(), start: asked });
                asked += 2 * nodes.len();
            }
        }
        self.flush(scene, asked, rows.start, out);
    }

    /// The kernel against each of the first `reach` fine nodes seen from the middle, product weights included.
    pub(super) fn fold_centre(
        &mut self,
        fine: &Fine,
        half_width: f64,
        (table, component): (&dyn KernelTable, Component),
        reach: usize,
        out: &mut Vec<f64>,
    ) {
        let log_c = half_width.ln();
        out.clear();
        for start in (0..reach).step_by(BATCH) {
            let nodes = start..reach.min(start + BATCH);
            let distances = &mut self.distances[..nodes.len()];
            for (t, x) in distances.iter_mut().zip(&fine.x[nodes.clone()]) {
                *t = -half_width * x;
            }
            table.parts_into(component, distances, self.parts.first(nodes.len()));
            let weights = fine.centre.0[nodes.clone()].iter().zip(&fine.centre.1[nodes.clone()]);
            let parts = self.parts.range(0..nodes.len());
            out.extend(parts.zip(weights).map(|(p, (s, l))| p.smooth - p.sign * s + p.log * (log_c + l)));
        }
    }

    /// Asks the table for all that waits.
    fn flush(&mut self, scene: Scene, asked: usize, first: usize, out: &mut [f64]) {
        let arch = Arch::new();
        let Self { distances, parts, waiting } = self;
        arch.dispatch(Measure { scene, waiting, out: distances });
        let (table, component) = scene.kernel;
        table.parts_into(component, &distances[..asked], parts.first(asked));
        arch.dispatch(Fold { scene, waiting, parts, first, out });
        waiting.clear();
    }
}

/// The distances of a batch.
struct Measure<'a> {
    scene: Scene<'a>,
    waiting: &'a [Stretch],
    out: &'a mut [f64],
}

impl WithSimd for Measure<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let (fine, c) = (self.scene.fine, self.scene.half_width);
        for Stretch { row, nodes, start } in self.waiting {
            let row = fine.row(*row);
            let (near, far) = self.out[*start..start + 2 * nodes.len()].split_at_mut(nodes.len());
            for (t, minus) in near.iter_mut().zip(&row.minus[nodes.clone()]) {
                *t = c * minus;
            }
            for (t, x) in far.iter_mut().zip(&fine.x[nodes.clone()]) {
                *t = c * (row.x + x);
            }
        }
    }
}

/// The parts of a batch put together.
struct Fold<'a> {
    scene: Scene<'a>,
    waiting: &'a [Stretch],
    parts: &'a PartsVec,
    /// Row of the first number of `out`.
    first: usize,
    out: &'a mut [f64],
}

impl WithSimd for Fold<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Scene { fine, half_width, mirror, .. } = self.scene;
        let (log_c, count) = (half_width.ln(), fine.x.len());
        for Stretch { row, nodes, start } in self.waiting {
            let out = &mut self.out[(row - self.first) * count..][nodes.clone()];
            let Row { log_minus, log_plus, sign_minus, sign_plus, .. } = fine.row(*row);
            let (near, far) = (*start..start + nodes.len(), start + nodes.len()..start + 2 * nodes.len());
            let sides = [(near, sign_minus, log_minus, 1.0), (far, sign_plus, log_plus, mirror)];
            for (i, (side, sign_weight, log_weight, factor)) in sides.into_iter().enumerate() {
                let smooth = &self.parts.smooth[side.clone()];
                let sign = self.parts.sign[side.clone()].iter().zip(&sign_weight[nodes.clone()]);
                let log = self.parts.log[side].iter().zip(&log_weight[nodes.clone()]);
                for (((out, smooth), (sign, s)), (log, l)) in out.iter_mut().zip(smooth).zip(sign).zip(log) {
                    let value = factor * (smooth + sign * s + log * (log_c + l));
                    *out = if i == 0 { value } else { *out + value };
                }
            }
        }
    }
}
