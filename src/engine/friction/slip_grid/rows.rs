//! Sums over the nodes of the slip zone, a row of them for each station.

use crate::engine::friction::half_plane_shear::HalfPlaneShear;
use crate::engine::friction::stick_zone::StickZone;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::Station;
use slipzone_api::double_exponential::Node;
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
    /// The same, in the sum of what does not go with the friction.
    pub(super) beside: Vec<f64>,
    /// What multiplies `k(r - x)`.
    pub(super) kernel: Vec<f64>,
    /// `r` where `k(r + x)` is asked for: as many, or fewer.
    pub(super) far: Vec<f64>,
    /// What multiplies `k(r + x)` there.
    pub(super) far_kernel: Vec<f64>,
}

impl Nodes {
    /// Fills in what belongs to the nodes of a unit grid, from the pressure there and at the end of the stick zone.
    pub(super) fn weigh(&mut self, grid: &[Node], pressure: &[f64], at_end: f64, known: HalfPlaneShear) {
        Arch::new().dispatch(Weigh { nodes: self, grid, pressure, at_end, known });
    }

    /// Distances in a row.
    pub(super) fn distances(&self) -> usize {
        self.r.len() + self.far.len()
    }

    /// Writes `r - x` for each node, then `r + x` where the kernel is asked for, for each of the stations, whose gaps
    /// are to the end at `a`.
    pub(super) fn distances_into(&self, at: &[Station], out: &mut [f64]) {
        Arch::new().dispatch(Distances { nodes: self, at, out });
    }

    /// Writes both sums over the nodes for each of the stations, from those distances and the kernel there.
    pub(super) fn sums_into(&self, at: &[Station], distances: &[f64], kernel: &[f64], out: &mut [[f64; 2]]) {
        Arch::new().dispatch(Sums { nodes: self, at, distances, kernel, out });
    }
}

struct Weigh<'a> {
    nodes: &'a mut Nodes,
    grid: &'a [Node],
    pressure: &'a [f64],
    at_end: f64,
    known: HalfPlaneShear,
}

impl WithSimd for Weigh<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { nodes, grid, pressure, at_end, known } = self;
        let Nodes { beyond, r, cauchy, beside, kernel, .. } = nodes;
        let StickZone { half_width: a, slip_width: width } = known.zone;
        let rows = beyond.iter_mut().zip(r).zip(cauchy).zip(beside).zip(kernel);
        for (((((beyond, r), cauchy), beside), kernel), (node, p)) in rows.zip(grid.iter().zip(pressure)) {
            let weight = width * node.weight;
            *beyond = width * node.from_lower;
            *r = a + *beyond;
            // 1/(x - r) - 1/(x + r) = -2 r/((r - x) (r + x)), with r - x from distances to the stick zone's edge.
            let [proportional, more] = known.slipping(Station { x: *r, gap: width * node.to_upper });
            *cauchy = -2.0 * *r * weight * (p - at_end * proportional);
            *beside = 2.0 * *r * weight * more;
            // k(x - r) = -k(r - x).
            *kernel = -weight * p;
        }
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
        let Nodes { beyond, far, .. } = self.nodes;
        for (at, row) in self.at.iter().zip(self.out.chunks_exact_mut(self.nodes.distances())) {
            let (near, across) = row.split_at_mut(beyond.len());
            for (t, beyond) in near.iter_mut().zip(beyond) {
                *t = beyond + at.gap;
            }
            for (t, r) in across.iter_mut().zip(far) {
                *t = r + at.x;
            }
        }
    }
}

struct Sums<'a> {
    nodes: &'a Nodes,
    at: &'a [Station],
    distances: &'a [f64],
    kernel: &'a [f64],
    out: &'a mut [[f64; 2]],
}

impl WithSimd for Sums<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        const { assert!(LANES.is_multiple_of(S::F64_LANES), "rows are filled up to whole vectors") };
        let Nodes { r, cauchy, beside, kernel: weight, far_kernel: far_weight, .. } = self.nodes;
        let (count, length, one) = (r.len(), self.nodes.distances(), simd.splat_f64s(1.0));
        let (r, cauchy, beside) = (S::as_simd_f64s(r).0, S::as_simd_f64s(cauchy).0, S::as_simd_f64s(beside).0);
        let (weight, far_weight) = (S::as_simd_f64s(weight).0, S::as_simd_f64s(far_weight).0);
        let rows = self.distances.chunks_exact(length).zip(self.kernel.chunks_exact(length));
        for ((out, at), (distances, kernel)) in self.out.iter_mut().zip(self.at).zip(rows) {
            let (k_near, k_far) = kernel.split_at(count);
            let near = S::as_simd_f64s(&distances[..count]).0;
            let (k_near, k_far) = (S::as_simd_f64s(k_near).0, S::as_simd_f64s(k_far).0);
            let (mut sum, mut other, x) = (simd.splat_f64s(0.0), simd.splat_f64s(0.0), simd.splat_f64s(at.x));
            for i in 0..cauchy.len() {
                let inverse = simd.div_f64s(one, simd.mul_f64s(near[i], simd.add_f64s(r[i], x)));
                sum = simd.mul_add_e_f64s(cauchy[i], inverse, simd.mul_add_e_f64s(weight[i], k_near[i], sum));
                other = simd.mul_add_e_f64s(beside[i], inverse, other);
            }
            for (weight, kernel) in far_weight.iter().zip(k_far) {
                sum = simd.mul_add_e_f64s(*weight, *kernel, sum);
            }
            *out = [simd.reduce_sum_f64s(sum), simd.reduce_sum_f64s(other)];
        }
    }
}
