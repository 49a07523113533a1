//! Where a formula is not smooth: there, something of which an absolute value, a root, a logarithm or an inverse is
//! taken is zero.

use crate::dual::Dual;
use crate::tape::{Function, Step, Tape};
use std::ops::Range;

/// Steps by which the samples are equally spaced up to four scales, and those per factor of ten beyond and below.
const STEPS: i32 = 1024;
const PER_DECADE: i32 = 40;

/// Samples beside a narrow place, in widths from it.
const BESIDE: [f64; 9] = [-4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0];

/// What counts as zero, beside the size nearby.
const ZERO: f64 = 1e-12;

/// Values that differ by so much, beside both, are not equal by rounding.
const APART: f64 = 1e-9;

/// How near to the middle that is there, over the scale: farther out an exponential is out of all proportion.
const NEARBY: f64 = 1e-2;

/// A quantity whose zeros are singular points of the formula.
struct Suspect {
    /// The step that it is taken for.
    end: usize,
    first: Range<usize>,
    /// Taken away from it.
    second: Option<Range<usize>>,
    /// And this too.
    shift: f64,
    /// Its cosine in place of itself, for the poles of a tangent.
    cosine: bool,
}

impl Suspect {
    fn at(&self, tape: &Tape, x: f64) -> Dual {
        let first = tape.part(self.first.clone(), x);
        let second = self.second.as_ref().map_or(Dual::default(), |second| tape.part(second.clone(), x));
        let value = first - second - Dual::constant(self.shift);
        if self.cosine { value.cos() } else { value }
    }

    /// Whether a `min` or `max` around it takes its other operand there, as `max(0, abs(x) - 1)` does at 0.
    fn is_passed_over(&self, tape: &Tape, x: f64) -> bool {
        let mut around = tape.steps().iter().enumerate().skip(self.end + 1);
        around.any(|(end, step)| {
            let sign = match step {
                Step::Max => 1.0,
                Step::Min => -1.0,
                _ => return false,
            };
            let (first, second) = tape.operands(end);
            let sign = match self.end {
                place if first.contains(&place) => sign,
                place if second.contains(&place) => -sign,
                _ => return false,
            };
            let [first, second] = [first, second].map(|part| tape.part(part, x).value);
            sign * (second - first) > APART * (first.abs() + second.abs())
        })
    }
}

/// See [`crate::Formula::singular_points`].
pub(crate) fn points(tape: &Tape, scale: f64, most: usize, narrow: &[(f64, f64)]) -> Vec<f64> {
    let suspects = suspects(tape);
    if suspects.is_empty() {
        return Vec::new();
    }
    let mut samples: Vec<f64> = (1..=STEPS).map(|i| f64::from(i) * (4.0 / f64::from(STEPS)) * scale).collect();
    samples
        .extend((-9 * PER_DECADE..=3 * PER_DECADE).map(|i| 10_f64.powf(f64::from(i) / f64::from(PER_DECADE)) * scale));
    // Where something is narrow its zeros are close together.
    let beside = |(x, width): &(f64, f64)| BESIDE.map(|share| x + share * width);
    samples.extend(narrow.iter().flat_map(beside).filter(|x| *x > 0.0 && x.is_finite()));
    let mut points: Vec<f64> = Vec::new();
    let mut zeros: Vec<f64> = Vec::new();
    for suspect in &suspects {
        samples.sort_unstable_by(f64::total_cmp);
        samples.dedup();
        let found = zeros_of(tape, suspect, scale, &samples);
        points.extend(found.iter().filter(|x| !suspect.is_passed_over(tape, **x)));
        zeros.extend(found);
        zeros.sort_unstable_by(f64::total_cmp);
        // What is taken of it comes later, and is as narrow. No more of them than are told, or a few waves too short
        // for the samples would make samples without end.
        let between = zeros.windows(2).take(most).flat_map(|pair| [pair[0], 0.5 * (pair[0] + pair[1]), pair[1]]);
        samples.extend(between.filter(|x| *x > 0.0));
    }
    points.sort_unstable_by(f64::total_cmp);
    // The same place found in two ways differs by rounding.
    points.dedup_by(|next, before| *next - *before <= 1e-14 * *next);
    points.truncate(most);
    points
}

