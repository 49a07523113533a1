//! Looks a shape over, point by point, for what its formula does not show.

use slipzone_api::{Flaw, PunchShape};

/// Points of the first look; a flaw narrower than a step of them may pass.
const POINTS: u32 = 512;
/// Closer looks at what the first one found, and the points of each.
const CLOSER: u32 = 3;
const CLOSER_POINTS: u32 = 32;

/// Rounding that is no flaw, beside the largest slope or height.
const ROUNDING: f64 = 1e-12;

/// The first flaw on `[0, half_width]`: no number, below the tip, or not convex.
///
/// Looks at equally spaced points and at `also`, ascending; then closer at where something was found.
pub(crate) fn first_flaw(shape: &dyn PunchShape, half_width: f64, also: &[f64]) -> Option<Flaw> {
    let mut points: Vec<f64> = (1..=POINTS).map(|i| f64::from(i) / f64::from(POINTS) * half_width).collect();
    points.extend(also.iter().filter(|&&x| x > 0.0 && x <= half_width));
    points.sort_unstable_by(f64::total_cmp);
    let mut scale = Scale::default();
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
#[derive(Default)]
struct Scale {
    height: f64,
    slope: f64,
}

impl Scale {
    /// The first flaw among ascending points, and the stretch in which it begins.
    fn look(&mut self, shape: &dyn PunchShape, from: f64, points: &[f64]) -> Option<(Flaw, (f64, f64))> {
        let flaw = |what: String, x: f64| Flaw { what, x };
        let mut before = (from, from, shape.slope(from));
        for &x in points {
            let (height, slope) = (shape.height(x), shape.slope(x));
            let stretch = (before.0, x);
            if !height.is_finite() || !slope.is_finite() {
                let word = if height.is_finite() { "slope" } else { "height" };
                return Some((flaw(format!("the punch has no finite {word}"), x), stretch));
            }
            self.height = self.height.max(height.abs());
            self.slope = self.slope.max(slope.abs());
            if height < -ROUNDING * self.height {
                return Some((flaw("the punch leaves the surface".into(), x), stretch));
            }
            if slope < before.2 - ROUNDING * self.slope {
                // What falls before this point has begun to fall at the one before, or short of it.
                return Some((flaw("the punch is not convex".into(), before.1), (before.0, x)));
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
}
