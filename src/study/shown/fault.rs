//! What may be wrong with a figure's description.

use slipzone_api::Fault;

/// What is wrong where some keys lead to.
pub(super) fn wrong(path: &[&str], message: impl Into<String>, expected: impl Into<String>) -> Fault {
    Fault::new(path, message).expected(expected)
}

/// A key that is missing.
pub(super) fn missing(key: &str, expected: &str) -> Fault {
    wrong(&[], format!("missing key `{key}`"), expected).found(format!("no `{key}`"))
}

/// What is wrong in one line, for those who have no text of the study.
#[cfg(feature = "plot")]
pub(crate) fn in_one_line(Fault { path, message, found, expected, .. }: &Fault) -> String {
    let found = found.as_ref().map_or_else(String::new, |found| format!(", found {found}"));
    format!("`{}`: {message}{found}, expected {}", path.join("."), expected.as_deref().unwrap_or_default())
}
