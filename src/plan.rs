//! Which methods solve a scene: what the scene leaves open, the solver chooses here and says why.

use crate::scene::{Layer, LoadKind, Model, Scene};
use serde::Serialize;
use slipzone_api::{
    Base, Flexibility, Friction, FrozenStrain, KernelStrategy, LayerModel, Poisson, Positive, Quadrature, Refusal,
};
use slipzone_flexibilities::{ClosedForm, Compliance};
use slipzone_gradings::Homogeneous;
use slipzone_kernels::{Moments, Octaves, Split};
use slipzone_quadratures::{DeSinc, GradedPanels};
use std::borrow::Cow;
use std::cell::LazyCell;

/// Reasons that a plan most often has.
const USUAL_REASONS: usize = 4;

/// How the numbers were got.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Plan {
    /// Grading, by its `type`.
    pub grading: &'static str,
    /// Flexibility, by its `type`.
    pub flexibility: &'static str,
    /// Kernel strategy, by its `type`.
    pub kernel: &'static str,
    /// Quadrature, by its `type`.
    pub quadrature: &'static str,
    /// Unknowns of the finest pressure problem.
    pub unknowns: usize,
    /// Wave numbers at which the flexibility was evaluated, all resolutions together.
    pub flexibility_evaluations: usize,
    /// Distances at which a kernel was read off its table, all resolutions together.
    pub kernel_evaluations: u64,
    /// Matrices factorised, all resolutions together.
    pub factorisations: usize,
    /// Multiplications in their elimination: `n^3/3` for a matrix and `n^2` for each right-hand side.
    pub operations: u64,
    /// All of that as multiplications, and those of telling the tractions of flat punches in between: what the
    /// [budget](crate::engine::BUDGET) bounds.
    pub work: u64,
    /// What stands for the solid.
    pub model: Model,
    /// Largest relative error that it makes of a number reported, by its bound: part of the errors stated. 0 of the
    /// full model; `None` before anything is solved.
    pub bound: Option<f64>,
    /// How much more friction the coupled equations take for the stick ratio, over Goodman's, as far as that can be
    /// told: what Goodman's approximation costs. It is no part of the errors; `None` without a stick zone.
    pub coupling_neglected: Option<f64>,
    /// Why each choice was made.
    pub reasons: Vec<Cow<'static, str>>,
}

/// The methods that solve a scene.
#[derive(Clone)]
pub(crate) struct Methods {
    pub(crate) flexibility: Box<dyn Flexibility>,
    pub(crate) kernel: Box<dyn KernelStrategy>,
    pub(crate) quadrature: Box<dyn Quadrature>,
}

/// A scene with nothing left open.
#[derive(Clone)]
pub(crate) struct Chosen {
    /// The scene, its methods filled in.
    pub(crate) scene: Scene,
    /// The same methods.
    pub(crate) methods: Methods,
    /// Their names, and why they were chosen.
    pub(crate) plan: Plan,
    /// Whether the scene left all of them open.
    pub(crate) is_open: bool,
}

impl Chosen {
    /// The same with a model in place of the solid: the methods that were left open are those that the model takes.
    pub(crate) fn with(mut self, model: Model, modelled: &Layer, because: String) -> Self {
        if self.is_open {
            let (flexibility, reason) = flexibility_for(modelled.model().ok().as_ref());
            self.plan.flexibility = flexibility.typetag_name();
            self.scene.solver.flexibility = Some(flexibility.clone());
            self.methods.flexibility = flexibility;
            // What was said of the flexibility is said of the model's.
            self.plan.reasons[0] = reason.into();
            if model == Model::CorrectedHalfPlane {
                self.methods.kernel = Box::new(Moments {});
                self.scene.solver.kernel = Some(self.methods.kernel.clone());
                self.plan.kernel = self.methods.kernel.typetag_name();
                self.plan.reasons[1] =
                    "moments: first terms of the kernels in powers of b/h, what they leave out bounded".into();
            }
        }
        self.scene.solver.model = Some(model);
        self.plan.model = model;
        self.plan.reasons.insert(0, because.into());
        self
    }

