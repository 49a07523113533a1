//! Which keys `[load]` holds, and whether the loads of a path grow: said before anything is decoded, where each
//! number still has its place in the text.

use super::LoadPath;
use super::decode::{LOAD, wrong_type};
use super::document::{Document, number};
use super::error::{Kind, SceneError};
use std::ops::RangeInclusive;
use toml::Spanned;
use toml::de::DeValue;

const LOADS: [&str; 5] = ["force", "half_width", "indentation", "path", "until"];
const QUANTITIES: [&str; 3] = ["force", "half_width", "indentation"];
const ONE_QUANTITY: &str = "exactly one of `force`, `half_width`, `indentation`";

/// Checks that there is exactly one load; its value is left to the decoder.
pub(super) fn load(document: &Document) -> Result<(), SceneError> {
    let Some(keys) = keys(document, &["load"], &LOADS)? else {
        return match document.value(&["load"]) {
            Some(_) => Err(wrong_type(document, &["load"], LOAD)),
            None => Ok(()),
        };
    };
    let expected = "exactly one of `force`, `half_width`, `indentation`, `path`, `until`";
    match keys.as_slice() {
        ["path"] => path(document),
        ["until"] => until(document),
        [key] if document.value(&["load", key]).is_some_and(|value| value.get_ref().is_array()) => {
            let example = format!("several loads are a path: `path = {{ {key} = [0.5, 1.0] }}`");
            Err(wrong_type(document, &["load", key], "a number").hint(example))
        }
        [_] => Ok(()),
        [] => Err(document.error(document.key(&["load"]), "no load").found("an empty table").expected(expected)),
        [first, second, ..] => {
            let message = format!("a second load, `{second}` beside `{first}`");
            let error = document.error(document.key(&["load", second]), message).found(listed(&keys));
            let error = error.expected(expected).of_kind(Kind::SecondLoad);
            let ends_itself = keys.contains(&"path") || keys.contains(&"until");
            Err(if ends_itself { error.hint("the last load of a path is the one that is reported") } else { error })
        }
    }
}

/// Loads one by one.
fn path(document: &Document) -> Result<(), SceneError> {
    let Some(keys) = keys(document, &["load", "path"], &QUANTITIES)? else {
        let error = wrong_type(document, &["load", "path"], &format!("a table with {ONE_QUANTITY}"));
        return Err(error.hint("say what grows: `path = { force = [0.5, 1.0] }`"));
    };
    let key = only(document, "path", &keys)?;
    let place = ["load", "path", key];
    let Some(DeValue::Array(loads)) = document.value(&place).map(Spanned::get_ref) else {
        let error = wrong_type(document, &place, "an array of numbers");
        return Err(error.hint(format!("equal steps up to a load are `until = {{ {key} = 1.0 }}`")));
    };
    if !LoadPath::LISTED.contains(&loads.len()) {
        let error = document.not_allowed(&place, from_to(LoadPath::LISTED) + " numbers");
        return Err(if loads.is_empty() { error } else { error.found(format!("{} numbers", loads.len())) });
    }
    let numbers: Vec<Option<f64>> = loads.iter().map(|load| number(load.get_ref())).collect();
    // What is no number above 0 is left to the decoder.
    let falls = |pair: &[Option<f64>]| matches!(pair, [Some(before), Some(load)] if *load > 0.0 && load <= before);
    match numbers.windows(2).position(falls) {
        None => Ok(()),
        Some(before) => {
            let at = |index: usize| index.to_string();
            let previous = document.found(&["load", "path", key, &at(before)]);
            let error = document.not_allowed(
                &["load", "path", key, &at(before + 1)],
                format!("a number above the one before it, which is {previous}"),
            );
            Err(error.hint("the loads of a path grow; unloading is not solved"))
        }
    }
}

/// Equal steps.
fn until(document: &Document) -> Result<(), SceneError> {
    let known = ["force", "half_width", "indentation", "points"];
    let Some(mut keys) = keys(document, &["load", "until"], &known)? else {
        let error = wrong_type(document, &["load", "until"], &format!("a table with {ONE_QUANTITY}"));
        return Err(error.hint("say what grows: `until = { force = 1.0, points = 60 }`"));
    };
    keys.retain(|key| *key != "points");
    only(document, "until", &keys)?;
    let place = ["load", "until", "points"];
    let points = document.value(&place).map(Spanned::get_ref);
    let (least, most) = (*LoadPath::POINTS.start() as f64, *LoadPath::POINTS.end() as f64);
    match points {
        Some(value @ DeValue::Integer(_)) if number(value).is_none_or(|points| points < least || points > most) => {
            Err(document.not_allowed(&place, "an integer ".to_owned() + &from_to(LoadPath::POINTS)))
        }
        _ => Ok(()),
    }
}

/// `from 2 to 100000`.
fn from_to(counts: RangeInclusive<usize>) -> String {
    format!("from {} to {}", counts.start(), counts.end())
}

/// The keys of a table, each of them known; `None` where there is no table.
fn keys<'d>(document: &'d Document, path: &[&str], known: &[&str]) -> Result<Option<Vec<&'d str>>, SceneError> {
    let Some(table) = document.table(path) else { return Ok(None) };
    let keys: Vec<_> = table.keys().map(|key| key.get_ref().as_ref()).collect();
    match keys.iter().find(|key| !known.contains(key)) {
        Some(unknown) => Err(document.unknown_key(path, unknown, known)),
        None => Ok(Some(keys)),
    }
}

/// The one quantity of a path.
fn only<'k>(document: &Document, table: &str, keys: &[&'k str]) -> Result<&'k str, SceneError> {
    match keys {
        [key] => Ok(key),
        [] => Err(document
            .error(document.key(&["load", table]), format!("no load in `load.{table}`"))
            .found(match document.value(&["load", table, "points"]) {
                Some(_) => "`points` alone".into(),
                None => document.found(&["load", table]),
            })
            .expected(ONE_QUANTITY)),
        [first, second, ..] => Err(document
            .error(document.key(&["load", table, second]), format!("a second load, `{second}` beside `{first}`"))
            .found(listed(keys))
            .expected(ONE_QUANTITY)
            .of_kind(Kind::SecondLoad)),
    }
}

/// Keys in words.
fn listed(keys: &[&str]) -> String {
    keys.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(" and ")
}
