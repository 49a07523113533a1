//! From the tree to a [`Scene`]; errors of the decoder are put back where they belong.

use super::complaint::Complaint;
use super::document::{Document, dotted, is_index, one_of, owned, written};
use super::error::{Kind, SHOWN, SceneError};
use super::tables::Tables;
use serde::de::DeserializeOwned;
use serde_path_to_error::{Path, Segment};
use slipzone_api::{Family, Parameter, PluginInfo, Values, clip, plugins};
use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

/// Characters of a list of keys that are there: it is only help.
const LONGEST_LIST: usize = 200;

/// The version of the format that this program reads.
const FORMAT: &str = "1";

/// The section that says how hard a punch is pressed, in words.
pub(super) const LOAD: &str = "[load] with one of `force`, `half_width`, `indentation`, `path`, `until`";

/// What to do about friction that is none.
const FRICTIONLESS: &str = "a contact without friction has no [friction]";

/// Checks `format` before anything else: the rest is read by its rules.
pub(crate) fn format(document: &Document) -> Result<(), SceneError> {
    let expected = "`format = 1`, the only version so far";
    match document.value(&["format"]).map(Spanned::get_ref) {
        Some(DeValue::Integer(version)) if version.to_string() == FORMAT => Ok(()),
        Some(DeValue::Integer(version)) => Err(document
            .error(document.best(&["format"]), format!("format {} is not known", clip(&version.to_string(), SHOWN)))
            .found(document.found(&["format"]))
            .expected(expected)),
        Some(_) => Err(wrong_type(document, &["format"], expected)),
        None => {
            let first = document.table(&[]).and_then(|table| table.keys().next());
            Err(document
                .error(first.map_or(0..0, Spanned::span), "missing key `format`")
                .found(format!("a {} that does not say its format", document.what))
                .expected(format!("{expected}, on top")))
        }
    }
}

/// Decodes the whole document.
pub(crate) fn decode<T: DeserializeOwned>(document: &Document) -> Result<T, SceneError> {
    let mut tree = document.tree();
    type_first(tree.get_mut());
    serde_path_to_error::deserialize(Tables(toml::Deserializer::from(tree)))
        .map_err(|error| explain(document, error.path(), error.inner().message()))
}

/// Moves `type` to the front of every table: only then do plugins read the rest key by key, and errors
/// keep their place. The parser bounds the depth.
fn type_first(table: &mut DeTable) {
    let mut entries: Vec<_> = std::mem::take(table).into_iter().collect();
    entries.sort_by_key(|(key, _)| key.get_ref() != "type");
    for (_, value) in &mut entries {
        type_first_within(value.get_mut());
    }
    *table = entries.into_iter().collect();
}

fn type_first_within(value: &mut DeValue) {
    match value {
        DeValue::Table(table) => type_first(table),
        DeValue::Array(array) => array.iter_mut().for_each(|value| type_first_within(value.get_mut())),
        _ => {}
    }
}

