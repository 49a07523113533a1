//! The contact kernels `k(t)`.

use crate::elementary::ln;
use crate::{LayerResponse, Refusal};
use std::fmt::Debug;
use std::ops::Range;

/// Distance of a kernel's nearest complex singularity, but for that at the origin, in terms of [`KernelTable::length`],
/// at the least.
pub const NEAREST_POLE: f64 = 0.77;

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
    /// On a half-plane it is fixed only up to a constant: there it is told against the depth of a datum
    /// ([`LayerResponse::against_datum`](crate::LayerResponse::against_datum)), or not at all.
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
        let log = if self.log == 0.0 { 0.0 } else { self.log * ln(t.abs()) };
        self.smooth + self.sign * t.signum() + log
    }
}

/// Room for the parts at many distances, an array for each part: all of one length.
#[derive(Debug)]
pub struct PartsMut<'a> {
    /// `A`.
    pub smooth: &'a mut [f64],
    /// `E`.
    pub sign: &'a mut [f64],
    /// `O`.
    pub log: &'a mut [f64],
}

impl PartsMut<'_> {
    /// Writes `parts(t)` for each distance `t`.
    ///
    /// # Panics
    /// When there is not one place for each distance.
    pub fn fill(self, distances: &[f64], mut parts: impl FnMut(f64) -> Parts) {
        self.assert_len(distances.len());
        let places = self.smooth.iter_mut().zip(self.sign).zip(self.log);
        for (((smooth, sign), log), t) in places.zip(distances) {
            Parts { smooth: *smooth, sign: *sign, log: *log } = parts(*t);
        }
    }

    /// Checks that there is one place for each of `count` distances.
    ///
    /// # Panics
    /// When there is not.
    pub fn assert_len(&self, count: usize) {
        let lengths = [self.smooth.len(), self.sign.len(), self.log.len()];
        assert_eq!(lengths, [count; 3], "one set of parts for each distance");
    }
}

/// The parts at many distances, an array for each part.
#[derive(Clone, Debug, Default)]
pub struct PartsVec {
    /// `A`.
    pub smooth: Vec<f64>,
    /// `E`.
    pub sign: Vec<f64>,
    /// `O`.
    pub log: Vec<f64>,
}

impl PartsVec {
    /// Room for as many distances.
    pub fn new(count: usize) -> Self {
        Self { smooth: vec![0.0; count], sign: vec![0.0; count], log: vec![0.0; count] }
    }

    /// Makes room for as many distances.
    pub fn resize(&mut self, count: usize) {
        self.smooth.resize(count, 0.0);
        self.sign.resize(count, 0.0);
        self.log.resize(count, 0.0);
    }

    /// The first `count` places, to be written.
    ///
    /// # Panics
    /// When there are fewer.
    pub fn first(&mut self, count: usize) -> PartsMut<'_> {
        PartsMut { smooth: &mut self.smooth[..count], sign: &mut self.sign[..count], log: &mut self.log[..count] }
    }

    /// The parts at a range of distances.
    ///
    /// # Panics
    /// When there are not as many.
    pub fn range(&self, range: Range<usize>) -> impl Iterator<Item = Parts> + Clone {
        let both = self.smooth[range.clone()].iter().zip(&self.sign[range.clone()]);
        both.zip(&self.log[range]).map(|((smooth, sign), log)| Parts { smooth: *smooth, sign: *sign, log: *log })
    }

    /// The parts at the `i`-th distance.
    ///
    /// # Panics
    /// When there are not as many.
    pub fn at(&self, i: usize) -> Parts {
        Parts { smooth: self.smooth[i], sign: self.sign[i], log: self.log[i] }
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
    /// Whether it tells the kernels of such a flexibility at all, as far as that is known without any table.
    ///
    /// # Errors
    /// What [`Self::tabulate`] refuses whatever the request.
    fn serves(&self, response: &dyn LayerResponse) -> Result<(), Refusal> {
        let _ = response;
        Ok(())
    }

    /// Evaluates the flexibility where it must and builds the tables. Nothing else bounds its work: the wave numbers
    /// are counted when the tables are there, and how long these take to be read is not known to those who read them.
    ///
    /// # Errors
    /// What it cannot tell, or not with bounded work.
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
    /// The parts of the kernel at each of the `distances`, of either sign and within the requested reach.
    ///
    /// # Panics
    /// When the slices differ in length or the component was not requested.
    fn parts_into(&self, component: Component, distances: &[f64], out: PartsMut);

    /// [`Self::parts_into`] at one distance.
    fn parts(&self, component: Component, distance: f64) -> Parts {
        let Parts { mut smooth, mut sign, mut log } = Parts::default();
        let [smooth, sign, log] = [&mut smooth, &mut sign, &mut log].map(std::slice::from_mut);
        self.parts_into(component, &[distance], PartsMut { smooth, sign, log });
        Parts { smooth: smooth[0], sign: sign[0], log: log[0] }
    }

    /// `out[i]` = the kernel's value at `distances[i]`, of either sign but not 0, and within the reach.
    ///
    /// # Panics
    /// As [`Self::parts_into`].
    fn values_into(&self, component: Component, distances: &[f64], out: &mut [f64]) {
        assert_eq!(distances.len(), out.len(), "one value for each distance");
        let mut parts = PartsVec::new(distances.len());
        self.parts_into(component, distances, parts.first(distances.len()));
        for (i, (out, t)) in out.iter_mut().zip(distances).enumerate() {
            *out = parts.at(i).value(*t);
        }
    }

    /// Bound on the error, in the terms of [`KernelRequest::accuracy`], by the strategy's own proof; `None`
    /// where it has none and only a refined twin can tell.
    fn error(&self) -> Option<f64> {
        None
    }

    /// What is wrong beside that of nothing but what is as narrow as may be, the singularity at the edge of a contact:
    /// over its size.
    fn edge_error(&self) -> f64 {
        0.0
    }

    /// The shortest length over which the parts vary, in units of the thickness: what a sum over points must resolve.
    /// Their nearest complex singularity may be at [`NEAREST_POLE`] of it.
    fn length(&self) -> f64;

    /// Where the parts are singular at the origin, as a power of the distance is: down to which distance they vary over
    /// the distance itself. `None` where each of them is analytic there.
    fn nearest(&self) -> Option<f64> {
        None
    }

    /// Where the kernels are series in that power of the distance, over the distance (of the depth, as it is), from
    /// [`Self::nearest`] down to 0.
    fn power(&self) -> Option<f64> {
        None
    }

    /// Number of wave numbers at which the flexibility was evaluated.
    fn flexibility_evaluations(&self) -> usize;
}
