//! The strain of the surface that friction left in the stick zone, from the tractions of the whole contact:
//! `-u'(x)/A0 = (1/pi) PV int q(r)/(x - r) dr + (1/pi) int q k_uu(x - r) dr + beta p(x) - (1/pi) int p k_uv(x - r) dr`.
//!
//! Each traction is sampled once on double-exponential grids between the points at which it is not analytic: the
//! middle, the kinks of the shape, where the stick zone ended when the contact reached them, both ends of the slip
//! zone. In between it is told by sinc functions in the grid's own variable. The integrals are split at `x`, where the
//! kernels jump.

use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::work::budget::Meter;
use slipzone_api::double_exponential::{self, Node};
use slipzone_api::{Component, Refusal, Station};
use std::f64::consts::PI;

/// Where the grids end in `u`: 4e-13 of a piece is left out at either end. Beyond that, a distance to a point that is
/// not the middle has lost its digits.
const END: f64 = 2.9;
/// What is left out there, over the piece. Kernels that begin with a power of the distance below 1 have that power of
/// it, times as much: towards the point at which the strain is told grids go on until that is as small, or to where
/// such kernels end.
///
/// Measured on laws that begin with `y^0.5` and `y^0.3`: strains off by up to 4e-5 and 2e-2 of the largest with grids
/// that ended here.
const LEFT_OUT: f64 = 4e-13;
/// Where they end at the latest.
const FARTHEST: f64 = 5.8;
/// Nodes on either side.
///
/// Measured with 14, 18, 24, 32: under a cylinder on a half-plane errors of 1e-8 with any of them, which is that of the
/// tractions; on graded layers, seen under two loads, 2e-5, 3e-6, 1e-7, 1e-8 apart. Under a wedge on a layer twice as
/// thick as the contact is wide, eight times as soft below, 1e-4 with 32, 3e-7 with 64, 2e-9 with 96.
const NODES: f64 = 32.0;
/// Nodes per length of the kernel.
const NODES_PER_LENGTH: f64 = 8.0;
/// Nodes at which tractions are asked for at most, if no more than that are due to a narrow zone: kernels may vary over
/// far shorter lengths than they do, and a traction of a contact that grew takes thousands of flat punches.
const TOLD: f64 = 256.0;
/// Distance to a corner, over its own to the middle, from which positions beside it are told apart: rounding changes
/// the logarithm there by as much as its neglected companion, the distance times the logarithm.
const TOLD_APART: f64 = 1e-9;
/// Share of those nodes that is tried first.
const FIRST_SHARE: f64 = 0.75;
/// By how much the share grows until the strain no longer depends on it.
const GROWTH: f64 = 1.5;
const LARGEST_SHARE: f64 = 6.0;
/// Most points at which the strains of two grids are compared.
const COMPARED: usize = 12;
/// What a finer grid must leave of what the one before changed, to be more than rounding.
const SHRINKING: f64 = 0.5;

/// Most nodes.
const MOST_NODES: usize = 1 << 11;

/// Strains at points of a contact.
pub(crate) struct Strains<T> {
    /// One for each of the points.
    pub(crate) each: Vec<T>,
    /// By how much coarser grids change one of them.
    pub(crate) apart: f64,
}

/// Where tractions are not analytic, and how finely they are sampled in between.
pub(crate) struct Sampling<'a> {
    /// Ascending from 0 to the half-width.
    pub(crate) breaks: &'a [f64],
    /// Those of them at which tractions are unbounded, but for the middle.
    pub(crate) corners: &'a [f64],
    /// How much finer than others they must be resolved.
    pub(crate) crowding: f64,
    /// Over which length the kernels vary.
    pub(crate) length: f64,
}

impl Sampling<'_> {
    /// The strains over `A0` at points `0 <= x < b`, by grids as fine as `wanted` asks; `tractions` tells `p` and `q`
    /// at points inside the contact, and `None` where they are not known. Refused where the budget is used up.
    pub(crate) fn strains(
        &self,
        layer: &PreparedLayer,
        beta: f64,
        (at, wanted): (&[f64], f64),
        mut tractions: impl FnMut(&[Station]) -> Option<[Vec<f64>; 2]>,
    ) -> Result<Option<Strains<f64>>, Refusal> {
        if at.is_empty() {
            return Ok(Some(Strains { each: Vec::new(), apart: 0.0 }));
        }
        // Every so many of them are compared.
        let every = at.len().div_ceil(COMPARED).max(1);
        let left_out = left_out(layer);
        let (mut share, mut apart) = (FIRST_SHARE, f64::INFINITY);
        let mut before: Option<Vec<f64>> = None;
        loop {
            let sampled = Strain::new(self, (share, left_out), layer.meter(), &mut tractions)?;
            let Some(mut strain) = sampled else { return Ok(None) };
            let now = at.iter().step_by(every).map(|x| strain.at(layer, beta, *x)).collect::<Result<Vec<f64>, _>>()?;
            if let Some(before) = before {
                let moved = before.iter().zip(&now).map(|(before, now)| (before - now).abs()).fold(0.0, f64::max);
                if moved <= wanted || moved > SHRINKING * apart || share * GROWTH > LARGEST_SHARE {
                    let one = |(i, x): (usize, &f64)| {
                        if i.is_multiple_of(every) { Ok(now[i / every]) } else { strain.at(layer, beta, *x) }
                    };
                    let each = at.iter().enumerate().map(one).collect::<Result<_, Refusal>>()?;
                    return Ok(Some(Strains { each, apart: moved }));
                }
                apart = moved;
            }
            before = Some(now);
            share *= GROWTH;
        }
    }
}

