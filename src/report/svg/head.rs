//! What stands over the panels of a figure: its title, the scene in lines, and what is wrong.

use super::canvas::{ALARM, INK, LETTERS, LINE, SIZE, literal};
use crate::engine::Status;
use crate::report::labels::one_line;
use kuva::render::color::Color;
use kuva::render::render::{Primitive, TextAnchor};

/// Characters that a line of the subtitle holds, in the widest of the fonts asked for.
pub(super) const SUBTITLE: usize = 78;

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

/// What is wrong with the numbers, if anything, as far as it fits into two lines.
pub(super) fn alarm(status: Status, reason: Option<&str>) -> Vec<String> {
    const LONGEST: usize = 68;
    const MOST_LINES: usize = 2;
    let status = match status {
        Status::Converged => return Vec::new(),
        Status::NotConverged => "NOT CONVERGED",
        Status::AssumptionViolated => "ASSUMPTION VIOLATED",
        // Of some loads of a curve: of a scene there is no figure.
        Status::Refused => "INCOMPLETE",
    };
    let reason = reason.map(one_line).unwrap_or_default();
    let text = if reason.is_empty() { status.to_owned() } else { format!("{status}: {reason}") };
    wrapped(&text, LONGEST, MOST_LINES).iter().map(|line| literal(line)).collect()
}

/// The parts in lines of so many characters that break between two parts, never within one.
pub(super) fn lines(parts: &[String], longest: usize) -> String {
    let mut lines: Vec<String> = Vec::new();
    for part in parts {
        match lines.last_mut() {
            Some(line) if line.chars().count() + part.chars().count() + 3 <= longest => {
                line.push_str(", ");
                line.push_str(part);
            }
            Some(line) => {
                line.push(',');
                lines.push(part.clone());
            }
            None => lines.push(part.clone()),
        }
    }
    lines.join("\n")
}

/// A text in lines that hold so many characters, cut off after the last line.
pub(super) fn wrapped(text: &str, longest: usize, most_lines: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let full = lines.len() == most_lines;
        let last = lines.last_mut().expect("never empty");
        if last.chars().count() + word.chars().count() < longest {
            last.push_str(if last.is_empty() { "" } else { " " });
            last.push_str(word);
        } else if full {
            last.push('…');
            break;
        } else {
            lines.push(word.chars().take(longest).collect());
        }
    }
    lines
}
