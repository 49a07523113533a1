//! Tops of a function between the places at which it is known: on a walk below zero, or along half of a contact.

use arrayvec::ArrayVec;
use slipzone_api::Station;

/// Parabolas through a place between two that are lower. With 20 the peak of a contact that grew, each of whose
/// pressures is a sum over flat punches, took up to a fifth of its solve where no parabola fits.
const CLIMBS: usize = 12;
/// How near to that place the next one may be, over the distance of those two.
const BESIDE_TOP: f64 = 0.02;
/// Tops lower than this are not climbed on the way to zero.
const TOO_LOW: f64 = -0.7;
/// How often it is looked nearer to the middle for a top beside it, at half the distance each time.
const NEARER: usize = 2;
/// A climb ends where the parabola rises no higher than this beside the top.
const LEVEL: f64 = 1e-12;
/// Share of the highest value that a top among samples reaches if it may be the highest between them.
pub(crate) const NEARLY: f64 = 0.75;

/// A walk below zero.
#[derive(Default)]
pub(crate) struct Trail {
    /// Its last two places, and how high each is.
    last: ArrayVec<(f64, f64), 2>,
    /// How high the highest top climbed is, of those that stayed below zero.
    pub(crate) highest: Option<f64>,
}

impl Trail {
    /// Goes on to the next place.
    pub(crate) fn pass(&mut self, next: (f64, f64)) {
        if self.last.is_full() {
            self.last.remove(0);
        }
        self.last.push(next);
    }

    /// A place above zero between the last two and the next, where the second of them is the highest, or where the
    /// parabola through all three has turned before the next; and one below zero before it.
    pub(crate) fn top(&mut self, next: (f64, f64), mut excess: impl FnMut(f64) -> f64) -> Option<(f64, f64)> {
        let [left, top] = self.last[..] else { return None };
        let three = if next.1 > top.1 {
            let (at, _) = vertex([left, top, next]).filter(|(at, _)| *at < next.0 && next.1 > TOO_LOW)?;
            [top, (at, excess(at)), next]
        } else {
            [left, top, next]
        };
        let (at, height) = climb(three, excess, |height| height >= 0.0 || height <= TOO_LOW);
        if height >= 0.0 {
            return Some((three[0].0, at));
        }
        self.highest = self.highest.into_iter().chain([height]).reduce(f64::max);
        None
    }
}

/// Where the parabola through three places is highest, and how fast it falls from there; `None` where it is open above.
fn vertex([left, top, right]: [(f64, f64); 3]) -> Option<(f64, f64)> {
    let (rise, fall) = ((top.1 - left.1) / (top.0 - left.0), (right.1 - top.1) / (right.0 - top.0));
    let bend = (rise - fall) / (right.0 - left.0);
    (bend > 0.0).then(|| (f64::midpoint(left.0, top.0) + 0.5 * rise / bend, bend))
}

/// The top of a function beside the middle of three places, or where the parabola through them turns before the last: a
/// place, and how high it is there.
pub(crate) fn top([left, top, right]: [(f64, f64); 3], mut height: impl FnMut(f64) -> f64) -> (f64, f64) {
    let turn = vertex([left, top, right]).filter(|(at, _)| right.1 > top.1 && (top.0..right.0).contains(at));
    let three = match turn {
        Some((at, _)) => [top, (at, height(at)), right],
        None => [left, top, right],
    };
    let found = climb(three, height, |_| false);
    if found.1 < right.1 { right } else { found }
}

/// The highest place among three and what parabolas find that close in; as soon as it is high enough, or two parabolas
/// one after another rise no higher.
fn climb(
    [mut left, mut top, mut right]: [(f64, f64); 3],
    mut height: impl FnMut(f64) -> f64,
    is_enough: impl Fn(f64) -> bool,
) -> (f64, f64) {
    let mut was_level = false;
    for _ in 0..CLIMBS {
        let Some((at, bend)) = vertex([left, top, right]).filter(|_| left.1 <= top.1 && top.1 >= right.1) else {
            break;
        };
        // One parabola may turn there by chance.
        let is_level = bend * (at - top.0).powi(2) <= LEVEL * top.1.abs();
        if is_enough(top.1) || is_level && was_level {
            break;
        }
        was_level = is_level;
        // Beside the highest so far, where the parabola ends there.
        let room = BESIDE_TOP * (right.0 - left.0);
        let wider = (right.0 - top.0) - (top.0 - left.0);
        let at = if (at - top.0).abs() > room { at } else { top.0 + room.copysign(wider) };
        let here = (at, height(at));
        match (here.1 > top.1, at > top.0) {
            (true, true) => (left, top) = (top, here),
            (true, false) => (right, top) = (top, here),
            (false, true) => right = here,
            (false, false) => left = here,
        }
    }
    top
}

/// The highest value, and where, of a function on half of a contact: at ascending stations, and at tops between them
/// where the one in the middle of three is no lower than what `least` says of the highest of all. Where the first is
/// the middle of the contact, the function is even about it.
pub(crate) fn highest(
    at: &[Station],
    values: &mut Vec<f64>,
    least: impl FnOnce(f64) -> f64,
    mut values_into: impl FnMut(&[Station], &mut [f64]),
) -> Option<(Station, f64)> {
    values.resize(at.len(), 0.0);
    values_into(at, values);
    let mut value = |at: Station| {
        let mut one = [0.0];
        values_into(&[at], &mut one);
        one[0]
    };
    let most = at.iter().zip(&*values).max_by(|one, other| one.1.total_cmp(other.1))?;
    let mut best = (*most.0, *most.1);
    let least = least(best.1);
    for (at, values) in at.windows(3).zip(values.windows(3)) {
        if !(values[1] >= least && values[1] >= values[0] && values[1] >= values[2]) {
            continue;
        }
        let found = highest_among([at[0], at[1], at[2]], [values[0], values[1], values[2]], &mut value);
        if found.1 > best.1 {
            best = found;
        }
    }
    if let [middle, next, over, ..] = at
        && middle.x == 0.0
        && values[0] >= least
    {
        let three = [(0.0, values[0]), (next.x.powi(2), values[1]), (over.x.powi(2), values[2])];
        if let Some((square, height)) = top_beside_middle(three, |square| value(from_middle(square, middle.gap)))
            && height > best.1
        {
            best = (from_middle(square, middle.gap), height);
        }
    }
    Some(best)
}