/// Sampled tractions, for the strain that belongs to them.
struct Strain {
    half_width: f64,
    pieces: Vec<Piece>,
    /// Nodes of each piece at which tractions are told.
    told: usize,
    /// A grid of unit length.
    grid: Vec<Node>,
    /// The same, towards its upper end as far as the kernels ask for.
    towards: Vec<Node>,
    sources: Vec<Source>,
    distances: Vec<f64>,
    kernels: [Vec<f64>; 2],
}

/// What acts at a point `r` and at its mirror image.
#[derive(Clone, Copy)]
struct Source {
    r: f64,
    /// `x - r`.
    apart: f64,
    weight: f64,
    p: f64,
    q: f64,
}

/// The tractions between two points at which they are not analytic.
struct Piece {
    lower: f64,
    upper: f64,
    p: Traction,
    q: Traction,
}

/// One traction over a piece.
struct Traction {
    values: Vec<f64>,
    /// What it is like at the ends, a constant and a logarithm of the distance to each; taken off, nothing is left
    /// there.
    ends: [[f64; 2]; 2],
    /// What then is left at the nodes, of alternating sign.
    rest: Vec<f64>,
}

impl Strain {
    /// Samples the tractions with a share of the nodes, and towards points at which the strain is told leaves out that
    /// much of a piece.
    fn new(
        &Sampling { breaks, corners, crowding, length }: &Sampling,
        (share, left_out): (f64, f64),
        meter: &Meter,
        tractions: &mut impl FnMut(&[Station]) -> Option<[Vec<f64>; 2]>,
    ) -> Result<Option<Self>, Refusal> {
        let half_width = breaks[breaks.len() - 1];
        let longest = breaks.windows(2).map(|ends| ends[1] - ends[0]).fold(0.0, f64::max);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a positive count; `as` saturates
        let count = |nodes: f64| ((share * nodes).ceil() as usize).min(MOST_NODES);
        let (of_tractions, of_kernel) = (NODES * crowding, NODES_PER_LENGTH * longest / length);
        let nodes = count(of_tractions.max(of_kernel));
        let told = count(of_tractions.max(of_kernel.min(TOLD)));
        let grid = double_exponential::nodes_up_to(1.0, nodes, END);
        let asked = double_exponential::nodes_up_to(1.0, told, END);
        let towards = towards(&grid, nodes, left_out);
        let mut pieces = Vec::with_capacity(breaks.len() - 1);
        for ends in breaks.windows(2) {
            let (lower, upper) = (ends[0], ends[1]);
            let width = upper - lower;
            let at = |node: &Node| Station {
                x: lower + width * node.from_lower,
                gap: (half_width - upper) + width * node.to_upper,
            };
            meter.within()?;
            let Some(mut sampled) = tractions(&asked.iter().map(at).collect::<Vec<_>>()) else { return Ok(None) };
            for values in &mut sampled {
                if corners.contains(&lower) {
                    continue_logarithm(values.iter_mut().zip(asked.iter().map(|node| width * node.from_lower)), lower);
                }
                if corners.contains(&upper) {
                    let inwards = values.iter_mut().zip(asked.iter().map(|node| width * node.to_upper));
                    continue_logarithm(inwards.rev(), upper);
                }
            }
            let [p, q] = sampled.map(|values| Traction::new(values, &asked).on(&grid));
            pieces.push(Piece { lower, upper, p, q });
        }
        let (sources, distances, kernels) = (Vec::new(), Vec::new(), [Vec::new(), Vec::new()]);
        Ok(Some(Self { half_width, pieces, told: asked.len(), grid, towards, sources, distances, kernels }))
    }

