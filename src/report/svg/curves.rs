//! The curves of the figure: scaled, continued to the edges, and the frame that shows them.

use crate::engine::Solution;
use crate::report::svg::legend::Entry;
use crate::report::svg::{FigureError, line};
use kuva::render::plots::Plot;
use slipzone_api::Friction;

/// Where an unbounded pressure is cut off, in mean pressures.
const TOP_UNBOUNDED: f64 = 2.5;
/// Where any pressure is cut off, in mean pressures.
const TOP: f64 = 6.0;

/// The dashes tell the curves apart where the colours are lost in print.
pub(super) const PRESSURE: Entry = Entry::line("pressure p", "#1f4e8c", 2.4, "none");
const SHEAR: Entry = Entry::line("shear q", "#b5401c", 2.4, "8 4");
const LIMIT: Entry = Entry::line("friction limit ±ηp", "#555555", 1.3, "1.5 3");

/// The points of a curve that can be told apart, both ends among them; `place` gives a point's place in its panel, whose
/// sides are 1.
pub(super) fn thinned(points: &[(f64, f64)], place: impl Fn((f64, f64)) -> (f64, f64)) -> Vec<(f64, f64)> {
    /// Points closer than this part of the panel are left out: nobody sees them.
    const UNSEEN: f64 = 1e-3;
    let mut kept: Vec<(f64, f64)> = Vec::new();
    for (index, &point) in points.iter().enumerate() {
        let seen = kept.last().is_none_or(|&last| {
            let (here, there) = (place(point), place(last));
            (here.0 - there.0).abs() > UNSEEN || (here.1 - there.1).abs() > UNSEEN
        });
        if seen || index + 1 == points.len() {
            kept.push(point);
        }
    }
    kept
}

/// The range of the ordinate, in mean pressures, and the distance of its ticks.
#[derive(Clone, Copy)]
pub(super) struct Frame {
    pub(super) bottom: f64,
    pub(super) top: f64,
    pub(super) step: f64,
}

/// The curves, in units of the half-width and of the mean pressure, from left to right.
pub(super) struct Curves {
    pressure: Vec<(f64, f64)>,
    shear: Vec<(f64, f64)>,
    /// Coefficient of friction.
    eta: Option<f64>,
    /// Whether the pressure is unbounded anywhere in the contact.
    unbounded: bool,
}

impl Curves {
    pub(super) fn new(solution: &Solution, b: f64, mean: f64) -> Result<Self, FigureError> {
        let profile = &solution.profile;
        let scaled = |values: &[Option<f64>]| {
            let mut points: Vec<(f64, Option<f64>)> =
                profile.x.iter().zip(values).map(|(x, value)| (x / b, value.map(|v| v / mean))).collect();
            // A scene may list its points in any order.
            points.sort_by(|left, right| left.0.total_cmp(&right.0));
            points
        };
        let mut pressure = scaled(&profile.pressure);
        // Under a corner there is no number to draw, whatever was computed there.
        let shape = solution.scene.punch.shape();
        let corners = shape.as_ref().map_or(&[][..], |shape| shape.corners());
        for (x, value) in &mut pressure {
            if corners.iter().any(|corner| (x.abs() - corner / b).abs() < 1e-9) {
                *value = None;
            }
        }
        // A scene that lists its points may leave the sharp edges out.
        let sharp = solution.edge.stress_intensity.is_some_and(|k| k > 0.0);
        let unbounded = sharp || pressure.iter().any(|point| point.1.is_none());
        let pressure = to_the_edges(&pressure);
        if pressure.len() < 2 {
            return Err(FigureError::NoProfile(pressure.len()));
        }
        let shear = profile.shear.as_deref().map(|values| to_the_edges(&scaled(values))).unwrap_or_default();
        let eta = solution.scene.friction.as_ref().map(|Friction::Goodman { coefficient, .. }| coefficient.get());
        Ok(Self { pressure, shear, eta, unbounded })
    }

    /// A range that shows all of a bounded pressure, most of an unbounded one, and the shear beside it.
    pub(super) fn frame(&self) -> Frame {
        let highest = self.pressure.iter().map(|point| point.1).fold(0.0, f64::max);
        let top = if self.unbounded { TOP_UNBOUNDED } else { (1.05 * highest).clamp(1.0, TOP) };
        // What goes on while the pressure is in the frame: the shear near a sharp edge leaves it too.
        let visible = self.pressure.iter().filter(|point| point.1 <= top).map(|point| point.0);
        let (left, right) = visible.fold((1.0, -1.0), |(l, r): (f64, f64), x| (l.min(x), r.max(x)));
        let lowest = (self.shear.iter().filter(|point| point.0 >= left && point.0 <= right))
            .chain(&self.pressure)
            .map(|point| point.1)
            .fold(0.0, f64::min)
            .max(-top);
        let step = if top - lowest > 5.0 {
            1.0
        } else if top - lowest > 1.5 {
            0.5
        } else {
            0.2
        };
        Frame { bottom: (1.05 * lowest / step).floor() * step, top: (top / step).ceil() * step, step }
    }

