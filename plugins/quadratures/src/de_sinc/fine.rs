//! Where the kernel part is summed: the nodes, or a grid an odd number of times as fine.

use super::apart::Apart;
use super::grid::{Grid, tail};
use super::map::Place;
use super::series::alternating;
use super::sums::dot;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::Edge;
use slipzone_api::elementary::{EULER_GAMMA, LANES};
use spec_math::cephes64::sici;
use std::f64::consts::{FRAC_2_PI, PI};
use std::ops::Range;

/// Distances and product weights from each staggered point, and from the end as one more row, to each fine
/// node `u_k = k step/factor >= 0` and to its mirror image. With a whole number and a half of fine steps
/// between them,
///
/// * `sign(x - r)` has the weight `(2/pi) Si(pi d)`, `d` being the distance in fine steps;
/// * `log|x - r|` has the weight `log|x - r| - Ci(pi |d|)`: the sinc function's own integral against
///   `log|d|` is `Cin(pi d) - log pi - gamma_E`, and the ratio of both logarithms is smooth.
pub(super) struct Fine {
    pub(super) factor: usize,
    /// Fine nodes, `x_k`, filled up.
    pub(super) x: Vec<f64>,
    /// `x_i`, and 1 for the end.
    from: Vec<f64>,
    /// For each staggered point, and for the end, at each fine node `x_i - x_k`, then the weights of the logarithm of
    /// `|x_i - x_k|`, then those of the logarithm of `x_i + x_k`.
    table: Vec<f64>,
    /// Weight of the sign at `d = (2 n - 1)/2 factor, ... , -n factor + factor/2`, descending.
    sign_descending: Vec<f64>,
    /// Weight of the sign at `d = 1/2, 3/2, ...`.
    sign_ascending: Vec<f64>,
    /// Weight of the sign seen from the end, where no step is near.
    ones: Vec<f64>,
    /// Weight of the sign and of the logarithm of the distance from the middle, which is a node: `d = 0, 1, ...`.
    pub(super) centre: (Vec<f64>, Vec<f64>),
    /// How many fine nodes matter, per row and for the end, filled up.
    reach: Vec<usize>,
    /// `step/factor P_k` per unit of `F_j`, where the fine node is a node.
    pub(super) weight: Vec<f64>,
    /// The same for the fine nodes between, a row of unknowns each.
    between: Vec<f64>,
}

/// A term this small beside the largest of its kind is left out: it stands for `1e-13` of a rounding even
/// where the kernel is some `1e7` times as large as the Cauchy part.
const NEGLIGIBLE: f64 = 1e-22;

/// Weights of some nodes of one row of a [`Fine`].
pub(super) struct Row<'a> {
    pub(super) log_minus: &'a [f64],
    pub(super) log_plus: &'a [f64],
    pub(super) sign_minus: &'a [f64],
    pub(super) sign_plus: &'a [f64],
}

impl Fine {
    /// Numbers held, about.
    pub(super) fn numbers(&self) -> usize {
        self.table.len() + self.between.len() + 2 * self.x.len()
    }

