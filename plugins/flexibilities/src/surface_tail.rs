//! The asymptotic series of the surface flexibility in `1/s`.
//!
//! Write the compliance of the theory's section 2 as `C = -A G/s` with `A` the surface's `A0 = (kappa + 1)/4`, the
//! moduli in units of the surface modulus: the entries of `G(0)` are those of `s F/A0`, in the order `(u, v)`. Its
//! Riccati equation becomes
//!
//! ```text
//! G'/s = [[0, 1], [-lambda, 0]] G + G [[0, -lambda], [1, 0]] + 2 A mu/A0 G e e^T G - diag(1, beta)/(A mu),   e = (1, 0).
//! ```
//!
//! Put `G = (H0 + H1/s + H2/s^2 + ...)/m(y)`, `m = A mu/A0`. Then `H0 = [[1, -beta], [-beta, 1]]` is the half-plane at
//! every depth, and with the logarithmic gradient `w = m'/m` the power `1/s^k` reads
//!
//! ```text
//! L Hk + Hk L^T = Hk-1' - w Hk-1 - 2 sum_{j=1}^{k-1} Hj e e^T Hk-j,     L = [[2, 1], [-1, 0]],
//! ```
//!
//! with the same `L` for every `kappa`, constant over depth or not, because `2 beta + lambda = 1`. The `Hk` are
//! symmetric.

mod orders;

use crate::coefficients::Coefficients;
use nalgebra::Matrix2;
use orders::Orders;
use slipzone_api::taylor::Taylor;
use slipzone_api::{Elastic, LayerModel, Moduli, Plane, Solid, SurfaceFlexibility};

/// `s F/A0` of a homogeneous half-plane, the limit of every layer as `s` grows: `1`, `1`, `-beta`.
pub(crate) fn half_plane(elastic: Elastic) -> SurfaceFlexibility {
    SurfaceFlexibility { vv: 1.0, uu: 1.0, uv: -elastic.beta() }
}

/// The same as a compliance `C`, order `(u, v)`, times `mu s`: what a half-plane adds below a layer.
pub(crate) fn half_plane_compliance(elastic: Elastic) -> Matrix2<f64> {
    let coupling = elastic.beta();
    Matrix2::new(1.0, -coupling, -coupling, 1.0) * -elastic.a0()
}

/// Coefficients of `1/s`, ..., `1/s^terms` in `s F/A0` under `exp(gradient y)`, where `w` and all `Hk` are constants.
///
/// The `k`-th is `gradient^k` times a number that depends on `kappa` alone; the series converges beyond
/// `s` of about `|gradient|`. Cost: `3 terms^2/2` multiplications.
pub(crate) fn exponential(elastic: Elastic, gradient: f64, terms: usize) -> Vec<SurfaceFlexibility> {
    let mut tail: Vec<SurfaceFlexibility> = Vec::with_capacity(terms);
    let mut last = half_plane(elastic);
    for _ in 0..terms {
        let mut right =
            SurfaceFlexibility { vv: -gradient * last.vv, uu: -gradient * last.uu, uv: -gradient * last.uv };
        for (before, after) in tail.iter().zip(tail.iter().rev()) {
            subtract_product(&mut right, *before, *after);
        }
        last = solved(right);
        tail.push(last);
    }
    tail
}

/// The same for a layer whose law tells its Taylor coefficients at the surface: as many terms as those give, or `None`
/// where they give none at all.
pub(crate) fn of(layer: &LayerModel, terms: usize) -> Option<Vec<SurfaceFlexibility>> {
    let law = &*layer.law;
    let (modulus, is_uniform) = (law.surface_series(terms + 1), law.poisson(0.0).is_none());
    if modulus.len() < 2 && terms > 0 {
        return None;
    }
    if is_uniform {
        return Some(smooth(layer.elastic, &modulus, &[layer.elastic.beta()], terms));
    }
    let poisson = law.poisson_series(modulus.len());
    let count = modulus.len().min(poisson.len());
    if count < 2 && terms > 0 {
        return None;
    }
    let (modulus, nu) = (Taylor::new(modulus), Taylor::new(poisson[..count].to_vec()));
    let (plane_modulus, beta) = constants(layer.solid, modulus, &nu);
    let plane_modulus = plane_modulus.coefficients();
    let relative: Vec<f64> = plane_modulus.iter().map(|c| c / plane_modulus[0]).collect();
    Some(smooth(layer.elastic, &relative, beta.coefficients(), terms))
}

