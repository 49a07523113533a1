//! Sums of products, in the vectors that the machine has.

use pulp::{Arch, Simd, WithSimd};

/// Vectors added up side by side: an addition takes as long as it takes to begin so many.
const WIDE: usize = 4;

/// Sum of products over the shorter of two slices.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let count = a.len().min(b.len());
    Arch::new().dispatch(Dot(&a[..count], &b[..count]))
}

/// Sums of the products of a difference `a - b` with each of two others, all of one length.
pub(super) fn dots((a, b): (&[f64], &[f64]), others: [&[f64]; 2]) -> [f64; 2] {
    Arch::new().dispatch(Dots { a, b, others })
}

struct Dots<'a> {
    a: &'a [f64],
    b: &'a [f64],
    others: [&'a [f64]; 2],
}

impl WithSimd for Dots<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [f64; 2] {
        let Self { a, b, others: [c, d] } = self;
        let ((a, a_rest), (b, b_rest)) = (S::as_simd_f64s(a), S::as_simd_f64s(b));
        let ((c, c_rest), (d, d_rest)) = (S::as_simd_f64s(c), S::as_simd_f64s(d));
        let mut sums = [simd.splat_f64s(0.0); 2];
        for (((a, b), c), d) in a.iter().zip(b).zip(c).zip(d) {
            let apart = simd.sub_f64s(*a, *b);
            sums = [simd.mul_add_e_f64s(apart, *c, sums[0]), simd.mul_add_e_f64s(apart, *d, sums[1])];
        }
        let mut sums = sums.map(|sum| simd.reduce_sum_f64s(sum));
        for (((a, b), c), d) in a_rest.iter().zip(b_rest).zip(c_rest).zip(d_rest) {
            sums = [sums[0] + (a - b) * c, sums[1] + (a - b) * d];
        }
        sums
    }
}

/// The sum over slices of one length.
struct Dot<'a>(&'a [f64], &'a [f64]);

impl WithSimd for Dot<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let ((a, a_rest), (b, b_rest)) = (S::as_simd_f64s(self.0), S::as_simd_f64s(self.1));
        let (a, a_single) = a.as_chunks::<WIDE>();
        let (b, b_single) = b.as_chunks::<WIDE>();
        let mut sums = [simd.splat_f64s(0.0); WIDE];
        for (a, b) in a.iter().zip(b) {
            for i in 0..WIDE {
                sums[i] = simd.mul_add_e_f64s(a[i], b[i], sums[i]);
            }
        }
        for i in 0..a_single.len() {
            sums[i] = simd.mul_add_e_f64s(a_single[i], b_single[i], sums[i]);
        }
        let whole = simd.add_f64s(simd.add_f64s(sums[0], sums[1]), simd.add_f64s(sums[2], sums[3]));
        a_rest.iter().zip(b_rest).fold(simd.reduce_sum_f64s(whole), |sum, (a, b)| sum + a * b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pulp::Scalar;

    #[test]
    fn every_product_counts_once() {
        for count in 0..70_usize {
            let a: Vec<f64> = (0..count).map(|i| 1.0 + i as f64).collect();
            let longer: Vec<f64> = (0..count + 3).map(|i| 2.0 - i as f64).collect();
            let exact: f64 = (0..count).map(|i| (1.0 + i as f64) * (2.0 - i as f64)).sum();
            assert!((dot(&a, &longer) - exact).abs() < 1e-9, "whole numbers: {count}");
            assert!((dot(&longer, &a) - exact).abs() < 1e-9, "whole numbers: {count}");
            let one_by_one = Dot(&a, &longer[..count]).with_simd(Scalar::new());
            assert!((one_by_one - exact).abs() < 1e-9, "without vectors: {count}");

            let twice: Vec<f64> = a.iter().map(|a| 2.0 * a).collect();
            let less: f64 = a.iter().map(|a| a * a).sum();
            let (longer, others) = (&longer[..count], [&a[..], &twice]);
            let alone = Dots { a: longer, b: &a, others }.with_simd(Scalar::new());
            for got in [dots((longer, &a), others), alone] {
                assert!((got[0] - exact + less).abs() < 1e-9, "a difference: {count}");
                assert!((got[1] - 2.0 * (exact - less)).abs() < 1e-9, "times another: {count}");
            }
        }
    }
}
