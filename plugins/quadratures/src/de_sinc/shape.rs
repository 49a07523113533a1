//! The density between its nodes.

use super::grid::Grid;
use super::series::{BATCH, Series};
use super::sums::dot;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::double_exponential::locate;
use slipzone_api::{Edge, Station};

/// A density made ready for evaluation, with `s = sqrt(1 - x^2)` and `y` a sum of sinc functions:
/// `f = (limit + y)/s` at sharp edges, `s limit + sqrt(s) y` at smooth ones, `s limit + y` at continued
/// ones; `limit` times `x` where `f` is odd. The root of `s` shares the error of a series cut short between the
/// middle, where it rings, and the end, where `f` is small.
pub(super) struct Shape<'a> {
    grid: &'a Grid,
    limit: f64,
    /// `(-1)^j y_j`, up to where it is all rounding.
    signed: &'a [f64],
}

impl<'a> Shape<'a> {
    /// `room` is scratch.
    pub(super) fn new(grid: &'a Grid, unknowns: &[f64], room: &'a mut Vec<f64>) -> Self {
        assert_eq!(unknowns.len(), grid.unknowns(), "one number per unknown");
        let y = room;
        y.clear();
        y.resize(grid.first, 0.0);
        y.extend_from_slice(unknowns);
        let limit = if grid.edge == Edge::Sharp {
            y.truncate(grid.plateau);
            dot(&grid.edge_row, unknowns)
        } else {
            bound(y, grid)
        };
        for (y, [of_density, of_limit]) in y.iter_mut().zip(&grid.series) {
            *y = of_density * *y - of_limit * limit;
        }
        Self { grid, limit, signed: y.as_slice() }
    }

    /// About how far it is off between the nodes.
    pub(super) fn lost_between(&self) -> f64 {
        let Self { grid: Grid { odd, .. }, signed, .. } = *self;
        Series { signed, odd: *odd, offset: 0.0 }.lost_between()
    }

    /// About how far it is off as close to a sharp end as that, over the half-width: past the last node but one it is
    /// on its way to the limit, which it is taken to have reached at the last. There `y` is still something like the
    /// last gap.
    pub(super) fn lost_at_end(&self, nearest: f64) -> f64 {
        let Self { grid, signed, .. } = *self;
        if grid.edge != Edge::Sharp {
            return 0.0;
        }
        let [.., before, _] = &grid.nodes[..signed.len()] else { return 0.0 };
        if nearest < before.gap { signed.last().map_or(0.0, |y| y.abs()) } else { 0.0 }
    }

    /// The density at points strictly inside an interval of that half-width.
    pub(super) fn values_into(&self, at: &[Station], half_width: f64, out: &mut [f64]) {
        Arch::new().dispatch(Values { shape: self, at, half_width, out });
    }
}

/// A density at some points.
struct Values<'a> {
    shape: &'a Shape<'a>,
    at: &'a [Station],
    half_width: f64,
    out: &'a mut [f64],
}

impl WithSimd for Values<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Shape { grid, limit, signed } = *self.shape;
        let series = Series { signed, odd: grid.odd, offset: 0.0 };
        let (per_step, per_width) = (1.0 / grid.step, 1.0 / self.half_width);
        let (mut t, mut x, mut root, mut sums) = ([0.0; BATCH], [0.0; BATCH], [0.0; BATCH], [0.0; BATCH]);
        for (at, out) in self.at.chunks(BATCH).zip(self.out.chunks_mut(BATCH)) {
            // Loops without a choice in them, which become vector code.
            for (((t, x), root), at) in t.iter_mut().zip(&mut x).zip(&mut root).zip(at) {
                let gap = at.gap * per_width;
                (*t, *x, *root) = (locate(*at) * per_step, at.x * per_width, (gap * (2.0 - gap)).sqrt());
            }
            series.sums_into(simd, &t, at.len(), &mut sums);
            let (x, root, sums) = (&mut x[..at.len()], &root[..at.len()], &mut sums[..at.len()]);
            if grid.odd {
                for (x, sum) in x.iter_mut().zip(&mut *sums) {
                    *sum *= 1.0_f64.copysign(*x);
                    *x *= limit;
                }
            } else {
                x.fill(limit);
            }
            let out = out.iter_mut().zip(&*x).zip(&*sums).zip(root);
            match grid.edge {
                Edge::Sharp => out.for_each(|(((out, limit), varying), root)| *out = (limit + varying) / root),
                Edge::Smooth => {
                    out.for_each(|(((out, limit), varying), root)| *out = root * limit + root.sqrt() * varying);
                }
                Edge::Continued => out.for_each(|(((out, limit), varying), root)| *out = root * limit + varying),
            }
        }
    }
}

