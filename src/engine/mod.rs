//! The engine: layer -> flexibility -> kernels -> tractions -> stick zone -> solution.
//!
//! It knows the traits of `slipzone-api` and no plugin by name, prints nothing and reads no file.

mod solution;

pub use solution::{
    EdgeReport, ErrorReport, LoadReport, Plan, PressureReport, Profile, Program, Slip, Solution, Status, StickReport,
};

use crate::scene::Scene;

/// Solves a scene. Whatever happens is in the solution's `status` and `reason`.
pub fn solve(scene: &Scene) -> Solution {
    Solution::refused(scene, "not built yet".into())
}

/// How a scene would be solved, without solving it.
pub fn plan(_scene: &Scene) -> Plan {
    Plan::default()
}
