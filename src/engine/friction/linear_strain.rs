//! A strain `u' = C|x|` in the stick zone, as in Chen and Chen (2013, eq. 63): to be compared with what a contact's
//! history leaves there.
//!
//! For each stick zone one `C` belongs to a shear that is bounded at the zone's end. The paper leaves open which zone
//! it is. The shear must meet `eta p` like `(a - x)^(3/2)`, its rate being finite: the derivative of the shear over
//! `a`, at a constant contact, must not be singular at `a`. That derivative is odd, vanishes in the slip zone and
//! strains the stick zone by `-dC/da |x|`, which alone would need a singular end: so it vanishes and **`dC/da = 0`**.

use super::stick::Shear;
use super::stick_zone::StickZone;
use crate::engine::numerics::chebyshev::Points;
use crate::engine::numerics::root;
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::pressure::normal::Normal;
use basin::RootError;
use slipzone_api::Refusal;

/// The range of `lambda = ln(a/(b - a))` that is scanned.
pub(crate) const SCANNED: std::ops::RangeInclusive<f64> = -14.0..=16.0;
/// The steps taken through it.
const SCAN_STEP: f64 = 0.75;
/// Step of the differences that tell `dC/d lambda` in a scan.
const STEP: f64 = 0.01;
/// Half of the range about the extremum of a coarser resolution over which `C` is a polynomial, and through how many
/// points. A wider one of as many would be off by 1e-12 of `C`; a narrower one magnifies rounding more than the fifty
/// times that this does.
const RANGE: f64 = 0.12;
const POINTS: usize = 9;
/// Position tolerance.
const POSITION: f64 = 1e-10;

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
            Err(other) => Err(Refusal::Limit {
                why: format!("where the strain's rate C is extremal could not be found: {other}"),
                remedy: "leave out strain = \"linear\"",
            }),
        }
    }
}
