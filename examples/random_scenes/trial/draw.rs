//! Draws tables from the description of their keys: what a scene may hold is known to `scene::KEYS` and the registry
//! alone, so that a new key or plugin is drawn without a line changed here.

use super::dice::Dice;
use super::formulas;
use slipzone::api::{Family, Kind, Parameter, PluginInfo, Values, plugins};
use toml::{Table, Value};

/// How deep plugins hold plugins, such as stacks in stacks.
const DEEPEST: usize = 3;
/// Sizes that a scene may hold, and all that there are.
const SIZES: [(f64, f64); 2] = [(1e-100, 1e100), (5e-324, f64::MAX)];

/// Draws what keys may hold.
pub(crate) struct Artist<'a> {
    pub(crate) dice: &'a mut Dice,
    /// Share of the numbers that come from the whole range permitted.
    pub(crate) wild: f64,
    /// Share of the optional keys that are there.
    pub(crate) talkative: f64,
    depth: usize,
}

impl<'a> Artist<'a> {
    pub(crate) fn new(dice: &'a mut Dice, wild: f64, talkative: f64) -> Self {
        Self { dice, wild, talkative, depth: 0 }
    }

    /// A table of these keys; `example` is one that is known to be right.
    pub(crate) fn table(&mut self, keys: &[Parameter], example: Option<&Table>) -> Table {
        let mut table = Table::new();
        for key in keys.iter().filter(|key| key.in_place_of.is_none()) {
            if !key.required && !self.dice.chance(self.talkative) {
                continue;
            }
            let others = keys.iter().filter(|other| other.in_place_of == Some(key.name));
            let choice: Vec<&Parameter> = std::iter::once(key).chain(others).collect();
            let key = *self.dice.one_of(&choice);
            let value =
                self.value(key.values, key.samples, example.and_then(|example| example.get(key.name)), key.name);
            table.insert(key.name.into(), value);
        }
        formulas::name_parameters(self.dice, keys, &mut table);
        table
    }

    /// Some plugin of a family.
    pub(crate) fn plugin(&mut self, family: Family) -> Table {
        let nests = |info: &PluginInfo| info.parameters.iter().any(|key| holds_plugins(key.values));
        let all: Vec<_> = plugins().into_iter().filter(|info| info.family == family).collect();
        let all: Vec<_> = all.into_iter().filter(|info| self.depth < DEEPEST || !nests(info)).collect();
        let info = *self.dice.one_of(&all);
        self.of_plugin(info)
    }

    /// A table of that plugin.
    pub(crate) fn of_plugin(&mut self, info: &PluginInfo) -> Table {
        self.depth += 1;
        let example: Table = toml::from_str(info.example).unwrap_or_default();
        let mut table = self.table(info.parameters, Some(&example));
        table.insert("type".into(), info.name.into());
        self.depth -= 1;
        table
    }

    fn kind(&mut self, kinds: &[Kind]) -> Table {
        let kind = self.dice.one_of(kinds);
        let mut table = self.table(kind.parameters, None);
        table.insert("type".into(), kind.name.into());
        table
    }

    fn value(&mut self, values: Values, samples: &[f64], example: Option<&Value>, name: &str) -> Value {
        match values {
            Values::Unstated => example.cloned().unwrap_or_else(|| self.near(samples, true).into()),
            Values::Number => self.number(samples).into(),
            Values::Positive => self.number_within(samples, f64::MIN_POSITIVE, f64::MAX).into(),
            Values::UpTo(most) => self.number_within(samples, f64::MIN_POSITIVE, most).into(),
            Values::Between(least, most) => self.number_within(samples, least, most).into(),
            Values::Poisson => self.poisson().into(),
            Values::Whole(least, most) | Values::Even(least, most) => self.whole(samples, least, most).into(),
            Values::Flag => self.dice.chance(0.5).into(),
            Values::Text => formulas::text(self.dice, name, example, self.wild).into(),
            Values::Line(most) => self.line(most).into(),
            Values::OneOf(words) => (*self.dice.one_of(words)).into(),
            Values::List(inner, least, most) => self.list(*inner, least, most, name),
            Values::ByName(_) => Value::Table(Table::new()), // named after the formulas beside it
            Values::Table(keys) => self.table(keys, None).into(),
            Values::Choice(kinds) => self.kind(kinds).into(),
            Values::Plugin(family) => self.plugin(family).into(),
        }
    }

    /// A number like the samples, or like 1.
    fn near(&mut self, samples: &[f64], positive: bool) -> f64 {
        if !samples.is_empty() && self.dice.chance(0.4) {
            return *self.dice.one_of(samples);
        }
        let ends = samples.first().zip(samples.last());
        match ends {
            Some((least, most)) if *least > 0.0 => self.dice.log(0.7 * least, 1.4 * most),
            Some((least, most)) => self.dice.between(*least, *most),
            None => self.dice.log(0.2, 5.0) * if positive || self.dice.chance(0.5) { 1.0 } else { -1.0 },
        }
    }

