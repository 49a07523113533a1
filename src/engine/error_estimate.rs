//! How far a sequence of refined results is from its limit.

use std::collections::BTreeMap;

/// Reported numbers at one resolution, by their path in the result.
pub(crate) type Numbers = BTreeMap<&'static str, f64>;

/// Error of a second-order scheme over the difference to the result at half the resolution, `1/(4 - 1)`.
const SECOND_ORDER: f64 = 1.0 / 3.0;
/// A difference that shrinks by less than this factor says nothing of the next one.
const NOT_SHRINKING: f64 = 0.5;
/// Two successive differences that both shrink by more than this factor converge exponentially.
const EXPONENTIAL: f64 = 1.0 / 16.0;
/// Factor on what the differences give.
const SAFETY: f64 = 2.0;
/// No number is claimed to be better than this: rounding of a dense solve of a few hundred unknowns.
const ROUNDING: f64 = 1e-13;

/// Relative error estimates of the last of a sequence of results, each at twice the resolution.
///
/// Two errors of second order, of the kernel and of the quadrature, may cancel in one difference by
/// chance, so the last two are consulted: `d2/3` and `d1/12` are what each alone would give. Only where
/// three differences shrink ever faster is the scheme taken to converge exponentially, with the error
/// `d2 (d2/d1)` at most. `None` with fewer than three results.
pub(crate) fn extrapolated(history: &[Numbers]) -> Option<BTreeMap<String, f64>> {
    let [earlier @ .., first, second, third] = history else { return None };
    let estimate = |name: &'static str, value: f64| {
        let difference = |one: &Numbers, other: &Numbers| match (one.get(name), other.get(name)) {
            (Some(one), Some(other)) => relative(*one, *other, value),
            _ => 1.0, // a number that comes and goes between resolutions is not known at all
        };
        let (d1, d2) = (difference(first, second), difference(second, third));
        let d0 = earlier.last().map_or(f64::INFINITY, |zeroth| difference(zeroth, first));
        let left = if d1 < EXPONENTIAL * d0 && d2 < EXPONENTIAL * d1 && d0.is_finite() {
            d2 * (d2 / d1)
        } else if d2 > NOT_SHRINKING * d1 {
            d2.max(d1)
        } else {
            SECOND_ORDER * d2.max(d1 / 4.0)
        };
        (SAFETY * left).max(ROUNDING)
    };
    Some(third.iter().map(|(name, value)| ((*name).to_owned(), estimate(name, *value))).collect())
}

/// Relative error estimates of a result from a twin at twice its resolution.
pub(crate) fn judged_by_twin(result: &Numbers, twin: &Numbers) -> BTreeMap<String, f64> {
    let estimate = |name: &'static str, value: f64| {
        let Some(&better) = twin.get(name) else { return 1.0 };
        // The twin's own error is a quarter of the result's at second order.
        (SAFETY * relative(better, value, value)).max(ROUNDING)
    };
    result.iter().map(|(name, value)| ((*name).to_owned(), estimate(name, *value))).collect()
}

/// `|one - other|/|scale|`; 1 when nothing is left to compare with.
fn relative(one: f64, other: f64, scale: f64) -> f64 {
    let difference = (one - other).abs();
    if difference == 0.0 {
        0.0
    } else if scale == 0.0 {
        1.0
    } else {
        difference / scale.abs()
    }
}
