//! The strain that is left on the surface where it stuck.

use super::Growing;
use crate::engine::friction::strain::{Sampling, Strains};
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::pressure::normal::Normal;
use crate::engine::problem::Problem;
use slipzone_api::Refusal;

/// Points of the contact closer than that, relative to how far out they are, are one: nothing is to be told in between.
const NO_PIECE: f64 = 1e-11;
/// By how much more finely tractions are sampled for each `e` of `b/a`: on layers what grew from a hundred times
/// narrower may have stuck anywhere in a narrow zone.
///
/// Measured under a cylinder on a layer 2.5 times as thick as the contact is wide, zones of 1e-8 to 1e-50 of it:
/// strains known to 1e-4 with none, 1e-6 with 0.02, 1e-7 with 0.05 and with 0.1.
const MORE_IF_NARROW: f64 = 0.05;
/// How many times as far out as it begins a piece ends at most.
const FARTHER: f64 = 1e3;

impl Growing {
    /// The strain left on the surface at points of the stick zone, `x >= 0`; `None` where it cannot be told, and at
    /// points under which the pressure is unbounded.
    pub(crate) fn strain(
        &mut self,
        layer: &PreparedLayer,
        problem: &Problem,
        normal: &Normal,
        (at, wanted): (&[f64], f64),
    ) -> Result<Option<Strains<Option<f64>>>, Refusal> {
        if self.has_no_shear() {
            return Ok(Some(Strains { each: vec![Some(0.0); at.len()], apart: 0.0 }));
        }
        let (Some(family), Some(stack), None) = (&mut self.family, &self.stack, &self.broken) else { return Ok(None) };
        let b = self.half_width;
        let zone = family.zone(b);
        let kinks: Vec<f64> = stack.breaks().iter().copied().filter(|kink| *kink > 0.0 && *kink < b).collect();
        // Under the face the surface has stuck from the start.
        let face = problem.face();
        let never_slipped = if face > 0.0 && face < b { family.zone(face).half_width } else { 0.0 };
        let mut breaks: Vec<f64> = kinks.iter().map(|kink| family.zone(*kink).half_width).collect();
        breaks.extend(kinks.into_iter().chain([0.0, zone.half_width]));
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|next, before| *next - *before < NO_PIECE * *next);
        breaks.retain(|end| *end < b * (1.0 - NO_PIECE));
        // Of a slip zone too narrow to be a piece nothing has to be resolved.
        let is_piece = breaks.last().is_some_and(|end| *end >= zone.half_width * (1.0 - NO_PIECE));
        breaks.push(b);
        let breaks = graded(&breaks);
        // What touched first was not strained yet when it stuck, and a corner has no strain.
        let is_unstrained = |x: f64| x < never_slipped || x == 0.0 && !problem.is_corner(x);
        let asked: Vec<f64> = at.iter().copied().filter(|x| !is_unstrained(*x) && !problem.is_corner(*x)).collect();
        let corners: Vec<f64> = problem.corners().filter(|corner| *corner > 0.0).collect();
        let crowding = if is_piece { zone.crowding() } else { 1.0 }.max(1.0 - MORE_IF_NARROW * zone.log());
        let length = layer.length();
        let sampling = Sampling { breaks: &breaks, corners: &corners, crowding, length };
        let a0 = problem.elastic.a0();
        let found = sampling.strains(layer, problem.elastic.beta(), (&asked, wanted / a0), |at| {
            let mut pressure = vec![0.0; at.len()];
            self.pressure_into(problem, normal, at, &mut pressure);
            let shear = self.shear(problem, at, &pressure)?;
            Some([pressure, shear])
        })?;
        let Some(found) = found else { return Ok(None) };
        let mut strains = found.each.iter().map(|strain| a0 * strain);
        let one = |x: &f64| match *x {
            x if is_unstrained(x) => Some(0.0),
            x if problem.is_corner(x) => None,
            _ => strains.next(),
        };
        Ok(Some(Strains { each: at.iter().map(one).collect(), apart: a0 * found.apart }))
    }
}

/// The same breaks, and more of them where a piece reaches very much farther out than it begins: seen from within a
/// narrow stick zone what slides acts in proportion to `dr/r` all the way from the zone's end to the contact's.
fn graded(breaks: &[f64]) -> Vec<f64> {
    let mut all = Vec::with_capacity(breaks.len());
    for ends in breaks.windows(2) {
        let (lower, upper) = (ends[0], ends[1]);
        all.push(lower);
        // The piece in the middle is sampled towards it anyway.
        let farther = if lower > 0.0 { (upper / lower).ln() } else { 0.0 };
        let parts = (farther / FARTHER.ln()).ceil();
        let mut part = 1.0;
        while part < parts {
            all.push(lower * (farther * part / parts).exp());
            part += 1.0;
        }
    }
    all.extend(breaks.last());
    all
}
