//! What a resolution is asked, and what it answers.

use super::prepared_layer::Wanted;
use super::problem::Problem;
use crate::engine::accuracy::error_estimate::Seen;
use crate::engine::accuracy::quantity::{Numbers, Quantity, Traces};
use crate::engine::friction::rubbing::Rubbing;
use crate::engine::pressure::contact_size::Size;

/// What one resolution found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Outcome {
    /// The numbers reported, in layer units.
    pub(crate) numbers: Numbers,
    pub(crate) rubbing: Option<Rubbing>,
    pub(crate) size: Option<Size>,
    /// The pressure at [`Traces::AT`] over its mean.
    pub(super) pressure: [f64; Traces::AT.len()],
    /// Of a contact that grew: what its stack loses.
    pub(crate) lost: Option<Lost>,
}

impl Outcome {
    /// What it tells of the next resolution.
    pub(crate) fn seen(&self) -> Seen {
        let shear = self.rubbing.as_ref().and_then(|rubbing| rubbing.shear);
        let traces = Traces { pressure: self.pressure, shear, is_stacked: self.lost.is_some() };
        let mut numbers = self.numbers;
        if self.rubbing.as_ref().is_some_and(|rubbing| rubbing.is_full) {
            // A zone that is all of the contact is no number that converges.
            for quantity in [Quantity::StickHalfWidth, Quantity::StickRatio, Quantity::OneMinusRatio] {
                numbers.take(quantity);
            }
        }
        Seen { numbers, traces }
    }
}

/// What a stack loses, relative.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Lost {
    /// By its integrals and the series of its force.
    pub(crate) stacked: f64,
    /// The same of a pressure exactly at a kink of the shape.
    pub(crate) at_kinks: f64,
    pub(crate) left: Left,
}

/// What series over the half-width leave between the members, relative: of a force, of a pressure that is stacked of
/// its growth, and of the shear. Two resolutions may leave the same.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Left {
    pub(crate) force: f64,
    pub(crate) pressure: f64,
    pub(crate) shear: f64,
}

/// What a resolution needs to know beside its own scratch.
#[derive(Clone, Copy)]
pub(crate) struct Task<'a> {
    pub(crate) problem: &'a Problem,
    pub(crate) wanted: Wanted,
    pub(crate) tolerance: f64,
}

impl Task<'_> {
    /// The friction coefficient, where there is friction.
    pub(crate) fn friction(&self) -> f64 {
        self.problem.friction.expect("only with friction")
    }
}
