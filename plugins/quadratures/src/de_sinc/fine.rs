//! Where the kernel part is summed: the nodes, or a grid an odd number of times as fine.

use super::apart::{Apart, descending};
use super::between::Between;
use super::beyond::Beyond;
use super::grid::Grid;
use super::integrals::{at_halves, at_wholes};
use super::map::Place;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::Edge;
use slipzone_api::elementary::{EULER_GAMMA, LANES, ln};
use std::f64::consts::PI;
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
    /// `sech w_k`.
    sech: Vec<f64>,
    staggered: Vec<Place>,
    apart: Apart,
    /// `Ci(pi d)` like the weights of the sign.
    cosine_descending: Vec<f64>,
    cosine_ascending: Vec<f64>,
    /// What the weights of both logarithms are at the last node, for each staggered point: it stands for the places
    /// beyond, too.
    log_beyond: Vec<[f64; 2]>,
    /// [`Rows`] of all staggered points, unless these are many.
    held: Vec<f64>,
    /// That of the end.
    of_end: Vec<f64>,
    /// Weight of the sign at `d = (2 n - 1)/2 factor, ... , -n factor + factor/2`, descending.
    sign_descending: Vec<f64>,
    /// Weight of the sign at `d = 1/2, 3/2, ...`.
    sign_ascending: Vec<f64>,
    /// Weight of the sign seen from the end, where no step is near.
    ones: Vec<f64>,
    /// Weight of the sign and of the logarithm of the distance from the middle, which is a node: `d = 0, 1, ...`.
    pub(super) centre: (Vec<f64>, Vec<f64>),
    /// What the weights of the sign lack there and at its mirror image, for the end as well.
    sign_beyond: Vec<[f64; 2]>,
    /// How many fine nodes matter, per row and for the end, filled up.
    reach: Vec<usize>,
    /// `step/factor P_k` per unit of `F_j`, where the fine node is a node.
    pub(super) weight: Vec<f64>,
    /// The same for the fine nodes between.
    between: Between,
    /// What of the last two `F` of a density that is finite at the end to take for the last one: its weights stand for
    /// the places beyond, where such a density goes on otherwise than an unknown one. Of densities that may be
    /// singular, or vanish, it is not known.
    finite_end: [f64; 2],
}

/// A term this small beside the largest of its kind is left out: it stands for `1e-13` of a rounding even
/// where the kernel is some `1e7` times as large as the Cauchy part.
const NEGLIGIBLE: f64 = 1e-22;

/// Most numbers of all rows that are held, 8 MB; more are found again whenever rows are summed, which takes half as
/// long again.
const HELD: usize = 1 << 20;

/// Some rows, one for each staggered point or for the end: at each fine node `x_i - x_k`, then the weights of the
/// logarithm of `|x_i - x_k|`, then those of the logarithm of `x_i + x_k`.
#[derive(Clone, Copy)]
pub(super) struct Rows<'a> {
    fine: &'a Fine,
    first: usize,
    table: &'a [f64],
}

/// Weights of some nodes of one row of a [`Fine`].
pub(super) struct Row<'a> {
    pub(super) log_minus: &'a [f64],
    pub(super) log_plus: &'a [f64],
    pub(super) sign_minus: &'a [f64],
    pub(super) sign_plus: &'a [f64],
    /// The index of the last node among these, if it is, and [`Fine::sign_beyond`].
    pub(super) beyond: Option<(usize, [f64; 2])>,
}

