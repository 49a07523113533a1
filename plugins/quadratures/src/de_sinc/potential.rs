//! The potential between the staggered points.

use super::series::{BATCH, Series};
use pulp::{Simd, WithSimd};
use slipzone_api::Station;
use slipzone_api::double_exponential::locate;

/// A potential at some points: what it is at the end, `edge` (times `x` where it is odd), and a sum of sinc functions.
pub(super) struct Potential<'a> {
    pub(super) half_width: f64,
    /// Step of the grid.
    pub(super) step: f64,
    pub(super) odd: bool,
    pub(super) edge: f64,
    /// `(-1)^i` times the rest of it at the staggered points.
    pub(super) signed: &'a [f64],
    pub(super) at: &'a [Station],
    pub(super) out: &'a mut [f64],
}

impl WithSimd for Potential<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { odd, edge, signed, .. } = self;
        let series = Series { signed, odd, offset: 0.5 };
        let (per_step, per_width) = (1.0 / self.step, 1.0 / self.half_width);
        let (mut t, mut sums) = ([0.0; BATCH], [0.0; BATCH]);
        for (at, out) in self.at.chunks(BATCH).zip(self.out.chunks_mut(BATCH)) {
            for (t, at) in t.iter_mut().zip(at) {
                *t = locate(*at) * per_step;
            }
            series.sums_into(simd, &t, at.len(), &mut sums);
            for ((out, at), varying) in out.iter_mut().zip(at).zip(&sums) {
                *out = if odd { edge * at.x * per_width + varying * 1.0_f64.copysign(at.x) } else { edge + varying };
            }
        }
    }
}
