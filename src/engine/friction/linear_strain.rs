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
use slipzone_api::Refusal;

/// The range of `lambda = ln(a/(b - a))` that is scanned.
pub(crate) const SCANNED: std::ops::RangeInclusive<f64> = -14.0..=16.0;
/// The steps taken through it, and how many places that makes.
const SCAN_STEP: f64 = 0.75;
const SCAN_PLACES: usize = 41;
/// Half of the range about the extremum of a coarser resolution over which `C` is a polynomial, and through how many
/// points. A wider one of as many would be off by 1e-12 of `C`; a narrower one magnifies rounding more than the fifty
/// times that this does. Through as many over a whole step of the scan to either side it is off by 1e-9.
const RANGE: f64 = 0.12;
const POINTS: usize = 9;

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

    /// Where `C` is extremal: near a place known, or anywhere.
    pub(crate) fn extrema(&mut self, known: Option<f64>) -> Result<Vec<f64>, Refusal> {
        if let Some(known) = known
            && let Some(found) = self.about(known, RANGE)?
        {
            return Ok(vec![found]);
        }
        let rates: Vec<f64> =
            (0..SCAN_PLACES + 4).map(|place| self.at(scanned(place) - 2.0 * SCAN_STEP)).collect::<Result<_, _>>()?;
        // Of `C` by five places in a row, but for a factor.
        let slope = |rates: &[f64]| 8.0 * (rates[3] - rates[1]) - (rates[4] - rates[0]);
        let slopes: Vec<f64> = rates.windows(5).map(slope).collect();
        let mut found = Vec::new();
        for (place, ends) in slopes.windows(2).enumerate() {
            if ends[0] * ends[1] <= 0.0
                && let Some(roughly) = self.about(scanned(place) + 0.5 * SCAN_STEP, SCAN_STEP)?
            {
                found.push(self.about(roughly, RANGE)?.unwrap_or(roughly));
            }
        }
        Ok(found)
    }

    /// Where `C` is extremal within a range about a place; `None` where that is not inside.
    fn about(&mut self, place: f64, range: f64) -> Result<Option<f64>, Refusal> {
        let points = Points::get(POINTS);
        let lambda = |part: f64| place + range * (2.0 * part - 1.0);
        let rates: Result<Vec<f64>, Refusal> = points.at.iter().map(|part| self.at(lambda(*part))).collect();
        let series = points.through(&rates?);
        let between = |ends| root::between(ends, f64::EPSILON, |part| series.value_and_slope(part).1);
        // Another one may be near the ends.
        Ok(between((0.25, 0.75)).or_else(|| between((0.0, 1.0))).map(lambda))
    }
}

/// A place of the scan.
fn scanned(place: usize) -> f64 {
    SCANNED.start() + SCAN_STEP * place as f64
}
