//! Legendre series on a stretch of wave numbers, and their transforms.

use crate::spherical_bessel;
use num_complex::Complex64;

/// `P_0(x)`, `P_1(x)`, ...
pub(crate) fn values(x: f64) -> impl Iterator<Item = f64> {
    let (mut before, mut p) = (0.0, 1.0);
    (0..).map(move |l: usize| {
        let here = p;
        let a = (2 * l + 1) as f64 / (l + 1) as f64;
        (before, p) = (p, a * x * p - (a - 1.0) * before);
        here
    })
}

/// What transforms are made of: `2 half` times the coefficients of a series, with the signs of `i^l` put in (real for
/// even `l`, imaginary for odd).
pub(crate) fn waves_of(coefficients: &[f64], half: f64) -> impl Iterator<Item = f64> {
    coefficients.iter().enumerate().map(move |(l, c)| c * if l % 4 < 2 { 2.0 * half } else { -2.0 * half })
}

/// Adds `int W(s) exp(ist) ds` over a stretch around its `middle` for each of some series, an even number of terms
/// each, given by their
/// [waves](waves_of); `scratch` holds as many numbers as the longest.
#[inline]
pub(crate) fn add_transforms<'w>(
    (middle, half): (f64, f64),
    waves: impl Iterator<Item = &'w [f64]>,
    t: f64,
    scratch: &mut [f64],
    out: &mut [Complex64],
) {
    spherical_bessel::sequence(half * t, scratch);
    let wave = Complex64::cis(middle * t);
    for (out, waves) in out.iter_mut().zip(waves) {
        let (mut re, mut im) = (0.0, 0.0);
        for (w, j) in waves.chunks_exact(2).zip(scratch.chunks_exact(2)) {
            re += w[0] * j[0];
            im += w[1] * j[1];
        }
        *out += wave * Complex64::new(re, im);
    }
}
