//! The kernel between staggered points and fine nodes, each node together with its mirror image.

use super::fine::{Fine, Row, Rows};
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::elementary::LANES;
use slipzone_api::{Component, KernelTable, PartsVec, lend};
use std::cell::Cell;
use std::ops::Range;

/// Distances that a table is asked for at a time: they and the parts stay in the fastest memory.
const BATCH: usize = 512;

/// What is folded.
#[derive(Clone, Copy)]
pub(super) struct Folding<'a> {
    pub(super) fine: &'a Fine,
    pub(super) half_width: f64,
    /// Factor of the mirror image.
    pub(super) mirror: f64,
    pub(super) kernel: (&'a dyn KernelTable, Component),
    /// Whether all rows reach as far as that of the end.
    pub(super) whole: bool,
}

thread_local! {
    /// The room of this thread, unless it is in use: to clear one for each rule would cost more than to fill it.
    static ROOM: Cell<Option<Box<Room>>> = const { Cell::new(None) };
}

struct Room {
    asked: Asked,
    /// Rows of a fine grid that does not hold them.
    rows: Vec<f64>,
}

/// What a table is asked for.
struct Asked {
    /// Near distances of each row, then its far ones.
    distances: [f64; BATCH],
    parts: PartsVec,
}

impl Room {
    /// Lends the room of this thread.
    fn lend(work: impl FnOnce(&mut Self)) {
        let new = || {
            let asked = Asked { distances: [0.0; BATCH], parts: PartsVec::new(BATCH) };
            Box::new(Self { asked, rows: Vec::new() })
        };
        lend(&ROOM, |room| work(room.get_or_insert_with(new)));
    }
}

/// Rows whose distances fit into the room, and which nodes of them: the rows end with their reach.
struct Batch<'a> {
    of: Rows<'a>,
    rows: Range<usize>,
    nodes: Range<usize>,
}

impl Folding<'_> {
    /// For each of the `rows` as many numbers as there are fine nodes, filled up: `k` there and `mirror k` at
    /// the mirror image, product weights included, as far as the row reaches and zeros beyond.
    pub(super) fn fold(self, rows: Range<usize>, room: &mut Vec<f64>) -> &[f64] {
        let count = self.fine.x.len();
        if room.len() < rows.len() * count {
            room.resize(rows.len() * count, 0.0);
        }
        let out = &mut room[..rows.len() * count];
        Room::lend(|Room { asked: room, rows: written }| {
            let of = self.fine.rows_of(rows.clone(), self.whole, written);
            let mut row = rows.start;
            while row < rows.end {
                let first = row;
                let (mut asked, reach) = (0, self.reach(row));
                while row < rows.end && asked + 2 * self.reach(row) <= BATCH {
                    let reach = self.reach(row);
                    out[(row - rows.start) * count..][reach..count].fill(0.0);
                    asked += 2 * reach;
                    row += 1;
                }
                if first < row {
                    self.fold_batch(room, &Batch { of, rows: first..row, nodes: 0..count }, asked, rows.start, out);
                    continue;
                }
                // Too long a row for one batch.
                row += 1;
                out[(first - rows.start) * count..][reach..count].fill(0.0);
                for start in (0..reach).step_by(BATCH / 2) {
                    let nodes = start..reach.min(start + BATCH / 2);
                    let asked = 2 * nodes.len();
                    self.fold_batch(room, &Batch { of, rows: first..row, nodes }, asked, rows.start, out);
                }
            }
        });
        out
    }

    /// Folds a batch, which takes `asked` distances; the first number of `out` belongs to row `first`.
    fn fold_batch(self, room: &mut Asked, batch: &Batch, asked: usize, first: usize, out: &mut [f64]) {
        let arch = Arch::new();
        let Asked { distances, parts } = room;
        arch.dispatch(Measure { folding: self, batch, out: &mut distances[..asked] });
        let (table, component) = self.kernel;
        table.parts_into(component, &distances[..asked], parts.first(asked));
        arch.dispatch(Fold { folding: self, batch, parts, first, out });
    }

    /// The kernel against each of the fine nodes that matter seen from the middle, product weights included.
    pub(super) fn fold_centre(self, out: &mut Vec<f64>) {
        let Self { fine, half_width, kernel: (table, component), .. } = self;
        let (log_c, reach) = (half_width.ln(), fine.reach(fine.rows()));
        out.clear();
        Room::lend(|Room { asked: Asked { distances, parts }, .. }| {
            for start in (0..reach).step_by(BATCH) {
                let nodes = start..reach.min(start + BATCH);
                let distances = &mut distances[..nodes.len()];
                for (t, x) in distances.iter_mut().zip(&fine.x[nodes.clone()]) {
                    *t = -half_width * x;
                }
                table.parts_into(component, distances, parts.first(nodes.len()));
                let weights = fine.centre.0[nodes.clone()].iter().zip(&fine.centre.1[nodes.clone()]);
                let parts = parts.range(0..nodes.len());
                out.extend(parts.zip(weights).map(|(p, (s, l))| p.smooth - p.sign * s + p.log * (log_c + l)));
            }
        });
    }

    /// How many of the nodes of a row matter.
    #[inline(always)]
    fn reach(&self, row: usize) -> usize {
        self.fine.reach(if self.whole { self.fine.rows() } else { row })
    }
}

