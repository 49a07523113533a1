//! A number beside what it should be.

use serde::Serialize;

/// What was computed or expected.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Value {
    /// A finite number.
    Number(f64),
    /// A word, such as a status.
    Word(String),
    /// Nothing: it could not be had.
    Missing,
}

impl From<f64> for Value {
    fn from(number: f64) -> Self {
        if number.is_finite() { Self::Number(number) } else { Self::Missing }
    }
}

/// What is called the error of a check.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// `|computed/expected - 1|`.
    Relative,
    /// `|computed - expected|`.
    Absolute,
    /// What `computed` exceeds `expected` by.
    AtMost,
    /// 0 where both are the same word, 1 elsewhere.
    Same,
}

/// One check: it passes where its error does not exceed its tolerance.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// The group it belongs to.
    pub group: &'static str,
    /// What is checked; unique in all groups.
    pub name: String,
    /// What the program gives.
    pub computed: Value,
    /// What it should give.
    pub expected: Value,
    /// What the error is.
    pub measure: Measure,
    /// The error; `None` where something is missing.
    pub error: Option<f64>,
    /// Largest error allowed.
    pub tolerance: f64,
    /// Why the tolerance is what it is.
    pub reason: String,
    /// Where the expected value comes from.
    pub source: String,
    /// Whether it holds.
    pub passed: bool,
    /// What went wrong where there is no number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
}

/// A tolerance and why it is what it is.
#[derive(Clone, Debug)]
pub(super) struct Within(pub(super) f64, pub(super) String);

impl Within {
    pub(super) fn new(tolerance: f64, reason: impl Into<String>) -> Self {
        Self(tolerance, reason.into())
    }
}

/// The largest modulus; infinite where one is NaN.
pub(super) fn worst(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors.into_iter().fold(0.0, |worst, error| {
        let error = if error.is_nan() { f64::INFINITY } else { error.abs() };
        worst.max(error)
    })
}

/// The largest difference of tractions from what they should be, over the largest of these; infinite where one is
/// missing.
pub(super) fn off(tractions: &[Option<f64>], expected: &[f64]) -> f64 {
    let largest = worst(expected.iter().copied());
    worst(
        tractions.iter().zip(expected).map(|(traction, expected)| (traction.unwrap_or(f64::NAN) - expected) / largest),
    )
}

/// Where the checks of one case are written down.
pub(super) struct Sheet {
    group: &'static str,
    checks: Vec<Check>,
}

impl Sheet {
    pub(super) fn new(group: &'static str) -> Self {
        Self { group, checks: Vec::new() }
    }

    pub(super) fn into_checks(self) -> Vec<Check> {
        self.checks
    }

    /// `computed` should be `expected`, relative to it.
    pub(super) fn relative(&mut self, name: &str, computed: f64, expected: f64, within: Within, source: &str) {
        self.number(name, computed, expected, Measure::Relative, (computed / expected - 1.0).abs(), within, source);
    }

    /// `computed` should be `expected`.
    pub(super) fn absolute(&mut self, name: &str, computed: f64, expected: f64, within: Within, source: &str) {
        self.number(name, computed, expected, Measure::Absolute, (computed - expected).abs(), within, source);
    }

    /// `computed` should not be above `expected`; NaN is above everything.
    pub(super) fn at_most(&mut self, name: &str, computed: f64, expected: f64, within: Within, source: &str) {
        self.number(
            name,
            computed,
            expected,
            Measure::AtMost,
            if computed <= expected { 0.0 } else { computed - expected },
            within,
            source,
        );
    }

    /// How many of `least` comparisons are missing, where a method may refuse some: one that refuses everything has
    /// shown nothing.
    pub(super) fn compared(&mut self, what: &str, count: usize, least: usize) {
        let missing = least.saturating_sub(count) as f64;
        let within = Within::new(0.0, "a method that refuses everything has shown nothing");
        self.at_most(&format!("{what} of {least} at least: missing"), missing, 0.0, within, "a count");
    }

    /// An error that a case worked out itself, of which 0 is expected.
    pub(super) fn error(&mut self, name: &str, error: f64, within: Within, source: &str) {
        self.absolute(name, error, 0.0, within, source);
    }

    /// `computed` should be the word `expected`.
    pub(super) fn same(&mut self, name: &str, computed: &str, expected: &str, reason: &str, source: &str) {
        let error = if computed == expected { 0.0 } else { 1.0 };
        let [computed, expected] = [computed, expected].map(|word| Value::Word(word.to_owned()));
        self.push(name, computed, expected, Measure::Same, Some(error), Within::new(0.0, reason), source, None);
    }

    /// A case that gave no number.
    pub(super) fn no_number(&mut self, name: &str, why: String) {
        let within = Within::new(0.0, "a number is expected");
        self.push(name, Value::Missing, Value::Missing, Measure::Absolute, None, within, "", Some(why));
    }

    #[allow(clippy::too_many_arguments)] // a check's own fields, in their order
    fn number(
        &mut self,
        name: &str,
        computed: f64,
        expected: f64,
        measure: Measure,
        error: f64,
        within: Within,
        source: &str,
    ) {
        let error = error.is_finite().then_some(error);
        self.push(name, computed.into(), expected.into(), measure, error, within, source, None);
    }

    #[allow(clippy::too_many_arguments)] // as above
    fn push(
        &mut self,
        name: &str,
        computed: Value,
        expected: Value,
        measure: Measure,
        error: Option<f64>,
        Within(tolerance, reason): Within,
        source: &str,
        note: Option<String>,
    ) {
        let passed = error.is_some_and(|error| error <= tolerance);
        let (group, name, source) = (self.group, name.to_owned(), source.to_owned());
        self.checks.push(Check {
            group,
            name,
            computed,
            expected,
            measure,
            error,
            tolerance,
            reason,
            source,
            passed,
            note,
        });
    }
}
