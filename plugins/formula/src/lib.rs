//! Formulas that users type into scenes: one variable, named parameters, exact derivatives.
//!
//! ```
//! use slipzone_formula::Formula;
//!
//! let parameters = [("R".to_owned(), 10.0)].into();
//! let formula = Formula::parse("height", "x^2/(2*R)", "x", &parameters).unwrap();
//! assert_eq!((formula.at(4.0).value, formula.at(4.0).slope), (0.8, 0.4));
//!
//! let fault = Formula::parse("height", "x^2/(2*r)", "x", &parameters).unwrap_err();
//! assert_eq!(fault.hint.unwrap(), "did you mean `R`?");
//! ```
//!
//! # Grammar
//! ```text
//! sum      = product { ("+" | "-") product }
//! product  = signed { ("*" | "/") signed }
//! signed   = ("+" | "-") signed | power
//! power    = atom [ "^" signed ]                       so -x^2 is -(x^2), and 2^3^2 is 2^(3^2)
//! atom     = number | name | function "(" sum { "," sum } ")" | "(" sum ")"
//! ```
//! Names are the variable, the parameters, `pi` and `e`; the functions are in [`FUNCTIONS`]. Angles are in radians,
//! `ln` and `log` are natural. A text is at most [`LONGEST`] characters long and nested at most [`DEEPEST`] deep, so
//! that no text takes long or overflows a stack.
//!
//! No library served: those that evaluate fast read `-x^2` as `(-x)^2` or overflow the stack on deep input, and none
//! says where a formula is not smooth, which the solver has to know.

mod dual;
mod lexer;
mod narrow;
mod parser;
mod singular;
mod tape;
#[cfg(test)]
mod tests;

pub use dual::Dual;
pub use parser::{DEEPEST, LONGEST};

use slipzone_api::Fault;
use std::collections::BTreeMap;
use tape::Tape;

/// Every function, with the number of its arguments (at least so many for `min` and `max`).
pub const FUNCTIONS: [(&str, usize); 21] = [
    ("abs", 1),
    ("acos", 1),
    ("acosh", 1),
    ("asin", 1),
    ("asinh", 1),
    ("atan", 1),
    ("atanh", 1),
    ("cbrt", 1),
    ("cos", 1),
    ("cosh", 1),
    ("exp", 1),
    ("ln", 1),
    ("log", 1),
    ("log10", 1),
    ("max", 2),
    ("min", 2),
    ("sin", 1),
    ("sinh", 1),
    ("sqrt", 1),
    ("tan", 1),
    ("tanh", 1),
];

/// A formula, ready to be evaluated at any value of its variable.
#[derive(Clone, Debug)]
pub struct Formula {
    tape: Tape,
}

impl Formula {
    /// Understands the text of a formula, which stands under a key of a plugin's table.
    ///
    /// # Errors
    /// The first thing that is wrong, with its place in the text: not a formula, an unknown name, a division by a
    /// constant zero, a variable that does not occur. Of the `parameters`, under the key of that name: a name that is
    /// taken, a value that is not finite, a parameter that does not occur.
    pub fn parse(key: &str, text: &str, variable: &str, parameters: &BTreeMap<String, f64>) -> Result<Self, Fault> {
        Self::parse_each(&[(key, text)], variable, parameters, &[]).map(|mut formulas| formulas.remove(0))
    }

    /// [`Self::parse`] of formulas, each with its key, that share their parameters: each parameter has to occur in one
    /// of them, and the variable in one of them. Names that are `given` have a value without being parameters, and need
    /// not occur.
    ///
    /// # Errors
    /// Those of [`Self::parse`]; a parameter that has the name of what is given.
    pub fn parse_each(
        texts: &[(&str, &str)],
        variable: &str,
        parameters: &BTreeMap<String, f64>,
        given: &[(&str, f64)],
    ) -> Result<Vec<Self>, Fault> {
        let mut names = parameters.clone();
        for &(name, value) in given {
            if names.insert(name.to_owned(), value).is_some() {
                return Err(Fault::new(&["parameters", name], format!("the name `{name}` is taken"))
                    .found(format!("`{name}` as a parameter"))
                    .expected(format!("no parameter `{name}`: it has its value already")));
            }
        }
        let mut occurs = vec![false; names.len()];
        let mut formulas = Vec::with_capacity(texts.len());
        let under = |key: &str, mut fault: Fault| {
            if fault.path.is_empty() {
                fault.path = vec![key.to_owned()];
            }
            fault
        };
        for &(key, text) in texts {
            let (tape, used) = parser::parse(text, variable, &names).map_err(|fault| under(key, fault))?;
            occurs.iter_mut().zip(used).for_each(|(occurs, used)| *occurs |= used);
            formulas.push(Self { tape });
        }
        if let Some((Self { tape }, &(key, text))) = formulas.iter().zip(texts).next()
            && formulas.iter().all(|formula| !formula.tape.varies())
        {
            return Err(under(key, parser::constant(text, tape, variable)));
        }
        let mut idle = names.keys().zip(occurs).filter(|(name, occurs)| !occurs && parameters.contains_key(*name));
        match idle.next() {
            Some((name, _)) => Err(parser::idle(name, texts)),
            None => Ok(formulas),
        }
    }

    /// Value and derivative; not a number where there is none.
    pub fn at(&self, x: f64) -> Dual {
        self.tape.at(x)
    }

    /// The first `terms` Taylor coefficients about `x`, or as many as there are: the series holds to the right of `x`.
    pub fn series(&self, x: f64, terms: usize) -> Vec<f64> {
        let mut series = self.tape.series(x, terms).into_finite();
        if series.len() < terms {
            // Where a zero is divided by a zero, as in sin(x)/x, terms get lost on the way.
            series = self.tape.series(x, 2 * terms + 8).into_finite();
            series.truncate(terms);
        }
        series
    }

    /// Where the formula may not be analytic on `[0, infinity)`: an absolute value, a root or a logarithm of zero, a
    /// division by zero, the place where `min` or `max` changes sides. Ascending, the first `most` of them.
    ///
    /// What is further out than `1e3 scale` is not looked for, and of places closer together than `scale/256` some may
    /// be missed, unless what is zero there turns around once between them, or they lie in one of the `narrow` places:
    /// as a rule
    /// [`Self::narrow_places`] up to `4 scale`. A place too many does no harm.
    pub fn singular_points(&self, scale: f64, most: usize, narrow: &[(f64, f64)]) -> Vec<f64> {
        singular::points(&self.tape, scale, most, narrow)
    }

    /// Where on `[0, length]` the formula, analytic there, may vary over a short length: the step of a hyperbolic
    /// tangent, the peak of an exponential or of an inverse, the beginning of either at an end, the place where an
    /// exponential outgrows what is added to it. Place and width of each, in no order; the width is no number where
    /// nothing varies. A place too many does no harm; what the arguments of its functions do between a thousand samples
    /// is missed.
    pub fn narrow_places(&self, length: f64) -> Vec<(f64, f64)> {
        narrow::places(&self.tape, length)
    }
}
