//! What a resolution and a parity fix, whatever the half-width: nodes, Cauchy matrix, edge functional.

use super::apart::Apart;
use super::map::Place;
use super::series::alternating;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::Edge;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};

/// `n + 1` nodes `u_j = j step` and `n` staggered points `v_i = (i + 1/2) step` on half of `[-1, 1]`.
///
/// Unknowns are `F_j = f(x_j) sqrt(1 - x_j^2)`, `j = first..=n`. Rows are multiplied by
/// `x'(v_i)/sqrt(1 - x_i^2)`: both ways of scaling leave entries and unknowns of order one at the edge.
pub(super) struct Grid {
    pub(super) odd: bool,
    pub(super) edge: Edge,
    pub(super) step: f64,
    /// Nodes, the middle one included.
    pub(super) nodes: Vec<Place>,
    /// Collocation points.
    pub(super) staggered: Vec<Place>,
    /// Index of the node of the first unknown: an odd density has none in the middle.
    pub(super) first: usize,
    /// `x'(v_i)/sqrt(1 - x_i^2)`, the factor of each row.
    pub(super) scale: Vec<f64>,
    /// Cauchy part of the operator.
    pub(super) cauchy: Vec<f64>,
    /// `lim F` at the upper end as a sum over the unknowns.
    pub(super) edge_row: Vec<f64>,
    /// Factors of `F` and of `lim F/ending` that make of them `(-1)^j y_j`, see [`super::shape::Shape`].
    pub(super) series: Vec<[f64; 2]>,
    /// Nodes before `F` of a sharp edge is its own limit to rounding.
    pub(super) plateau: usize,
    /// `int f dx` on `[-1, 1]` as a sum over the unknowns.
    pub(super) resultant: Vec<f64>,
}

/// From here on `F` of a sharp edge is its own limit to rounding: what is left is `gap log gap`,
/// `gap/c = 2 exp(-2 w)`.
const PLATEAU: f64 = 20.0;
/// From this `u` on `x'/sqrt(1 - x^2)` is a rounding of what it is where the widest grid ends.
const LAST_SLOPE: f64 = 6.1;
/// A share of what the last node weighs.
const NOTHING: f64 = 1e-17;

impl Grid {
    /// Numbers held, about.
    pub(super) fn numbers(&self) -> usize {
        self.cauchy.len()
    }

    pub(super) fn new(n: usize, u_max: f64, odd: bool, edge: Edge) -> Self {
        let step = u_max / n as f64;
        let nodes: Vec<Place> = (0..=n).map(|j| Place::new(j as f64 * step)).collect();
        let staggered: Vec<Place> = (0..n).map(|i| Place::new((i as f64 + 0.5) * step)).collect();
        let first = usize::from(odd);
        let scale: Vec<f64> = staggered.iter().map(|v| v.slope).collect();
        let cauchy = cauchy(&nodes, &staggered, step, odd);
        let both = |u: &Place| if odd { 0.0 } else { 2.0 * step * u.slope };
        let mut resultant: Vec<f64> = nodes[first..].iter().map(both).collect();
        if !odd {
            resultant[0] *= 0.5;
            if edge == Edge::Sharp {
                resultant[n] += 2.0 * tail(&nodes, step);
            }
        }
        let series = nodes.iter().enumerate().map(|(j, u)| series_factors(j, u, edge, odd)).collect();
        let plateau = nodes.iter().take_while(|u| u.w < PLATEAU).count();
        let edge_row = Vec::new();
        let mut grid =
            Self { odd, edge, step, nodes, staggered, first, scale, cauchy, edge_row, series, plateau, resultant };
        grid.go_on();
        grid.make_exact();
        grid.edge_row = if edge == Edge::Continued { grid.edge_locally() } else { grid.edge_functional() };
        grid
    }

    pub(super) fn unknowns(&self) -> usize {
        self.nodes.len() - self.first
    }

    /// Along which curve a density that does not vanish runs into its end, where only the end is known.
    pub(super) fn ending(&self, x: f64) -> f64 {
        ending(x, self.odd)
    }

    /// The places beyond the last node in steps of a `factor`-th, with `F` there over that at the last node: it goes on
    /// as that of the simplest density does. Those that weigh less than a rounding are left out.
    pub(super) fn beyond(&self, factor: usize) -> Vec<(Place, f64)> {
        let last = self.nodes.len() - 1;
        let (end, fine_step) = (self.nodes[last], self.step / factor as f64);
        let of_last = simplest(&end, self.edge, self.odd);
        (last * factor + 1..=vanished(fine_step))
            .map(|k| Place::new(k as f64 * fine_step))
            .map(|place| (place, simplest(&place, self.edge, self.odd) / of_last))
            .take_while(|(place, share)| place.slope * share > NOTHING * end.slope)
            .collect()
    }

