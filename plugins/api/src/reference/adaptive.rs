//! Double-exponential integrals refined until they stand still.

use crate::double_exponential::{Node, nodes};

/// Relative change at which an integral stands still: the rounding of a few hundred terms.
const STILL: f64 = 4e-15;

/// `int f` over an interval of some `length`, of an integrand that may be singular at its ends but not inside.
///
/// The rule's error is about squared by each doubling, so that the last change bounds it with much to spare.
pub(super) fn integral(length: f64, mut f: impl FnMut(&Node) -> f64) -> f64 {
    let mut sum = |n: usize| -> f64 { nodes(length, n).iter().map(|node| node.weight * f(node)).sum() };
    let mut last = sum(20);
    for n in [40, 80, 160, 320] {
        let finer = sum(n);
        if (finer - last).abs() <= STILL * finer.abs() {
            return finer;
        }
        last = finer;
    }
    last
}

/// `int f` over `[lower, upper]`, cut at those `cuts` that lie inside; `f` is told the piece, by its ends, and where
/// in it the node lies. 0 when there is nothing between the ends.
pub(super) fn pieces(lower: f64, upper: f64, cuts: &[f64], mut f: impl FnMut(f64, f64, &Node) -> f64) -> f64 {
    if lower >= upper {
        return 0.0;
    }
    let inside = cuts.iter().copied().filter(|&cut| lower < cut && cut < upper);
    let mut ends: Vec<f64> = [lower].into_iter().chain(inside).chain([upper]).collect();
    ends.sort_by(f64::total_cmp);
    let filled = ends.windows(2).filter(|piece| piece[0] < piece[1]);
    filled.map(|piece| integral(piece[1] - piece[0], |node| f(piece[0], piece[1], node))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kink_costs_nothing_when_it_is_known() {
        // int_0^2 |x - 1/3|^(1/2) dx
        let exact = 2.0 / 3.0 * ((1.0_f64 / 3.0).powf(1.5) + (5.0_f64 / 3.0).powf(1.5));
        let root = |lower: f64, _: f64, node: &Node| (lower + node.from_lower - 1.0 / 3.0).abs().sqrt();
        let known = pieces(0.0, 2.0, &[1.0 / 3.0, 7.0], root);
        // The distance to the cut loses its digits there, where the root is small: 1e-16^1.5.
        assert!((known / exact - 1.0).abs() < 4e-15, "{known}");
        let unknown = pieces(0.0, 2.0, &[], root);
        assert!((unknown / exact - 1.0).abs() > 1e-9, "a cut is worth its while: {unknown}");
    }

    #[test]
    fn nothing_between_the_ends_is_nothing() {
        assert!(pieces(1.0, 1.0, &[], |_, _, _| f64::NAN).abs() < f64::MIN_POSITIVE);
        assert!(pieces(2.0, 1.0, &[1.5], |_, _, _| f64::NAN).abs() < f64::MIN_POSITIVE);
    }
}
