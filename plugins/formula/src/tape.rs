//! A formula as a list of steps on a stack: evaluating it needs no recursion.

use crate::dual::Dual;
use slipzone_api::taylor::Taylor;
use std::ops::Range;

/// Room on the stack; the parser refuses what needs more.
pub(crate) const STACK: usize = 64;

/// One step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Step {
    Number(f64),
    Variable,
    Negate,
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Min,
    Max,
    /// A function of one argument.
    Of(Function),
}

/// The functions of one argument.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Function {
    Abs,
    Acos,
    Acosh,
    Asin,
    Asinh,
    Atan,
    Atanh,
    Cbrt,
    Cos,
    Cosh,
    Exp,
    Ln,
    Log10,
    Sin,
    Sinh,
    Sqrt,
    Tan,
    Tanh,
}

/// A function of a value of any kind that has them all as methods.
macro_rules! apply {
    ($function:expr, $value:expr) => {
        match $function {
            Function::Abs => $value.abs(),
            Function::Acos => $value.acos(),
            Function::Acosh => $value.acosh(),
            Function::Asin => $value.asin(),
            Function::Asinh => $value.asinh(),
            Function::Atan => $value.atan(),
            Function::Atanh => $value.atanh(),
            Function::Cbrt => $value.cbrt(),
            Function::Cos => $value.cos(),
            Function::Cosh => $value.cosh(),
            Function::Exp => $value.exp(),
            Function::Ln => $value.ln(),
            Function::Log10 => $value.log10(),
            Function::Sin => $value.sin(),
            Function::Sinh => $value.sinh(),
            Function::Sqrt => $value.sqrt(),
            Function::Tan => $value.tan(),
            Function::Tanh => $value.tanh(),
        }
    };
}

impl Function {
    /// The function of that name, if it has one argument.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "abs" => Self::Abs,
            "acos" => Self::Acos,
            "acosh" => Self::Acosh,
            "asin" => Self::Asin,
            "asinh" => Self::Asinh,
            "atan" => Self::Atan,
            "atanh" => Self::Atanh,
            "cbrt" => Self::Cbrt,
            "cos" => Self::Cos,
            "cosh" => Self::Cosh,
            "exp" => Self::Exp,
            "ln" | "log" => Self::Ln,
            "log10" => Self::Log10,
            "sin" => Self::Sin,
            "sinh" => Self::Sinh,
            "sqrt" => Self::Sqrt,
            "tan" => Self::Tan,
            "tanh" => Self::Tanh,
            _ => return None,
        })
    }

    fn of(self, u: Dual) -> Dual {
        apply!(self, u)
    }

    fn series(self, u: Taylor) -> Taylor {
        apply!(self, u)
    }
}

/// The steps of a formula, operands before what is done with them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tape {
    steps: Vec<Step>,
    /// Where the operands of each step begin: its own place for a number or the variable.
    begins: Vec<usize>,
}

impl Tape {
    /// Appends a step whose operands are there already; of numbers alone, its result.
    pub(crate) fn push(&mut self, step: Step) {
        let end = self.steps.len();
        let begin = match step {
            Step::Number(_) | Step::Variable => end,
            Step::Negate | Step::Of(_) => self.begins[end - 1],
            _ => self.operands(end).0.start,
        };
        // |u|^n with n even is u^n, which is smooth.
        if let (Step::Power, Some(Step::Number(n))) = (step, self.steps.last())
            && *n > 0.0
            && n % 2.0 == 0.0
            && end >= 2
            && self.steps[end - 2] == Step::Of(Function::Abs)
        {
            self.steps.remove(end - 2);
            self.begins.remove(end - 2);
            self.begins[end - 2] = end - 2;
            return self.push(step);
        }
        self.steps.push(step);
        self.begins.push(begin);
        if begin < end && self.steps[begin..end].iter().all(|step| matches!(step, Step::Number(_))) {
            let folded = self.part(begin..end + 1, 0.0).value;
            self.steps.truncate(begin);
            self.begins.truncate(begin);
            self.push(Step::Number(folded));
        }
    }

    /// The steps.
    pub(crate) fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Whether the variable occurs.
    pub(crate) fn varies(&self) -> bool {
        self.steps.contains(&Step::Variable)
    }

    /// The steps of both operands of the step at `end`, or of what would stand there.
    pub(crate) fn operands(&self, end: usize) -> (Range<usize>, Range<usize>) {
        let second = self.begins[end - 1];
        (self.begins[second - 1]..second, second..end)
    }

    /// The steps of the only operand of the step at `end`.
    pub(crate) fn operand(&self, end: usize) -> Range<usize> {
        self.begins[end - 1]..end
    }

    /// Places on the stack that are needed at once.
    pub(crate) fn height(&self) -> usize {
        let (mut height, mut highest) = (0, 0);
        for step in &self.steps {
            match step {
                Step::Number(_) | Step::Variable => height += 1,
                Step::Negate | Step::Of(_) => {}
                _ => height -= 1,
            }
            highest = highest.max(height);
        }
        highest
    }

    /// The whole formula's value.
    pub(crate) fn at(&self, x: f64) -> Dual {
        self.part(0..self.steps.len(), x)
    }

    /// The Taylor series of the whole formula about a value of the variable, to the right.
    pub(crate) fn series(&self, x: f64, terms: usize) -> Taylor {
        let mut stack: Vec<Taylor> = Vec::with_capacity(STACK);
        for step in &self.steps {
            let mut operand = || stack.pop().expect("operands stand before what is done with them");
            let result = match *step {
                Step::Number(number) => Taylor::constant(number, terms),
                Step::Variable => Taylor::line(x, 1.0, terms),
                Step::Negate => -operand(),
                Step::Of(function) => function.series(operand()),
                binary => {
                    let second = operand();
                    let first = operand();
                    match binary {
                        Step::Add => first + second,
                        Step::Subtract => first - second,
                        Step::Multiply => first * second,
                        Step::Divide => first / second,
                        Step::Power => first.pow(second),
                        Step::Min => first.min(second),
                        _ => first.max(second),
                    }
                }
            };
            stack.push(result);
        }
        stack.pop().expect("a formula has a value")
    }

    /// The value of one part.
    pub(crate) fn part(&self, steps: Range<usize>, x: f64) -> Dual {
        let mut stack = [Dual::default(); STACK];
        let mut top = 0; // the next free place
        for step in &self.steps[steps] {
            if let Step::Number(_) | Step::Variable = step {
                top += 1;
            } else if !matches!(step, Step::Negate | Step::Of(_)) {
                top -= 1;
            }
            let second = stack[top.min(STACK - 1)];
            let first = &mut stack[top - 1];
            *first = match *step {
                Step::Number(number) => Dual::constant(number),
                Step::Variable => Dual::variable(x),
                Step::Negate => -*first,
                Step::Add => *first + second,
                Step::Subtract => *first - second,
                Step::Multiply => *first * second,
                Step::Divide => *first / second,
                Step::Power => first.power(second),
                Step::Min => first.min(second),
                Step::Max => first.max(second),
                Step::Of(function) => function.of(*first),
            };
        }
        stack[0]
    }
}