/// The top among three stations of which the second is no lower than the others.
fn highest_among(at: [Station; 3], values: [f64; 3], mut value: impl FnMut(Station) -> f64) -> (Station, f64) {
    let middle = at[1];
    if middle.gap < middle.x {
        // From the edge, so that no digit of a gap is lost.
        let beside = |step: f64| Station { x: middle.x + step, gap: middle.gap - step };
        let three = [0, 1, 2].map(|i| (middle.gap - at[i].gap, values[i]));
        let (step, height) = climb(three, |step| value(beside(step)), |_| false);
        return (beside(step), height);
    }
    // Of an even function parabolas tell more by the squares of the distances.
    let half_width = middle.x + middle.gap;
    let three = [0, 1, 2].map(|i| (at[i].x.powi(2), values[i]));
    let (square, height) = climb(three, |square| value(from_middle(square, half_width)), |_| false);
    (from_middle(square, half_width), height)
}

/// A place by the square of its distance from the middle.
fn from_middle(square: f64, half_width: f64) -> Station {
    let x = square.sqrt();
    Station { x, gap: half_width - x }
}

/// A top of an even function between the middle and the next of three places, that is no higher: by the squares of
/// their distances, in which it may rise from the middle.
fn top_beside_middle(
    [middle, mut next, over]: [(f64, f64); 3],
    mut height: impl FnMut(f64) -> f64,
) -> Option<(f64, f64)> {
    // It falls from the middle, by far.
    if next.1 > middle.1 || vertex([middle, next, over]).is_none_or(|(at, _)| at < -next.0) {
        return None;
    }
    for _ in 0..NEARER {
        let nearer = (0.25 * next.0, height(0.25 * next.0));
        if nearer.1 > middle.1 {
            return Some(top([middle, nearer, next], height));
        }
        if let Some((at, _)) = vertex([middle, nearer, next]).filter(|(at, _)| (0.0..nearer.0).contains(at)) {
            return Some(top([middle, (at, height(at)), nearer], height));
        }
        next = nearer;
    }
    None
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

    #[test]
    fn a_top_beside_the_middle_is_seen() {
        // It rises by `t^4/2` from the middle to `t`, and falls from there.
        for t in [0.3_f64, 0.1, 0.03, 0.01] {
            let p = |x: f64| 1.0 + t.powi(2) * x.powi(2) - 0.5 * x.powi(4) - 0.3 * x.powi(6);
            let at = [0.0, 0.16, 0.31, 0.45, 0.59].map(|x| Station { x, gap: 1.0 - x });
            let values_into = |at: &[Station], out: &mut [f64]| {
                out.iter_mut().zip(at).for_each(|(out, at)| *out = p(at.x));
            };
            let (found, top) = highest(&at, &mut Vec::new(), |most| 0.5 * most, values_into).unwrap();
            let true_top = p((((1.0 + 3.6 * t.powi(2)).sqrt() - 1.0) / 1.8).sqrt());
            assert!((top - true_top).abs() < 1e-7 * t.powi(4) + 1e-15, "{t}: {top} at {}, {true_top}", found.x);
        }
    }

    /// Nearly a quartic, on which parabolas creep.
    #[test]
    fn a_flat_top_is_climbed_from_wherever_its_bracket_is() {
        let t = 0.1183_f64;
        let p = |x: f64| 1.0 + 1.1e-4 * (2.0 * (x / t).powi(2) - (x / t).powi(4)) - 0.2 * x.powi(6);
        let true_top = (0..=4000).map(|i| p(0.11 + 4e-6 * f64::from(i))).fold(0.0, f64::max);
        for i in 0..=20 {
            for k in 0..=20 {
                let (at, right) = (0.03 + 0.006 * f64::from(i), 0.17 + 0.01 * f64::from(k));
                if p(at) <= p(0.0) || p(at) <= p(right) {
                    continue;
                }
                let places = [0.0, at, right].map(|x| Station { x, gap: 1.0 - x });
                let values_into = |at: &[Station], out: &mut [f64]| {
                    out.iter_mut().zip(at).for_each(|(out, at)| *out = p(at.x));
                };
                let (_, top) = highest(&places, &mut Vec::new(), |most| 0.5 * most, values_into).unwrap();
                assert!(true_top - top < 1e-12, "{at} between 0 and {right}: {:e} too low", true_top - top);
            }
        }
    }

    /// It rose from step to step, and will rise again.
    #[test]
    fn a_top_that_was_stepped_over_is_climbed() {
        let wave = |x: f64| 0.02 - (x - 0.4).powi(2) + 2.0 * (x - 0.4).powi(3);
        let mut trail = Trail::default();
        for x in [-0.3, 0.15] {
            trail.pass((x, wave(x)));
        }
        assert!(wave(0.6) > wave(0.15) && wave(0.6) < 0.0);
        let (below, top) = trail.top((0.6, wave(0.6)), wave).expect("a top above zero");
        assert!(wave(below) < 0.0 && wave(top) >= 0.0 && below < top && top < 0.5, "{below}, {top}");
    }
}
