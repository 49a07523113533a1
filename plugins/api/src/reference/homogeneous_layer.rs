//! Surface flexibility of a homogeneous layer on a rigid base, and the long-wave limit of any layer.
//!
//! `w = s h` throughout; results are `s F/A0`, see [`SurfaceFlexibility`]. The bonded layer with
//! `D = kappa cosh 2w + 2 w^2 + (1 + kappa^2)/2`:
//!
//! ```text
//! vv = (kappa sinh 2w - 2w)/D      uu = (kappa sinh 2w + 2w)/D
//! uv = (4 w^2 - kappa (kappa - 1)(cosh 2w - 1))/((kappa + 1) D)
//! ```
//!
//! On a base without friction, `N = 2w + sinh 2w`:
//!
//! ```text
//! vv = 2 sinh^2 w/N      uu = 2 cosh^2 w/N      uv = (4w - (kappa - 1) sinh 2w)/((kappa + 1) N)
//! ```
//!
//! In plane strain `(1 + kappa^2)/2 = 5 - 12 nu + 8 nu^2`, the form in which the first is usually
//! printed (K. L. Johnson, *Contact Mechanics* (1985), section 5.8, cites its history). With `kappa`
//! all of them hold in plane stress as well.

use crate::{Elastic, SurfaceFlexibility};

/// Layer bonded to a rigid base (`u = v = 0`), `w = s h >= 0`.
///
/// Numerator and denominator carry a factor `2 exp(-2w)`: nothing overflows however short the wave,
/// and long waves keep their digits.
pub fn bonded(elastic: Elastic, w: f64) -> SurfaceFlexibility {
    let kappa = elastic.kappa;
    let decay = (-2.0 * w).exp();
    let hyperbolic_sine = -(-4.0 * w).exp_m1(); // 2 exp(-2w) sinh 2w
    let hyperbolic_cosine_less_1 = (-2.0 * w).exp_m1().powi(2); // 2 exp(-2w) (cosh 2w - 1)
    // D = kappa (cosh 2w - 1) + 2 w^2 + (1 + kappa)^2/2: a sum of positive terms
    let denominator = kappa * hyperbolic_cosine_less_1 + 4.0 * w * (w * decay) + (1.0 + kappa) * (1.0 + kappa) * decay;
    SurfaceFlexibility {
        // kappa sinh 2w - 2w = kappa (sinh 2w - 2w) + (kappa - 1) 2w: again positive terms only
        vv: (kappa * scaled_sinh_less_argument(2.0 * w) + (kappa - 1.0) * 4.0 * w * decay) / denominator,
        uu: (kappa * hyperbolic_sine + 4.0 * w * decay) / denominator,
        uv: (8.0 * w * (w * decay) - kappa * (kappa - 1.0) * hyperbolic_cosine_less_1) / ((kappa + 1.0) * denominator),
    }
}

/// Layer on a rigid base without friction (`v = 0`, `sigma_xy = 0` below), `w = s h > 0`.
///
/// `uu` grows like `1/w` as `w -> 0`: the layer slides freely.
pub fn frictionless(elastic: Elastic, w: f64) -> SurfaceFlexibility {
    let kappa = elastic.kappa;
    let decay = (-2.0 * w).exp();
    let hyperbolic_sine = -(-4.0 * w).exp_m1(); // 2 exp(-2w) sinh 2w
    let denominator = 4.0 * w * decay + hyperbolic_sine;
    SurfaceFlexibility {
        vv: (-2.0 * w).exp_m1().powi(2) / denominator,
        uu: (1.0 + decay).powi(2) / denominator,
        // 4w - (kappa - 1) sinh 2w with sinh 2w - 2w taken out: no digits lost near kappa = 3
        uv: ((3.0 - kappa) * 4.0 * w * decay - (kappa - 1.0) * scaled_sinh_less_argument(2.0 * w))
            / ((kappa + 1.0) * denominator),
    }
}

