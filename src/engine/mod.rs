//! The engine: layer -> flexibility -> kernels -> tractions -> stick zone -> solution.
//!
//! It knows the traits of `slipzone-api` and no plugin by name, prints nothing and reads no file.

mod assemble;
mod checks;
mod contact;
mod contact_size;
mod error_estimate;
mod finite;
mod layer;
mod lu;
mod normal;
mod problem;
mod refine;
mod solution;
mod stick;
mod stick_search;
mod verdict;

pub use crate::plan::Plan;
pub use finite::first_not_finite;
pub(crate) use finite::insist;
pub use solution::{
    EdgeReport, ErrorReport, LoadReport, PressureReport, Profile, Program, Slip, Solution, Status, StickReport,
};

use crate::plan::{self, Chosen};
use crate::scene::Scene;
use layer::Work;
use problem::Problem;
use rayon::prelude::*;
use slipzone_api::Refusal;

/// Solves a scene. Whatever happens is in the solution's `status` and `reason`.
pub fn solve(scene: &Scene) -> Solution {
    let chosen = plan::choose(scene);
    match attempt(&chosen) {
        Ok(solution) => solution,
        Err(refusal) => Solution::refused(&chosen.scene, chosen.plan, refusal.to_string()),
    }
}

fn attempt(chosen: &Chosen) -> Result<Solution, Refusal> {
    let tolerance = chosen.scene.solver.tolerance.get();
    let problem = Problem::new(&chosen.scene)?;
    let work = Work::default();
    let judged = refine::to_tolerance(&problem, &chosen.methods, tolerance, &work)?;
    let (status, reason) = verdict::verdict(&problem, &judged, tolerance);
    let plan = Plan {
        unknowns: judged.contact.pressure.size(),
        flexibility_evaluations: work.flexibility_evaluations.get(),
        factorisations: work.factorisations.get(),
        ..chosen.plan.clone()
    };
    assemble::solution(&chosen.scene, plan, &problem, &judged, status, reason)
}

/// Solves many scenes on all cores, in the order given; each solution has the bits that [`solve`] gives it.
pub fn solve_all(scenes: &[Scene]) -> Vec<Solution> {
    scenes.par_iter().map(solve).collect()
}

/// Why [`solve`] would refuse a scene before computing anything; `None` where it would try.
pub fn refusal(scene: &Scene) -> Option<Refusal> {
    let chosen = plan::choose(scene);
    match Problem::new(&chosen.scene) {
        Ok(problem) => chosen.methods.flexibility.respond(&problem.layer).err(),
        Err(refusal) => Some(refusal),
    }
}

/// Which methods would solve a scene, and why.
pub fn plan(scene: &Scene) -> Plan {
    plan::choose(scene).plan
}
