//! The published discretisation: Gauss-Chebyshev after Erdogan, Gupta and Cook.

mod grid;

use grid::{Grid, Kind};
use serde::{Deserialize, Serialize};
use slipzone_api::{
    Component, Densities, Edge, KernelTable, Parity, Parts, PartsVec, Quadrature, Refusal, Rule, Span, Station,
};
use std::f64::consts::PI;

/// Gauss-Chebyshev nodes and staggered collocation points (CC13 eqs. 55-60, 64-67).
///
/// * Sharp edges: `f = F(t)/sqrt(1 - t^2)`, nodes `cos((2j-1) pi/2n)`, collocation at `cos(m pi/n)`.
/// * Smooth edges: `f = F(t) sqrt(1 - t^2)`, nodes `cos(l pi/(n+1))`, collocation at
///   `cos((2i-1) pi/2(n+1))`.
/// * Continued (odd) densities, of which 0 is left at the end: the same. CC13 (eqs. 49, 50) takes `eta p(a) t` off the
///   shear where slipzone takes that of a half-plane.
///
/// The Cauchy part is exact for polynomials `F` of degree `2n`. The kernel is summed at the nodes as if
/// it were smooth: a homogeneous layer converges exponentially, a graded one like `n^-2`, because of the
/// jump and the logarithm of its kernel and the `gap log gap` in its density.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GaussChebyshev {
    /// Number of nodes over the whole interval, even; left out, the solver chooses.
    #[serde(skip_serializing_if = "Option::is_none")]
    n: Option<EvenCount>,
    /// Added refinements, chosen by the solver.
    #[serde(skip)]
    level: u32,
}

/// An even number of nodes, so that symmetry halves it and no node lies in the middle.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(try_from = "usize", into = "usize")]
struct EvenCount(usize);

impl TryFrom<usize> for EvenCount {
    type Error = String;

    fn try_from(n: usize) -> Result<Self, String> {
        if n.is_multiple_of(2) && (4..=MOST_PINNED).contains(&n) {
            Ok(Self(n))
        } else {
            Err(format!("expected an even number of nodes from 4 to {MOST_PINNED}, found {n}"))
        }
    }
}

impl From<EvenCount> for usize {
    fn from(n: EvenCount) -> usize {
        n.0
    }
}

slipzone_api::register!(Quadrature, "gauss-chebyshev", "the published scheme; treats the kernel as smooth",
    example: "type = \"gauss-chebyshev\"\nn = 60",
    parameters: [("n", "nodes over the whole contact, even", false, [8.0, 60.0, 200.0], Even(4, MOST_PINNED as u64))],
    source: "CC13 eqs. 55-60, 64-67; F. Erdogan, G. D. Gupta, T. S. Cook (1973)");

/// Nodes at level 0.
const FIRST_NODES: usize = 16;
/// Most nodes that a scene may ask for: a twin of twice as many judges them.
const MOST_PINNED: usize = MOST_NODES / 2;
/// Most nodes that one interval may get; a dense factorisation of half as many takes about a second.
const MOST_NODES: usize = 4096;

#[typetag::serde(name = "gauss-chebyshev")]
impl Quadrature for GaussChebyshev {
    fn rule(&self, span: &Span) -> Result<Box<dyn Rule>, Refusal> {
        let [lower, upper] = span.interval;
        let parity = span.parity_for("gauss-chebyshev")?;
        let n = self.n.map_or(FIRST_NODES, |n| n.0).saturating_mul(1 << self.level.min(30));
        if n > MOST_NODES {
            return Err(Refusal::OutOfReach {
                method: "gauss-chebyshev",
                why: format!("{n} nodes asked for, {MOST_NODES} are the most it takes"),
                remedy: "ask for a coarser tolerance or fewer nodes",
            });
        }
        let kind = if span.edge == Edge::Sharp { Kind::First } else { Kind::Second };
        Ok(Box::new(ChebyshevRule::new(0.5 * (upper - lower), parity, span.edge, Grid::new(kind, n))))
    }

    fn refined(&self, level: u32) -> Box<dyn Quadrature> {
        Box::new(Self { level: self.level + level, ..self.clone() })
    }

    fn is_pinned(&self) -> bool {
        self.n.is_some()
    }
}