impl Fine {
    /// Numbers held, about.
    pub(super) fn numbers(&self) -> usize {
        self.held.len() + self.between.numbers() + 24 * self.x.len()
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
        let places_beyond = grid.beyond(factor);
        // Half-integers up to d = n factor - factor/2 + n factor, and beyond for what fills up or lies beyond.
        let halves = 2 * n * factor + LANES.max(places_beyond.len());
        let (sign_ascending, cosine_ascending) = at_halves(halves);
        let farthest = n * factor - factor / 2;
        let sign_descending = descending(&sign_ascending, farthest, -1.0);
        let cosine_descending = descending(&cosine_ascending, farthest, 1.0);
        let (centre_sign, centre_cosine) = at_wholes(last + LANES.max(places_beyond.len()));
        // At `d = 0` the limit of `log|x'(0) d step| - Ci(pi d)`.
        let at_middle = (places[0].slope * fine_step / PI).ln() - EULER_GAMMA;
        let others = places[1..].iter().zip(&centre_cosine).map(|(place, cosine)| place.x.ln() - cosine);
        let centre_log = [at_middle].into_iter().chain(others).collect();

        let mut fine = Self {
            factor,
            x: places.iter().map(|p| p.x).collect(),
            sech: places.iter().map(|p| p.sech).collect(),
            staggered: grid.staggered.clone(),
            apart: Apart::new(n, factor, grid.step),
            cosine_descending,
            cosine_ascending,
            log_beyond: Vec::with_capacity(n),
            held: Vec::new(),
            of_end: Vec::with_capacity(3 * filled),
            sign_descending,
            sign_ascending,
            ones: vec![1.0; filled],
            centre: ([0.0].into_iter().chain(centre_sign.iter().copied()).collect(), centre_log),
            sign_beyond: Vec::with_capacity(n + 1),
            reach: Vec::with_capacity(n + 1),
            weight: grid.nodes.iter().map(|u| fine_step * u.slope).collect(),
            between: Between::new(grid, factor),
            finite_end: [0.0, 1.0],
        };
        // The middle node is its own mirror image, and both are summed.
        fine.weight[0] *= 0.5;
        let beyond = Beyond::new(&places[last], fine.weight[n], places_beyond, fine_step);
        if grid.edge == Edge::Continued {
            fine.finite_end = beyond.finite_end(grid, &fine.between);
        }
        fine.weight[n] = beyond.weight;
        let reach = |slope: f64| {
            let matter = places[..count].iter().take_while(|p| slope * p.slope > NEGLIGIBLE).count();
            matter.next_multiple_of(LANES)
        };
        fine.reach.extend(grid.staggered.iter().map(|v| reach(v.slope)));
        fine.reach.push(reach(1.0));
        // The end lies infinitely many steps away: no correction.
        fine.of_end.extend(places.iter().map(|place| place.gap));
        fine.of_end.extend(places.iter().map(|place| place.gap.ln()));
        fine.of_end.extend(places.iter().map(|place| (1.0 + place.x).ln()));
        fine.go_on(&beyond, (&centre_sign, &centre_cosine));
        if 3 * n * filled <= HELD {
            let mut held = vec![0.0; 3 * n * filled];
            fine.write(0..n, true, &mut held);
            fine.held = held;
        }
        fine
    }

    /// Lets the last node's weights of sign and logarithm stand for those of the places beyond it as well, as its
    /// weight in the sum does.
    fn go_on(&mut self, beyond: &Beyond, (sign_at_centre, cosine_at_centre): (&[f64], &[f64])) {
        let (filled, rows) = (self.x.len(), self.rows());
        let last = rows * self.factor;
        for (i, v) in self.staggered.iter().enumerate() {
            // Where the distances of the last node stand, on this side and on the other, and from then on.
            let before = i * self.factor + self.factor / 2;
            let [near, far] = [last - before - 1, last + before];
            let [minus, plus] = [near, far].map(|at| {
                let signs = &self.sign_ascending[at..];
                beyond.mean(signs) - signs[0]
            });
            self.sign_beyond.push([-minus, plus]);
            let cosines = [near, far].map(|at| beyond.mean(&self.cosine_ascending[at..]));
            // `x + x_k` is `1 + x` less the gap.
            self.log_beyond.push([beyond.mean_log(v.gap) - cosines[0], beyond.mean_log(1.0 + v.x) - cosines[1]]);
        }
        // Seen from the end no step is near, and all beyond is as far from its mirror image.
        self.sign_beyond.push([0.0; 2]);
        self.of_end[filled + last] = beyond.mean_log_of_gap();
        let (signs, of_centre) = &mut self.centre;
        signs[last] = beyond.mean(&sign_at_centre[last - 1..]);
        of_centre[last] = beyond.mean_log(1.0) - beyond.mean(&cosine_at_centre[last - 1..]);
    }