/// The factors of two terms which, with a number that is the same at all of them, make what is given at three places.
fn leading([(s, f), (t, g), (u, h)]: [([f64; 2], f64); 3]) -> [f64; 2] {
    // By differences, in which the number is gone.
    let (a, b) = ([s[0] - u[0], s[1] - u[1]], [t[0] - u[0], t[1] - u[1]]);
    let (of_first, of_second) = ((f - h) / a[0], (g - h) / b[0]);
    let second = (of_first - of_second) / (a[1] / a[0] - b[1] / b[0]);
    [of_second - second * b[1] / b[0], second]
}

/// Noise is smaller than this over the largest value.
const NOISY: f64 = 1e-10;
/// Where `F` is more than so many times what it was where it is no noise, over `1 - x^2`, it is noise.
const STEEP: f64 = 10.0;
/// One value of noise may be so many times another.
const SPREAD: f64 = 4.0;

/// Where the first value stands that is noise, and about how large it is; nothing where there is none.
///
/// `F` goes with `s^2 = 1 - x^2` at the end, which noise does not. That may be far less than the rounding of the
/// largest value: a stick zone's system tells small unknowns beside the end as well as large ones.
fn first_noise(f: &[f64], grid: &Grid, largest: f64) -> Option<(usize, f64)> {
    let mut steepest = largest;
    for (j, (f, node)) in f.iter().zip(&grid.nodes).enumerate().skip(grid.first) {
        let (size, square) = (f.abs(), node.sech * node.sech);
        let most = STEEP * steepest * square;
        if size >= NOISY * largest {
            steepest = steepest.max(size / square);
        } else if size > most || size == 0.0 && most < NOISY * largest {
            // A zero is a difference of which nothing is left.
            return Some((j, size.max(most)));
        }
    }
    None
}

/// The node at which to cut `F`, which is known to within `noise`: `f` is off there by `noise/s`, and by `s` times what
/// `F/s^2` still changes by beyond, as far as noise does not explain it. Where both together are least.
///
/// Under a narrow slip zone `F/s^2` changes until the gap is well below its width: cut where `F` is the power 2/3 of
/// its noise, as does where it goes on with the root of the gap, it took three times as many unknowns.
fn cut(f: &[f64], grid: &Grid, noise: f64) -> usize {
    let (mut best, mut least) = (f.len().saturating_sub(1), f64::INFINITY);
    let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
    for (j, (f, node)) in f.iter().zip(&grid.nodes).enumerate().skip(1).rev() {
        let per_square = 1.0 / (node.sech * node.sech);
        let (limit, blur) = (f * per_square, noise * per_square);
        let changed = (highest - limit).max(limit - lowest).max(0.0);
        let lost = node.sech * (blur + changed);
        if lost < least {
            (best, least) = (j, lost);
        }
        (lowest, highest) = (lowest.min(limit + SPREAD * blur), highest.max(limit - SPREAD * blur));
        // Farther in at least half of that is lost.
        if 0.5 * node.sech * (highest - lowest) > least {
            break;
        }
    }
    best
}

/// Takes the noise off `F` and cuts it where nothing else is left; returns `lim F/(1 - x^2)`.
///
/// The singular density that is to be absent is absent up to an error `e` only, and adds nearly the same
/// number to `F` at all nodes; what stays of it once that is taken off is half of `e` or less.
fn bound(f: &mut Vec<f64>, grid: &Grid) -> f64 {
    // The very last node feels the missing ones.
    let n = f.len() - 1;
    let at = n - 1 - n / 32;
    let next = if grid.edge == Edge::Smooth { 2.0 } else { 1.5 };
    let terms = |j: usize| [grid.nodes[j].gap, grid.nodes[j].gap.powf(next)];
    let is_rounding = grid.nodes[at - 2].gap < f64::EPSILON;
    let [first, second] = if is_rounding { [0.0; 2] } else { leading([at - 2, at - 1, at].map(|j| (terms(j), f[j]))) };
    let known = |j: usize| first * terms(j)[0] + second * terms(j)[1];
    let noise = f[at] - known(at);
    let mut largest = 0.0_f64;
    for (f, u) in f.iter_mut().zip(&grid.nodes) {
        *f -= noise * grid.ending(u.x);
        largest = largest.max(f.abs());
    }
    // What is all noise may be nothing at one node.
    let tail = (at + 1..n).map(|j| (f[j] - known(j)).abs()).fold(0.5 * noise.abs(), f64::max);
    let (first, size) = first_noise(&f[..n], grid, largest).unwrap_or((n, 0.0));
    let end = cut(&f[..first], grid, tail.max(size));
    f.truncate(end + 1);
    f[end] / (grid.nodes[end].sech.powi(2) * grid.ending(grid.nodes[end].x))
}
