//! The shape of the rigid punch.

use crate::{Fault, Files, Refusal, examine};
use std::fmt::Debug;

/// Config half of a punch: what a scene says under `[punch]`, lengths in the user's units.
#[typetag::serde(tag = "type")]
pub trait PunchProfile: dyn_clone::DynClone + Debug + Send + Sync {
    /// Fetches the files that the table names, and checks what no single key can show, such as a formula. Called once
    /// after the table was read; what was fetched is kept for [`Self::shape`] and not written with the table.
    ///
    /// # Errors
    /// The first fault, with its place in the table or in the file.
    fn read(&mut self, files: &dyn Files) -> Result<(), Fault> {
        let _ = files;
        Ok(())
    }

    /// The shape, ready to be evaluated.
    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal>;
}
dyn_clone::clone_trait_object!(PunchProfile);

/// Run-time half of a punch: its height over the surface, all lengths in the user's unit.
///
/// Shapes are symmetric about `x = 0`; how far they are convex is theirs to say, or else it is looked for, see
/// [`Self::flaw`].
pub trait PunchShape: Debug + Send + Sync {
    /// Gap `g(x)` between the unloaded surface and the punch that touches it at the origin; `g(0) = 0`.
    /// Not a number where the shape is not defined.
    fn height(&self, x: f64) -> f64;

    /// Slope `g'(x)`, dimensionless; 0 in the middle, the mean of both sides at any other corner.
    fn slope(&self, x: f64) -> f64;

    /// Half-width of the contact when sharp corners fix it, whatever the load; `None` for a contact
    /// that grows with the load and ends smoothly.
    fn fixed_half_width(&self) -> Option<f64> {
        None
    }

    /// Half-width of the flat face that touches the surface before there is any load; 0 for a shape that touches in
    /// the middle alone.
    fn face(&self) -> f64 {
        0.0
    }

    /// A length typical of the shape: half-width of a flat, radius of a cylinder. The search for an
    /// unknown contact size starts from it.
    fn natural_length(&self) -> f64;

    /// Where the shape ends: nothing is known of it beyond. `None` for a shape that goes on for ever.
    fn reach(&self) -> Option<f64> {
        None
    }

    /// What keeps the contact under `|x| <= half_width` from being one interval that grew with the load, such as a face
    /// that is not convex: what it is and at which `x`. `None` where nothing does.
    ///
    /// By default the shape is [looked over](examine::flaw), point by point, at every contact that is reported. A shape
    /// that knows better says so: `None` is a promise that it is convex, and that its slope is that of its height.
    fn flaw(&self, half_width: f64) -> Option<Flaw> {
        examine::flaw(self, half_width)
    }

    /// Places within a half-width, ascending, beside which the shape, smooth there, may vary over lengths far shorter
    /// than elsewhere. Nothing is between two of them that a few dozen samples would miss.
    fn details(&self, half_width: f64) -> Vec<f64> {
        let _ = half_width;
        Vec::new()
    }

    /// Where the shape is not analytic, ascending, `x >= 0`; the middle is among them where `g(|x|)` is not smooth
    /// across it, as for a wedge or `|x|^1.5`. Sharp corners at the contact's ends do not count.
    fn kinks(&self) -> &[f64] {
        &[]
    }

    /// Those of the kinks at which the slope itself jumps: the pressure is unbounded there, like a logarithm.
    fn corners(&self) -> &[f64] {
        &[]
    }

    /// Scatter of the measured heights that the shape was made of, root mean square; `None` for shapes that were not
    /// measured.
    fn noise(&self) -> Option<f64> {
        None
    }

    /// By how much the shape under a contact of that half-width is unsure, at most, over its height at the contact's
    /// edge; `None` for shapes that are what they are.
    fn doubt(&self, half_width: f64) -> Option<f64> {
        let _ = half_width;
        None
    }

    /// What users are to know of how the shape under a contact of that half-width was made of what they gave, in words;
    /// as a rule nothing.
    fn remarks(&self, half_width: f64) -> Vec<String> {
        let _ = half_width;
        Vec::new()
    }
}

/// What is wrong with a shape, and where.
#[derive(Clone, Debug, PartialEq)]
pub struct Flaw {
    /// In words, such as "the punch is not convex".
    pub what: String,
    /// Where it begins, in the user's unit of length.
    pub x: f64,
    /// Whether it is that the shape contradicts itself, and not that it is of the wrong form.
    pub is_contradiction: bool,
}

impl Flaw {
    /// That the shape is of the wrong form.
    pub fn new(what: impl Into<String>, x: f64) -> Self {
        Self { what: what.into(), x, is_contradiction: false }
    }
}

/// A flat face between sharp corners: the punch that every growing contact is a stack of, and that scenes call `flat`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FlatFace {
    /// Half the face's width.
    pub half_width: f64,
}

impl PunchShape for FlatFace {
    fn height(&self, _x: f64) -> f64 {
        0.0
    }

    fn slope(&self, _x: f64) -> f64 {
        0.0
    }

    fn fixed_half_width(&self) -> Option<f64> {
        Some(self.half_width)
    }

    fn natural_length(&self) -> f64 {
        self.half_width
    }

    fn flaw(&self, _half_width: f64) -> Option<Flaw> {
        None
    }
}
