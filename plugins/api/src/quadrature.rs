//! How a singular integral equation becomes matrix rows.

use crate::{Component, KernelTable, Refusal};
use std::fmt::Debug;

/// A point of the contact: its abscissa, and its distance to the nearer end kept exactly.
///
/// `half_width - |x|` loses all digits near the end; a point that knows its gap does not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Abscissa.
    pub x: f64,
    /// Distance to the nearer end of the interval, `>= 0`.
    pub gap: f64,
}

/// Symmetry of a density about the middle of its interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Parity {
    /// `f(-x) = f(x)`, like the pressure of a symmetric punch.
    Even,
    /// `f(-x) = -f(x)`, like the shear that it causes.
    Odd,
}

impl Parity {
    /// `+1` or `-1`: the density at `-x` over that at `x`.
    pub fn mirror(self) -> f64 {
        if self == Self::Even { 1.0 } else { -1.0 }
    }
}

/// What a density does at the ends of its interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Edge {
    /// Unbounded like `1/sqrt(gap)`: a sharp corner. The equations leave one number free (the resultant).
    Sharp,
    /// Vanishing like `sqrt(gap)`: a contact that ends smoothly. One condition too many (contact size).
    Smooth,
    /// Finite, and 0 at the end itself: what is left of a traction that goes on beyond the end, known there, as in a
    /// stick zone amid slip, once a known one is taken off it. One condition too many, as for [`Edge::Smooth`].
    Continued,
}

/// A density to be resolved: where it lives and how it behaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// The interval `[c1, c2]`.
    pub interval: [f64; 2],
    /// Symmetry about its middle, when there is one; it halves the unknowns.
    pub parity: Option<Parity>,
    /// Behaviour at both ends.
    pub edge: Edge,
}

impl Span {
    /// The interval `[-half_width, half_width]`.
    pub fn symmetric(half_width: f64, parity: Parity, edge: Edge) -> Self {
        Self { interval: [-half_width, half_width], parity: Some(parity), edge }
    }

    /// The parity of a density that can be solved on half of its interval; a refusal in the name of a `method` where
    /// it has none, or is even and continued, which no contact asks for.
    pub fn parity_for(&self, method: &str) -> Result<Parity, Refusal> {
        match (self.parity, self.edge) {
            (Some(parity), edge) if (parity, edge) != (Parity::Even, Edge::Continued) => Ok(parity),
            (parity, edge) => {
                let parity = parity.map_or("no", |parity| if parity == Parity::Even { "even" } else { "odd" });
                let edge = format!("{edge:?}").to_lowercase();
                Err(Refusal::NotBuilt {
                    what: format!("{method} for a density of {parity} parity and {edge} edges"),
                    remedy: "only symmetric contacts are solved".into(),
                })
            }
        }
    }
}

/// Config half: the discretisation (such as `gauss-chebyshev`).
///
/// Refinement asks for one level after another until the tolerance is met, the [budget](Rule::multiplications_beside)
/// is used up or the scheme refuses: one that converges slowly must end that itself, by refusing more unknowns than it
/// is worth solving for.
#[typetag::serde(tag = "type")]
pub trait Quadrature: dyn_clone::DynClone + Debug + Send + Sync {
    /// Lays out nodes and collocation points for one density.
    ///
    /// # Errors
    /// Unknowns for which it has no room, or that take more work than they are worth.
    fn rule(&self, span: &Span) -> Result<Box<dyn Rule>, Refusal>;

    /// The same scheme, `level` steps finer. A step takes at least 5/4 and at most twice the unknowns.
    fn refined(&self, level: u32) -> Box<dyn Quadrature>;

    /// What it is to be for kernels that begin at the origin with that power of the distance, no whole number, over the
    /// distance; `None` where it is the same for all.
    fn under(&self, _power: f64) -> Option<Box<dyn Quadrature>> {
        None
    }

    /// Whether the scene itself fixed the resolution.
    fn is_pinned(&self) -> bool;
}
dyn_clone::clone_trait_object!(Quadrature);

/// Writes two densities at points strictly inside an interval, on either side of its middle or there.
pub type Densities<'a> = dyn Fn(&[Station], &mut [[f64; 2]]) + 'a;

/// Run-time half: one density on one interval.
///
/// The operator is `(1/pi) PV int f(r)/(x - r) dr + (1/pi) int f(r) k(x - r) dr`. Its kernel comes in
/// three parts ([`crate::Parts`]); a rule says in its documentation which of them it integrates exactly.
pub trait Rule: Send + Sync {
    /// Number of unknowns, after symmetry.
    fn unknowns(&self) -> usize;

    /// Points at which the equation is collocated, ascending; with a parity only those at `x >= 0`
    /// that are not satisfied by symmetry. One fewer than the unknowns for [`Edge::Sharp`] even densities;
    /// together with [`Self::edge_condition`], where there is one, as many for [`Edge::Smooth`] even
    /// densities and one more for [`Edge::Continued`] odd ones.
    fn collocation(&self) -> &[Station];

    /// Half of its interval.
    fn half_width(&self) -> f64;

    /// Moves the rule to `[-half_width, half_width]`; nothing is allocated.
    fn stretch(&mut self, half_width: f64);

