//! Polynomials made as short as they may be.

/// Most coefficients.
pub(super) const MOST: usize = 32;

/// `sum_j powers[j] x^j` on `[0, 1]` in powers of `v = 2 x - 1`, shortened by as much as is `allowed` in its value.
///
/// The last powers are dropped first, then the last Chebyshev terms. Also returns the number of coefficients and what the
/// dropped ones sum up to.
#[inline]
pub(super) fn shortened(powers: &[f64], allowed: f64) -> ([f64; MOST], usize, f64) {
    let mut dropped = 0.0;
    let short = without_last(powers, 0.5 * allowed, &mut dropped);
    let series = chebyshev(short);
    let series = without_last(&series[..short.len()], allowed, &mut dropped);
    (monomials(series), series.len(), dropped)
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
fn chebyshev(powers: &[f64]) -> [f64; MOST] {
    let mut series = [0.0; MOST];
    for (length, power) in powers.iter().rev().enumerate() {
        // T_0 becomes all of T_1, the others half of each neighbour.
        let mut below = 0.0;
        for k in 0..length {
            let (here, above) = (series[k], series[k + 1]);
            series[k] = 0.5 * here + 0.25 * (below + above);
            below = if k == 0 { 2.0 * here } else { here };
        }
        series[length] = 0.25 * below;
        series[0] += power;
    }
    series
}

/// `sum_k series[k] T_k(v)` in powers of `v`: each `T_k` follows from the two before.
fn monomials(series: &[f64]) -> [f64; MOST] {
    let (mut sum, mut even, mut odd) = ([0.0; MOST], [0.0; MOST], [0.0; MOST]);
    let (mut older, mut newer) = (&mut even, &mut odd);
    for (k, c) in series.iter().enumerate() {
        // `older` becomes T_k.
        if k < 2 {
            older[k] = 1.0;
        } else {
            older[0] = -older[0];
            for j in 1..=k {
                older[j] = 2.0 * newer[j - 1] - older[j];
            }
        }
        std::mem::swap(&mut older, &mut newer);
        for (sum, t) in sum.iter_mut().zip(&newer[..=k]) {
            *sum += c * t;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_stay_but_for_what_is_dropped() {
        // exp(-2 x) and all of it at once.
        let mut power = 1.0;
        let powers: Vec<f64> = (1..=MOST)
            .map(|j| {
                let here = power;
                power *= -2.0 / j as f64;
                here
            })
            .collect();
        let mut longest = MOST;
        for allowed in [0.0, 1e-12, 1e-6, 1e-2, 10.0] {
            let (shorter, count, dropped) = shortened(&powers, allowed);
            assert!(dropped <= allowed && count <= longest, "{allowed:e}: {count} coefficients, {dropped:e}");
            for i in 0..=50 {
                let x = f64::from(i) / 50.0;
                let value = shorter[..count].iter().rev().fold(0.0, |sum, c| sum * (2.0 * x - 1.0) + c);
                let error = (value - (-2.0 * x).exp()).abs();
                assert!(error <= dropped + 1e-14, "{allowed:e}, x = {x}: {error:e}");
            }
            longest = count;
        }
        assert_eq!(longest, 0, "everything may be dropped");
    }
}
