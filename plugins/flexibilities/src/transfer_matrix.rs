//! The route of CC13: eigenvectors, transfer matrix, and their inverse.

use crate::exponential::Exponential;
use nalgebra::{Matrix4, Vector4};
use num_complex::Complex64;
use serde::{Deserialize, Serialize};
use slipzone_api::{Base, Elastic, Flexibility, LayerModel, LayerResponse, Refusal, SurfaceFlexibility};
use std::sync::Arc;

const METHOD: &str = "transfer-matrix";

const REMEDY: &str = "use flexibility = { type = \"compliance\" }";

/// Largest expected error, relative to the result, with which a result leaves this file. A survey of
/// 200 000 random layers and wave numbers found no error above twice that; 1e-8 is promised.
const ACCEPTED: f64 = 1e-10;

/// Largest `|Re n_j| h`: complex quotients square what they divide by, and `exp(2 n h)` overflows at 354.
const LARGEST_EXPONENT: f64 = 340.0;

/// `H(s, y)`, `G(s) = H(s, 0) H(s, h)^-1` (CC13 eq. 32), `N(s)` (eq. 35).
///
/// Faithful to the paper, and therefore not good everywhere. It overflows near `s h = 340`. Where the four
/// depth exponents meet pairwise the eigenvectors become parallel: `gamma -> 0`, `gamma/s -> 0`,
/// `s/gamma -> 0` (so never at `s = 0`) and `nu = 0` in plane strain (`kappa = 3`). The stress of eq. 21 has
/// the factor `1/(1 - kappa)`, infinite for the incompressible solid. The method refuses there: as soon as
/// the sum of
/// * what is visibly wrong with the result, which should be real and symmetric, and
/// * round-off times the condition of the eigenvectors, squared because `H` is inverted and then multiplied
///   by its like, the cancellation in `G`, and the cancellation `1/(kappa - 1)` in the normal stress
///
/// exceeds 1e-10 of the result. At `nu = 0.3` it serves `1e-5/g < s h < 240 g` for `g = |gamma| h` up to 1,
/// thus nothing below `g = 2e-4`, and `5e-6 < s h < 320` from 2 to 12.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TransferMatrix {}

slipzone_api::register!(Flexibility, "transfer-matrix", "the published route through eigenvectors; refuses where it overflows or degenerates",
    example: "type = \"transfer-matrix\"",
    parameters: [],
    source: "CC13 eqs. 18-35");

#[typetag::serde(name = "transfer-matrix")]
impl Flexibility for TransferMatrix {
    fn respond(&self, layer: &Arc<LayerModel>) -> Result<Box<dyn LayerResponse>, Refusal> {
        match (layer.base, layer.exponent()) {
            (Base::Rigid, Some(gamma)) => {
                if let Some(why) = (Route { elastic: layer.elastic, gamma }).obstacle() {
                    return Err(Refusal::OutOfReach { method: METHOD, why: why.into(), remedy: REMEDY });
                }
                let surface =
                    |layer: &Exponential, s: f64| Route { elastic: layer.elastic, gamma: layer.gamma }.surface(s);
                Ok(Box::new(Exponential { elastic: layer.elastic, gamma, depth: 1.0, surface }))
            }
            (Base::Rigid, None) => Err(not_built("a law other than the exponential one")),
            _ => Err(not_built("a base other than the rigid one")),
        }
    }
}

fn not_built(what: &str) -> Refusal {
    Refusal::NotBuilt { what: format!("{what} in flexibility `{METHOD}`"), remedy: REMEDY.into() }
}

/// The eigenvectors of `mu1 exp(gamma y)`.
struct Route {
    elastic: Elastic,
    gamma: f64,
}

