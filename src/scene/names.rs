//! Names that were nearly right.

/// The known name that was probably meant, if any is close enough: a letter missing, doubled, wrong or
/// swapped in every three, case and `-` for `_` not counted.
pub fn nearest<'a>(name: &str, known: &[&'a str]) -> Option<&'a str> {
    // Nobody misspells a name at such length, and the distance takes quadratic time.
    if name.len() > 64 || known.contains(&name) {
        return None;
    }
    let plain = |name: &str| name.to_lowercase().replace('-', "_");
    let allowed = 1 + name.chars().count() / 4;
    known
        .iter()
        .map(|candidate| (strsim::damerau_levenshtein(&plain(name), &plain(candidate)), *candidate))
        .filter(|(distance, candidate)| *distance <= allowed && *distance < candidate.len())
        .min()
        .map(|(_, candidate)| candidate)
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn slips_are_recognised_and_strangers_are_not() {
        let known = ["cylinder", "flat", "half_width"];
        for (name, near) in [
            ("cylindre", Some("cylinder")),
            ("Flat", Some("flat")),
            ("halfwidth", Some("half_width")),
            ("half-width", Some("half_width")),
            ("sphere", None),
            ("", None),
            // It was right, in the wrong place.
            ("flat", None),
        ] {
            assert_eq!(nearest(name, &known), near, "{name}");
        }
        assert_eq!(nearest(&"x".repeat(1_000_000), &known), None);
    }
}
