//! Sums of sinc functions over a grid that is its own mirror image.

use num_complex::Complex64;
use pulp::Simd;
use slipzone_api::elementary::{ROUND, sin_pi};
use std::f64::consts::{FRAC_2_PI, PI};

/// Frequencies at which a spectrum is looked at, from the highest down, as far apart as so many samples tell.
const LOOKED_AT: u32 = 8;

/// Points that are evaluated at a time.
pub(super) const BATCH: usize = 64;

/// Vectors of points that are summed side by side.
const WIDE: usize = 2;

/// `sum_h y_h sinc(t - h)` over all `h = j + offset`, `y_-h = y_h` (or `-y_h` when `odd`).
#[derive(Clone, Copy)]
pub(super) struct Series<'a> {
    /// `(-1)^j y_h` for `j >= 0`; beyond its end all are zero, and so is the sum.
    pub(super) signed: &'a [f64],
    pub(super) odd: bool,
    /// 0 where the samples stand at the nodes, 1/2 where they stand half way between.
    pub(super) offset: f64,
}

impl Series<'_> {
    /// About how far it is off between its samples: by what of its spectrum they do not tell apart from lower
    /// frequencies.
    ///
    /// With the frequency the spectrum falls like `Y exp(-d w)` per radian and step, to `w = pi`, the highest that the
    /// samples tell; there `(-1)^j y_h` sums to half of it. As much as lies beyond, `int_pi^inf`, is taken for
    /// something lower: about `2 Y exp(-pi d)/(pi d)` is lost. It waves as it falls, and may vanish at one frequency by
    /// chance: several tell it.
    pub(super) fn lost_between(&self) -> f64 {
        let Self { signed, odd, offset } = *self;
        let (count, whole) = (signed.len() as f64, signed.iter().map(|y| y.abs()).sum::<f64>());
        // The sample in the middle counts once.
        let middle = if offset == 0.0 { -0.5 * signed[0] } else { 0.0 };
        // Half way between, what is odd is seen where what is even would be.
        let by_sine = odd == (offset == 0.0);
        // `-pi d`, by a frequency so far below the highest.
        let fallen = |below: f64| {
            let turn = below * PI / count;
            let mut wave = if offset == 0.0 { Complex64::ONE } else { Complex64::cis(offset * turn) };
            let turn = Complex64::cis(turn);
            let mut sum = Complex64::new(middle, 0.0);
            for y in signed {
                sum += wave * y;
                wave *= turn;
            }
            let size = if by_sine { sum.im } else { sum.re };
            (size.abs() / whole).ln() * count / (count - below)
        };
        // Of a sine nothing is seen at the highest itself.
        let first = if by_sine { 0.5 } else { 0.0 };
        let looked_at = (0..LOOKED_AT).map(|m| f64::from(m) + first).take_while(|below| *below <= 0.5 * count);
        let fallen = looked_at.map(fallen).fold(f64::NEG_INFINITY, f64::max);
        2.0 * whole * fallen.exp() / (-fallen).max(1.0)
    }

    /// Writes the sums at the first `count` of the points `t >= 0`; what the others hold must be numbers.
    #[inline(always)]
    pub(super) fn sums_into<S: Simd>(&self, simd: S, t: &[f64; BATCH], count: usize, out: &mut [f64; BATCH]) {
        let (points, sums) = (S::as_simd_f64s(t).0, S::as_mut_simd_f64s(out).0);
        let vectors = count.div_ceil(S::F64_LANES);
        let (wide, single) = points[..vectors].as_chunks::<WIDE>();
        let (wide_sums, single_sums) = sums[..vectors].as_chunks_mut::<WIDE>();
        for (t, sum) in wide.iter().zip(wide_sums) {
            self.fractions(simd, t, sum);
        }
        for (t, sum) in single.as_chunks::<1>().0.iter().zip(single_sums.as_chunks_mut::<1>().0) {
            self.fractions(simd, t, sum);
        }
        let last = self.signed.len() as f64 - 1.0 + self.offset;
        for (out, t) in out.iter_mut().zip(t).take(count) {
            // sin(pi (t - h)) = (-1)^j sin(pi (t - h_j)) whichever j, and best the nearest.
            let place = t - self.offset;
            let rounded = place + ROUND;
            let sine = sin_pi(place - (rounded - ROUND));
            let signed = f64::from_bits((FRAC_2_PI * sine * *out).to_bits() ^ (rounded.to_bits() << 63));
            *out = if *t >= last { 0.0 } else { signed };
        }
        for (out, t) in out.iter_mut().zip(t).take(count) {
            // An exact hit has divided by zero.
            if out.is_nan() {
                *out = self.sample_at(*t).unwrap_or(*out);
            }
        }
    }

    /// `(1/2) sum_h signed_h/(t - h)`: pairs of `1/(t - h) +- 1/(t + h)` are `2 t/(t^2 - h^2)` or `2 h/(t^2 - h^2)`.
    #[inline(always)]
    fn fractions<S: Simd, const N: usize>(&self, simd: S, t: &[S::f64s; N], out: &mut [S::f64s; N]) {
        let at_nodes = self.offset == 0.0;
        // Mirrored in the middle, the sign of (-1)^j stays at the nodes and changes half way between.
        let by_place = self.odd == at_nodes;
        // The node in the middle counts once.
        let (middle, others) = if at_nodes { self.signed.split_at(1) } else { self.signed.split_at(0) };
        let first = if at_nodes { 1.0 } else { 0.5 };
        let (zero, one) = (simd.splat_f64s(0.0), simd.splat_f64s(1.0));
        let mut sums = [zero; N];
        let mut h = simd.splat_f64s(first);
        // Two fractions with one division.
        let (pairs, rest) = others.as_chunks::<2>();
        for [y, z] in pairs {
            let g = simd.add_f64s(h, one);
            let (mut y, mut z) = (simd.splat_f64s(*y), simd.splat_f64s(*z));
            if by_place {
                (y, z) = (simd.mul_f64s(y, h), simd.mul_f64s(z, g));
            }
            for i in 0..N {
                let d = simd.mul_f64s(simd.sub_f64s(t[i], h), simd.add_f64s(t[i], h));
                let e = simd.mul_f64s(simd.sub_f64s(t[i], g), simd.add_f64s(t[i], g));
                let both = simd.mul_add_e_f64s(y, e, simd.mul_f64s(z, d));
                sums[i] = simd.add_f64s(sums[i], simd.div_f64s(both, simd.mul_f64s(d, e)));
            }
            h = simd.add_f64s(g, one);
        }
        if let [y] = rest {
            let y = simd.splat_f64s(*y);
            let y = if by_place { simd.mul_f64s(y, h) } else { y };
            for i in 0..N {
                let d = simd.mul_f64s(simd.sub_f64s(t[i], h), simd.add_f64s(t[i], h));
                sums[i] = simd.add_f64s(sums[i], simd.div_f64s(y, d));
            }
        }
        if !by_place {
            let middle = simd.splat_f64s(middle.first().map_or(0.0, |y| 0.5 * y));
            for i in 0..N {
                sums[i] = simd.mul_f64s(sums[i], t[i]);
                if at_nodes {
                    sums[i] = simd.add_f64s(sums[i], simd.div_f64s(middle, t[i]));
                }
            }
        }
        *out = sums;
    }

    /// The sample that stands at `t`, if one does.
    #[expect(clippy::float_cmp, reason = "an exact hit is meant")]
    fn sample_at(&self, t: f64) -> Option<f64> {
        let place = t - self.offset;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // whole; `as` saturates
        let j = place as usize;
        let hit = place == j as f64;
        self.signed.get(j).filter(|_| hit).map(|y| alternating(j) * y)
    }
}

