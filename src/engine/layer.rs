//! What is known of a layer, carried from one solver to the next.

use super::prepared_layer::PreparedLayer;
use super::refine::FlatPunches;
use crate::plan::choose;
use crate::scene::Scene;
use crate::scene::check::bounds;
use slipzone_api::Refusal;

/// The flexibility of one layer, the kernel tables made of it and the flat punches solved on it, to be used under
/// another punch or load: [`Solver::on`](super::Solver::on) takes it, [`Solver::into_layer`](super::Solver::into_layer)
/// gives it back.
pub struct Layer {
    pub(super) prepared: PreparedLayer,
    /// The layer and the methods as a scene would write them.
    described: String,
    /// Whether it is but a model of the layer described.
    pub(super) is_model: bool,
    /// Its flat punches, and the quadrature they were solved with.
    flat_punches: (String, FlatPunches),
}

impl Layer {
    /// The layer of a scene, with nothing tabulated yet.
    pub fn of(scene: &Scene) -> Result<Self, Refusal> {
        bounds(scene)?;
        let chosen = choose(scene);
        Ok(Self::known(PreparedLayer::of(&chosen)?, &chosen.scene, FlatPunches::default()))
    }

    /// What a solver of that scene knows.
    pub(super) fn known(prepared: PreparedLayer, scene: &Scene, flat_punches: FlatPunches) -> Self {
        let flat_punches = (quadrature(scene), flat_punches);
        Self { prepared, described: description(scene), is_model: false, flat_punches }
    }

    /// The model that stands for a scene's layer; the flat punches on it are of no use to the layer.
    pub(super) fn modelled(prepared: PreparedLayer, scene: &Scene) -> Self {
        Self { is_model: true, ..Self::known(prepared, scene, FlatPunches::default()) }
    }

    /// Whether a scene is about this layer, to be solved by the same flexibility and kernels.
    pub(super) fn is_of(&self, scene: &Scene) -> bool {
        self.described == description(scene)
    }

    /// The layer prepared, and its flat punches where a scene is solved like them.
    pub(super) fn for_scene(self, scene: &Scene) -> (PreparedLayer, FlatPunches) {
        let (solved_with, flat_punches) = self.flat_punches;
        let flat_punches = if solved_with == quadrature(scene) { flat_punches } else { FlatPunches::default() };
        (self.prepared, flat_punches)
    }

    /// Wave numbers at which the flexibility was evaluated so far.
    pub fn flexibility_evaluations(&self) -> usize {
        self.prepared.flexibility_evaluations()
    }

    /// Distances at which its kernels were read so far.
    pub fn kernel_evaluations(&self) -> u64 {
        self.prepared.kernel_evaluations()
    }
}

/// What of a scene the flexibility and its kernels depend on.
fn description(scene: &Scene) -> String {
    let solver = &scene.solver;
    serde_json::to_string(&(&scene.layer, &solver.flexibility, &solver.kernel)).expect("a scene is plain data")
}

/// How a scene's equations are discretised, and how well: flat punches that were solved better than a scene asks for
/// would make its resolutions look nearer to each other than they are to the truth.
fn quadrature(scene: &Scene) -> String {
    let solver = &scene.solver;
    serde_json::to_string(&(&solver.quadrature, solver.tolerance)).expect("a scene is plain data")
}