impl Batch<'_> {
    /// The nodes of one of the rows.
    #[inline(always)]
    fn nodes(&self, folding: &Folding, row: usize) -> Range<usize> {
        self.nodes.start..self.nodes.end.min(folding.reach(row))
    }
}

/// The distances of a batch.
struct Measure<'a> {
    folding: Folding<'a>,
    batch: &'a Batch<'a>,
    out: &'a mut [f64],
}

impl WithSimd for Measure<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        const { assert!(LANES.is_multiple_of(S::F64_LANES), "rows are filled up to whole vectors") };
        let Self { folding, batch, mut out } = self;
        let (fine, c) = (folding.fine, simd.splat_f64s(folding.half_width));
        for row in batch.rows.clone() {
            let nodes = batch.nodes(&folding, row);
            let (x, minus) = batch.of.minus(row, nodes.clone());
            let (here, later) = out.split_at_mut(2 * nodes.len());
            let (near, far) = here.split_at_mut(nodes.len());
            let ((near, _), (far, _)) = (S::as_mut_simd_f64s(near), S::as_mut_simd_f64s(far));
            let ((minus, _), (nodes, _)) = (S::as_simd_f64s(minus), S::as_simd_f64s(&fine.x[nodes]));
            let shift = simd.splat_f64s(folding.half_width * x);
            for (((near, far), minus), node) in near.iter_mut().zip(far).zip(minus).zip(nodes) {
                *near = simd.mul_f64s(c, *minus);
                *far = simd.mul_add_e_f64s(c, *node, shift);
            }
            out = later;
        }
    }
}

/// The parts of a batch put together.
struct Fold<'a> {
    folding: Folding<'a>,
    batch: &'a Batch<'a>,
    parts: &'a PartsVec,
    /// Row of the first number of `out`.
    first: usize,
    out: &'a mut [f64],
}

impl WithSimd for Fold<'_> {
    type Output = ();

    #[allow(clippy::needless_range_loop)] // one index for eleven slices of one length
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { folding, batch, parts, first, out } = self;
        let Folding { fine, half_width, mirror, .. } = folding;
        let (log_c, mirror) = (simd.splat_f64s(half_width.ln()), simd.splat_f64s(mirror));
        let mut start = 0;
        for row in batch.rows.clone() {
            let nodes = batch.nodes(&folding, row);
            let count = nodes.len();
            let out = &mut out[(row - first) * fine.x.len()..][nodes.clone()];
            let Row { log_minus, log_plus, sign_minus, sign_plus, beyond } = batch.of.row(row, nodes);
            let wide = S::as_mut_simd_f64s(&mut *out).0;
            let near = Side::new::<S>(parts, start..start + count, sign_minus, log_minus, wide.len());
            let far = Side::new::<S>(parts, start + count..start + 2 * count, sign_plus, log_plus, wide.len());
            for i in 0..wide.len() {
                wide[i] = simd.mul_add_e_f64s(mirror, far.at(simd, log_c, i), near.at(simd, log_c, i));
            }
            if let Some((last, [near, far])) = beyond {
                let signs = &parts.sign[start..];
                out[last] += near * signs[last] + folding.mirror * far * signs[count + last];
            }
            start += 2 * count;
        }
    }
}

/// The parts at some nodes and their weights, vector by vector.
struct Side<'a, T> {
    smooth: &'a [T],
    sign: &'a [T],
    log: &'a [T],
    sign_weight: &'a [T],
    log_weight: &'a [T],
}

impl<'a, T> Side<'a, T> {
    #[inline(always)]
    fn new<S: Simd<f64s = T>>(
        parts: &'a PartsVec,
        range: Range<usize>,
        sign_weight: &'a [f64],
        log_weight: &'a [f64],
        vectors: usize,
    ) -> Self {
        // Cut to one length that the compiler knows: no index is checked in the loop.
        let smooth = &S::as_simd_f64s(&parts.smooth[range.clone()]).0[..vectors];
        let sign = &S::as_simd_f64s(&parts.sign[range.clone()]).0[..vectors];
        let log = &S::as_simd_f64s(&parts.log[range]).0[..vectors];
        let sign_weight = &S::as_simd_f64s(sign_weight).0[..vectors];
        let log_weight = &S::as_simd_f64s(log_weight).0[..vectors];
        Self { smooth, sign, log, sign_weight, log_weight }
    }
}

impl<T: Copy> Side<'_, T> {
    #[inline(always)]
    fn at<S: Simd<f64s = T>>(&self, simd: S, log_c: T, i: usize) -> T {
        let signed = simd.mul_add_e_f64s(self.sign[i], self.sign_weight[i], self.smooth[i]);
        simd.mul_add_e_f64s(self.log[i], simd.add_f64s(log_c, self.log_weight[i]), signed)
    }
}
