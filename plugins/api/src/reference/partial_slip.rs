//! Stick and slip under a flat punch on a half-plane, in Goodman's approximation.
//!
//! Asking that the shear traction be bounded at `x = a` gives
//! `eta int_a^b p(r)/sqrt(r^2 - a^2) dr = beta int_0^a p(x)/sqrt(a^2 - x^2) dx`, which with
//! `p ~ 1/sqrt(b^2 - x^2)` is `eta/beta = K(k)/K'(k)`, `k = a/b`: complete elliptic integrals of the
//! first kind. It was found by D. A. Spence (Proc. R. Soc. A 305 (1968) 55) for indenters of any
//! power-law shape. Both directions are explicit here: the arithmetic-geometric mean one way, theta
//! series the other (their nome is `exp(-pi beta/eta)`), so neither needs a root search.

use std::f64::consts::PI;

/// A stick zone, its size kept so that no digit is lost at either end of the range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stick {
    /// `a/b`.
    pub ratio: f64,
    /// `1 - a/b`.
    pub one_minus_ratio: f64,
}

impl Stick {
    /// From `a/b`; good where `a/b` is not close to 1.
    ///
    /// # Panics
    /// When `ratio` is outside `[0, 1]`.
    pub fn from_ratio(ratio: f64) -> Self {
        assert!((0.0..=1.0).contains(&ratio), "a/b = {ratio} is outside [0, 1]");
        Self { ratio, one_minus_ratio: 1.0 - ratio }
    }

    /// From `1 - a/b`; good where `a/b` is not close to 0.
    ///
    /// # Panics
    /// When `one_minus_ratio` is outside `[0, 1]`.
    pub fn from_one_minus_ratio(one_minus_ratio: f64) -> Self {
        assert!((0.0..=1.0).contains(&one_minus_ratio), "1 - a/b = {one_minus_ratio} is outside [0, 1]");
        Self { ratio: 1.0 - one_minus_ratio, one_minus_ratio }
    }
}

/// The friction coefficient that belongs to a stick zone: `eta = beta K(k)/K'(k)`, `k = a/b`.
///
/// 0 where nothing sticks, infinite where all does. `beta = (kappa - 1)/(kappa + 1)`.
pub fn friction(stick: Stick, beta: f64) -> f64 {
    let modulus = stick.ratio;
    let complementary = (stick.one_minus_ratio * (1.0 + stick.ratio)).sqrt();
    // K(k) = pi/(2 agm(1, k')), K'(k) = pi/(2 agm(1, k))
    beta * mean(modulus) / mean(complementary)
}

/// The stick zone that belongs to a friction coefficient, the inverse of [`friction`].
///
/// `a/b = 4 exp(-pi beta/(2 eta))` for small `eta/beta`, `1 - a/b = 8 exp(-pi eta/beta)` for large.
/// All sticks where `beta = 0`: pressure then drags the surface nowhere.
///
/// # Panics
/// When `eta` is not above zero or `beta` not in `[0, 1]`.
pub fn stick(eta: f64, beta: f64) -> Stick {
    assert!(eta > 0.0, "eta = {eta} is no friction coefficient");
    assert!((0.0..=1.0).contains(&beta), "beta = {beta} is outside [0, 1]");
    if eta <= beta {
        // Nome of k itself; at most exp(-pi).
        let (k, k_prime) = moduli(beta / eta);
        // 1 - k = k'^2/(1 + k)
        Stick { ratio: k, one_minus_ratio: k_prime * k_prime / (1.0 + k) }
    } else {
        // Nome of the complementary modulus.
        let (k_prime, k) = moduli(eta / beta);
        Stick { ratio: k, one_minus_ratio: k_prime * k_prime / (1.0 + k) }
    }
}

/// The modulus whose `K'/K = quotient >= 1`, and its complement: `k = (theta_2/theta_3)^2`,
/// `k' = (theta_4/theta_3)^2` at the nome `exp(-pi quotient)`.
fn moduli(quotient: f64) -> (f64, f64) {
    let nome = (-PI * quotient).exp();
    // The nome is at most 0.0432: its powers 16 and 20 are below rounding.
    let (fourth, ninth) = (nome.powi(4), nome.powi(9));
    let theta_3 = 1.0 + 2.0 * (nome + fourth + ninth);
    let theta_4 = 1.0 + 2.0 * (fourth - nome - ninth);
    // theta_2^2 = 4 sqrt(nome) (1 + nome^2 + nome^6 + nome^12)^2; the root straight from the exponent,
    // which reaches twice as far before it underflows.
    let theta_2 = 1.0 + nome.powi(2) + nome.powi(6) + nome.powi(12);
    let root = (-0.5 * PI * quotient).exp();
    (4.0 * root * (theta_2 / theta_3).powi(2), (theta_4 / theta_3).powi(2))
}

