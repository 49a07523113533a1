//! Double-exponential sinc collocation.

mod apart;
mod between;
mod beyond;
mod fine;
mod fold;
mod grid;
mod integrals;
mod map;
mod potential;
mod resolution;
mod rule;
mod series;
mod shape;
mod sums;

use crate::count::Count;
use resolution::{Resolution, finer, ladder, reach};
use rule::DeSincRule;
use serde::{Deserialize, Serialize};
use slipzone_api::{Edge, Parity, Quadrature, Refusal, Rule, Span};

/// Sinc collocation in the variable of a double-exponential map, `x = c tanh w`, `w = (pi/2) sinh u`.
///
/// Nodes `u_j = j H`, collocation half way between at `v_i = (i + 1/2) H`, `H = u_max/n`, symmetry folded in. The
/// map turns whatever happens at an end (a power of the gap, `gap log gap`) into double-exponential decay, so
/// that the scheme need not know it. Unknowns are `F_j = f(x_j) sqrt(1 - (x_j/c)^2)`, a traction; rows are
/// multiplied by `x'(v_i)/sqrt(c^2 - x_i^2)`. Both leave numbers of order one at the ends, where `x'` itself
/// falls below `1e-30`, and no table depends on `c`.
///
/// * Cauchy part: `(H/pi) sum P_j/(x_i - x_j)`, `P = f x'`; a trapezoidal sum half a step off the pole needs no
///   correction, and differences of `x` are `c sinh(w_i - w_j)/(cosh w_i cosh w_j)`. Each row is then made exact
///   for the simplest density with its kind of edge, such as the flat punch's, which keeps the traction's
///   relative precision up to the end.
/// * The end: beyond the last node a density goes on as the simplest of its kind does, and all nodes that would follow
///   stand in the last unknown's column; the strain beyond the last point goes on with its slope over the root of the
///   gap. What is missed is of the order of the last gap or less; without it would be of its root.
/// * Kernel part: all three parts exact. `sign` weighs `(2/pi) Si(pi d)`, `log|x - r|` weighs
///   `log|x - r| - Ci(pi |d|)`, `d` being the distance in steps. Where the kernel outruns the nodes (thin layers) it
///   is summed on a grid an odd number of times finer, with `P` interpolated by sinc functions.
/// * Edge factor and edge condition: a functional of all unknowns, see [`Rule::edge_condition`], and no
///   extrapolation; of a stick zone's shear the last three unknowns tell whether it vanishes.
///
/// Sums converge like `exp(-2 pi d/H)`, values between the nodes like `exp(-pi d/H)`; `d` is the width of the
/// strip of `u` in which everything is analytic. A singularity at `l` off the end, along the axis (the end of the
/// slip zone, seen from the stick zone), gives `d = 1/sqrt(1 + (ln(2 c/l)/pi)^2)`; one across (kernels, `l` the
/// thickness) about half of that.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DeSinc {
    /// Steps over half the interval; left out, the solver chooses.
    #[serde(skip_serializing_if = "Option::is_none")]
    n: Option<Count<LEAST_STEPS, MOST_PINNED>>,
    /// Where the grid ends in `u`; left out, it goes with `n`.
    #[serde(skip_serializing_if = "Option::is_none")]
    u_max: Option<Reach>,
    /// Added refinements, chosen by the solver.
    #[serde(skip)]
    level: u32,
}

/// An end of the grid that a scene may ask for.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
struct Reach(f64);

impl TryFrom<f64> for Reach {
    type Error = String;

    fn try_from(u_max: f64) -> Result<Self, String> {
        if (LEAST_REACH..=MOST_REACH).contains(&u_max) {
            Ok(Self(u_max))
        } else {
            Err(format!("expected an end of the grid from {LEAST_REACH} to {MOST_REACH}, found {u_max}"))
        }
    }
}

impl From<Reach> for f64 {
    fn from(reach: Reach) -> f64 {
        reach.0
    }
}

slipzone_api::register!(Quadrature, "de-sinc", "double-exponential sinc collocation; exact with jumps, logarithms and unknown edge behaviour",
    example: "type = \"de-sinc\"\nn = 32",
    parameters: [("n", "steps over half the contact", false, [8.0, 32.0, 128.0], Whole(LEAST_STEPS as u64, MOST_PINNED as u64)),
                 ("u_max", "where the grid ends, x = c tanh((pi/2) sinh u)", false, [3.4, 4.0, 4.6], Between(LEAST_REACH, MOST_REACH))],
    source: "H. Takahasi, M. Mori (1974); F. Stenger (1993); docs/theory.md section 3");

/// Fewest steps that a scene may ask for.
const LEAST_STEPS: usize = 4;
/// Most steps that a scene may ask for: a twin of twice as many judges them.
const MOST_PINNED: usize = MOST_STEPS / 2;
/// Most steps that half an interval may get.
const MOST_STEPS: usize = 2048;
/// Smallest end of the grid: a fifth of a flat punch's force lies beyond it.
const LEAST_REACH: f64 = 1.0;
/// Largest `u`: the last gap is then 1e-275 of the half-width.
const MOST_REACH: f64 = 6.0;
/// The same where a density vanishes at the end, by as much as the root of the gap: systems were singular from 4.8 on.
const MOST_SMOOTH_REACH: f64 = 4.7;

impl DeSinc {
    fn resolution(&self, edge: Edge) -> Resolution {
        let n = self.n.map_or_else(|| ladder(self.level), |n| finer(n.0, self.level));
        let own = reach(n, edge);
        // What a grid that ends too soon misses shows beside one that does not.
        let u_max = self.u_max.map_or(own, |u_max| if self.level == 0 { u_max.0 } else { u_max.0.max(own) });
        Resolution { n, u_max }
    }
}

#[typetag::serde(name = "de-sinc")]
impl Quadrature for DeSinc {
    fn rule(&self, span: &Span) -> Result<Box<dyn Rule>, Refusal> {
        let [lower, upper] = span.interval;
        let odd = span.parity_for("de-sinc")? == Parity::Odd;
        let resolution = self.resolution(span.edge);
        if resolution.n > MOST_STEPS {
            return Err(Refusal::OutOfReach {
                method: "de-sinc",
                why: format!("{} steps asked for, {MOST_STEPS} are the most it takes", resolution.n),
                remedy: "ask for a coarser tolerance or fewer steps",
            });
        }
        if span.edge == Edge::Smooth && resolution.u_max > MOST_SMOOTH_REACH {
            return Err(Refusal::OutOfReach {
                method: "de-sinc",
                why: format!(
                    "a density that vanishes at its end has no digits left at u = {}, {MOST_SMOOTH_REACH} is the largest there",
                    resolution.u_max
                ),
                remedy: "take a smaller `u_max`, or leave it out",
            });
        }
        let grid = resolution::grid(resolution, odd, span.edge);
        Ok(Box::new(DeSincRule::new(0.5 * (upper - lower), resolution, grid)))
    }

    fn refined(&self, level: u32) -> Box<dyn Quadrature> {
        Box::new(Self { level: self.level + level, ..self.clone() })
    }

    fn is_pinned(&self) -> bool {
        self.n.is_some() || self.u_max.is_some()
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests;
