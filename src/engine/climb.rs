//! Tops between the steps of a walk.

use arrayvec::ArrayVec;

/// Parabolas through a place between two that are lower.
const CLIMBS: usize = 8;
/// How near to that place the next one may be, over the distance of those two.
const BESIDE_TOP: f64 = 0.02;
/// Tops lower than this are not climbed.
const TOO_LOW: f64 = -0.7;

/// The last two places of a walk below zero, and how high each is.
#[derive(Default)]
pub(super) struct Trail(ArrayVec<(f64, f64), 2>);

impl Trail {
    /// Goes on to the next place.
    pub(super) fn pass(&mut self, next: (f64, f64)) {
        if self.0.is_full() {
            self.0.remove(0);
        }
        self.0.push(next);
    }

    /// A place above zero between the last two and the next, where the second of them is the highest, and the first of them: by parabolas
    /// that close in.
    pub(super) fn top(&self, next: (f64, f64), mut excess: impl FnMut(f64) -> f64) -> Option<(f64, f64)> {
        let [mut left, mut top] = self.0[..] else { return None };
        let (below, mut right) = (left.0, next);
        for _ in 0..CLIMBS {
            let (rise, fall) = ((top.1 - left.1) / (top.0 - left.0), (right.1 - top.1) / (right.0 - top.0));
            if !(rise > 0.0 && fall < 0.0 && top.1 > TOO_LOW) {
                return None;
            }
            let at = f64::midpoint(left.0, top.0) - 0.5 * rise * (right.0 - left.0) / (fall - rise);
            // Beside the highest so far, where the parabola ends there.
            let room = BESIDE_TOP * (right.0 - left.0);
            let wider = (right.0 - top.0) - (top.0 - left.0);
            let at = if (at - top.0).abs() > room { at } else { top.0 + room.copysign(wider) };
            let here = (at, excess(at));
            if here.1 >= 0.0 {
                return Some((below, at));
            }
            match (here.1 > top.1, at > top.0) {
                (true, true) => (left, top) = (top, here),
                (true, false) => (right, top) = (top, here),
                (false, true) => right = here,
                (false, false) => left = here,
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_top_between_two_steps_is_climbed() {
        // A cusp, which no parabola is: 0.01 above zero over a width of 0.02.
        let cusp = |x: f64| 0.01 - (x - 0.3).abs();
        let mut trail = Trail::default();
        for x in [-0.4, 0.2] {
            trail.pass((x, cusp(x)));
        }
        let (below, top) = trail.top((0.8, cusp(0.8)), cusp).expect("a top above zero");
        assert!((below + 0.4).abs() < 1e-15 && cusp(top) >= 0.0, "{top}");
        // Not one that stays below, nor where it rises still.
        assert_eq!(trail.top((0.8, cusp(0.8) - 1.0), |x| cusp(x) - 0.02), None);
        assert_eq!(trail.top((0.8, 0.5), cusp), None);
    }
}
