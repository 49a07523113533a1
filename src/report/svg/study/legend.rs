//! The legend of a study's figure, in rows under its panels.

use super::style::Style;
use crate::report::svg::{INK, LETTERS, literal};
use kuva::render::color::Color;
use kuva::render::render::{Primitive, Scene, TextAnchor};

/// A name and what it names.
pub(super) struct Entry {
    pub(super) name: String,
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
/// Width of an average letter in its height; the viewer chooses the font, so nobody knows better.
const LETTER: f64 = 0.58;

/// Entries in rows, each centred.
pub(super) struct Legend<'e> {
    rows: Vec<Vec<&'e Entry>>,
    width: f64,
    pub(super) height: f64,
}

impl Entry {
    fn width(&self) -> f64 {
        SAMPLE + GAP + LETTER * f64::from(LETTERS) * self.name.chars().count() as f64
    }
}

fn total(row: &[&Entry]) -> f64 {
    row.iter().map(|entry| entry.width()).sum::<f64>() + BETWEEN * (row.len() as f64 - 1.0)
}

impl<'e> Legend<'e> {
    pub(super) fn new(entries: &'e [Entry], width: f64) -> Self {
        const SIDES: f64 = 20.0;
        let mut rows: Vec<Vec<&Entry>> = Vec::new();
        for entry in entries {
            match rows.last_mut() {
                Some(row) if total(row) + BETWEEN + entry.width() <= width - 2.0 * SIDES => row.push(entry),
                _ => rows.push(vec![entry]),
            }
        }
        let height = if rows.is_empty() { 0.0 } else { ROW * rows.len() as f64 + 8.0 };
        Self { rows, width, height }
    }

    pub(super) fn draw(&self, figure: &mut Scene, top: f64) {
        for (index, row) in self.rows.iter().enumerate() {
            let y = top + (index as f64 + 0.5) * ROW;
            let mut x = (self.width - total(row)) / 2.0;
            for entry in row {
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
                figure.add(Primitive::Text {
                    x: x + SAMPLE + GAP,
                    // Half the height of small letters below the middle.
                    y: y + 0.33 * f64::from(LETTERS),
                    content: literal(&entry.name),
                    size: LETTERS,
                    anchor: TextAnchor::Start,
                    rotate: None,
                    bold: false,
                    color: Some(Color::from(INK)),
                });
                x += entry.width() + BETWEEN;
            }
        }
    }
}
