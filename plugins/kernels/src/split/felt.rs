//! How deep the surface's own law goes on, as far as is felt.

use super::ROUNDING_OF_FLEXIBILITY;
use super::beyond::{CHECKS, Cut};
use super::column::Column;
use slipzone_api::{Component, LayerResponse, Refusal, SurfaceFlexibility};

/// The depth that kernels are cut for, and what that neglects.
pub(super) struct Felt {
    pub(super) depth: f64,
    /// Bound on what is not felt beyond the cut, in the terms of the request.
    pub(super) left: f64,
    pub(super) evaluations: usize,
}

/// Part of the error that what is not felt may take, and that what the cut of the whole layer leaves may.
const SHARE: (f64, f64) = (0.1, 0.5);
/// Where the whole layer is looked at, over the cut that goes with it: what its base sends back, and what the series
/// leaves out, is nothing there.
const BEYOND: f64 = 2.0;
/// From one wave number that is looked at to the next; a power of two, so that parts are whole again.
pub(super) const NEARER: f64 = 4.0;
/// `s d` at which what a depth sends back, powers of it times `exp(-2 s d)`, falls.
const FADES: f64 = 1.0;

impl Felt {
    /// Down to a depth that is known, and nothing is left.
    pub(super) fn down_to(depth: f64) -> Self {
        Self { depth, left: 0.0, evaluations: 0 }
    }

    /// Past breaks, the first of them at the depth `nearest`, of which next to nothing comes back: between two
    /// sublayers of one law, or nearly.
    ///
    /// `cut` is that of a layer without any. Looked at from where the first break fades to longer waves, until
    /// something is seen; the cut is to lie where nothing is.
    pub(super) fn of(
        response: &dyn LayerResponse,
        (columns, cut): (&[Column], Cut),
        (nearest, thickness): (f64, f64),
        (accuracy, reach): (f64, f64),
    ) -> Result<Self, Refusal> {
        let scale = |column: &Column| if column.component == Component::Depth { 1.0 } else { reach };
        let seen = |s: f64, f: &SurfaceFlexibility| {
            let seen = |column: &Column| {
                let rest = column.rest(column.best(cut.cutoff), s, f).abs();
                scale(column) * (rest - ROUNDING_OF_FLEXIBILITY * column.exposed(s, f).max(1.0)).max(0.0)
            };
            columns.iter().map(seen).fold(0.0, f64::max)
        };
        // Over the thickness.
        let mut part = 1.0;
        while BEYOND * cut.cutoff * nearest < FADES * part {
            part /= NEARER;
        }
        let (mut felt, mut before) = (Self::down_to(nearest), 0.0_f64);
        while part <= 1.0 {
            let s = BEYOND * cut.cutoff / part;
            let here = seen(s, &response.surface(s)?);
            felt.evaluations += 1;
            // From here to the one before, or as far as it fades.
            let left = felt.left + NEARER * s * here.max(before);
            if left > SHARE.0 * accuracy {
                return Ok(felt);
            }
            // The one whose cut is no nearer than that, whether or not a series of more terms is enough before.
            let depth = cut.nearest * thickness / s;
            (felt.depth, felt.left, before) = (depth.max(nearest), left, here);
            part *= NEARER;
        }
        let (rest, _) = cut.rest(columns, response, thickness)?;
        felt.evaluations += CHECKS;
        if columns.iter().zip(rest).all(|(column, rest)| scale(column) * rest <= SHARE.1 * accuracy) {
            felt.depth = thickness;
        }
        Ok(felt)
    }
}
