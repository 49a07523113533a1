//! Depths of the flat punches of a family against a datum.
//!
//! Over the distance to the datum they change by far more than anything else does, and members that tell the pressures
//! tell too little of that. But each is told by its pressure, and that by these members: so depths are taken at
//! half-widths of their own, even in `asinh(b/datum)`, which is the half-width well within that distance and its
//! logarithm well beyond.

use super::{OF_PRESSURE, blend};
use crate::engine::growing::blend::Blend;
use crate::engine::problem::Problem;
use slipzone_api::Refusal;

/// Half-widths per unknown of the pressure, and more of them where the datum is near.
const PER_UNKNOWN: f64 = 1.0;
const MORE_BY_NEARNESS: f64 = 0.25;
/// Most of them.
const MOST: f64 = 160.0;

/// Depths over `A0` beyond those on a half-plane.
pub(super) struct Depths {
    datum: f64,
    /// In `asinh(b/datum)`.
    blend: Blend,
    coefficients: Vec<f64>,
}

impl Depths {
    /// From the depth at each half-width between two, the rule of the pressure having so many unknowns.
    pub(super) fn new(
        problem: &Problem,
        datum: f64,
        (narrowest, widest): (f64, f64),
        unknowns: usize,
        mut depth: impl FnMut(f64) -> f64,
    ) -> Result<Self, Refusal> {
        let ends = (place(narrowest, datum), place(widest, datum));
        let count = unknowns as f64 * (PER_UNKNOWN + MORE_BY_NEARNESS * ends.1);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // at most MOST
        let blend = blend(problem, ends, count.min(MOST) as usize, OF_PRESSURE)?;
        // What the place rounds must not leave the widest.
        let depths: Vec<f64> = blend.half_widths().iter().map(|s| depth((datum * s.sinh()).min(widest))).collect();
        let coefficients = blend.coefficients(&depths, 1);
        Ok(Self { datum, blend, coefficients })
    }

    pub(super) fn at(&self, half_width: f64) -> f64 {
        self.blend.sum(place(half_width, self.datum), &self.coefficients)
    }
}

fn place(half_width: f64, datum: f64) -> f64 {
    (half_width / datum).asinh()
}
