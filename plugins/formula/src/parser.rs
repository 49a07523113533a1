//! From words to steps, by recursive descent of bounded depth.

use crate::FUNCTIONS;
use crate::lexer::{Token, belongs_to_name, fault, tokens};
use crate::tape::{Function, STACK, Step, Tape};
use slipzone_api::{Fault, clip, nearest};
use std::collections::BTreeMap;
use std::f64::consts::{E, PI};
use std::ops::Range;

/// The longest formula, in characters.
pub const LONGEST: usize = 2000;

/// The deepest nesting of brackets, signs and powers.
pub const DEEPEST: usize = 50;
/// The formula itself is in none of them.
const OUTERMOST: usize = 1;

/// Characters of a name that a message shows, at most.
const SHOWN: usize = 40;

/// Names that stand for a number.
const CONSTANTS: [(&str, f64); 2] = [("pi", PI), ("e", E)];

/// Understands a formula; see [`crate::Formula::parse`]. Tells also which of the parameters occur in it.
pub(crate) fn parse(
    text: &str,
    variable: &str,
    parameters: &BTreeMap<String, f64>,
) -> Result<(Tape, Vec<bool>), Fault> {
    let length = text.chars().count();
    if length > LONGEST {
        let long = Fault::new(&[], "the formula is too long").found(format!("{length} characters"));
        return Err(long.expected(format!("at most {LONGEST}")).hint("a measured or computed shape fits into a table"));
    }
    check(variable, parameters)?;
    let tokens = tokens(text)?;
    let used = vec![false; parameters.len()];
    let mut parser = Parser { text, variable, parameters, tokens, next: 0, depth: 0, used, tape: Tape::default() };
    parser.sum()?;
    if parser.token() != Token::End {
        return Err(parser.unexpected("an operator such as `+`, or the end"));
    }
    let Parser { tape, used, .. } = parser;
    if tape.height() > STACK {
        return Err(fault(0..text.len(), "the formula is nested too deeply"));
    }
    Ok((tape, used))
}

/// A formula that does not vary.
pub(crate) fn constant(text: &str, tape: &Tape, variable: &str) -> Fault {
    fault(0..text.len(), format!("the formula does not contain `{variable}`"))
        .found(format!("a constant, {}", tape.at(0.0).value))
        .expected(format!("a formula in `{variable}`"))
}

/// A parameter that occurs in none of the texts.
pub(crate) fn idle(name: &str, texts: &[(&str, &str)]) -> Fault {
    let found: Vec<_> = texts.iter().map(|(_, text)| format!("`{}`", clip(text, SHOWN))).collect();
    let formula = if texts.len() > 1 { "formulas" } else { "formula" };
    let name_it = if texts.len() > 1 { "name" } else { "names" };
    Fault::new(&["parameters", name], format!("the parameter `{name}` does not occur in the {formula}"))
        .found(found.join(" and "))
        .expected(format!("parameters that the {formula} {name_it}"))
}

/// Parameters must have names of their own and finite values.
fn check(variable: &str, parameters: &BTreeMap<String, f64>) -> Result<(), Fault> {
    for (name, value) in parameters {
        let path = ["parameters", name.as_str()];
        let is_name = name.starts_with(|c: char| c.is_alphabetic() || c == '_') && name.chars().all(belongs_to_name);
        if !is_name {
            let fault =
                Fault::new(&path, "not a name that a formula can use").found(format!("`{}`", clip(name, SHOWN)));
            return Err(fault.expected("letters, digits and `_`, a letter first"));
        }
        let is_function = FUNCTIONS.iter().any(|(function, _)| function == name);
        if is_function || name == variable || CONSTANTS.iter().any(|(constant, _)| constant == name) {
            let fault =
                Fault::new(&path, format!("the name `{name}` is taken")).found(format!("`{name}` as a parameter"));
            return Err(fault.expected(format!("a name other than `{variable}`, `pi`, `e` and those of functions")));
        }
        if !value.is_finite() {
            return Err(Fault::new(&path, format!("the parameter `{name}` is not allowed"))
                .found(format!("`{value}`"))
                .expected("a finite number"));
        }
    }
    Ok(())
}

