//! Polynomials made as short as they may be.

/// `sum_j powers[j] x^j` on `[0, 1]` in powers of `v = 2 x - 1`, its last Chebyshev terms dropped as long as they sum up
/// to no more than `allowed`. Also returns what they sum up to.
pub(super) fn shortened(powers: &[f64], allowed: f64) -> (Vec<f64>, f64) {
    let mut series = chebyshev(powers);
    let mut dropped = 0.0;
    while let Some(c) = series.last() {
        if dropped + c.abs() > allowed {
            break;
        }
        dropped += c.abs();
        series.pop();
    }
    (monomials(&series), dropped)
}

/// The same in `T_k(v)`: Horner's scheme, with `x T_k = T_k/2 + (T_(k+1) + T_|k-1|)/4`.
fn chebyshev(powers: &[f64]) -> Vec<f64> {
    let mut series = vec![0.0; powers.len()];
    for (length, power) in powers.iter().rev().enumerate() {
        let mut before = series.first().map_or(0.0, |c| *c);
        for k in 0..=length.min(series.len() - 1) {
            let after = series.get(k + 1).map_or(0.0, |c| *c);
            let here = series[k];
            // T_0 comes from T_1 alone, T_1 from T_0 as a whole.
            let below = match k {
                0 => 0.0,
                1 => 2.0 * before,
                _ => before,
            };
            series[k] = 0.5 * here + 0.25 * (below + after);
            before = here;
        }
        series[0] += power;
    }
    series
}

/// `sum_k series[k] T_k(v)` in powers of `v`, by Clenshaw's scheme.
fn monomials(series: &[f64]) -> Vec<f64> {
    let n = series.len();
    let (mut older, mut newer) = (vec![0.0; n], vec![0.0; n]);
    for (k, c) in series.iter().enumerate().rev() {
        // b_k = c_k + 2 v b_(k+1) - b_(k+2), at k = 0 with v in place of 2 v.
        let slope = if k == 0 { 1.0 } else { 2.0 };
        for j in (0..n).rev() {
            let shifted = if j > 0 { slope * newer[j - 1] } else { *c };
            older[j] = shifted - older[j];
        }
        std::mem::swap(&mut older, &mut newer);
    }
    newer
}
