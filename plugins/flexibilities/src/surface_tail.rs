//! What the surface flexibility tends to at large wave numbers.

use nalgebra::Matrix2;
use slipzone_api::{Elastic, SurfaceFlexibility};

/// `s F/A0` of a homogeneous half-plane, the limit of every layer as `s` grows: `1`, `1`, `-beta`.
pub(crate) fn half_plane(elastic: Elastic) -> SurfaceFlexibility {
    SurfaceFlexibility { vv: 1.0, uu: 1.0, uv: -elastic.beta() }
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
pub(crate) fn leading_tail(elastic: Elastic, gradient: f64) -> SurfaceFlexibility {
    let half = gradient / 2.0;
    SurfaceFlexibility { vv: -half * (elastic.kappa + 5.0) / (elastic.kappa + 1.0), uu: -half, uv: half }
}

/// `s F/A0` from a compliance `C` (order `(u, v)`) in units of `scale mu1`: `F = -C`.
pub(crate) fn scaled(compliance: &Matrix2<f64>, scale: f64, elastic: Elastic) -> SurfaceFlexibility {
    let factor = -scale / elastic.a0();
    // Equal but for round-off.
    let coupling = (compliance.m12 + compliance.m21) / 2.0;
    SurfaceFlexibility { vv: factor * compliance.m22, uu: factor * compliance.m11, uv: factor * coupling }
}
