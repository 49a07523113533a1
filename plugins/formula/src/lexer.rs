//! From the text of a formula to its words.

use slipzone_api::{Fault, Place};
use std::ops::Range;

/// A word of a formula.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Token<'t> {
    Number(f64),
    Name(&'t str),
    /// One of `+ - * / ^ ( ) ,`.
    Sign(char),
    End,
}

impl Token<'_> {
    /// What a message calls it.
    pub(crate) fn in_words(self, text: &str) -> String {
        match self {
            Token::End => "the end of the formula".into(),
            _ => format!("`{text}`"),
        }
    }
}

/// A fault at a stretch of the text.
pub(crate) fn fault(span: Range<usize>, message: impl Into<String>) -> Fault {
    Fault::new(&[], message).at(Place::Text(span))
}

/// All words with their places, [`Token::End`] last.
pub(crate) fn tokens(text: &str) -> Result<Vec<(Token<'_>, Range<usize>)>, Fault> {
    let mut tokens = Vec::new();
    let mut at = 0;
    while let Some(c) = text[at..].chars().next() {
        let rest = &text[at..];
        let length = match c {
            _ if c.is_whitespace() => {
                at += c.len_utf8();
                continue;
            }
            '0'..='9' | '.' => number_length(rest),
            _ if c.is_alphabetic() || c == '_' => rest.find(|c: char| !belongs_to_name(c)).unwrap_or(rest.len()),
            _ => c.len_utf8(),
        };
        let (word, span) = (&rest[..length], at..at + length);
        let token = match c {
            '0'..='9' | '.' => match word.parse::<f64>() {
                Ok(number) if number.is_finite() => Token::Number(number),
                _ => {
                    return Err(fault(span, "not a number")
                        .found(format!("`{word}`"))
                        .expected("a number such as 0.5"));
                }
            },
            _ if c.is_alphabetic() || c == '_' => Token::Name(word),
            '+' | '-' | '*' | '/' | '^' | '(' | ')' | ',' => Token::Sign(c),
            _ => {
                let fault = fault(span, "a character that means nothing in a formula")
                    .found(format!("`{}`", c.escape_debug()))
                    .expected("a number, a name, one of `+ - * / ^ ( ) ,`");
                return Err(match c {
                    '\u{b2}' => fault.hint("a power is written with `^`, as in x^2"),
                    '\u{b7}' | '\u{d7}' => fault.hint("a product is written with `*`"),
                    '[' | '{' => fault.hint("brackets are round"),
                    '|' => fault.hint("the absolute value is written abs(...)"),
                    '\u{2212}' | '\u{2013}' => fault.hint("minus is the plain `-`"),
                    '=' => fault.hint("only the right-hand side is written"),
                    _ => fault,
                });
            }
        };
        tokens.push((token, span));
        at += length;
    }
    tokens.push((Token::End, text.len()..text.len()));
    Ok(tokens)
}

/// Whether a name may go on with that character; the superscript two may not, though it counts as numeric.
pub(crate) fn belongs_to_name(c: char) -> bool {
    c.is_alphabetic() || c.is_ascii_digit() || c == '_'
}

/// Length of the number that a text begins with: digits, point, digits, exponent.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let mut length = digits(0);
    if bytes.get(length) == Some(&b'.') {
        length += 1;
        length += digits(length);
    }
    if matches!(bytes.get(length), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let exponent = digits((length + 1 + sign).min(bytes.len()));
        if exponent > 0 {
            length += 1 + sign + exponent;
        }
    }
    length
}
