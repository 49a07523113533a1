//! Kernels on a short reach: one power series each, without interpolation.

use super::beyond::{Beyond, Cut};
use super::column::Column;
use super::singular::{Singular, signed_taylor};
use super::spectrum::Spectrum;
use crate::piece::{Kernel, LARGEST_LOG, Pieces};
use crate::polynomial;
use arrayvec::ArrayVec;
use slipzone_api::elementary::EULER_GAMMA;
use std::f64::consts::FRAC_PI_2;

/// Powers of one parity.
type Powers = ArrayVec<f64, { polynomial::MOST }>;

/// Most powers of `t`.
const MOST_POWERS: usize = 2 * polynomial::MOST;

/// Powers are taken until what is left is below this part of the aim, and dropped again up to another such part.
const SHARE: f64 = 0.03;

/// The powers cancel like `exp(S t)`: their rounding, of order one, may be this part of the aim.
const ROUNDING_SHARE: f64 = 0.2;

/// Rounding of one coefficient over the sizes of what it is summed from.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Whether the series serve: they keep the digits, and jump and logarithm do not outgrow the kernel.
pub(super) fn serve(columns: &[Column], cut: Cut, depth: f64, reach: f64) -> bool {
    let phase = cut.cutoff * reach;
    let serves = |column: &Column| {
        phase.exp() * f64::EPSILON <= ROUNDING_SHARE * column.aim
            && (column.is_moderate(cut.terms, reach) || Singular::is_tame(column, cut.terms, reach))
    };
    reach <= depth && columns.iter().all(serves)
}

/// `k(t) = sum_m (it)^m/m! (F_m + c_(m+1) (i pi/2 - log t))`: its imaginary part for the sine, its real one for the
/// cosine.
///
/// That is [`Spectrum`] and [`Beyond`] in powers of `t` (DLMF 8.19.8): with the wave numbers in units of `S`,
///
/// ```text
/// F_m S^-m = sum_i w_i W_i s_i^m - sum_(k != m+1) c_k/(m - k + 1) + c_(m+1) (1 + 1/2 + ... + 1/m - euler - log S).
/// ```
///
/// Each kernel's bound covers the powers left out, the rounding, and what is dropped to shorten the polynomials.
pub(super) fn pieces(columns: &[Column], spectrum: &Spectrum, beyond: &Beyond, reach: f64) -> (Pieces, Vec<f64>) {
    let kernels = columns.iter().enumerate().map(|(i, column)| kernel(i, column, spectrum, beyond, reach));
    let (kernels, rounding) = kernels.unzip();
    (Pieces { ends: vec![reach], kernels }, rounding)
}

fn kernel(i: usize, column: &Column, spectrum: &Spectrum, beyond: &Beyond, reach: f64) -> (Kernel, f64) {
    let odd = column.component.is_odd();
    let (cutoff, scaled) = (beyond.cutoff, &beyond.scaled[i][..]);
    let enough = SHARE * column.aim;
    // The smooth part: powers of one parity. Those that follow are no larger than the last.
    let first = usize::from(odd);
    let phase = cutoff * reach;
    let mut power = if odd { phase } else { 1.0 };
    let mut harmonic = first as f64;
    let (mut smooth, mut rounding, mut left) = (Powers::new(), 0.0, f64::INFINITY);
    let logarithm = EULER_GAMMA + cutoff.ln();
    let mut moments = spectrum.moments(i, odd, cutoff);
    for m in (first..MOST_POWERS).step_by(2) {
        let (mut sum, mut size) = moments.next().expect("endless");
        let mut order = m as f64;
        for c in scaled {
            let term = if order == 0.0 { c * (harmonic - logarithm) } else { -c / order };
            sum += term;
            size += term.abs();
            order -= 1.0;
        }
        smooth.push(if m % 4 < 2 { sum } else { -sum } * power);
        rounding += ROUNDING * size * power;
        let (next, after) = ((m + 1) as f64, (m + 2) as f64);
        harmonic += 1.0 / next + 1.0 / after;
        power *= phase * phase / (next * after);
        left = size * power / (1.0 - (phase / after).powi(2)).max(f64::MIN_POSITIVE);
        if left <= enough && after > phase && m > scaled.len() {
            break;
        }
    }
    let (mut rows, mut error) = (Vec::<[f64; 3]>::with_capacity(smooth.len()), left);
    // Jump and logarithm: the even and the odd powers of P, in units of the reach.
    let (mut sign, mut log) = (Powers::new(), Powers::new());
    let (jump, mut unit) = (if odd { FRAC_PI_2 } else { -FRAC_PI_2 }, 1.0);
    for (j, c) in signed_taylor(column, &column.series[..scaled.len()], scaled.len()).enumerate() {
        if odd == j.is_multiple_of(2) {
            sign.push(jump * (c * unit));
        } else {
            log.push(-(c * unit));
        }
        unit *= reach;
    }
    // (t/r) |log t| is below the first, |log t| below the second.
    let logarithm = if odd { 1.0 + reach.ln().abs() } else { LARGEST_LOG };
    for (part, (powers, weight)) in [(&smooth, 1.0), (&sign, 1.0), (&log, logarithm)].into_iter().enumerate() {
        let has_odd_powers = odd != (part == 1);
        let (polynomial, count, dropped) = polynomial::shortened(powers, enough / weight);
        error += weight * dropped;
        rows.resize(rows.len().max(count), [0.0; 3]);
        for (row, c) in rows.iter_mut().zip(&polynomial[..count]) {
            // The table multiplies these by t.
            row[part] = if has_odd_powers { c / reach } else { *c };
        }
    }
    (Kernel { rows: vec![rows], error, noise: 0.0 }, rounding)
}
