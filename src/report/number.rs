//! Numbers as a reader wants them: no digit that the error estimate does not carry.

/// Digits that mean something at a relative error, and one more.
///
/// An estimate of 1e-4 carries four digits; the fifth shows which way the fourth was rounded.
pub(super) fn digits(relative_error: f64) -> usize {
    /// `f64` holds no more: one more would show 0.7 as 0.69999999999999996.
    const MOST: f64 = 16.0;
    let carried = (-relative_error.log10()).floor();
    // A cast from f64 saturates, so that an error of 0 (infinitely many digits) needs the clamp only.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 1..=16")]
    let digits = (carried + 1.0).clamp(1.0, MOST) as usize;
    digits
}

/// `value` with so many significant digits; as a power of ten where plain decimals would be long.
pub(super) fn significant(value: f64, digits: usize) -> String {
    let scientific = format!("{value:.*e}", digits.saturating_sub(1));
    // Read back after rounding: 9.996 to three digits is 1.00e1, not 0.99e1.
    let Some(exponent) = scientific.split_once('e').and_then(|(_, e)| e.parse::<i32>().ok()) else {
        return "not finite".into();
    };
    let decimals = i32::try_from(digits).unwrap_or(i32::MAX) - 1 - exponent;
    match usize::try_from(decimals) {
        Ok(decimals) if exponent >= -4 => format!("{value:.decimals$}"),
        _ => scientific,
    }
}

/// At most `digits` significant digits, none of them a trailing zero: for numbers that the user gave.
pub(super) fn trimmed(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    let (mantissa, exponent) = text.split_once('e').map_or((text.as_str(), None), |(m, e)| (m, Some(e)));
    let mantissa = if mantissa.contains('.') { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
    exponent.map_or_else(|| mantissa.to_owned(), |e| format!("{mantissa}e{e}"))
}

/// A number as it is set in print: `-2.1e-5` as `−2.1×10⁻⁵`.
#[cfg(feature = "plot")]
pub(super) fn typeset(number: &str) -> String {
    let with_minus = |mantissa: &str| mantissa.replace('-', "\u{2212}");
    let Some((mantissa, exponent)) = number.split_once('e') else { return with_minus(number) };
    let raised = |c: char| match c.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    };
    let power = format!("10{}", exponent.chars().map(raised).collect::<String>());
    match mantissa {
        "1" => power,
        "-1" => format!("\u{2212}{power}"),
        _ => format!("{}×{power}", with_minus(mantissa)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_follow_the_estimate() {
        assert_eq!([1e-4, 3e-11, 0.2, 5.0, 0.0, 1e-30].map(digits), [5, 11, 1, 1, 16, 16]);
    }

    #[test]
    fn rounding_keeps_the_number_of_digits() {
        for (value, digits, text) in [
            (9.9996, 4, "10.00"),
            (0.317_742, 5, "0.31774"),
            (123_456.0, 3, "1.23e5"),
            (123_456.0, 6, "123456"),
            (1.6e-5, 2, "1.6e-5"),
            (-0.5, 3, "-0.500"),
            (0.0, 1, "0"),
        ] {
            assert_eq!(significant(value, digits), text);
        }
    }

    #[cfg(feature = "plot")]
    #[test]
    fn print_has_powers_and_minus_signs() {
        let printed = ["2.1e-5", "-2.1e5", "1e7", "-1e7", "-0.5", "0.25"].map(typeset);
        assert_eq!(printed, ["2.1×10⁻⁵", "−2.1×10⁵", "10⁷", "−10⁷", "−0.5", "0.25"]);
    }

    #[test]
    fn no_infinity_reaches_the_reader() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_eq!(significant(value, 5), "not finite");
        }
    }

    #[test]
    fn given_numbers_come_without_padding() {
        assert_eq!([5.0, 0.3, 1e-7, 100.0, 1.0 / 3.0].map(|v| trimmed(v, 4)), ["5", "0.3", "1e-7", "100", "0.3333"]);
        assert_eq!(trimmed(2e10, 4), "2e10");
    }
}