    /// Adds to the last column what those places contribute: left out, it would be missed by as much as the density
    /// there weighs, the root of the last gap at a sharp edge.
    fn go_on(&mut self) {
        let (unknowns, beyond) = (self.unknowns(), self.beyond(1));
        for (v, row) in self.staggered.iter().zip(self.cauchy.chunks_exact_mut(unknowns)) {
            let each = |(u, share): &(Place, f64)| {
                share * u.slope * (if self.odd { u.x } else { v.x }) / ((u.gap - v.gap) * (v.x + u.x))
            };
            row[unknowns - 1] += FRAC_2_PI * self.step * v.slope * beyond.iter().map(each).sum::<f64>();
        }
    }

    /// Factors of the last two `F` that make `F` at a place beyond, of a density that is finite at the end: it goes on
    /// with its slope over the root of the gap.
    pub(super) fn finite_beyond(&self, place: &Place) -> [f64; 2] {
        let [.., before, last] = &self.nodes[..] else { unreachable!("two nodes at least") };
        let rise = (last.sech - place.sech) / (before.sech - last.sech);
        [-rise * place.sech / before.sech, (1.0 + rise) * place.sech / last.sech]
    }

    /// Adds to each row a multiple of `F_i + F_i+1` that makes it exact for the simplest density of its kind.
    ///
    /// Seen from a point near an end, `1/(x_i - x(u))` has poles at `w_i + i pi m` besides the one at `w_i`, and
    /// they lie only `2 m/cosh v_i` off the real axis: the sum errs by `exp(-4 pi/(step cosh v_i))` times `F` there,
    /// whose form near the end is the same for all densities of a kind. What the nodes missing beyond the last
    /// one would add is alike. In the middle the correction is rounding.
    fn make_exact(&mut self) {
        let edge = self.edge;
        let unknowns = self.unknowns();
        let simplest: Vec<f64> = self.nodes.iter().map(|u| simplest(u, edge, self.odd)).collect();
        for (i, row) in self.cauchy.chunks_mut(unknowns).enumerate() {
            let got: f64 = row.iter().zip(&simplest[self.first..]).map(|(a, f)| a * f).sum();
            let exact = self.scale[i] * simplest_integral(&self.staggered[i], edge, self.odd);
            let share = (exact - got) / (simplest[i] + simplest[i + 1]);
            for node in [i, i + 1] {
                if node >= self.first {
                    row[node - self.first] += share;
                }
            }
        }
    }

    /// What is neither `gap` nor its power 3/2 in the last three `F`: 0 for a density that vanishes.
    fn edge_locally(&self) -> Vec<f64> {
        let mut row = vec![0.0; self.unknowns()];
        let (Some(factors), [.., u, v, w]) = (row.last_chunk_mut(), &self.nodes[..]) else {
            unreachable!("three nodes at least")
        };
        // Factors with which `gap` and its power sum to 0, that of the last being 1.
        let (s, t) = (w.gap / u.gap, w.gap / v.gap);
        *factors =
            [-s * (1.0 - t.sqrt()) / (1.0 - (t / s).sqrt()), -t * (1.0 - s.sqrt()) / (1.0 - (s / t).sqrt()), 1.0];
        row
    }

    /// `pi F(1) = int f dx - int sqrt((1 + t)/(1 - t)) C(t) dt` with `C = (1/pi) PV int f(r)/(t - r) dr`.
    ///
    /// Folded by parity the second integrand is `t C/sqrt(1 - t^2)` for even densities and
    /// `C/sqrt(1 - t^2)` for odd ones; the rows of the Cauchy matrix are its samples at the staggered points.
    fn edge_functional(&self) -> Vec<f64> {
        let mut row: Vec<f64> = self.resultant.iter().map(|r| r / PI).collect();
        // Beyond the last point C goes on with its slope over the root of the gap. Weights there are summed, not taken
        // as the rest of pi/2: the rest's rounding would be multiplied by 1/scale.
        let points = self.staggered.len();
        let [before, last] = [points - 2, points - 1].map(|i| self.staggered[i].sech);
        let mut share = vec![self.step; points];
        for place in (points..vanished(self.step)).map(|i| Place::new((i as f64 + 0.5) * self.step)) {
            let rise = (last - place.sech) / (before - last);
            share[points - 2] -= self.step * place.slope * rise / self.scale[points - 2];
            share[points - 1] += self.step * place.slope * (1.0 + rise) / self.scale[points - 1];
        }
        for ((share, v), cauchy) in share.into_iter().zip(&self.staggered).zip(self.cauchy.chunks(row.len())) {
            let weight = -2.0 / PI * share * if self.odd { 1.0 } else { v.x };
            for (entry, c) in row.iter_mut().zip(cauchy) {
                *entry += weight * c;
            }
        }
        row
    }
}

