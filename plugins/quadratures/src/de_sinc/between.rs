//! The fine nodes that are no nodes: what a density is there, and sums over them as sums over its unknowns.

use super::grid::Grid;
use super::series::alternating;
use super::sums::dot;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::elementary::LANES;
use slipzone_api::lend;
use std::cell::Cell;
use std::f64::consts::PI;
use std::ops::Range;

/// Rows, and vectors of unknowns, that are summed side by side: more sums than these do not stay where the processor
/// adds.
const ROWS: usize = 4;
const WIDE: usize = 2;

thread_local! {
    /// That of this thread, unless it is in use.
    static ROOM: Cell<Vec<f64>> = const { Cell::new(Vec::new()) };
}

/// `(step/factor) slope_j [sinc(t - j) +- sinc(t + j)]` at the fine nodes `t = q + r/factor`, `0 < r < factor`, that
/// are no nodes. The last unknown stands for the places beyond it as well.
///
/// As `sin(pi (t -+ j)) = (-1)^j sin(pi t)` it is a factor of `t`, a factor of `j` and `1/(t - j) +- 1/(t + j)`, whose
/// fractions depend on sums and differences of whole numbers: they are all that is kept, not a row of unknowns for each
/// `t`.
pub(super) struct Between {
    factor: usize,
    odd: bool,
    /// Nodes that have fine nodes after them, and the node of the first unknown.
    cells: usize,
    first: usize,
    /// For each `r` in turn `factor/(m factor + r)`, `m = -cells, -cells + 1, ...`, and how many there are.
    fractions: (Vec<f64>, usize),
    /// `step/(pi factor) sin(pi r/factor)` for `r = 0, 1, ...`; the sign of `sin(pi t)` alternates with `q`.
    sines: Vec<f64>,
    /// `(-1)^j slope_j` for the nodes and the places beyond, the other sign where odd, filled up with zeros: where odd,
    /// both fractions are taken with the opposite sign.
    slopes: Vec<f64>,
    /// For each fine node what the places beyond add to the last unknown's; 0 at the nodes.
    beyond: Vec<f64>,
}

impl Between {
    pub(super) fn new(grid: &Grid, factor: usize) -> Self {
        let (cells, beyond) = (grid.nodes.len() - 1, grid.beyond(1));
        let sign = if grid.odd { -1.0 } else { 1.0 };
        let places = grid.nodes.iter().chain(beyond.iter().map(|(place, _)| place));
        let mut slopes: Vec<f64> = places.enumerate().map(|(j, u)| sign * alternating(j) * u.slope).collect();
        // The node in the middle is its own mirror image.
        slopes[0] *= 0.5;
        let width = slopes.len() + LANES;
        let length = 2 * cells + width;
        let denominator = |r: usize, m: usize| (m * factor + r) as f64 - (cells * factor) as f64;
        let fractions = (1..factor).flat_map(|r| (0..length).map(move |m| factor as f64 / denominator(r, m)));
        let sine = |r: usize| (PI * r as f64 / factor as f64).sin() * grid.step / (PI * factor as f64);
        let between = Self {
            factor,
            odd: grid.odd,
            cells,
            first: grid.first,
            fractions: (fractions.collect(), length),
            sines: (0..factor).map(sine).collect(),
            slopes: Vec::new(),
            beyond: Vec::new(),
        };
        let last = grid.nodes.len();
        let shared: Vec<f64> = beyond.iter().zip(&slopes[last..]).map(|((_, share), slope)| share * slope).collect();
        let mut of_last = vec![0.0; cells * factor];
        between.spread_from(last, &shared, &mut of_last);
        slopes.resize(width, 0.0);
        Self { slopes, beyond: of_last, ..between }
    }

    /// What the last node, and each of the places beyond it, adds to the sum over all these nodes per unit of `F`
    /// there.
    pub(super) fn sums_from_last(&self) -> Vec<f64> {
        let (last, width) = (self.cells, self.slopes.len() - self.cells - LANES);
        let mut sums = vec![0.0; width];
        let ones = vec![1.0; self.cells * self.factor];
        let folded = (ones.as_slice(), ones.len());
        let nodes = last..last + width;
        let mut room = Vec::new();
        let by_phase = self.by_phase(folded, 1, self.cells, &mut room);
        let rows = (sums.as_mut_slice(), width);
        Arch::new().dispatch(Add { between: self, nodes, by_phase, scale: &[1.0], rows });
        sums
    }

