//! A slice of the layer as a two-port between its faces, and how slices are stacked.

use crate::coefficients::Coefficients;
use nalgebra::{Matrix2, Matrix4};
use slipzone_api::Material;

/// Largest `max(s, |gamma|) delta` of a slice: its growing solutions, hidden in the propagator, take no digits.
pub(crate) const THIN: f64 = 0.5;

/// Most terms of that series.
const MOST_TERMS: u32 = 40;

/// Terms of that series below this, times the fourth power of the wave number in units of the slice, are left out: no
/// compliance and no entry of a propagator is smaller than that power, and each keeps its relative precision.
const NEGLIGIBLE: f64 = f64::EPSILON / 32.0;

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
    /// A slice of thickness 1, at most [`THIN`], whose modulus, the unit of stress at its top, grows by `exp(gamma)`.
    pub(crate) fn thin(material: Material, gamma: f64, s: f64) -> Self {
        let propagator = propagator(material, gamma, s);
        let rho = gamma.exp();
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

    /// Tractions at the bottom for tractions at the top, both in one unit, when the compliance is `below` at the
    /// bottom.
    pub(crate) fn traction(&self, below: &Matrix2<f64>) -> Matrix2<f64> {
        inverse(&(Matrix2::identity() - self.c * below)) * self.b.transpose()
    }

    /// The compliance at the top when the bottom rests on a rigid body without friction: `v = 0`, `sigma_xy = 0` there.
    pub(crate) fn over_smooth_base(&self) -> Matrix2<f64> {
        // 0 = (e t)_xy + c_xx u.
        let sliding = self.b.column(0);
        self.a - sliding * sliding.transpose() / (self.rho * self.c.m11)
    }
}

/// Inverse of a matrix that is known to be regular: `I - a c` has a determinant of at least 1, because
/// `-a` and `c` are symmetric and not negative, and the blocks of thin slices are close to `I`.
fn inverse(m: &Matrix2<f64>) -> Matrix2<f64> {
    let [[m11, m21], [m12, m22]] = m.data.0;
    Matrix2::new(m22, -m12, -m21, m11) / (m11 * m22 - m12 * m21)
}

/// The state `(u, v, sigma_xy, sigma_yy)` at the bottom of such a slice for each unit state at its top, each in its
/// local unit of stress: the exponential of the equations' matrix.
fn propagator(material: Material, gamma: f64, s: f64) -> Matrix4<f64> {
    let [softness, stiffness, contraction, cross] = Coefficients::of(material, material.shear);
    let negligible = NEGLIGIBLE * s.min(1.0).powi(4);
    let mut term = Matrix4::<f64>::identity();
    let mut sum = term;
    let mut small = 0;
    for k in 1..=MOST_TERMS {
        let step = f64::from(k).recip();
        for mut state in term.column_iter_mut() {
            let [u, v, shear, normal] = [state[0], state[1], state[2], state[3]];
            state[0] = (s * v + softness * shear) * step;
            state[1] = (cross * normal - s * contraction * u) * step;
            state[2] = (s * (s * stiffness * u + contraction * normal) - gamma * shear) * step;
            state[3] = -(s * shear + gamma * normal) * step;
        }
        sum += term;
        small = if term.amax() <= negligible { small + 1 } else { 0 };
        if small >= 2 && k >= 5 {
            break;
        }
    }
    sum
}
