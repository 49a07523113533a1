//! Numbers that cannot be wrong: a value of these types has passed its check, files included.

use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// Sizes that are computed with: products of three such numbers neither overflow nor vanish.
pub const MODERATE: RangeInclusive<f64> = 1e-100..=1e100;

/// A number outside the range its type stands for.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("expected {expected}, found {found}")]
pub struct NotAllowed {
    /// The range, in words.
    pub expected: &'static str,
    /// The offending value as it would be written in a scene.
    pub found: f64,
}

/// A finite number above zero.
///
/// ```
/// use slipzone_api::Positive;
/// assert_eq!(Positive::new(2.0).unwrap().get(), 2.0);
/// assert!(Positive::new(f64::NAN).is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Positive(f64);

/// Poisson's ratio, `-1 < nu <= 1/2`.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Poisson(f64);

/// A finite number of either sign.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Finite(f64);

/// A checked wrapper around `f64`: constructor, accessor and the conversions serde goes through.
macro_rules! checked {
    ($name:ident, $expected:literal, $holds:expr) => {
        impl $name {
            /// Checks the range.
            pub fn new(value: f64) -> Result<Self, NotAllowed> {
                let holds: fn(f64) -> bool = $holds;
                if holds(value) { Ok(Self(value)) } else { Err(NotAllowed { expected: $expected, found: value }) }
            }

            /// The plain number.
            pub const fn get(self) -> f64 {
                self.0
            }
        }

        impl TryFrom<f64> for $name {
            type Error = NotAllowed;
            fn try_from(value: f64) -> Result<Self, NotAllowed> {
                Self::new(value)
            }
        }

        impl From<$name> for f64 {
            fn from(value: $name) -> f64 {
                value.0
            }
        }
    };
}

// Comparisons with NaN are false, so NaN is refused by each.
checked!(Positive, "a finite number above 0", |v| v > 0.0 && v < f64::INFINITY);
checked!(Finite, "a finite number", f64::is_finite);
checked!(Poisson, "a number above -1 and up to 0.5", |v| v > -1.0 && v <= 0.5);

/// A share of a shape's height for people, after words such as "up to " where it is no more than that: "up to 17 % of
/// its height".
pub fn of_height(most: &str, share: f64) -> String {
    if share < 1.0 { format!("{most}{:.0} % of its height", 100.0 * share) } else { "more than its height".into() }
}

/// A number for people, with five digits at most.
pub fn short(value: f64) -> String {
    rounded(value, 5)
}

/// A number with so many significant digits at most, one at least.
pub fn rounded(value: f64, digits: usize) -> String {
    exactly(format!("{value:.*e}", digits.saturating_sub(1)).parse().unwrap_or(value))
}

/// A number with all its digits, as a power of ten where plain decimals would be long.
pub fn exactly(value: f64) -> String {
    let is_plain = value == 0.0 || (1e-4..1e6).contains(&value.abs()) || !value.is_finite();
    if is_plain { value.to_string() } else { format!("{value:e}") }
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // where equality is asserted, it is exact by construction
mod tests {
    use super::*;

    #[test]
    fn ends_of_the_ranges() {
        for bad in [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(Positive::new(bad).is_err(), "{bad} must not pass as positive");
        }
        assert!(Positive::new(f64::MIN_POSITIVE).is_ok());
        assert!(Finite::new(-2.0).is_ok() && Finite::new(f64::NAN).is_err() && Finite::new(f64::INFINITY).is_err());
        for (nu, fine) in [(-1.0, false), (-0.99, true), (0.0, true), (0.5, true), (0.5001, false), (f64::NAN, false)] {
            assert_eq!(Poisson::new(nu).is_ok(), fine, "nu = {nu}");
        }
    }

    #[test]
    fn people_read_five_digits() {
        let cases = [(0.0, "0"), (2.0 / 3.0, "0.66667"), (-1e-5, "-1e-5"), (1.5e7, "1.5e7"), (f64::INFINITY, "inf")];
        for (value, text) in cases {
            assert_eq!(short(value), text);
        }
        assert_eq!([1.0 / 3.0, 1.25e-95].map(exactly), ["0.3333333333333333", "1.25e-95"]);
    }

    #[test]
    fn files_go_through_the_same_check() {
        #[derive(Debug, Deserialize)]
        struct Doc {
            #[allow(dead_code)]
            v: Positive,
        }
        for bad in ["v = 0", "v = -2.0", "v = nan", "v = inf"] {
            assert!(toml::from_str::<Doc>(bad).is_err(), "{bad}");
        }
        assert_eq!(toml::from_str::<Doc>("v = 3").unwrap().v.get(), 3.0, "an integer is a number too");
    }
}
