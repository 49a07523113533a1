//! What a key must refuse, if its [`Values`] are what it holds.

use crate::{Parameter, Values};
use toml::{Table, Value};

/// Values that are not among those; none where nothing is said.
pub(super) fn values(values: Values) -> Vec<Value> {
    let numbers = |numbers: &[f64]| -> Vec<Value> {
        let text = Value::String("no number".into());
        numbers.iter().chain(&[f64::NAN, f64::INFINITY]).map(|number| Value::Float(*number)).chain([text]).collect()
    };
    let number = Value::Integer(1);
    match values {
        // Text and words of a plugin are its own to judge.
        Values::Unstated => Vec::new(),
        Values::Number => numbers(&[]),
        Values::Positive => numbers(&[0.0, -1.0]),
        Values::UpTo(most) => numbers(&[0.0, -1.0, most * (1.0 + 1e-9)]),
        Values::Poisson => numbers(&[-1.0, 0.500_1]),
        Values::Between(least, most) => {
            numbers(&[least - 1e-9 * (1.0 + least.abs()), most + 1e-9 * (1.0 + most.abs())])
        }
        Values::Whole(least, most) => {
            let outside = [least.checked_sub(1), most.checked_add(1)].into_iter().flatten();
            let outside = outside.filter_map(|whole| i64::try_from(whole).ok().map(Value::Integer));
            outside.chain([Value::Integer(-1), Value::Float(least as f64 + 0.5)]).collect()
        }
        Values::Even(least, most) => {
            let odd = i64::try_from(least + 1).ok().map(Value::Integer);
            self::values(Values::Whole(least, most)).into_iter().chain(odd).collect()
        }
        Values::Flag | Values::Text | Values::Line(_) => vec![number],
        Values::OneOf(_) => vec![number, Value::String("no such word".into())],
        Values::List(of, ..) => {
            let lists = self::values(*of).into_iter().map(|value| Value::Array(vec![value]));
            lists.chain([number]).collect()
        }
        Values::ByName(of) => {
            let tables = self::values(*of).into_iter().map(|value| table([("name", value)]));
            tables.chain([number]).collect()
        }
        Values::Table(keys) => wrong_keys(keys).chain([number]).collect(),
        Values::Choice(_) | Values::Plugin(_) => vec![number, table([("type", Value::String("no such type".into()))])],
    }
}

/// Tables with a key too many, or one that is wrong.
fn wrong_keys(keys: &[Parameter]) -> impl Iterator<Item = Value> {
    let wrong = keys.iter().flat_map(|key| values(key.values).into_iter().map(move |value| table([(key.name, value)])));
    wrong.chain([table([("no_such_key", Value::Integer(1))])])
}

fn table<const N: usize>(entries: [(&str, Value); N]) -> Value {
    Value::Table(entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect::<Table>())
}
