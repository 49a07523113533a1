//! Sums over the nodes of the slip zone, a row of them for each station.

use pulp::{Arch, Simd, WithSimd};
use slipzone_api::Station;
use slipzone_api::elementary::LANES;

/// What of the nodes a row depends on; filled up to a multiple of [`LANES`].
#[derive(Default)]
pub(super) struct Nodes {
    /// `r - a`.
    pub(super) beyond: Vec<f64>,
    /// `r`.
    pub(super) r: Vec<f64>,
    /// What multiplies `1/((r - x) (r + x))`.
    pub(super) cauchy: Vec<f64>,
    /// What multiplies `k(r - x) + k(r + x)`.
    pub(super) kernel: Vec<f64>,
}

impl Nodes {
    /// Writes `r - x` for each node, then `r + x`, for each of the stations, whose gaps are to the end at `a`.
    pub(super) fn distances_into(&self, at: &[Station], out: &mut [f64]) {
        Arch::new().dispatch(Distances { nodes: self, at, out });
    }

    /// Writes the sum over the nodes for each of the stations, from those distances and the kernel there.
    pub(super) fn sums_into(&self, distances: &[f64], kernel: &[f64], out: &mut [f64]) {
        Arch::new().dispatch(Sums { nodes: self, distances, kernel, out });
    }
}

struct Distances<'a> {
    nodes: &'a Nodes,
    at: &'a [Station],
    out: &'a mut [f64],
}

impl WithSimd for Distances<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Nodes { beyond, r, .. } = self.nodes;
        for (at, row) in self.at.iter().zip(self.out.chunks_exact_mut(2 * r.len())) {
            let (near, far) = row.split_at_mut(r.len());
            for (t, beyond) in near.iter_mut().zip(beyond) {
                *t = beyond + at.gap;
            }
            for (t, r) in far.iter_mut().zip(r) {
                *t = r + at.x;
            }
        }
    }
}

struct Sums<'a> {
    nodes: &'a Nodes,
    distances: &'a [f64],
    kernel: &'a [f64],
    out: &'a mut [f64],
}

impl WithSimd for Sums<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        const { assert!(LANES.is_multiple_of(S::F64_LANES), "rows are filled up to whole vectors") };
        let count = self.nodes.r.len();
        let (cauchy, weight) = (S::as_simd_f64s(&self.nodes.cauchy).0, S::as_simd_f64s(&self.nodes.kernel).0);
        let rows = self.distances.chunks_exact(2 * count).zip(self.kernel.chunks_exact(2 * count));
        for (out, (distances, kernel)) in self.out.iter_mut().zip(rows) {
            let ((near, far), (k_near, k_far)) = (distances.split_at(count), kernel.split_at(count));
            let (near, far) = (S::as_simd_f64s(near).0, S::as_simd_f64s(far).0);
            let (k_near, k_far) = (S::as_simd_f64s(k_near).0, S::as_simd_f64s(k_far).0);
            let mut sum = simd.splat_f64s(0.0);
            for i in 0..cauchy.len() {
                let fraction = simd.div_f64s(cauchy[i], simd.mul_f64s(near[i], far[i]));
                let both = simd.add_f64s(k_near[i], k_far[i]);
                sum = simd.add_f64s(sum, simd.mul_add_e_f64s(weight[i], both, fraction));
            }
            *out = simd.reduce_sum_f64s(sum);
        }
    }
}
