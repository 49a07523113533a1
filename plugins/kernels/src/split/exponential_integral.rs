//! The generalised exponential integrals `E_k(-iu)`: what a power of `1/s` leaves beyond a cut.

use num_complex::Complex64;
use slipzone_api::elementary::EULER_GAMMA;
use std::f64::consts::FRAC_PI_2;

/// Up to here `E_1` comes from its power series (terms up to `exp(u)/u`, so two digits are lost at most), beyond from
/// the continued fraction.
const SERIES: f64 = 3.0;

/// Terms of the power series below this are left out.
const SETTLED: f64 = 1e-16;

/// Most terms of it; never reached.
const MOST_TERMS: u32 = 60;

/// Terms of the continued fraction for [`ALL_DIGITS`], found by trying: so many, and this many more over `u`. It gains
/// like `exp(-sqrt(terms))`, so that fewer digits ask for fewer terms by the square.
const FRACTION: (f64, f64) = (9.0, 210.0);

/// Digits beyond which only rounding is left.
pub(super) const ALL_DIGITS: f64 = 16.0;

/// `out[k - 1] = E_k(-iu) = u^(k-1) int_u^inf exp(is) s^-k ds`, in the sense of Abel for `k = 1`; `u > 0`.
///
/// `k E_(k+1) = exp(iu) + iu E_k` is stable upwards from `k = u` and downwards from there, so that is where it starts
/// (DLMF 8.19.12; continued fraction 8.19.17). Absolute error about 1e-15, or as many digits as are asked for.
pub(super) fn sequence(u: f64, digits: f64, out: &mut [Complex64]) {
    let last = out.len();
    if last == 0 {
        return;
    }
    let wave = Complex64::cis(u);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // positive; `as` saturates
    let start = if u <= SERIES { 1 } else { (u.round() as usize).clamp(1, last) };
    out[start - 1] = if u <= SERIES { first_by_series(u) } else { by_continued_fraction(u, start, digits) * wave };
    for k in start..last {
        out[k] = (wave + Complex64::new(-u * out[k - 1].im, u * out[k - 1].re)) / k as f64;
    }
    for k in (1..start).rev() {
        let rest = (out[k] * k as f64 - wave) / u;
        out[k - 1] = Complex64::new(rest.im, -rest.re);
    }
}

/// `E_1(-iu) = -euler - log u + i pi/2 - sum_m (iu)^m/(m m!)`.
fn first_by_series(u: f64) -> Complex64 {
    let (mut re, mut im) = (-EULER_GAMMA - u.ln(), FRAC_PI_2);
    // i^m: 1, i, -1, -i.
    let mut power = 1.0;
    for m in (1..MOST_TERMS).step_by(2) {
        let (odd, even) = (f64::from(m), f64::from(m + 1));
        power *= u / odd;
        im -= power / odd;
        power *= -u / even;
        re -= power / even;
        if power.abs() < SETTLED {
            break;
        }
    }
    Complex64::new(re, im)
}

/// `E_k(-iu) exp(-iu)`, the fraction from its last term on.
fn by_continued_fraction(u: f64, k: usize, digits: f64) -> Complex64 {
    let (k, part) = (k as f64, (digits / ALL_DIGITS).min(1.0).powi(2));
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small positive count
    let terms = (part * (FRACTION.0 + FRACTION.1 / u)).ceil() as u32;
    let mut rest = Complex64::default();
    for i in (1..=terms).rev().map(f64::from) {
        let (re, im) = (k + 2.0 * i + rest.re, rest.im - u);
        let factor = -i * (k - 1.0 + i) / (re * re + im * im);
        rest = Complex64::new(factor * re, -factor * im);
    }
    (rest + Complex64::new(k, -u)).inv()
}

#[cfg(test)]
mod tests {
    use super::*;
    use spec_math::cephes64::sici;

    #[test]
    fn first_is_sine_and_cosine_integral() {
        let mut out = [Complex64::default(); 30];
        for i in 1..200 {
            let u = 0.05 * f64::from(i * i);
            sequence(u, ALL_DIGITS, &mut out);
            // E_1(-iu) = -Ci(u) + i (pi/2 - Si(u)); Si near pi/2 carries the rounding of pi/2.
            let (si, ci) = sici(u);
            let error = (out[0] - Complex64::new(-ci, FRAC_PI_2 - si)).norm();
            assert!(error < 3e-15, "u = {u}: {error:e}");
        }
    }

    #[test]
    fn as_many_digits_as_are_asked_for() {
        let (mut all, mut some) = ([Complex64::default(); 20], [Complex64::default(); 20]);
        for digits in [4.0, 8.0, 12.0, 14.0] {
            for i in 1..400 {
                let u = 0.2 * f64::from(i);
                sequence(u, ALL_DIGITS, &mut all);
                sequence(u, digits, &mut some);
                let error = all.iter().zip(&some).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
                assert!(error < 10.0_f64.powf(-digits), "u = {u}, {digits} digits: {error:e}");
            }
        }
    }

    #[test]
    fn recurrence_and_an_integral_hold_for_each_order() {
        // int_1^inf exp(iux) x^-k dx along x = 1 + iy, where it decays: i exp(iu) int exp(-uy) (1 + iy)^-k dy.
        let rule = bilby::GaussLegendre::new(400).expect("nodes");
        let mut out = [Complex64::default(); 30];
        for u in [0.02, 0.7, 2.9, 3.1, 4.0, 9.5, 17.0, 31.0, 90.0] {
            sequence(u, ALL_DIGITS, &mut out);
            for (k, value) in (1..).zip(&out) {
                // y = z/(1 - z) on (0, 1), z squared towards infinity.
                let integral: Complex64 = rule
                    .rule()
                    .nodes
                    .iter()
                    .zip(&rule.rule().weights)
                    .map(|(x, w)| {
                        let z = 0.5 * (1.0 + x);
                        let y = z / (1.0 - z);
                        let slope = 0.5 / ((1.0 - z) * (1.0 - z));
                        Complex64::new(1.0, y).powi(-k) * (w * slope * (-u * y).exp())
                    })
                    .sum();
                let error = (value - integral * Complex64::i() * Complex64::cis(u)).norm();
                // Upwards from the series the error grows by 3^k/k!, up to 4.5.
                assert!(error < 2e-14, "u = {u}, k = {k}: {error:e}");
            }
        }
    }
}