/// One density of a given parity on `[-half_width, half_width]`; unknowns are `F` at the positive nodes.
struct ChebyshevRule {
    half_width: f64,
    parity: Parity,
    edge: Edge,
    grid: Grid,
    stations: Vec<Station>,
}

impl ChebyshevRule {
    fn new(half_width: f64, parity: Parity, edge: Edge, grid: Grid) -> Self {
        // The equation has the parity opposite to the density's: an odd one says nothing at x = 0.
        let mut angles = grid.staggered_angles();
        if parity == Parity::Odd {
            angles.push(0.5 * PI);
        }
        angles.reverse();
        let station =
            |a: &f64| Station { x: half_width * middle_exact_cos(*a), gap: 2.0 * half_width * (0.5 * a).sin().powi(2) };
        let stations = angles.iter().map(station).collect();
        Self { half_width, parity, edge, grid, stations }
    }

    /// `out[j] = k(x - c t_j) + mirror k(x + c t_j)` with `reduce` applied to each kernel value.
    fn folded_kernel(
        &self,
        (table, component): (&dyn KernelTable, Component),
        x: f64,
        reduce: impl Fn(Parts, f64) -> f64,
        scratch: &mut Scratch,
    ) {
        let n = self.grid.t.len();
        for (j, t) in self.grid.t.iter().enumerate() {
            scratch.distances[j] = x - self.half_width * t;
            scratch.distances[n + j] = x + self.half_width * t;
        }
        table.parts_into(component, &scratch.distances, scratch.parts.first(2 * n));
        for j in 0..n {
            let value = |k: usize| reduce(scratch.parts.at(k), scratch.distances[k]);
            scratch.folded[j] = value(j) + self.parity.mirror() * value(n + j);
        }
    }

    fn value_at(&self, unknowns: &[f64], at: Station) -> f64 {
        let t = at.x / self.half_width;
        let relative_gap = at.gap / self.half_width;
        let root = (relative_gap * (2.0 - relative_gap)).sqrt();
        let smooth = self.grid.interpolate(unknowns, self.parity.mirror(), t);
        match self.edge {
            Edge::Sharp => smooth / root,
            Edge::Smooth | Edge::Continued => smooth * root,
        }
    }

    fn scratch(&self) -> Scratch {
        let n = self.grid.t.len();
        Scratch { distances: vec![0.0; 2 * n], parts: PartsVec::new(2 * n), folded: vec![0.0; n] }
    }
}

/// Room for one row of kernel values.
struct Scratch {
    distances: Vec<f64>,
    parts: PartsVec,
    folded: Vec<f64>,
}

/// `cos(angle)`, exactly 0 at the middle, where rounding of `pi/2` would leave 6e-17.
fn middle_exact_cos(angle: f64) -> f64 {
    (0.5 * PI - angle).sin()
}

impl Rule for ChebyshevRule {
    fn unknowns(&self) -> usize {
        self.grid.t.len()
    }

    fn collocation(&self) -> &[Station] {
        &self.stations
    }

    fn half_width(&self) -> f64 {
        self.half_width
    }

    fn stretch(&mut self, half_width: f64) {
        let factor = half_width / self.half_width;
        self.half_width = half_width;
        for station in &mut self.stations {
            *station = Station { x: factor * station.x, gap: factor * station.gap };
        }
    }

    fn operator_into(&mut self, kernel: Option<(&dyn KernelTable, Component)>, rows: &mut [f64]) {
        let (n, length) = (self.unknowns(), rows.len() / self.stations.len());
        assert_eq!(rows.len(), length * self.stations.len(), "a row for each collocation point");
        let mut scratch = self.scratch();
        let last = self.stations.len() - 1;
        for (i, (row, station)) in rows.chunks_mut(length).zip(&self.stations).enumerate() {
            if let Some(kernel) = kernel {
                self.folded_kernel(kernel, station.x, Parts::value, &mut scratch);
            }
            for (j, entry) in row[..n].iter_mut().enumerate() {
                // Stations ascend in x, angles in the grid.
                let (minus, plus) = self.grid.minus_and_plus(last - i, j);
                let cauchy = 1.0 / minus + self.parity.mirror() / plus;
                *entry = self.grid.weight[j] / PI * (cauchy + self.half_width * scratch.folded[j]);
            }
        }
    }

