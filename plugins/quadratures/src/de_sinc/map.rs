//! The double-exponential map `x = c tanh w`, `w = (pi/2) sinh u` (H. Takahasi, M. Mori 1974).

use slipzone_api::Station;
use slipzone_api::elementary::ln_1p;
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

/// `u` of `|x|` on an interval with that gap, beyond all grids at the end.
#[inline(always)]
pub(super) fn locate(at: Station) -> f64 {
    // With x + gap = c all digits are kept: tanh w = x/c is exp(2 w) = 1 + 2 x/gap.
    let w = 0.5 * ln_1p(2.0 * at.x.abs() / at.gap);
    let sinh = w / FRAC_PI_2;
    let square = sinh * sinh;
    ln_1p(sinh + square / (1.0 + (1.0 + square).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_found_again() {
        for u in [0.0, 1e-200, 1e-9, 0.01, 0.3, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0] {
            let place = Place::new(u);
            let c = 3.0;
            let found = locate(Station { x: -c * place.x, gap: c * place.gap });
            assert!((found - u).abs() <= 1e-15 * u, "{found} for {u}");
        }
        assert!(locate(Station { x: 1.0, gap: 0.0 }) > 6.0);
    }
}
