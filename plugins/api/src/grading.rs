//! How the elastic constants vary with depth.

use crate::{Fault, Files, Moduli, Positive, Refusal};
use std::fmt::Debug;

/// Config half of a grading: what a scene says under `layer.grading`.
///
/// Moduli and depths are in the user's units here.
#[typetag::serde(tag = "type")]
pub trait Grading: dyn_clone::DynClone + Debug + Send + Sync {
    /// Fetches the files that the table names, and checks what no single key can show, such as a formula. Called once
    /// after the table was read; what was fetched is kept for [`Self::law`] and not written with the table.
    ///
    /// # Errors
    /// The first fault, with its place in the table or in the file.
    fn read(&mut self, files: &dyn Files) -> Result<(), Fault> {
        let _ = files;
        Ok(())
    }

    /// The layer's thickness where the grading itself fixes it, as a stack of sublayers does.
    fn thickness(&self) -> Option<Positive> {
        None
    }

    /// The law over a layer.
    ///
    /// Refuses what only the setting can show to be impossible.
    fn law(&self, setting: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal>;
}
dyn_clone::clone_trait_object!(Grading);

/// What a grading is told of the layer that it describes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Setting {
    /// Thickness in the user's unit; `None` on an infinite solid.
    pub thickness: Option<Positive>,
    /// What the scene calls a modulus. Only laws that mix materials need to know: all others hand on what they are
    /// given.
    pub moduli: Moduli,
}

impl Setting {
    /// A layer of `thickness` whose moduli are shear moduli.
    pub fn thick(thickness: Positive) -> Self {
        Self { thickness: Some(thickness), moduli: Moduli::Shear }
    }
}

/// Run-time half of a grading: the elastic constants as functions of depth.
///
/// Moduli are in the user's unit of stress, of the kind that the [`Setting`] names; `depth` runs from 0 at the surface
/// to 1 at the base, in units of the thickness (of the user's length on an infinite solid). Only `modulus` is required:
/// what else a law can tell makes it faster, never different.
pub trait ModulusLaw: Debug + Send + Sync {
    /// Modulus at `depth`; finite and positive. At a jump, the value on either side.
    fn modulus(&self, depth: f64) -> f64;

    /// Poisson's ratio at `depth`, above -1 and up to 1/2; `None` where it is the layer's.
    fn poisson(&self, depth: f64) -> Option<f64> {
        let _ = depth;
        None
    }

    /// Modulus at the surface.
    fn surface_modulus(&self) -> f64 {
        self.modulus(0.0)
    }

    /// `Some(gamma)` if and only if the modulus is exactly `mu1 exp(gamma depth)`, Poisson's ratio the same everywhere;
    /// 0 when homogeneous.
    ///
    /// The depth exponents are then known in closed form (CC13 eq. 20).
    fn exponent(&self) -> Option<f64> {
        None
    }

    /// The power of the depth, no whole number, with which the law begins to be no analytic function at the surface;
    /// `None` where it is one.
    fn broken_power(&self) -> Option<f64> {
        None
    }

    /// Taylor coefficients of `modulus(depth)/surface_modulus()` at the surface: `terms` of them, or as many
    /// as are known (the first is 1). They set the kernel's jump and logarithm; where they are not known they are taken
    /// from values, with fewer digits and more work.
    fn surface_series(&self, terms: usize) -> Vec<f64> {
        let Some(gamma) = self.exponent() else { return vec![1.0; terms.min(1)] };
        let next = |term: &mut f64, k: usize| {
            let here = *term;
            *term *= gamma / (k + 1) as f64;
            Some(here)
        };
        (0..terms).scan(1.0, next).collect()
    }

    /// Taylor coefficients of [`Self::poisson`] at the surface, likewise; not asked for where that is `None`.
    fn poisson_series(&self, terms: usize) -> Vec<f64> {
        let known = if self.exponent().is_some() { terms } else { terms.min(1) };
        let mut series = vec![0.0; known];
        if let (Some(first), Some(surface)) = (series.first_mut(), self.poisson(0.0)) {
            *first = surface;
        }
        series
    }