    /// Limit of friction below, then shear, then pressure on top.
    pub(super) fn plots(&self, frame: Frame) -> Vec<Plot> {
        // Far outside the frame nothing is seen, and some viewers stumble over huge coordinates.
        let (low, high) = (frame.bottom - FAR, frame.top + FAR);
        let curve = |points: &[(f64, f64)], factor: f64, Entry { style, .. }: &Entry| {
            let points = points.iter().map(|(x, y)| (*x, (factor * y).clamp(low, high)));
            line(points, style.color, style.width, Some(style.dashes))
        };
        let mut plots = Vec::new();
        if let Some(eta) = self.eta {
            plots.extend([eta, -eta].map(|factor| curve(&self.pressure, factor, &LIMIT)));
        }
        plots.extend([curve(&self.shear, 1.0, &SHEAR), curve(&self.pressure, 1.0, &PRESSURE)]);
        plots
    }

    /// What is drawn.
    pub(super) fn legend(&self) -> Vec<Entry> {
        let mut entries = vec![PRESSURE];
        if !self.shear.is_empty() {
            entries.push(SHEAR);
        }
        if self.eta.is_some() {
            entries.push(LIMIT);
        }
        entries
    }
}

/// In mean pressures.
const FAR: f64 = 1e3;

/// The bounded points, with the curve between each edge and the sample next to it.
///
/// Tractions end as the inverse square root of the distance to a sharp edge (an unbounded sample) and as the
/// square root at a smooth one (a sample of 0). So drawn, the curve leaves the frame instead of stopping short
/// of the edge, and meets a smooth edge without a corner. To an unbounded sample within, a corner of the punch, they go
/// like the logarithm of the distance. Nothing else is interpolated.
pub(super) fn to_the_edges(points: &[(f64, Option<f64>)]) -> Vec<(f64, f64)> {
    /// Shares of the distance between the edge and the sample next to it.
    const SHARES: [f64; 9] = [0.8, 0.6, 0.4, 0.25, 0.1, 0.03, 0.01, 0.001, 1e-4];
    let bounded = |points: &[(f64, Option<f64>)]| -> Vec<(f64, f64)> {
        points.iter().filter_map(|(x, y)| Some((*x, (*y)?))).collect()
    };
    let [first, inner @ .., last] = points else { return bounded(points) };
    // From the two samples beside the corner.
    let towards_corner = |corner: f64, near: Option<&(f64, Option<f64>)>, far: Option<&(f64, Option<f64>)>| {
        let (Some((x, Some(y))), Some((beyond, Some(lower)))) = (near, far) else { return Vec::new() };
        let rise = (y - lower) / ((beyond - corner) / (x - corner)).ln();
        if !(rise > 0.0 && rise.is_finite()) {
            return Vec::new();
        }
        SHARES.map(|share| (corner + (x - corner) * share, y - rise * share.ln())).into()
    };
    let mut curve = Vec::with_capacity(inner.len());
    for (i, (x, y)) in inner.iter().enumerate() {
        if let Some(y) = y {
            curve.push((*x, *y));
            continue;
        }
        let before = |n: usize| i.checked_sub(n).and_then(|i| inner.get(i));
        let left = towards_corner(*x, before(1), before(2));
        let right = towards_corner(*x, inner.get(i + 1), inner.get(i + 2));
        curve.extend(left.into_iter().chain(right.into_iter().rev()));
    }
    let (Some(left), Some(right)) = (curve.first().copied(), curve.last().copied()) else { return bounded(points) };
    let towards = |edge: &(f64, Option<f64>), (x, y): (f64, f64)| -> Vec<(f64, f64)> {
        let along = |power: fn(f64) -> f64| SHARES.map(|share| (edge.0 + (x - edge.0) * share, y * power(share)));
        match edge.1 {
            None => along(|share| share.sqrt().recip()).into(),
            Some(0.0) => along(f64::sqrt).into_iter().chain([(edge.0, 0.0)]).collect(),
            Some(value) => vec![(edge.0, value)],
        }
    };
    curve.splice(..0, towards(first, left).into_iter().rev());
    curve.extend(towards(last, right));
    curve
}
