//! The double-exponential map `x = c tanh w`, `w = (pi/2) sinh u` (H. Takahasi, M. Mori 1974).

use slipzone_api::elementary::sinh;
use std::f64::consts::FRAC_PI_2;

/// Where a node `u >= 0` stands on `[-1, 1]`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
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
    /// The place at `u <= 6.1`.
    pub(super) fn new(u: f64) -> Self {
        let sinh_u = sinh(u);
        let w = FRAC_PI_2 * sinh_u;
        let sinh_w = sinh(w);
        let cosh_w = (1.0 + sinh_w * sinh_w).sqrt();
        let sech = 1.0 / cosh_w;
        let gap = sech / (cosh_w + sinh_w);
        // Whichever keeps its digits, so that places ascend.
        let x = if w < 1.0 { sinh_w * sech } else { 1.0 - gap };
        Self { w, x, gap, sech, slope: FRAC_PI_2 * (1.0 + sinh_u * sinh_u).sqrt() * sech }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use slipzone_api::Station;
    use slipzone_api::double_exponential::locate;

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