    pub(super) fn new(grid: &Grid, factor: usize) -> Self {
        let n = grid.staggered.len();
        let count = n * factor + 1;
        let fine_step = grid.step / factor as f64;
        let last = count - 1;
        // What fills the rows up stands where the last node does and is not summed.
        let filled = count.next_multiple_of(LANES);
        let places: Vec<Place> = (0..filled)
            .map(|k| k.min(last))
            .map(|k| if k % factor == 0 { grid.nodes[k / factor] } else { Place::new(k as f64 * fine_step) })
            .collect();
        // Half-integers up to d = n factor - factor/2 + n factor, and beyond for what fills up.
        let halves = 2 * n * factor + LANES;
        let (sign_ascending, cosine): (Vec<f64>, Vec<f64>) =
            (0..halves).map(|m| sici(PI * (m as f64 + 0.5))).map(|(si, ci)| (FRAC_2_PI * si, ci)).unzip();
        let nearest = n * factor - factor / 2;
        let sign_descending = sign_ascending[..nearest].iter().rev().copied();
        let sign_descending = sign_descending.chain(sign_ascending.iter().map(|s| -s)).collect();

        let mut fine = Self {
            factor,
            x: places.iter().map(|p| p.x).collect(),
            from: grid.staggered.iter().map(|v| v.x).chain([1.0]).collect(),
            table: Vec::with_capacity((n + 1) * 3 * filled),
            sign_descending,
            sign_ascending,
            ones: vec![1.0; filled],
            centre: places.iter().enumerate().map(|(k, place)| centre_weights(k, place, fine_step)).unzip(),
            reach: Vec::with_capacity(n + 1),
            weight: grid.nodes.iter().map(|u| fine_step * u.slope).collect(),
            between: between(grid, factor),
        };
        // The middle node is its own mirror image, and both are summed.
        fine.weight[0] *= 0.5;
        if grid.edge == Edge::Sharp {
            fine.weight[n] += tail(&places[..count], fine_step);
        }
        let reach = |slope: f64| {
            let matter = places[..count].iter().take_while(|p| slope * p.slope > NEGLIGIBLE).count();
            matter.next_multiple_of(LANES)
        };
        let apart = Apart::new(n, factor, grid.step);
        for (i, v) in grid.staggered.iter().enumerate() {
            let d = (2 * i + 1) * factor; // in halves
            let nodes = || places.iter().enumerate();
            let minus: Vec<f64> = nodes().map(|(k, place)| apart.minus((i, v), (k.min(last), place))).collect();
            let log_minus = nodes().zip(&minus).map(|((k, _), minus)| minus.abs().ln() - cosine[d.abs_diff(2 * k) / 2]);
            let log_plus = nodes().map(|(k, place)| (v.x + place.x).ln() - cosine[d / 2 + k]);
            fine.table.extend(minus.iter().copied().chain(log_minus).chain(log_plus));
            fine.reach.push(reach(v.slope));
        }
        // The end lies infinitely many steps away: no correction.
        let log_minus = places.iter().map(|p| p.gap.ln());
        let log_plus = places.iter().map(|p| (1.0 + p.x).ln());
        fine.table.extend(places.iter().map(|p| p.gap).chain(log_minus).chain(log_plus));
        fine.reach.push(reach(1.0));
        fine
    }

    /// Number of rows before that of the end.
    #[inline(always)]
    pub(super) fn rows(&self) -> usize {
        self.from.len() - 1
    }

    /// Number of fine nodes that matter to a row, filled up.
    #[inline(always)]
    pub(super) fn reach(&self, i: usize) -> usize {
        self.reach[i]
    }

    /// `rows[i][j] = cauchy[i][j] + scale[i] sum_k folded[i][k] (step/factor) dP_k/dF_j` for a few rows of that length and all
    /// unknowns `j`.
    pub(super) fn gather(
        &self,
        grid: &Grid,
        (cauchy, folded): (&[f64], &[f64]),
        scale: &[f64],
        rows: (&mut [f64], usize),
    ) {
        Arch::new().dispatch(Gather { fine: self, grid, cauchy, folded, scale, rows });
    }

    /// `out[k] = (step/factor) P_k` from the unknowns, filled up with zeros.
    pub(super) fn spread(&self, grid: &Grid, unknowns: &[f64], out: &mut Vec<f64>) {
        let count = (grid.nodes.len() - 1) * self.factor + 1;
        out.clear();
        out.extend((0..count).map(|k| {
            let (node, off) = (k / self.factor, k % self.factor);
            if off != 0 {
                let between = &self.between[(k - node - 1) * unknowns.len()..][..unknowns.len()];
                dot(between, unknowns)
            } else if node >= grid.first {
                self.weight[node] * unknowns[node - grid.first]
            } else {
                0.0
            }
        }));
        out.resize(self.x.len(), 0.0);
    }

    /// `x_i`, or 1 at the end, and its distances from some nodes.
    #[inline(always)]
    pub(super) fn minus(&self, i: usize, nodes: Range<usize>) -> (f64, &[f64]) {
        (self.from[i], &self.table[3 * i * self.x.len()..][nodes])
    }

    /// Some nodes of the row of the `i`-th staggered point, or of the end when there are only `i` of them.
    #[inline(always)]
    pub(super) fn row(&self, i: usize, nodes: Range<usize>) -> Row<'_> {
        let (filled, rows) = (self.x.len(), self.rows());
        let (sign_minus, sign_plus) = if i == rows {
            (self.ones.as_slice(), self.ones.as_slice())
        } else {
            (
                &self.sign_descending[(rows - 1 - i) * self.factor..],
                &self.sign_ascending[i * self.factor + self.factor / 2..],
            )
        };
        let table = &self.table[3 * i * filled..3 * (i + 1) * filled];
        Row {
            log_minus: &table[filled..2 * filled][nodes.clone()],
            log_plus: &table[2 * filled..][nodes.clone()],
            sign_minus: &sign_minus[nodes.clone()],
            sign_plus: &sign_plus[nodes],
        }
    }
}

/// See [`Fine::gather`].
struct Gather<'a> {
    fine: &'a Fine,
    grid: &'a Grid,
    cauchy: &'a [f64],
    folded: &'a [f64],
    scale: &'a [f64],
    /// And their length.
    rows: (&'a mut [f64], usize),
}

