//! The fine nodes that are no nodes: what a density is there, and sums over them as sums over its unknowns.

use super::grid::Grid;
use super::map::Place;
use super::series::alternating;
use super::sums::dot;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::elementary::LANES;
use std::f64::consts::PI;

/// Rows, and vectors of unknowns, that are summed side by side: more sums than these do not stay where the processor adds.
const ROWS: usize = 4;
const WIDE: usize = 2;
/// Numbers of the table that all rows go through before the next: they stay in the fastest memory.
const AT_ONCE: usize = 1 << 12;

/// `(step/factor) slope_j [sinc(k/factor - j) +- sinc(k/factor + j)]` for the fine nodes `k` that are no nodes: `factor - 1` from each
/// node to the next. The last unknown stands for the places beyond it as well.
pub(super) struct Between {
    /// A row of unknowns for each, filled up with zeros.
    table: Vec<f64>,
    unknowns: usize,
    factor: usize,
}

impl Between {
    pub(super) fn new(grid: &Grid, factor: usize) -> Self {
        let mut between = Self { table: Vec::new(), unknowns: grid.unknowns(), factor };
        let (width, cells) = (between.width(), grid.nodes.len() - 1);
        let beyond = grid.beyond(1);
        between.table.resize(cells * (factor - 1) * width, 0.0);
        for (row, k) in between.table.chunks_exact_mut(width).zip(no_nodes(factor)) {
            let at = Seen::new(grid, (k, factor));
            for (entry, (j, u)) in row.iter_mut().zip(grid.nodes.iter().enumerate().skip(grid.first)) {
                *entry = at.entry(j, u);
            }
            let each = |(m, (u, share)): (usize, &(Place, f64))| share * at.entry(cells + 1 + m, u);
            row[between.unknowns - 1] += beyond.iter().enumerate().map(each).sum::<f64>();
        }
        between
    }

    /// What the last node, and each of the places beyond it, adds to the sum over all these nodes per unit of `F` there.
    pub(super) fn sums_from_last<'a>(
        &self,
        grid: &'a Grid,
        places: impl Iterator<Item = &'a Place> + Clone,
    ) -> Vec<f64> {
        let last = grid.nodes.len() - 1;
        let each = (last..).zip(std::iter::once(&grid.nodes[last]).chain(places));
        let mut sums = vec![0.0; each.clone().count()];
        for k in no_nodes(self.factor).take(self.table.len() / self.width()) {
            let at = Seen::new(grid, (k, self.factor));
            sums.iter_mut().zip(each.clone()).for_each(|(sum, (j, u))| *sum += at.entry(j, u));
        }
        sums
    }

    /// Numbers held.
    pub(super) fn numbers(&self) -> usize {
        self.table.len()
    }

    /// Length of a row.
    #[inline(always)]
    fn width(&self) -> usize {
        self.unknowns.next_multiple_of(LANES)
    }

    /// Adds what the density of these unknowns is there, times the fine step, to what `out` has for all fine nodes.
    pub(super) fn spread(&self, unknowns: &[f64], out: &mut [f64]) {
        for (row, k) in self.table.chunks_exact(self.width()).zip(no_nodes(self.factor)) {
            out[k] += dot(&row[..self.unknowns], unknowns);
        }
    }

    /// Adds to each of the rows of unknowns its scale times the sum of what it has `folded` at these nodes times the density there. `rows`
    /// are of the length given, and so is what is folded; fine nodes from `reach` on have nothing.
    pub(super) fn add(&self, folded: (&[f64], usize), scale: &[f64], rows: (&mut [f64], usize), reach: usize) {
        if self.factor > 1 {
            Arch::new().dispatch(Add { between: self, folded, scale, rows, reach });
        }
    }
}

/// A fine node that is no node, in steps of the nodes, and `step/(pi factor) sin(pi t)` there.
struct Seen {
    t: f64,
    sine: f64,
    odd: bool,
}

impl Seen {
    fn new(grid: &Grid, (k, factor): (usize, usize)) -> Self {
        // Whole turns are dropped first.
        let turn = PI * (k % (2 * factor)) as f64 / factor as f64;
        Self { t: k as f64 / factor as f64, sine: turn.sin() * grid.step / (PI * factor as f64), odd: grid.odd }
    }

