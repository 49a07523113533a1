//! What is marked in the panels of a layer: interfaces and limits by dashed lines, and the base by a strip.

use crate::report::svg::canvas::{GRID, INK, LETTERS, THIN, lettered, line};
use crate::report::svg::panel::Ground;
use crate::report::svg::scale::Scale;
use kuva::render::annotations::ShadedRegion;
use kuva::render::layout::{ComputedLayout, Layout};
use kuva::render::plots::Plot;
use kuva::render::render::{Scene, TextAnchor};

/// Colour of the base.
const BASE: &str = "#ececec";

/// In units of the axes.
pub(super) struct Landmarks {
    /// Dashed verticals, at these abscissae.
    pub(super) interfaces: Vec<f64>,
    /// Dashed levels, each with its name.
    pub(super) limits: Vec<(f64, String)>,
    pub(super) base: Option<Strip>,
}

/// The base.
pub(super) struct Strip {
    /// The abscissa from which on it goes to the end.
    pub(super) from: f64,
    pub(super) name: &'static str,
    /// Whether its name stands at its upper end.
    pub(super) at_top: bool,
}

impl Ground for Landmarks {
    /// The names of limits.
    fn room(&self) -> f64 {
        44.0
    }

    fn shaded(&self, layout: Layout, x: &Scale) -> Layout {
        let strip = |base: &Strip| ShadedRegion::vertical(base.from, x.most).with_color(BASE).with_opacity(1.0);
        self.base.iter().map(strip).fold(layout, Layout::with_shaded_region)
    }

    /// Grid, interfaces and limits.
    fn rules(&self, x: &Scale, y: &Scale) -> Vec<Plot> {
        let end = self.base.as_ref().map_or(x.most, |base| base.from);
        let upright = |at: f64, color, dashes| line([(at, y.least), (at, y.most)], color, THIN, Some(dashes));
        let level = |at: f64, end, color, dashes| line([(x.least, at), (end, at)], color, THIN, Some(dashes));
        let mut rules: Vec<Plot> =
            x.inner_ticks().into_iter().filter(|at| *at < end).map(|at| upright(at, GRID, "none")).collect();
        rules.extend(y.inner_ticks().into_iter().map(|at| level(at, end, GRID, "none")));
        rules.extend(self.interfaces.iter().map(|at| upright(*at, INK, "5 4")));
        rules.extend(self.base.as_ref().map(|base| upright(base.from, INK, "none")));
        rules.extend(self.limits.iter().map(|(at, _)| level(*at, x.most, INK, "5 4")));
        rules
    }

    /// Names of the limits, right of the frame, and of the base, upright within it.
    fn draw(&self, scene: &mut Scene, computed: &ComputedLayout, _: &Scale, _: &Scale) {
        let mut write = |x: f64, y: f64, content: String, anchor: TextAnchor, rotate: Option<f64>| {
            scene.add(lettered((x, y), content, LETTERS - 1, anchor, rotate));
        };
        let half_a_letter = 0.33 * f64::from(LETTERS - 1);
        let frame_right = computed.width - computed.margin_right;
        for (at, name) in &self.limits {
            write(frame_right + 4.0, computed.map_y(*at) + half_a_letter, name.clone(), TextAnchor::Start, None);
        }
        let Some(Strip { from, name, at_top }) = self.base else { return };
        let (top, bottom) = (computed.margin_top, computed.height - computed.margin_bottom);
        let (y, anchor) = if at_top { (top + 8.0, TextAnchor::End) } else { (bottom - 8.0, TextAnchor::Start) };
        let middle = f64::midpoint(computed.map_x(from), frame_right);
        write(middle + half_a_letter, y, name.into(), anchor, Some(-90.0));
    }
}