/// The same from the constants as polynomials in the depth.
pub(crate) fn by_values(elastic: Elastic, coefficients: &Coefficients, terms: usize) -> Vec<SurfaceFlexibility> {
    let first = coefficients.stiffness.at(0.0);
    let padded = |series: &[f64]| series.iter().copied().chain(std::iter::repeat(0.0)).take(terms + 1).collect();
    let modulus: Vec<f64> = padded(coefficients.stiffness.coefficients());
    let modulus: Vec<f64> = modulus.iter().map(|c| c / first).collect();
    let mut beta: Vec<f64> = padded(coefficients.contraction.coefficients());
    for c in &mut beta {
        *c *= -0.5;
    }
    beta[0] = elastic.beta();
    smooth(elastic, &modulus, &beta, terms)
}

/// `mu/A0`, but for a factor, and `beta`, given the modulus and Poisson's ratio.
fn constants(solid: Solid, modulus: Taylor, nu: &Taylor) -> (Taylor, Taylor) {
    let one_plus = || nu.clone() + 1.0;
    let shear = match solid.moduli {
        Moduli::Shear => modulus,
        Moduli::Young => modulus / one_plus(),
    };
    // A0 = 1 - nu, beta = (1 - 2 nu)/(2 - 2 nu); in plane stress 1/(1 + nu), (1 - nu)/2.
    match solid.plane {
        Plane::Strain => {
            let a0 = -nu.clone() + 1.0;
            (shear / a0.clone(), (nu.clone() * -2.0 + 1.0) / (a0 * 2.0))
        }
        Plane::Stress => (shear * one_plus(), nu.clone() * -0.5 + 0.5),
    }
}

/// The same under any law that is smooth at the surface, from the Taylor coefficients of `mu/A0`, the first of them 1,
/// and of `beta` (those left out are zero) there.
///
/// The `Hk` are carried as Taylor polynomials. Each order differentiates once: `Hk` to degree `m` asks for `w` to
/// degree `m + k - 1` and for the modulus to one more, so that `n + 1` coefficients (the leading 1 among them) give `n`
/// terms, at about `terms^4/8` multiplications. The series is in general only asymptotic, and ends before a term that
/// is too large for a number: of a steep law even the first may be.
fn smooth(elastic: Elastic, modulus: &[f64], beta: &[f64], terms: usize) -> Vec<SurfaceFlexibility> {
    let terms = terms.min(modulus.len().saturating_sub(1));
    let gradient = logarithmic_gradient(modulus, terms);
    let coupling: Vec<f64> = beta.iter().map(|beta| -beta).collect();
    let orders = Orders::new(half_plane(elastic), &coupling, &gradient, terms);
    let is_number = |term: &SurfaceFlexibility| [term.vv, term.uu, term.uv].iter().all(|entry| entry.is_finite());
    (1..=terms).map(|order| orders.at_surface(order)).take_while(is_number).collect()
}

/// Taylor coefficients of `w = mu'/mu`, `terms` of them, from `terms + 1` of `mu`: `mu' = w mu`, power by power.
fn logarithmic_gradient(modulus: &[f64], terms: usize) -> Vec<f64> {
    let mut gradient: Vec<f64> = Vec::with_capacity(terms);
    for k in 1..=terms {
        let known: f64 = gradient.iter().zip(modulus[1..k].iter().rev()).map(|(w, mu)| w * mu).sum();
        gradient.push(k as f64 * modulus[k] - known);
    }
    gradient
}

/// `sum -= 2 left e e^T right`. Of the off-diagonal entry one triangle is enough: the sums that this adds up in
/// contain each pair in both orders.
fn subtract_product(sum: &mut SurfaceFlexibility, left: SurfaceFlexibility, right: SurfaceFlexibility) {
    sum.uu -= 2.0 * left.uu * right.uu;
    sum.uv -= 2.0 * left.uu * right.uv;
    sum.vv -= 2.0 * left.uv * right.uv;
}

/// The symmetric `X` with `L X + X L^T = right`, `L = [[2, 1], [-1, 0]]`: the three equations
/// `4 uu + 2 uv`, `2 uv + vv - uu`, `-2 uv` for the entries `uu`, `uv`, `vv` of `right`.
fn solved(right: SurfaceFlexibility) -> SurfaceFlexibility {
    let uu = (right.uu + right.vv) / 4.0;
    SurfaceFlexibility { vv: right.uv + right.vv + uu, uu, uv: -right.vv / 2.0 }
}

/// `s F/A0` from a compliance `C` (order `(u, v)`) in units of `scale mu1`: `F = -C`.
pub(crate) fn scaled(compliance: &Matrix2<f64>, scale: f64, elastic: Elastic) -> SurfaceFlexibility {
    let factor = -scale / elastic.a0();
    // Equal but for round-off.
    let coupling = f64::midpoint(compliance.m12, compliance.m21);
    SurfaceFlexibility { vv: factor * compliance.m22, uu: factor * compliance.m11, uv: factor * coupling }
}

#[cfg(test)]
mod tests;