    /// Numbers held.
    pub(super) fn numbers(&self) -> usize {
        self.fractions.0.len() + self.beyond.len()
    }

    /// The fractions with `r`, from `m` on.
    #[inline(always)]
    fn fractions(&self, r: usize, m: isize) -> &[f64] {
        let (fractions, length) = &self.fractions;
        &fractions[(r - 1) * length..r * length][self.cells.strict_add_signed(m)..]
    }

    /// `1/(t + j)` and `1/(j - t)` for `t = q + r/factor` and all `j` from one on.
    #[inline(always)]
    fn ahead_and_back(&self, r: usize, q: usize, j: usize) -> [&[f64]; 2] {
        let (q, j) = (q.cast_signed(), j.cast_signed());
        [self.fractions(r, q + j), self.fractions(self.factor - r, j - q - 1)]
    }

    /// Adds what a density with these numbers, `(-1)^j F_j slope_j` from node `first` on, is at the fine nodes between,
    /// times the fine step.
    fn spread_from(&self, first: usize, signed: &[f64], out: &mut [f64]) {
        for (q, cell) in out.chunks_exact_mut(self.factor).take(self.cells).enumerate() {
            for (r, out) in cell.iter_mut().enumerate().skip(1) {
                let [ahead, back] = self.ahead_and_back(r, q, first).map(|fractions| dot(signed, fractions));
                *out += alternating(q) * self.sines[r] * (if self.odd { ahead + back } else { ahead - back });
            }
        }
    }

    /// Adds what the density of these unknowns is there, times the fine step, to what `out` has for all fine nodes.
    pub(super) fn spread(&self, unknowns: &[f64], out: &mut [f64]) {
        if self.factor > 1 {
            lend(&ROOM, |signed| {
                signed.clear();
                signed.extend(unknowns.iter().zip(&self.slopes[self.first..]).map(|(f, slope)| f * slope));
                self.spread_from(self.first, signed, out);
            });
            let last = unknowns.last().copied().unwrap_or_default();
            out.iter_mut().zip(&self.beyond).for_each(|(out, beyond)| *out += last * beyond);
        }
    }

    /// Adds to each of the rows of unknowns its scale times the sum of what it has `folded` at these nodes times the
    /// density there. `rows` are of the length given, and so is what is folded; fine nodes from `reach` on have
    /// nothing.
    pub(super) fn add(&self, folded: (&[f64], usize), scale: &[f64], rows: (&mut [f64], usize), reach: usize) {
        if self.factor > 1 {
            self.added(folded, scale, rows, reach, |add| Arch::new().dispatch(add));
        }
    }

    fn added(
        &self,
        folded: (&[f64], usize),
        scale: &[f64],
        (rows, length): (&mut [f64], usize),
        reach: usize,
        sum: impl FnOnce(Add),
    ) {
        let nodes = self.first..self.cells + 1;
        for ((row, folded), scale) in rows.chunks_exact_mut(length).zip(folded.0.chunks_exact(folded.1)).zip(scale) {
            row[nodes.len() - 1] += scale * dot(&self.beyond, folded);
        }
        let cells = reach.div_ceil(self.factor).min(self.cells);
        lend(&ROOM, |room| {
            let by_phase = self.by_phase(folded, scale.len(), cells, room);
            sum(Add { between: self, nodes, by_phase, scale, rows: (rows, length) });
        });
    }

    /// What some rows have folded in the first cells, times the factor of `t`: for each row all `q` of one `r` side by
    /// side.
    fn by_phase<'a>(
        &self,
        (folded, count): (&[f64], usize),
        rows: usize,
        cells: usize,
        by_phase: &'a mut Vec<f64>,
    ) -> &'a [f64] {
        by_phase.clear();
        for row in folded.chunks_exact(count).take(rows) {
            for (r, sine) in self.sines.iter().enumerate().skip(1) {
                let of_cells = row[r..].iter().step_by(self.factor).take(cells).enumerate();
                by_phase.extend(of_cells.map(|(q, value)| alternating(q) * sine * value));
            }
        }
        by_phase
    }
}

/// See [`Between::add`].
struct Add<'a> {
    between: &'a Between,
    /// Of which nodes to add the densities.
    nodes: Range<usize>,
    by_phase: &'a [f64],
    scale: &'a [f64],
    rows: (&'a mut [f64], usize),
}

