//! What the surface flexibility tends to at large wave numbers.

use nalgebra::Matrix2;
use slipzone_api::{Elastic, SurfaceFlexibility};

/// `s F/A0` of a homogeneous half-plane, the limit of every layer as `s` grows: `1`, `1`, `-beta`.
pub(crate) fn half_plane(elastic: Elastic) -> SurfaceFlexibility {
    SurfaceFlexibility { vv: 1.0, uu: 1.0, uv: -elastic.beta() }
}

/// The same as a compliance `C`, order `(u, v)`, times `mu s`: what a half-plane adds below a layer.
pub(crate) fn half_plane_compliance(elastic: Elastic) -> Matrix2<f64> {
    let coupling = elastic.beta();
    Matrix2::new(1.0, -coupling, -coupling, 1.0) * -elastic.a0()
}

/// Coefficient of `1/s` in `s F/A0`, with `gradient = d ln mu/dy` at the surface.
///
/// In the order `(u, v)` and with `mu` and `s` divided out, the Riccati equation of the compliance is, at
/// order `gamma/s`, the Sylvester equation `(A - C0 D) C1 - C1 (E + D C0) = -C0` with
///
/// ```text
/// A = [[0, 1], [-lambda, 0]],   E = -A^T,   D = diag(8/(1 + kappa), 0),
/// C0 = -(kappa + 1)/4 [[1, -beta], [-beta, 1]].
/// ```
///
/// `D C0 = [[-2, 2 beta], [0, 0]]`, so `A - C0 D = [[2, 1], [-1, 0]]` for every `kappa`, and `E + D C0` is
/// minus its transpose (`2 beta + lambda = 1`). The three equations for a symmetric `C1` then give
/// `C1 = (kappa + 1)/8 [[1, -1], [-1, (kappa + 5)/(kappa + 1)]]`, and `s F mu = -(C0 + C1 gamma/s + ...)`.
pub(crate) fn exponential(elastic: Elastic, gradient: f64, terms: usize) -> Vec<SurfaceFlexibility> {
    let half = gradient / 2.0;
    let first = SurfaceFlexibility { vv: -half * (elastic.kappa + 5.0) / (elastic.kappa + 1.0), uu: -half, uv: half };
    vec![first; terms.min(1)]
}

/// `s F/A0` from a compliance `C` (order `(u, v)`) in units of `scale mu1`: `F = -C`.
pub(crate) fn scaled(compliance: &Matrix2<f64>, scale: f64, elastic: Elastic) -> SurfaceFlexibility {
    let factor = -scale / elastic.a0();
    // Equal but for round-off.
    let coupling = f64::midpoint(compliance.m12, compliance.m21);
    SurfaceFlexibility { vv: factor * compliance.m22, uu: factor * compliance.m11, uv: factor * coupling }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Matrix4, Vector4};
    use slipzone_api::{Plane, Poisson};

    /// The Sylvester equation of [`exponential`] as four linear equations for the entries of `C1`.
    fn by_direct_solve(elastic: Elastic, gradient: f64) -> SurfaceFlexibility {
        let a = Matrix2::new(0.0, 1.0, -elastic.lambda(), 0.0);
        let d = Matrix2::new(8.0 / (1.0 + elastic.kappa), 0.0, 0.0, 0.0);
        let c0 = half_plane_compliance(elastic);
        let (left, right) = (a - c0 * d, a.transpose() - d * c0);
        // vec(L X + X R) = (I x L + R^T x I) vec(X), columns stacked.
        let one = Matrix2::identity();
        let system: Matrix4<f64> = one.kronecker(&left) + right.transpose().kronecker(&one);
        let c1 = system.lu().solve(&Vector4::from_column_slice((-c0).as_slice())).unwrap();
        scaled(&(Matrix2::from_column_slice(c1.as_slice()) * gradient), 1.0, elastic)
    }

    #[test]
    fn closed_form_solves_the_sylvester_equation() {
        for (plane, nu) in [(Plane::Strain, -0.99), (Plane::Strain, 0.3), (Plane::Strain, 0.5), (Plane::Stress, 0.2)] {
            let elastic = Elastic::new(plane, Poisson::new(nu).unwrap());
            let (closed, direct) = (exponential(elastic, -2.5, 1)[0], by_direct_solve(elastic, -2.5));
            for (x, y) in [(closed.vv, direct.vv), (closed.uu, direct.uu), (closed.uv, direct.uv)] {
                // Entries of order one out of a well-conditioned 4x4 system.
                assert!((x - y).abs() < 1e-14, "nu = {nu}: {closed:?} against {direct:?}");
            }
        }
    }
}