/// Puts a decoder's complaint into a scene error at the right place.
fn explain(document: &Document, path: &Path, message: &str) -> SceneError {
    let segments: Vec<String> = path
        .iter()
        .filter_map(|segment| match segment {
            Segment::Seq { index } => Some(index.to_string()),
            Segment::Map { key } => Some(key.clone()),
            Segment::Enum { variant } => Some(variant.clone()),
            Segment::Unknown => None,
        })
        .collect();
    let mut path: Vec<&str> = segments.iter().map(String::as_str).collect();
    match Complaint::read(message) {
        Complaint::UnknownKey { key, known } => {
            // The decoder counts the unknown key to the path.
            if path.last() == Some(&key) && document.table(&path[..path.len() - 1]).is_some() {
                path.pop();
            }
            document.unknown_key(&path, key, &known)
        }
        Complaint::UnknownName { name, known } => unknown_name(document, path, name, &known),
        Complaint::MissingKey(key) => missing_key(document, &path, key),
        Complaint::NotWhole { expected } => wrong_type(document, &path, &expected).of_kind(Kind::NotWhole),
        Complaint::WrongType { expected } => {
            // The decoder knows a plugin only as "dyn Grading", wherever in the table it stumbles.
            let expected = match path.as_slice() {
                [parents @ .., "type"] => {
                    family(document, parents).map(|family| format!("a string, {}", names(family)))
                }
                path => family(document, path).map(|family| format!("a table with `type`, {}", names(family))),
            }
            .unwrap_or(expected);
            wrong_type(document, &path, &expected)
        }
        Complaint::OutOfRange { expected, found } => {
            blamed(document, &mut path, message);
            let mut error = document.not_allowed(&path, expected);
            if found == Some("neither") {
                error.message = format!("`{}` lacks a key", dotted(&path));
            }
            let is_friction = path == ["friction", "coefficient"];
            let error = if is_friction { error.hint(FRICTIONLESS) } else { error };
            if let Some(found) = found { error.found(found) } else { error }
        }
        Complaint::TwoOfOneName(name) => two_of_one_name(document, &path, name),
        Complaint::Other(words) => {
            blamed(document, &mut path, message);
            document.error(document.best(&path), format!("`{}`: {words}", dotted(&path))).found(document.found(&path))
        }
    }
}

/// Follows a complaint about a whole table to the last of its keys that the complaint names.
fn blamed<'m>(document: &Document, path: &mut Vec<&'m str>, message: &'m str) {
    let Some(table) = document.table(path) else { return };
    if let Some(key) = message.split('`').skip(1).step_by(2).filter(|name| table.contains_key(*name)).last() {
        path.push(key);
    }
}

fn unknown_name(document: &Document, mut path: Vec<&str>, name: &str, known: &[&str]) -> SceneError {
    if document.table(&path).is_some_and(|table| table.contains_key("type")) {
        path.push("type");
    }
    let of = match path.as_slice() {
        [parents @ .., "type"] => {
            family(document, parents).map(Family::name).or(parents.last().copied()).unwrap_or("type").into()
        }
        _ => format!("`{}`", dotted(&path)),
    };
    let message = format!("unknown {of} `{}`", clip(name, SHOWN));
    let error = document
        .error(document.best(&path), message)
        .found(format!("`{}`", clip(name, SHOWN)))
        .expected(one_of(known))
        .nearest(name, known);
    match (path.as_slice(), name.to_lowercase().as_str()) {
        (["friction", "type"], "none" | "frictionless" | "smooth") => error.hint(FRICTIONLESS),
        (["friction", "type"], "coulomb") => {
            error.hint("Coulomb friction is solved for in Goodman's approximation: `goodman`")
        }
        ([parents @ .., "type"], word) => {
            let of_plugin = || family(document, parents).and_then(|family| slipzone_api::known_elsewhere(family, word));
            let meant = match (parents, word) {
                (["layer", "base"], "bonded" | "fixed" | "clamped") => Some("rigid"),
                (["layer", "base"], "substrate" | "elastic" | "half-space" | "halfspace") => Some("half-plane"),
                _ => of_plugin(),
            };
            match meant {
                Some(meant) => error.hint(format!("it is called `{meant}` here")),
                None => error,
            }
        }
        _ => error,
    }
}

/// What goes by one name is none of both: the program was linked so, and no scene mends that.
fn two_of_one_name(document: &Document, path: &[&str], name: &str) -> SceneError {
    let place = path.strip_suffix(&["type"]).unwrap_or(path);
    let family = family(document, place);
    let crates: Vec<_> = slipzone_api::plugins()
        .into_iter()
        .filter(|info| Some(info.family) == family && info.name == name)
        .map(|info| format!("`{}`", info.krate))
        .collect();
    let whose = if crates.len() > 1 { format!(", of the crates {}", crates.join(" and ")) } else { String::new() };
    document
        .error(document.best(path), format!("two plugins go by the name `{name}` in this program"))
        .found(format!("`{name}`{whose}"))
        .expected("one plugin for each name")
        .hint("rename one of them in its `#[typetag::serde(name = ...)]` and its `register!`, or do not link its crate")
}

