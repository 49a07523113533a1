//! Looks a shape over, point by point, for what its formula does not show.

use crate::{Flaw, PunchShape};

/// Points of the first look; a flaw narrower than a step of them may pass.
const POINTS: u32 = 512;
/// Closer looks at what the first one found, and the points of each.
const CLOSER: u32 = 3;
const CLOSER_POINTS: u32 = 32;

/// Rounding that is no flaw, beside the largest slope or height.
const ROUNDING: f64 = 1e-12;

/// Intervals on which height and slope are compared.
const INTERVALS: u32 = 16;
/// What they may miss of each other, beside the steepest rise over an interval: heights as near to the tip as a
/// millionth of its radius have no more digits.
const SLACK: f64 = 0.01;
/// What a height that is to be 0 may be, beside the largest.
const LEVEL: f64 = 1e-6;

/// What [`PunchShape::flaw`] is where a shape has none of its own: [`first_flaw`], the kinks among the points, or else
/// where the shape contradicts itself.
pub fn flaw<S: PunchShape + ?Sized>(shape: &S, half_width: f64) -> Option<Flaw> {
    let half_width = within(shape, half_width);
    let size = |value: f64| if value.is_finite() { value.abs() } else { 0.0 };
    // What is known of nothing but its values may round by the largest of them, heights by more: what they say is
    // compared with the slope.
    let height = LEVEL / ROUNDING * size(shape.height(half_width));
    let known = (height, size(shape.slope(half_width)));
    first_flaw_beside(known, shape, half_width, shape.kinks()).or_else(|| contradiction(shape, half_width))
}

/// A half-width, but for what rounding puts at the end of the shape or beyond.
fn within<S: PunchShape + ?Sized>(shape: &S, half_width: f64) -> f64 {
    let end = shape.fixed_half_width().unwrap_or(f64::INFINITY).min(shape.reach().unwrap_or(f64::INFINITY));
    if half_width <= end * (1.0 + ROUNDING) { half_width.min(end * (1.0 - ROUNDING)) } else { half_width }
}

/// Where the height of a convex shape is not 0 though it is to be, or rises by what no slope between those of both ends
/// gives.
fn contradiction<S: PunchShape + ?Sized>(shape: &S, half_width: f64) -> Option<Flaw> {
    let flaw = |what, x| Flaw { is_contradiction: true, ..Flaw::new(what, x) };
    let highest = shape.height(half_width).abs();
    let is_off = |x: &f64| shape.height(*x).abs() > LEVEL * highest;
    if let Some(x) = [0.0, shape.face().min(half_width)].into_iter().find(is_off) {
        return Some(flaw("the punch does not touch the surface where it says it does", x));
    }
    let step = half_width / f64::from(INTERVALS);
    let slack = SLACK * step * shape.slope(half_width).abs() + ROUNDING * highest;
    let contradicts = |&(from, to): &(f64, f64)| {
        let rise = shape.height(to) - shape.height(from);
        let [least, most] = [from, to].map(|x| shape.slope(x) * step);
        rise < least - slack || rise > most + slack
    };
    let mut intervals = (0..INTERVALS).map(|i| (f64::from(i) * step, f64::from(i + 1) * step));
    intervals.find(contradicts).map(|(x, _)| flaw("the punch's slope is not that of its height", x))
}

/// The first flaw on `[0, half_width]`: no number, below the tip, or not convex.
///
/// Looks at equally spaced points and at `also`, ascending; then closer at where something was found.
pub fn first_flaw<S: PunchShape + ?Sized>(shape: &S, half_width: f64, also: &[f64]) -> Option<Flaw> {
    first_flaw_beside((0.0, 0.0), shape, half_width, also)
}

/// [`first_flaw`], where so large a height and slope are known, which round.
pub fn first_flaw_beside<S: PunchShape + ?Sized>(
    (height, slope): (f64, f64),
    shape: &S,
    half_width: f64,
    also: &[f64],
) -> Option<Flaw> {
    let mut scale = Scale { height, slope };
    let mut points: Vec<f64> = (1..=POINTS).map(|i| f64::from(i) / f64::from(POINTS) * half_width).collect();
    points.extend(also.iter().filter(|&&x| x > 0.0 && x <= half_width));
    points.sort_unstable_by(f64::total_cmp);
    let (mut flaw, mut between) = scale.look(shape, 0.0, &points)?;
    for _ in 0..CLOSER {
        let (from, to) = between;
        let step = (to - from) / f64::from(CLOSER_POINTS);
        let closer: Vec<f64> = (1..=CLOSER_POINTS).map(|i| f64::from(i) * step + from).collect();
        match scale.look(shape, from, &closer) {
            Some(found) => (flaw, between) = found,
            None => break,
        }
    }
    Some(flaw)
}

/// The largest finite height and slope seen so far.
struct Scale {
    height: f64,
    slope: f64,
}

impl Scale {
    /// The first flaw among ascending points, and the stretch in which it begins.
    fn look<S: PunchShape + ?Sized>(&mut self, shape: &S, from: f64, points: &[f64]) -> Option<(Flaw, (f64, f64))> {
        let mut before = (from, from, shape.slope(from));
        for &x in points {
            let (height, slope) = (shape.height(x), shape.slope(x));
            let stretch = (before.0, x);
            if !height.is_finite() || !slope.is_finite() {
                let word = if height.is_finite() { "slope" } else { "height" };
                return Some((Flaw::new(format!("the punch has no finite {word}"), x), stretch));
            }
            self.height = self.height.max(height.abs());
            self.slope = self.slope.max(slope.abs());
            if height < -ROUNDING * self.height {
                return Some((Flaw::new("the punch leaves the surface", x), stretch));
            }
            if slope < before.2 - ROUNDING * self.slope {
                // What falls before this point has begun to fall at the one before, or short of it.
                return Some((Flaw::new("the punch is not convex", before.1), (before.0, x)));
            }
            before = (before.1, x, slope);
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug)]
    struct Shape {
        height: fn(f64) -> f64,
        slope: fn(f64) -> f64,
    }

