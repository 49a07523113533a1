//! Where and when friction does not bear the shear of a contact as it grew.

use super::Growing;
use crate::engine::friction::checks::{is_too_little, overloaded};
use crate::engine::growing::family::during;
use crate::engine::problem::Problem;
use slipzone_api::rounded;
use std::f64::consts::FRAC_PI_2;

/// Parts of the stick zone at whose ends it is looked at, denser at its own end.
const PARTS: usize = 16;
/// Friction that bears less than so many times the shear may bear too little nearby.
const NEARLY: f64 = 4.0 / 3.0;
/// Contacts looked at, at most: those of tight tolerances are many, and see no more of this than so many do.
const MOST: usize = 40;
/// How often the steps from a weakest place to its neighbours are halved.
const HALVED: usize = 6;

/// A place and a time: a half-width, and `(2/pi) asin(x/a)`.
#[derive(Clone, Copy)]
struct Moment {
    half_width: f64,
    place: f64,
    /// `x/b`.
    at: f64,
    /// `eta p/|q|`.
    bears: f64,
}

impl Moment {
    /// What is wrong there, if anything is, and in contacts of which half-widths it is that of friction bears too
    /// little.
    fn told(&self, problem: &Problem, [narrowest, widest]: [f64; 2]) -> Option<String> {
        /// Half-widths that tell a range, over the wider one.
        const APART: f64 = 1e-3;
        let Self { half_width, at, bears, .. } = *self;
        if !is_too_little(bears) {
            return None;
        }
        let what = overloaded(bears.max(0.0).recip(), at);
        let place = if bears < 0.0 { "" } else { " inside the stick zone" };
        let range = (widest - narrowest > APART * widest).then(|| {
            let [narrowest, widest, worst] = [narrowest, widest, half_width].map(|b| rounded(b * problem.length, 3));
            format!(
                "; friction does not bear the shear at half-widths from {narrowest} to {widest}, least of all at {worst}"
            )
        });
        let what = what + place + &range.unwrap_or_default();
        Some(during(problem, half_width, &what))
    }
}

/// The moments of one contact that are the weakest among their neighbours. Beside the end of the zone friction always
/// bears hardly more than the shear; there it bears just the shear.
fn dips(zone: &[Moment]) -> impl Iterator<Item = Moment> {
    let bears = |i: usize| zone.get(i).map_or(1.0, |moment| moment.bears);
    let is_dip = move |i: usize| bears(i) <= bears(i + 1) && (i == 0 || bears(i) <= bears(i - 1));
    (0..zone.len()).filter(move |i| is_dip(*i)).map(|i| zone[i])
}

/// So many of some, if there are more: the first, the last, and evenly by their place in the row those between.
fn thinned(all: Vec<f64>, most: usize) -> Vec<f64> {
    if all.len() <= most {
        return all;
    }
    (0..most).map(|i| all[i * (all.len() - 1) / (most - 1)]).collect()
}

impl Growing {
    /// What the member fails worst of those looked at, or a contact between them near where friction bears hardly more
    /// than the shear: near the weakest moment of all that are the weakest among their neighbours in the zone, and near
    /// that of the last contact.
    pub(super) fn overload(&mut self, problem: &Problem) -> Option<String> {
        let mut half_widths = self.family.as_ref()?.half_widths_to(self.half_width);
        half_widths.retain(|b| *b > problem.face());
        let half_widths = thinned(half_widths, MOST);
        let mut weakest: [Option<(usize, Moment)>; 2] = [None; 2];
        // The weakest moment of the members that fail, and the narrowest and the widest of these.
        let mut worst: Option<(usize, Moment)> = None;
        let mut range = [f64::INFINITY, 0.0_f64];
        for (k, b) in half_widths.iter().enumerate() {
            let mut zone = Vec::with_capacity(PARTS);
            for i in 1..PARTS {
                zone.push(self.moment(problem, *b, i as f64 / PARTS as f64)?);
            }
            for here in zone.iter().filter(|here| is_too_little(here.bears)) {
                range = [range[0].min(*b), range[1].max(*b)];
                if worst.is_none_or(|(_, worst)| here.bears < worst.bears) {
                    worst = Some((k, *here));
                }
            }
            let of_all = &mut weakest[usize::from(k > 0)];
            for here in dips(&zone) {
                if of_all.is_none_or(|(_, weakest)| here.bears < weakest.bears) {
                    *of_all = Some((k, here));
                }
            }
        }
        let suspects = if worst.is_some() { [worst, None] } else { weakest };
        suspects.into_iter().flatten().filter(|(_, weakest)| weakest.bears < NEARLY).find_map(|(k, weakest)| {
            // From the widest to the narrowest.
            let neighbours = &half_widths[k.saturating_sub(1)..(k + 2).min(half_widths.len())];
            let way = (neighbours.first()? - neighbours.last()?) / neighbours.len() as f64;
            self.weaker(problem, weakest, [0.5 * way, 0.5 / PARTS as f64]).told(problem, range)
        })
    }

    /// The weakest moment near one, by ever smaller steps in half-width and place.
    fn weaker(&mut self, problem: &Problem, mut weakest: Moment, mut steps: [f64; 2]) -> Moment {
        let range = (problem.face(), self.half_width);
        for _ in 0..HALVED {
            let centre = weakest;
            for (in_width, in_place) in [(-1.0, 0.0), (1.0, 0.0), (0.0, -1.0), (0.0, 1.0)] {
                let half_width = (centre.half_width + in_width * steps[0]).clamp(range.0, range.1);
                let place = (centre.place + in_place * steps[1]).clamp(0.5 / PARTS as f64, 1.0 - 0.5 / PARTS as f64);
                if half_width <= range.0 {
                    continue;
                }
                if let Some(here) = self.moment(problem, half_width, place).filter(|here| here.bears < weakest.bears) {
                    weakest = here;
                }
            }
            steps = steps.map(|step| 0.5 * step);
        }
        weakest
    }

    fn moment(&mut self, problem: &Problem, half_width: f64, place: f64) -> Option<Moment> {
        let family = self.family.as_mut()?;
        let (friction, a) = (family.signed_friction().abs(), family.zone(half_width).half_width);
        let lacking_to = family.lacking_to();
        let x = a * (FRAC_PI_2 * place).sin();
        let p = self.stack.as_ref()?.pressure(problem, family, half_width, x);
        let q = lacking_to * p - self.lack(problem, half_width, x);
        Some(Moment { half_width, place, at: x / half_width, bears: friction * p / q.abs() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_many_as_many_as_wanted_are_left_with_both_ends() {
        let all = |count: usize| (0..count).map(|i| i as f64).collect::<Vec<_>>();
        assert_eq!(thinned(all(40), 40), all(40));
        for count in [41, 79, 80, 500] {
            let few = thinned(all(count), 40);
            assert_eq!((few.len(), few[0], few[39]), (40, 0.0, (count - 1) as f64));
            assert!(few.windows(2).all(|pair| pair[0] < pair[1]), "{few:?}");
        }
    }
}
