//! Which methods solve a scene: what the scene leaves open, the solver chooses here and says why.

use crate::scene::Scene;
use serde::Serialize;
use slipzone_api::{Flexibility, KernelStrategy, Quadrature};
use slipzone_flexibilities::Compliance;
use slipzone_kernels::Truncated;
use slipzone_quadratures::GaussChebyshev;

/// How the numbers were got.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Plan {
    /// Grading, by its `type`.
    pub grading: String,
    /// Flexibility, by its `type`.
    pub flexibility: String,
    /// Kernel strategy, by its `type`.
    pub kernel: String,
    /// Quadrature, by its `type`.
    pub quadrature: String,
    /// Unknowns of the finest pressure problem.
    pub unknowns: usize,
    /// Wave numbers at which the flexibility was evaluated, all resolutions together.
    pub flexibility_evaluations: usize,
    /// Matrices factorised, all resolutions together.
    pub factorisations: usize,
    /// Why each choice was made.
    pub reasons: Vec<String>,
}

/// The methods that solve a scene.
pub(crate) struct Methods {
    pub(crate) flexibility: Box<dyn Flexibility>,
    pub(crate) kernel: Box<dyn KernelStrategy>,
    pub(crate) quadrature: Box<dyn Quadrature>,
}

/// A scene with nothing left open.
pub(crate) struct Chosen {
    /// The scene, its methods filled in.
    pub(crate) scene: Scene,
    /// The same methods.
    pub(crate) methods: Methods,
    /// Their names, and why they were chosen.
    pub(crate) plan: Plan,
}

/// Fills in what the scene leaves open.
pub(crate) fn choose(scene: &Scene) -> Chosen {
    let mut scene = scene.clone();
    let solver = &mut scene.solver;
    let mut reasons = Vec::new();
    let mut because = |reason: &str| reasons.push(reason.to_owned());

    let flexibility = solver.flexibility.get_or_insert_with(|| {
        because("compliance: stable at every wave number and gradient");
        Box::new(Compliance {})
    });
    let kernel = solver.kernel.get_or_insert_with(|| {
        because("truncated: the one strategy there is");
        Box::new(Truncated::default())
    });
    let quadrature = solver.quadrature.get_or_insert_with(|| {
        because("gauss-chebyshev: the one quadrature there is");
        Box::new(GaussChebyshev::default())
    });
    let methods = Methods { flexibility: flexibility.clone(), kernel: kernel.clone(), quadrature: quadrature.clone() };
    let plan = Plan {
        grading: scene.layer.grading.typetag_name().into(),
        flexibility: methods.flexibility.typetag_name().into(),
        kernel: methods.kernel.typetag_name().into(),
        quadrature: methods.quadrature.typetag_name().into(),
        reasons,
        ..Plan::default()
    };
    Chosen { scene, methods, plan }
}
