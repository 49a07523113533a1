//! What changes from scene to scene.

use crate::scene::to_fifteen_digits;
use std::borrow::Cow;
use std::fmt;

/// Fields of a scene that change together, step by step.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The fields, as the study lists them.
    pub columns: Vec<Column>,
    /// Steps.
    pub count: u64,
}

/// One field of the scene along an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Path of the field in the scene, such as `layer.grading.base`.
    pub field: String,
    /// What it is called in tables and figures; its path unless the study says otherwise.
    pub label: String,
    /// The keys of the path.
    pub(super) path: Vec<String>,
    pub(super) values: Values,
}

/// What a field takes along an axis.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Values {
    /// One after another, as TOML and as they are shown.
    Listed(Vec<(String, Cell)>),
    /// Equal steps, of the logarithm where `by_factors`.
    Steps { from: f64, to: f64, count: u64, by_factors: bool, whole: bool },
    /// Drawn from an interval, evenly, or by the logarithm where `by_factors`.
    Drawn { from: f64, to: f64, by_factors: bool, seed: u64 },
}

/// A value of an axis as tables show it.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum Cell {
    /// A number.
    Number(f64),
    /// Anything else: text, the name that the study gives, or the `type` of a table.
    Text(String),
}

impl fmt::Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{number:?}"),
            Self::Text(text) => write!(f, "`{text}`"),
        }
    }
}

impl Column {
    /// The value of a step, as TOML.
    pub(super) fn toml(&self, step: u64) -> Cow<'_, str> {
        match &self.values {
            Values::Listed(listed) => Cow::Borrowed(&listed[at(step)].0),
            Values::Steps { whole: true, .. } => Cow::Owned(format!("{:.0}", self.number(step))),
            _ => Cow::Owned(format!("{:?}", self.number(step))),
        }
    }

    /// The value of a step, as tables show it.
    pub fn cell(&self, step: u64) -> Cell {
        match &self.values {
            Values::Listed(listed) => listed[at(step)].1.clone(),
            _ => Cell::Number(self.number(step)),
        }
    }

    /// All that decides the values, on one line.
    pub(super) fn described(&self) -> String {
        match &self.values {
            Values::Listed(listed) => listed.iter().map(|(toml, _)| toml.as_str()).collect::<Vec<_>>().join(", "),
            Values::Steps { from, to, count, by_factors, .. } => {
                let kind = if *by_factors { "log" } else { "linear" };
                format!("{kind} from {from:?} to {to:?}, {count} of them")
            }
            Values::Drawn { from, to, by_factors, seed } => {
                let kind = if *by_factors { "log" } else { "linear" };
                format!("drawn, {kind} from {from:?} to {to:?}, by {seed}")
            }
        }
    }

    /// What the values are shown as, where that is not what they are.
    pub(super) fn names(&self) -> Option<String> {
        let Values::Listed(listed) = &self.values else { return None };
        let names = listed.iter().map(|(_, cell)| match cell {
            Cell::Text(text) => Some(text.as_str()),
            Cell::Number(_) => None,
        });
        names.collect::<Option<Vec<_>>>().map(|names| format!("{names:?}"))
    }

    /// Of values that are not listed.
    fn number(&self, step: u64) -> f64 {
        match self.values {
            Values::Steps { from, to, count, by_factors, whole } => {
                let last = count.saturating_sub(1);
                let value = if step == 0 {
                    from
                } else if step == last {
                    to
                } else {
                    let value = to_fifteen_digits(between(from, to, step as f64 / last as f64, by_factors));
                    // What is left of 0 by rounding is no step.
                    let least = if by_factors { 0.0 } else { 1e-15 * from.abs().max(to.abs()) };
                    if value.abs() <= least { 0.0 } else { value }
                };
                if whole { value.round() } else { value }
            }
            Values::Drawn { from, to, by_factors, seed } => between(from, to, uniform(seed, step), by_factors),
            Values::Listed(_) => f64::NAN,
        }
    }

    /// The ends of what is drawn at random, which are checked before anything is solved though they may never be drawn,
    /// by their keys; none of other values.
    pub(super) fn ends(&self) -> Vec<(&'static str, f64)> {
        match self.values {
            Values::Drawn { from, to, .. } => vec![("from", from), ("to", to)],
            _ => Vec::new(),
        }
    }

    /// Steps whose values are checked before anything is solved: all that are listed, the ends of a range.
    pub(super) fn checked(&self) -> Vec<u64> {
        match self.values {
            Values::Listed(ref listed) => (0..listed.len() as u64).collect(),
            Values::Steps { count, .. } => vec![0, count - 1],
            Values::Drawn { .. } => vec![0],
        }
    }
}

/// The place of a step in a list, which is in memory.
#[allow(clippy::cast_possible_truncation)]
fn at(step: u64) -> usize {
    step as usize
}

fn between(from: f64, to: f64, share: f64, by_factors: bool) -> f64 {
    if by_factors { from * (to / from).powf(share) } else { from + (to - from) * share }
}

/// A number in `[0, 1)` for each step, the same on every machine: the finaliser of `SplitMix64` (Steele, Lea, Flood,
/// OOPSLA 2014) on the step.
fn uniform(seed: u64, step: u64) -> f64 {
    let mut z = seed.wrapping_add(step.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^= z >> 31;
    (z >> 11) as f64 / (1_u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(values: Values) -> Column {
        Column { field: "x".into(), label: "x".into(), path: vec!["x".into()], values }
    }

    #[test]
    fn ranges_end_exactly_where_they_say() {
        for by_factors in [false, true] {
            let steps = column(Values::Steps { from: 0.1, to: 0.7, count: 7, by_factors, whole: false });
            let told: Vec<f64> = (0..7).map(|step| steps.toml(step).parse().unwrap()).collect();
            assert_eq!((told[0], told[6]), (0.1, 0.7));
            assert!(told.is_sorted());
        }
        let whole = column(Values::Steps { from: 1.0, to: 10.0, count: 4, by_factors: false, whole: true });
        assert_eq!([0, 1, 3].map(|step| whole.toml(step)), ["1", "4", "10"]);
        let tenths = column(Values::Steps { from: 0.0, to: 0.4, count: 5, by_factors: false, whole: false });
        assert_eq!(tenths.toml(3), "0.3");
        let across = column(Values::Steps { from: -0.2, to: 0.5, count: 8, by_factors: false, whole: false });
        assert_eq!(across.toml(2), "0.0");
    }

    /// Draws fill their interval evenly: the mean of n is off by `0.29/sqrt(n)` in the root mean square.
    #[test]
    fn draws_are_even_and_repeat() {
        let draws: Vec<f64> = (0..10_000).map(|step| uniform(7, step)).collect();
        assert!(draws.iter().all(|x| (0.0..1.0).contains(x)));
        let mean = draws.iter().sum::<f64>() / 1e4;
        assert!((mean - 0.5).abs() < 4.0 * 0.0029, "{mean}");
        assert_eq!(draws[3].to_bits(), uniform(7, 3).to_bits());
        assert!((uniform(8, 3) - draws[3]).abs() > 0.0);
    }
}