    /// Some rows, held or written into the room: as far as each reaches, or all as far as that of the end does.
    pub(super) fn rows_of<'a>(&'a self, rows: Range<usize>, whole: bool, room: &'a mut Vec<f64>) -> Rows<'a> {
        let width = 3 * self.x.len();
        if !self.held.is_empty() {
            return Rows { fine: self, first: 0, table: &self.held };
        }
        let points = rows.start..rows.end.min(self.rows());
        if room.len() < points.len() * width {
            room.resize(points.len() * width, 0.0);
        }
        self.write(points.clone(), whole, &mut room[..points.len() * width]);
        Rows { fine: self, first: points.start, table: room }
    }

    /// Writes the rows of some staggered points.
    fn write(&self, rows: Range<usize>, whole: bool, out: &mut [f64]) {
        Arch::new().dispatch(Distances { fine: self, rows, whole, out });
    }

    /// Makes the last `F` of a density that is finite at the end one that its weights fit.
    pub(super) fn end_finite(&self, density: &mut [f64]) {
        let [.., before, last] = density else { return };
        *last = self.finite_end[0] * *before + self.finite_end[1] * *last;
    }

    /// Number of rows before that of the end.
    #[inline(always)]
    pub(super) fn rows(&self) -> usize {
        self.staggered.len()
    }

    /// Number of fine nodes that matter to a row, filled up.
    #[inline(always)]
    pub(super) fn reach(&self, i: usize) -> usize {
        self.reach[i]
    }

    /// `rows[i][j] = cauchy[i][j] + scale[i] sum_k folded[i][k] (step/factor) dP_k/dF_j` for a few rows of that length,
    /// from row `first` on, and all unknowns `j`.
    pub(super) fn gather(
        &self,
        grid: &Grid,
        (cauchy, folded): (&[f64], &[f64]),
        scale: &[f64],
        (first, rows, length): (usize, &mut [f64], usize),
    ) {
        Arch::new().dispatch(Gather { fine: self, grid, cauchy, folded, scale, rows: (rows, length) });
        // Those that come have no farther reach.
        let reach = self.reach(first);
        self.between.add((folded, self.x.len()), &scale[..rows.len() / length], (rows, length), reach);
    }

    /// `out[k] = (step/factor) P_k` from the unknowns, filled up with zeros.
    pub(super) fn spread(&self, grid: &Grid, unknowns: &[f64], out: &mut Vec<f64>) {
        out.clear();
        out.resize(self.x.len(), 0.0);
        let at_nodes = out.iter_mut().step_by(self.factor).zip(&self.weight).skip(grid.first);
        for ((out, weight), unknown) in at_nodes.zip(unknowns) {
            *out = weight * unknown;
        }
        self.between.spread(unknowns, out);
    }
}

impl<'a> Rows<'a> {
    /// `x_i`, or 1 at the end, and its distances from some nodes.
    #[inline(always)]
    pub(super) fn minus(self, i: usize, nodes: Range<usize>) -> (f64, &'a [f64]) {
        (self.fine.staggered.get(i).map_or(1.0, |v| v.x), &self.all(i)[nodes])
    }

