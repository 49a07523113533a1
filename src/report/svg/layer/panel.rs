//! One panel of the figure of a layer: curves in a frame, thin rules, and a strip for the base.

use crate::report::svg::canvas::{GRID, INK, LETTERS, THIN, framed, lettered, line, outline, thinned};
use crate::report::svg::legend::{Entry, LEGEND, under_frame};
use crate::report::svg::scale::Scale;
use kuva::render::annotations::ShadedRegion;
use kuva::render::layout::{ComputedLayout, Layout};
use kuva::render::plots::Plot;
use kuva::render::render::{Scene, TextAnchor, render_multiple};

/// Colour of the base.
const BASE: &str = "#ececec";

/// Curves over a length or a wave number.
pub(super) struct Panel {
    pub(super) x: Scale,
    pub(super) y: Scale,
    pub(super) curves: Vec<(Entry, Vec<(f64, f64)>)>,
    /// Dashed verticals, at these abscissae.
    pub(super) interfaces: Vec<f64>,
    /// Dashed levels, each with its name.
    pub(super) limits: Vec<(f64, String)>,
    /// The base, from this abscissa on, and its name.
    pub(super) base: Option<(f64, &'static str)>,
    /// Where the panel stands in the figure, and its size, px.
    pub(super) place: (f64, f64),
    pub(super) size: (f64, f64),
}

impl Panel {
    fn plain_layout(&self) -> Layout {
        let Self { x, y, size, .. } = self;
        y.beside(x.below(framed((x.least, x.most), (y.least, y.most), *size, [&x.label, &y.label])))
    }

    /// Room that the numbers beside the frame take, px: panels one over the other share the larger.
    pub(super) fn margin(&self) -> f64 {
        self.y.margin(&self.plain_layout())
    }

    /// The panel by itself.
    pub(super) fn draw(&self, margin: f64) -> Scene {
        /// Room for the names of limits, px.
        const NAMES: f64 = 44.0;
        let plain = ComputedLayout::from_layout(&self.plain_layout());
        // The frames of all panels that stand on the figure's bottom end in a line, above the legend of one of them.
        let below = if self.x.label.is_empty() { 0.0 } else { LEGEND };
        let mut layout = self
            .plain_layout()
            .with_force_margins(margin, NAMES)
            .with_force_margins_y(plain.margin_top, plain.margin_bottom + below)
            .with_x_label_offset(0.0, -below);
        if let Some((from, _)) = self.base {
            layout =
                layout.with_shaded_region(ShadedRegion::vertical(from, self.x.most).with_color(BASE).with_opacity(1.0));
        }
        let computed = ComputedLayout::from_layout(&layout);
        let mut plots = self.rules();
        plots.extend(self.curves.iter().map(|(Entry { style, .. }, points)| {
            // What is not positive has no place on a logarithmic axis.
            let drawable = |point: &&(f64, f64)| !self.y.is_logarithmic() || point.1 > 0.0;
            let points: Vec<_> = points.iter().filter(drawable).copied().collect();
            let points = thinned(&points, |(x, y)| (self.x.place(x), self.y.place(y)));
            line(points, style.color, style.width, Some(style.dashes))
        }));
        let mut scene = render_multiple(plots, layout);
        self.names(&mut scene, &computed);
        outline(&mut scene, &computed);
        if self.curves.len() > 1 {
            let entries: Vec<Entry> = self.curves.iter().map(|curve| curve.0.clone()).collect();
            under_frame(&entries, &mut scene, &computed);
        }
        scene
    }

    /// Grid, interfaces and limits, under the curves.
    fn rules(&self) -> Vec<Plot> {
        let Self { x, y, .. } = self;
        let end = self.base.map_or(x.most, |base| base.0);
        let upright = |at: f64, color, dashes| line([(at, y.least), (at, y.most)], color, THIN, Some(dashes));
        let level = |at: f64, end, color, dashes| line([(x.least, at), (end, at)], color, THIN, Some(dashes));
        let mut rules: Vec<Plot> =
            x.inner_ticks().into_iter().filter(|at| *at < end).map(|at| upright(at, GRID, "none")).collect();
        rules.extend(y.inner_ticks().into_iter().map(|at| level(at, end, GRID, "none")));
        rules.extend(self.interfaces.iter().map(|at| upright(*at, INK, "5 4")));
        rules.extend(self.base.map(|base| upright(base.0, INK, "none")));
        rules.extend(self.limits.iter().map(|(at, _)| level(*at, x.most, INK, "5 4")));
        rules
    }

    /// Names of the limits, right of the frame, and of the base, upright within it.
    fn names(&self, scene: &mut Scene, computed: &ComputedLayout) {
        let mut write = |x: f64, y: f64, content: String, anchor: TextAnchor, rotate: Option<f64>| {
            scene.add(lettered((x, y), content, LETTERS - 1, anchor, rotate));
        };
        let half_a_letter = 0.33 * f64::from(LETTERS - 1);
        let frame_right = computed.width - computed.margin_right;
        for (at, name) in &self.limits {
            write(frame_right + 4.0, computed.map_y(*at) + half_a_letter, name.clone(), TextAnchor::Start, None);
        }
        let Some((from, name)) = self.base else { return };
        // Where the line of a half-plane's modulus does not cross it.
        let last = self.curves.first().and_then(|curve| curve.1.last()).filter(|point| point.0 > from);
        let (top, bottom) = (computed.margin_top, computed.height - computed.margin_bottom);
        let is_low = last.is_some_and(|point| self.y.place(point.1) < 0.5);
        let (y, anchor) = if is_low { (top + 8.0, TextAnchor::End) } else { (bottom - 8.0, TextAnchor::Start) };
        let middle = f64::midpoint(computed.map_x(from), frame_right);
        write(middle + half_a_letter, y, name.into(), anchor, Some(-90.0));
    }
}
