//! The stick zone of one member of a family, approached from near it.

use super::rubbed::{Member, Members};
use crate::engine::friction::stick_search::{FrictionCurve, Root};
use crate::engine::numerics::root::CERTAIN;

impl Members {
    /// The stick zone of a member to within an error from near it, by systems that `one` solves: for the zone given it
    /// finds the next one along the slope given. What the shear lacks is moved with the last step: it is linear in so
    /// short a one. `None` where the guess was not near.
    pub(super) fn approach<E>(
        &mut self,
        error: f64,
        half_width: f64,
        mut from: Root,
        mut one: impl FnMut(Root) -> Result<Option<(Root, Vec<f64>)>, E>,
    ) -> Result<Option<Member>, E> {
        const SYSTEMS: usize = 6;
        /// A slope that many times another, or less, is no neighbour's: the curve jumps there, or is all rounding.
        const ALIKE: f64 = 4.0;
        let mut known = self.moves_known(half_width);
        let mut before: Option<(f64, f64, Vec<f64>)> = None;
        for _ in 0..SYSTEMS {
            if !FrictionCurve::reaches(from.lambda) {
                return Ok(None);
            }
            let Some((root, mut lack)) = one(from)? else { return Ok(None) };
            let step = root.lambda - from.lambda;
            // Differences of rounding have no slope.
            let measured = before.take().and_then(|(there, first, lacked)| {
                let (moved, share) = (from.lambda - there, 1.0 - step / first);
                let is_alike = (1.0 / ALIKE..ALIKE).contains(&share);
                (moved.abs() > f64::EPSILON.sqrt() && is_alike).then_some((moved, share, first, lacked))
            });
            let Some((moved, share, first, mut lacked)) = measured else {
                // What known moves miss: the part by which they and the slope differ from those here, and the square.
                let missed = if known.is_some() { step * (self.doubt + step.abs()) } else { f64::INFINITY };
                // A step along a slope of which nothing is known says nothing.
                if from.doubt < CERTAIN && (step.abs() < error || missed.abs() < 0.5 * error) {
                    if let Some(known) = &mut known {
                        make_alike(&mut lack, known);
                        lack.iter_mut().zip(known).for_each(|(lack, moves)| *lack += step * *moves);
                    }
                    return Ok(Some(Member { root, lack, stuck: None, moves: known }));
                }
                before = Some((from.lambda, step, lack));
                from = root;
                continue;
            };
            let step = step / share;
            let next = Root { lambda: from.lambda + step, slope: from.slope * share, ..root };
            if (first * step).abs() < error {
                make_alike(&mut lack, &mut lacked);
                let moves: Vec<f64> = lack.iter().zip(&lacked).map(|(here, there)| (here - there) / moved).collect();
                if let Some(known) = &known {
                    self.doubt = doubt(known, &moves, share);
                }
                lack.iter_mut().zip(&moves).for_each(|(lack, moves)| *lack += step * moves);
                return Ok(Some(Member { root: next, lack, stuck: None, moves: Some(moves) }));
            }
            before = Some((from.lambda, step, lack));
            from = next;
        }
        Ok(None)
    }
}

/// Makes two series as long as the longer of them.
fn make_alike(one: &mut Vec<f64>, other: &mut Vec<f64>) {
    let length = one.len().max(other.len());
    one.resize(length, 0.0);
    other.resize(length, 0.0);
}

/// By how much moves that were known before differ from those measured, and the slope, relative.
fn doubt(known: &[f64], measured: &[f64], share: f64) -> f64 {
    let largest = |numbers: &mut dyn Iterator<Item = f64>| numbers.fold(0.0_f64, |most, number| most.max(number.abs()));
    let known = known.iter().copied().chain(std::iter::repeat(0.0));
    let apart = largest(&mut known.zip(measured).map(|(known, measured)| known - measured));
    (apart / largest(&mut measured.iter().copied())).max((share - 1.0).abs())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::convert::Infallible;

    /// A zone approached along the slope given, where the friction rises by 0.14 per unit to what is wanted at 7, and
    /// jumps by so much just before the start.
    fn approached(slope: f64, doubt: f64, jump: f64) -> Option<Member> {
        let excess = |lambda: f64| 0.14 * (lambda - 7.0) + if lambda > 6.98995 { jump } else { 0.0 };
        let start = Root { lambda: 6.99, branch: 1.0, slope, doubt };
        let one = |from: Root| {
            let next = Root { lambda: from.lambda - excess(from.lambda) / from.slope, ..from };
            Ok::<_, Infallible>(Some((next, vec![1.0])))
        };
        let mut found = Members::new(None, true);
        found.approach(1e-7, 1.0, start, one).unwrap()
    }

    #[test]
    fn a_slope_is_not_believed_for_its_steps_alone() {
        let near = approached(0.15, f64::INFINITY, 0.0).expect("a member");
        assert!((near.root.lambda - 7.0).abs() < 1e-7, "{:?}", near.root);
        // A millionth of a step along a slope a million times too steep is none.
        assert!(approached(1.4e5, f64::INFINITY, 0.0).is_none());
        // Where the friction jumps past what is wanted there is nothing to be found, and no slope.
        assert!(approached(0.14, f64::INFINITY, 0.00141).is_none());
    }
}
