//! Piecewise polynomials on panels graded towards the contact's ends, every part of the kernel integrated exactly.

mod basis;
mod cauchy;
mod layout;
mod legendre;
mod mesh;
mod pieces;
mod regular;
mod rule;
mod shares;

use crate::count::Count;
use basis::Basis;
use layout::Layout;
use rule::PanelRule;
use serde::{Deserialize, Serialize};
use slipzone_api::{Quadrature, Refusal, Rule, Span, root};

/// Product integration on graded panels.
///
/// With `x = c cos(theta)`, `0 <= theta <= pi/2` and the symmetry for the rest, the density is
/// * sharp edges: `f = F/sin(theta)`,
/// * smooth edges: `f = F`, `F(0) = 0`,
/// * continued (odd) densities: `f = F/sin(theta)`, `F(0) = 0`: finite at the end, which they need not use,
///
/// and `F` a continuous piecewise polynomial of the angle on panels that shrink geometrically towards the end
/// `theta = 0`, by its values at Chebyshev-Lobatto points. The equation is collocated half way between these, at
/// `nodes` Chebyshev points per panel: that is one equation fewer than nodes, and the condition at the end and an
/// odd density's zero in the middle each take one node away, so that all counts are those of the contract with no
/// extra row. Rows of sharp and continued densities are scaled by `sin(theta)`, which makes the operator a
/// Hilbert transform of `F`: condition numbers are 20 to 200 from 18 to 162 unknowns on a half-plane, up to
/// 2000 where the contact is 200 times as wide as the layer is thick.
///
/// Exact for such `F`: the Cauchy part (Legendre functions of the second kind, Neumann's formula); jump and
/// logarithm (integrals of Legendre functions of either kind) times the polynomials through `nodes + 12` Gauss
/// points, on pieces of panels no longer than the kernel's own length. Only the pieces, not the unknowns, grow in
/// number with the contact's width over the layer's thickness.
///
/// Where kernels begin with a power `p < 1` of the distance (over the distance) a density is a series in that power of
/// its distance to the end. The panels are then equal ones of `u`, `theta = u^root`, in a root for which `2 root p` is
/// whole, or nearly so; densities that vanish at the end are `F = u^(root - 1)` times the polynomial. Beside a slip
/// zone, however narrow, there are logarithms of its width too: the first of the panels of a continued density is cut
/// geometrically.
///
/// Convergence is exponential also where densities contain `gap log gap` or, beyond the end of a stick zone, the
/// branch point of the pressure: `P` panels resolve it from a distance of about `16^(2 - P)` of the half-width.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GradedPanels {
    /// Degree of the polynomial on each panel, which is also its number of collocation points; left out, the
    /// solver chooses.
    #[serde(skip_serializing_if = "Option::is_none")]
    nodes: Option<Count<4, 32>>,
    /// Panels from the middle of the contact to its end; left out, the solver chooses.
    #[serde(skip_serializing_if = "Option::is_none")]
    panels: Option<Count<2, 64>>,
    /// Added refinements, chosen by the solver.
    #[serde(skip)]
    level: u32,
    /// The power of the distance with which the kernels begin, where that is no whole number.
    #[serde(skip)]
    power: Option<f64>,
}

slipzone_api::register!(Quadrature, "graded-panels", "graded panels; jump and logarithm of the kernel integrated exactly",
    example: "type = \"graded-panels\"\nnodes = 12\npanels = 8",
    parameters: [
        ("nodes", "degree and collocation points of each panel", false, [4.0, 12.0, 32.0], Whole(4, 32)),
        ("panels", "panels from the middle to the end", false, [2.0, 8.0, 64.0], Whole(2, 64)),
    ],
    source: "product integration: K. E. Atkinson (1997) sec. 4.2; geometric grading: C. Schwab (1998)");

/// Nodes and panels at level 0.
const FIRST: (usize, usize) = (6, 3);
/// Most unknowns that one density may get: what a scene may ask for at most, 32 times 64, has a twin of 2886. A
/// dense factorisation of as many takes a few seconds.
const MOST_UNKNOWNS: usize = 3072;

impl GradedPanels {
    /// Nodes per panel and panels at this level.
    ///
    /// Nodes grow by 20 %, panels by 15 %, rounded up: unknowns by a factor from 1.38 (large counts) to 1.88 (4 nodes
    /// on 2 panels).
    fn counts(&self) -> (usize, usize) {
        let mut counts = (self.nodes.map_or(FIRST.0, |n| n.0), self.panels.map_or(FIRST.1, |n| n.0));
        for _ in 0..self.level.min(64) {
            counts = ((counts.0 * 24).div_ceil(20), (counts.1 * 23).div_ceil(20));
        }
        counts
    }
}

/// The root of the angle in which densities are polynomials, or nearly so, if kernels begin with that power of the
/// distance over the distance: they are then series in that power of the distance to the contact's end, which goes with
/// the square of the angle.
fn root_of(power: f64) -> u32 {
    const SMALLEST: u32 = 3;
    const LARGEST: u32 = 6;
    const WHOLE: f64 = 1e-3;
    if power < 1.0 { root::whole(2.0 * power, SMALLEST..=LARGEST, WHOLE).unwrap_or(LARGEST) } else { 1 }
}

#[typetag::serde(name = "graded-panels")]
impl Quadrature for GradedPanels {
    fn rule(&self, span: &Span) -> Result<Box<dyn Rule>, Refusal> {
        let [lower, upper] = span.interval;
        let parity = span.parity_for("graded-panels")?;
        let (nodes, panels) = self.counts();
        if nodes * panels > MOST_UNKNOWNS {
            return Err(Refusal::OutOfReach {
                method: "graded-panels",
                why: format!("{} unknowns asked for, {MOST_UNKNOWNS} are the most it takes", nodes * panels),
                remedy: "ask for a coarser tolerance or fewer nodes and panels",
            });
        }
        let layout = Layout::shared((nodes, panels), self.power.map_or(1, root_of), Basis { parity, edge: span.edge });
        Ok(Box::new(PanelRule::new(0.5 * (upper - lower), layout)))
    }

    fn refined(&self, level: u32) -> Box<dyn Quadrature> {
        Box::new(Self { level: self.level.saturating_add(level), ..self.clone() })
    }

    fn under(&self, power: f64) -> Option<Box<dyn Quadrature>> {
        Some(Box::new(Self { power: Some(power), ..self.clone() }))
    }

    fn is_pinned(&self) -> bool {
        self.nodes.is_some() || self.panels.is_some()
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests;
