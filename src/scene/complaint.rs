//! What a decoder complains about, read from its message.
//!
//! Plugins sit behind `typetag`, which keeps of an error nothing but its message; the wordings are
//! those of `serde` (stable for years) and of the checked numbers. Whatever is not recognised is passed
//! on in its own words.

/// A decoder's message, taken apart.
#[derive(Debug, PartialEq)]
pub(super) enum Complaint<'m> {
    UnknownKey { key: &'m str, known: Vec<&'m str> },
    UnknownName { name: &'m str, known: Vec<&'m str> },
    MissingKey(&'m str),
    WrongType { expected: String },
    NotWhole { expected: String },
    OutOfRange { expected: String, found: Option<&'m str> },
    TwoOfOneName(&'m str),
    Other(String),
}

impl<'m> Complaint<'m> {
    pub(super) fn read(message: &'m str) -> Self {
        let message = message.lines().next().unwrap_or_default().trim();
        let names = |rest: &'m str| rest.split('`').skip(1).step_by(2).collect();
        if let Some((key, rest)) = quoted(message, "unknown field `") {
            Self::UnknownKey { key, known: names(rest) }
        } else if let Some((name, rest)) = quoted(message, "unknown variant `") {
            Self::UnknownName { name, known: names(rest) }
        } else if let Some((key, _)) = quoted(message, "missing field `") {
            Self::MissingKey(key)
        } else if message.ends_with("number overflowed") {
            Self::OutOfRange { expected: "a number that a computer can hold (64 bits)".into(), found: None }
        } else if let Some(rest) = message.strip_prefix("invalid type: ") {
            let expected = rest.rsplit_once(", expected ").map_or(rest, |(_, expected)| expected);
            // An integer of more than 64 bits is announced as one type the number cannot take.
            if rest.contains("` as i128") || rest.contains("` as u128") {
                let expected = match in_words(expected).as_str() {
                    "a number" => "a number (an integer this long needs a point, as in 1.0e30)".into(),
                    integer => format!("{integer}, of at most 64 bits"),
                };
                return Self::OutOfRange { expected, found: None };
            }
            match whole(expected) {
                Some(expected) => Self::NotWhole { expected: expected.into() },
                None => Self::WrongType { expected: in_words(expected) },
            }
        } else if let Some(rest) =
            message.strip_prefix("invalid value: ").or_else(|| message.strip_prefix("invalid length "))
        {
            let expected = rest.rsplit_once(", expected ").map_or(rest, |(_, expected)| expected);
            Self::OutOfRange { expected: in_words(expected), found: None }
        } else if let Some((expected, found)) =
            message.strip_prefix("expected ").and_then(|rest| rest.rsplit_once(", found "))
        {
            // The file's own way of writing a number beats the decoder's.
            let found = found.parse::<f64>().is_err().then_some(found);
            Self::OutOfRange { expected: expected.into(), found }
        } else if let Some(name) = message.strip_prefix("non-unique tag of ").and_then(|rest| rest.split('"').nth(1)) {
            Self::TwoOfOneName(name)
        } else {
            Self::Other(message.into())
        }
    }
}

/// The name between a prefix and the next backtick that ends it, and what follows.
fn quoted<'m>(message: &'m str, prefix: &str) -> Option<(&'m str, &'m str)> {
    let rest = message.strip_prefix(prefix)?;
    // A name may itself hold backticks; what ends it is the one before the list, or the last.
    rest.split_once("`, ").or_else(|| rest.rsplit_once('`'))
}

/// A decoder's name of a type of whole numbers, in words that fit a scene file; `None` of others.
fn whole(expected: &str) -> Option<&'static str> {
    match expected {
        "u8" | "u16" | "u32" | "u64" | "usize" => Some("an integer of 0 or more"),
        "i8" | "i16" | "i32" | "i64" | "isize" => Some("an integer"),
        _ => None,
    }
}

/// A decoder's name of a type in words that fit a scene file.
fn in_words(expected: &str) -> String {
    if let Some(words) = whole(expected) {
        return words.into();
    }
    match expected {
        "f64" => "a number".into(),
        "a sequence" => "an array".into(),
        "a map" => "a table".into(),
        "string only" | "a borrowed string" => "a string".into(),
        "a boolean" => "`true` or `false`".into(),
        _ if expected.starts_with("struct ") => "a table".into(),
        _ => expected.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wordings_of_the_decoder_are_known() {
        let key = Complaint::UnknownKey { key: "x", known: vec!["a", "b"] };
        assert_eq!(Complaint::read("unknown field `x`, expected `a` or `b`\nin `punch`"), key);
        let none = Complaint::UnknownKey { key: "x", known: vec![] };
        assert_eq!(Complaint::read("unknown field `x`, there are no fields"), none);
        let odd = Complaint::UnknownKey { key: "a`b", known: vec!["c"] };
        assert_eq!(Complaint::read("unknown field `a`b`, expected `c`"), odd);
        assert_eq!(Complaint::read("missing field `radius`"), Complaint::MissingKey("radius"));
        let kind = Complaint::WrongType { expected: "a number".into() };
        assert_eq!(Complaint::read("invalid type: string \"a, expected b\", expected f64"), kind);
        let whole = Complaint::NotWhole { expected: "an integer of 0 or more".into() };
        assert_eq!(Complaint::read("invalid type: floating point `2.5`, expected u32"), whole);
        let range = Complaint::OutOfRange { expected: "a finite number above 0".into(), found: None };
        assert_eq!(Complaint::read("expected a finite number above 0, found -2"), range);
        let both = Complaint::OutOfRange { expected: "one of `a` and `b`".into(), found: Some("both") };
        assert_eq!(Complaint::read("expected one of `a` and `b`, found both"), both);
        assert_eq!(Complaint::read("something new"), Complaint::Other("something new".into()));
    }
}