impl WithSimd for Add<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        const { assert!(LANES.is_multiple_of(S::F64_LANES), "rows are filled up to whole vectors") };
        let Self { between, nodes, by_phase, scale, rows: (rows, length) } = self;
        if by_phase.is_empty() {
            return;
        }
        let of_row = by_phase.len() / scale.len();
        let each = rows.chunks_mut(ROWS * length).zip(by_phase.chunks(ROWS * of_row)).zip(scale.chunks(ROWS));
        for ((rows, by_phase), scale) in each {
            if let Some(scale) = scale.first_chunk::<ROWS>() {
                let by_phase = std::array::from_fn(|r| &by_phase[r * of_row..(r + 1) * of_row]);
                Sums { between, nodes: nodes.clone(), by_phase, scale }.add_to(simd, rows, length);
                continue;
            }
            let single = rows.chunks_mut(length).zip(by_phase.chunks(of_row)).zip(scale.as_chunks().0);
            for ((row, by_phase), scale) in single {
                Sums { between, nodes: nodes.clone(), by_phase: [by_phase], scale }.add_to(simd, row, length);
            }
        }
    }
}

/// A few rows.
struct Sums<'a, const R: usize> {
    between: &'a Between,
    nodes: Range<usize>,
    by_phase: [&'a [f64]; R],
    scale: &'a [f64; R],
}

