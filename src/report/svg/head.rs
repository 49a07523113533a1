//! The lines over a row of panels.

use super::{ALARM, INK, LETTERS, LINE, SIZE, SUBTITLE, lines, literal, wrapped};
use crate::report::labels::one_line;
use kuva::render::color::Color;
use kuva::render::render::{Primitive, TextAnchor};

/// A scene's title, or what its figure is called.
pub(super) fn titled(title: Option<&str>, called: &str) -> String {
    title.map(one_line).filter(|title| !title.is_empty()).unwrap_or_else(|| called.into())
}

/// Title, scene and what is wrong, over the panels.
pub(super) struct Head {
    pub(super) lines: Vec<Primitive>,
    /// Where the panels begin, px.
    pub(super) height: f64,
}

impl Head {
    /// A title, the parts of a scene, and what is wrong in lines ready to be set.
    pub(super) fn new(title: &str, parts: &[String], alarm: &[String], panels: usize) -> Self {
        /// Sizes of letters, px.
        const TITLE: u32 = 17;
        const SCENE: u32 = 12;
        /// Characters of a title that fit over a panel, in the widest of the fonts asked for.
        const FITTING: usize = 52;
        let width = SIZE.0 * panels as f64;
        let mut head = Self { lines: Vec::new(), height: 14.0 };
        let mut line = |text: &str, size: u32, color: &str, bold: bool| {
            head.height += 1.35 * f64::from(size);
            head.lines.push(Primitive::Text {
                x: width / 2.0,
                y: head.height,
                content: text.into(),
                size,
                anchor: TextAnchor::Middle,
                rotate: None,
                bold,
                color: Some(Color::from(color)),
            });
        };
        for text in wrapped(&literal(&one_line(title)), FITTING * panels, 3) {
            line(&text, TITLE, INK, false);
        }
        // A part may be longer than a line.
        let longest = SUBTITLE * panels;
        for text in literal(&lines(parts, longest)).lines().flat_map(|text| wrapped(text, longest + 1, 3)) {
            line(&text, SCENE, INK, false);
        }
        for text in alarm {
            line(text, LETTERS - 2, ALARM, true);
        }
        head.height += 0.3 * LINE;
        head
    }
}
