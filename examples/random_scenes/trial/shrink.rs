//! The smallest scene that fails like a given one: keys left out, lists shortened, numbers rounded.

use super::Trial;
use toml::{Table, Value};

/// Most scenes tried on the way.
const MOST: usize = 400;

/// A step from a scene to a simpler one, at a place: keys and indices.
type Place = Vec<String>;

/// The simplest scene found that fails the same check.
pub(crate) fn shrunk(trial: &Trial) -> Trial {
    let Some((check, _)) = trial.run().failure else { return trial.clone() };
    let mut best =
        Trial { chosen: trial.chosen.iter().copied().filter(|name| *name == check).collect(), ..trial.clone() };
    let fails = |table: &Table| best_fails(trial, table, check);
    if !fails(&best.table) {
        return trial.clone();
    }
    let mut left = MOST;
    loop {
        let before = best.table.clone();
        for place in places(&Value::Table(best.table.clone())) {
            for simpler in simpler(&best.table, &place) {
                if left == 0 {
                    return best;
                }
                left -= 1;
                if fails(&simpler) {
                    best = best.of(simpler);
                    break;
                }
            }
        }
        if best.table == before {
            return best;
        }
    }
}

fn best_fails(trial: &Trial, table: &Table, check: &'static str) -> bool {
    let trial = Trial { chosen: vec![check], ..trial.of(table.clone()) };
    trial.run().failure.is_some_and(|(other, _)| other == check)
}

/// All places of a tree, outer ones first.
fn places(value: &Value) -> Vec<Place> {
    let mut all = Vec::new();
    let children: Vec<(String, &Value)> = match value {
        Value::Table(table) => table.iter().map(|(key, value)| (key.clone(), value)).collect(),
        Value::Array(entries) => entries.iter().enumerate().map(|(index, value)| (index.to_string(), value)).collect(),
        _ => Vec::new(),
    };
    for (step, child) in children {
        all.push(vec![step.clone()]);
        all.extend(places(child).into_iter().map(|place| [vec![step.clone()], place].concat()));
    }
    all
}

/// The scene without what is at a place, or with something simpler there.
fn simpler(table: &Table, place: &[String]) -> Vec<Table> {
    let mut all = Vec::new();
    let mut without = Value::Table(table.clone());
    if remove(&mut without, place) {
        all.extend(without.as_table().cloned());
    }
    let Some(Value::Float(number)) = at(table, place) else { return all };
    for digits in [0, 1, 3] {
        let rounded: f64 = format!("{number:.digits$e}").parse().unwrap_or(*number);
        if rounded.to_bits() != number.to_bits() {
            let mut other = Value::Table(table.clone());
            if let Some(value) = at_mut(&mut other, place) {
                *value = rounded.into();
                all.extend(other.as_table().cloned());
            }
        }
    }
    all
}

fn at<'a>(table: &'a Table, place: &[String]) -> Option<&'a Value> {
    let (first, rest) = place.split_first()?;
    rest.iter().try_fold(table.get(first)?, |value, step| match value {
        Value::Array(entries) => entries.get(step.parse::<usize>().ok()?),
        _ => value.get(step),
    })
}

fn at_mut<'a>(value: &'a mut Value, place: &[String]) -> Option<&'a mut Value> {
    place.iter().try_fold(value, |value, step| match value {
        Value::Array(entries) => entries.get_mut(step.parse::<usize>().ok()?),
        Value::Table(table) => table.get_mut(step),
        _ => None,
    })
}

fn remove(value: &mut Value, place: &[String]) -> bool {
    let Some((last, way)) = place.split_last() else { return false };
    match at_mut(value, way) {
        Some(Value::Table(table)) => table.remove(last).is_some(),
        Some(Value::Array(entries)) => match last.parse::<usize>() {
            Ok(index) if index < entries.len() => {
                entries.remove(index);
                true
            }
            _ => false,
        },
        _ => false,
    }
}