    /// The scene as it was before a model was chosen.
    pub(crate) fn before_model(&self) -> Scene {
        let mut scene = self.scene.clone();
        if self.is_open {
            scene.solver.flexibility = None;
            scene.solver.kernel = None;
            scene.solver.quadrature = None;
            scene.solver.model = None;
        }
        scene
    }

    /// What solves a scene that leaves its methods open where these refused it: kernels too rough for `split` are told
    /// by `octaves`.
    pub(crate) fn instead(&self, refusal: &Refusal) -> Option<Self> {
        let is_rough =
            matches!(refusal, Refusal::OutOfReach { method, .. } if *method == Split::default().typetag_name());
        (self.is_open && is_rough).then(|| self.by_octaves("octaves: the kernel is too rough beside t = 0 for `split`"))
    }

    /// What may solve a scene that leaves its methods open where the grids that `split` takes do not.
    pub(crate) fn otherwise(&self) -> Option<Self> {
        let because = "octaves: the tolerance was missed on the grids that `split` takes";
        let is_split = self.plan.kernel == Split::default().typetag_name();
        (self.is_open && is_split).then(|| self.by_octaves(because))
    }

    fn by_octaves(&self, because: &'static str) -> Self {
        let mut scene = self.before_model();
        scene.solver.kernel = Some(Box::new(Octaves::default()));
        let mut other = choose(&scene);
        other.plan.reasons.insert(1, because.into());
        other
    }
}

/// Fills in what the scene leaves open.
pub(crate) fn choose(scene: &Scene) -> Chosen {
    let mut scene = scene.clone();
    let is_linear = matches!(scene.friction_needed(), Some(Friction::Goodman { strain: FrozenStrain::Linear, .. }));
    let solver = &mut scene.solver;
    let mut reasons = Vec::with_capacity(USUAL_REASONS);
    let is_open = solver.flexibility.is_none() && solver.kernel.is_none() && solver.quadrature.is_none();
    let mut because = |reason: &'static str| reasons.push(Cow::Borrowed(reason));

    let model = LazyCell::new(|| scene.layer.model().ok());
    let flexibility = solver.flexibility.get_or_insert_with(|| {
        let (flexibility, reason) = flexibility_for(model.as_ref());
        because(reason);
        flexibility
    });
    // Under other quadratures kernels of any power are no better than those that `split` tells.
    let by_panels = solver.quadrature.as_ref().is_none_or(|quadrature| quadrature.typetag_name() == PANELS);
    let is_broken = by_panels && solver.kernel.is_none() && model.as_ref().is_some_and(begins_broken);
    let is_strained =
        is_linear && solver.tolerance.get() <= STRAINED && !model.as_ref().is_some_and(is_homogeneous_half_plane);
    let kernel = solver.kernel.get_or_insert_with(|| {
        if is_broken {
            because(
                "octaves: the grading begins with a power of the depth that is no whole number, and so does the kernel",
            );
            return Box::new(Octaves::default());
        }
        because("split: jump and logarithm of the kernel apart, its error proved");
        Box::new(Split::default())
    });
    let quadrature = solver.quadrature.get_or_insert_with(|| {
        if kernel.typetag_name() == OCTAVES {
            because("graded-panels: the kernel's own singularity, whatever its power, is summed on pieces that shrink towards it");
            return Box::new(GradedPanels::default());
        }
        if is_strained {
            because("graded-panels: the strain C|x| has a kink in the middle of the contact, where panels end");
            return Box::new(GradedPanels::default());
        }
        because("de-sinc: exponential convergence with jumps, logarithms and any edge");
        Box::new(DeSinc::default())
    });
    let power = model.as_ref().and_then(|model| model.law.broken_power());
    if let Some(under) = power.and_then(|power| quadrature.under(power)) {
        *quadrature = under;
    }
    let methods = Methods { flexibility: flexibility.clone(), kernel: kernel.clone(), quadrature: quadrature.clone() };
    reasons.extend(left_out(&scene));
    let plan = Plan {
        grading: scene.layer.grading.typetag_name(),
        flexibility: methods.flexibility.typetag_name(),
        kernel: methods.kernel.typetag_name(),
        quadrature: methods.quadrature.typetag_name(),
        reasons,
        ..Plan::default()
    };
    Chosen { scene, methods, plan, is_open }
}