    /// What the `j`-th node adds there, see [`Between`]: `sin(pi (t -+ j)) = (-1)^j sin(pi t)`.
    #[inline(always)]
    fn entry(&self, j: usize, u: &Place) -> f64 {
        let (t, at) = (self.t, j as f64);
        let sincs = match (j, self.odd) {
            (0, _) => 1.0 / t,
            (_, false) => 2.0 * t / ((t - at) * (t + at)),
            (_, true) => 2.0 * at / ((t - at) * (t + at)),
        };
        alternating(j) * self.sine * u.slope * sincs
    }
}

/// The fine nodes that are no nodes, without end; of a grid that is no finer none may be asked for.
fn no_nodes(factor: usize) -> impl Iterator<Item = usize> {
    (0..).filter(move |k| k % factor != 0)
}

/// See [`Between::add`].
struct Add<'a> {
    between: &'a Between,
    folded: (&'a [f64], usize),
    scale: &'a [f64],
    rows: (&'a mut [f64], usize),
    reach: usize,
}

impl WithSimd for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        const { assert!(LANES.is_multiple_of(S::F64_LANES), "rows are filled up to whole vectors") };
        let Self { between, folded: (folded, count), scale, rows: (rows, length), reach } = self;
        let factor = between.factor;
        let of_cell = (factor - 1) * between.width();
        let (cells, at_once) = (reach.div_ceil(factor), (AT_ONCE / of_cell).max(1));
        let table = &between.table[..between.table.len().min(cells * of_cell)];
        for (chunk, table) in table.chunks(at_once * of_cell).enumerate() {
            let cells = Cells { between, table };
            let from = chunk * at_once * factor;
            let each = rows.chunks_mut(ROWS * length).zip(folded.chunks(ROWS * count)).zip(scale.chunks(ROWS));
            for ((rows, folded), scale) in each {
                let folded = |r: usize| &folded[r * count + from..(r + 1) * count];
                if let Some(scale) = scale.first_chunk::<ROWS>() {
                    cells.add_to::<S, ROWS>(simd, std::array::from_fn(folded), *scale, (rows, length));
                    continue;
                }
                for (r, (row, scale)) in rows.chunks_mut(length).zip(scale).enumerate() {
                    cells.add_to::<S, 1>(simd, [folded(r)], [*scale], (row, length));
                }
            }
        }
    }
}

/// Some of the table, from one node to another.
struct Cells<'a> {
    between: &'a Between,
    table: &'a [f64],
}

