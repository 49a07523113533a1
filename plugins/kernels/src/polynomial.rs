//! Polynomials made as short as they may be.

use slipzone_api::chebyshev::in_powers;
use std::sync::OnceLock;

/// Most coefficients.
pub(crate) const MOST: usize = 32;

/// `sum_j powers[j] x^j` on `[0, 1]` in powers of `v = 2 x - 1`, shortened by as much as is `allowed` in its value.
///
/// The last powers are dropped first, then the last Chebyshev terms. Also returns the number of coefficients and what
/// the dropped ones sum up to.
#[inline]
pub(crate) fn shortened(powers: &[f64], allowed: f64) -> ([f64; MOST], usize, f64) {
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

/// The same in `T_k(v)`.
fn chebyshev(powers: &[f64]) -> [f64; MOST] {
    sum(powers, &tables().of_powers)
}

/// `sum_k series[k] T_k(v)` in powers of `v`.
fn monomials(series: &[f64]) -> [f64; MOST] {
    sum(series, &tables().of_chebyshev)
}

/// The sum of polynomials, the `k`-th of degree `k`.
#[inline]
pub(crate) fn sum<const N: usize>(factors: &[f64], polynomials: &[[f64; N]; N]) -> [f64; N] {
    let mut sum = [0.0; N];
    for (k, (factor, polynomial)) in factors.iter().zip(polynomials).enumerate() {
        for (sum, c) in sum[..=k].iter_mut().zip(polynomial) {
            *sum += factor * c;
        }
    }
    sum
}

/// One family of polynomials in terms of another.
struct Tables {
    /// `x^k` in `T_0(v), T_1(v), ...`.
    of_powers: [[f64; MOST]; MOST],
    /// `T_k(v)` in powers of `v`.
    of_chebyshev: [[f64; MOST]; MOST],
}

/// Made when first asked for.
fn tables() -> &'static Tables {
    static TABLES: OnceLock<Tables> = OnceLock::new();
    TABLES.get_or_init(|| {
        let mut of_powers = [[0.0; MOST]; MOST];
        of_powers[0][0] = 1.0;
        for k in 1..MOST {
            // x T_j = T_j/2 + (T_(j+1) + T_|j-1|)/4.
            for j in 0..k {
                let c = of_powers[k - 1][j];
                of_powers[k][j] += 0.5 * c;
                of_powers[k][j + 1] += 0.25 * c;
                of_powers[k][j.abs_diff(1)] += 0.25 * c;
            }
        }
        Tables { of_powers, of_chebyshev: in_powers([0.0, 1.0]) }
    })
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
