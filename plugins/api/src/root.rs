//! Roots in which powers that are no whole numbers are polynomials.

use std::ops::RangeInclusive;

/// The least of some roots `r` in which `x^power` is a polynomial: `r power` is whole, or off by less than `within`.
pub fn whole(power: f64, mut roots: RangeInclusive<u32>, within: f64) -> Option<u32> {
    roots.find(|root| {
        let in_root = power * f64::from(*root);
        (in_root - in_root.round()).abs() < within
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_root_is_found_if_there_is_one() {
        assert_eq!(whole(0.2, 3..=6, 1e-9), Some(5));
        assert_eq!(whole(0.5, 3..=6, 1e-9), Some(4));
        assert_eq!(whole(0.35, 6..=12, 1e-9), None);
        assert_eq!(whole(0.333, 1..=6, 1e-2), Some(3));
    }
}
