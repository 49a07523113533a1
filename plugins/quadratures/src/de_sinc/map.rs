//! The double-exponential map `x = c tanh w`, `w = (pi/2) sinh u` (H. Takahasi, M. Mori 1974).

use slipzone_api::Station;
use std::f64::consts::FRAC_PI_2;

/// Where a node stands on `[-1, 1]`, `u >= 0`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// `u`.
    pub(super) u: f64,
    /// `w = (pi/2) sinh u`.
    pub(super) w: f64,
    /// `tanh w`.
    pub(super) x: f64,
    /// `1 - tanh w`, to full relative precision.
    pub(super) gap: f64,
    /// `1/cosh w = sqrt(1 - x^2)`.
    pub(super) sech: f64,
    /// `(dx/du)/sqrt(1 - x^2) = (pi/2) cosh u/cosh w`.
    pub(super) slope: f64,
}

impl Place {
    pub(super) fn new(u: f64) -> Self {
        let w = FRAC_PI_2 * u.sinh();
        let sech = 1.0 / w.cosh();
        Self { u, w, x: w.tanh(), gap: (-w).exp() * sech, sech, slope: FRAC_PI_2 * u.cosh() * sech }
    }
}

/// `u` of `|x|` on `[-half_width, half_width]`, infinite at the end.
pub(super) fn locate(at: Station, half_width: f64) -> f64 {
    let t = at.x.abs() / half_width;
    // Each form where it keeps its digits.
    let w = if t < 0.5 { t.atanh() } else { 0.5 * ((2.0 * half_width - at.gap) / at.gap).ln() };
    (w / FRAC_PI_2).asinh()
}
