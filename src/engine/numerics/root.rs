//! Roots: one known nearly, found in one to three evaluations, and one between two places.

use basin::{RootError, Toms748Root};
use std::convert::Infallible;

/// By how much a secant step overshoots, so that the root lies between.
const OVERSHOOT: f64 = 0.02;
/// A bracket this narrow is left: its width tells how far the resolution before was off, and this one will be
/// off by much more than the square of it.
const NARROW: f64 = 0.01;
/// Steps tried before a root counts as lost.
const STEPS: usize = 6;
/// A step wider than this leaves the neighbourhood.
const WIDEST: f64 = 1.0;

/// A slope known to within this may move a root without being measured again: what the step misses is this part of
/// it, and resolutions that converge differ by less from step to step.
pub(crate) const CERTAIN: f64 = 0.01;
/// Such a step is no wider than this: the curve's bend over it adds less than that.
const SHORT: f64 = 1e-3;

/// A root, and what is known of the function around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Near {
    pub(crate) at: f64,
    pub(crate) slope: f64,
    /// By how much, relative, the slope changed when it was last measured across the root; infinite where nobody has.
    pub(crate) doubt: f64,
}

/// The root of `f` near the one of a coarser resolution.
///
/// Each round takes a step that goes too far on purpose and then the secant between both ends; what the
/// secant misses is a small part of the product of the distances to the root. Ends when that is below
/// `wanted`; `None` when the root is not near, or above `most`. Once brackets on two resolutions have the same
/// slope, a short step along it is enough.
pub(crate) fn polish<E>(
    start: Near,
    most: f64,
    wanted: f64,
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Option<Near>, E> {
    // Positions cannot be told apart any closer.
    let wanted = wanted.max(4.0 * f64::EPSILON * start.at.abs().max(1.0));
    let Near { at: mut from, mut slope, doubt } = start;
    let mut here = f(from)?;
    if doubt < CERTAIN && (here / slope).abs() < SHORT {
        return Ok(Some(Near { at: (from - here / slope).min(most), slope, doubt }));
    }
    let found = |at: f64, slope: f64| Some(Near { at, slope, doubt: (slope / start.slope - 1.0).abs() });
    for _ in 0..STEPS {
        let step = -here / slope;
        if step.is_nan() || step.abs() > WIDEST || from + step > most {
            return Ok(None);
        }
        // A slope brought along proves nothing: the sign must change, however small the step.
        let to = from + (step * (1.0 + OVERSHOOT)).abs().max(wanted).copysign(step);
        let beyond = f(to)?;
        slope = (beyond - here) / (to - from);
        if beyond * here > 0.0 {
            (from, here) = (to, beyond);
            continue;
        }
        let (width, between) = ((to - from).abs(), from - here / slope);
        // Half of the product of the distances at most, and the curve bends little over a narrow bracket.
        if width * width < wanted || width < NARROW {
            return Ok(found(between, slope));
        }
        let left = f(between)?;
        let across = (beyond - left) / (to - between);
        if across.is_finite() && across != 0.0 {
            slope = across;
        }
        let last = -left / slope;
        if last.abs() * width < wanted {
            return Ok(found(between + last, slope));
        }
        (from, here) = (between, left);
    }
    Ok(None)
}

/// A root between two places, and what is known of the function around it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Bracketed {
    pub(crate) at: f64,
    /// What the function is there.
    pub(crate) value: f64,
    /// Through the last two places tried that are apart by more than rounding; NaN where these are one.
    pub(crate) slope: f64,
}

/// The root of `f` between two places, to within `wanted` (Alefeld, Potra, Shi, ACM TOMS algorithm 748). Both are tried
/// first.
pub(crate) fn bracketed<E>(
    (lower, upper): (f64, f64),
    wanted: f64,
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Bracketed, RootError<E>> {
    let mut last = [(lower, 0.0); 2];
    let found = solver((lower, upper), wanted).solve(|x| {
        let value = f(x)?;
        // Nearer to each other their difference is rounding.
        let before = if (x - last[1].0).abs() < f64::EPSILON.sqrt() { last[0] } else { last[1] };
        last = [before, (x, value)];
        Ok(value)
    })?;
    let [(x0, f0), (x1, f1)] = last;
    Ok(Bracketed { at: found.root(), value: found.value(), slope: (f1 - f0) / (x1 - x0) })
}

/// The place alone, where `f` never fails; `None` where it has the same sign at both.
pub(crate) fn between(ends: (f64, f64), wanted: f64, mut f: impl FnMut(f64) -> f64) -> Option<f64> {
    solver(ends, wanted).solve(|x| Ok::<_, Infallible>(f(x))).ok().map(|found| found.root())
}

fn solver((lower, upper): (f64, f64), wanted: f64) -> Toms748Root {
    Toms748Root::new(lower, upper).with_absolute_position_tolerance(wanted)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The root of `exp(x) - 2` from a start and a slope, and the evaluations that it took.
    fn find(at: f64, slope: f64, doubt: f64) -> (Option<Near>, usize) {
        let mut count = 0;
        let found = polish(Near { at, slope, doubt }, 10.0, 1e-12, |x: f64| {
            count += 1;
            Ok::<_, Infallible>(x.exp() - 2.0)
        });
        (found.unwrap(), count)
    }

    #[test]
    fn two_evaluations_near_a_root_more_farther_off_and_none_without() {
        let root = std::f64::consts::LN_2;
        let (found, count) = find(root + 1e-4, 2.0, f64::INFINITY);
        let near = found.unwrap();
        // f''/(2 f') = 1/2 times the product of the distances, 1e-4 and 2e-6.
        assert!((near.at - root).abs() < 1e-9 && (near.slope - 2.0).abs() < 1e-3 && near.doubt < 1e-3, "{near:?}");
        assert_eq!(count, 2);
        // A slope a million times too large is found out.
        let (found, count) = find(root + 1e-2, 2e6, f64::INFINITY);
        assert!(found.is_none_or(|near| (near.at - root).abs() < 1e-9), "{found:?} after {count} evaluations");
        // A slope that is off by a quarter costs more, not digits.
        let (found, count) = find(root - 1e-2, 1.5, f64::INFINITY);
        assert!((found.unwrap().at - root).abs() < 1e-9 && count <= 6, "{count} evaluations");
        let start = Near { at: 0.0, slope: 1.0, doubt: 0.0 };
        let lost = polish(start, 10.0, 1e-10, |x: f64| Ok::<_, Infallible>(x * x + 1.0)).unwrap();
        assert_eq!(lost, None);
    }

    #[test]
    fn a_slope_confirmed_moves_a_root_by_a_short_step() {
        let root = std::f64::consts::LN_2;
        let (found, count) = find(root + 1e-5, 2.0, 1e-4);
        assert!((found.unwrap().at - root).abs() < 1e-9, "half of the square of the step: {found:?}");
        assert_eq!(count, 1);
        // Not by a long one, nor by one that is in doubt.
        assert!(find(root + 1e-2, 2.0, 1e-4).1 > 1);
        assert!(find(root + 1e-5, 2.0, 0.1).1 > 1);
    }
}
