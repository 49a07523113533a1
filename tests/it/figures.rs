//! Figures of the documents against what the program draws.

/// Fails unless both have the same text, with the same numbers up to what rounding may do to a coordinate on another
/// processor.
pub(crate) fn assert_same(name: &str, committed: &str, now: &str) {
    let words = |text: &str| -> Vec<String> {
        text.split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-')).map(Into::into).collect()
    };
    let rest = |text: &str| text.replace(|c: char| c.is_ascii_digit() || c == '.' || c == '-', "");
    assert_eq!(rest(committed), rest(now), "{name}");
    for (old, new) in words(committed).iter().zip(&words(now)) {
        let number = |text: &str| text.parse::<f64>().ok();
        let close = number(old).zip(number(new)).is_some_and(|(old, new)| (old - new).abs() < 0.02);
        assert!(close || old == new, "{name}: {old} is now {new}");
    }
}