struct Parser<'t> {
    text: &'t str,
    variable: &'t str,
    parameters: &'t BTreeMap<String, f64>,
    tokens: Vec<(Token<'t>, Range<usize>)>,
    next: usize,
    depth: usize,
    used: Vec<bool>,
    tape: Tape,
}

impl<'t> Parser<'t> {
    fn token(&self) -> Token<'t> {
        self.tokens[self.next].0
    }

    fn span(&self) -> Range<usize> {
        self.tokens[self.next].1.clone()
    }

    /// Goes on; the last word, [`Token::End`], stays.
    fn advance(&mut self) {
        self.next = (self.next + 1).min(self.tokens.len() - 1);
    }

    /// Goes on if the next word is that sign.
    fn eat(&mut self, sign: char) -> bool {
        let is_it = self.token() == Token::Sign(sign);
        if is_it {
            self.advance();
        }
        is_it
    }

    fn unexpected(&self, expected: &str) -> Fault {
        let (token, span) = (self.token(), self.span());
        let before = self.next.checked_sub(1).map(|index| self.tokens[index].0);
        let fault =
            fault(span.clone(), "this is no formula").found(token.in_words(&self.text[span])).expected(expected);
        match (before, token) {
            (Some(Token::Number(_) | Token::Sign(')')), Token::Name(_) | Token::Sign('('))
            | (Some(Token::Name(_)), Token::Number(_) | Token::Name(_)) => {
                fault.hint("a product is written with `*`, as in 2*x")
            }
            (Some(Token::Number(_)), Token::Sign(',')) => fault.hint("decimals are written with a point, as in 0.5"),
            (Some(Token::Sign('*')), Token::Sign('*')) => fault.hint("a power is written with `^`, as in x^2"),
            _ => fault,
        }
    }

    fn sum(&mut self) -> Result<(), Fault> {
        self.depth += 1;
        if self.depth > OUTERMOST + DEEPEST {
            let deep =
                fault(self.span(), "the formula is nested too deeply").found(format!("more than {DEEPEST} levels"));
            return Err(deep.expected(format!("at most {DEEPEST} levels of brackets, signs and powers")));
        }
        self.product()?;
        loop {
            let step = match self.token() {
                Token::Sign('+') => Step::Add,
                Token::Sign('-') => Step::Subtract,
                _ => break,
            };
            self.advance();
            self.product()?;
            self.tape.push(step);
        }
        self.depth -= 1;
        Ok(())
    }

    fn product(&mut self) -> Result<(), Fault> {
        self.signed()?;
        loop {
            let at = self.span();
            if self.eat('*') {
                self.signed()?;
                self.tape.push(Step::Multiply);
            } else if self.eat('/') {
                let divisor = self.span().start;
                self.signed()?;
                if self.tape.steps().last() == Some(&Step::Number(0.0)) {
                    let end = self.tokens[self.next - 1].1.end;
                    return Err(fault(at.start..end, "division by zero")
                        .found(format!("`{}`, which is 0", clip(&self.text[divisor..end], SHOWN)))
                        .expected("a divisor other than 0"));
                }
                self.tape.push(Step::Divide);
            } else {
                return Ok(());
            }
        }
    }

    fn signed(&mut self) -> Result<(), Fault> {
        // Signs in a row are counted, not nested.
        let mut negative = false;
        loop {
            if self.eat('-') {
                negative = !negative;
            } else if !self.eat('+') {
                break;
            }
        }
        self.power()?;
        if negative {
            self.tape.push(Step::Negate);
        }
        Ok(())
    }

    fn power(&mut self) -> Result<(), Fault> {
        self.atom()?;
        if self.eat('^') {
            self.depth += 1;
            if self.depth > OUTERMOST + DEEPEST {
                return Err(
                    fault(self.span(), "the formula is nested too deeply").found(format!("more than {DEEPEST} levels"))
                );
            }
            self.signed()?;
            self.depth -= 1;
            self.tape.push(Step::Power);
        }
        Ok(())
    }

    fn atom(&mut self) -> Result<(), Fault> {
        match self.token() {
            Token::Number(number) => {
                self.advance();
                self.tape.push(Step::Number(number));
            }
            Token::Name(name) => return self.name(name),
            Token::Sign('(') => {
                self.advance();
                self.sum()?;
                self.close("an operator such as `+`, or `)`")?;
            }
            _ => return Err(self.unexpected("a number, a name or `(`")),
        }
        Ok(())
    }

    fn close(&mut self, expected: &str) -> Result<(), Fault> {
        if self.eat(')') { Ok(()) } else { Err(self.unexpected(expected)) }
    }

    fn name(&mut self, name: &'t str) -> Result<(), Fault> {
        let span = self.span();
        let is_called = matches!(self.tokens.get(self.next + 1), Some((Token::Sign('('), _)));
        let function = FUNCTIONS.iter().find(|(function, _)| *function == name);
        match function {
            Some((_, least)) if is_called => {
                self.advance();
                return self.call(name, span, *least);
            }
            Some(_) => {
                self.advance();
                let example = format!("as in {name}(x)");
                return Err(self.unexpected(&format!("`(` after the function `{name}`")).hint(example));
            }
            None => {}
        }
        let step = if name == self.variable {
            Step::Variable
        } else if let Some(index) = self.parameters.keys().position(|parameter| parameter == name) {
            self.used[index] = true;
            Step::Number(self.parameters[name])
        } else if let Some((_, constant)) = CONSTANTS.iter().find(|(constant, _)| *constant == name) {
            Step::Number(*constant)
        } else {
            return Err(self.unknown(name, span, is_called));
        };
        self.advance();
        if is_called {
            return Err(self.unexpected("an operator: this name is not a function"));
        }
        self.tape.push(step);
        Ok(())
    }

    /// The arguments of a function, its name read already.
    fn call(&mut self, name: &str, span: Range<usize>, least: usize) -> Result<(), Fault> {
        self.advance();
        let mut arguments = 0;
        loop {
            self.sum()?;
            arguments += 1;
            match name {
                "min" if arguments > 1 => self.tape.push(Step::Min),
                "max" if arguments > 1 => self.tape.push(Step::Max),
                _ => {}
            }
            if !self.eat(',') {
                break;
            }
        }
        self.close("an operator such as `+`, `,` or `)`")?;
        let many = least > 1;
        if arguments < least || (arguments > least && !many) {
            let expected = if many { "two or more, between commas" } else { "one" };
            return Err(fault(span, format!("`{name}` with the wrong number of arguments"))
                .found(arguments.to_string())
                .expected(expected));
        }
        if let Some(function) = Function::named(name) {
            self.tape.push(Step::Of(function));
        }
        Ok(())
    }

    fn unknown(&self, name: &str, span: Range<usize>, is_called: bool) -> Fault {
        let names: Vec<&str> = if is_called {
            FUNCTIONS.iter().map(|(function, _)| *function).collect()
        } else {
            let parameters = self.parameters.keys().map(String::as_str);
            std::iter::once(self.variable).chain(parameters).chain(CONSTANTS.iter().map(|(name, _)| *name)).collect()
        };
        let what = if is_called { "function" } else { "name" };
        let list: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
        let fault = fault(span, format!("unknown {what} `{}` in the formula", clip(name, SHOWN)))
            .found(format!("`{}`", clip(name, SHOWN)))
            .expected(format!("one of {}", list.join(", ")));
        if is_called && ["sign", "sgn", "signum"].contains(&name) {
            return fault.hint(format!("the sign of {0} is {0}/abs({0})", self.variable));
        }
        match nearest(name, &names) {
            Some(near) => fault.hint(format!("did you mean `{near}`?")),
            None if is_called => fault,
            None => fault.hint(format!("give it a value: parameters = {{ {} = 1.0 }}", clip(name, SHOWN))),
        }
    }
}
