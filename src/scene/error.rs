//! What is wrong with a scene, and where.

use std::ops::Range;

/// Characters of a value that a message shows, at most.
pub(super) const SHOWN: usize = 40;

/// A scene that cannot be used: what was found, where, and what was expected in its place.
///
/// No field but `excerpt` holds characters that a terminal would obey. `Display` gives several lines of plain text;
/// programs with a terminal draw their own from the fields.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.in_words())]
pub struct SceneError {
    /// Name of the file, as it was given; a scene may name others.
    pub file: String,
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
    /// Bytes of the scene's text that are meant; empty when nothing in it is, but a line of a file that it names.
    pub span: Range<usize>,
    /// The line (of a very long one, the part around the error); empty when the whole file is meant.
    pub excerpt: String,
    /// Bytes of `excerpt` that are meant.
    pub marked: Range<usize>,
    /// What is wrong, in one line.
    pub message: String,
    /// What was found.
    pub found: Option<String>,
    /// What would be right.
    pub expected: Option<String>,
    /// What to do, such as the nearest name.
    pub hint: Option<String>,
    /// What a study that made the scene goes by.
    pub(crate) kind: Kind,
}

/// What is wrong, where it matters to a study that made the scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Other,
    /// The table at this path has no such key.
    UnknownKey(Vec<String>),
    /// The table at this path lacks a key.
    MissingKey(Vec<String>),
    /// A key below what is no table and no array.
    NoPlace,
    /// A number with a point where whole numbers belong.
    NotWhole,
    /// A load beside another one.
    SecondLoad,
}

/// Bytes of a line kept on each side of an error.
const MARGIN: usize = 80;

impl SceneError {
    /// An error about a stretch of the text.
    pub(crate) fn at(file: &str, text: &str, span: Range<usize>, message: impl Into<String>) -> Self {
        let start = floor(text, span.start.min(text.len()));
        let end = floor(text, span.end.clamp(start, text.len()));
        let line_start = text[..start].rfind('\n').map_or(0, |newline| newline + 1);
        let line_end = text[start..].find('\n').map_or(text.len(), |newline| start + newline);
        let line_end = if text[line_start..line_end].ends_with('\r') { line_end - 1 } else { line_end };
        let from = floor(text, line_start.max(start.saturating_sub(MARGIN)));
        let to = floor(text, line_end.min(start + 2 * MARGIN)).max(from);
        Self {
            file: printable(file),
            line: 1 + text[..start].bytes().filter(|&byte| byte == b'\n').count(),
            column: 1 + text[line_start..start].chars().count(),
            span: start..end,
            excerpt: text[from..to].into(),
            marked: start.min(to) - from..end.min(to) - from,
            message: printable(&message.into()),
            found: None,
            expected: None,
            hint: None,
            kind: Kind::Other,
        }
    }

    /// An error in a line of a file that the scene names; line 0 is the file as a whole.
    pub(super) fn in_file(file: &str, line: usize, text: &str, span: Range<usize>, message: String) -> Self {
        let mut error = Self::at(file, text, span, message);
        error.line = line.max(1);
        error.span = 0..0;
        error
    }

    /// An error about the file as a whole.
    pub(crate) fn whole(file: &str, message: impl Into<String>) -> Self {
        Self::at(file, "", 0..0, message)
    }

    pub(crate) fn found(mut self, found: impl Into<String>) -> Self {
        self.found = Some(printable(&found.into()));
        self
    }

    pub(crate) fn expected(mut self, expected: impl Into<String>) -> Self {
        self.expected = Some(printable(&expected.into()));
        self
    }

    pub(crate) fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(printable(&hint.into()));
        self
    }

    pub(crate) fn of_kind(mut self, kind: Kind) -> Self {
        self.kind = kind;
        self
    }

    /// Adds "did you mean" when one of the known names is close.
    pub(crate) fn nearest(self, name: &str, known: &[&str]) -> Self {
        match slipzone_api::nearest(name, known) {
            Some(near) => self.hint(format!("did you mean `{near}`?")),
            None => self,
        }
    }

    /// Adds to a hint where a file is named, which has a place of its own.
    pub(crate) fn named_at(self, hint: Option<&str>, named: &str, place: &Self) -> Self {
        let place = format!("{named} in {}, line {}", place.file, place.line);
        self.hint(hint.map_or_else(|| place.clone(), |hint| format!("{hint}; {place}")))
    }

    /// What is wrong in one line, without its place.
    pub fn in_one_line(&self) -> String {
        self.notes().fold(self.message.clone(), |line, (name, note)| format!("{line}; {name}: {note}"))
    }

    /// What was found, what was expected and what to do, as far as there is something to say, each with its name.
    pub fn notes(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let notes = [("found", &self.found), ("expected", &self.expected), ("help", &self.hint)];
        notes.into_iter().filter_map(|(name, note)| Some((name, note.as_deref()?)))
    }

    fn in_words(&self) -> String {
        let mut lines = vec![format!("{}:{}:{}: {}", self.file, self.line, self.column, self.message)];
        if !self.excerpt.is_empty() {
            lines.push(format!("  {} | {}", self.line, printable(&self.excerpt)));
        }
        lines.extend(self.notes().map(|(name, note)| format!("  {name}: {note}")));
        lines.join("\n")
    }
}

/// The text without characters that a terminal would obey.
fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { '\u{fffd}' } else { c }).collect()
}

/// The character boundary at or below a byte offset.
fn floor(text: &str, mut at: usize) -> usize {
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_and_column_count_from_one_in_characters() {
        let text = "a = 1\r\nß = µµ!\r\n";
        let at = text.find('!').unwrap();
        let error = SceneError::at("f", text, at..at + 1, "no");
        assert_eq!((error.line, error.column), (2, 7));
        assert_eq!(error.excerpt, "ß = µµ!", "the line end is no part of the excerpt");
        assert_eq!(&error.excerpt[error.marked.clone()], "!");
    }

    #[test]
    fn any_span_is_safe() {
        let text = "ß\nlong";
        for start in 0..9 {
            for end in 0..9 {
                let error = SceneError::at("f", text, start..end, "no");
                assert!(error.excerpt.get(error.marked.clone()).is_some(), "{start}..{end}");
            }
        }
    }

    #[test]
    fn a_long_line_is_cut_around_the_error() {
        let text = format!("x = [{}!{}]", "1, ".repeat(100_000), "2, ".repeat(100_000));
        let at = text.find('!').unwrap();
        let error = SceneError::at("f", &text, at..at + 1, "no");
        assert!(error.excerpt.len() <= 3 * MARGIN);
        assert_eq!(&error.excerpt[error.marked.clone()], "!");
        assert_eq!(error.column, at + 1);
    }

    #[test]
    fn words_carry_everything_but_control_characters() {
        let error =
            SceneError::at("f", "k = 1\u{1b}[31m", 4..5, "n\u{1b}o").found("1\u{7}").expected("2").hint("try 2");
        let words = error.to_string();
        for field in [&error.message, error.found.as_ref().unwrap()] {
            assert!(!field.contains(char::is_control), "{field:?}");
        }
        assert_eq!(
            words,
            "f:1:5: n\u{fffd}o\n  1 | k = 1\u{fffd}[31m\n  found: 1\u{fffd}\n  expected: 2\n  help: try 2"
        );
    }
}
