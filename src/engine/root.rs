//! A root known nearly, found in two or three evaluations.

/// By how much a secant step overshoots, so that the root lies between.
const OVERSHOOT: f64 = 0.02;
/// A bracket this narrow is left: its width tells how far the resolution before was off, and this one will be
/// off by much more than the square of it.
const NARROW: f64 = 1e-3;
/// Steps tried before a root counts as lost.
const STEPS: usize = 6;
/// A step wider than this leaves the neighbourhood.
const WIDEST: f64 = 1.0;

/// The root of `f` near `start`, where its slope is about `slope`, and the slope there; always bracketed.
///
/// Each round takes a step that goes too far on purpose and then the secant between both ends; what the
/// secant misses is a small part of the product of the distances to the root. Ends when that is below
/// `wanted`; `None` when the root is not near, or above `most`.
pub(super) fn polish<E>(
    start: f64,
    mut slope: f64,
    most: f64,
    wanted: f64,
    mut f: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Option<(f64, f64)>, E> {
    // Positions cannot be told apart any closer.
    let wanted = wanted.max(4.0 * f64::EPSILON * start.abs().max(1.0));
    let mut from = start;
    let mut here = f(from)?;
    for _ in 0..STEPS {
        let step = -here / slope;
        if step.is_nan() || step.abs() > WIDEST || from + step > most {
            return Ok(None);
        }
        if step.abs() < wanted {
            return Ok(Some((from + step, slope)));
        }
        let to = from + step * (1.0 + OVERSHOOT);
        let beyond = f(to)?;
        slope = (beyond - here) / (to - from);
        if beyond * here > 0.0 {
            (from, here) = (to, beyond);
            continue;
        }
        let (width, between) = ((to - from).abs(), from - here / slope);
        // Half of the product of the distances at most, and the curve bends little over a narrow bracket.
        if width * width < wanted || width < NARROW {
            return Ok(Some((between, slope)));
        }
        let left = f(between)?;
        let across = (beyond - left) / (to - between);
        if across.is_finite() && across != 0.0 {
            slope = across;
        }
        let last = -left / slope;
        if last.abs() * width < wanted {
            return Ok(Some((between + last, slope)));
        }
        (from, here) = (between, left);
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    #[test]
    fn two_evaluations_near_a_root_more_farther_off_and_none_without() {
        let find = |start: f64, slope: f64, wanted: f64| {
            let mut count = 0;
            let found = polish(start, slope, 10.0, wanted, |x: f64| {
                count += 1;
                Ok::<_, Infallible>(x.exp() - 2.0)
            });
            (found.unwrap(), count)
        };
        let root = std::f64::consts::LN_2;
        let (found, count) = find(root + 1e-4, 2.0, 1e-12);
        let (x, slope) = found.unwrap();
        // f''/(2 f') = 1/2 times the product of the distances, 1e-4 and 2e-6.
        assert!((x - root).abs() < 1e-9 && (slope - 2.0).abs() < 1e-3, "{x}, {slope}");
        assert_eq!(count, 2);
        // A slope that is off by a quarter costs more, not digits.
        let (found, count) = find(root - 1e-2, 1.5, 1e-12);
        assert!((found.unwrap().0 - root).abs() < 1e-9 && count <= 6, "{count} evaluations");
        let lost = polish(0.0, 1.0, 10.0, 1e-10, |x: f64| Ok::<_, Infallible>(x * x + 1.0)).unwrap();
        assert_eq!(lost, None);
    }
}
