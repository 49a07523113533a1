//! One panel of a figure: curves or cells in a frame.

use super::canvas::{GRID, INK, LINE, SIZE, THIN, framed, line, literal, outline, thinned, write};
use super::scale::Scale;
use super::style::Style;
use kuva::render::layout::{ComputedLayout, Layout};
use kuva::render::plots::Plot;
use kuva::render::render::{Scene, render_multiple};

/// Height of a panel, px; it is as wide as the figure of the tractions.
pub(super) const PANEL: f64 = 400.0;
/// Points up to which each is marked: a curve through few says where they are.
pub(super) const MARKED: usize = 24;

/// Curves over a scale. What is drawn is in its units.
pub(super) struct Panel {
    pub(super) name: String,
    pub(super) x: Scale,
    pub(super) y: Scale,
    pub(super) curves: Vec<Curve>,
    /// What is under the curves, in place of a grid or on it.
    pub(super) ground: Option<Box<dyn Ground>>,
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
    fn room(&self) -> f64;

    /// Whether it leaves nothing of a grid to be seen.
    fn covers(&self) -> bool;

    /// Drawn within the frame, and beside it.
    fn draw(&self, scene: &mut Scene, computed: &ComputedLayout, x: &Scale, y: &Scale);
}

impl Panel {
    fn plain_layout(&self) -> Layout {
        let Self { x, y, .. } = self;
        let layout = framed((x.least, x.most), (y.least, y.most), (SIZE.0, PANEL), [&x.label, &y.label]);
        y.beside(x.below(layout.with_y_label_wrap(40)))
    }

    /// Room that the numbers beside the frame take, px: panels one over the other share the larger.
    pub(super) fn margin(&self) -> f64 {
        self.y.margin(&self.plain_layout())
    }

    /// The panel by itself.
    pub(super) fn draw(&self, margin: f64) -> Scene {
        /// Room for half of the last number of the abscissa, px.
        const RIGHT: f64 = 24.0;
        let plain = ComputedLayout::from_layout(&self.plain_layout());
        let above = if self.name.is_empty() { 0.0 } else { LINE };
        let right = self.ground.as_ref().map_or(RIGHT, |ground| RIGHT.max(ground.room()));
        let layout = self
            .plain_layout()
            .with_force_margins(margin, right)
            .with_force_margins_y(plain.margin_top + above, plain.margin_bottom);
        let computed = ComputedLayout::from_layout(&layout);
        let covered = self.ground.as_ref().is_some_and(|ground| ground.covers());
        let mut plots = if covered { Vec::new() } else { self.grid() };
        plots.extend(self.curves.iter().flat_map(|curve| {
            curve.stretches.iter().map(|points| {
                let points = thinned(points, |(x, y)| (self.x.place(x), self.y.place(y)));
                line(points, curve.style.color, curve.style.width, Some(curve.style.dashes))
            })
        }));
        // kuva draws a frame for something only.
        if plots.is_empty() {
            plots.push(line([(self.x.least, self.y.least)], INK, THIN, None));
        }
        let mut scene = render_multiple(plots, layout);
        if let Some(ground) = &self.ground {
            ground.draw(&mut scene, &computed, &self.x, &self.y);
        }
        for curve in &self.curves {
            let within = |point: &&(f64, f64)| self.x.holds(point.0) && self.y.holds(point.1);
            for (x, y) in curve.marks.iter().filter(within) {
                scene.add(curve.style.mark(computed.map_x(*x), computed.map_y(*y)));
            }
        }
        if !self.name.is_empty() {
            let middle = computed.margin_left + computed.plot_width() / 2.0;
            write(&mut scene, middle, computed.margin_top - 0.4 * LINE, literal(&self.name), INK, false);
        }
        outline(&mut scene, &computed);
        scene
    }

    /// Lines at the ticks, under the curves, and the one at 0.
    fn grid(&self) -> Vec<Plot> {
        let Self { x, y, .. } = self;
        let rule = |ends: [(f64, f64); 2], color| line(ends, color, THIN, None);
        let mut rules: Vec<Plot> =
            x.inner_ticks().into_iter().map(|at| rule([(at, y.least), (at, y.most)], GRID)).collect();
        rules.extend(y.inner_ticks().into_iter().map(|at| rule([(x.least, at), (x.most, at)], GRID)));
        if y.least < 0.0 && y.most > 0.0 && !y.is_logarithmic() {
            rules.push(rule([(x.least, 0.0), (x.most, 0.0)], INK));
        }
        rules
    }
}
