//! The kernel between staggered points and fine nodes, each node together with its mirror image.

use super::fine::{Fine, Row};
use pulp::{Arch, Scalar, Simd, WithSimd};
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

/// Room for a batch, as much as was asked for so far.
#[derive(Default)]
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
            self.make_room(nodes.len());
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

    fn make_room(&mut self, distances: usize) {
        if self.distances.len() < distances {
            self.distances.resize(distances, 0.0);
            self.parts.resize(distances);
        }
    }

    /// Asks the table for all that waits.
    fn flush(&mut self, scene: Scene, asked: usize, first: usize, out: &mut [f64]) {
        self.make_room(asked);
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
    fn with_simd<S: Simd>(self, simd: S) {
        let Scene { fine, half_width, mirror, .. } = self.scene;
        let (log_c, count) = (half_width.ln(), fine.x.len());
        for Stretch { row, nodes, start } in self.waiting {
            let out = &mut self.out[(row - self.first) * count..][nodes.clone()];
            let Row { log_minus, log_plus, sign_minus, sign_plus, .. } = fine.row(*row);
            let (near, far) = (*start..start + nodes.len(), start + nodes.len()..start + 2 * nodes.len());
            let near = Side::new(self.parts, near, &sign_minus[nodes.clone()], &log_minus[nodes.clone()]);
            let far = Side::new(self.parts, far, &sign_plus[nodes.clone()], &log_plus[nodes.clone()]);
            let (whole, rest) = S::as_mut_simd_f64s(out);
            let ((near, near_rest), (far, far_rest)) = (near.split::<S>(), far.split::<S>());
            let (logs, mirrors) = (simd.splat_f64s(log_c), simd.splat_f64s(mirror));
            for (i, out) in whole.iter_mut().enumerate() {
                *out = simd.mul_add_e_f64s(mirrors, far.at(simd, logs, i), near.at(simd, logs, i));
            }
            for (i, out) in rest.iter_mut().enumerate() {
                *out = mirror * far_rest.at(Scalar::new(), log_c, i) + near_rest.at(Scalar::new(), log_c, i);
            }
        }
    }
}

/// The parts at some nodes and their weights, number by number or vector by vector.
struct Side<'a, T> {
    smooth: &'a [T],
    sign: &'a [T],
    log: &'a [T],
    sign_weight: &'a [T],
    log_weight: &'a [T],
}

impl<'a> Side<'a, f64> {
    #[inline(always)]
    fn new(parts: &'a PartsVec, range: Range<usize>, sign_weight: &'a [f64], log_weight: &'a [f64]) -> Self {
        let PartsVec { smooth, sign, log } = parts;
        let (smooth, sign, log) = (&smooth[range.clone()], &sign[range.clone()], &log[range]);
        Self { smooth, sign, log, sign_weight, log_weight }
    }

    /// As many whole vectors as there are, and the rest.
    #[inline(always)]
    fn split<S: Simd>(&self) -> (Side<'a, S::f64s>, Self) {
        let ((smooth, a), (sign, b), (log, c)) =
            (S::as_simd_f64s(self.smooth), S::as_simd_f64s(self.sign), S::as_simd_f64s(self.log));
        let ((sign_weight, d), (log_weight, e)) = (S::as_simd_f64s(self.sign_weight), S::as_simd_f64s(self.log_weight));
        let whole = Side { smooth, sign, log, sign_weight, log_weight };
        (whole, Self { smooth: a, sign: b, log: c, sign_weight: d, log_weight: e })
    }
}

impl<T: Copy> Side<'_, T> {
    #[inline(always)]
    fn at<S: Simd<f64s = T>>(&self, simd: S, log_c: T, i: usize) -> T {
        let signed = simd.mul_add_e_f64s(self.sign[i], self.sign_weight[i], self.smooth[i]);
        simd.mul_add_e_f64s(self.log[i], simd.add_f64s(log_c, self.log_weight[i]), signed)
    }
}
