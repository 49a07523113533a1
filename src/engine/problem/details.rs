//! Details of a smooth shape that a grid over all of the contact does not resolve.

use super::Problem;
use crate::engine::numerics::chebyshev::{Points, Series};
use slipzone_api::details;
use std::f64::consts::FRAC_2_PI;

/// Chebyshev points all over the contact that tell whether a slope is smooth. What they do not resolve no grid does
/// whose nodes crowd at the edges, with as many unknowns as are worth it.
const SLOPES: usize = 40;

/// Chebyshev points that tell what a grid of an unknown more could: three times as dense in the middle, where a grid is
/// coarsest.
const POINTS_PER_UNKNOWN: usize = 2;
/// How much of a missed slope the pressure is at most, beside the share `2/pi ln(b/w)` of a step of the width `w`:
/// under a bump `x/(1 + x^2)^2` it is 1.54 times the largest slope.
const FELT: f64 = 1.6;
/// What a shape may be off by that is stacked for its details, over the tolerance: the rest is left to the resolution.
const SHARE: f64 = 0.5;
/// What they miss of a detail, over what a series cut short may.
const MISSED: f64 = 10.0;

/// Chebyshev points that do so over a piece.
const OF_PIECE: usize = 24;
/// The least error asked of them.
const LEAST: f64 = 1e-13;
/// Most pieces worth it.
const MOST_PIECES: usize = 96;
/// How much nearer to the middle a piece there is cut, in `ln x`.
const NEARER: f64 = 2.5;

impl Problem {
    /// Whether a grid over all of the contact is to resolve the shape.
    fn is_smooth(&self) -> bool {
        !self.is_kinked() && !self.is_linear && self.fixed_half_width().is_none()
    }

    /// Whether the slope of a smooth shape has details within a half-width that no grid over all of it resolves to a
    /// tolerance, such as a tip rounded off by little.
    pub(crate) fn has_details(&self, half_width: f64, tolerance: f64) -> bool {
        self.is_detailed.is_none()
            && self.is_smooth()
            && (self.slopes(half_width, SLOPES).tail() > tolerance
                || self.hidden_details(half_width, SLOPES / POINTS_PER_UNKNOWN) > SHARE * tolerance)
            && self.cut(&mut vec![0.0, half_width], tolerance)
    }

    /// What a grid of so many unknowns, and every coarser one, may miss of its details, over the slope at the end: a
    /// bump of the slope, however narrow, is felt by the pressure beneath it, and a step of it the more the narrower it
    /// is.
    pub(crate) fn hidden_details(&self, half_width: f64, unknowns: usize) -> f64 {
        let details = if self.is_smooth() { self.details(half_width) } else { Vec::new() };
        if details.is_empty() {
            return 0.0;
        }
        let series = self.slopes(half_width, POINTS_PER_UNKNOWN * unknowns);
        let missed = |x: f64| (self.slope(x) - series.value_and_slope(0.5 + 0.5 * x / half_width).0).abs();
        let most = details::looked_at(&details).map(missed).fold(0.0, f64::max);
        let widths = details.windows(2).map(|pair| pair[1] - pair[0]);
        let narrowest = widths.fold(details[0], f64::min).max(f64::EPSILON * half_width);
        most * (FELT + FRAC_2_PI * (half_width / narrowest).ln()) / self.slope(half_width).abs()
    }

    /// The slope over all of a contact, through so many points.
    fn slopes(&self, half_width: f64, count: usize) -> Series {
        let points = Points::get(count);
        let slopes: Vec<f64> = points.at.iter().map(|s| self.slope(half_width * (2.0 * s - 1.0))).collect();
        points.through(&slopes)
    }

    /// Places beside which a smooth shape may vary over short lengths, see [`slipzone_api::PunchShape::details`].
    pub(in crate::engine) fn details(&self, half_width: f64) -> Vec<f64> {
        let details = self.shape.details(half_width * self.length).into_iter();
        details.map(|x| x / self.length).filter(|x| *x > 0.0 && *x < half_width).collect()
    }

    /// Ends of so many equal parts of the contact, cut beside its details; ascending, neither the middle nor the end
    /// among them.
    pub(in crate::engine) fn parts(&self, half_width: f64, count: u32) -> Vec<f64> {
        let mut ends = self.details(half_width);
        ends.extend((1..count).map(|part| half_width * f64::from(part) / f64::from(count)));
        ends.sort_unstable_by(f64::total_cmp);
        ends
    }

    /// Whether a shape that is stacked for its kinks may vary over short lengths besides.
    pub(crate) fn is_kinked_beside_details(&self, half_width: f64) -> bool {
        self.is_detailed.is_none() && self.is_kinked() && !self.details(half_width).is_empty()
    }

    /// Cuts pieces of a shape until the slope is resolved over each, beside the slope at the end of all: beside its
    /// details, and one in the middle nearer to it. Returns whether that took few pieces; they are left as they were
    /// where it did not.
    pub(crate) fn cut(&self, breaks: &mut Vec<f64>, digits: f64) -> bool {
        let points = Points::get(OF_PIECE);
        let end = breaks.last().copied().unwrap_or(0.0);
        let (details, enough) = (self.details(end), digits.max(LEAST) * self.slope(end).abs());
        let is_smooth_across = self.kinks().all(|kink| kink > 0.0);
        let mut cut = breaks.clone();
        let mut i = 1;
        while i < cut.len() {
            let (from, to) = (cut[i - 1], cut[i]);
            // Across the middle the slope is as smooth as beside it.
            let begins = if from > 0.0 || !is_smooth_across { from } else { -to };
            let slopes: Vec<f64> = points.at.iter().map(|s| self.slope(begins + (to - begins) * s)).collect();
            let largest = slopes.iter().fold(0.0_f64, |most, slope| most.max(slope.abs()));
            let series = points.through(&slopes);
            let told = |x: f64| series.value_and_slope((x - begins) / (to - begins)).0;
            let inside: Vec<f64> = details.iter().copied().filter(|x| *x > from && *x < to).collect();
            let is_like = |x: f64| (self.slope(x) - told(x)).abs() <= MISSED * enough;
            // Where a detail ends may be just where this piece does.
            let ends = [from, to].into_iter().filter(|end| self.kinks().all(|kink| kink.to_bits() != end.to_bits()));
            let is_resolved = series.tail() * largest <= enough && inside.iter().copied().chain(ends).all(is_like);
            // Beside a kink no series resolves a slope, and none has to: a stack knows what is singular there.
            let is_beside_kink = inside.is_empty() && self.kinks().any(|kink| kink.to_bits() == from.to_bits());
            if is_resolved || is_beside_kink {
                i += 1;
            } else if cut.len() > MOST_PIECES {
                return false;
            } else {
                let between = if from > 0.0 { 0.5 * (from + to) } else { to * (-NEARER).exp() };
                cut.insert(i, inside.get(inside.len() / 2).copied().unwrap_or(between));
            }
        }
        *breaks = cut;
        true
    }
}
