//! Shears of a flat punch's stick zone on a half-plane, in Goodman's approximation, in closed form.
//!
//! With `k = a/b`, `k'^2 = 1 - k^2` and `p ~ 1/sqrt(b^2 - x^2)`, two odd shears are known all over the contact:
//!
//! * `Q = p F(asin(x/a), k)/K(k)` in the stick zone `(-a, a)` and `p sign(x)` outside, bounded at `a`, of which
//!   `(1/pi) PV int_-b^b Q/(x - r) dr` is `-p K(k')/K(k)` in the stick zone: the half-plane's own, for the friction
//!   `eta_h = beta K(k)/K(k')`;
//! * `X = p x/a`, of which it is a constant.
//!
//! `p(a) (eta Q + k^2 (eta - eta_h) (X - Q))` is `eta p` at `a`, and takes `-beta p` of the strain beside the contact's
//! edge as the shear of a layer does, as far as the zone reaches there (docs/theory.md, "Stick zone"). Once it is taken
//! off that, what is left has no detail of the size of the slip zone, and on a half-plane it is nothing.

use super::stick_zone::StickZone;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::Station;
use slipzone_api::elementary::{LANES, angle};
use std::f64::consts::PI;

/// These shears, 1 at the end of the stick zone. What they do comes in pairs: for `Y = Q + k^2 (X - Q)` and for
/// `Z = k^2 (Q - X)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HalfPlaneShear {
    pub(crate) zone: StickZone,
    /// `k^2`.
    share: f64,
    /// `sqrt(b^2 - a^2)`.
    at_end: f64,
    /// Towards `K(k)`.
    means: Means,
    /// `K(k')/K(k)`.
    quotient: f64,
}

impl HalfPlaneShear {
    pub(crate) fn new(zone: StickZone) -> Self {
        let b = zone.contact();
        let at_end = (zone.slip_width * (b + zone.half_width)).sqrt();
        let (means, of_rest) = (Means::new(at_end / b), Means::new(zone.half_width / b));
        let share = zone.ratio().powi(2);
        Self { zone, share, at_end, means, quotient: means.mean() / of_rest.mean() }
    }

    /// The friction that makes this stick zone on a half-plane.
    pub(crate) fn friction(&self, beta: f64) -> f64 {
        beta / self.quotient
    }

    /// In the slip zone, a point of the contact.
    #[inline(always)]
    pub(crate) fn slipping(&self, at: Station) -> [f64; 2] {
        let p = self.pressure(at);
        let beyond = -self.zone.inside(at);
        self.parts(p, p * beyond / self.zone.half_width)
    }

    /// In the stick zone; the gaps are to its end.
    pub(crate) fn sticking_into(&self, at: &[Station], out: &mut [[f64; 2]]) {
        Arch::new().dispatch(Sticking { shear: self, at, out });
    }

    /// [`Self::sticking_into`], a few points side by side.
    #[inline(always)]
    fn sticking_in_lanes(&self, at: &[Station; LANES]) -> [[f64; 2]; LANES] {
        let a = self.zone.half_width;
        let cotangents = at.map(|at| (at.gap * (a + at.x.abs())).sqrt() / at.x.abs());
        let shares = self.means.shares(cotangents);
        std::array::from_fn(|i| {
            let p = self.pressure(self.zone.in_contact(at[i])).copysign(at[i].x);
            self.parts(p * shares[i], p * (at[i].x.abs() / a - shares[i]))
        })
    }

    /// `(1/pi) PV int_-b^b q(r)/(x - r) dr` at a point of the stick zone.
    pub(crate) fn strain(&self, at: Station) -> [f64; 2] {
        let own = -self.quotient * self.pressure(self.zone.in_contact(at));
        self.parts(own, -self.at_end / self.zone.half_width - own)
    }