impl<const R: usize> Sums<'_, R> {
    #[inline(always)]
    fn add_to<S: Simd>(&self, simd: S, rows: &mut [f64], length: usize) {
        for first in self.nodes.clone().step_by(WIDE * S::F64_LANES) {
            let mut sums = [[simd.splat_f64s(0.0); WIDE]; R];
            if first + S::F64_LANES < self.nodes.end {
                self.sum::<S, WIDE>(simd, first, &mut sums);
            } else {
                self.sum::<S, 1>(simd, first, &mut sums);
            }
            let slopes = &self.between.slopes[first..];
            for ((row, sums), scale) in rows.chunks_exact_mut(length).zip(sums).zip(self.scale) {
                let mut each = [0.0; WIDE * LANES];
                S::as_mut_simd_f64s(&mut each).0.iter_mut().zip(sums).for_each(|(vector, sum)| *vector = sum);
                let row = &mut row[first - self.nodes.start..self.nodes.len()];
                for ((entry, sum), slope) in row.iter_mut().zip(&each[..WIDE * S::F64_LANES]).zip(slopes) {
                    *entry += scale * slope * sum;
                }
            }
        }
    }

    /// The sums for the first `W` vectors of nodes from one on.
    #[inline(always)]
    fn sum<S: Simd, const W: usize>(&self, simd: S, first: usize, sums: &mut [[S::f64s; WIDE]; R]) {
        let Self { between, by_phase, .. } = self;
        let cells = by_phase[0].len() / (between.factor - 1);
        for r in 1..between.factor {
            // Cut to one length that the compiler knows: no index is checked in the loop.
            let values = by_phase.map(|values| &values[(r - 1) * cells..r * cells]);
            let window = W * S::F64_LANES;
            let ahead = between.fractions(r, first.cast_signed());
            let back = between.fractions(between.factor - r, first.cast_signed() - cells.cast_signed());
            let (ahead, back) = (&ahead[..cells + window - 1], &back[..cells + window - 1]);
            for (q, (ahead, back)) in ahead.windows(window).zip(back.windows(window).rev()).enumerate() {
                let (ahead, back) = (S::as_simd_f64s(ahead).0, S::as_simd_f64s(back).0);
                for w in 0..W {
                    let both =
                        if between.odd { simd.add_f64s(ahead[w], back[w]) } else { simd.sub_f64s(ahead[w], back[w]) };
                    for i in 0..R {
                        sums[i][w] = simd.mul_add_e_f64s(simd.splat_f64s(values[i][q]), both, sums[i][w]);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::grid::Grid;
    use super::super::map::Place;
    use super::super::resolution::reach;
    use super::*;
    use pulp::Scalar;
    use slipzone_api::Edge;

    /// For each fine node what each unknown is there, with sinc functions as they are written; 0 at the nodes.
    fn one_by_one(grid: &Grid, factor: usize) -> Vec<Vec<f64>> {
        let (last, fine_step) = (grid.nodes.len() - 1, grid.step / factor as f64);
        let mirror = if grid.odd { -1.0 } else { 1.0 };
        let sinc = |d: f64| (PI * d).sin() / (PI * d);
        let beyond = grid.beyond(1);
        let of = |t: f64, j: usize, u: &Place| {
            let image = if j == 0 { 0.0 } else { mirror * sinc(t + j as f64) };
            fine_step * u.slope * (sinc(t - j as f64) + image)
        };
        let row = |k: usize| {
            let t = k as f64 / factor as f64;
            let mut row: Vec<f64> = (grid.first..=last).map(|j| of(t, j, &grid.nodes[j])).collect();
            row[last - grid.first] += (last + 1..).zip(&beyond).map(|(j, (u, share))| share * of(t, j, u)).sum::<f64>();
            if k.is_multiple_of(factor) { vec![0.0; row.len()] } else { row }
        };
        (0..last * factor).map(row).collect()
    }

    /// Against sums one by one: rows and unknowns that fill no block, one cell and many, a reach that ends within one.
    #[test]
    fn sums_are_those_one_by_one() {
        for (n, factor, odd) in [(2, 3, false), (7, 5, true), (13, 3, false), (24, 55, true)] {
            let grid = Grid::new(n, reach(n, Edge::Sharp), odd, Edge::Sharp);
            let (between, densities) = (Between::new(&grid, factor), one_by_one(&grid, factor));
            let (unknowns, count, length) = (grid.unknowns(), n * factor + 5, grid.unknowns() + 2);
            let entry = |i: usize| ((i * 7919 + 13) % 1009) as f64 / 504.5 - 1.0;
            for (rows, nodes) in [(1, n * factor), (3, n * factor), (8, n * factor), (9, (n * factor) / 2)] {
                let folded: Vec<f64> =
                    (0..rows * count).map(|i| if i % count < nodes { entry(i) } else { 0.0 }).collect();
                let scale: Vec<f64> = (0..rows).map(|i| 1.0 + i as f64).collect();
                let before: Vec<f64> = (0..rows * length).map(entry).collect();
                let (mut with_vectors, mut without) = (before.clone(), before.clone());
                between.add((&folded, count), &scale, (&mut with_vectors, length), nodes);
                between.added((&folded, count), &scale, (&mut without, length), nodes, |add| {
                    add.with_simd(Scalar::new());
                });
                for (i, before) in before.iter().enumerate() {
                    let (row, j) = (i / length, i % length);
                    // What follows the unknowns in a row is left alone.
                    let of_unknown = densities.iter().map(|densities| if j < unknowns { densities[j] } else { 0.0 });
                    let sum: f64 = folded[row * count..].iter().zip(of_unknown).map(|(a, b)| a * b).sum();
                    let expected = before + scale[row] * sum;
                    for got in [with_vectors[i], without[i]] {
                        assert!((got - expected).abs() < 1e-12, "{n}, {factor}: {got} for {expected} at {row}, {j}");
                    }
                }
            }
        }
    }

    /// One unknown is spread as its own column, and what it and the places beyond add up to is known.
    #[test]
    fn a_density_is_spread_as_its_unknowns_say() {
        let (n, factor) = (6, 5);
        for (odd, edge) in [(false, Edge::Sharp), (true, Edge::Continued)] {
            let grid = Grid::new(n, reach(n, edge), odd, edge);
            let (between, densities) = (Between::new(&grid, factor), one_by_one(&grid, factor));
            for j in 0..grid.unknowns() {
                let mut unknowns = vec![0.0; grid.unknowns()];
                unknowns[j] = 2.0;
                let mut out = vec![1.0; n * factor];
                between.spread(&unknowns, &mut out);
                for (k, (out, densities)) in out.into_iter().zip(&densities).enumerate() {
                    assert!((out - 1.0 - 2.0 * densities[j]).abs() < 1e-15, "node {k}: {out}");
                }
            }
            let shares = [1.0].into_iter().chain(grid.beyond(1).into_iter().map(|(_, share)| share));
            let sum: f64 = between.sums_from_last().iter().zip(shares).map(|(sum, share)| share * sum).sum();
            let expected: f64 = densities.iter().filter_map(|densities| densities.last()).sum();
            assert!((sum - expected).abs() < 1e-15, "{sum} for {expected}");
        }
    }
}
