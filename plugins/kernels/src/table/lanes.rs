//! Polynomials of one variable at many distances, side by side in the vectors that the machine has.

use pulp::Simd;

/// Vectors that go through a polynomial together: about as many as multiplications can be begun before the first is
/// through, and few enough for sums and variables to stay in the 16 vectors that a processor has.
const WIDE: usize = 6;

/// All bits but that of the sign. `abs_f64s` makes it anew for each vector, by two calls in builds for tests: a tenth
/// of all they run.
const UNSIGNED: f64 = f64::from_bits(i64::MAX.cast_unsigned());

/// The three polynomials of a kernel on one piece.
#[derive(Clone, Copy)]
pub(super) struct Piece<'a> {
    /// `v = slope x + offset`, with `x = t^2` on the piece at the origin and `|t|` on the others.
    pub(super) slope: f64,
    pub(super) offset: f64,
    pub(super) at_origin: bool,
    /// Coefficients of the parts in powers of `v`, highest first; none where a part is zero.
    pub(super) coefficients: [&'a [f64]; 3],
    /// Which parts are odd: `t` times their polynomial at the origin, `sign(t)` times it elsewhere.
    pub(super) odd: [bool; 3],
}

/// How many distances lie within a range before the first that does not: its lower end belongs to what is outside.
#[inline(always)]
pub(super) fn within<S: Simd>(simd: S, t: &[f64], (lower, upper): (f64, f64)) -> usize {
    let (vectors, rest) = S::as_simd_f64s(t);
    let (low, high, unsigned) = (simd.splat_f64s(lower), simd.splat_f64s(upper), simd.splat_f64s(UNSIGNED));
    for (i, t) in vectors.iter().enumerate() {
        let size = simd.and_f64s(*t, unsigned);
        let outside = simd.or_m64s(simd.less_than_or_equal_f64s(size, low), simd.less_than_f64s(high, size));
        let first = simd.first_true_m64s(outside);
        if first < S::F64_LANES {
            return i * S::F64_LANES + first;
        }
    }
    let outside = |t: &f64| t.abs() <= lower || t.abs() > upper;
    vectors.len() * S::F64_LANES + rest.iter().position(outside).unwrap_or(rest.len())
}

/// Writes the parts at all distances, which are within the piece.
#[inline(always)]
pub(super) fn parts_into<S: Simd>(simd: S, piece: Piece, t: &[f64], out: [&mut [f64]; 3]) {
    let (t, t_rest) = S::as_simd_f64s(t);
    let [a, b, c] = out;
    let ((a, a_rest), (b, b_rest), (c, c_rest)) =
        (S::as_mut_simd_f64s(a), S::as_mut_simd_f64s(b), S::as_mut_simd_f64s(c));
    let (wide, single) = t.as_chunks::<WIDE>();
    let (a, a_single) = a.as_chunks_mut::<WIDE>();
    let (b, b_single) = b.as_chunks_mut::<WIDE>();
    let (c, c_single) = c.as_chunks_mut::<WIDE>();
    for (((t, a), b), c) in wide.iter().zip(a).zip(b).zip(c) {
        block(simd, &piece, t, [a, b, c]);
    }
    let (twos, ones) = single.as_chunks::<2>();
    let (a, a_one) = a_single.as_chunks_mut::<2>();
    let (b, b_one) = b_single.as_chunks_mut::<2>();
    let (c, c_one) = c_single.as_chunks_mut::<2>();
    for (((t, a), b), c) in twos.iter().zip(a).zip(b).zip(c) {
        block(simd, &piece, t, [a, b, c]);
    }
    // At most one vector, and what fills none.
    if !ones.is_empty() || !t_rest.is_empty() {
        let t = [ones.first().copied().unwrap_or_else(|| simd.splat_f64s(0.0)), simd.partial_load_f64s(t_rest)];
        let (mut x, mut y, mut z) = (t, t, t);
        block(simd, &piece, &t, [&mut x, &mut y, &mut z]);
        for (one, rest, sums) in [(a_one, a_rest, &x), (b_one, b_rest, &y), (c_one, c_rest, &z)] {
            if let Some(one) = one.first_mut() {
                *one = sums[0];
            }
            simd.partial_store_f64s(rest, sums[1]);
        }
    }
}

