//! The legend of a figure, in rows under its panels or under one of them.

use super::canvas::{LETTERS, lettered, literal};
use super::style::Style;
use kuva::render::color::Color;
use kuva::render::layout::ComputedLayout;
use kuva::render::render::{Primitive, Scene, TextAnchor};
use std::borrow::Cow;

/// A name and what it names.
#[derive(Clone)]
pub(super) struct Entry {
    pub(super) name: Cow<'static, str>,
    pub(super) style: Style,
    /// Whether it is a line, and whether it has marks.
    pub(super) is_line: bool,
    pub(super) is_marked: bool,
}

/// Lengths in px.
const SAMPLE: f64 = 48.0;
const GAP: f64 = 8.0;
const BETWEEN: f64 = 26.0;
const ROW: f64 = 24.0;
/// Room for a row under the axis of a panel.
pub(super) const LEGEND: f64 = 28.0;
/// Width of an average letter in its height; the viewer chooses the font, so nobody knows better.
const LETTER: f64 = 0.52;

/// Entries in a row, or in columns where they are too many for one.
pub(super) struct Legend<'e> {
    rows: Vec<&'e [Entry]>,
    /// Width of a column, where there are some.
    column: Option<f64>,
    pub(super) height: f64,
}

impl Entry {
    /// Of a line without marks.
    pub(super) const fn line(name: &'static str, color: &'static str, width: f64, dashes: &'static str) -> Self {
        let style = Style::line(color, width, dashes);
        Self { name: Cow::Borrowed(name), style, is_line: true, is_marked: false }
    }

    fn width(&self) -> f64 {
        SAMPLE + GAP + LETTER * f64::from(LETTERS) * self.name.chars().count() as f64
    }
}

/// Of entries beside each other, each as wide as it is, or as a column.
fn total(row: &[Entry], column: Option<f64>) -> f64 {
    let widths = row.iter().map(|entry| column.unwrap_or_else(|| entry.width()));
    widths.sum::<f64>() + BETWEEN * (row.len() as f64 - 1.0)
}

/// Under the axis of a panel.
pub(super) fn under_frame(entries: &[Entry], scene: &mut Scene, computed: &ComputedLayout) {
    let middle = computed.margin_left + computed.plot_width() / 2.0;
    Legend::new(entries, computed.width).draw(scene, middle, computed.height - LEGEND);
}

impl<'e> Legend<'e> {
    pub(super) fn new(entries: &'e [Entry], width: f64) -> Self {
        const SIDES: f64 = 20.0;
        let room = width - 2.0 * SIDES;
        let widest = entries.iter().map(Entry::width).fold(1.0, f64::max);
        let is_one_row = total(entries, None) <= room;
        // As many columns as fit, then as few as the rows need.
        let most = (1..=entries.len()).rev().find(|n| widest * *n as f64 + BETWEEN * (*n as f64 - 1.0) <= room);
        let rows = entries.len().div_ceil(most.unwrap_or(1).max(1)).max(1);
        let columns = if is_one_row { entries.len() } else { entries.len().div_ceil(rows) };
        let rows: Vec<&[Entry]> = entries.chunks(columns.max(1)).collect();
        let height = if rows.is_empty() { 0.0 } else { ROW * rows.len() as f64 + 8.0 };
        Self { rows, column: (!is_one_row).then_some(widest), height }
    }

    /// Centred, from `top` on.
    pub(super) fn draw(&self, figure: &mut Scene, middle: f64, top: f64) {
        for (index, row) in self.rows.iter().enumerate() {
            let y = top + (index as f64 + 0.5) * ROW;
            // Columns begin under each other.
            let widest = self.rows.first().map_or(&row[..], |first| first);
            let mut x = middle - total(widest, self.column) / 2.0;
            for entry in *row {
                if entry.is_line {
                    figure.add(Primitive::Line {
                        x1: x,
                        y1: y,
                        x2: x + SAMPLE,
                        y2: y,
                        stroke: Color::from(entry.style.color),
                        stroke_width: entry.style.width,
                        stroke_dasharray: Some(entry.style.dashes.into()),
                    });
                }
                if entry.is_marked {
                    figure.add(entry.style.mark(x + SAMPLE / 2.0, y));
                }
                // Half the height of small letters below the middle.
                let at = (x + SAMPLE + GAP, y + 0.33 * f64::from(LETTERS));
                figure.add(lettered(at, literal(&entry.name), LETTERS, TextAnchor::Start, None));
                x += self.column.unwrap_or_else(|| entry.width()) + BETWEEN;
            }
        }
    }
}
