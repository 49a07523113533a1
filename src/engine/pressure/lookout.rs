//! Where a pressure is looked at for what happens between the points reported.

use crate::engine::numerics::climb::{NEARLY, highest};
use crate::engine::numerics::ways;
use slipzone_api::{Station, lend};
use std::cell::Cell;

/// Points on either side of the middle of a part of the contact between places where the pressure is not analytic, and
/// where there are many such parts.
const POINTS: usize = 10;
const FEW_POINTS: usize = 5;
/// So many parts are many.
const MANY: usize = 4;

thread_local! {
    /// That of this thread, unless it is in use.
    static ROOM: Cell<Lookout> = Cell::default();
}

/// Ascending points of half of a contact or of its stick zone, and what is found there.
#[derive(Default)]
pub(crate) struct Lookout {
    pub(crate) at: Vec<Station>,
    pub(crate) values: Vec<f64>,
    /// The same points seen otherwise, and what is found there.
    pub(crate) seen: Vec<Station>,
    pub(crate) beside: Vec<f64>,
}

impl Lookout {
    /// Lends that of this thread.
    pub(crate) fn lend<T>(work: impl FnOnce(&mut Self) -> T) -> T {
        lend(&ROOM, work)
    }

    /// Points between places where a pressure is not analytic, the middle and the edge at `b` among them, and at all of
    /// these but the edge; ever denser towards them, for what happens beside them may be of any width.
    pub(crate) fn between(&mut self, ends: &[f64], b: f64) {
        let grid = ways::rough_grid(if ends.len() > MANY { FEW_POINTS } else { POINTS });
        self.at.clear();
        self.at.push(Station { x: 0.0, gap: b });
        for ends in ends.windows(2) {
            let (from, to) = (ends[0], ends[1]);
            let length = to - from;
            self.at.extend(
                grid.iter()
                    .map(|node| Station { x: from + length * node.from_lower, gap: (b - to) + length * node.to_upper }),
            );
            if to < b {
                self.at.push(Station { x: to, gap: b - to });
            }
        }
    }

    /// The points at which the equations of something within a half-width are collocated, for it has no details that
    /// these do not tell, and the middle.
    pub(crate) fn at_collocation(&mut self, half_width: f64, points: &[Station]) {
        self.at.clear();
        self.at.push(Station { x: 0.0, gap: half_width });
        self.at.extend(points.iter().filter(|at| at.x > 0.0));
    }

    /// The largest pressure, from how it is found at points.
    pub(crate) fn peak(&mut self, pressure_into: impl FnMut(&[Station], &mut [f64])) -> f64 {
        let Self { at, values, .. } = self;
        highest(at, values, |most| NEARLY * most, pressure_into).map_or(f64::NAN, |(_, peak)| peak)
    }
}