    /// The half-plane's pressure at a point of the contact.
    #[inline(always)]
    fn pressure(&self, at: Station) -> f64 {
        self.at_end / (at.gap * (self.zone.contact() + at.x.abs())).sqrt()
    }

    /// From `Q` and from `X - Q`.
    #[inline(always)]
    fn parts(&self, own: f64, more: f64) -> [f64; 2] {
        let more = self.share * more;
        [own + more, -more]
    }
}

/// The arithmetic-geometric mean of 1 and another number above zero, step by step.
///
/// `K(k) = pi/(2 agm(1, k'))`, and Landen's transformation carries `F(phi, k)` from step to step until `F` is an angle
/// (R. Bulirsch, Numer. Math. 7 (1965) 78).
#[derive(Clone, Copy, Debug)]
struct Means {
    /// `4^n` times the product of both numbers at step `n`.
    products: [f64; Self::MOST],
    steps: usize,
    /// `2^n` times the mean.
    last: f64,
}

impl Means {
    /// Steps enough for any number that is not below `1e-300`.
    const MOST: usize = 16;

    fn new(other: f64) -> Self {
        let mut means = Self { products: [0.0; Self::MOST], steps: 0, last: 1.0 };
        let mut other = other;
        while means.steps < Self::MOST {
            let product = means.last * other;
            means.products[means.steps] = product;
            means.steps += 1;
            let apart = (means.last - other).abs();
            means.last += other;
            // Half of the digits are there when both agree to that, and all of them a step later.
            if apart <= 1e-8 * means.last {
                break;
            }
            other = 2.0 * product.sqrt();
        }
        means
    }

    fn mean(&self) -> f64 {
        self.last / self.power()
    }

    /// `F(phi, k)/K(k)` from `cot phi`, `0 < phi <= pi/2`, side by side.
    #[inline(always)]
    fn shares(&self, cotangents: [f64; LANES]) -> [f64; LANES] {
        let (mut y, mut turns) = (cotangents, [0.0; LANES]);
        for product in &self.products[..self.steps] {
            for (y, turns) in y.iter_mut().zip(&mut turns) {
                *turns = 2.0 * *turns + if *y < 0.0 { 1.0 } else { 0.0 };
                *y -= product / *y;
            }
        }
        let scale = 1.0 / (0.5 * PI * self.power());
        std::array::from_fn(|i| (angle(y[i], self.last) + PI * turns[i]) * scale)
    }

    #[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap)] // a few steps
    fn power(&self) -> f64 {
        2.0_f64.powi(self.steps as i32)
    }
}

/// Shears at points of a stick zone, a few of them at a time.
struct Sticking<'a> {
    shear: &'a HalfPlaneShear,
    at: &'a [Station],
    out: &'a mut [[f64; 2]],
}