impl Route {
    /// What ends the route at every wave number.
    fn obstacle(&self) -> Option<&'static str> {
        if self.elastic.kappa <= 1.0 {
            Some("the factor 1/(1 - kappa) of sigma_yy is infinite for an incompressible solid")
        } else if self.gamma == 0.0 {
            Some("a homogeneous layer has two double depth exponents, one eigenvector each")
        } else {
            None
        }
    }

    /// Depth exponents `n_j` (CC13 eq. 20), in units of `1/h`.
    fn exponents(&self, s: f64) -> [Complex64; 4] {
        let half = self.gamma / 2.0;
        let split = Complex64::I * self.gamma * s * Complex64::from(self.elastic.lambda()).sqrt();
        let (plus, minus) = ((half * half + s * s + split).sqrt(), (half * half + s * s - split).sqrt());
        [plus - half, minus - half, -plus - half, -minus - half]
    }

    /// `H(s, y)`: in each column the state `(v/i, u, sigma_yy/i, sigma_xy)` that belongs to one exponent
    /// (CC13 eqs. 21-31), with `v/i` and `sigma_yy/i` turned by -1.
    ///
    /// The `F_j` of the paper go with `u ~ exp(n y)`, `v ~ -i F exp(n y)` under `exp(-i s x)`; equilibrium then
    /// asks for `sigma_xy = mu (n - s F)`.
    fn states(&self, s: f64, exponents: &[Complex64; 4], y: f64) -> Matrix4<Complex64> {
        let Self { elastic: Elastic { kappa }, gamma } = *self;
        let mu = (gamma * y).exp();
        let columns = exponents.map(|n| {
            let f =
                ((kappa - 1.0) * (n * n + gamma * n) - (1.0 + kappa) * s * s) / (s * (2.0 * n + (kappa - 1.0) * gamma));
            let normal = ((1.0 + kappa) * f * n + s * (3.0 - kappa)) * (mu / (kappa - 1.0));
            let shear = (n - s * f) * mu;
            Vector4::new(f, Complex64::ONE, normal, shear) * (n * y).exp()
        });
        Matrix4::from_columns(&columns)
    }
}

/// By how much the product `G = H(s, 0) H(s, h)^-1` may magnify the rounding of its factors.
///
/// The sum of the squared condition of `H(s, h)` and the cancellation in the two columns of `G` in use, both
/// entry by entry, so that neither the growth of the columns nor the units of the rows count.
fn amplification(
    top: &Matrix4<Complex64>,
    bottom: &Matrix4<Complex64>,
    inverse: &Matrix4<Complex64>,
    transfer: &Matrix4<Complex64>,
) -> f64 {
    let size = |m: &Matrix4<Complex64>| m.map(Complex64::norm);
    let condition = size(bottom) * size(inverse);
    // Blocks that lead from displacements to displacements and from tractions to tractions carry no unit.
    let condition = condition.fixed_view::<2, 2>(0, 0).max().max(condition.fixed_view::<2, 2>(2, 2).max());
    let cancellation = (size(top) * size(inverse)).component_div(&size(transfer));
    condition * condition + cancellation.fixed_view::<4, 2>(0, 2).max()
}

impl Route {
    fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        let refusal = |why: String| Refusal::WaveNumber { method: METHOD, wave_number: s, why, remedy: REMEDY };
        let exponents = self.exponents(s);
        let largest = exponents.iter().map(|n| n.re.abs()).fold(0.0, f64::max);
        if largest > LARGEST_EXPONENT {
            return Err(refusal(format!("exp(n h) overflows: |Re n| h = {largest:.0}, {LARGEST_EXPONENT} at most")));
        }
        let singular = || refusal("the matrix of eigenvectors is singular to working precision".into());

        let (top, bottom) = (self.states(s, &exponents, 0.0), self.states(s, &exponents, 1.0));
        let inverse = bottom.lu().try_inverse().ok_or_else(singular)?;
        let transfer = top * inverse;
        // f(s, 0) = G f(s, h), and the fixed base leaves only the tractions (last two entries) of f(s, h).
        let displacement = transfer.fixed_view::<2, 2>(0, 2);
        let traction = transfer.fixed_view::<2, 2>(2, 2).into_owned().lu().try_inverse().ok_or_else(singular)?;
        // CC13's N: displacement by stress. Pressure and shear are minus the stresses, so F = -N.
        let flexibility = displacement * traction * Complex64::from(-s / self.elastic.a0());
        let [[vv, uv], [vu, uu]] = flexibility.transpose().data.0;

        // What round-off has left: see `TransferMatrix`. NaN must not pass.
        let size = (vv.re * uu.re).sqrt();
        let seen = (uv - vu).norm() / size + (vv.im / vv.re).abs() + (uu.im / uu.re).abs();
        let spread = amplification(&top, &bottom, &inverse, &transfer) / (self.elastic.kappa - 1.0).min(1.0);
        let error = seen + f64::EPSILON * spread;
        if error <= ACCEPTED {
            Ok(SurfaceFlexibility { vv: vv.re, uu: uu.re, uv: f64::midpoint(uv.re, vu.re) })
        } else {
            let expected = if error.is_nan() { "any error".into() } else { format!("an error of {error:.0e}") };
            Err(refusal(format!("the eigenvectors are so close that {expected} is to be expected")))
        }
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Compliance;
    use crate::fixtures::{Exponential, Opaque, at, bonded, distance, exponential};
    use slipzone_api::Plane;

    fn surface(layer: &Arc<LayerModel>, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        TransferMatrix {}.respond(layer)?.surface(s)
    }