    fn number(&mut self, samples: &[f64]) -> f64 {
        if !self.dice.chance(self.wild) {
            return self.near(samples, false);
        }
        let sign = if self.dice.chance(0.5) { -1.0 } else { 1.0 };
        if self.dice.chance(0.1) { 0.0 * sign } else { self.anywhere(f64::MIN_POSITIVE, f64::MAX) * sign }
    }

    fn number_within(&mut self, samples: &[f64], least: f64, most: f64) -> f64 {
        if !self.dice.chance(self.wild) {
            return self.near(samples, true).clamp(least, most);
        }
        if least > 0.0 { self.anywhere(least, most) } else { self.dice.between(least, most) }
    }

    /// Log-uniform over a range, most often over that part of it which scenes may hold; now and then an end.
    fn anywhere(&mut self, least: f64, most: f64) -> f64 {
        if self.dice.chance(0.03) {
            return *self.dice.one_of(&[least, most]);
        }
        // A few decades around 1, as many as make sense, or all.
        let (small, large) = match self.dice.whole(0, 5) {
            0..=2 => (1e-6, 1e6),
            3..=4 => SIZES[0],
            _ => SIZES[1],
        };
        let (small, large) = (small.max(least), large.min(most));
        if small < large { self.dice.log(small, large) } else { self.dice.log(least, most) }
    }

    fn poisson(&mut self) -> f64 {
        if !self.dice.chance(self.wild) {
            return if self.dice.chance(0.9) {
                self.dice.between(0.0, 0.48)
            } else {
                *self.dice.one_of(&[0.0, 0.5, 0.25])
            };
        }
        match self.dice.whole(0, 3) {
            0 => 0.5 - self.dice.log(1e-17, 0.5),
            1 => -1.0 + self.dice.log(1e-16, 1.0),
            2 => self.dice.log(1e-300, 0.5),
            _ => self.dice.between(-0.999, 0.5),
        }
    }

    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_possible_wrap)] // small counts
    fn whole(&mut self, samples: &[f64], least: u64, most: u64) -> i64 {
        let drawn = if !self.dice.chance(self.wild) {
            let typical = if samples.is_empty() {
                (least as f64).max(2.0) * self.dice.log(1.0, 60.0)
            } else {
                self.near(samples, true)
            };
            (typical as u64).clamp(least, most)
        } else if self.dice.chance(0.2) {
            *self.dice.one_of(&[least, most])
        } else {
            (self.dice.log(least.max(1) as f64, most.max(1) as f64) as u64).clamp(least, most)
        };
        drawn as i64
    }

    fn line(&mut self, most: usize) -> String {
        const LETTERS: [char; 14] = ['a', 'Z', '0', ' ', '"', '\'', '\\', '<', '&', '{', 'é', '漢', '🙂', '\u{7}'];
        let wild = self.dice.chance(self.wild);
        let length = if wild { self.dice.whole(0, most as u64 + 1) } else { self.dice.whole(0, 12) };
        let letters = if wild { &LETTERS[..] } else { &LETTERS[..13] };
        (0..length).map(|_| *self.dice.one_of(letters)).collect()
    }

    /// A few entries; numbers ascend most often, and so do rows by their first.
    fn list(&mut self, inner: Values, least: usize, most: usize, name: &str) -> Value {
        let few = if self.dice.chance(0.03 * self.wild) { 300 } else { 4 };
        #[allow(clippy::cast_possible_truncation)] // a few
        let count = self.dice.whole(least as u64, most.min(least + few) as u64) as usize;
        let columns = match inner {
            Values::List(_, least, most) => Some(self.dice.whole(least as u64, most as u64)),
            _ => None,
        };
        let mut entries: Vec<Value> = (0..count)
            .map(|_| match (inner, columns) {
                (Values::List(inner, ..), Some(columns)) if !self.dice.chance(0.1 * self.wild) => {
                    (0..columns).map(|_| self.value(*inner, &[], None, name)).collect::<Vec<_>>().into()
                }
                _ => self.value(inner, &[], None, name),
            })
            .collect();
        if matches!(inner, Values::OneOf(_)) && !self.dice.chance(self.wild) {
            entries.sort_by_key(ToString::to_string);
            entries.dedup();
        } else if !self.dice.chance(0.3 * self.wild) {
            entries.sort_by(|one, other| first(one).total_cmp(&first(other)));
        }
        entries.into()
    }
}

/// The number that a value is or begins with.
fn first(value: &Value) -> f64 {
    match value {
        Value::Array(entries) => entries.first().map_or(0.0, first),
        _ => value.as_float().unwrap_or(0.0),
    }
}

fn holds_plugins(values: Values) -> bool {
    match values {
        Values::Plugin(_) => true,
        Values::List(inner, ..) | Values::ByName(inner) => holds_plugins(*inner),
        Values::Table(keys) => keys.iter().any(|key| holds_plugins(key.values)),
        Values::Choice(kinds) => kinds.iter().any(|kind| kind.parameters.iter().any(|key| holds_plugins(key.values))),
        _ => false,
    }
}
