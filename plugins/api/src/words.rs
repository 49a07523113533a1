//! Words in messages: the beginning of a text, and names that were nearly right.

/// The beginning of a text, on one line and of at most so many characters.
pub fn clip(text: &str, most: usize) -> String {
    let short: String = text.chars().take_while(|&c| c != '\n').take(most).collect();
    if short.len() == text.len() { short } else { short + "..." }
}

/// The known name that was probably meant, if any is close enough: a letter missing, doubled, wrong or
/// swapped in every three, case and `-` for `_` not counted.
pub fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    // Nobody misspells a name at such length, and the distance takes quadratic time.
    if name.len() > 64 || known.contains(&name) {
        return None;
    }
    let plain = |name: &str| name.to_lowercase().replace('-', "_");
    // A single letter is a name of its own, but for its case.
    let allowed = match name.chars().count() {
        0 | 1 => 0,
        count => 1 + count / 4,
    };
    known
        .iter()
        .map(|candidate| (strsim::damerau_levenshtein(&plain(name), &plain(candidate)), *candidate))
        .filter(|(distance, candidate)| *distance <= allowed && *distance < candidate.len())
        .min()
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::{clip, nearest};

    #[test]
    fn long_texts_are_cut_between_characters() {
        assert_eq!(
            ["h = \u{b5}m", "h = \u{b5}mm", "h\n"].map(|text| clip(text, 6)),
            ["h = \u{b5}m", "h = \u{b5}m...", "h..."]
        );
    }

    #[test]
    fn slips_are_recognised_and_strangers_are_not() {
        let known = ["cylinder", "flat", "half_width", "pi", "R"];
        for (name, near) in [
            ("cylindre", Some("cylinder")),
            ("Flat", Some("flat")),
            ("halfwidth", Some("half_width")),
            ("half-width", Some("half_width")),
            ("sphere", None),
            ("", None),
            ("p", None),
            ("r", Some("R")),
            // It was right, in the wrong place.
            ("flat", None),
        ] {
            assert_eq!(nearest(name, &known), near, "{name}");
        }
        assert_eq!(nearest(&"x".repeat(1_000_000), &known), None);
    }
}
