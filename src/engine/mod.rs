//! The engine: layer -> flexibility -> kernels -> tractions -> stick zone -> solution.
//!
//! Each line uses those above it:
//!
//! | module | |
//! |---|---|
//! | `numerics`, `work` | tools that know nothing of contacts; the work that a scene may take, counted |
//! | `accuracy` | what a result reports, and how sure each number is |
//! | `foreign`, `problem`, `prepared_layer` | what plugins tell of themselves, looked over; the scene in the layer's units; its layer with flexibility and kernels |
//! | `pressure`, `friction` | the parts of one contact at one resolution |
//! | `outcome`, `contact`, `growing` | what a resolution answers: a contact solved at once, or as a stack of the flat punches that it grew through |
//! | `refine` | resolutions, until the estimate meets the tolerance |
//! | `verdict`, `assemble`, `solution` | whether to believe it, and the result in the scene's units |
//! | `stand_in`, `layer`, `culprit`, `solver` | a cheaper solid where one will do; what one load leaves to the next; whose numbers are none where it fails |
//! | `portrait` | what a layer looks like, whether or not it is solved |
//!
//! It knows the traits of `slipzone-api` and no plugin by name, prints nothing and reads no file.

mod accuracy;
mod assemble;
mod contact;
mod culprit;
pub(crate) mod foreign;
mod friction;
mod growing;
mod layer;
pub(crate) mod numerics;
mod outcome;
mod portrait;
mod prepared_layer;
mod pressure;
mod problem;
mod refine;
mod solution;
mod solver;
mod stand_in;
mod verdict;
mod work;

use crate::caught::caught;
pub use crate::plan::Plan;
pub use layer::Layer;
pub use portrait::{DepthProfile, FlexibilityProfile, response};
pub use solution::finite::first_not_finite;
pub(crate) use solution::finite::insist;
pub use solution::loading_curve::Curve;
pub use solution::{
    EdgeReport, ErrorReport, LoadReport, PressureReport, Profile, Program, Slip, Solution, Status, StickReport,
};
pub use solver::Solver;
pub use work::budget::BUDGET;

use crate::plan;
use crate::scene::Scene;
use rayon::prelude::*;
use slipzone_api::Refusal;

/// Solves a scene. Whatever happens is in the solution's `status` and `reason`; but a plugin's panic is passed on, here
/// and in
/// [`solve_all`].
pub fn solve(scene: &Scene) -> Solution {
    solve_within(scene, BUDGET)
}

/// [`solve`] with another budget of work than [`BUDGET`].
pub fn solve_within(scene: &Scene, budget: u64) -> Solution {
    match Solver::prepare(plan::choose(scene)) {
        Ok(mut solver) => {
            solver.limit(budget);
            solver.solve()
        }
        Err((refusal, chosen)) => Solution::refused(&chosen.scene, chosen.plan, refusal.to_string()),
    }
}

/// [`solve`] for programs that go on: a panic is a refusal, too.
#[cfg(feature = "cli")]
pub(crate) fn solve_caught(scene: &Scene) -> Solution {
    caught(|| solve(scene)).unwrap_or_else(|why| Solution::refused(scene, Plan::default(), why))
}

/// Solves many scenes on all cores, in the order given; each solution has the bits that [`solve`] gives it.
pub fn solve_all(scenes: &[Scene]) -> Vec<Solution> {
    scenes.par_iter().map(solve).collect()
}

/// Why [`solve`] would refuse a scene before computing anything; `None` where it would try.
pub fn refusal(scene: &Scene) -> Option<Refusal> {
    Solver::new(scene).map_or_else(Some, |solver| solver.would_refuse())
}

/// Which model and which methods would solve a scene, and why.
pub fn plan(scene: &Scene) -> Plan {
    match Solver::prepare(plan::choose(scene)) {
        Ok(solver) => solver.planned(),
        Err((_, chosen)) => chosen.plan,
    }
}