/// Arithmetic-geometric mean of 1 and `x` in `[0, 1]`.
pub(super) fn mean(x: f64) -> f64 {
    let (mut arithmetic, mut geometric) = (1.0, x);
    // Quadratic convergence: at x = 1e-300 it takes twelve turns.
    for _ in 0..20 {
        if arithmetic - geometric <= f64::EPSILON * arithmetic {
            break;
        }
        (arithmetic, geometric) = (0.5 * (arithmetic + geometric), (arithmetic * geometric).sqrt());
    }
    if x == 0.0 { 0.0 } else { 0.5 * (arithmetic + geometric) }
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // where equality is asserted, it is exact by construction
mod tests {
    use super::*;
    use crate::double_exponential::nodes;
    use spec_math::cephes64::ellpk;

    const BETA: f64 = 2.0 / 7.0; // nu = 0.3, plane strain

    #[track_caller]
    fn close(got: f64, want: f64, relative: f64, why: &str) {
        assert!((got / want - 1.0).abs() < relative, "got {got:e}, want {want:e}: {why}");
    }

    /// The condition itself, each side by quadrature, with no elliptic integral in sight.
    #[test]
    fn shear_is_bounded_at_the_stick_edge() {
        for ratio in [1e-3, 0.1, 0.5, 0.9, 0.999] {
            let (a, b) = (ratio, 1.0);
            let eta = friction(Stick::from_ratio(a), BETA);
            let slip: f64 = nodes(b - a, 60)
                .iter()
                .map(|r| {
                    r.weight / ((2.0 * b - r.to_upper) * r.to_upper * r.from_lower * (2.0 * a + r.from_lower)).sqrt()
                })
                .sum();
            let stick: f64 = nodes(a, 60)
                .iter()
                .map(|x| {
                    x.weight / ((a + x.from_lower) * x.to_upper * (b - a + x.to_upper) * (b + x.from_lower)).sqrt()
                })
                .sum();
            close(eta * slip, BETA * stick, 1e-13, "120 terms each, poles just outside the intervals");
        }
    }

    #[test]
    fn agrees_with_a_library_of_elliptic_integrals() {
        for ratio in [0.01, 0.3, 0.7, 0.95] {
            // ellpk(m1) = K at the complementary parameter m1 = 1 - k^2.
            let quotient = ellpk(1.0 - ratio * ratio) / ellpk(ratio * ratio);
            close(friction(Stick::from_ratio(ratio), BETA), BETA * quotient, 1e-14, "roundings of 1 - k^2");
        }
    }

    #[test]
    fn inverse_pairs_over_many_decades() {
        for tenth in -90..=90 {
            let eta = BETA * 10.0_f64.powf(f64::from(tenth) / 40.0); // eta/beta from 1/180 to 180
            let zone = stick(eta, BETA);
            // Errors of the exponent, pi quotient eps, are those of a/b; the logarithm undoes them.
            close(friction(zone, BETA), eta, 4e-15, "an exponential and its logarithm");
            let sum = zone.ratio + zone.one_minus_ratio;
            assert!((sum - 1.0).abs() < 4.0 * f64::EPSILON, "a/b and 1 - a/b add up to {sum}");
        }
    }

    #[test]
    fn ratios_come_back_too() {
        for decade in 1..=300 {
            let small = 10.0_f64.powi(-decade);
            let zone = stick(friction(Stick::from_ratio(small), BETA), BETA);
            // a/b hangs on eta through an exponential: ln(4 b/a) eps is the error to expect.
            close(zone.ratio, small, 4.0 * f64::EPSILON * (4.0 / small).ln(), "conditioning");
            let zone = stick(friction(Stick::from_one_minus_ratio(small), BETA), BETA);
            close(zone.one_minus_ratio, small, 4.0 * f64::EPSILON * (8.0 / small).ln(), "conditioning");
        }
    }

    #[test]
    fn asymptotics_at_both_ends() {
        for quotient in [8.0, 20.0, 100.0, 200.0_f64] {
            // The next terms are relatively 8 exp(-pi quotient) and smaller.
            let next = 1e-14 + 16.0 * (-PI * quotient).exp();
            let zone = stick(BETA / quotient, BETA);
            close(zone.ratio, 4.0 * (-0.5 * PI * quotient).exp(), next, "4 exp(-pi beta/2 eta)");
            let zone = stick(BETA * quotient, BETA);
            close(zone.one_minus_ratio, 8.0 * (-PI * quotient).exp(), next, "8 exp(-pi eta/beta)");
        }
    }

    #[test]
    fn special_values() {
        // K = K' at k = 1/sqrt 2.
        close(stick(BETA, BETA).ratio, 0.5_f64.sqrt(), 1e-15, "symmetric point");
        close(friction(Stick::from_ratio(0.5_f64.sqrt()), BETA), BETA, 1e-15, "symmetric point");
        // Nothing slips without coupling, nothing sticks without friction.
        assert_eq!(stick(0.2, 0.0), Stick { ratio: 1.0, one_minus_ratio: 0.0 });
        assert_eq!(friction(Stick::from_ratio(0.0), BETA), 0.0);
        assert_eq!(friction(Stick::from_ratio(1.0), BETA), f64::INFINITY);
        // Beyond the range of floats: clean limits, no NaN.
        assert_eq!(stick(1e-4, BETA), Stick { ratio: 0.0, one_minus_ratio: 1.0 });
        assert_eq!(stick(1e3, BETA), Stick { ratio: 1.0, one_minus_ratio: 0.0 });
    }

    /// eta = 0.237403, nu = 0.3 (docs/theory.md): 0.5530 to the digits printed there.
    #[test]
    fn the_number_that_the_theory_quotes() {
        assert!((stick(0.237_403, BETA).ratio - 0.5530).abs() < 5e-5);
    }
}
