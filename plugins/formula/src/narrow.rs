//! Where a formula that is analytic varies over a short length: there, the argument of a function that rises or falls
//! fast passes through zero, or turns around, or begins, or an exponential outgrows what stands beside it.

use crate::dual::Dual;
use crate::singular::bisect;
use crate::tape::{Function, Step, Tape};
use std::ops::Range;

/// Samples of each argument: it is no narrower than what is made of it, but far broader as a rule. A straight line
/// wants its ends.
const SAMPLES: i32 = 1024;
/// Samples of how two summands compare: their logarithms run as straight as exponents do, as a rule.
const COMPARISONS: i32 = 128;
/// From this exponent on a power is as steep as an exponential.
const STEEP: f64 = 16.0;
/// Doublings of the least width, up to the whole length.
const DOUBLINGS: i32 = 41;

/// How a function varies with its argument.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    /// By its difference to the place: an exponential.
    Plain,
    /// Beside zero: a hyperbolic tangent.
    Step,
    /// In proportion: an inverse, a root.
    Scaled,
    /// In proportion, and so many times as fast: a power.
    Raised(f64),
}

impl Kind {
    /// The change of an argument of that value that matters.
    fn scale(self, value: f64) -> f64 {
        match self {
            Self::Plain | Self::Step => 1.0,
            Self::Scaled => value.abs(),
            Self::Raised(exponent) => value.abs() / exponent.abs().max(1.0),
        }
    }
}

/// See [`crate::Formula::narrow_places`].
pub(crate) fn places(tape: &Tape, length: f64) -> Vec<(f64, f64)> {
    let mut found = Vec::new();
    for (range, kind) in arguments(tape) {
        let samples = if is_straight(tape, range.clone()) { 1 } else { SAMPLES };
        look(|x| tape.part(range.clone(), x), kind, (length, samples), &mut found);
    }
    for (base, exponent) in powers(tape) {
        let samples = if varies(tape, &base) || !is_straight(tape, exponent.clone()) { SAMPLES } else { 1 };
        let argument = |x: f64| tape.part(exponent.clone(), x) * tape.part(base.clone(), x).ln();
        look(argument, Kind::Plain, (length, samples), &mut found);
    }
    for (steep, rest) in rivals(tape) {
        let rest = |x: f64| rest.as_ref().map_or(Dual::constant(1.0), |rest| tape.part(rest.clone(), x));
        meet(|x| tape.part(steep.clone(), x).abs().ln() - rest(x).abs().ln(), length, &mut found);
    }
    found
}

/// Whether the variable occurs in a part.
fn varies(tape: &Tape, range: &Range<usize>) -> bool {
    tape.steps()[range.clone()].contains(&Step::Variable)
}

/// Whether a part is a straight line by how it is written: sums, and products and quotients with the variable in one
/// factor only.
fn is_straight(tape: &Tape, range: Range<usize>) -> bool {
    range.into_iter().all(|end| match tape.steps()[end] {
        Step::Number(_) | Step::Variable | Step::Negate | Step::Add | Step::Subtract => true,
        Step::Multiply => {
            let (first, second) = tape.operands(end);
            !(varies(tape, &first) && varies(tape, &second))
        }
        Step::Divide => !varies(tape, &tape.operands(end).1),
        Step::Power | Step::Min | Step::Max | Step::Of(_) => false,
    })
}

/// The arguments of functions that may vary fast.
fn arguments(tape: &Tape) -> Vec<(Range<usize>, Kind)> {
    let of = |(end, step): (usize, &Step)| match step {
        Step::Divide => Some((tape.operands(end).1, Kind::Scaled)),
        Step::Power => {
            let (base, exponent) = tape.operands(end);
            // One that varies is as a rule no larger than it is at the surface.
            Some((base, Kind::Raised(tape.part(exponent, 0.0).value)))
        }
        Step::Of(function) => match function {
            Function::Exp | Function::Sinh | Function::Cosh => Some((tape.operand(end), Kind::Plain)),
            Function::Tanh | Function::Atan | Function::Asinh => Some((tape.operand(end), Kind::Step)),
            Function::Sqrt | Function::Cbrt | Function::Ln | Function::Log10 => Some((tape.operand(end), Kind::Scaled)),
            _ => None,
        },
        _ => None,
    };
    tape.steps().iter().enumerate().filter_map(of).filter(|(range, _)| varies(tape, range)).collect()
}

/// Bases and exponents of powers whose exponents vary: exponentials of `exponent ln base`.
fn powers(tape: &Tape) -> Vec<(Range<usize>, Range<usize>)> {
    let all = tape.steps().iter().enumerate().filter(|(_, step)| **step == Step::Power);
    all.map(|(end, _)| tape.operands(end)).filter(|(_, exponent)| varies(tape, exponent)).collect()
}

