//! Which methods solve a scene: what the scene leaves open, the solver chooses here and says why.

use crate::engine::Plan;
use crate::scene::Scene;
use slipzone_flexibilities::Compliance;
use slipzone_kernels::Truncated;
use slipzone_quadratures::GaussChebyshev;

/// The scene with every method filled in, and the plan that says which and why.
pub(crate) fn fill_in(scene: &Scene) -> (Scene, Plan) {
    let mut scene = scene.clone();
    let mut plan = Plan { grading: scene.layer.grading.typetag_name().into(), ..Plan::default() };

    let flexibility = scene.solver.flexibility.get_or_insert_with(|| {
        plan.reasons.push("compliance: stable at every wave number and gradient".into());
        Box::new(Compliance {})
    });
    plan.flexibility = flexibility.typetag_name().into();
    let kernel = scene.solver.kernel.get_or_insert_with(|| {
        plan.reasons.push("truncated: the one strategy there is".into());
        Box::new(Truncated::default())
    });
    plan.kernel = kernel.typetag_name().into();
    let quadrature = scene.solver.quadrature.get_or_insert_with(|| {
        plan.reasons.push("gauss-chebyshev: the one quadrature there is".into());
        Box::new(GaussChebyshev::default())
    });
    plan.quadrature = quadrature.typetag_name().into();
    (scene, plan)
}
