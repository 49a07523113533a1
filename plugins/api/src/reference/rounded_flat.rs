//! Frictionless flat punch with rounded corners on a half-plane: `g = 0` for `|x| <= c`, then
//! `(|x| - c)^2/(2 R)`.
//!
//! G. Schubert, Ing.-Arch. 13 (1942) 132; M. Ciavarella, D. A. Hills, G. Monno, Proc. Inst. Mech. Eng. C 212 (1998) 319.
//! Derived here from Abel's integrals with `c = b cos psi`: `P = (b^2/(A0 R)) (psi - sin psi cos psi)` and
//! `dP/db = 2 b psi/(A0 R)`. In the pressure the sines and tangents of the papers are written in lengths, which
//! keep their digits at `|x| = c`.

use std::f64::consts::PI;

/// A rounded flat punch in contact.
///
/// A contact hardly wider than the flat leaves small differences of large numbers: with `psi` as above, force and
/// pressure have a relative rounding of about `1e-16/psi^2`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundedFlat {
    /// Half-width `c` of the flat part.
    pub flat: f64,
    /// Radius `R` of the corners.
    pub radius: f64,
    /// Half-width `b` of the contact, at least `c`.
    pub half_width: f64,
    /// Compliance `A0 = (kappa + 1)/(4 mu)` of the half-plane, 1/stress.
    pub compliance: f64,
}

impl RoundedFlat {
    /// `P = (b^2/(A0 R)) (psi - sin psi cos psi)`, per unit length.
    pub fn force(self) -> f64 {
        let (b, c) = (self.half_width, self.flat);
        (b * b * self.psi() - c * self.shoulder()) / (self.compliance * self.radius)
    }

    /// `dP/db = 2 b psi/(A0 R)`; 0 for a half-width within the flat.
    pub fn force_rate(self) -> f64 {
        2.0 * self.half_width * self.psi() / (self.compliance * self.radius)
    }

    /// With `X = sqrt(b^2 - x^2)`, `C = sqrt(b^2 - c^2)`:
    /// `p = (2 psi X + |x| ln((|x| C + c X)^2/(b^2 |x^2 - c^2|)) + c ln(|x^2 - c^2|/(C + X)^2))/(pi A0 R)`;
    /// 0 outside the contact.
    pub fn pressure(self, x: f64) -> f64 {
        let (x, b, c) = (x.abs(), self.half_width, self.flat);
        if x >= b || c >= b {
            return 0.0;
        }
        let (root, shoulder) = (((b - x) * (b + x)).sqrt(), self.shoulder());
        let apart = (x - c).abs() * (x + c);
        let sum = x * shoulder + c * root;
        let log = if apart > 0.0 {
            // Each logarithm apart is infinite at x = c, both together are not.
            2.0 * (x * (sum / (b * b)).ln() - c * ((shoulder + root) / b).ln()) - (x - c) * (apart / (b * b)).ln()
        } else {
            2.0 * c * (sum / (b * (shoulder + root))).ln()
        };
        // A cylinder in the middle: 0 ln 0.
        let log = if c + x > 0.0 { log } else { 0.0 };
        (2.0 * self.psi() * root + log) / (PI * self.compliance * self.radius)
    }

    /// `psi = acos(c/b)`; 0 for a half-width within the flat.
    fn psi(self) -> f64 {
        self.shoulder().atan2(self.flat)
    }

    /// `C = sqrt(b^2 - c^2)`.
    fn shoulder(self) -> f64 {
        ((self.half_width - self.flat) * (self.half_width + self.flat)).max(0.0).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::cylinder::Cylinder;
    use crate::reference::{abel, surface};

    fn contact(flat: f64) -> RoundedFlat {
        RoundedFlat { flat, radius: 3.0, half_width: 0.8, compliance: 0.6 }
    }

    #[test]
    fn it_is_a_stack_of_flat_punches() {
        for flat in [0.01, 0.4, 0.7, 0.79] {
            let psi2 = contact(flat).psi().powi(2);
            let force = abel::force(|x| (x - flat).max(0.0) / 3.0, &[flat], 0.8, 0.6);
            assert!((contact(flat).force() / force - 1.0).abs() < 1e-14 / psi2, "c = {flat}: {force}");
            for x in [0.0, 0.3, 0.4, 0.4 + 1e-9, 0.4 - 1e-9, -0.6, 0.7, 0.799] {
                let rate = |b: f64| RoundedFlat { half_width: b, ..contact(flat) }.force_rate();
                let (got, sum) = (contact(flat).pressure(x), abel::pressure(rate, &[flat], 0.8, x));
                // Rounding as documented, in units of the pressure in the middle.
                let unit = contact(flat).pressure(0.0);
                assert!((got - sum).abs() < 2e-14 / psi2 * unit, "c = {flat}, x = {x}: {got} against {sum}");
            }
        }
    }

    #[test]
    fn without_a_flat_it_is_a_cylinder() {
        let cylinder = Cylinder { radius: 3.0, half_width: 0.8, compliance: 0.6 };
        assert!((contact(0.0).force() / cylinder.force() - 1.0).abs() < 1e-15, "three roundings");
        for x in [0.0, 0.1, -0.5, 0.79] {
            let (got, exact) = (contact(0.0).pressure(x), cylinder.pressure(x));
            assert!((got / exact - 1.0).abs() < 1e-15, "at {x}: {got} against {exact}");
        }
    }

    #[test]
    fn hardly_rounded_it_is_a_flat_punch() {
        // p/P = 1/(pi sqrt(b^2 - x^2)) in the middle, short by terms of psi^2.
        let almost = RoundedFlat { half_width: 0.4 * (1.0 + 1e-4), ..contact(0.4) };
        let ratio = almost.pressure(0.0) / almost.force() * PI * 0.4;
        assert!((ratio - 1.0).abs() < almost.psi().powi(2), "{ratio}");
        let within = RoundedFlat { half_width: 0.3, ..contact(0.4) };
        assert!([within.force_rate(), within.pressure(0.1)].iter().all(|x| x.abs() < f64::MIN_POSITIVE));
    }

    #[test]
    fn the_surface_takes_the_shape_of_the_punch() {
        for x in [0.1, 0.39, 0.41, 0.7] {
            let slope = 0.6 * surface::cauchy(|r| contact(0.4).pressure(r), 0.8, &[-0.4, 0.4], x);
            // What the check leaves out beside the pole, in units of the largest slope.
            assert!((slope - (x - 0.4).max(0.0) / 3.0).abs() < 1e-11, "slope {slope} at x = {x}");
        }
    }
}
