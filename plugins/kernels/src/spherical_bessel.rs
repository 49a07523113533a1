//! The spherical Bessel functions `j_l(x)`: transforms of the Legendre polynomials.

/// Orders beyond the last at which the downward recurrence starts where `x` is small beside them, and
/// where it is not; from there its start is forgotten to 1e-16.
const MARGIN: (usize, usize) = (8, 32);

/// `out[l] = j_l(x)`, `x >= 0`; absolute error about 1e-16 times the number of orders.
///
/// Upwards while `l < x` and downwards in the ratios `j_l/j_(l-1) = x/(2l + 1 - x j_(l+1)/j_l)` beyond,
/// each where it is stable (DLMF 10.51.1, 3.6); no ratio has a pole there.
pub(crate) fn sequence(x: f64, out: &mut [f64]) {
    let orders = out.len();
    if orders == 0 {
        return;
    }
    let (sin, cos) = x.sin_cos();
    out[0] = if x == 0.0 { 1.0 } else { sin / x };
    if x >= 1.0 && orders > 1 {
        out[1] = (out[0] - cos) / x;
    }
    // Orders already there.
    let mut known = if x >= 1.0 { orders.min(2) } else { 1 };
    while known < orders && (known as f64) < x {
        out[known] = (2 * known - 1) as f64 / x * out[known - 1] - out[known - 2];
        known += 1;
    }
    if known == orders {
        return;
    }
    let margin = if x < 0.5 * orders as f64 { MARGIN.0 } else { MARGIN.1 };
    let mut ratio = 0.0;
    for l in (orders..orders + margin).rev() {
        ratio = x / ((2 * l + 1) as f64 - x * ratio);
    }
    for l in (known..orders).rev() {
        ratio = x / ((2 * l + 1) as f64 - x * ratio);
        out[l] = ratio;
    }
    for l in known..orders {
        out[l] *= out[l - 1];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn legendre_series_of_a_wave() {
        // exp(ixz) = sum_l (2l + 1) i^l j_l(x) P_l(z), here at z = 1: the real and the imaginary part.
        let mut out = [0.0; 160];
        for x in [0.0, 1e-9, 0.3, 0.999, 1.0, 2.5, std::f64::consts::PI, 7.0, 20.0, 59.0, 61.5, 80.0] {
            sequence(x, &mut out);
            let (mut re, mut im) = (0.0, 0.0);
            for (l, j) in out.iter().enumerate() {
                let term = (2 * l + 1) as f64 * j * if l % 4 < 2 { 1.0 } else { -1.0 };
                *(if l % 2 == 0 { &mut re } else { &mut im }) += term;
            }
            // 160 terms: the rounding of each j_l times 2l + 1. The first left out is below 1e-20.
            assert!((re - x.cos()).abs() < 1e-13 && (im - x.sin()).abs() < 1e-13, "x = {x}: {re} {im}");
        }
    }

    #[test]
    fn short_sequences_agree_with_long_ones() {
        let mut long = [0.0; 160];
        for i in 0..400 {
            let x = 0.25 * f64::from(i);
            sequence(x, &mut long);
            for orders in [1, 2, 5, 14, 40] {
                let mut short = vec![0.0; orders];
                sequence(x, &mut short);
                let error = short.iter().zip(&long).map(|(s, l)| (s - l).abs()).fold(0.0, f64::max);
                assert!(error < 2e-15, "x = {x}, {orders} orders: {error:e}");
            }
        }
    }
}
