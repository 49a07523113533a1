//! A figure of many panels: what is over them, the panels in rows, and the legend under them.

use super::canvas::{SIZE, place};
use super::head::Head;
use super::legend::{Entry, Legend};
use super::panel::Panel;
use kuva::backend::svg::SvgBackend;
use kuva::render::render::Scene as Canvas;

pub(super) struct Sheet {
    pub(super) title: String,
    /// Lines under the title, in parts that are not broken.
    pub(super) notes: Vec<String>,
    /// What is wrong.
    pub(super) alarm: Vec<String>,
    /// Row by row, all as high as those that stand beside them.
    pub(super) panels: Vec<Panel>,
    /// How many of them are side by side.
    pub(super) abreast: usize,
    pub(super) legend: Vec<Entry>,
}

impl Sheet {
    /// The figure as SVG (UTF-8).
    pub(super) fn draw(self) -> String {
        let Self { title, notes, alarm, panels, abreast, legend } = self;
        let abreast = abreast.min(panels.len()).max(1);
        let head = Head::new(&title, &notes, &alarm, abreast);
        let width = SIZE.0 * abreast as f64;
        let row = panels.first().map_or(0.0, |panel| panel.column().map(|panel| panel.height).sum());
        let legend = Legend::new(&legend, width);
        let below = head.height + row * panels.len().div_ceil(abreast) as f64;
        let mut figure = Canvas::new(width, below + legend.height);
        // Frames over each other begin at one abscissa, and those side by side are equally wide.
        let margin = panels.iter().flat_map(Panel::column).map(Panel::margin).fold(0.0, f64::max);
        for (index, panel) in panels.iter().enumerate() {
            let mut name = format!("frame{index}");
            let mut at = (SIZE.0 * (index % abreast) as f64, head.height + row * (index / abreast) as f64);
            for panel in panel.column() {
                place(&mut figure, panel.draw(margin), &name, at);
                at.1 += panel.height;
                name += "below";
            }
        }
        figure.elements.extend(head.lines);
        legend.draw(&mut figure, width / 2.0, below);
        SvgBackend::new().with_pretty(true).render_scene(&figure)
    }
}