impl WithSimd for Gather<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { fine, grid, cauchy, folded, scale, rows: (rows, length) } = self;
        let (count, n, factor) = (fine.x.len(), grid.unknowns(), fine.factor);
        let (weight, first) = (&fine.weight[grid.first..], grid.first);
        let each = rows.chunks_exact_mut(length).zip(cauchy.chunks_exact(n)).zip(folded.chunks_exact(count)).zip(scale);
        for (((row, cauchy), folded), scale) in each {
            let row = &mut row[..n];
            if factor == 1 {
                let (cauchy, cauchy_rest) = S::as_simd_f64s(cauchy);
                let (values, values_rest) = S::as_simd_f64s(&folded[first..first + n]);
                let (weights, weights_rest) = S::as_simd_f64s(&weight[..n]);
                let (row, rest) = S::as_mut_simd_f64s(row);
                let wide = simd.splat_f64s(*scale);
                for (((entry, start), value), weight) in row.iter_mut().zip(cauchy).zip(values).zip(weights) {
                    *entry = simd.mul_add_e_f64s(simd.mul_f64s(wide, *value), *weight, *start);
                }
                let rests = cauchy_rest.iter().zip(values_rest).zip(weights_rest);
                for (entry, ((start, value), weight)) in rest.iter_mut().zip(rests) {
                    *entry = start + scale * value * weight;
                }
            } else {
                let at_nodes = folded[first * factor..].iter().step_by(factor);
                for (entry, ((start, value), weight)) in row.iter_mut().zip(cauchy.iter().zip(at_nodes).zip(weight)) {
                    *entry = start + scale * value * weight;
                }
            }
        }
        // A pair of fine nodes for all rows, then the next: the pair's own rows stay in the fastest memory.
        for (pair, between) in fine.between.chunks_exact(2 * n).enumerate() {
            let (cell, within) = (2 * pair / (factor - 1), 2 * pair % (factor - 1));
            let k = cell * factor + within + 1;
            let (p, q) = between.split_at(n);
            let ((p, p_rest), (q, q_rest)) = (S::as_simd_f64s(p), S::as_simd_f64s(q));
            for ((row, folded), scale) in rows.chunks_exact_mut(length).zip(folded.chunks_exact(count)).zip(scale) {
                let row = &mut row[..n];
                let (a, b) = (scale * folded[k], scale * folded[k + 1]);
                let (row, rest) = S::as_mut_simd_f64s(row);
                let (wide_a, wide_b) = (simd.splat_f64s(a), simd.splat_f64s(b));
                for (entry, (p, q)) in row.iter_mut().zip(p.iter().zip(q)) {
                    *entry = simd.mul_add_e_f64s(wide_b, *q, simd.mul_add_e_f64s(wide_a, *p, *entry));
                }
                for (entry, (p, q)) in rest.iter_mut().zip(p_rest.iter().zip(q_rest)) {
                    *entry += a * p + b * q;
                }
            }
        }
    }
}

/// Weights of the sign and of the logarithm of the distance `x_k` from the middle, `k` fine steps away. At
/// `k = 0` that of the logarithm is the limit of `log|x'(0) d step| - Ci(pi d)`.
fn centre_weights(k: usize, place: &Place, fine_step: f64) -> (f64, f64) {
    if k == 0 {
        return (0.0, (place.slope * fine_step / PI).ln() - EULER_GAMMA);
    }
    let (si, ci) = sici(PI * k as f64);
    (FRAC_2_PI * si, place.x.ln() - ci)
}

/// `(step/factor) slope_j [sinc(k/factor - j) +- sinc(k/factor + j)]` for the fine nodes `k` that are no nodes.
fn between(grid: &Grid, factor: usize) -> Vec<f64> {
    let last = (grid.nodes.len() - 1) * factor;
    let mut table = Vec::with_capacity((last - last / factor) * grid.unknowns());
    for k in (0..last).filter(|k| k % factor != 0) {
        let t = k as f64 / factor as f64;
        // sin(pi (t -+ j)) = (-1)^j sin(pi t), and whole turns are dropped first.
        let sine = (PI * (k % (2 * factor)) as f64 / factor as f64).sin() * grid.step / (PI * factor as f64);
        table.extend(grid.nodes.iter().enumerate().skip(grid.first).map(|(j, u)| {
            let at = j as f64;
            let sincs = match (j, grid.odd) {
                (0, _) => 1.0 / t,
                (_, false) => 2.0 * t / ((t - at) * (t + at)),
                (_, true) => 2.0 * at / ((t - at) * (t + at)),
            };
            alternating(j) * sine * u.slope * sincs
        }));
    }
    table
}