/// What is not computed because nobody asks for it.
fn left_out(scene: &Scene) -> Vec<Cow<'static, str>> {
    if scene.output.quantities.is_none() {
        return Vec::new();
    }
    let mut reasons = Vec::new();
    if scene.friction.is_some() && scene.friction_needed().is_none() {
        reasons
            .push("frictionless: nothing that is asked for depends on the shear, which does not change the pressure");
    }
    let by_depth = scene.load.kind() == LoadKind::Indentation;
    if !scene.output.asks("load.indentation") && !by_depth && scene.layer.has_depths() {
        reasons.push("no kernel of the depth: the indentation is not asked for");
    }
    if !scene.output.asks("pressure.peak") {
        reasons.push("no search for the peak of the pressure: it is not asked for");
    }
    if !scene.output.asks("profile") {
        reasons.push("no samples of the tractions: no profile is asked for");
    }
    reasons.into_iter().map(Cow::Borrowed).collect()
}

/// The flexibility of a layer that leaves it open, and why.
fn flexibility_for(model: Option<&LayerModel>) -> (Box<dyn Flexibility>, &'static str) {
    if model.is_some_and(has_closed_form) {
        (Box::new(ClosedForm {}), "closed-form: the layer is exponential or homogeneous")
    } else {
        (Box::new(Compliance {}), "compliance: serves any grading")
    }
}

/// The quadrature that sums kernels of any power at the origin, and the strategy that tells them.
const PANELS: &str = "graded-panels";
const OCTAVES: &str = "octaves";

/// From this power on a law that is no analytic function at the surface has as many derivatives there as `split` asks
/// for. Measured, under a cylinder without friction and with it: 3.9 takes `split` 20 and 160 ms at 1e-8, `octaves` 10
/// and 900; 2.5 is not told by `split`.
const SMOOTH: f64 = 3.5;

/// From this tolerance down a strain `C|x|` in the stick zone takes panels that end at its kink: a layer makes a shear of
/// it that is no analytic function there.
///
/// Measured under cylinders on graded layers of 5, 0.5, 0.1 and 0.02 half-widths: `de-sinc` takes 0.2, 0.3, 0.7 and 1.8
/// times as long as panels at 1e-4, 0.2, 1.2, 1.8 and 2.6 times at 1e-5, 0.6, 4.6, 5.7 and 4 times at 1e-6; at 1e-8 it
/// takes 2 to 4 times as long and does not converge on the last two.
const STRAINED: f64 = 1e-5;

/// Whether a solid has no kernels.
pub(crate) fn is_homogeneous_half_plane(model: &LayerModel) -> bool {
    matches!(model.base, Base::Infinite) && model.exponent() == Some(0.0)
}

/// Whether a layer's law has so few derivatives at the surface that its kernels are none of those that `split` knows.
fn begins_broken(model: &LayerModel) -> bool {
    model.law.broken_power().is_some_and(|power| power < SMOOTH)
}

/// Whether the flexibility of a layer is known in closed form.
pub(crate) fn has_closed_form(model: &LayerModel) -> bool {
    matches!(model.base, Base::Rigid | Base::Infinite) && model.exponent().is_some()
}

/// Whether a kernel strategy serves any contact: moments serve narrow ones alone, and are the planner's.
pub(crate) fn serves_any_contact(kernel: &str) -> bool {
    kernel != Moments {}.typetag_name()
}

/// A layer on its base, of its surface's material throughout.
pub(crate) fn homogeneous(layer: &Layer, material: &LayerModel) -> Layer {
    let nu = material.solid.poisson_at(&*material.law, 0.0);
    let modulus = material.surface_shear / material.solid.moduli.shear(1.0, nu);
    let (Ok(modulus), Ok(poisson)) = (Positive::new(modulus), Poisson::new(nu)) else {
        unreachable!("the constants of a solid were checked")
    };
    Layer { poisson, grading: Box::new(Homogeneous { modulus }), ..layer.clone() }
}

/// The half-plane of a layer's surface material.
pub(crate) fn half_plane(layer: &Layer, material: &LayerModel) -> Layer {
    Layer { thickness: None, base: Base::Infinite, datum: None, ..homogeneous(layer, material) }
}
