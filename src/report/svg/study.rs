//! Figures of a study: a number over an axis, over two, or the tractions of several scenes.

mod curves;
mod gather;
mod map;
mod names;
mod tractions;

use super::FigureError;
use super::canvas::literal;
use super::head::wrapped;
use super::legend::Entry;
use super::panel::Panel;
use super::sheet::Sheet;
use crate::study::{Place, Plot, PlotKind, Shown, Study, in_one_line};
use gather::Groups;
use serde_json::Value;

/// Most panels side by side.
const ABREAST: usize = 2;

/// Characters of a line that tells what is missing, for each panel side by side.
const ALARM: usize = 68;

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
    /// What is left out though it has numbers, in words.
    left_out: Option<String>,
}

/// A figure of a study.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StudyFigure {
    /// The figure as SVG (UTF-8).
    pub svg: String,
    /// What it does not show of numbers that are there, and why; the figure itself says so, too.
    pub left_out: Option<String>,
}

/// A figure of a study as SVG (UTF-8), from the lines of its results in any order. Scenes that did not converge leave
/// gaps, and a line under the title counts them; so it does with numbers that an axis in equal factors has no place
/// for. The same results always give the same text. Without a note, the values that all scenes shown are confined to
/// stand under the title.
///
/// Of the records only what is drawn is kept: of very many scenes a part, chosen by their numbers.
pub fn study_svg(
    study: &Study,
    plot: &Plot,
    records: impl IntoIterator<Item = Value>,
) -> Result<StudyFigure, FigureError> {
    let shown = study.shown(plot).map_err(|fault| FigureError::Plot(in_one_line(&fault)))?;
    let groups = Groups::new(study, plot, &shown);
    let drawing = match plot.kind {
        PlotKind::Curves => curves::draw(&groups, records),
        PlotKind::Tractions => tractions::draw(&groups, records),
        PlotKind::Map => map::draw(&groups, records),
    }?;
    let left_out = drawing.left_out.clone();
    let note = plot.note.as_deref().map_or_else(|| kept(study, &shown), names::with_symbols);
    Ok(StudyFigure { svg: put_together(study, plot, note, drawing), left_out })
}

/// The one value that each scene shown has in common where the study has several, unless a curve or a panel is called
/// that.
fn kept(study: &Study, shown: &Shown) -> String {
    let is_named = |place: &Place| shown.family.iter().chain(&shown.panels).any(|named| named.axis == place.axis);
    let values = shown.only.iter().filter(|(place, steps)| steps.len() == 1 && !is_named(place));
    let names: Vec<String> = values.map(|(place, steps)| names::value(study, *place, steps[0], steps)).collect();
    names.join(", ")
}

/// Title, panels in rows, and the legend under them.
fn put_together(study: &Study, plot: &Plot, note: String, drawing: Drawing) -> String {
    let title = plot.title.as_deref().or(study.title.as_deref()).map(names::with_symbols);
    let Drawing { panels, abreast, legend, scenes, failed, left_out } = drawing;
    let abreast = abreast.min(panels.len());
    let failed = (failed > 0).then(|| format!("{failed} of {scenes} scenes without a converged result"));
    let left_out = left_out.map(|text| wrapped(&text, ALARM * abreast, 2)).unwrap_or_default();
    Sheet {
        title: title.unwrap_or_else(|| "Study".into()),
        notes: Some(note).into_iter().filter(|note| !note.is_empty()).collect(),
        alarm: failed.into_iter().chain(left_out.iter().map(|line| literal(line))).collect(),
        panels,
        abreast,
        legend,
    }
    .draw()
}

#[cfg(test)]
mod tests;
