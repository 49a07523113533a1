//! What may be wrong with a figure's description.

/// What is wrong with a figure's description.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct PlotFault {
    /// Keys that lead to the place.
    pub(crate) path: Vec<String>,
    pub(crate) message: String,
    pub(crate) found: Option<String>,
    pub(crate) expected: String,
    pub(crate) hint: Option<String>,
}

impl PlotFault {
    pub(super) fn new(path: &[&str], message: impl Into<String>, expected: impl Into<String>) -> Self {
        let path = path.iter().map(|key| (*key).to_owned()).collect();
        Self { path, message: message.into(), found: None, expected: expected.into(), hint: None }
    }

    pub(super) fn missing(key: &str, expected: &str) -> Self {
        Self::new(&[], format!("missing key `{key}`"), expected).found(format!("no `{key}`"))
    }

    pub(super) fn found(self, found: impl Into<String>) -> Self {
        Self { found: Some(found.into()), ..self }
    }

    /// What is wrong in one line, without its place.
    #[cfg(feature = "plot")]
    pub(crate) fn in_one_line(&self) -> String {
        let found = self.found.as_ref().map_or_else(String::new, |found| format!(", found {found}"));
        format!("`{}`: {}{found}, expected {}", self.path.join("."), self.message, self.expected)
    }

    pub(super) fn hint(self, hint: impl Into<String>) -> Self {
        Self { hint: Some(hint.into()), ..self }
    }
}
