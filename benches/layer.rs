//! The layer on which single stages are measured, in its own units.

use slipzone::api::{
    Base, Component, Flexibility, KernelRequest, LayerModel, LayerResponse, Moduli, ModulusLaw, Plane, Poisson, Solid,
};
use slipzone_flexibilities::Compliance;
use std::sync::Arc;

/// Half-width of the contact: the layer is five of them thick.
pub(crate) const HALF_WIDTH: f64 = 0.2;

/// What the pressure needs.
pub(crate) const NORMAL: &[Component] = &[Component::NormalSlope, Component::Depth];
/// What friction needs.
pub(crate) const ALL: &[Component] =
    &[Component::NormalSlope, Component::ShearStrain, Component::Coupling, Component::Depth];

/// Kernels over the contact.
pub(crate) fn request(components: &[Component]) -> KernelRequest<'_> {
    KernelRequest { reach: 2.0 * HALF_WIDTH, components, accuracy: 1e-10 }
}

/// Plane strain, Poisson's ratio 0.3, on a rigid base.
pub(crate) fn bonded(law: Box<dyn ModulusLaw>) -> Arc<LayerModel> {
    let poisson = Poisson::new(0.3).expect("a constant in range");
    let solid = Solid { plane: Plane::Strain, poisson, moduli: Moduli::Shear };
    Arc::new(LayerModel::new(law, solid, Base::Rigid))
}

/// Eight times as stiff at the base.
pub(crate) fn graded() -> Arc<LayerModel> {
    bonded(Box::new(Octupled))
}

/// Its flexibility by the method that serves everywhere.
pub(crate) fn response(layer: &Arc<LayerModel>) -> Box<dyn LayerResponse> {
    Compliance {}.respond(layer).expect("an exponential law on a rigid base")
}

#[derive(Debug)]
struct Octupled;

impl ModulusLaw for Octupled {
    fn modulus(&self, depth: f64) -> f64 {
        8.0_f64.powf(depth)
    }

    fn exponent(&self) -> Option<f64> {
        Some(8.0_f64.ln())
    }
}
