//! The engine: layer -> flexibility -> kernels -> tractions -> stick zone -> solution.
//!
//! It knows the traits of `slipzone-api` and no plugin by name, prints nothing and reads no file.

mod assemble;
mod blend;
mod budget;
mod carrier;
mod chebyshev;
mod checks;
mod climb;
mod contact;
mod contact_size;
mod counted;
mod coupling;
mod dense;
mod elimination;
mod error_estimate;
mod family;
mod finite;
mod growing;
mod half_plane_depth;
mod half_plane_shear;
mod judged;
mod lanes;
mod layer;
mod linear_strain;
mod loading_curve;
mod lookout;
mod normal;
mod outcome;
mod portrait;
mod prepared_layer;
mod problem;
mod quantity;
mod refine;
pub(crate) mod root;
mod rubbing;
mod sharpen;
mod sheet;
mod slip_grid;
mod solution;
mod solver;
mod stack;
mod stage;
mod stand_in;
mod stick;
mod stick_search;
mod stick_zone;
mod strain;
mod thin;
mod verdict;
mod ways;
mod work;

pub use crate::plan::Plan;
pub use budget::BUDGET;
pub use finite::first_not_finite;
pub(crate) use finite::insist;
pub use layer::Layer;
pub use loading_curve::Curve;
pub use portrait::{DepthProfile, FlexibilityProfile, response};
pub use solution::{
    EdgeReport, ErrorReport, LoadReport, PressureReport, Profile, Program, Slip, Solution, Status, StickReport,
};
pub use solver::Solver;

use crate::plan;
use crate::scene::Scene;
use problem::Problem;
use rayon::prelude::*;
use slipzone_api::Refusal;

/// Solves a scene. Whatever happens is in the solution's `status` and `reason`.
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

/// Solves many scenes on all cores, in the order given; each solution has the bits that [`solve`] gives it.
pub fn solve_all(scenes: &[Scene]) -> Vec<Solution> {
    scenes.par_iter().map(solve).collect()
}

/// Why [`solve`] would refuse a scene before computing anything; `None` where it would try.
pub fn refusal(scene: &Scene) -> Option<Refusal> {
    Solver::new(scene).map_or_else(Some, |solver| solver.would_refuse())
}

/// Which methods would solve a scene, and why.
pub fn plan(scene: &Scene) -> Plan {
    let chosen = plan::choose(scene);
    match Problem::new(&chosen.scene).map(|problem| solver::decided(chosen.clone(), problem)) {
        Ok(Ok((chosen, ..))) => chosen.plan,
        _ => chosen.plan,
    }
}