/// `2 exp(-x) (sinh x - x)` for `x >= 0`, without cancellation and without overflow.
fn scaled_sinh_less_argument(x: f64) -> f64 {
    if x > 2.0 {
        return -(-2.0 * x).exp_m1() - 2.0 * x * (-x).exp();
    }
    // x^3/3! + x^5/5! + ... from the last term inwards: x^27/27! is below 1e-18 of the sum at x = 2.
    let square = x * x;
    let sum = (1..=12).rev().map(f64::from).fold(0.0, |tail, k| square / (2.0 * k * (2.0 * k + 1.0)) * (1.0 + tail));
    2.0 * (-x).exp() * x * sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Plane, Poisson};

    fn strain(nu: f64) -> Elastic {
        Elastic::new(Plane::Strain, Poisson::new(nu).unwrap())
    }

    /// The two solutions at the base that it leaves free, as states `(u, v, sigma_xy, sigma_yy)`.
    const BONDED: [[f64; 4]; 2] = [[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];
    const FRICTIONLESS: [[f64; 4]; 2] = [[1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

    /// `s F/A0` with no closed form: the equilibrium equations over the depth, from the base up, by the
    /// classical Runge-Kutta method; thickness and surface modulus are one.
    fn integrated(elastic: Elastic, w: f64, modulus: fn(f64) -> f64, base: [[f64; 4]; 2]) -> SurfaceFlexibility {
        let rate = |y: f64, [u, v, s, t]: [f64; 4]| {
            let (mu, lambda) = (modulus(y), elastic.lambda());
            [
                w * v + s / mu,
                -w * lambda * u + elastic.beta() * t / mu,
                8.0 * mu * w * w / (1.0 + elastic.kappa) * u + w * lambda * t,
                -w * s,
            ]
        };
        let steps = 4000;
        let h = -1.0 / f64::from(steps);
        let along = |z: [f64; 4], slope: [f64; 4], by: f64| std::array::from_fn(|i| z[i] + by * slope[i]);
        let [left, right] = base.map(|mut z| {
            for step in 0..steps {
                let y = 1.0 + f64::from(step) * h;
                let k1 = rate(y, z);
                let k2 = rate(y + 0.5 * h, along(z, k1, 0.5 * h));
                let k3 = rate(y + 0.5 * h, along(z, k2, 0.5 * h));
                let k4 = rate(y + h, along(z, k3, h));
                z = std::array::from_fn(|i| z[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]));
            }
            z
        });
        // F = -d t^-1 with the columns of d and t side by side; tractions q = -sigma_xy, p = -sigma_yy.
        let determinant = left[2] * right[3] - right[2] * left[3];
        let flexibility = |row: usize| {
            let by_shear = (left[row] * right[3] - right[row] * left[3]) / determinant;
            let by_pressure = (right[row] * left[2] - left[row] * right[2]) / determinant;
            (-w * by_shear / elastic.a0(), -w * by_pressure / elastic.a0())
        };
        let ((uu, uv), (vu, vv)) = (flexibility(0), flexibility(1));
        assert!((uv - vu).abs() < 1e-10, "Betti: {uv} and {vu}");
        SurfaceFlexibility { vv, uu, uv }
    }

    fn distance(a: SurfaceFlexibility, b: SurfaceFlexibility) -> f64 {
        (a.vv - b.vv).abs().max((a.uu - b.uu).abs()).max((a.uv - b.uv).abs())
    }

    #[test]
    fn closed_forms_solve_the_equations_over_the_depth() {
        let solids = [strain(0.0), strain(0.3), strain(0.5), Elastic::new(Plane::Stress, Poisson::new(0.4).unwrap())];
        for elastic in solids {
            for w in [0.01, 0.2, 0.9, 1.1, 2.5, 5.0] {
                // Runge-Kutta: (w/4000)^4 per unit of w is 1e-11 at w = 5; rounding over 4000 steps is smaller.
                let error = distance(bonded(elastic, w), integrated(elastic, w, |_| 1.0, BONDED));
                assert!(error < 2e-11, "bonded, kappa = {}, w = {w}: {error:e}", elastic.kappa);
                let closed = frictionless(elastic, w);
                let error = distance(closed, integrated(elastic, w, |_| 1.0, FRICTIONLESS)) / closed.uu;
                assert!(error < 2e-11, "frictionless, kappa = {}, w = {w}: {error:e}", elastic.kappa);
            }
        }
    }

    #[test]
    fn agrees_with_the_form_in_print() {
        let (nu, w) = (0.3_f64, 1.3_f64);
        let kappa = 3.0 - 4.0 * nu;
        let printed = (kappa * (2.0 * w).sinh() - 2.0 * w)
            / (kappa * (2.0 * w).cosh() + 2.0 * w * w + 5.0 - 12.0 * nu + 8.0 * nu * nu);
        assert!((bonded(strain(nu), w).vv / printed - 1.0).abs() < 1e-15, "a dozen roundings");
    }

    #[test]
    fn short_waves_feel_a_half_plane() {
        for nu in [0.0, 0.3, 0.5] {
            let elastic = strain(nu);
            let half_plane = SurfaceFlexibility { vv: 1.0, uu: 1.0, uv: -elastic.beta() };
            for w in [25.0, 400.0, 1e5, 1e200] {
                // What is left is w^2 exp(-2w), 1e-19 at w = 25.
                assert!(distance(bonded(elastic, w), half_plane) < 1e-15, "bonded, nu = {nu}, w = {w}");
                assert!(distance(frictionless(elastic, w), half_plane) < 1e-15, "frictionless, nu = {nu}, w = {w}");
            }
        }
    }

    /// `lim s F/(A0 w)` as `w = s h -> 0`, for any grading bonded to a rigid base and one Poisson's ratio.
    ///
    /// A long wave squeezes and shears each depth for itself: `Fvv(0) = int (kappa - 1)/((kappa + 1) mu) dy`
    /// and `Fuu(0) = int dy/mu`, and they do not couple. `mean_softness` is `(1/h) int_0^h mu1/mu dy`.
    fn long_wave_slope(elastic: Elastic, mean_softness: f64) -> SurfaceFlexibility {
        let uu = mean_softness / elastic.a0();
        SurfaceFlexibility { vv: elastic.beta() * uu, uu, uv: 0.0 }
    }

    #[test]
    fn long_waves_keep_their_digits() {
        for nu in [0.0, 0.3, 0.49999] {
            let elastic = strain(nu);
            let slope = long_wave_slope(elastic, 1.0);
            for w in [1e-12, 1e-9] {
                // The next term is relatively w^2/(kappa - 1), at most 1e-18/4e-5.
                let long = bonded(elastic, w);
                assert!((long.vv / (w * slope.vv) - 1.0).abs() < 1e-13, "nu = {nu}, w = {w}: {}", long.vv);
                assert!((long.uu / (w * slope.uu) - 1.0).abs() < 1e-13, "nu = {nu}, w = {w}: {}", long.uu);
            }
        }
        // Incompressible: vv starts with w^3 only, (sinh 2w - 2w)/D -> (4/3) w^3/2.
        let w = 1e-6;
        assert!((bonded(strain(0.5), w).vv / (w.powi(3) * 2.0 / 3.0) - 1.0).abs() < 1e-11, "next term: w^2");
    }

    #[test]
    fn long_waves_on_a_graded_layer() {
        // int_0^1 dy/mu of a modulus growing to twice its surface value along a line is ln 2.
        let elastic = strain(0.3);
        let w = 1e-4;
        let long = integrated(elastic, w, |y| 1.0 + y, BONDED);
        let slope = long_wave_slope(elastic, 2.0_f64.ln());
        // The next terms are relatively of order w^2 in vv and uu.
        assert!((long.vv / (w * slope.vv) - 1.0).abs() < 1e-7, "{}", long.vv / w);
        assert!((long.uu / (w * slope.uu) - 1.0).abs() < 1e-7, "{}", long.uu / w);
        // The coupling starts with w^2, which is nothing beside w.
        assert!((long.uv / w).abs() < 1e-3, "{}", long.uv / w);
    }

    #[test]
    fn the_two_branches_of_the_series_meet() {
        for w in [1.0 - 1e-9, 1.0 + 1e-9_f64] {
            let direct = (2.0 * w).sinh() - 2.0 * w;
            let scaled = scaled_sinh_less_argument(2.0 * w) / (2.0 * (-2.0 * w).exp());
            assert!((scaled / direct - 1.0).abs() < 1e-15, "roundings; nothing cancels at w = 1");
        }
    }
}