    impl PunchShape for Shape {
        fn height(&self, x: f64) -> f64 {
            (self.height)(x)
        }
        fn slope(&self, x: f64) -> f64 {
            (self.slope)(x)
        }
        fn natural_length(&self) -> f64 {
            1.0
        }
    }

    #[test]
    fn a_convex_shape_has_none() {
        let shape = Shape { height: |x| x.abs(), slope: f64::signum };
        assert_eq!(first_flaw(&shape, 3.0, &[]), None, "rounding and straight flanks are no flaw");
    }

    #[test]
    fn the_place_is_found_closely() {
        let wave = Shape { height: |x| 1.0 - x.cos(), slope: f64::sin };
        let flaw = first_flaw(&wave, 3.0, &[]).unwrap();
        assert!(flaw.what.contains("not convex"));
        assert!((flaw.x - std::f64::consts::FRAC_PI_2).abs() < 1e-4, "{flaw:?}");

        let dip = Shape { height: |x| x * (x - 1.0), slope: |x| 2.0 * x - 1.0 };
        let flaw = first_flaw(&dip, 3.0, &[]).unwrap();
        assert!(flaw.what.contains("leaves the surface") && flaw.x < 0.01, "{flaw:?}");

        let circle = Shape { height: |x| 1.0 - (1.0 - x * x).sqrt(), slope: |x| x / (1.0 - x * x).sqrt() };
        let flaw = first_flaw(&circle, 1.5, &[]).unwrap();
        assert!(flaw.what.contains("no finite height") && (flaw.x - 1.0).abs() < 1e-4, "{flaw:?}");
    }

    #[test]
    fn a_single_bad_point_is_found_when_named() {
        let pole = Shape { height: |x| 1e-9 / (x - 0.3).abs() + x * x, slope: |x| 2.0 * x };
        assert_eq!(first_flaw(&pole, 1.0, &[]), None);
        assert_eq!(first_flaw(&pole, 1.0, &[0.3]).map(|flaw| flaw.x), Some(0.3));
    }

    #[test]
    fn shapes_that_say_nothing_of_it_are_looked_over() {
        let wavy =
            Shape { height: |x| 0.5 * x * x + 0.02 * (1.0 - (20.0 * x).cos()), slope: |x| x + 0.4 * (20.0 * x).sin() };
        let flaw = wavy.flaw(1.0).unwrap();
        assert!(flaw.what.contains("not convex") && !flaw.is_contradiction, "{flaw:?}");
        // 1 + 8 cos(20 x) = 0 first where x = 0.0848.
        assert!((flaw.x - (-0.125_f64).acos() / 20.0).abs() < 1e-4, "{flaw:?}");
    }

    #[test]
    fn height_and_slope_must_agree() {
        let contradictory = [
            Shape { height: |x| 0.5 * x * x, slope: |x| 1.3 * x },
            Shape { height: |x| x * x, slope: |x| x },
            Shape { height: |x| 0.5 * x * x, slope: |_| 0.0 },
            Shape { height: |x| 0.5 * x * x + if x.abs() > 0.5 { 0.1 } else { 0.0 }, slope: |x| x },
            Shape { height: |x| 0.5 * x * x + 0.25, slope: |x| x },
        ];
        for shape in contradictory {
            for half_width in [0.6, 1.0] {
                let flaw = shape.flaw(half_width);
                assert!(flaw.as_ref().is_some_and(|flaw| flaw.is_contradiction), "{half_width}: {shape:?}: {flaw:?}");
            }
        }
    }

    #[test]
    fn convex_shapes_may_round_have_corners_and_be_steep() {
        let circle = Shape { height: |x| 1.0 - (1.0 - x * x).sqrt(), slope: |x| x / (1.0 - x * x).sqrt() };
        assert_eq!(circle.flaw(1e-6), None, "its height has hardly three digits left");
        let fine = [
            circle,
            Shape { height: |x| x.cosh() - 1.0 - 0.5 * x * x, slope: |x| x.sinh() - x },
            Shape { height: f64::abs, slope: f64::signum },
            Shape { height: |x| x.powi(64), slope: |x| 64.0 * x.powi(63) },
            Shape { height: |x| 3.0 * (x - 0.3).max(0.0), slope: |x| if x < 0.3 { 0.0 } else { 3.0 } },
            Shape { height: |_| 0.0, slope: |_| 0.0 },
        ];
        for shape in fine {
            for half_width in [0.01, 0.3, 0.9] {
                assert_eq!(shape.flaw(half_width), None, "{half_width}: {shape:?}");
            }
        }
    }

    /// A parabola between sharp corners at 1, and nothing from there on.
    #[derive(Debug)]
    struct Crowned;

    impl PunchShape for Crowned {
        fn height(&self, x: f64) -> f64 {
            if x.abs() < 1.0 { 0.5 * x * x } else { f64::NAN }
        }
        fn slope(&self, x: f64) -> f64 {
            x
        }
        fn fixed_half_width(&self) -> Option<f64> {
            Some(1.0)
        }
        fn natural_length(&self) -> f64 {
            1.0
        }
    }

    #[test]
    fn what_lies_beyond_the_corners_is_no_flaw() {
        assert_eq!((Crowned.flaw(1.0), Crowned.flaw(1.0_f64.next_up())), (None, None));
        assert!(Crowned.flaw(1.1).unwrap().what.contains("no finite height"));
    }
}