    /// Whatever it returns agrees with the compliance to 1e-8 of each entry; everything else is refused.
    #[test]
    fn never_a_wrong_number() {
        let sizes = [1e-12, 1e-9, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.1, 0.5, 1.0, 2.0, 4.0, 8.0, 12.0];
        let ratios =
            [-0.9, -0.5, -0.1, -1e-3, -1e-9, 0.0, 1e-12, 1e-6, 0.01, 0.1, 0.3, 0.45, 0.49, 0.499_999, 0.5 - 1e-10, 0.5];
        let (mut served, mut refused, mut worst) = (0_u32, 0_u32, 0.0_f64);
        for (size, sign, nu, plane) in sizes.iter().flat_map(|&size| {
            let cases = ratios.iter().flat_map(move |&nu| [(size, 1.0, nu), (size, -1.0, nu)]);
            cases.flat_map(|(size, sign, nu)| [Plane::Strain, Plane::Stress].map(|plane| (size, sign, nu, plane)))
        }) {
            let layer = bonded(Exponential(sign * size), plane, nu);
            for k in 0..=60 {
                let s = 1e-6 * 8e8_f64.powf(f64::from(k) / 60.0);
                match surface(&layer, s) {
                    Ok(found) => {
                        served += 1;
                        worst = worst.max(distance(found, at(&Compliance {}, &layer, s)));
                    }
                    Err(refusal) => {
                        refused += 1;
                        let why = refusal.to_string();
                        assert!(why.contains(METHOD) && why.contains(REMEDY), "{why}");
                    }
                }
            }
        }
        assert!(worst < 1e-8, "{worst:e} among {served}");
        // Neither branch is empty: about a third of this hostile grid is served.
        assert!(served > 10_000 && refused > 10_000, "{served} served, {refused} refused");
    }

    #[test]
    fn serves_the_layers_of_the_paper() {
        for gamma in [-8.0_f64.ln(), 8.0_f64.ln()] {
            let layer = exponential(gamma, 0.3);
            for k in 0..=50 {
                let s = 1e-3 * 3e5_f64.powf(f64::from(k) / 50.0);
                let found = surface(&layer, s).unwrap();
                // Round-off times the square of the condition, (s/gamma)^2 = 2e4 at s = 300.
                assert!(distance(found, at(&Compliance {}, &layer, s)) < 1e-10, "s = {s}");
            }
        }
    }

    #[test]
    fn refuses_where_the_route_ends() {
        let why = |layer: &Arc<LayerModel>, s| match surface(layer, s) {
            Err(Refusal::WaveNumber { method: METHOD, wave_number, why, remedy: REMEDY })
                if wave_number.to_bits() == s.to_bits() =>
            {
                why
            }
            other => panic!("expected a refusal at s = {s}, found {other:?}"),
        };
        for (layer, what) in [(exponential(0.0, 0.3), "homogeneous"), (exponential(1.0, 0.5), "incompressible")] {
            // At every wave number.
            let Err(Refusal::OutOfReach { method: METHOD, why, remedy: REMEDY }) = TransferMatrix {}.respond(&layer)
            else {
                panic!("expected a refusal of what is {what}");
            };
            assert!(why.contains(what), "{why}");
        }
        assert!(why(&exponential(1.0, 0.3), 400.0).contains("overflows"));
        for (gamma, nu, s) in [(1.0, 0.3, 0.0), (1.0, 0.3, 1e-7), (1.0, 0.0, 1.0), (1e-6, 0.3, 100.0)] {
            assert!(why(&exponential(gamma, nu), s).contains("eigenvectors"), "gamma = {gamma}, nu = {nu}, s = {s}");
        }
        // A batch gives its first refusal.
        let layer = exponential(1.0, 0.3);
        let mut out = [SurfaceFlexibility::default(); 3];
        let refusal = TransferMatrix {}.respond(&layer).unwrap().surface_into(&[1.0, 500.0, 600.0], &mut out);
        assert!(matches!(refusal, Err(Refusal::WaveNumber { wave_number: 500.0, .. })), "{refusal:?}");
    }

    #[test]
    fn other_laws_and_bases_are_not_built() {
        let general = bonded(Opaque { modulus: |y| 1.0 + y, breakpoints: &[] }, Plane::Strain, 0.3);
        let infinite = Arc::new(LayerModel { base: Base::Infinite, ..Arc::into_inner(exponential(0.0, 0.3)).unwrap() });
        for layer in [general, infinite] {
            assert!(matches!(TransferMatrix {}.respond(&layer), Err(Refusal::NotBuilt { .. })));
        }
    }
}
