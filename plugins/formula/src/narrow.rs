//! Where a formula that is analytic varies over a short length: there, the argument of a function that rises or falls fast passes
//! through zero, or turns around, or begins.

use crate::dual::Dual;
use crate::singular::bisect;
use crate::tape::{Function, Step, Tape};
use std::ops::Range;

/// Samples of each argument: it is no narrower than what is made of it, but far broader as a rule. A straight line wants its ends.
const SAMPLES: i32 = 1024;
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
    found
}

/// Whether a part is a straight line by how it is written: sums, and products and quotients with the variable in one factor only.
fn is_straight(tape: &Tape, range: Range<usize>) -> bool {
    let varies = |part: Range<usize>| tape.steps()[part].contains(&Step::Variable);
    range.into_iter().all(|end| match tape.steps()[end] {
        Step::Number(_) | Step::Variable | Step::Negate | Step::Add | Step::Subtract => true,
        Step::Multiply => {
            let (first, second) = tape.operands(end);
            !(varies(first) && varies(second))
        }
        Step::Divide => !varies(tape.operands(end).1),
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
    let varies = |(range, _): &(Range<usize>, Kind)| tape.steps()[range.clone()].contains(&Step::Variable);
    tape.steps().iter().enumerate().filter_map(of).filter(varies).collect()
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
        // Also on a sample.
        if then.slope != 0.0 && then.slope * now.slope <= 0.0 {
            found.push(wide(bisect(before.0, x, |x| u(x).slope)));
        }
        before = (x, now);
    }
}
