//! The curves of the figure: scaled, continued to the edges, and the frame that shows them.

use crate::engine::Solution;
use crate::report::svg::FigureError;
use crate::report::svg::canvas::line;
use crate::report::svg::edges::to_the_edges;
use crate::report::svg::legend::Entry;
use crate::report::svg::panel::MARKED;
use crate::report::svg::style::Style;
use kuva::render::plots::Plot;
use slipzone_api::Friction;

/// Where an unbounded pressure is cut off, in mean pressures.
const TOP_UNBOUNDED: f64 = 2.5;
/// Where any pressure is cut off, in mean pressures.
const TOP: f64 = 6.0;

/// The dashes tell the curves apart where the colours are lost in print.
pub(super) const PRESSURE: Entry = Entry::line("pressure p", "#1f4e8c", 2.4, "none");
const SHEAR: Entry = Entry::line("shear q", "#b5401c", 2.4, "8 4");
pub(super) const LIMIT: Entry = Entry::line("friction limit ±ηp", "#555555", 1.3, "1.5 3");

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
    /// What the two curves go through, where that is so little that they alone would hide it.
    few: Option<[Vec<(f64, f64)>; 2]>,
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
        let shear = profile.shear.as_deref().map(scaled).unwrap_or_default();
        let bounded = |points: &[(f64, Option<f64>)]| points.iter().filter_map(|(x, y)| Some((*x, (*y)?))).collect();
        let few = (profile.x.len() <= MARKED).then(|| [bounded(&pressure), bounded(&shear)]);
        let pressure = to_the_edges(&pressure);
        if pressure.len() < 2 {
            return Err(FigureError::NoProfile(pressure.len()));
        }
        let shear = to_the_edges(&shear);
        let eta = solution.scene.friction.as_ref().map(|Friction::Goodman { coefficient, .. }| coefficient.get());
        Ok(Self { pressure, shear, few, eta, unbounded })
    }

    /// A range that shows all of a bounded pressure, most of an unbounded one, and the shear beside it.
    pub(super) fn frame(&self) -> Frame {
        let highest = self.pressure.iter().map(|point| point.1).fold(0.0, f64::max);
        let top = if self.unbounded { TOP_UNBOUNDED } else { (1.05 * highest).clamp(1.0, TOP) };
        // What goes on while the pressure is in the frame: the shear near a sharp edge leaves it too.
        let visible = self.pressure.iter().filter(|point| point.1 <= top).map(|point| point.0);
        let (left, right) = visible.fold((1.0, -1.0), |(l, r): (f64, f64), x| (l.min(x), r.max(x)));
        let tractions = self.shear.iter().filter(|point| point.0 >= left && point.0 <= right).chain(&self.pressure);
        // The lower limit of friction is seen to its end, unless there is none.
        let limit = self.eta.filter(|_| !self.unbounded).map_or(0.0, |eta| -eta * highest);
        let lowest = tractions.map(|point| point.1).fold(limit, f64::min).max(-top);
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

    /// Samples to be marked, shear first: those within the frame, where they are few.
    pub(super) fn samples(&self, frame: Frame) -> Vec<(Style, f64, f64)> {
        let Some([pressure, shear]) = &self.few else { return Vec::new() };
        let of = |points: &[(f64, f64)], entry: Entry| {
            let style = entry.style.with_filled_marks();
            let seen = points.iter().filter(|point| (frame.bottom..=frame.top).contains(&point.1));
            seen.map(|(x, y)| (style, *x, *y)).collect::<Vec<_>>()
        };
        of(shear, SHEAR).into_iter().chain(of(pressure, PRESSURE)).collect()
    }

    /// What is drawn.
    pub(super) fn legend(&self) -> Vec<Entry> {
        let marked =
            |entry: Entry| Entry { is_marked: self.few.is_some(), style: entry.style.with_filled_marks(), ..entry };
        let mut entries = vec![marked(PRESSURE)];
        if !self.shear.is_empty() {
            entries.push(marked(SHEAR));
        }
        if self.eta.is_some() {
            entries.push(LIMIT);
        }
        entries
    }
}

/// In mean pressures.
const FAR: f64 = 1e3;