    fn applied_into(
        &mut self,
        kernel: (&dyn KernelTable, Component),
        _: &[f64],
        densities: &Densities,
        out: &mut [[f64; 2]],
    ) {
        assert_eq!(out.len(), self.stations.len(), "one value per collocation point");
        let half_width = self.half_width;
        let weights = self.grid.plain_weights();
        let node = |(t, angle): (&f64, &f64)| Station {
            x: half_width * t,
            gap: 2.0 * half_width * (0.5 * angle).sin().powi(2),
        };
        let at: Vec<Station> = self.grid.t.iter().zip(&self.grid.angle).map(node).collect();
        let mut given = vec![[0.0; 2]; at.len()];
        densities(&at, &mut given);
        given.iter_mut().zip(weights).for_each(|(given, weight)| *given = given.map(|density| weight * density));
        let mut scratch = self.scratch();
        for (out, station) in out.iter_mut().zip(&self.stations) {
            self.folded_kernel(kernel, station.x, Parts::value, &mut scratch);
            let sum = |part: usize| given.iter().zip(&scratch.folded).map(|(given, k)| given[part] * k).sum::<f64>();
            *out = [0, 1].map(|part| half_width / PI * sum(part));
        }
    }

    fn resultant_into(&self, row: &mut [f64]) {
        assert_eq!(row.len(), self.unknowns(), "one entry per unknown");
        for (entry, weight) in row.iter_mut().zip(&self.grid.weight) {
            *entry = self.half_width * weight * (1.0 + self.parity.mirror());
        }
    }

    fn values_into(&self, unknowns: &[f64], at: &[Station], out: &mut [f64]) {
        assert_eq!(at.len(), out.len(), "one value per point");
        for (out, at) in out.iter_mut().zip(at) {
            *out = self.value_at(unknowns, *at);
        }
    }

    fn edge_factor(&self, unknowns: &[f64]) -> f64 {
        match self.edge {
            Edge::Sharp => self.half_width * self.grid.interpolate(unknowns, self.parity.mirror(), 1.0),
            Edge::Smooth | Edge::Continued => 0.0,
        }
    }

    fn sample_potential(&mut self, unknowns: &[f64], _: (&dyn KernelTable, Component), samples: &mut Vec<f64>) {
        samples.clear();
        samples.extend_from_slice(unknowns);
    }

    fn potential_into(
        &mut self,
        samples: &[f64],
        kernel: (&dyn KernelTable, Component),
        targets: &[Station],
        out: &mut [f64],
    ) {
        let unknowns = samples;
        assert_eq!(targets.len(), out.len(), "one value per target");
        // Jump and logarithm at the origin are integrated term by term against the Chebyshev series of
        // the density; what is left of the kernel is continuous and summed at the nodes.
        let Parts { sign: jump, log, .. } = kernel.0.parts(kernel.1, 0.0);
        let reduced = |parts: Parts, t: f64| {
            if t == 0.0 {
                parts.smooth
            } else {
                Parts { sign: parts.sign - jump, log: parts.log - log, ..parts }.value(t)
            }
        };
        let series =
            if jump == 0.0 && log == 0.0 { Vec::new() } else { self.grid.series(unknowns, self.parity.mirror()) };
        let mut scratch = self.scratch();
        for (out, Station { x, .. }) in out.iter_mut().zip(targets) {
            self.folded_kernel(kernel, *x, reduced, &mut scratch);
            let summed: f64 =
                unknowns.iter().zip(&self.grid.weight).zip(&scratch.folded).map(|((u, w), k)| u * w * k).sum();
            let alpha = (x / self.half_width).clamp(-1.0, 1.0).acos();
            // int T_k sign(x - r)/sqrt = -2 sin(k alpha)/k, int T_k log|x - r|/sqrt = -pi cos(k alpha)/k.
            let (cosines, sines) = grid::over_order(&series, alpha);
            let constant = series.first().copied().unwrap_or(0.0);
            let on_jump = constant * (PI - 2.0 * alpha) - 2.0 * sines;
            let on_log = PI * (constant * (0.5 * self.half_width).ln() - cosines);
            let exact = jump * on_jump + log * on_log;
            *out = self.half_width * (summed + exact) / PI;
        }
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests;
