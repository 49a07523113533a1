//! Polynomials made as short as they may be.

/// `sum_j powers[j] x^j` on `[0, 1]` in powers of `v = 2 x - 1`, its last Chebyshev terms dropped as long as they sum up
/// to no more than `allowed`. Also returns what they sum up to.
pub(super) fn shortened(powers: &[f64], allowed: f64) -> (Vec<f64>, f64) {
    let mut dropped = 0.0;
    // The last powers matter as little.
    let short = without_last(powers, 0.5 * allowed, &mut dropped);
    let series = chebyshev(short);
    (monomials(without_last(&series, allowed, &mut dropped)), dropped)
}

/// All but the last `terms`, as many as keep what is `dropped` below `allowed`.
fn without_last<'a>(terms: &'a [f64], allowed: f64, dropped: &mut f64) -> &'a [f64] {
    let mut kept = terms.len();
    while kept > 0 && *dropped + terms[kept - 1].abs() <= allowed {
        kept -= 1;
        *dropped += terms[kept].abs();
    }
    &terms[..kept]
}

/// The same in `T_k(v)`: Horner's scheme, with `x T_k = T_k/2 + (T_(k+1) + T_|k-1|)/4`.
fn chebyshev(powers: &[f64]) -> Vec<f64> {
    let mut series = vec![0.0; powers.len()];
    for (length, power) in powers.iter().rev().enumerate() {
        // T_0 becomes all of T_1, the others half of each neighbour.
        let mut below = 0.0;
        for k in 0..length {
            let (here, above) = (series[k], series[k + 1]);
            series[k] = 0.5 * here + 0.25 * (below + above);
            below = if k == 0 { 2.0 * here } else { here };
        }
        if length < series.len() && length > 0 {
            series[length] = 0.25 * below;
        }
        series[0] += power;
    }
    series
}

/// `sum_k series[k] T_k(v)` in powers of `v`: each `T_k` follows from the two before.
fn monomials(series: &[f64]) -> Vec<f64> {
    let n = series.len();
    let mut sum = vec![0.0; n];
    let (mut older, mut newer) = (vec![0.0; n], vec![0.0; n]);
    for (k, c) in series.iter().enumerate() {
        // `older` becomes T_k; the powers below k of the other parity stay 0.
        match k {
            0 => older[0] = 1.0,
            1 => older[1] = 1.0,
            _ => {
                older[0] = -older[0];
                for j in 1..=k {
                    older[j] = 2.0 * newer[j - 1] - older[j];
                }
            }
        }
        std::mem::swap(&mut older, &mut newer);
        for (sum, t) in sum[..=k].iter_mut().zip(&newer) {
            *sum += c * t;
        }
    }
    sum
}
