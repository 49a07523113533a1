//! How far a sequence of refined results is from its limit.

use super::quantity::{Numbers, Quantity};

/// A difference that shrinks by less than this factor says nothing of the next one.
const NOT_SHRINKING: f64 = 0.5;
/// Differences are not taken to shrink any faster, whatever chance makes of two of them.
///
/// Measured on 415 triples of stick ratios on half-planes, whose errors are erratic and of which one difference in
/// ten is small by chance: with 1/32 the estimate was up to 19 times too small, with 1/16 up to 5.5, with 1/8 up
/// to 1.3.
const FASTEST: f64 = 1.0 / 8.0;
/// Factor on what the differences give.
const SAFETY: f64 = 2.0;
/// No number is claimed to be better than this: rounding of a dense solve of a few hundred unknowns.
pub(crate) const ROUNDING: f64 = 1e-13;

/// Relative error estimates of the last of a sequence of results, each by one step finer; `None` with fewer
/// than three results.
///
/// One difference may be small by chance, but all numbers converge at the rate of the scheme: the slowest
/// ratio `r` of two successive differences is taken for the rate of all, and an algebraic sequence then has
/// the error `d r/(1 - r)` left, an exponential one less.
pub(crate) fn extrapolated(history: &[Numbers]) -> Option<Numbers> {
    let [.., first, second, third] = history else { return None };
    let differences = |quantity: Quantity, value: f64| {
        // A number that comes and goes between resolutions is not known at all.
        let difference = |one: &Numbers, other: &Numbers| match (one.get(quantity), other.get(quantity)) {
            (Some(one), Some(other)) => relative(one - other, value),
            _ => 1.0,
        };
        (difference(first, second), difference(second, third))
    };
    let rate = third.iter().fold(FASTEST, |rate, (quantity, value)| {
        let (d1, d2) = differences(quantity, value);
        // Differences of rounding have no ratio.
        if d2 < 0.1 * ROUNDING { rate } else { rate.max(d2 / d1) }
    });
    let mut errors = Numbers::default();
    for (quantity, value) in third.iter() {
        let (d1, d2) = differences(quantity, value);
        let left = if rate < NOT_SHRINKING { d2.max(rate * d1) * rate / (1.0 - rate) } else { d1.max(d2) };
        errors.set(quantity, (SAFETY * left).max(ROUNDING));
    }
    Some(errors)
}

/// Relative error estimates of a result from a finer twin.
pub(crate) fn judged_by_twin(result: &Numbers, twin: &Numbers) -> Numbers {
    let mut errors = Numbers::default();
    for (quantity, value) in result.iter() {
        let error = twin.get(quantity).map_or(1.0, |better| SAFETY * relative(better - value, value));
        errors.set(quantity, error.max(ROUNDING));
    }
    errors
}

/// `|difference|/|scale|`; 1 when nothing is left to compare with.
fn relative(difference: f64, scale: f64) -> f64 {
    if difference == 0.0 {
        0.0
    } else if scale == 0.0 {
        1.0
    } else {
        (difference / scale).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn history(sequences: &[&[f64]]) -> Vec<Numbers> {
        let at = |k: usize| {
            let mut numbers = Numbers::default();
            for (sequence, quantity) in sequences.iter().zip(Quantity::ALL) {
                numbers.set(quantity, sequence[k]);
            }
            numbers
        };
        (0..sequences[0].len()).map(at).collect()
    }

    /// Estimate, truth and first difference of a sequence over 8, 16 and 32 nodes.
    fn judged(error: fn(f64) -> f64) -> [f64; 3] {
        let values: Vec<f64> = [8.0, 16.0, 32.0].map(|n: f64| 1.0 + error(n)).into();
        let estimate = extrapolated(&history(&[&values])).unwrap().get(Quantity::Force).unwrap();
        [estimate, (values[2] - 1.0).abs(), (values[1] - values[0]).abs()]
    }

    #[test]
    fn algebraic_and_exponential_sequences_are_judged_from_above() {
        for error in [|n: f64| n.powi(-2), |n: f64| n.powi(-3)] {
            let [estimate, truth, _] = judged(error);
            assert!((truth..3.0 * truth).contains(&estimate), "{estimate} against {truth}");
        }
        let [estimate, truth, first] = judged(|n: f64| (-n).exp());
        // Two differences that shrink at the fastest rate believed, and the safety.
        let slowest = SAFETY * first * FASTEST.powi(2) / (1.0 - FASTEST);
        assert!((truth..1.01 * slowest).contains(&estimate), "{estimate} against {truth}, {slowest} at most");
    }

    #[test]
    fn a_difference_that_is_small_by_chance_is_not_believed() {
        let slow = [1.0 + 1e-2, 1.0 + 1e-3, 1.0 + 1e-4];
        let lucky = [1.0 + 1e-2, 1.0 + 1e-3, 1.0 + 1e-3];
        let errors = extrapolated(&history(&[&slow, &lucky])).unwrap();
        assert!(errors.get(Quantity::HalfWidth).unwrap() > 1e-4, "{errors:?}");
    }

    #[test]
    fn what_does_not_shrink_is_not_extrapolated() {
        let errors = extrapolated(&history(&[&[1.0, 1.1, 1.0]])).unwrap();
        assert!(errors.get(Quantity::Force).unwrap() > 0.1);
        assert_eq!(extrapolated(&history(&[&[1.0, 1.1]])), None);
    }

    #[test]
    fn a_twin_judges_by_the_whole_difference() {
        let [coarse, fine] = history(&[&[1.0, 1.01]])[..] else { panic!("two") };
        assert!((judged_by_twin(&coarse, &fine).get(Quantity::Force).unwrap() - 0.02).abs() < 1e-12);
        assert_eq!(judged_by_twin(&coarse, &Numbers::default()).get(Quantity::Force), Some(2.0_f64.min(1.0)));
    }
}