/// The quantities to watch.
fn suspects(tape: &Tape) -> Vec<Suspect> {
    let mut suspects = Vec::new();
    for (end, step) in tape.steps().iter().enumerate() {
        let mut watch = |first: Range<usize>, second: Option<Range<usize>>, shift: f64, cosine: bool| {
            let varies = |part: &Range<usize>| tape.steps()[part.clone()].contains(&Step::Variable);
            if varies(&first) || second.as_ref().is_some_and(varies) {
                suspects.push(Suspect { end, first, second, shift, cosine });
            }
        };
        match step {
            Step::Divide => watch(tape.operands(end).1, None, 0.0, false),
            Step::Min | Step::Max => {
                let (first, second) = tape.operands(end);
                watch(first, Some(second), 0.0, false);
            }
            Step::Power => {
                let is_whole = matches!(tape.steps()[end - 1], Step::Number(n) if n >= 0.0 && n.fract() == 0.0);
                if !is_whole {
                    watch(tape.operands(end).0, None, 0.0, false);
                }
            }
            Step::Of(function) => match function {
                Function::Abs | Function::Sqrt | Function::Cbrt | Function::Ln | Function::Log10 => {
                    watch(tape.operand(end), None, 0.0, false);
                }
                Function::Asin | Function::Acos | Function::Atanh => {
                    watch(tape.operand(end), None, 1.0, false);
                    watch(tape.operand(end), None, -1.0, false);
                }
                Function::Acosh => watch(tape.operand(end), None, 1.0, false),
                Function::Tan => watch(tape.operand(end), None, 0.0, true),
                _ => {}
            },
            _ => {}
        }
    }
    suspects
}

/// Zeros of a quantity among ascending samples: where it changes its sign, or touches zero, or turns around beyond it.
fn zeros_of(tape: &Tape, suspect: &Suspect, scale: f64, samples: &[f64]) -> Vec<f64> {
    let at = |x: f64| suspect.at(tape, x);
    let mut zeros = Vec::new();
    let tip = at(0.0);
    let nearby = at(NEARBY * scale).value.abs();
    // Written so that what is no number counts.
    let is_apart = tip.value.abs() > ZERO * nearby;
    let is_level = tip.value == 0.0 && nearby == 0.0;
    if !(is_apart || is_level) {
        zeros.push(0.0);
    }
    let (mut before, mut then) = (0.0, tip);
    for &x in samples {
        let now = at(x);
        if now.value == 0.0 {
            // On a stretch of zeros there is nothing to find.
            if then.value != 0.0 {
                zeros.push(x);
            }
        } else if then.value * now.value < 0.0 {
            zeros.push(bisect(before, x, |x| at(x).value));
        } else if then.slope * now.slope < 0.0 && then.value * then.slope < 0.0 {
            let turn = bisect(before, x, |x| at(x).slope);
            let there = at(turn).value;
            if there.abs() <= ZERO * then.value.abs().max(now.value.abs()) {
                zeros.push(turn);
            } else if there * then.value < 0.0 {
                zeros.extend([(before, turn), (turn, x)].map(|(from, to)| bisect(from, to, |x| at(x).value)));
            }
        }
        (before, then) = (x, now);
    }
    zeros
}

/// Where a function changes its sign, to the last bit.
pub(crate) fn bisect(mut from: f64, mut to: f64, f: impl Fn(f64) -> f64) -> f64 {
    let is_negative = f(from) < 0.0;
    loop {
        let middle = from + 0.5 * (to - from);
        if middle <= from || middle >= to {
            return if f(from).abs() <= f(to).abs() { from } else { to };
        }
        let value = f(middle);
        if value == 0.0 {
            return middle;
        }
        if (value < 0.0) == is_negative { from = middle } else { to = middle }
    }
}
