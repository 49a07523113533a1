//! Why a question has no answer, in words.

use super::seen::Point;
use super::{Question, STEPS};
use crate::study::find::{Find, Wanted};
use slipzone_api::{rounded, short};

/// Digits of a number.
const DIGITS: usize = 7;

impl Question<'_> {
    /// What a reason adds where a part of the range could not be told.
    pub(super) fn untold(&self, gaps: &[(f64, String)]) -> String {
        let (Some((first, why)), Some((last, why_last))) = (gaps.first(), gaps.last()) else { return String::new() };
        let field = &self.find.field;
        let steps = f64::from(STEPS);
        let is_one_stretch = (last - first) * steps < gaps.len() as f64 - 0.5;
        let value = |at: f64| short(self.value(at));
        match (*first <= 0.0, *last >= 1.0) {
            (false, true) if is_one_stretch => {
                format!("; from {field} = {} on it could not be found: {why}", value(*first))
            }
            (true, false) if is_one_stretch => {
                format!("; up to {field} = {} it could not be found: {why_last}", value(*last))
            }
            _ => {
                let (count, all) = (gaps.len(), STEPS + 1);
                let first = value(*first);
                format!(
                    "; at {count} of {all} values it could not be found, the first of them {field} = {first}: {why}"
                )
            }
        }
    }

    /// A reason with the value of the field that it is about.
    pub(super) fn placed(&self, at: f64, why: &str) -> String {
        format!("{} = {:?}: {why}", self.find.field, self.value(at))
    }

    /// That the number is the same all over the range.
    pub(super) fn constant(&self) -> String {
        let Find { field, quantity, from, to, .. } = self.find;
        format!("{quantity} does not depend on {field}: from {from:?} to {to:?} it changes by less than its error")
    }

    /// That the number is nowhere as wanted, in words.
    pub(super) fn missed(&self, points: &[Point]) -> String {
        let Find { field, quantity, from, to, .. } = self.find;
        let range = format!("for {field} from {from:?} to {to:?}");
        let ends = |number: fn(&Point) -> f64| {
            let numbers = || points.iter().map(number);
            (numbers().fold(f64::INFINITY, f64::min), numbers().fold(f64::NEG_INFINITY, f64::max))
        };
        match self.find.wanted {
            Wanted::HalfPlaneWithin(share) => {
                let (least, most) = ends(|point| point.excess);
                let side = if most < 0.0 { "never further" } else { "never nearer" };
                let off = if most < 0.0 { share + most } else { share + least };
                format!("{quantity} is {side} than {off:.3e} from that of the half-plane {range}; wanted is {share:?}")
            }
            Wanted::Target(target) => {
                let (least, most) = ends(|point| point.number);
                let (least, most, count) = (rounded(least, DIGITS), rounded(most, DIGITS), points.len());
                format!(
                    "{quantity} stays between {least} and {most} at the {count} values tried {range}; wanted is {target:?}"
                )
            }
            Wanted::Minimum | Wanted::Maximum => unreachable!("no crossing is looked for"),
        }
    }

    /// That it is not within what is wanted up to the end.
    pub(super) fn outside_at_end(&self) -> String {
        let Find { field, quantity, to, .. } = self.find;
        format!(
            "{quantity} is not within what is wanted at the end of the range, {field} = {to:?}, or cannot be found there"
        )
    }

    /// That it is the same, and as wanted, from one place to another.
    pub(super) fn plateau(&self, number: f64, from: f64, to: f64) -> String {
        let Find { field, quantity, .. } = self.find;
        let [from, to] = [from, to].map(|at| short(self.value(at)));
        let instead = if quantity == "stick.ratio" { "; ask for `stick.one_minus_ratio`" } else { "" };
        let number = rounded(number, DIGITS);
        format!("{quantity} is {number} within its error for {field} from {from} to {to}: it tells no value{instead}")
    }

    /// That it is never as wanted though it is less and more, at a value of the field.
    pub(super) fn jump(&self, value: f64) -> String {
        let Find { field, quantity, .. } = self.find;
        format!("{quantity} jumps over what is wanted at {field} = {}", short(value))
    }

    /// The number of which a least or largest value is looked for.
    pub(super) fn number_of(&self, excess: f64) -> f64 {
        if self.find.wanted == Wanted::Maximum { -excess } else { excess }
    }

    /// That it is least or largest beside what cannot be solved, to be followed by why.
    pub(super) fn at_end_of_solved(&self, at: f64, excess: f64) -> String {
        let Find { field, quantity, wanted, .. } = self.find;
        let (extreme, number) = (if *wanted == Wanted::Maximum { "largest" } else { "least" }, self.number_of(excess));
        let value = short(self.value(at));
        format!("{quantity} is {extreme}, {number:.6e}, at {field} = {value}, where what can be solved ends: ")
    }
}
