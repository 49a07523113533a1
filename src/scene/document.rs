//! The text of a scene as a tree that knows where everything stands.

use super::error::{Kind, SHOWN, SceneError};
use super::meant::meant;
use super::syntax::syntax;
use slipzone_api::{Fault, Place, clip};
use std::ops::Range;
use std::path::Path;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A scene's or a study's text, parsed but not yet understood.
pub(crate) struct Document<'a> {
    /// What errors call it: a scene, a study.
    pub(super) what: &'static str,
    name: &'a str,
    text: &'a str,
    tree: Spanned<DeTable<'a>>,
}

impl<'a> Document<'a> {
    /// Parses the TOML of a scene; the first syntax error, if there is one.
    pub(super) fn parse(name: &'a str, text: &'a str) -> Result<Self, SceneError> {
        Self::parse_as("scene", "at least `format`, `[layer]`, `[punch]` and `[load]`", name, text)
    }

    /// Parses the TOML of something else, of which at least some keys are expected.
    pub(crate) fn parse_as(
        what: &'static str,
        expected: &str,
        name: &'a str,
        text: &'a str,
    ) -> Result<Self, SceneError> {
        let tree = DeTable::parse(text).map_err(|error| syntax(name, text, &error))?;
        if tree.get_ref().is_empty() {
            let error = SceneError::whole(name, format!("the {what} is empty"));
            return Err(error.found("no key").expected(expected));
        }
        Ok(Self { what, name, text, tree })
    }

    /// A scene whose values come from several places: its errors have none.
    pub(super) fn of_scene(name: &'a str, tree: Spanned<DeTable<'a>>) -> Self {
        Self { what: "scene", name, text: "", tree }
    }

    /// A table of this document as a document of its own, whose errors have their places in the same text.
    pub(super) fn part(&self, what: &'static str, key: &str) -> Self {
        let table = self.table(&[key]).cloned().unwrap_or_default();
        Self { what, name: self.name, text: self.text, tree: Spanned::new(self.key(&[key]), table) }
    }