fn missing_key(document: &Document, path: &[&str], key: &str) -> SceneError {
    let sections = ["layer", "punch", "load"];
    let what = if path.is_empty() && sections.contains(&key) {
        format!("missing section [{key}]")
    } else {
        format!("missing key `{key}` in {}", document.section(path))
    };
    let present: Vec<_> =
        document.table(path).into_iter().flat_map(DeTable::keys).map(|key| format!("`{}`", key.get_ref())).collect();
    let found = if present.is_empty() { "no key".into() } else { format!("only {}", present.join(", ")) };
    let error = document.error(document.key(path), what).found(clip(&found, LONGEST_LIST));
    error.expected(meaning(document, path, key)).of_kind(Kind::MissingKey(owned(path)))
}

/// A required key and what it stands for.
fn meaning(document: &Document, path: &[&str], key: &str) -> String {
    let parameter =
        plugin(document, path).and_then(|info| info.parameters.iter().find(|parameter| parameter.name == key));
    match (path, key) {
        (_, "type") if family(document, path).is_some() => {
            format!("`type`, {}", family(document, path).map_or_else(String::new, names))
        }
        _ if parameter.is_some() => format!("`{key}`: {}", parameter.map_or("", |parameter| parameter.summary)),
        ([], "layer") => "[layer] with `thickness`, `poisson` and `grading`".into(),
        ([], "punch") => format!("[punch] with `type`, {}", names(Family::Punch)),
        ([], "load") => LOAD.into(),
        ([], "scene") => "`scene`: the name of a scene file, or a table [scene]".into(),
        ([.., "base"], "shear") => "`shear`: its shear modulus (stress), or `young` in its place".into(),
        (_, "poisson") => "`poisson`: Poisson's ratio, a number above -1 and up to 0.5".into(),
        (_, "grading") => format!("`grading`: a table with `type`, {}", names(Family::Grading)),
        ([.., "layers", _], "thickness") => "`thickness`: that of the sublayer (length)".into(),
        (["plots", _], "file") => "`file`: name of the figure, such as `stick.svg`".into(),
        (["find"], "field") => "`field`: path of the field that is looked for, such as `friction.coefficient`".into(),
        (["find"], "from") => "`from`: where the search begins, a number".into(),
        (["find"], "to") => "`to`: where the search ends, a number".into(),
        (["find"], "quantity") => "`quantity`: the number of the result that decides, such as `stick.ratio`".into(),
        (["friction"], "type") => "`type = \"goodman\"`".into(),
        (["friction"], "coefficient") => "`coefficient`: Coulomb's coefficient, a number above 0".into(),
        _ => format!("`{key}`"),
    }
}

/// The known names of a family, in words.
fn names(family: Family) -> String {
    let names: Vec<_> = plugins().into_iter().filter(|info| info.family == family).map(|info| info.name).collect();
    one_of(&names)
}

pub(crate) fn wrong_type(document: &Document, path: &[&str], expected: &str) -> SceneError {
    let found = document.found(path);
    let found = match document.value(path).map(Spanned::get_ref) {
        Some(DeValue::Table(_) | DeValue::Array(_)) | None => found,
        // A float may be written like an integer only with a point, so it must be named.
        Some(other) => format!("the {} {found}", other.type_str()),
    };
    let text = document.value(path).and_then(|value| value.get_ref().as_str());
    let error = document
        .error(document.best(path), format!("`{}` has the wrong type", dotted(path)))
        .found(found)
        .expected(expected);
    match text.and_then(|text| remedy(text.trim(), expected)).or_else(|| brackets(document, path, expected)) {
        Some(hint) => error.hint(hint),
        None => error,
    }
}