/// Summands as steep as an exponential, each with what stands beside it, and such arguments of functions that change
/// where these are about one. An exponential that only grows neither turns around nor passes through zero: `1/(1 +
/// exp(z))` is a step nevertheless.
fn rivals(tape: &Tape) -> Vec<(Range<usize>, Option<Range<usize>>)> {
    let of = |(end, step): (usize, &Step)| match step {
        Step::Add | Step::Subtract => {
            let (first, second) = tape.operands(end);
            (is_steep(tape, end - 1) || is_steep(tape, first.end - 1)).then_some((first, Some(second)))
        }
        Step::Power => is_steep(tape, end - 1).then_some((tape.operands(end).1, None)),
        Step::Of(
            Function::Exp | Function::Sinh | Function::Cosh | Function::Tanh | Function::Atan | Function::Asinh,
        ) => is_steep(tape, end - 1).then_some((tape.operand(end), None)),
        _ => None,
    };
    tape.steps().iter().enumerate().filter_map(of).collect()
}

/// Whether what a step gives may grow by factors over a short length: an exponential, a high power, and what is made of
/// them.
fn is_steep(tape: &Tape, end: usize) -> bool {
    let steep = |part: &Range<usize>| is_steep(tape, part.end - 1);
    match tape.steps()[end] {
        Step::Negate | Step::Of(Function::Abs | Function::Sqrt | Function::Cbrt) => steep(&tape.operand(end)),
        Step::Of(Function::Exp | Function::Sinh | Function::Cosh) => varies(tape, &tape.operand(end)),
        Step::Power => {
            let (base, exponent) = tape.operands(end);
            let is_high = tape.part(exponent.clone(), 0.0).value.abs() >= STEEP && varies(tape, &base);
            is_high || varies(tape, &exponent) || steep(&base)
        }
        Step::Add | Step::Subtract | Step::Multiply | Step::Divide | Step::Min | Step::Max => {
            let (first, second) = tape.operands(end);
            steep(&first) || steep(&second)
        }
        Step::Number(_) | Step::Variable | Step::Of(_) => false,
    }
}

/// Adds where the logarithm of a ratio passes through zero, and over which length it grows by one there.
fn meet(ratio: impl Fn(f64) -> Dual, length: f64, found: &mut Vec<(f64, f64)>) {
    let mut before = (0.0, ratio(0.0).value);
    for i in 1..=COMPARISONS {
        let x = length * f64::from(i) / f64::from(COMPARISONS);
        let value = ratio(x).value;
        if (before.1 < 0.0) != (value < 0.0) {
            let place = bisect(before.0, x, |x| ratio(x).value);
            found.push((place, ratio(place).slope.abs().recip()));
        }
        before = (x, value);
    }
}

/// Adds where an argument passes through zero, turns around or begins, and over which length.
fn look(u: impl Fn(f64) -> Dual, kind: Kind, (length, samples): (f64, i32), found: &mut Vec<(f64, f64)>) {
    let steep = |x: f64| {
        let Dual { value, slope } = u(x);
        (x, kind.scale(value) / slope.abs())
    };
    // The least width over which it changes by as much as matters to the function, within a factor of two.
    let wide = |x: f64| {
        let here = u(x).value;
        let changes = |width: &f64| {
            let beside = [x - width, x + width].into_iter().filter(|x| (0.0..=length).contains(x));
            beside.into_iter().any(|x| (u(x).value - here).abs() >= kind.scale(here))
        };
        let mut widths = (0..DOUBLINGS).rev().map(|k| length * 0.5_f64.powi(k));
        (x, widths.find(changes).unwrap_or(f64::INFINITY))
    };
    let is_straight = samples == 1;
    found.extend([0.0, length].map(|end| if is_straight { steep(end) } else { wide(end) }));
    let mut before = (0.0, u(0.0));
    for i in 1..=samples {
        let x = length * f64::from(i) / f64::from(samples);
        let (then, now) = (before.1, u(x));
        if kind == Kind::Step && (then.value < 0.0) != (now.value < 0.0) {
            found.push(steep(bisect(before.0, x, |x| u(x).value)));
        }
        // Also on a sample. (The product of two slopes may be too small for a number.)
        if then.slope != 0.0 && (now.slope == 0.0 || (then.slope < 0.0) != (now.slope < 0.0)) {
            found.push(wide(bisect(before.0, x, |x| u(x).slope)));
        }
        before = (x, now);
    }
}
