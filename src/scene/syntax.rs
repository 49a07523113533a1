//! Text that is no TOML: what was found, what was expected, and what may have been meant.

use super::error::{SHOWN, SceneError};
use slipzone_api::clip;
use std::ops::Range;

/// A syntax error in the parser's words, cut into message and expectation.
pub(super) fn syntax(name: &str, text: &str, error: &toml::de::Error) -> SceneError {
    let message = error.message().trim();
    let (what, expected) = match message.split_once(", expected ") {
        Some((what, expected)) => (what, Some(expected)),
        None => (message, None),
    };
    // The parser words its limit in two ways, neither of them for people; it takes any word for a broken string or
    // boolean.
    let (what, expected) = match what {
        "" => ("syntax error", expected),
        _ if what.contains("recurs") => ("nested too deeply", Some("at most 80 levels")),
        "duplicate key" => (what, Some("each key and each section once")),
        "string values must be quoted" | "invalid boolean" => {
            ("not a value", Some("a number, a string in quotes, `true`, `false`, an array or a table"))
        }
        _ => (what, expected),
    };
    let is_deep = what == "nested too deeply";
    let deepest = || if is_deep { first_deep_key(text) } else { None };
    let span = error.span().or_else(deepest).unwrap_or(text.len()..text.len());
    let found = match text.get(span.clone()) {
        Some(found) if !found.is_empty() => format!("`{}`", clip(found, SHOWN).escape_debug()),
        _ if span.start >= text.trim_end().len() => "the end of the file".into(),
        _ => match text.get(span.start..).and_then(|rest| rest.chars().next()) {
            Some('\n' | '\r') | None => "the end of the line".into(),
            Some(c) => format!("`{}`", c.escape_debug()),
        },
    };
    let hint = hint(what, text, &span);
    let error = SceneError::at(name, text, span, format!("not valid TOML: {what}"))
        .found(found)
        .expected(expected.unwrap_or("a line of TOML such as `key = value` or `[section]`"));
    match hint {
        Some(hint) => error.hint(hint),
        None => error,
    }
}

/// What to write instead, where the parser stopped over something usual.
fn hint(what: &str, text: &str, span: &Range<usize>) -> Option<String> {
    let (before, after) = text.split_at_checked(span.start)?;
    // From where the value begins, which the parser may have entered.
    let value = || [before.rsplit(['\n', '=']).next().unwrap_or_default().trim_start(), after].concat();
    let is_digit = |c: char| c.is_ascii_digit();
    let after_comma = after.strip_prefix(',');
    let is_decimal_comma = after_comma.is_some_and(|after| before.ends_with(is_digit) && after.starts_with(is_digit));
    let usual = match what {
        _ if is_decimal_comma || ends_in_decimal_comma(before) => "decimals are written with a point, as in 5.0",
        _ if after_comma.is_some_and(|after| after.lines().next().is_none_or(|rest| rest.trim().is_empty())) => {
            "outside of [ ] and { } a line ends without a comma"
        }
        "invalid mantissa" | "invalid fraction" => "a decimal point stands between digits, as in 0.5 and 3.0",
        "missing escaped value" => {
            "in a file's path write / for \\, or put it in single quotes: 'C:\\data\\moduli.csv'"
        }
        _ if what.starts_with("carriage return") => {
            "lines end in CR alone here; save the file with ends of LF, or of CR and LF"
        }
        _ if what.starts_with("cannot extend") => "what belongs to a table that is written in { } stands between them",
        _ if what.contains("inline table") && !after.trim().is_empty() => {
            "is the `}` missing that ends the table before?"
        }
        _ if value().starts_with(['\u{201c}', '\u{201d}', '\u{201e}', '\u{2018}', '\u{2019}']) => {
            "quotes are straight, \" or ', not those of a word processor"
        }
        _ if value().starts_with(['\u{2212}', '\u{2013}']) => "the sign is a hyphen, -, not a longer dash",
        "not a value" => return text.get(span.clone()).and_then(instead),
        _ => return None,
    };
    Some(usual.into())
}

/// Whether a text ends with a value such as `1,5`: in an inline table the 5 is taken for the next key, and what follows
/// it is what is wrong.
fn ends_in_decimal_comma(text: &str) -> bool {
    let is_digit = |c: char| c.is_ascii_digit();
    let text = text.trim_end();
    let Some(whole) = text.trim_end_matches(is_digit).strip_suffix(',') else { return false };
    let before = whole.trim_end_matches(is_digit);
    let begins = before.trim_end_matches(['+', '-']).trim_end();
    text.ends_with(is_digit) && before.len() < whole.len() && begins.ends_with('=')
}

/// The first key of more parts than may be nested: the parser does not say which it is.
fn first_deep_key(text: &str) -> Option<Range<usize>> {
    const MOST: usize = 80;
    let mut start = 0;
    text.split_inclusive('\n').find_map(|line| {
        let at = start + (line.len() - line.trim_start().len());
        start += line.len();
        let key = line.split('=').next().unwrap_or(line).trim();
        let is_deep = !key.starts_with('#') && key.matches('.').count() >= MOST;
        is_deep.then(|| at..at + clip(key, SHOWN).trim_end_matches('.').len())
    })
}

/// What to write for a text that is no value.
fn instead(found: &str) -> Option<String> {
    if let Some(number) = worked_out(found) {
        return Some(format!("a number is written out: {number}"));
    }
    let (first, rest) = found.trim().split_once(' ').unwrap_or((found.trim(), ""));
    let is_word = |text: &str| !text.is_empty() && text.chars().all(|c| c.is_alphanumeric() || "-_/^%.*".contains(c));
    if first.parse::<f64>().is_ok_and(f64::is_finite) {
        return is_word(rest).then(|| format!("the number alone, {first}; units are named in [units]"));
    }
    (is_word(first) && rest.is_empty()).then(|| format!("text stands in quotes: \"{first}\""))
}

/// The number that a percentage, a product or a quotient comes to.
fn worked_out(text: &str) -> Option<f64> {
    let text: String = text.split_whitespace().collect();
    let parts = |sign: char| {
        let (one, other) = text.split_once(sign)?;
        Some((one.parse::<f64>().ok()?, other.parse::<f64>().ok()?))
    };
    let of_percent = || Some(text.strip_suffix('%')?.parse::<f64>().ok()? / 100.0);
    let number = of_percent().or_else(|| parts('/').map(|(a, b)| a / b)).or_else(|| parts('*').map(|(a, b)| a * b));
    number.filter(|number| number.is_finite())
}