/// `(1/pi) scale_i step P_j [1/(x_i - x_j) +- 1/(x_i + x_j)]` per unit of `F_j`: with the bracket as one fraction
/// `(2/pi) scale_i step slope_j x/[(x_i - x_j) (x_i + x_j)]`, `x` being `x_i` or, where odd, `x_j`.
fn cauchy(nodes: &[Place], staggered: &[Place], step: f64, odd: bool) -> Vec<f64> {
    let of_each = |what: fn(&Place) -> f64| nodes.iter().map(what).collect::<Vec<f64>>();
    let (x, sech, mut slope) = (of_each(|u| u.x), of_each(|u| u.sech), of_each(|u| u.slope));
    // The middle node has no mirror image.
    slope[0] *= 0.5;
    let apart = Apart::new(staggered.len(), 1, step);
    let mut rows = vec![0.0; staggered.len() * (nodes.len() - usize::from(odd))];
    Arch::new().dispatch(Cauchy { apart, staggered, x: &x, sech: &sech, slope: &slope, step, odd, rows: &mut rows });
    rows
}

/// See [`cauchy`].
struct Cauchy<'a> {
    apart: Apart,
    staggered: &'a [Place],
    x: &'a [f64],
    sech: &'a [f64],
    slope: &'a [f64],
    step: f64,
    odd: bool,
    rows: &'a mut [f64],
}

impl WithSimd for Cauchy<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { apart, staggered, x, sech, slope, step, odd, rows } = self;
        let first = usize::from(odd);
        let mut minus = vec![0.0; x.len()];
        for ((i, v), row) in staggered.iter().enumerate().zip(rows.chunks_exact_mut(x.len() - first)) {
            apart.minus_into((i, v), sech, &mut minus);
            let of_row = FRAC_2_PI * step * v.slope;
            let each = minus[first..].iter().zip(&x[first..]).zip(&slope[first..]);
            for (entry, ((minus, x), slope)) in row.iter_mut().zip(each) {
                *entry = of_row * slope * (if odd { *x } else { v.x }) / (minus * (v.x + x));
            }
        }
    }
}

/// Steps up to [`LAST_SLOPE`].
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few times the number of nodes
fn vanished(step: f64) -> usize {
    (LAST_SLOPE / step) as usize
}

fn ending(x: f64, odd: bool) -> f64 {
    if odd { x } else { 1.0 }
}

/// What multiplies `F_j` and the limit in `(-1)^j y_j`: `F - limit` at a sharp edge, `(F/s^2 - limit) sqrt(s)` at a
/// smooth one, `F/s - limit s` at a continued one.
fn series_factors(j: usize, u: &Place, edge: Edge, odd: bool) -> [f64; 2] {
    let s = u.sech;
    let [of_density, of_limit] = match edge {
        Edge::Sharp => [1.0, 1.0],
        Edge::Smooth => [1.0 / (s * s.sqrt()), s.sqrt()],
        Edge::Continued => [1.0 / s, s],
    };
    [alternating(j) * of_density, alternating(j) * of_limit * ending(u.x, odd)]
}

/// Weight of all that lies beyond the last of some nodes, where `F` is what it is there: what a trapezoidal sum
/// leaves of `int_0^1 dx/sqrt(1 - x^2)`.
fn tail(nodes: &[Place], step: f64) -> f64 {
    let sum: f64 = nodes.iter().rev().map(|u| u.slope).sum();
    FRAC_PI_2 - step * (sum - 0.5 * nodes[0].slope)
}

/// `F` of the simplest density of a kind: `f = 1/s` or `s` with `s = sqrt(1 - x^2)`, times `x` where odd.
fn simplest(u: &Place, edge: Edge, odd: bool) -> f64 {
    let power = match edge {
        Edge::Sharp => 1.0,
        Edge::Smooth | Edge::Continued => u.sech * u.sech,
    };
    if odd { power * u.x } else { power }
}

/// `(1/pi) PV int f(r)/(x - r) dr` of the density of [`simplest`].
fn simplest_integral(v: &Place, edge: Edge, odd: bool) -> f64 {
    match (edge, odd) {
        (Edge::Sharp, false) => 0.0,
        (Edge::Sharp, true) => -1.0,
        (_, false) => v.x,
        (_, true) => v.x * v.x - 0.5,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A stick zone ends where nothing of `F` is left but what goes with the gap and with its power 3/2: without the
    /// power `1 - a/b` was off by 6e-10 with this grid, and is by 8e-11.
    #[test]
    fn the_condition_at_the_end_of_a_stick_zone_takes_off_the_gap_and_its_power() {
        let grid = Grid::new(32, 2.2, true, Edge::Continued);
        let row = &grid.edge_row;
        let sum = |power: f64| {
            let terms = grid.nodes[grid.first..].iter().zip(row).map(|(node, factor)| factor * node.gap.powf(power));
            let (sum, size) = terms.fold((0.0, 0.0), |(sum, size), term| (sum + term, size + term.abs()));
            sum / size
        };
        for power in [1.0, 1.5] {
            assert!(sum(power).abs() < 1e-14, "the power {power}: {}", sum(power));
        }
        assert!(sum(0.0).abs() > 0.1, "what is singular stays: {}", sum(0.0));
    }
}
