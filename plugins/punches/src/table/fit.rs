//! A table's points and the curve that comes closest to them, in the units of the rows.

use super::folded::Folded;
use super::spline::{Piece, at, best};
use slipzone_api::Fault;

/// A slope below this, over the mean one of the rows, is none.
const LEVEL: f64 = 1e-9;

/// A table's points, and the curve that comes closest to them.
pub(super) struct Fit {
    pub(super) folded: Folded,
    /// In scaled units.
    pub(super) pieces: Vec<Piece>,
    /// How many coefficients it has.
    coefficients: usize,
    /// The sum of squares that it leaves over, scaled.
    pub(super) left_over: f64,
}

impl Fit {
    /// The fit of rows with ascending `x`, given in those units.
    pub(super) fn new(rows: &[[f64; 2]], units: [f64; 2]) -> Result<Self, Fault> {
        let folded = Folded::new(rows, units)?;
        let (spline, left_over) = best(&folded.points, folded.distances, folded.rounding);
        let pieces = spline.pieces();
        let coefficients = 1 + usize::from(spline.corner > 0.0) + spline.bends.len();
        Ok(Self { folded, pieces, coefficients, left_over })
    }

    /// Whether it does so outwards.
    pub(super) fn rises(&self) -> bool {
        self.pieces.last().is_some_and(|piece| piece.slope(1.0) > LEVEL)
    }

    /// How far a row is above it, in the unit of the rows.
    pub(super) fn off(&self, [x, height]: [f64; 2]) -> f64 {
        let Folded { reach, range, tip, .. } = &self.folded;
        let x = x.abs() / reach;
        height - (tip + range * at(&self.pieces, x).height(x))
    }

    /// The sum of squares that it leaves over, in the unit of the rows.
    pub(super) fn left_over(&self) -> f64 {
        self.left_over * self.folded.range * self.folded.range
    }

    /// What rounding makes of heights, and the last decimal to which they are given.
    pub(super) fn rounding(&self) -> f64 {
        self.folded.rounding * self.folded.range
    }

    pub(super) fn decimal(&self) -> f64 {
        self.folded.decimal * self.folded.range
    }

    /// How many more points it has than coefficients; `None` where none.
    pub(super) fn spare(&self) -> Option<f64> {
        let spare = self.folded.points.len().checked_sub(self.coefficients).filter(|spare| *spare > 0)?;
        Some(spare as f64)
    }
}
