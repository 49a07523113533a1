//! Figures of a study: a number over an axis, over two, or the tractions of several scenes.

mod curves;
mod gather;
mod map;
mod names;
mod tractions;

use super::FigureError;
use super::legend::Entry;
use super::panel::Panel;
use super::sheet::Sheet;
use crate::study::{Plot, PlotKind, Study};
use gather::Groups;
use serde_json::Value;

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
    Ok(put_together(study, plot, drawing))
}

/// Title, panels in rows, and the legend under them.
fn put_together(study: &Study, plot: &Plot, drawing: Drawing) -> String {
    let title = plot.title.as_deref().or(study.title.as_deref()).map(names::with_symbols);
    let Drawing { panels, abreast, legend, scenes, failed } = drawing;
    let alarm = format!("{failed} of {scenes} scenes did not converge");
    Sheet {
        title: title.unwrap_or_else(|| "Study".into()),
        notes: plot.note.iter().map(|note| names::with_symbols(note)).collect(),
        alarm: if failed > 0 { vec![alarm] } else { Vec::new() },
        panels,
        abreast,
        legend,
    }
    .draw()
}

#[cfg(test)]
mod tests;