impl WithSimd for Sticking<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { shear, at, out } = self;
        let ((few, rest), (out, out_rest)) = (at.as_chunks(), out.as_chunks_mut());
        for (at, out) in few.iter().zip(out) {
            *out = shear.sticking_in_lanes(at);
        }
        if let Some(last) = rest.last() {
            let at = std::array::from_fn(|i| *rest.get(i).unwrap_or(last));
            out_rest.copy_from_slice(&shear.sticking_in_lanes(&at)[..rest.len()]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use slipzone_api::double_exponential;
    use slipzone_api::reference::goodman_shear::Goodman;
    use slipzone_api::reference::partial_slip;

    fn zones() -> impl Iterator<Item = StickZone> {
        [-25.0, -6.0, -1.0, 0.0, 2.0, 9.0, 25.0].into_iter().map(|lambda| StickZone::from_log(lambda, 1.0))
    }

    fn sticking(shear: &HalfPlaneShear, at: Station) -> [f64; 2] {
        let mut out = [[0.0; 2]];
        shear.sticking_into(&[at], &mut out);
        out[0]
    }

    fn at(zone: StickZone, part: f64) -> Station {
        Station { x: zone.half_width * (1.0 - part), gap: zone.half_width * part }
    }

    /// Another closed form, by integrals of the third kind.
    #[test]
    fn it_is_the_shear_of_a_half_plane() {
        for zone in zones() {
            let shear = HalfPlaneShear::new(zone);
            let law = Goodman { eta: shear.friction(0.3), beta: 0.3 };
            let stick = partial_slip::stick(law.eta, law.beta);
            assert!((stick.ratio / zone.half_width - 1.0).abs() < 1e-12, "{stick:?} for {zone:?}");
            let scale = law.eta / (PI * shear.at_end);
            for part in [0.9, 0.5, 0.1] {
                let exact = law.flat(1.0, 1.0, at(zone, part).x) / scale;
                let got: f64 = sticking(&shear, at(zone, part)).iter().sum();
                assert!((got / exact - 1.0).abs() < 1e-11, "{got} for {exact} at {part} of {zone:?}");
            }
        }
    }

    #[test]
    fn both_are_one_at_the_end_and_none_in_the_middle() {
        for zone in zones() {
            let shear = HalfPlaneShear::new(zone);
            let end = shear.slipping(Station { x: zone.half_width, gap: zone.slip_width });
            assert!((end[0] - 1.0).abs() < 1e-14 && end[1].abs() < 1e-14, "{end:?} at the end of {zone:?}");
            let inside = sticking(&shear, at(zone, 0.0));
            assert!((inside[0] - 1.0).abs() < 1e-14 && inside[1].abs() < 1e-14, "{inside:?} at the end of {zone:?}");
            let [here, there] = [1.0, -1.0].map(|sign| {
                let Station { x, gap } = at(zone, 0.4);
                sticking(&shear, Station { x: sign * x, gap })
            });
            assert_eq!(here.map(f64::to_bits), there.map(|q| (-q).to_bits()), "odd");
            assert!(sticking(&shear, at(zone, 1.0)).iter().all(|q| *q == 0.0), "in the middle of {zone:?}");
        }
    }

    /// The principal value itself: `int (q(r) - q(x))/(x - r) dr + q(x) ln((1 + x)/(1 - x))`.
    #[test]
    fn the_strain_is_the_principal_value() {
        let grid = double_exponential::nodes(1.0, 200);
        for zone in zones().filter(|zone| zone.slip_width > 1e-4 && zone.half_width > 1e-3) {
            let (shear, a, x) = (HalfPlaneShear::new(zone), zone.half_width, 0.6 * zone.half_width);
            let own = sticking(&shear, at(zone, 0.4));
            let mut sums = own.map(|own| own * ((1.0 + x) / (1.0 - x)).ln());
            let mut add = |r: f64, q: [f64; 2], apart: f64, weight: f64| {
                let terms = q.iter().zip(own).map(|(q, own)| weight * (q * r.signum() - own) / apart);
                sums.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
            };
            for node in &grid {
                let (gap, weight) = (zone.slip_width * node.to_upper, zone.slip_width * node.weight);
                let q = shear.slipping(Station { x: 1.0 - gap, gap });
                for r in [1.0 - gap, gap - 1.0] {
                    add(r, q, x - r, weight);
                }
                // From the pole to the end, and from it to the other.
                for (length, side) in [(a - x, 1.0), (a + x, -1.0)] {
                    let (r, gap) = (x + side * length * node.from_lower, length * node.to_upper);
                    let gap = if r < 0.0 { gap } else { a - r };
                    let q = sticking(&shear, Station { x: r.abs(), gap });
                    add(r, q, -side * length * node.from_lower, length * node.weight);
                }
            }
            for (sum, exact) in sums.iter().zip(shear.strain(at(zone, 0.4))) {
                let error = (sum / PI - exact).abs();
                assert!(error < 1e-6 * exact.abs().max(1.0), "{} for {exact} in {zone:?}", sum / PI);
            }
        }
    }
}