    /// `u'(x)/A0` at `0 <= x < b`; refused where the budget is used up.
    fn at(&mut self, layer: &PreparedLayer, beta: f64, x: f64) -> Result<f64, Refusal> {
        // Both tractions at both nodes for one, each a sum over all nodes at which they are told.
        layer.meter().count_multiplications(4 * self.told * self.towards.len());
        layer.meter().within()?;
        let [p, q] = self.see_from(x);
        let count = self.sources.len();
        self.distances.clear();
        self.distances.extend(self.sources.iter().map(|source| source.apart));
        self.distances.extend(self.sources.iter().map(|source| x + source.r));
        for (out, component) in self.kernels.iter_mut().zip([Component::ShearStrain, Component::Coupling]) {
            out.resize(2 * count, 0.0);
            layer.kernel_values(component, &self.distances, out);
        }
        let [by_shear, by_pressure] = &self.kernels;
        let mut sum = 0.0;
        for (i, source) in self.sources.iter().enumerate() {
            // q is odd and p is even: 1/(x - r) - 1/(x + r), and the kernels likewise.
            let cauchy = (source.q - q) * 2.0 * source.r / (source.apart * (x + source.r));
            let shear = source.q * (by_shear[i] - by_shear[count + i]);
            let pressure = source.p * (by_pressure[i] + by_pressure[count + i]);
            sum += source.weight * (cauchy + shear - pressure);
        }
        // PV int 2 r/(x^2 - r^2) dr, of what was taken off.
        let b = self.half_width;
        let taken_off = if x > 0.0 { q * (x * x / ((b - x) * (b + x))).ln() } else { 0.0 };
        Ok(-((sum + taken_off) / PI + beta * p))
    }

    /// Lists what acts, seen from `x`; returns the tractions there.
    fn see_from(&mut self, x: f64) -> [f64; 2] {
        let Self { pieces, grid, towards, sources, .. } = self;
        sources.clear();
        let mut here = None;
        for piece in pieces.iter() {
            let width = piece.upper - piece.lower;
            let (from_lower, to_upper) = (x - piece.lower, piece.upper - x);
            if from_lower <= 0.0 || to_upper <= 0.0 {
                for (i, node) in grid.iter().enumerate() {
                    let r = piece.lower + width * node.from_lower;
                    let apart = if to_upper <= 0.0 {
                        -to_upper + width * node.to_upper
                    } else {
                        from_lower - width * node.from_lower
                    };
                    let (p, q) = (piece.p.values[i], piece.q.values[i]);
                    sources.push(Source { r, apart, weight: width * node.weight, p, q });
                }
                continue;
            }
            here = Some([&piece.p, &piece.q].map(|traction| traction.at(from_lower / width, to_upper / width)));
            for node in towards.iter() {
                let (below, above) = (from_lower * node.to_upper, to_upper * node.to_upper);
                let places = [
                    (below, from_lower * node.from_lower, to_upper + below, from_lower * node.weight),
                    (-above, from_lower + above, to_upper * node.from_lower, to_upper * node.weight),
                ];
                for (apart, from_lower, to_upper, weight) in places {
                    let [p, q] = [&piece.p, &piece.q].map(|traction| traction.at(from_lower / width, to_upper / width));
                    sources.push(Source { r: piece.lower + from_lower, apart, weight, p, q });
                }
            }
        }
        // On a point between two pieces; in the middle, where there is no shear.
        here.unwrap_or_else(|| {
            let after = pieces.iter().find(|piece| x <= piece.lower);
            let first = |traction: &Traction| traction.values[0];
            after.map_or([0.0; 2], |piece| [first(&piece.p), if x > 0.0 { first(&piece.q) } else { 0.0 }])
        })
    }
}

/// How much of a piece may be left out beside a point: of kernels that are not told down to it, where they are flat,
/// and so little that pieces may be far wider than the layer is thick.
fn left_out(layer: &PreparedLayer) -> f64 {
    match layer.kernel_power() {
        Some(power) => LEFT_OUT.powf(power.recip()),
        None => LEFT_OUT * layer.nearest().unwrap_or(1.0),
    }
    .min(LEFT_OUT)
}

/// A grid of so many nodes on either side, which goes on towards its upper end until no more than that is left out
/// there.
fn towards(grid: &[Node], nodes: usize, left_out: f64) -> Vec<Node> {
    if left_out >= LEFT_OUT {
        return grid.to_vec();
    }
    let (end, step) = ((-left_out.ln() / PI).asinh().min(FARTHEST), END / nodes as f64);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few times as many
    let all = ((end / step).ceil() as usize).max(nodes);
    double_exponential::nodes_up_to(1.0, all, step * all as f64).split_off(all - nodes)
}

/// The grid's variable of a point, from its distances to both ends of a unit interval.
fn variable(from_lower: f64, to_upper: f64) -> f64 {
    ((from_lower / to_upper).ln() / PI).asinh()
}