/// The parts at `N` vectors of distances.
#[inline(always)]
fn block<S: Simd, const N: usize>(simd: S, piece: &Piece, t: &[S::f64s; N], out: [&mut [S::f64s; N]; 3]) {
    let (slope, offset) = (simd.splat_f64s(piece.slope), simd.splat_f64s(piece.offset));
    let (zero, sign_bit, unsigned) = (simd.splat_f64s(0.0), simd.splat_f64s(-0.0), simd.splat_f64s(UNSIGNED));
    let mut v = [zero; N];
    for i in 0..N {
        let x = if piece.at_origin { simd.mul_f64s(t[i], t[i]) } else { simd.and_f64s(t[i], unsigned) };
        v[i] = simd.mul_add_e_f64s(slope, x, offset);
    }
    let [smooth, sign, log] = out;
    for (part, out) in [smooth, sign, log].into_iter().enumerate() {
        let Some((highest, lower)) = piece.coefficients[part].split_first() else {
            *out = [zero; N];
            continue;
        };
        let mut sums = [simd.splat_f64s(*highest); N];
        for c in lower {
            let c = simd.splat_f64s(*c);
            for i in 0..N {
                sums[i] = simd.mul_add_e_f64s(sums[i], v[i], c);
            }
        }
        if piece.odd[part] {
            for i in 0..N {
                sums[i] = if piece.at_origin {
                    simd.mul_f64s(sums[i], t[i])
                } else {
                    simd.xor_f64s(sums[i], simd.and_f64s(t[i], sign_bit))
                };
            }
        }
        *out = sums;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pulp::{Arch, Scalar, WithSimd};

    struct Within<'a>(&'a [f64], (f64, f64));

    impl WithSimd for Within<'_> {
        type Output = usize;

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> usize {
            within(simd, self.0, self.1)
        }
    }

    #[test]
    fn a_run_ends_at_the_first_distance_outside() {
        for count in 0..30 {
            for end in 0..=count {
                for outside in [1.0, -0.5, 2.5, -3.0] {
                    let t: Vec<f64> = (0..count).map(|i| if i < end { [2.0, -1.5][i % 2] } else { outside }).collect();
                    let found =
                        [Arch::new().dispatch(Within(&t, (1.0, 2.0))), Within(&t, (1.0, 2.0)).with_simd(Scalar::new())];
                    assert_eq!(found, [end; 2], "{count} distances");
                }
            }
        }
    }

    struct Write<'a>(Piece<'a>, &'a [f64]);

    impl WithSimd for Write<'_> {
        type Output = [Vec<f64>; 3];

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Self::Output {
            let mut out = [const { Vec::new() }; 3];
            let [a, b, c] = &mut out;
            for part in [&mut *a, &mut *b, &mut *c] {
                part.resize(self.1.len(), f64::NAN);
            }
            parts_into(simd, self.0, self.1, [a, b, c]);
            out
        }
    }

    /// Small whole numbers: nothing is rounded, whatever the order and the vectors.
    #[test]
    #[allow(clippy::float_cmp)]
    fn any_number_of_distances_in_vectors_and_without() {
        let coefficients: [&[f64]; 3] = [&[2.0, -1.0, 3.0], &[], &[5.0]];
        for (at_origin, odd) in
            [(true, [true, false, true]), (false, [true, false, true]), (false, [false, true, false])]
        {
            let piece = Piece { slope: 2.0, offset: -1.0, at_origin, coefficients, odd };
            for count in 0..80 {
                let t: Vec<f64> = (0..count).map(|i| f64::from(i % 9) - 4.5).collect();
                let expected = |part: usize, t: f64| {
                    let v = 2.0 * if at_origin { t * t } else { t.abs() } - 1.0;
                    let sum = coefficients[part].iter().fold(0.0, |sum, c| sum * v + c);
                    sum * if !odd[part] {
                        1.0
                    } else if at_origin {
                        t
                    } else {
                        t.signum()
                    }
                };
                for got in [Arch::new().dispatch(Write(piece, &t)), Write(piece, &t).with_simd(Scalar::new())] {
                    for (part, got) in got.iter().enumerate() {
                        let expected: Vec<f64> = t.iter().map(|t| expected(part, *t)).collect();
                        assert_eq!(got, &expected, "part {part} at {count} distances");
                    }
                }
            }
        }
    }
}
