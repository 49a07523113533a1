//! A strain `u' = C|x|` in the stick zone, as in Chen and Chen (2013, eq. 63): to be compared with what a contact's history
//! leaves there.
//!
//! For each stick zone one `C` belongs to a shear that is bounded at the zone's end. The paper leaves open which zone it
//! is. The shear must meet `eta p` like `(a - x)^(3/2)`, its rate being finite: the derivative of the shear over `a`, at a
//! constant contact, must not be singular at `a`. That derivative is odd, vanishes in the slip zone and strains the stick
//! zone by `-dC/da |x|`, which alone would need a singular end: so it vanishes and **`dC/da = 0`**.

use super::chebyshev::Points;
use super::normal::Normal;
use super::prepared_layer::PreparedLayer;
use super::root;
use super::stick::Shear;
use super::stick_zone::StickZone;
use basin::RootError;
use slipzone_api::double_exponential;
use slipzone_api::{Component, Refusal, Station};
use std::f64::consts::PI;

/// Fewest nodes on either side of the integrals over the carrier.
const FEWEST_NODES: f64 = 24.0;
/// Those nodes per length of the kernel.
const NODES_PER_LENGTH: f64 = 8.0;
/// The range of `lambda = ln(a/(b - a))` that is scanned.
pub(crate) const SCANNED: std::ops::RangeInclusive<f64> = -14.0..=16.0;
/// The steps taken through it.
const SCAN_STEP: f64 = 0.75;
/// Step of the differences that tell `dC/d lambda` in a scan.
const STEP: f64 = 0.01;
/// Half of the range about the extremum of a coarser resolution over which `C` is a polynomial, and through how many points. A wider
/// one of as many would be off by 1e-12 of `C`; a narrower one magnifies rounding more than the fifty times that this does.
const RANGE: f64 = 0.12;
const POINTS: usize = 9;
/// Position tolerance.
const POSITION: f64 = 1e-10;

/// The shear that `|x|` alone makes: `z` with `(1/pi) PV int z(r)/(x - r) dr = -(|x| - 2 a/pi)` within `(-a, a)`,
/// `z = (x/pi) ln((a - w)/(a + w))`, `w = sqrt(a^2 - x^2)`. The constant is what makes it bounded.
pub(crate) fn carrier(a: f64, at: Station) -> f64 {
    let x = at.x.abs();
    if x == 0.0 {
        return 0.0;
    }
    let w = (at.gap * (2.0 * a - at.gap)).max(0.0).sqrt();
    let logarithm = if at.gap < 0.5 * a { (-(at.gap + w) / (a + w)).ln_1p() } else { (x / (a + w)).ln() };
    2.0 * at.x / PI * logarithm
}

/// What stands beside `C/A0` in the tangential equation at each point: the constant that the carrier leaves, and the
/// layer's `(1/pi) int z(r) k_uu(x - r) dr`.
pub(crate) fn equation(layer: &PreparedLayer, a: f64, at: &[Station]) -> Vec<f64> {
    let constant = 2.0 * a / PI;
    if layer.is_plain() {
        return vec![constant; at.len()];
    }
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a positive count; `as` saturates
    let grid = double_exponential::nodes(1.0, FEWEST_NODES.max(NODES_PER_LENGTH * a / layer.length()).ceil() as usize);
    let (mut distances, mut weights, mut kernel) = (Vec::new(), Vec::new(), vec![0.0; 4 * grid.len()]);
    let one = |at: &Station| {
        distances.clear();
        weights.clear();
        for node in &grid {
            let (below, above) = (at.x * node.to_upper, at.gap * node.from_lower);
            let inner = Station { x: at.x * node.from_lower, gap: at.gap + below };
            let outer = Station { x: at.x + above, gap: at.gap * node.to_upper };
            distances.extend([below, at.x + inner.x, -above, at.x + outer.x]);
            weights.extend([at.x * node.weight * carrier(a, inner), at.gap * node.weight * carrier(a, outer)]);
        }
        layer.kernel_values(Component::ShearStrain, &distances, &mut kernel);
        let sum: f64 = weights.iter().zip(kernel.chunks_exact(2)).map(|(weight, k)| weight * (k[0] - k[1])).sum();
        constant + sum / PI
    };
    at.iter().map(one).collect()
}

/// `C/A0` as a function of `lambda`, at one resolution.
pub(crate) struct RateCurve<'a> {
    pub(crate) layer: &'a PreparedLayer,
    pub(crate) normal: &'a mut Normal,
    pub(crate) shear: &'a mut Shear,
    pub(crate) beta: f64,
    /// Negative where the slip is outward.
    pub(crate) friction: f64,
}

impl RateCurve<'_> {
    /// At one stick zone, the shear of which is left.
    pub(crate) fn at(&mut self, lambda: f64) -> Result<f64, Refusal> {
        let zone = StickZone::from_log(lambda, self.normal.half_width);
        self.shear.solve_strained(self.layer, self.normal, self.beta, self.friction, zone)
    }

    /// `dC/d lambda` over `A0`.
    fn slope(&mut self, lambda: f64) -> Result<f64, Refusal> {
        let last = self.at(lambda + 2.0 * STEP)?;
        let (after, before, first) = (self.at(lambda + STEP)?, self.at(lambda - STEP)?, self.at(lambda - 2.0 * STEP)?);
        Ok((8.0 * (after - before) - (last - first)) / (12.0 * STEP))
    }

    /// Where `C` is extremal: near a place known, or anywhere.
    pub(crate) fn extrema(&mut self, known: Option<f64>) -> Result<Vec<f64>, Refusal> {
        if let Some(known) = known
            && let Some(found) = self.about(known)?
        {
            return Ok(vec![found]);
        }
        let (mut found, mut before) = (Vec::new(), None);
        let mut lambda = *SCANNED.start();
        while SCANNED.contains(&lambda) {
            let slope = self.slope(lambda)?;
            if let Some((at, was)) = before.filter(|(_, was)| slope * was <= 0.0) {
                found.push(self.between([at, lambda], [was, slope])?);
            }
            before = Some((lambda, slope));
            lambda += SCAN_STEP;
        }
        Ok(found)
    }

    /// Where `C` is extremal within a range about a place; `None` where that is not inside.
    fn about(&mut self, place: f64) -> Result<Option<f64>, Refusal> {
        let points = Points::get(POINTS);
        let lambda = |part: f64| place + RANGE * (2.0 * part - 1.0);
        let rates: Result<Vec<f64>, Refusal> = points.at.iter().map(|part| self.at(lambda(*part))).collect();
        let series = points.through(&rates?);
        Ok(root::between((0.0, 1.0), f64::EPSILON, |part| series.value_and_slope(part).1).map(lambda))
    }

    /// The root between two places where the slope has different signs.
    fn between(&mut self, ends: [f64; 2], slopes: [f64; 2]) -> Result<f64, Refusal> {
        let known = |lambda: f64| slopes.into_iter().zip(ends).find(|(_, end)| end.to_bits() == lambda.to_bits());
        let slope = |lambda| known(lambda).map_or_else(|| self.slope(lambda), |(slope, _)| Ok(slope));
        match root::bracketed((ends[0], ends[1]), POSITION, slope) {
            Ok(found) => Ok(found.at),
            Err(RootError::Evaluation(refusal)) => Err(refusal),
            Err(other) => Err(Refusal::OutOfReach {
                method: "engine",
                why: format!("where the strain's rate C is extremal could not be told: {other}"),
                remedy: "leave out strain = \"linear\"",
            }),
        }
    }
}