    /// Some nodes of the row of the `i`-th staggered point, or of the end when there are only `i` of them.
    #[inline(always)]
    pub(super) fn row(self, i: usize, nodes: Range<usize>) -> Row<'a> {
        let fine = self.fine;
        let (filled, rows) = (fine.x.len(), fine.rows());
        let (sign_minus, sign_plus) = if i == rows {
            (fine.ones.as_slice(), fine.ones.as_slice())
        } else {
            (
                &fine.sign_descending[(rows - 1 - i) * fine.factor..],
                &fine.sign_ascending[i * fine.factor + fine.factor / 2..],
            )
        };
        let table = self.all(i);
        let last = rows * fine.factor;
        let beyond = nodes.contains(&last).then(|| (last - nodes.start, fine.sign_beyond[i]));
        Row {
            beyond,
            log_minus: &table[filled..2 * filled][nodes.clone()],
            log_plus: &table[2 * filled..][nodes.clone()],
            sign_minus: &sign_minus[nodes.clone()],
            sign_plus: &sign_plus[nodes],
        }
    }

    #[inline(always)]
    fn all(self, i: usize) -> &'a [f64] {
        let width = self.fine.of_end.len();
        if i == self.fine.rows() { &self.fine.of_end } else { &self.table[(i - self.first) * width..][..width] }
    }
}

/// See [`Fine::write`].
struct Distances<'a> {
    fine: &'a Fine,
    rows: Range<usize>,
    whole: bool,
    out: &'a mut [f64],
}

impl WithSimd for Distances<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { fine, rows, whole, out } = self;
        let (n, factor, filled) = (fine.rows(), fine.factor, fine.x.len());
        let last = n * factor;
        for (i, row) in rows.zip(out.chunks_exact_mut(3 * filled)) {
            let v = &fine.staggered[i];
            let (minus, logs) = row.split_at_mut(filled);
            let (log_minus, log_plus) = logs.split_at_mut(filled);
            let count = fine.reach(if whole { n } else { i }).min(last + 1);
            fine.apart.minus_into((i, v), &fine.sech, &mut minus[..count]);
            let near = minus[..count].iter().zip(&fine.cosine_descending[(n - 1 - i) * factor..]);
            for (log, (minus, cosine)) in log_minus.iter_mut().zip(near) {
                *log = ln(minus.abs()) - cosine;
            }
            let far = fine.x[..count].iter().zip(&fine.cosine_ascending[i * factor + factor / 2..]);
            for (log, (x, cosine)) in log_plus.iter_mut().zip(far) {
                *log = ln(v.x + x) - cosine;
            }
            if count <= last {
                continue;
            }
            [log_minus[last], log_plus[last]] = fine.log_beyond[i];
            for part in [minus, log_minus, log_plus] {
                let at_last = part[last];
                part[last + 1..].fill(at_last);
            }
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
    }
}

#[cfg(test)]
mod tests {
    use super::super::resolution::reach;
    use super::*;

    /// As far as each row reaches, and as far as that of the end does; a few rows of them all, and the end alone.
    #[test]
    fn rows_found_again_are_those_held() {
        let (n, factor, edge) = (19, 5, Edge::Sharp);
        let grid = Grid::new(n, reach(n, edge), true, edge);
        let [held, mut again] = [(); 2].map(|()| Fine::new(&grid, factor));
        again.held.clear();
        let mut room = [Vec::new(), vec![f64::NAN; 7]];
        for (rows, whole) in [(0..8, false), (8..16, true), (16..20, true), (16..20, false), (19..20, true)] {
            let [one, other] = &mut room;
            let (held, again) = (held.rows_of(rows.clone(), whole, one), again.rows_of(rows.clone(), whole, other));
            for i in rows {
                let nodes = 0..held.fine.reach(if whole { n } else { i });
                assert!(held.minus(i, nodes.clone()) == again.minus(i, nodes.clone()), "distances of {i}");
                let [held, again] = [held, again].map(|rows| rows.row(i, nodes.clone()));
                assert!(held.log_minus == again.log_minus && held.log_plus == again.log_plus, "logarithms of {i}");
                assert!(held.sign_minus == again.sign_minus && held.beyond == again.beyond, "signs of {i}");
            }
        }
    }
}