/// Values from a corner at `end` inwards, at those distances to it: a constant and a logarithm of the distance, as near
/// to it as positions are no longer told apart.
fn continue_logarithm<'a>(values: impl Iterator<Item = (&'a mut f64, f64)>, end: f64) {
    let (mut near, rest): (Vec<_>, Vec<_>) = values.partition(|(_, distance)| *distance < TOLD_APART * end);
    let [(one, here), (other, there), ..] = &rest[..] else { return };
    let factor = (**other - **one) / (there / here).ln();
    for (value, distance) in &mut near {
        **value = **one + factor * (*distance / here).ln();
    }
}

impl Traction {
    fn new(values: Vec<f64>, grid: &[Node]) -> Self {
        let last = grid.len() - 1;
        let end = |outer: usize, next: usize, distance: &dyn Fn(&Node) -> f64| {
            let logarithms = [outer, next].map(|i| distance(&grid[i]).ln());
            let factor = (values[next] - values[outer]) / (logarithms[1] - logarithms[0]);
            [values[outer] - factor * logarithms[0], factor]
        };
        let ends = [end(0, 1, &|node| node.from_lower), end(last, last - 1, &|node| node.to_upper)];
        let mut sign = 1.0;
        let rest = values.iter().zip(grid).map(|(value, node)| {
            sign = -sign;
            sign * (value - at_ends(&ends, node.from_lower, node.to_upper))
        });
        let rest = rest.collect();
        Self { values, ends, rest }
    }

    /// The same with values at the nodes of another grid.
    fn on(mut self, grid: &[Node]) -> Self {
        if grid.len() != self.values.len() {
            self.values = grid.iter().map(|node| self.at(node.from_lower, node.to_upper)).collect();
        }
        self
    }

    /// Its value between the nodes.
    fn at(&self, from_lower: f64, to_upper: f64) -> f64 {
        let middle = (self.rest.len() / 2) as f64;
        let place = variable(from_lower, to_upper) * middle / END + middle;
        let nearest = place.round();
        // sin(pi (place - j))/(pi (place - j)), the sine up to its sign being that of the distance to the nearest node.
        let off = place - nearest;
        let at_ends = at_ends(&self.ends, from_lower, to_upper);
        if off.abs() < 1e-12 {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a node's number, or beside the grid
            let rest = if nearest < 0.0 { None } else { self.rest.get(nearest as usize) };
            let sign = if nearest % 2.0 == 0.0 { -1.0 } else { 1.0 };
            return at_ends + sign * rest.unwrap_or(&0.0);
        }
        let sum: f64 = self.rest.iter().enumerate().map(|(j, rest)| rest / (place - j as f64)).sum();
        let sign = if nearest.rem_euclid(2.0) == 0.0 { -1.0 } else { 1.0 };
        at_ends + sign * (PI * off).sin() / PI * sum
    }
}

/// What a traction is like at the ends of a unit interval, each faded out towards the other.
fn at_ends([lower, upper]: &[[f64; 2]; 2], from_lower: f64, to_upper: f64) -> f64 {
    (lower[0] + lower[1] * from_lower.ln()) * to_upper + (upper[0] + upper[1] * to_upper.ln()) * from_lower
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tractions_are_not_asked_for_as_finely_as_short_kernels_are_summed() {
        let sampling = Sampling { breaks: &[0.0, 0.4, 1.0], corners: &[], crowding: 1.0, length: 1e-3 };
        let p = |at: &Station| (at.gap * (2.0 - at.gap)).sqrt();
        let q = |at: &Station| if at.x < 0.4 { 0.3 - (0.4 - at.x).powf(0.7) } else { p(at) };
        let mut asked = 0;
        let mut tractions = |at: &[Station]| {
            asked += at.len();
            Some([at.iter().map(p).collect(), at.iter().map(q).collect()])
        };
        let strain = Strain::new(&sampling, (1.0, LEFT_OUT), &Meter::default(), &mut tractions).unwrap().unwrap();
        assert_eq!(asked, 2 * (2 * 256 + 1));
        assert!(strain.grid.len() > 4 * strain.told, "{} nodes", strain.grid.len());
        for piece in &strain.pieces {
            let values = piece.p.values.iter().zip(&piece.q.values);
            for (node, (of_p, of_q)) in strain.grid.iter().zip(values) {
                let width = piece.upper - piece.lower;
                let at = Station {
                    x: piece.lower + width * node.from_lower,
                    gap: 1.0 - piece.upper + width * node.to_upper,
                };
                assert!((of_p - p(&at)).abs() < 1e-8 && (of_q - q(&at)).abs() < 1e-8, "at {}: {of_p}, {of_q}", at.x);
            }
        }
    }
}
