//! Whether points differ from a convex and symmetric shape by more than their noise.
//!
//! The noise is judged twice and the smaller one taken: by what the fit leaves over, which too large a misfit inflates,
//! and by third differences of that between neighbours, which a sparse table inflates. Means over blocks of neighbours
//! then show what single points hide: of `n` points they scatter by `noise/sqrt(n)`.

use super::folded::Point;
use slipzone_api::Flaw;

/// Blocks of neighbours.
const BLOCKS: usize = 64;

/// How many times its scatter something must be off to be no accident.
pub(super) const CERTAIN: f64 = 8.0;

/// By how much more than that of a parabola a line between neighbours may be off.
const ROOM: f64 = 4.0;

/// All flaws found, at most one of each kind; `residuals` are heights less those of the fit, which are rounded to so
/// much, and to the last decimal given: neighbours that are rounded alike do not scatter, and their means are off by
/// half of it.
pub(super) fn flaws(points: &[Point], residuals: &[f64], (rounding, decimal): (f64, f64)) -> Vec<Flaw> {
    let noise = noise(points, residuals) + rounding;
    let bent = bent(points, noise, decimal).map(|x| Flaw::new("the punch is not convex", x));
    let uneven = uneven(points, residuals, noise, decimal).map(|x| Flaw::new("the punch is not symmetric", x));
    bent.into_iter().chain(uneven).collect()
}

/// Root mean square of the scatter.
fn noise(points: &[Point], residuals: &[f64]) -> f64 {
    let mean_square = |squares: &mut dyn Iterator<Item = f64>| {
        let (sum, count) = squares.fold((0.0, 0.0), |(sum, count), square| (sum + square, count + 1.0));
        if count > 0.0 { sum / count } else { f64::INFINITY }
    };
    let of_fit = mean_square(&mut residuals.iter().map(|r| r * r));
    let sides = [false, true].map(|left| {
        let side = points.iter().zip(residuals).filter(|(point, _)| point.left == left);
        side.map(|(_, r)| *r).collect::<Vec<_>>()
    });
    let differences = sides.iter().flat_map(|side| side.windows(4)).map(|r| r[3] - 3.0 * r[2] + 3.0 * r[1] - r[0]);
    // The weights' squares add up to 20.
    let of_neighbours = mean_square(&mut differences.map(|d| d * d / 20.0));
    of_fit.min(of_neighbours).sqrt()
}

/// Where block means stand above the straight line between others by more than chance, most of all. Those of a convex
/// shape never do, wherever the points are: the line is above each point between, and a mean above the shape at the
/// mean `x`.
fn bent(points: &[Point], noise: f64, decimal: f64) -> Option<f64> {
    let blocks: Vec<(f64, f64, f64)> = blocks(points.len(), BLOCKS)
        .map(|block| {
            let count = block.len() as f64;
            let mean = |of: fn(&Point) -> f64| points[block.clone()].iter().map(of).sum::<f64>() / count;
            (mean(|point| point.x), mean(|point| point.height), count)
        })
        .collect();
    let heights: Vec<(f64, f64)> = blocks.iter().map(|(x, height, _)| (*x, *height)).collect();
    let excess =
        above_hull(&heights).zip(&blocks).map(|((x, above), (.., count))| (x, (above - decimal) * count.sqrt()));
    let worst = excess.max_by(|one, other| one.1.total_cmp(&other.1));
    worst.filter(|(_, excess)| *excess > CERTAIN * noise).map(|(x, _)| x)
}

/// How far points with ascending `x >= 0` are above the lower convex hull of them and their mirror images, which shows
/// heights that first fall, too.
pub(super) fn above_hull(points: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64)> {
    let mirrored = points.iter().rev().filter(|(x, _)| *x > 0.0).map(|(x, height)| (-x, *height));
    let hull = hull(mirrored.chain(points.iter().copied()));
    points.iter().map(move |&(x, height)| {
        let after = hull.partition_point(|(vertex, _)| *vertex < x).clamp(1, hull.len() - 1);
        let ((x0, h0), (x1, h1)) = (hull[after - 1], hull[after]);
        (x, height - (h0 + (h1 - h0) * ((x - x0) / (x1 - x0))))
    })
}

/// The lower convex hull of points with ascending `x` (A. M. Andrew, Inf. Process. Lett. 9 (1979) 216).
fn hull(points: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut hull: Vec<(f64, f64)> = Vec::new();
    for (x, height) in points {
        while let [.., (x0, h0), (x1, h1)] = hull[..]
            && (h1 - h0) * (x - x0) >= (height - h0) * (x1 - x0)
        {
            hull.pop();
        }
        hull.push((x, height));
    }
    hull
}

/// Where left and right differ by more than chance, first: by what each point on the left is off the straight line
/// between its neighbours on the right, of which one is its mirror image as a rule. What the fit misses is the same on
/// both sides, and bends that line.
fn uneven(points: &[Point], residuals: &[f64], noise: f64, decimal: f64) -> Option<f64> {
    let side = |left: bool| {
        let side = points.iter().zip(residuals).filter(move |(point, _)| point.left == left);
        side.map(|(point, residual)| (point.x, *residual)).collect::<Vec<_>>()
    };
    let (right, left) = (side(false), side(true));
    let differences: Vec<Difference> = left.iter().filter_map(|point| Difference::of(*point, &right)).collect();
    if differences.is_empty() {
        return None;
    }
    blocks(differences.len(), BLOCKS.min(points.len() / 4)).find_map(|block| {
        let differences = &differences[block];
        let count = differences.len() as f64;
        let mean = |of: fn(&Difference) -> f64| differences.iter().map(of).sum::<f64>().abs() / count;
        let allowed = CERTAIN * noise * (2.0 / count).sqrt() + mean(|difference| difference.bend) + decimal;
        let is_uneven = mean(|difference| difference.off) > allowed;
        is_uneven.then(|| differences[differences.len() / 2].x)
    })
}

/// How far a point is off the straight line between two on the other side, and how far that line bends there.
struct Difference {
    x: f64,
    off: f64,
    bend: f64,
}

impl Difference {
    /// `None` beyond the last of the others.
    fn of((x, residual): (f64, f64), others: &[(f64, f64)]) -> Option<Self> {
        let after = others.partition_point(|(other, _)| *other < x);
        let (to, last) = *others.get(after)?;
        if to.to_bits() == x.to_bits() {
            return Some(Self { x, off: residual - last, bend: 0.0 });
        }
        let (from, first) = *others.get(after.checked_sub(1)?)?;
        let line = first + (last - first) * (x - from) / (to - from);
        // As a parabola through both and the next on either side would, with room for what bends more and more towards
        // a tip.
        let bends = |index: usize| match others.get(index..index + 3) {
            Some(&[(x0, r0), (x1, r1), (x2, r2)]) => ((r2 - r1) / (x2 - x1) - (r1 - r0) / (x1 - x0)) / (x2 - x0),
            _ => 0.0,
        };
        let both = after.checked_sub(2).map_or(0.0, bends) + bends(after - 1);
        Some(Self { x, off: residual - line, bend: ROOM * both * (x - from) * (to - x) })
    }
}

/// So many runs of nearly the same length, no more than there are points.
fn blocks(points: usize, most: usize) -> impl Iterator<Item = std::ops::Range<usize>> {
    let count = most.clamp(1, points);
    (0..count).map(move |i| i * points / count..(i + 1) * points / count)
}