    /// Depths, ascending, at which the law has a kink or a jump.
    fn breakpoints(&self) -> &[f64] {
        &[]
    }

    /// Depths, ascending, beside which the law, smooth there, may vary over lengths far shorter than elsewhere: a thin
    /// film, a skin. Nothing is between two of them that a few dozen samples would miss.
    fn details(&self) -> &[f64] {
        &[]
    }

    /// Depths from 0 to 1, ascending, none at a breakpoint, at which what stands for the law is compared with it: the
    /// rows of a table, and so many depths of a formula that a film which is none of its details is seen as a rule.
    fn probes(&self) -> &[f64] {
        &[]
    }

    /// The sublayers of which the law is made, top first, their thicknesses adding up to 1; none where it is no stack.
    /// They are bonded to each other; each has a law over a depth of its own from 0 to 1. All else that a stack tells
    /// is what its sublayers tell.
    fn sublayers(&self) -> &[Sublayer] {
        &[]
    }

    /// What users are to know of how the law was made of what they gave, in words; as a rule nothing.
    fn remarks(&self) -> Vec<String> {
        let of = |(index, sublayer): (usize, &Sublayer)| {
            sublayer.law.remarks().into_iter().map(move |remark| format!("sublayer {}: {remark}", index + 1))
        };
        self.sublayers().iter().enumerate().flat_map(of).collect()
    }
}

/// A part of a stack.
#[derive(Debug)]
pub struct Sublayer {
    /// Its part of the whole thickness.
    pub thickness: f64,
    /// Its law, over its own depth.
    pub law: Box<dyn ModulusLaw>,
}

/// A part of a law without the kinks and jumps that it tells, between two of its details.
#[derive(Clone, Copy, Debug)]
pub struct Stretch<'l> {
    /// A law that is no stack.
    pub law: &'l dyn ModulusLaw,
    /// Where that law begins in the whole, and its part of the whole thickness.
    pub top: f64,
    /// See `top`.
    pub thickness: f64,
    /// Where the stretch begins and ends, in the law's own depth.
    pub from: f64,
    /// See `from`.
    pub to: f64,
    /// Whether the law is smooth where it begins.
    pub is_continued: bool,
}

impl Stretch<'_> {
    /// Depth in the whole of a depth of the law's own.
    pub fn in_whole(&self, depth: f64) -> f64 {
        self.top + depth * self.thickness
    }

    /// The law's [probes](ModulusLaw::probes) in a part of the stretch, both ends included.
    pub fn probes(&self, from: f64, to: f64) -> &[f64] {
        let probes = self.law.probes();
        let above = probes.partition_point(|depth| *depth < from);
        &probes[above..probes.partition_point(|depth| *depth <= to).max(above)]
    }
}

impl dyn ModulusLaw {
    /// The stretches of the law, or of all the sublayers of a stack, from the surface downwards.
    pub fn stretches(&self) -> Vec<Stretch<'_>> {
        let mut stretches = Vec::new();
        collect(self, 0.0, 1.0, &mut stretches);
        stretches
    }
}

fn collect<'l>(law: &'l dyn ModulusLaw, top: f64, thickness: f64, out: &mut Vec<Stretch<'l>>) {
    let mut above = 0.0;
    for sublayer in law.sublayers() {
        collect(&*sublayer.law, top + above * thickness, sublayer.thickness * thickness, out);
        above += sublayer.thickness;
    }
    if law.sublayers().is_empty() {
        let breaks = law.breakpoints().iter().map(|depth| (*depth, false));
        let mut ends: Vec<_> = [(0.0, false), (1.0, false)].into_iter().chain(breaks).collect();
        ends.extend(law.details().iter().map(|depth| (*depth, true)));
        ends.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
        ends.dedup_by_key(|(depth, _)| depth.to_bits());
        let stretch = |ends: &[(f64, bool)]| {
            let [(from, is_continued), (to, _)] = [ends[0], ends[1]];
            Stretch { law, top, thickness, from, to, is_continued }
        };
        out.extend(ends.windows(2).map(stretch));
    }
}
