//! A stick zone in a contact.

use slipzone_api::Station;
use slipzone_api::double_exponential::Node;
use std::f64::consts::PI;

/// A stick zone `|x| <= a`, with the width of the slip zone kept exactly.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct StickZone {
    /// `a`.
    pub(crate) half_width: f64,
    /// `b - a`.
    pub(crate) slip_width: f64,
}

impl StickZone {
    /// From `lambda = ln(a/(b - a))`, the unknown in which both ends are far away.
    pub(crate) fn from_log(lambda: f64, b: f64) -> Self {
        Self { half_width: b / (1.0 + (-lambda).exp()), slip_width: b / (1.0 + lambda.exp()) }
    }

    /// What it is made from.
    pub(crate) fn log(self) -> f64 {
        (self.half_width / self.slip_width).ln()
    }

    /// The same part of another contact.
    pub(crate) fn of(self, b: f64) -> Self {
        let part = b / self.contact();
        Self { half_width: part * self.half_width, slip_width: part * self.slip_width }
    }

    /// All of the contact.
    pub(crate) fn widened(self) -> Self {
        Self { half_width: self.contact(), slip_width: 0.0 }
    }

    /// Width of the narrowest slip zone that grids over the contact tell from none, over the half-width.
    pub(crate) const TOLD: f64 = 7e-13;

    /// How near to the contact's edge the shear under a sharp one may be out of all proportion, over the half-width.
    pub(crate) const NEAR: f64 = 0.01;

    /// Whether it reaches as near to the contact's edge.
    pub(crate) fn is_crowded(self) -> bool {
        self.slip_width < Self::NEAR * self.contact()
    }

    /// Half-width `b` of the contact.
    pub(crate) fn contact(self) -> f64 {
        self.half_width + self.slip_width
    }

    /// Whether grids over the contact tell its slip zone from none.
    pub(crate) fn is_told(self) -> bool {
        self.slip_width >= Self::TOLD * self.half_width
    }

    /// `a/b`.
    pub(crate) fn ratio(self) -> f64 {
        self.half_width / self.contact()
    }

    /// `1 - a/b`.
    pub(crate) fn one_minus_ratio(self) -> f64 {
        self.slip_width / self.contact()
    }

    /// How wide it is, in words: beside the edge by how much it misses the contact's.
    pub(crate) fn words(self) -> String {
        if self.is_crowded() {
            format!("1 - a/b = {:.3e}", self.one_minus_ratio())
        } else {
            format!("a/b = {:.6}", self.ratio())
        }
    }

    /// The point of the contact that is this point of the stick zone: its gap is to the contact's edge.
    pub(crate) fn in_contact(self, station: Station) -> Station {
        Station { x: station.x, gap: station.gap + self.slip_width }
    }

    /// How far a point of the contact, right of the middle, is inside its end; negative in the slip zone. The
    /// difference is taken on that side of the end on which it costs no digits: in a narrow zone both gaps to the
    /// contact's edge are nearly all of the contact.
    #[inline(always)]
    pub(crate) fn inside(self, at: Station) -> f64 {
        if self.half_width < self.slip_width { self.half_width - at.x } else { at.gap - self.slip_width }
    }

    /// A point of the slip zone on a double-exponential grid of unit length over it.
    pub(crate) fn in_slip(self, node: &Node) -> Station {
        Station { x: self.half_width + self.slip_width * node.from_lower, gap: self.slip_width * node.to_upper }
    }

    /// By how much finer a grid a shear needs where the half-plane's is not taken off it ([`super::half_plane_shear`]).
    ///
    /// The pressure has a branch point at the contact's edge, `b - a` beyond the end. In the variable `sinh u = (2/pi)
    /// atanh(x/a)` of a double-exponential grid it stands at `sinh u = (ln(1 + 2 a/(b - a)) + i pi)/pi`, whose
    /// imaginary part is less than the `pi/2` of the end by about the factor returned; convergence slows down by as
    /// much. In narrower slip zones than [`Self::TOLD`] it stands beyond the end of all grids.
    pub(crate) fn crowding(self) -> f64 {
        let slip_width = self.slip_width.max(Self::TOLD * self.half_width);
        (1.0 + ((2.0 * self.half_width / slip_width).ln_1p() / PI).powi(2)).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_widths_keep_their_digits() {
        for lambda in [-27.0_f64, -1.0, 0.0, 1.0, 27.0] {
            let zone = StickZone::from_log(lambda, 3.0);
            let again = (zone.half_width / zone.slip_width).ln();
            assert!((again - lambda).abs() < 1e-14 * lambda.abs().max(1.0), "{again} for {lambda}: two roundings");
            assert!((zone.contact() - 3.0).abs() < 1e-15);
        }
        assert!((StickZone::from_log(0.0, 1.0).crowding() - 1.0).abs() < 0.1);
    }
}
