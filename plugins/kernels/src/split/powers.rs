//! Moments of one kernel: its integral against one power of the wave number after another.

use pulp::{Arch, Simd, WithSimd};
use slipzone_api::elementary::LANES;

/// Moments summed at a time: the terms go through the processor once for all of them.
const AT_ONCE: usize = 4;

/// `sum_i w_i x_i^m` and the sum of the terms' sizes, for `m` as given and then each next but one.
pub(super) struct Moments {
    /// The terms of the next moment, then `x_i^2`; as many zeros as fill up whole vectors behind either.
    terms: Vec<f64>,
    /// Those summed and not yet told, the last first.
    waiting: [(f64, f64); AT_ONCE],
    count: usize,
}

impl Moments {
    /// Of so many `(x_i, w_i x_i^m)`.
    pub(super) fn new(count: usize, first: impl Iterator<Item = (f64, f64)>) -> Self {
        let filled = count.next_multiple_of(LANES);
        let mut terms = vec![0.0; 2 * filled];
        let (term, square) = terms.split_at_mut(filled);
        for ((term, square), (x, weighted)) in term.iter_mut().zip(square).zip(first) {
            (*term, *square) = (weighted, x * x);
        }
        Self { terms, waiting: [(0.0, 0.0); AT_ONCE], count: 0 }
    }
}

impl Iterator for Moments {
    type Item = (f64, f64);

    fn next(&mut self) -> Option<(f64, f64)> {
        if self.count == 0 {
            self.waiting = Arch::new().dispatch(Sum(&mut self.terms));
            self.count = AT_ONCE;
        }
        self.count -= 1;
        Some(self.waiting[self.count])
    }
}

/// Sums [`Moments::terms`] and takes them so many powers further.
struct Sum<'a>(&'a mut [f64]);

impl WithSimd for Sum<'_> {
    type Output = [(f64, f64); AT_ONCE];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
        const { assert!(LANES.is_multiple_of(S::F64_LANES), "the terms are filled up to whole vectors") };
        let (terms, squares) = self.0.split_at_mut(self.0.len() / 2);
        let (terms, squares) = (S::as_mut_simd_f64s(terms).0, S::as_simd_f64s(squares).0);
        let mut sums = [[simd.splat_f64s(0.0); 2]; AT_ONCE];
        for (kept, square) in terms.iter_mut().zip(squares) {
            let mut term = *kept;
            for [sum, size] in &mut sums {
                (*sum, *size) = (simd.add_f64s(*sum, term), simd.add_f64s(*size, simd.abs_f64s(term)));
                term = simd.mul_f64s(term, *square);
            }
            *kept = term;
        }
        sums.reverse();
        sums.map(|[sum, size]| (simd.reduce_sum_f64s(sum), simd.reduce_sum_f64s(size)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// More moments than are summed at a time, of as many terms as fill no vectors.
    #[test]
    fn each_power_has_its_sum() {
        let nodes = [(0.25, -1.5), (0.5, 2.0), (1.0, -0.125), (0.75, 1.0), (0.125, 3.0)];
        for odd in [false, true] {
            let first = nodes.iter().map(|(x, w)| (*x, if odd { w * x } else { *w }));
            for (i, (sum, size)) in Moments::new(nodes.len(), first).take(2 * AT_ONCE + 1).enumerate() {
                let power = i32::try_from(2 * i).unwrap() + i32::from(odd);
                let terms = nodes.map(|(x, w): (f64, f64)| w * x.powi(power));
                assert!((sum - terms.iter().sum::<f64>()).abs() < 1e-15 * size, "power {power}");
                assert!((size - terms.iter().map(|term| term.abs()).sum::<f64>()).abs() < 1e-15 * size);
            }
        }
    }
}
