//! One panel of a figure: curves or cells in a frame.

use super::canvas::{GRID, INK, LINE, SIZE, THIN, framed, line, literal, outline, thinned, write};
use super::legend::{Entry, LEGEND, under_frame};
use super::scale::Scale;
use super::style::Style;
use kuva::render::layout::{ComputedLayout, Layout};
use kuva::render::plots::Plot;
use kuva::render::render::{Scene, render_multiple};

/// Height of most panels, px; all are as wide as the figure of the tractions.
const PANEL: f64 = 400.0;
/// Points up to which each is marked: a curve through few says where they are.
pub(super) const MARKED: usize = 24;

/// Curves over a scale. What is drawn is in its units.
pub(super) struct Panel {
    /// Written over the frame.
    pub(super) name: String,
    pub(super) x: Scale,
    pub(super) y: Scale,
    pub(super) curves: Vec<Curve>,
    /// What is under the curves, in place of a grid or on it.
    pub(super) ground: Box<dyn Ground>,
    /// Height, px.
    pub(super) height: f64,
    /// One that stands right under it.
    pub(super) lower: Option<Box<Panel>>,
    /// Of its own under the frame; without entries room for one, so that the frame ends with those beside it.
    pub(super) legend: Option<Vec<Entry>>,
}

/// One curve in its stretches, and points that are marked.
pub(super) struct Curve {
    pub(super) style: Style,
    pub(super) stretches: Vec<Vec<(f64, f64)>>,
    pub(super) marks: Vec<(f64, f64)>,
}

/// What a panel stands on.
pub(super) trait Ground {
    /// Room that it takes to the right of the frame, px.
    fn room(&self) -> f64 {
        0.0
    }

    /// The layout with what it shades.
    fn shaded(&self, layout: Layout, _: &Scale) -> Layout {
        layout
    }

    /// Lines under the curves.
    fn rules(&self, x: &Scale, y: &Scale) -> Vec<Plot> {
        grid(x, y)
    }

    /// Drawn within the frame, and beside it.
    fn draw(&self, scene: &mut Scene, computed: &ComputedLayout, x: &Scale, y: &Scale);
}

impl Panel {
    /// Curves on a grid, without a name.
    pub(super) fn new(x: Scale, y: Scale, curves: Vec<Curve>) -> Self {
        Self { name: String::new(), x, y, curves, ground: Box::new(Plain), height: PANEL, lower: None, legend: None }
    }

    /// This one and those under it.
    pub(super) fn column(&self) -> impl Iterator<Item = &Self> {
        std::iter::successors(Some(self), |panel| panel.lower.as_deref())
    }

    fn plain_layout(&self) -> Layout {
        let Self { x, y, height, .. } = self;
        let layout = framed((x.least, x.most), (y.least, y.most), (SIZE.0, *height), [&x.label, &y.label]);
        y.beside(x.below(layout.with_y_label_wrap(40)))
    }

    /// Room that the numbers beside the frame take, px: the panels of a figure share the largest.
    pub(super) fn margin(&self) -> f64 {
        self.y.margin(&self.plain_layout())
    }

    /// The panel by itself.
    pub(super) fn draw(&self, margin: f64) -> Scene {
        /// Room for half of the last number of the abscissa, px.
        const RIGHT: f64 = 24.0;
        let Self { name, x, y, curves, ground, legend, .. } = self;
        let plain = ComputedLayout::from_layout(&self.plain_layout());
        let above = if name.is_empty() { 0.0 } else { LINE };
        let below = if legend.is_some() { LEGEND } else { 0.0 };
        let layout = self
            .plain_layout()
            .with_force_margins(margin, RIGHT.max(ground.room()))
            .with_force_margins_y(plain.margin_top + above, plain.margin_bottom + below)
            .with_x_label_offset(0.0, -below);
        let layout = ground.shaded(layout, x);
        let computed = ComputedLayout::from_layout(&layout);
        let mut plots = ground.rules(x, y);
        plots.extend(curves.iter().flat_map(|curve| {
            curve.stretches.iter().map(|points| {
                let points = thinned(points, |point| (x.place(point.0), y.place(point.1)));
                line(points, curve.style.color, curve.style.width, Some(curve.style.dashes))
            })
        }));
        // kuva draws a frame for something only.
        if plots.is_empty() {
            plots.push(line([(x.least, y.least)], INK, THIN, None));
        }
        let mut scene = render_multiple(plots, layout);
        ground.draw(&mut scene, &computed, x, y);
        for curve in curves {
            for (at, value) in curve.marks.iter().filter(|mark| x.holds(mark.0) && y.holds(mark.1)) {
                scene.add(curve.style.mark(computed.map_x(*at), computed.map_y(*value)));
            }
        }
        if !name.is_empty() {
            let middle = computed.margin_left + computed.plot_width() / 2.0;
            write(&mut scene, middle, computed.margin_top - 0.4 * LINE, literal(name), INK, false);
        }
        outline(&mut scene, &computed);
        under_frame(legend.as_deref().unwrap_or_default(), &mut scene, &computed);
        scene
    }
}

/// A grid and nothing else.
struct Plain;

impl Ground for Plain {
    fn draw(&self, _: &mut Scene, _: &ComputedLayout, _: &Scale, _: &Scale) {}
}

/// Lines at the ticks, and the one at 0.
fn grid(x: &Scale, y: &Scale) -> Vec<Plot> {
    let rule = |ends: [(f64, f64); 2], color| line(ends, color, THIN, None);
    let mut rules: Vec<Plot> =
        x.inner_ticks().into_iter().map(|at| rule([(at, y.least), (at, y.most)], GRID)).collect();
    rules.extend(y.inner_ticks().into_iter().map(|at| rule([(x.least, at), (x.most, at)], GRID)));
    if y.least < 0.0 && y.most > 0.0 && !y.is_logarithmic() {
        rules.push(rule([(x.least, 0.0), (x.most, 0.0)], INK));
    }
    rules
}
