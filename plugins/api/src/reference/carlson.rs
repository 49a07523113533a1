//! Carlson's elliptic integral of the third kind.
//!
//! B. C. Carlson, Numer. Algorithms 10 (1995) 13; NIST DLMF, section 19.36(i): duplication until the arguments are
//! alike, then a series about their mean. All terms are positive where they matter: the result has full relative
//! precision whatever the sizes of its arguments, as Legendre's form has not.

/// `R_J(0, y, 1, p) = (3/2) int_0^inf dt/((t + p) sqrt(t (t + y) (t + 1)))`, `y` and `p` in `(0, 1]`.
pub(super) fn third_kind(y: f64, p: f64) -> f64 {
    let start = [0.0, y, 1.0, p];
    let mean = (y + 1.0 + 2.0 * p) / 5.0;
    let furthest = start.iter().fold(0.0_f64, |far, m| far.max((mean - m).abs()));
    // What the series leaves out is of the sixth order in the arguments' distance from their mean.
    let (mut enough, mut quarter) = ((0.25 * f64::EPSILON).powf(-1.0 / 6.0) * furthest, 1.0);
    let ([mut x, mut y, mut z, mut p], mut middle) = (start, mean);
    let (mut delta, mut sum) = (p * (p - y) * (p - z), 0.0);
    while enough > middle.abs() {
        let (a, b, c, d) = (x.sqrt(), y.sqrt(), z.sqrt(), p.sqrt());
        let lambda = a * b + a * c + b * c;
        let product = (d + a) * (d + b) * (d + c);
        sum += quarter / product * inverse_tangent(delta / (product * product));
        [x, y, z, p, middle] = [x, y, z, p, middle].map(|m| 0.25 * (m + lambda));
        (enough, quarter, delta) = (0.25 * enough, 0.25 * quarter, delta / 64.0);
    }
    let [x, y, z] = [start[0], start[1], start[2]].map(|m| (mean - m) * quarter / middle);
    let p = -0.5 * (x + y + z);
    let e2 = x * y + x * z + y * z - 3.0 * p * p;
    let e3 = x * y * z + 2.0 * e2 * p + 4.0 * p * p * p;
    let e4 = (2.0 * x * y * z + e2 * p + 3.0 * p * p * p) * p;
    let e5 = x * y * z * p * p;
    let series = 1.0 - 3.0 * e2 / 14.0 + e3 / 6.0 + 9.0 * e2 * e2 / 88.0 - 3.0 * e4 / 22.0 - 9.0 * e2 * e3 / 52.0
        + 3.0 * e5 / 26.0;
    quarter * series / (middle * middle.sqrt()) + 6.0 * sum
}

/// `R_C(1, 1 + e) = atan(sqrt e)/sqrt e`, continued to `-1 < e < 0`.
fn inverse_tangent(e: f64) -> f64 {
    if e.abs() < 1e-4 {
        // The next term is e^4/9.
        1.0 - e * (1.0 / 3.0 - e * (0.2 - e / 7.0))
    } else if e > 0.0 {
        e.sqrt().atan() / e.sqrt()
    } else {
        (-e).sqrt().atanh() / (-e).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    /// The definition by the trapezoidal rule in `ln t`, where the integrand is analytic in a strip of `|Im| < pi`.
    #[test]
    fn it_is_its_integral() {
        for y in [1e-6, 0.1, 0.5, 0.999, 1.0] {
            for p in [1e-12, 1e-3, 0.3, 0.5, 1.0] {
                let f = |t: f64| t / ((t + p) * (t * (t + y) * (t + 1.0)).sqrt());
                let direct: f64 = (-400..=400).map(|j| 1.5 * 0.25 * f((0.25 * f64::from(j)).exp())).sum();
                let got = third_kind(y, p);
                // Some hundreds of terms; what is cut off is of the order exp(-50)/p at worst.
                assert!((got / direct - 1.0).abs() < 1e-14, "y = {y}, p = {p}: {got} against {direct}");
            }
        }
    }

    /// `R_J(0, 1, 1, p) = 3 pi/(2 (1 + sqrt p) sqrt p)`, DLMF 19.20.8.
    #[test]
    fn it_is_elementary_on_a_circle() {
        for decade in 0..=250 {
            let p = 10.0_f64.powi(-decade);
            let exact = 3.0 * FRAC_PI_2 / ((1.0 + p.sqrt()) * p.sqrt());
            let got = third_kind(1.0, p);
            assert!((got / exact - 1.0).abs() < 4e-15, "p = {p:e}: {got:e} against {exact:e}");
        }
    }
}
