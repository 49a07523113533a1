//! The same scene in other units. The dimension of a key is what its summary says in brackets.

use super::formulas::with_words;
use slipzone::api::{Family, Parameter, Values, find};
use toml::{Table, Value};

/// Powers of length and of stress.
type Dimension = [f64; 2];

/// The values of these keys where the unit of length is `1/length` of what it was, and that of stress likewise; `None`
/// where the dimension of one is not known.
pub(crate) fn scaled(table: &Table, keys: &[Parameter], factors: [f64; 2]) -> Option<Table> {
    let mut scaled = table.clone();
    for key in keys {
        let mut value = table.get(key.name).cloned();
        // Rows of a table have units of their own, which are 1 unless said otherwise.
        if value.is_none() && key.name.ends_with("_unit") && key.summary.ends_with("default 1") {
            value = Some(1.0.into());
        }
        let Some(value) = value else { continue };
        let other = one_value(&value, key, table, factors)?;
        scaled.insert(key.name.into(), other);
    }
    Some(scaled)
}

fn one_value(value: &Value, key: &Parameter, table: &Table, factors: [f64; 2]) -> Option<Value> {
    match (key.values, value) {
        (Values::Text, Value::String(text)) if key.name != "file" => Some(formula(text, key, table, factors)),
        // Of a formula, and in the units of its text.
        (Values::ByName(_), value) => Some(value.clone()),
        (values, value) => nested(value, values, key, table, factors),
    }
}

fn nested(value: &Value, values: Values, key: &Parameter, table: &Table, factors: [f64; 2]) -> Option<Value> {
    match (values, value) {
        (Values::Table(keys), Value::Table(inner)) => Some(scaled(inner, keys, factors)?.into()),
        (Values::Choice(kinds), Value::Table(inner)) => {
            let name = inner.get("type")?.as_str()?;
            let kind = kinds.iter().find(|kind| kind.name == name)?;
            Some(scaled(inner, kind.parameters, factors)?.into())
        }
        (Values::Plugin(family), Value::Table(inner)) => Some(plugin(inner, family, factors)?.into()),
        (Values::List(Values::List(..), ..), value) => Some(value.clone()),
        (Values::List(inner, ..), Value::Array(entries)) => {
            let dimensions = dimensions(key.summary, table);
            let entry = |(index, entry): (usize, &Value)| match entry {
                Value::Float(number) => Some((number * factor(*progression(&dimensions, index)?, factors)).into()),
                _ => nested(entry, *inner, key, table, factors),
            };
            Some(entries.iter().enumerate().map(entry).collect::<Option<Vec<_>>>()?.into())
        }
        (_, Value::Float(number)) => {
            let dimension = dimensions(key.summary, table).first().copied().unwrap_or([0.0, 0.0]);
            Some((number * factor(dimension, factors)).into())
        }
        (_, value) => Some(value.clone()),
    }
}

/// A plugin's table in other units.
pub(crate) fn plugin(table: &Table, family: Family, factors: [f64; 2]) -> Option<Table> {
    scaled(table, find(family, table.get("type")?.as_str()?)?.parameters, factors)
}

fn factor([length, stress]: Dimension, factors: [f64; 2]) -> f64 {
    factors[0].powf(length) * factors[1].powf(stress)
}

/// That of an entry; a list of one dimension has it at all entries.
fn progression(dimensions: &[Dimension], index: usize) -> Option<&Dimension> {
    const NONE: &Dimension = &[0.0, 0.0];
    match dimensions {
        [] => Some(NONE),
        [one] => Some(one),
        many => many.get(index),
    }
}

/// A formula of the same numbers in other units.
fn formula(text: &str, key: &Parameter, table: &Table, factors: [f64; 2]) -> Value {
    let is_length = |word: &str| ["x", "y", "h"].contains(&word);
    let out = with_words(text, |word| is_length(word).then(|| format!("({word}/{:?})", factors[0])));
    let dimension = dimensions(key.summary, table).first().copied().unwrap_or([0.0, 0.0]);
    let factor = factor(dimension, factors);
    if dimension == [0.0, 0.0] { out.into() } else { format!("{factor:?}*({out})").into() }
}

/// The dimensions in the first brackets of a summary that hold some; a list of three goes on like an arithmetic
/// sequence.
fn dimensions(summary: &str, table: &Table) -> Vec<Dimension> {
    for (start, _) in summary.match_indices('(') {
        let Some(inside) = balanced(&summary[start + 1..]) else { continue };
        let inside = inside.split_once(", in ").map_or(inside, |(_, unit)| unit);
        let is_series = inside.ends_with("...");
        let parts = inside.trim_end_matches("...").trim_end_matches(", ").split(", ");
        let Some(mut found) = parts.map(|part| dimension(part, table)).collect::<Option<Vec<_>>>() else { continue };
        if let ([.., before, last], true) = (&found[..], is_series) {
            let (mut last, step) = (*last, [last[0] - before[0], last[1] - before[1]]);
            for _ in 0..64 {
                last = [last[0] + step[0], last[1] + step[1]];
                found.push(last);
            }
        }
        return found;
    }
    Vec::new()
}

/// Up to the bracket that closes.
fn balanced(text: &str) -> Option<&str> {
    let mut depth = 1;
    for (at, c) in text.char_indices() {
        depth += match c {
            '(' => 1,
            ')' => -1,
            _ => 0,
        };
        if depth == 0 {
            return Some(&text[..at]);
        }
    }
    None
}

/// `stress`, `1/length^3`, `stress times length`, `length^(1 - exponent)`, `no unit`.
fn dimension(text: &str, table: &Table) -> Option<Dimension> {
    if let Some((one, other)) = text.split_once(" times ") {
        let (one, other) = (dimension(one, table)?, dimension(other, table)?);
        return Some([one[0] + other[0], one[1] + other[1]]);
    }
    if let Some(inverse) = text.strip_prefix("1/") {
        return dimension(inverse, table).map(|[length, stress]| [-length, -stress]);
    }
    let (unit, power) = text.split_once('^').unwrap_or((text, "1"));
    let power = match power.strip_prefix("(1 - ").and_then(|key| key.strip_suffix(')')) {
        Some(key) => 1.0 - table.get(key)?.as_float()?,
        None => power.parse().ok()?,
    };
    match unit {
        "length" => Some([power, 0.0]),
        "stress" => Some([0.0, power]),
        "no unit" => Some([0.0, 0.0]),
        _ => None,
    }
}
