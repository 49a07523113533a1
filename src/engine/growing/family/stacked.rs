//! What many slices of a growing contact press and shear at one point.

use super::Family;
use crate::engine::friction::stick_zone::StickZone;
use crate::engine::numerics::lanes::{LANES, Lanes};
use slipzone_api::Station;

/// Places at which a member's pressure is looked at.
const LOOKED_AT: usize = 16;

/// A slice of a stack: a flat punch and the force that it bears.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slice {
    pub(crate) half_width: f64,
    /// By how much it is wider than the point looked at is far from the middle.
    pub(crate) beyond: f64,
    pub(crate) force: f64,
}

impl Family {
    /// The pressure of slices at a point.
    pub(crate) fn stacked_pressure(&mut self, slices: &[Slice], x: f64) -> f64 {
        let unknowns = self.pressed.pressure.numbers.len();
        let (blend, sheet) = self.pressed.spread(&mut self.contact.normal, self.accuracy);
        // A sheet may have more numbers than its unknowns, but sums them side by side.
        self.meter.count_multiplications(slices.len() * sheet.products().min(unknowns));
        let (mut places, mut factors) = ([0.0; LANES], [0.0; LANES]);
        let mut sum = 0.0;
        for slices in slices.chunks(LANES) {
            factors.fill(0.0);
            let lanes = slices.iter().zip(places.iter_mut().zip(&mut factors));
            for (Slice { beyond, force, .. }, (place, factor)) in lanes {
                // Of `b'`, `sqrt(1 - (x/b')^2)`.
                let root = beyond.sqrt() * (2.0 * x + beyond).sqrt();
                *place = sheet.place(Station { x, gap: *beyond });
                *factor = if root > 0.0 { force / root } else { 0.0 };
            }
            blend.functions_into(&half_widths(slices), &mut self.room.side_by_side);
            let mut values = [0.0; LANES];
            sheet.values_into(&self.room.side_by_side, &places, &mut self.room.polynomials, &mut values);
            sum += values.iter().zip(&factors).map(|(value, factor)| value * factor).sum::<f64>();
        }
        sum
    }

    /// Whether the pressure of no member pulls anywhere, as far as a few places tell.
    pub(crate) fn presses(&mut self) -> bool {
        let (blend, sheet) = self.pressed.spread(&mut self.contact.normal, self.accuracy);
        blend.half_widths().chunks(LANES).all(|members| {
            let mut half_widths = [members[0]; LANES];
            half_widths[..members.len()].copy_from_slice(members);
            blend.functions_into(&half_widths, &mut self.room.side_by_side);
            (0..LOOKED_AT).all(|i| {
                let mut values = [0.0; LANES];
                let place = [i as f64 / LOOKED_AT as f64; LANES];
                sheet.values_into(&self.room.side_by_side, &place, &mut self.room.polynomials, &mut values);
                values.iter().all(|p| *p > 0.0)
            })
        })
    }

    /// What the shear of slices lacks to that of full sliding, `eta p - q`, at a point.
    pub(crate) fn stacked_lack(&mut self, slices: &[Slice], x: f64) -> f64 {
        let rubbed = self.rubbed.as_ref().expect("a family with friction");
        self.meter.count_multiplications(slices.len() * rubbed.lack.products());
        let (mut places, mut factors) = ([0.0; LANES], [0.0; LANES]);
        let mut sum = 0.0;
        for slices in slices.chunks(LANES) {
            rubbed.blend.functions_into(&half_widths(slices), &mut self.room.side_by_side);
            let lambda = rubbed.lambda_in_lanes(&self.room.side_by_side);
            factors.fill(0.0);
            let lanes = slices.iter().zip(&lambda).zip(places.iter_mut().zip(&mut factors));
            for ((Slice { half_width, beyond, force }, lambda), (place, factor)) in lanes {
                let gap = StickZone::from_log(*lambda, *half_width).inside(Station { x, gap: *beyond });
                if gap > 0.0 {
                    *place = rubbed.lack.place(Station { x, gap });
                    *factor = force / (beyond.sqrt() * (2.0 * x + beyond).sqrt());
                }
            }
            let mut values = [0.0; LANES];
            rubbed.lack.values_into(&self.room.side_by_side, &places, &mut self.room.polynomials, &mut values);
            sum += values.iter().zip(&factors).map(|(value, factor)| value * factor).sum::<f64>();
        }
        sum
    }
}

/// Those of a few slices, side by side.
fn half_widths(slices: &[Slice]) -> Lanes {
    let mut half_widths = [slices[0].half_width; LANES];
    half_widths.iter_mut().zip(slices).for_each(|(half_width, slice)| *half_width = slice.half_width);
    half_widths
}
