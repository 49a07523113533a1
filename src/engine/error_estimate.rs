//! How far a sequence of refined results is from its limit.

use std::collections::BTreeMap;

/// Reported numbers at one resolution, by their path in the result.
pub(crate) type Numbers = BTreeMap<&'static str, f64>;

/// Differences shrink at least by this factor from one resolution to the next before they are trusted to
/// go on shrinking: a scheme of second order gives 1/4, with logarithms up to 0.4.
const SLOWEST: f64 = 0.5;
/// Factor on what the extrapolation of the differences gives.
const SAFETY: f64 = 2.0;
/// An estimate falls at most by this factor below the one before: differences may vanish by chance.
const LARGEST_DROP: f64 = 64.0;
/// No number is claimed to be better than this: rounding of a dense solve of a few hundred unknowns.
const ROUNDING: f64 = 1e-13;

/// Relative error estimates of the last of a sequence of results, each at twice the resolution.
///
/// With differences `d1`, `d2` between the last three, a geometric sequence has the limit
/// `d2 r/(1 - r)`, `r = d2/d1`, away from its last member. `None` with fewer than three results.
pub(crate) fn extrapolated(history: &[Numbers]) -> Option<BTreeMap<String, f64>> {
    let ([.., first, second, third], n) = (history, history.len()) else { return None };
    let before = if n > 3 { extrapolated(&history[..n - 1]) } else { None };
    let estimate = |name: &'static str, value: f64| {
        let at = |numbers: &Numbers| numbers.get(name).copied();
        let (Some(first), Some(second)) = (at(first), at(second)) else { return 1.0 };
        let (d1, d2) = (relative(second, first, value), relative(value, second, value));
        let ratio = if d1 > 0.0 { d2 / d1 } else { SLOWEST };
        let left = if ratio < SLOWEST { d2 * ratio / (1.0 - ratio) } else { 2.0 * d2 };
        let floor = before.as_ref().and_then(|b| b.get(name)).map_or(0.0, |e| e / LARGEST_DROP);
        (SAFETY * left).max(floor.min(d2)).max(ROUNDING)
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
