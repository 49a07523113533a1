//! From where to where the kernels next to the origin are looked at.

use super::bands::{HIGHEST, PHASE};
use crate::integrand::Integrand;
use slipzone_api::{Component, LayerResponse, Refusal, contract};

/// Where the stretch ends on which they are found, over the root of the accuracy: what is analytic in the kernels
/// counts by the square of it.
const END: (f64, f64) = (0.3, 1e-5);
/// And where it begins: `z` there over that at its end.
const BEGINNING: f64 = 0.1;
/// `W` at the wave number that belongs to its end: powers of it are as small.
const SMALL: f64 = 0.1;
/// From one wave number to the next that is tried.
const STEP: f64 = 32.0;

/// Distances between which they are found, and how many wave numbers it took to say so.
pub(super) struct Stretch {
    pub(super) ends: (f64, f64),
    pub(super) tried: usize,
}

/// That of some kernels; `None` where `W` does not get small.
pub(super) fn of(
    integrands: &[Integrand],
    response: &dyn LayerResponse,
    (power, length): (f64, f64),
    accuracy: f64,
) -> Result<Option<Stretch>, Refusal> {
    let narrowest = BEGINNING.powf(power.recip());
    let first = 1.0 / (END.0 * accuracy.sqrt()).min(END.1);
    let tried = std::iter::successors(Some(first), |s| Some(s * STEP)).take_while(|s| PHASE * s / narrowest < HIGHEST);
    for (count, s) in (1..).zip(tried) {
        let f = response.surface(s / length)?;
        contract::numbers(&[s / length], &[f])?;
        let size = |integrand: &Integrand| {
            let unit = if integrand.component == Component::Depth { s / length } else { 1.0 };
            (unit * integrand.weight(s / length, &f)).abs()
        };
        if integrands.iter().map(size).fold(0.0, f64::max) < SMALL {
            let end = length / s;
            return Ok(Some(Stretch { ends: (narrowest * end, end), tried: count }));
        }
    }
    Ok(None)
}

impl Stretch {
    /// From which wave number on nothing is asked for.
    pub(super) fn waves(&self) -> f64 {
        PHASE / self.ends.0
    }
}
