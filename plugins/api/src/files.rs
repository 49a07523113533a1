//! Files that a scene names, and what may be wrong with them or with a text inside the scene.

use std::ops::Range;

/// Where the files that a scene names come from: a folder, a browser's memory, nowhere.
///
/// Plugins ask here and never open a file themselves.
pub trait Files {
    /// All bytes of a file, under the name that the scene gives it; of one above [`LARGEST_FILE`], that many and
    /// one more will do.
    ///
    /// # Errors
    /// Why it cannot be had, in words that go after "cannot read the file: ".
    fn read(&self, name: &str) -> Result<Vec<u8>, String>;
}

/// The largest data file that plugins take, in bytes.
pub const LARGEST_FILE: usize = 64 * 1024 * 1024;

/// No files at all.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoFiles;

impl Files for NoFiles {
    fn read(&self, _name: &str) -> Result<Vec<u8>, String> {
        Err("whoever reads this scene supplies no files".into())
    }
}

/// What is wrong with a plugin's table, beyond the type of a single key: where, what was found, what would be right.
#[derive(Clone, Debug, Default, PartialEq, Eq, thiserror::Error)]
#[error("{message}{}", self.notes())]
pub struct Fault {
    /// The keys and indices that lead to the value meant, from the plugin's table: `["points", "3"]`; empty for the
    /// table as a whole.
    pub path: Vec<String>,
    /// The place inside that value or inside a file.
    pub place: Place,
    /// What is wrong, in one line.
    pub message: String,
    /// What was found.
    pub found: Option<String>,
    /// What would be right.
    pub expected: Option<String>,
    /// What to do, such as the nearest name.
    pub hint: Option<String>,
}

/// A place inside a value.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Place {
    /// The value as it stands.
    #[default]
    Whole,
    /// Bytes of the value, which is a text such as a formula.
    Text(Range<usize>),
    /// A line of a file that the value names.
    File {
        /// Name of the file, as in the scene.
        name: String,
        /// Line, counted from 1; 0 when the file as a whole is meant.
        line: usize,
        /// The line without its end.
        text: String,
        /// Bytes of that line.
        span: Range<usize>,
    },
}

impl Fault {
    /// A fault of the value at a path, as a whole.
    pub fn new(path: &[&str], message: impl Into<String>) -> Self {
        let path = path.iter().map(|&key| key.to_owned()).collect();
        Self { path, message: message.into(), ..Self::default() }
    }

    /// Puts it at a place inside the value.
    #[must_use]
    pub fn at(mut self, place: Place) -> Self {
        self.place = place;
        self
    }

    /// Adds what was found.
    #[must_use]
    pub fn found(mut self, found: impl Into<String>) -> Self {
        self.found = Some(found.into());
        self
    }

    /// Adds what would be right.
    #[must_use]
    pub fn expected(mut self, expected: impl Into<String>) -> Self {
        self.expected = Some(expected.into());
        self
    }

    /// Adds what to do.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }

    fn notes(&self) -> String {
        let place = match &self.place {
            Place::Whole => String::new(),
            Place::Text(span) => format!(" (at byte {})", span.start + 1),
            Place::File { name, line: 0, .. } => format!(" ({name})"),
            Place::File { name, line, .. } => format!(" ({name}:{line})"),
        };
        let notes = [("found", &self.found), ("expected", &self.expected), ("help", &self.hint)];
        let notes = notes.into_iter().filter_map(|(name, note)| Some(format!("; {name}: {}", note.as_ref()?)));
        place + &notes.collect::<String>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_reads_as_one_line() {
        let place = Place::File { name: "a.csv".into(), line: 7, text: "1, x".into(), span: 3..4 };
        let fault = Fault::new(&["file"], "not a number").at(place).found("`x`").expected("a height").hint("look");
        assert_eq!(fault.to_string(), "not a number (a.csv:7); found: `x`; expected: a height; help: look");
        assert_eq!(Fault::new(&[], "no").at(Place::Text(2..3)).to_string(), "no (at byte 3)");
    }

    #[test]
    fn where_there_are_no_files_none_is_read() {
        assert!(NoFiles.read("profile.csv").unwrap_err().contains("no files"));
    }
}