    /// The file's name, as it was given.
    pub(super) fn name(&self) -> &'a str {
        self.name
    }

    /// The tree, to be decoded.
    pub(super) fn tree(&self) -> Spanned<DeTable<'a>> {
        self.tree.clone()
    }

    /// The table at a path; the root at an empty one.
    pub(crate) fn table(&self, path: &[&str]) -> Option<&DeTable<'a>> {
        match path {
            [] => Some(self.tree.get_ref()),
            _ => self.value(path)?.get_ref().as_table(),
        }
    }

    /// The value at a path of keys and, in arrays, of indices.
    pub(crate) fn value(&self, path: &[&str]) -> Option<&Spanned<DeValue<'a>>> {
        let (first, rest) = path.split_first()?;
        rest.iter().try_fold(self.tree.get_ref().get(*first)?, |value, key| match value.get_ref() {
            DeValue::Array(array) => array.get(key.parse::<usize>().ok()?),
            other => other.get(*key),
        })
    }

    /// Shows each value at a path and within it that is no table and no array, with the keys and indices that lead
    /// there. Depth is bounded by the parser.
    pub(crate) fn each_within(
        &self,
        path: &[&str],
        visit: impl FnMut(&[String], &DeValue) -> Result<(), SceneError>,
    ) -> Result<(), SceneError> {
        fn look(
            path: &mut Vec<String>,
            value: &DeValue,
            visit: &mut impl FnMut(&[String], &DeValue) -> Result<(), SceneError>,
        ) -> Result<(), SceneError> {
            let mut within = |key: String, value: &DeValue| {
                path.push(key);
                look(path, value, visit)?;
                path.pop();
                Ok(())
            };
            match value {
                DeValue::Table(table) => {
                    table.iter().try_for_each(|(key, value)| within(key.get_ref().to_string(), value.get_ref()))
                }
                DeValue::Array(array) => (0..)
                    .zip(array.iter())
                    .try_for_each(|(index, value): (usize, _)| within(index.to_string(), value.get_ref())),
                _ => visit(path, value),
            }
        }
        let mut visit = visit;
        let Some(value) = self.value(path) else { return Ok(()) };
        look(&mut path.iter().map(|key| (*key).to_owned()).collect(), value.get_ref(), &mut visit)
    }

    /// Where the key at the end of a path stands; an element of an array stands for itself, and the end
    /// of the text for the root.
    pub(crate) fn key(&self, path: &[&str]) -> Range<usize> {
        let Some((last, parents)) = path.split_last() else {
            let end = self.text.trim_end().len();
            return end..end;
        };
        match self.table(parents).and_then(|table| table.get_key_value(*last)) {
            Some((key, _)) => key.span(),
            None => self.value(path).map_or_else(|| self.key(parents), Spanned::span),
        }
    }

    /// The value at the end of a path, or its key when the value is a table or an array; the first of several values
    /// may be written as the only one.
    pub(crate) fn best(&self, path: &[&str]) -> Range<usize> {
        let only = path.split_last().filter(|(last, _)| **last == "0").and_then(|(_, parents)| self.value(parents));
        let is_plain = |value: &&Spanned<DeValue>| !value.get_ref().is_table() && !value.get_ref().is_array();
        self.value(path).or(only).filter(is_plain).map_or_else(|| self.key(path), Spanned::span)
    }

    /// An error about a stretch of the text.
    pub(crate) fn error(&self, span: Range<usize>, message: impl Into<String>) -> SceneError {
        SceneError::at(self.name, self.text, span, message)
    }

    /// What is said against a table, which stands at `path`, or against a file named there: a plugin's own, a figure's.
    pub(crate) fn fault(&self, path: &[&str], fault: Fault) -> SceneError {
        let within = fault.path.iter().map(String::as_str);
        let full: Vec<&str> = path.iter().copied().chain(within).collect();
        let span = self.best(&full);
        let mut error = match fault.place {
            Place::Whole => self.error(span, fault.message),
            Place::Text(part) => self.error(self.within(&full, part).unwrap_or(span), fault.message),
            Place::File { name, line, text, span: part } => {
                let error = SceneError::in_file(&self.beside(&name), line, &text, part, fault.message);
                match &fault.hint {
                    // Of a scene without places the caller knows better.
                    _ if self.text.is_empty() => error,
                    hint => error.named_at(hint.as_deref(), "the file is named", &self.error(span, "")),
                }
            }
        };
        if let Some(found) = fault.found {
            error = error.found(found);
        }
        if let Some(expected) = fault.expected {
            error = error.expected(expected);
        }
        match fault.hint {
            Some(hint) if error.hint.is_none() => error.hint(hint),
            _ => error,
        }
    }

    /// What to call a file that it names, relative to its own folder, where it is called by its own name.
    pub(crate) fn beside(&self, file: &str) -> String {
        Path::new(self.name).with_file_name(file).display().to_string()
    }

    /// Where a part of a text value stands; `None` where it is written with escapes, so that places differ.
    fn within(&self, path: &[&str], part: Range<usize>) -> Option<Range<usize>> {
        let value = self.value(path)?;
        let (text, span) = (value.get_ref().as_str()?, value.span());
        let opening = self.text.get(span.clone())?.find(text)?;
        let is_verbatim = opening <= 4 && part.end <= text.len();
        is_verbatim.then(|| span.start + opening + part.start..span.start + opening + part.end)
    }

    /// A number that is not allowed: what it is, where it stands.
    pub(crate) fn not_allowed(&self, path: &[&str], expected: impl Into<String>) -> SceneError {
        self.error(self.best(path), format!("`{}` is not allowed", dotted(path)))
            .found(self.found(path))
            .expected(expected)
    }

    /// A key that the table at `path` does not have.
    pub(super) fn unknown_key(&self, path: &[&str], key: &str, known: &[&str]) -> SceneError {
        let full = [path, &[key]].concat();
        let is_section = path.is_empty() && self.table(&full).is_some();
        let message = if is_section {
            format!("unknown section [{key}]")
        } else {
            format!("unknown key `{key}` in {}", self.section(path))
        };
        let error = self
            .error(self.key(&full), message)
            .found(format!("`{}`", clip(key, SHOWN)))
            .expected(one_of(known))
            .of_kind(Kind::UnknownKey(owned(path)));
        match meant(path, key, known) {
            Some(hint) => error.hint(hint),
            None => error.nearest(key, known),
        }
    }

    /// The name of the table at a path, as it would be written.
    pub(super) fn section(&self, path: &[&str]) -> String {
        match path {
            [] => format!("the {}", self.what),
            // No section is written with a number.
            _ if path.iter().any(|key| is_index(key)) => format!("`{}`", dotted(path)),
            _ => format!("[{}]", path.join(".")),
        }
    }

    /// The source of the value at a path, for messages; in words when it is long.
    pub(crate) fn found(&self, path: &[&str]) -> String {
        match self.value(path) {
            None => "nothing".into(),
            Some(value) => match value.get_ref() {
                DeValue::Table(table) if table.is_empty() => "an empty table".into(),
                DeValue::Table(_) => "a table".into(),
                DeValue::Array(array) if array.is_empty() => "an empty array".into(),
                DeValue::Array(_) => "an array".into(),
                plain => match self.text.get(value.span()) {
                    Some(source) if !source.is_empty() => format!("`{}`", clip(source, SHOWN)),
                    _ => format!("`{}`", clip(&written(plain), SHOWN)),
                },
            },
        }
    }
}

/// A value that is no table and no array, as it would be written.
pub(crate) fn written(value: &DeValue) -> String {
    match value {
        DeValue::String(string) => format!("{string:?}"),
        DeValue::Integer(integer) => integer.to_string(),
        DeValue::Float(float) => float.as_str().into(),
        DeValue::Boolean(boolean) => boolean.to_string(),
        DeValue::Datetime(datetime) => datetime.to_string(),
        DeValue::Array(_) => "an array".into(),
        DeValue::Table(_) => "a table".into(),
    }
}

/// The number that a value is, if it is one.
pub(super) fn number(value: &DeValue) -> Option<f64> {
    match value {
        DeValue::Float(float) => float.as_str().parse().ok(),
        DeValue::Integer(integer) => i128::from_str_radix(integer.as_str(), integer.radix()).ok().map(|i| i as f64),
        _ => None,
    }
}

/// Whether a part of a path is a place in an array.
pub(super) fn is_index(segment: &str) -> bool {
    !segment.is_empty() && segment.bytes().all(|byte| byte.is_ascii_digit())
}

/// A path to be kept.
pub(super) fn owned(path: &[&str]) -> Vec<String> {
    path.iter().map(ToString::to_string).collect()
}

/// A path as it would be written, indices in brackets.
pub(crate) fn dotted(path: &[&str]) -> String {
    let written: String = path
        .iter()
        .map(|segment| if is_index(segment) { format!("[{segment}]") } else { format!(".{segment}") })
        .collect();
    written.trim_start_matches('.').to_owned()
}

/// Names as a list in words.
pub(crate) fn one_of(names: &[&str]) -> String {
    let quoted: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.as_slice() {
        [] => "no key here".into(),
        [only] => only.clone(),
        _ => format!("one of {}", quoted.join(", ")),
    }
}
