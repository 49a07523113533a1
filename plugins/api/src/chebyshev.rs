//! Chebyshev polynomials in powers of their variable.

/// The first `N`, two at least, of a family that goes on by `P_k = 2 v P_(k-1) - P_(k-2)`, as coefficients of `1, v,
/// v^2, ...`: `P_0 = 1`, and `P_1` is given by its two coefficients.
///
/// From `P_1 = v` these are the `T_k(v)`; from `P_1 = 2 v - 1` the `T_(2k+1)(x)/x` in `v = 2 x^2 - 1`. All are whole
/// numbers, exact as long as they stay below `2^53`: up to 44 of the `T_k`.
pub fn in_powers<const N: usize>(second: [f64; 2]) -> [[f64; N]; N] {
    let mut rows = [[0.0; N]; N];
    rows[0][0] = 1.0;
    (rows[1][0], rows[1][1]) = (second[0], second[1]);
    for k in 2..N {
        for j in 0..=k {
            let raised = if j > 0 { 2.0 * rows[k - 1][j - 1] } else { 0.0 };
            rows[k][j] = raised - rows[k - 2][j];
        }
    }
    rows
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_are_cosines_of_multiples() {
        let (whole, odd) = (in_powers::<12>([0.0, 1.0]), in_powers::<12>([-1.0, 2.0]));
        let sum = |row: &[f64; 12], v: f64| row.iter().rev().fold(0.0, |sum, c| sum * v + c);
        for i in 0..20 {
            let angle = 0.07 * f64::from(i);
            for (k, (whole, odd)) in whole.iter().zip(&odd).enumerate() {
                let multiple = |order: usize| (order as f64 * angle).cos();
                // Coefficients of up to 5e3, which cancel to 1.
                assert!((sum(whole, angle.cos()) - multiple(k)).abs() < 1e-11, "T_{k} at {angle}");
                let v = (2.0 * angle).cos();
                assert!((sum(odd, v) * angle.cos() - multiple(2 * k + 1)).abs() < 1e-11, "T_{} at {angle}", 2 * k + 1);
            }
        }
    }
}
