//! Whether points differ from a convex and symmetric shape by more than their noise.
//!
//! The noise is judged twice and the smaller one taken: by what the fit leaves over, which too large a misfit inflates,
//! and by third differences of that between neighbours, which a sparse table inflates. Means over blocks of neighbours
//! then show what single points hide: of `n` points they scatter by `noise/sqrt(n)`.

use super::fit::Point;
use slipzone_api::Flaw;

/// Blocks of neighbours.
const BLOCKS: usize = 64;

/// How many times its scatter something must be off to be no accident.
const CERTAIN: f64 = 8.0;

/// All flaws found, at most one of each kind; `residuals` are heights less `fitted` ones.
pub(super) fn flaws(points: &[Point], residuals: &[f64], fitted: impl Fn(f64) -> f64, rounding: f64) -> Vec<Flaw> {
    let noise = noise(points, residuals) + rounding;
    let bent = bent(points, residuals, fitted, noise).map(|x| Flaw { what: "the punch is not convex".into(), x });
    let uneven = uneven(points, residuals, noise).map(|x| Flaw { what: "the punch is not symmetric".into(), x });
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

/// Where block means stand above the straight line between others by more than chance, most of all.
fn bent(points: &[Point], residuals: &[f64], fitted: impl Fn(f64) -> f64, noise: f64) -> Option<f64> {
    let blocks: Vec<(f64, f64, f64)> = blocks(points.len(), BLOCKS)
        .map(|block| {
            let count = block.len() as f64;
            let x = points[block.clone()].iter().map(|point| point.x).sum::<f64>() / count;
            let off = residuals[block].iter().sum::<f64>() / count;
            (x, fitted(x) + off, count)
        })
        .collect();
    // With their mirror images, so that heights that first fall stand out too.
    let mirrored = blocks.iter().rev().filter(|(x, ..)| *x > 0.0).map(|(x, height, _)| (-x, *height));
    let hull = hull(mirrored.chain(blocks.iter().map(|(x, height, _)| (*x, *height))));
    let excess = |&(x, height, count): &(f64, f64, f64)| {
        let after = hull.partition_point(|(vertex, _)| *vertex < x).clamp(1, hull.len() - 1);
        let ((x0, h0), (x1, h1)) = (hull[after - 1], hull[after]);
        let line = h0 + (h1 - h0) * ((x - x0) / (x1 - x0));
        (x, (height - line) * count.sqrt())
    };
    let worst = blocks.iter().map(excess).max_by(|one, other| one.1.total_cmp(&other.1));
    worst.filter(|(_, excess)| *excess > CERTAIN * noise).map(|(x, _)| x)
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

/// Where left and right differ by more than chance, first.
fn uneven(points: &[Point], residuals: &[f64], noise: f64) -> Option<f64> {
    blocks(points.len(), BLOCKS.min(points.len() / 4)).find_map(|block| {
        // Sum and number on either side.
        let mut sides = [(0.0, 0.0); 2];
        for index in block.clone() {
            let side = &mut sides[usize::from(points[index].left)];
            *side = (side.0 + residuals[index], side.1 + 1.0);
        }
        let [(right, rights), (left, lefts)] = sides;
        let is_uneven = rights > 0.0
            && lefts > 0.0
            && (right / rights - left / lefts).abs() > CERTAIN * noise * (1.0 / rights + 1.0 / lefts).sqrt();
        is_uneven.then(|| points[usize::midpoint(block.start, block.end)].x)
    })
}

/// So many runs of nearly the same length, no more than there are points.
fn blocks(points: usize, most: usize) -> impl Iterator<Item = std::ops::Range<usize>> {
    let count = most.clamp(1, points);
    (0..count).map(move |i| i * points / count..(i + 1) * points / count)
}
