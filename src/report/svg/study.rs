//! Figures of a study: a number over an axis, over two, or the tractions of several scenes.

mod curves;
mod gather;
mod legend;
mod map;
mod names;
mod panel;
mod style;
mod tractions;

use super::head::Head;
use super::{FigureError, SIZE, place};
use crate::study::{Plot, PlotKind, Study};
use gather::Groups;
use kuva::backend::svg::SvgBackend;
use kuva::render::render::Scene as Canvas;
use legend::{Entry, Legend};
use panel::Panel;
use serde_json::Value;

/// Height of a panel, px; it is as wide as the figure of the tractions.
const PANEL: f64 = 400.0;
/// Most panels side by side.
const ABREAST: usize = 2;

/// What a figure is made of.
struct Drawing {
    /// Row by row.
    panels: Vec<Panel>,
    /// How many of them are side by side.
    abreast: usize,
    legend: Vec<Entry>,
    /// Scenes that the figure shows.
    scenes: u64,
    /// Those of them without numbers.
    failed: u64,
}

/// A figure of a study as SVG (UTF-8), from the lines of its results in any order. Scenes that did not converge leave gaps,
/// and a line under the title counts them. The same results always give the same text.
///
/// Of the records only what is drawn is kept: of very many scenes a part, chosen by their numbers.
pub fn study_svg(study: &Study, plot: &Plot, records: impl IntoIterator<Item = Value>) -> Result<String, FigureError> {
    let shown = study.shown(plot).map_err(|fault| FigureError::Plot(fault.in_one_line()))?;
    let groups = Groups::new(study, plot, &shown);
    let drawing = match plot.kind {
        PlotKind::Curves => curves::draw(&groups, records),
        PlotKind::Tractions => tractions::draw(&groups, records),
        PlotKind::Map => map::draw(&groups, records),
    }?;
    Ok(put_together(study, plot, &drawing))
}

/// Title, panels in rows, and the legend under them.
fn put_together(study: &Study, plot: &Plot, drawing: &Drawing) -> String {
    let title = plot.title.as_deref().or(study.title.as_deref());
    let note: Vec<String> = plot.note.iter().map(|note| names::with_symbols(note)).collect();
    let Drawing { scenes, failed, .. } = drawing;
    let alarm = format!("{failed} of {scenes} scenes did not converge");
    let alarm: &[String] = if *failed > 0 { &[alarm] } else { &[] };
    let title = title.map(names::with_symbols);
    let abreast = drawing.abreast.min(drawing.panels.len()).max(1);
    let head = Head::new(title.as_deref(), "Study", &note, alarm, abreast);
    let width = SIZE.0 * abreast as f64;
    let rows = drawing.panels.len().div_ceil(abreast);
    let legend = Legend::new(&drawing.legend, width);
    let below = head.height + PANEL * rows as f64;
    let mut figure = Canvas::new(width, below + legend.height);
    // Frames over each other begin at one abscissa.
    let margin = drawing.panels.iter().map(Panel::margin).fold(0.0, f64::max);
    for (index, panel) in drawing.panels.iter().enumerate() {
        let at = (SIZE.0 * (index % abreast) as f64, head.height + PANEL * (index / abreast) as f64);
        place(&mut figure, panel.draw(margin), &format!("frame{index}"), at);
    }
    figure.elements.extend(head.lines);
    legend.draw(&mut figure, below);
    SvgBackend::new().with_pretty(true).render_scene(&figure)
}

#[cfg(test)]
mod tests;
