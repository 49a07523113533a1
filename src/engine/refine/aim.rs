//! What is to be solved, and how fine the steps are that lead there.

use crate::engine::problem::Problem;
use crate::plan::Methods;

/// Tolerances below which that many more of the coarsest levels are left out, which hardly a pressure converges on, or
/// a shear, or a stack of shears. Searches begin with the coarsest of all nevertheless.
///
/// Sixty random flat punches with friction take 4 % less work at 1e-10 with three levels left out below 3e-11 than
/// below 3e-10; growing contacts 2 to 6 % less at 1e-8 with two below 3e-8 than below 5e-9.
const LEFT_OUT: &[f64] = &[1e-7, 1e-9];
const LEFT_OUT_OF_SHEAR: &[f64] = &[1e-7, 5e-9, 3e-11];
const LEFT_OUT_OF_STACKS: &[f64] = &[1e-7, 3e-8, 3e-10];
/// Extra levels of what the scene left open beside a method that it fixed: of the other method.
const BESIDE_PINNED: usize = 3;

/// What is to be solved, how, and how well.
#[derive(Clone, Copy)]
pub(in crate::engine) struct Aim<'a> {
    pub(in crate::engine) problem: &'a Problem,
    pub(in crate::engine) methods: &'a Methods,
    pub(in crate::engine) tolerance: f64,
}

impl Aim<'_> {
    /// Whether the scene fixed a resolution.
    pub(super) fn is_pinned(self) -> bool {
        self.methods.kernel.is_pinned() || self.methods.quadrature.is_pinned()
    }

    /// The level of a step where the scene fixed none.
    pub(super) fn level(self, step: usize) -> usize {
        let first = if self.searches() { 0 } else { self.left_out() };
        first + step
    }

    /// The levels of kernels and quadrature at a step.
    pub(super) fn levels(self, step: usize) -> [u32; 2] {
        let methods = [self.methods.kernel.is_pinned(), self.methods.quadrature.is_pinned()];
        let levels = match methods {
            [false, false] => [self.level(step); 2],
            _ => methods.map(|is_pinned| if is_pinned { step } else { BESIDE_PINNED + step }),
        };
        levels.map(|level| u32::try_from(level).expect("a few steps"))
    }

    /// Whether a stick zone or the size of the contact has to be found.
    pub(super) fn searches(self) -> bool {
        self.problem.friction.is_some() || self.problem.fixed_half_width().is_none()
    }

    /// How many of the coarsest levels hardly anything converges on.
    pub(super) fn left_out(self) -> usize {
        let thresholds = match self.problem.friction {
            None => LEFT_OUT,
            Some(_) if self.problem.is_stacked() => LEFT_OUT_OF_STACKS,
            Some(_) => LEFT_OUT_OF_SHEAR,
        };
        thresholds.iter().filter(|least| self.tolerance < **least).count()
    }
}
