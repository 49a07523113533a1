//! The contact kernels `k(t)`.

use crate::{LayerResponse, Refusal};
use std::fmt::Debug;

/// Which kernel. All are scaled by `A0` (theory.md section 3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Component {
    /// `k_vv = int M_vv sin(st) ds`: slope of the surface by pressure; odd.
    NormalSlope,
    /// `k_uu = int M_uu sin(st) ds`: strain of the surface by shear; odd.
    ShearStrain,
    /// `k_uv = int M_uv cos(st) ds`: the coupling; even.
    Coupling,
    /// `G/A0 = int Fvv/A0 cos(st) ds`: depth of the surface by pressure; even, `-log|t|` at the origin.
    /// On a half-plane it is fixed only up to a constant and no strategy offers it.
    Depth,
}

impl Component {
    /// Whether `k(-t) = -k(t)`.
    pub fn is_odd(self) -> bool {
        matches!(self, Self::NormalSlope | Self::ShearStrain)
    }
}

/// A kernel at one distance, as it really is: `k(t) = smooth + sign(t) * sign_part + log|t| * log_part`.
///
/// All three parts are analytic in `t` with radius of convergence of the order of the layer's thickness.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Parts {
    /// `A(t)`.
    pub smooth: f64,
    /// `E(t)`, the factor of `sign(t)`.
    pub sign: f64,
    /// `O(t)`, the factor of `log|t|`.
    pub log: f64,
}

impl Parts {
    /// The kernel's value at `t`; at `t = 0` the mean of both sides, logarithm left out.
    pub fn value(self, t: f64) -> f64 {
        if t == 0.0 {
            return self.smooth;
        }
        let log = if self.log == 0.0 { 0.0 } else { self.log * t.abs().ln() };
        self.smooth + self.sign * t.signum() + log
    }
}

/// What the engine wants to know of the kernels.
#[derive(Clone, Copy, Debug)]
pub struct KernelRequest<'a> {
    /// Largest `|t|` that will be asked for, in units of the thickness.
    pub reach: f64,
    /// The kernels that will be asked for; nothing else is tabulated.
    pub components: &'a [Component],
    /// Error wanted: of `reach` times the kernel for the slopes and the coupling, of the kernel itself for
    /// [`Component::Depth`]. A strategy that does not know its error takes no notice.
    pub accuracy: f64,
}

/// Config half: how the kernels are got from the flexibility (such as `truncated`).
#[typetag::serde(tag = "type")]
pub trait KernelStrategy: dyn_clone::DynClone + Debug + Send + Sync {
    /// Evaluates the flexibility where it must and builds the tables.
    fn tabulate(&self, response: &dyn LayerResponse, request: &KernelRequest) -> Result<Box<dyn KernelTable>, Refusal>;

    /// The same strategy at a resolution at least `2^level` times as fine: fine enough to judge this one.
    /// One whose tables bound their own error may return itself.
    fn refined(&self, level: u32) -> Box<dyn KernelStrategy>;

    /// Whether the scene itself fixed the resolution.
    fn is_pinned(&self) -> bool;
}
dyn_clone::clone_trait_object!(KernelStrategy);

/// Run-time half: kernels tabulated over a range of lengths.
pub trait KernelTable: Send + Sync {
    /// `out[i]` = parts of the kernel at `distances[i]`, of either sign and within the requested reach.
    ///
    /// # Panics
    /// When the slices differ in length or the component was not requested.
    fn parts_into(&self, component: Component, distances: &[f64], out: &mut [Parts]);

    /// `out[i]` = the kernel's value at `distances[i]`, of either sign but not 0, and within the reach.
    ///
    /// # Panics
    /// As [`Self::parts_into`].
    fn values_into(&self, component: Component, distances: &[f64], out: &mut [f64]) {
        let mut parts = vec![Parts::default(); distances.len()];
        self.parts_into(component, distances, &mut parts);
        for ((out, parts), t) in out.iter_mut().zip(parts).zip(distances) {
            *out = parts.value(*t);
        }
    }

    /// Bound on the error, in the terms of [`KernelRequest::accuracy`], by the strategy's own proof; `None`
    /// where it has none and only a refined twin can tell.
    fn error(&self) -> Option<f64> {
        None
    }

    /// The shortest length over which the parts vary (distance of their nearest complex singularity, about):
    /// what a sum over points must resolve, in units of the thickness.
    fn length(&self) -> f64;

    /// Number of wave numbers at which the flexibility was evaluated.
    fn flexibility_evaluations(&self) -> usize;
}
