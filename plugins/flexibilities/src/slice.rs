//! A slice of the layer as a two-port between its faces, and how slices are stacked.

use nalgebra::{Matrix2, Matrix4};
use slipzone_api::Elastic;

/// Terms of the Taylor series of a slice's propagator. On a slice with `max(s, |gamma|) delta <= 1/4` the
/// depth exponents are at most 0.43, and `0.43^16/16!` leaves nothing above round-off.
const TERMS: u32 = 15;

/// What a slice does between its top and its bottom: displacements `d = (u, v)`, tractions `t = (sigma_xy, sigma_yy)`,
///
/// ```text
/// d_top = a t_top + b d_bottom,      t_bottom = e t_top + c d_bottom.
/// ```
///
/// `a` is the compliance of the slice on a rigid base, `c` the stiffness of its bottom under a free top,
/// `b` fades with thickness: nothing here grows exponentially, and stacking adds terms of one sign, so
/// nothing cancels. By reciprocity `a` and `c` are symmetric and `e = b^T/rho`, where `rho` is the ratio
/// of the units of stress at the bottom and at the top.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slice {
    pub(crate) a: Matrix2<f64>,
    pub(crate) b: Matrix2<f64>,
    pub(crate) c: Matrix2<f64>,
    pub(crate) rho: f64,
}

impl Slice {
    /// The slice whose state `(d, t)` obeys `z' = generator z` over a unit of depth.
    pub(crate) fn thin(generator: &Matrix4<f64>, rho: f64) -> Self {
        let one = Matrix4::identity();
        let propagator = (1..=TERMS).rev().fold(one, |sum, k| one + generator * sum / f64::from(k));
        let block = |i, j| propagator.fixed_view::<2, 2>(i, j).into_owned();
        // d_bottom = P11 d_top + P12 t_top, t_bottom = P21 d_top + P22 t_top, solved for d_top.
        let b = inverse(&block(0, 0));
        Self { a: -b * block(0, 2), b, c: block(2, 0) * b, rho }
    }

    /// This slice on top of another one like it, stresses at each face in their local unit.
    pub(crate) fn doubled(&self) -> Self {
        let Self { a, b, c, rho } = *self;
        let between = inverse(&(Matrix2::identity() - a * c));
        let bounce = b.transpose() * (c * between) * b / rho;
        Self { a: self.over(&a), b: b * between * b, c: c + bounce, rho: rho * rho }
    }

    /// Compliance `d = C t` at the top, when it is `below` at the bottom.
    pub(crate) fn over(&self, below: &Matrix2<f64>) -> Matrix2<f64> {
        let between = inverse(&(Matrix2::identity() - below * self.c));
        self.a + self.b * (between * below) * self.b.transpose() / self.rho
    }
}

/// Inverse of a matrix that is known to be regular: `I - a c` has a determinant of at least 1, because
/// `-a` and `c` are symmetric and not negative, and the blocks of thin slices are close to `I`.
fn inverse(m: &Matrix2<f64>) -> Matrix2<f64> {
    let [[m11, m21], [m12, m22]] = m.data.0;
    Matrix2::new(m22, -m12, -m21, m11) / (m11 * m22 - m12 * m21)
}

/// The equations of plane elasticity over depth, `z' = K z`, for `z = (u, v, sigma_xy, sigma_yy)` at wave
/// number `s`, the stresses in a unit that grows like `exp(gamma y)`, the shear modulus `modulus` in that unit.
pub(crate) fn generator(elastic: Elastic, s: f64, gamma: f64, modulus: f64) -> Matrix4<f64> {
    let (lambda, beta) = (elastic.lambda(), elastic.beta());
    #[rustfmt::skip]
    let k = Matrix4::new(
        0.0, s, 1.0 / modulus, 0.0,
        -lambda * s, 0.0, 0.0, beta / modulus,
        8.0 * modulus * s * s / (1.0 + elastic.kappa), 0.0, -gamma, lambda * s,
        0.0, 0.0, -s, -gamma,
    );
    k
}