    /// Row of the condition that the ends of a [`Edge::Smooth`] or [`Edge::Continued`] density are not
    /// singular, `sum row[j] unknowns[j] = 0`; `None` where the rule's own terms see to it.
    fn edge_condition(&self) -> Option<&[f64]> {
        None
    }

    /// Factor by which each row that [`Self::operator_into`] and [`Self::applied_into`] write is multiplied
    /// already, one per collocation point, dimensionless; `None` where all are 1. Right-hand sides want the
    /// same factor. Points that crowd at an end need it: their rows differ by many orders of magnitude, and
    /// elimination chooses its pivots by size.
    fn row_scale(&self) -> Option<&[f64]> {
        None
    }

    /// How near to its end, over the half-width, a density is told apart from what it is just there: nearer than that
    /// it may be off by more than the rule is elsewhere.
    fn finest_gap(&self) -> f64 {
        self.collocation().last().map_or(1.0, |station| station.gap / self.half_width())
    }

    /// Relative error, about, of integrals over kernels whose length is `1/thinness` of the half-width, where the rule
    /// lacks the room to do them better; 0 where more unknowns will do.
    fn lost_for_room(&self, thinness: f64) -> f64 {
        let _ = thinness;
        0.0
    }

    /// Multiplications that [`Self::operator_into`] takes beside reading the kernel and a few for each entry, where the
    /// kernel's length is `1/thinness` of the half-width: what a finer grid for the kernel costs. They are counted
    /// where `thinness` is above 8: under wider kernels a grid is as fine as its unknowns.
    fn multiplications_beside(&self, thinness: f64) -> u64 {
        let _ = thinness;
        0
    }

    /// The operator: a row for each collocation point, an entry for each unknown; each row times its
    /// [`Self::row_scale`]. `kernel` is `None` on a half-plane, where only the Cauchy part is left.
    ///
    /// `rows` are of one length, which may be more than the unknowns: what follows these in a row is left alone.
    fn operator_into(&mut self, kernel: Option<(&dyn KernelTable, Component)>, rows: &mut [f64]);

    /// `(1/pi) int f(r) k(x - r) dr` of two densities that are known and finite at the ends, with the parity of the
    /// rule's own, at each collocation point; times its [`Self::row_scale`]. `rows` are what [`Self::operator_into`]
    /// wrote for that kernel.
    fn applied_into(
        &mut self,
        kernel: (&dyn KernelTable, Component),
        rows: &[f64],
        densities: &Densities,
        out: &mut [[f64; 2]],
    );

    /// Row of the resultant: `int f dx = sum row[j] unknowns[j]`.
    fn resultant_into(&self, row: &mut [f64]);

    /// The density that the unknowns describe at points strictly inside its interval.
    ///
    /// # Panics
    /// When the slices differ in length.
    fn values_into(&self, unknowns: &[f64], at: &[Station], out: &mut [f64]);

    /// [`Self::values_into`] at one point.
    fn value(&self, unknowns: &[f64], at: Station) -> f64 {
        let mut value = [0.0];
        self.values_into(unknowns, &[at], &mut value);
        value[0]
    }

    /// About how far values between the nodes are off beside those at nodes: in `f sqrt(1 - (x/c)^2)` where the edge is
    /// [`Edge::Sharp`], in `f` otherwise. `nearest` is how close to an end the closest of them is. `None` where the rule does not tell.
    fn lost_between(&self, _unknowns: &[f64], _nearest: f64) -> Option<f64> {
        None
    }

    /// `lim f sqrt(gap (c2 - c1 - gap))` at the upper end; 0 unless the edge is [`Edge::Sharp`].
    fn edge_factor(&self, unknowns: &[f64]) -> f64;

    /// Prepares `(1/pi) int f(r) k(x - r) dr` (no Cauchy part) for [`Self::potential_into`]: fills `samples`
    /// with whatever the rule needs to know of it.
    fn sample_potential(&mut self, unknowns: &[f64], kernel: (&dyn KernelTable, Component), samples: &mut Vec<f64>);

    /// About how far [`Self::potential_into`] is off between places where it is exact, of a potential of that
    /// component; `None` where the rule does not tell.
    fn lost_between_samples(&self, _samples: &[f64], _component: Component) -> Option<f64> {
        None
    }

    /// `(1/pi) int f(r) k(-r) dr`: the potential in the middle alone.
    fn potential_at_centre(&mut self, unknowns: &[f64], kernel: (&dyn KernelTable, Component)) -> f64 {
        let (mut samples, mut out) = (Vec::new(), [0.0]);
        self.sample_potential(unknowns, kernel, &mut samples);
        let half_width = self.half_width();
        self.potential_into(&samples, kernel, &[Station { x: 0.0, gap: half_width }], &mut out);
        out[0]
    }

    /// `(1/pi) int f(r) k(x - r) dr` at any `targets` within the interval, ends included; not only at
    /// collocation points. `samples` comes from [`Self::sample_potential`] with the same kernel. Sign and log
    /// parts are resolved at least to the order of the rule itself.
    ///
    /// # Panics
    /// When the slices differ in length.
    fn potential_into(
        &mut self,
        samples: &[f64],
        kernel: (&dyn KernelTable, Component),
        targets: &[Station],
        out: &mut [f64],
    );
}