/// Which brackets were meant, where a section stands for a list of sections or the other way round.
fn brackets(document: &Document, path: &[&str], expected: &str) -> Option<String> {
    let found = document.value(path)?.get_ref();
    let is_sections = |array: &DeArray| array.iter().all(|value| value.get_ref().is_table()) && !array.is_empty();
    match (path, found) {
        ([name], DeValue::Array(array)) if !expected.starts_with("an array") && is_sections(array) => {
            Some(format!("there is one of it: [{name}] in single brackets"))
        }
        // Of all sections these alone may be there several times.
        ([name @ ("axes" | "plots"), ..], _) if path.len() <= 2 => {
            Some(format!("each stands in a section of its own: [[{name}]] in double brackets"))
        }
        (_, DeValue::Array(_)) => None,
        ([.., key], _) if expected.starts_with("an array") => {
            let inside = if found.is_table() { "{ ... }".into() } else { clip(&written(found), SHOWN) };
            let is_index = is_index(key);
            Some(if is_index { format!("in brackets: [{inside}]") } else { format!("in brackets: {key} = [{inside}]") })
        }
        _ => None,
    }
}

/// What to write in place of a string.
fn remedy(text: &str, expected: &str) -> Option<String> {
    if expected.starts_with("a table with `type`") {
        let is_name = !text.is_empty() && text.chars().all(|c| c.is_ascii_lowercase() || c == '-');
        return is_name.then(|| format!("write {{ type = \"{text}\" }}, and the keys that it takes"));
    }
    if text.parse::<f64>().is_ok_and(f64::is_finite) {
        return Some(format!("without quotes: {text}"));
    }
    let number = text.split_whitespace().next()?;
    number
        .parse::<f64>()
        .is_ok_and(f64::is_finite)
        .then(|| format!("the number alone, {number}; units are named in [units]"))
}

/// The family of plugins that a path of the scene holds; a plugin may hold others, as its keys say.
fn family(document: &Document, path: &[&str]) -> Option<Family> {
    let whole = |family: Family| family.place().split('.').count();
    let begins = |family: &Family| family.place().split('.').eq(path.iter().take(whole(*family)).copied());
    let mut family = Family::ALL.into_iter().find(begins)?;
    let mut rest = &path[whole(family)..];
    while !rest.is_empty() {
        let info = named(document, &path[..path.len() - rest.len()], family)?;
        (family, rest) = held(info.parameters, rest)?;
    }
    Some(family)
}

/// The family of plugins that a path among these keys leads to, and what is left of the path.
fn held<'p>(keys: &[Parameter], path: &'p [&'p str]) -> Option<(Family, &'p [&'p str])> {
    let (name, mut path) = path.split_first()?;
    let mut values = keys.iter().find(|key| key.name == *name)?.values;
    while let (Values::List(entry, ..) | Values::ByName(entry), [_, rest @ ..]) = (values, path) {
        (values, path) = (*entry, rest);
    }
    match values {
        Values::Plugin(family) => Some((family, path)),
        Values::Table(keys) => held(keys, path),
        _ => None,
    }
}

/// The plugin of a family that the table at a path names.
fn named(document: &Document, path: &[&str], family: Family) -> Option<&'static PluginInfo> {
    let name = document.table(path)?.get("type")?.get_ref().as_str()?;
    slipzone_api::find(family, name)
}

/// The plugin that the table at a path names.
fn plugin(document: &Document, path: &[&str]) -> Option<&'static PluginInfo> {
    named(document, path, family(document, path)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_that_holds_plugins_is_known_wherever_it_stands() {
        const GRADING: Values = Values::Plugin(Family::Grading);
        const PART: [Parameter; 1] = [Parameter::required("of", "the part's", GRADING)];
        let keys = [
            Parameter::required("one", "another", GRADING),
            Parameter::optional("named", "others", Values::ByName(&GRADING)),
            Parameter::optional("parts", "parts", Values::List(&Values::Table(&PART), 1, 9)),
        ];
        for path in [&["one"][..], &["named", "my"], &["parts", "3", "of"]] {
            assert_eq!(held(&keys, path), Some((Family::Grading, &[][..])), "{path:?}");
        }
        assert_eq!(held(&keys, &["one", "type"]), Some((Family::Grading, &["type"][..])));
        for path in [&["named"][..], &["parts", "3"], &["parts", "3", "type"], &["other"]] {
            assert_eq!(held(&keys, path), None, "{path:?}");
        }
    }
}