impl Cells<'_> {
    /// [`Between::add`] for a few rows; `folded` begins with the first of these nodes.
    #[inline(always)]
    fn add_to<S: Simd, const R: usize>(
        &self,
        simd: S,
        folded: [&[f64]; R],
        scale: [f64; R],
        (rows, length): (&mut [f64], usize),
    ) {
        let vectors = self.between.width() / S::F64_LANES;
        for first in (0..vectors).step_by(WIDE) {
            let mut sums = [[simd.splat_f64s(0.0); WIDE]; R];
            if first + WIDE <= vectors {
                self.sum::<S, R, WIDE>(simd, folded, first, &mut sums);
            } else {
                self.sum::<S, R, 1>(simd, folded, first, &mut sums);
            }
            for ((row, sums), scale) in rows.chunks_exact_mut(length).zip(sums).zip(scale) {
                let (row, rest) = S::as_mut_simd_f64s(&mut row[..self.between.unknowns]);
                let wide = simd.splat_f64s(scale);
                for (at, sum) in (first..vectors).zip(sums) {
                    if let Some(entry) = row.get_mut(at) {
                        *entry = simd.mul_add_e_f64s(wide, sum, *entry);
                        continue;
                    }
                    let mut last = [0.0; LANES];
                    S::as_mut_simd_f64s(&mut last).0[0] = sum;
                    rest.iter_mut().zip(last).for_each(|(entry, sum)| *entry += scale * sum);
                }
            }
        }
    }

    /// The sums for the first `W` vectors of unknowns from one on.
    #[inline(always)]
    fn sum<S: Simd, const R: usize, const W: usize>(
        &self,
        simd: S,
        folded: [&[f64]; R],
        first: usize,
        sums: &mut [[S::f64s; WIDE]; R],
    ) {
        let (width, factor) = (self.between.width(), self.between.factor);
        for (cell, table) in self.table.chunks_exact((factor - 1) * width).enumerate() {
            // Cut to one length that the compiler knows: no index is checked in the loop.
            let folded = folded.map(|folded| &folded[cell * factor + 1..][..factor - 1]);
            for (k, densities) in (0..factor - 1).zip(table.chunks_exact(width)) {
                let densities = &S::as_simd_f64s(densities).0[first..first + W];
                for r in 0..R {
                    let value = simd.splat_f64s(folded[r][k]);
                    for w in 0..W {
                        sums[r][w] = simd.mul_add_e_f64s(value, densities[w], sums[r][w]);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::grid::Grid;
    use super::super::resolution::reach;
    use super::*;
    use pulp::Scalar;
    use slipzone_api::Edge;

    /// Against sums one by one: rows and unknowns that fill no block, one cell and many, a reach that ends within one.
    #[test]
    fn sums_are_those_one_by_one() {
        for (n, factor, odd) in [(2, 3, false), (7, 5, true), (13, 3, false), (24, 55, true)] {
            let grid = Grid::new(n, reach(n, Edge::Sharp), odd, Edge::Sharp);
            let between = Between::new(&grid, factor);
            let (unknowns, count, length) = (grid.unknowns(), n * factor + 5, grid.unknowns() + 2);
            let entry = |i: usize| ((i * 7919 + 13) % 1009) as f64 / 504.5 - 1.0;
            for (rows, nodes) in [(1, n * factor), (3, n * factor), (8, n * factor), (9, (n * factor) / 2)] {
                let folded: Vec<f64> =
                    (0..rows * count).map(|i| if i % count < nodes { entry(i) } else { 0.0 }).collect();
                let scale: Vec<f64> = (0..rows).map(|i| 1.0 + i as f64).collect();
                let before: Vec<f64> = (0..rows * length).map(entry).collect();
                let (mut with_vectors, mut without) = (before.clone(), before.clone());
                between.add((&folded, count), &scale, (&mut with_vectors, length), nodes);
                let rows = (without.as_mut_slice(), length);
                let add = Add { between: &between, folded: (&folded, count), scale: &scale, rows, reach: nodes };
                add.with_simd(Scalar::new());
                for (i, before) in before.iter().enumerate() {
                    let (row, j) = (i / length, i % length);
                    let mut sum = 0.0;
                    // What follows the unknowns in a row is left alone.
                    if j < unknowns {
                        let entries = between.table[j..].iter().step_by(between.width());
                        for (entry, k) in entries.zip((1..nodes).filter(|k| k % factor != 0)) {
                            sum += folded[row * count + k] * entry;
                        }
                    }
                    let expected = before + scale[row] * sum;
                    for got in [with_vectors[i], without[i]] {
                        assert!((got - expected).abs() < 1e-12, "{n}, {factor}: {got} for {expected} at {row}, {j}");
                    }
                }
            }
        }
    }

    /// One unknown is spread as its own column.
    #[test]
    fn a_density_is_spread_as_its_unknowns_say() {
        let (n, factor) = (6, 5);
        let grid = Grid::new(n, reach(n, Edge::Sharp), false, Edge::Sharp);
        let between = Between::new(&grid, factor);
        for j in 0..grid.unknowns() {
            let mut unknowns = vec![0.0; grid.unknowns()];
            unknowns[j] = 2.0;
            let mut out = vec![1.0; n * factor + 1];
            between.spread(&unknowns, &mut out);
            let mut column = between.table[j..].iter().step_by(between.width());
            for (k, out) in out.into_iter().enumerate() {
                let added = if k % factor == 0 { 0.0 } else { 2.0 * column.next().expect("a row for each") };
                assert!((out - 1.0 - added).abs() < 1e-15, "node {k}: {out}");
            }
        }
    }
}
