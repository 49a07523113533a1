//! The engine: layer -> flexibility -> kernels -> tractions -> stick zone -> solution.
//!
//! It knows the traits of `slipzone-api` and no plugin by name, prints nothing and reads no file.

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

pub use finite::first_not_finite;
pub(crate) use finite::insist;
pub use solution::{
    EdgeReport, ErrorReport, LoadReport, Plan, PressureReport, Profile, Program, Slip, Solution, Status, StickReport,
};

use crate::scene::Scene;
use rayon::prelude::*;

/// Solves a scene. Whatever happens is in the solution's `status` and `reason`.
pub fn solve(scene: &Scene) -> Solution {
    let (scene, plan) = crate::plan::fill_in(scene);
    match refine::to_tolerance(&scene, plan.clone()) {
        Ok(solution) => solution,
        Err(refusal) => Solution::refused(&scene, plan, refusal.to_string()),
    }
}

/// Solves many scenes on all cores, in the order given; each solution has the bits that [`solve`] gives it.
pub fn solve_all(scenes: &[Scene]) -> Vec<Solution> {
    scenes.par_iter().map(solve).collect()
}

/// Which methods would solve a scene, and why.
pub fn plan(scene: &Scene) -> Plan {
    crate::plan::fill_in(scene).1
}