/// `(-1)^j`.
pub(super) fn alternating(j: usize) -> f64 {
    if j.is_multiple_of(2) { 1.0 } else { -1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pulp::{Arch, Scalar, WithSimd};

    struct Sums<'a>(Series<'a>, &'a [f64]);

    impl WithSimd for Sums<'_> {
        type Output = Vec<f64>;

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Vec<f64> {
            let (mut t, mut out) = ([0.0; BATCH], [0.0; BATCH]);
            t[..self.1.len()].copy_from_slice(self.1);
            self.0.sums_into(simd, &t, self.1.len(), &mut out);
            out[..self.1.len()].to_vec()
        }
    }

    /// Gaussians are their own interpolants to `exp(-(pi/2)^2 s^2)` and less: 1e-17 at width `s = 4`.
    #[test]
    fn gaussians_come_back() {
        let even = |t: f64| (-(t / 4.0).powi(2)).exp();
        let odd = |t: f64| t * even(t);
        let t = [0.0, 1e-300, 1e-9, 0.3, 0.5, 1.0, 2.5, 3.0, 3.0 + 1e-12, 4.5, 7.49, 7.5 - 1e-13, 12.9];
        for (g, is_odd) in [(&even as &dyn Fn(f64) -> f64, false), (&odd, true)] {
            for (offset, samples) in [(0.0, 30), (0.0, 31), (0.5, 30), (0.5, 31)] {
                let signed: Vec<f64> = (0..samples).map(|j| alternating(j) * g(j as f64 + offset)).collect();
                let series = Series { signed: &signed, odd: is_odd, offset };
                for count in [1, 3, 8, t.len()] {
                    let wide = Arch::new().dispatch(Sums(series, &t[..count]));
                    let narrow = Sums(series, &t[..count]).with_simd(Scalar::new());
                    for (t, got) in t.iter().zip(&wide).chain(t.iter().zip(&narrow)) {
                        assert!((got - g(*t)).abs() < 5e-15, "{offset}, odd: {is_odd}, t = {t}: {got} for {}", g(*t));
                    }
                }
                let beyond = Arch::new().dispatch(Sums(series, &[31.0, 1e9]));
                assert!(beyond.iter().all(|y| y.abs() < 1e-300), "nothing beyond the grid: {beyond:?}");
            }
        }
    }
}
