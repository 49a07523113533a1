//! What Goodman's approximation costs, estimated.
//!
//! It leaves out what the shear does to the pressure, `beta q - (1/pi) int q k_uv` in the pressure's equation. On
//! half-planes a formula tells how much more friction the stick zone takes (docs/planner.md, "What Goodman's
//! approximation neglects"), and where little slips it serves layers, too: all of it happens beside the edge, and the
//! friction says what comes from farther away.
//!
//! On a layer where more slips the first step from Goodman's solution towards the coupled one is taken, under a flat
//! punch with the contact and the stick zone of the solution, and the same on the half-plane of the layer's surface. A
//! coarse resolution makes much the same error in either: what is neglected is as much smaller than on the half-plane
//! as the step is, or larger by as much.

use crate::engine::friction::rubbing::Rubbing;
use crate::engine::friction::stick::Shear;
use crate::engine::friction::stick_zone::StickZone;
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::pressure::normal::Normal;
use crate::engine::problem::Problem;
use crate::plan;
use crate::scene::Scene;
use slipzone_api::double_exponential::{self, Node};
use slipzone_api::{Component, Edge, Quadrature, Refusal, Shelf, Station};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

/// What the fit to half-planes takes, see [`on_half_plane`].
const FIT: [f64; 3] = [1.0 / 6.0, 0.055, 0.042];
/// More friction than Goodman's, over it, beyond which the estimate says nothing: not much friction more, and none is
/// enough.
const MOST: f64 = 2.0;
/// Slip zone, over the half-width, of which half is told as of a half-plane, and one that is as a whole.
const NARROW: f64 = 0.03;
const NARROWEST: f64 = 3e-3;
/// A share of the depth beyond which the steps do not add up.
const MOST_LIFT: f64 = 0.9;
/// Rounds in which that fit is solved: each leaves a fifth.
const ROUNDS: usize = 12;
/// Fewest and most refinements of the quadrature for the steps.
const COARSEST: f64 = 1.0;
const FINEST: f64 = 8.0;
/// Kernel lengths in the half-width that the coarsest one serves.
const SERVED: f64 = 6.0;
/// Nodes on either side of the middle of the stick zone, and of the slip zone, the kernel lengths in the half-width
/// that they serve, and by how many times as many there may be.
const NODES: usize = 10;
const SERVED_BY_NODES: f64 = 1.4;
const MOST_TIMES: usize = 64;
/// Numbers that all such grids take.
const MOST_NUMBERS: usize = 4 * NODES * MOST_TIMES;
/// Where those grids end: sums over the shear see no more of the edge.
const END: f64 = 3.0;

/// What is neglected, relative.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neglected {
    /// By how much more friction belongs to the stick zone; `None` where everything sticks, for which any more would
    /// do.
    pub(crate) friction: Option<f64>,
    /// By how much more force pushes a flat punch as wide as the contact to a depth; `None` where depths have no
    /// meaning or were not asked for.
    pub(crate) force: Option<f64>,
}

/// What is neglected is not known: kernels too short for coarse grids, or no solution on them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Untold;

impl From<Refusal> for Untold {
    fn from(_: Refusal) -> Self {
        Self
    }
}

/// What is neglected of a stick zone; `Err` where it cannot be told.
pub(crate) fn neglected(
    layer: &PreparedLayer,
    problem: &Problem,
    rubbing: &Rubbing,
    scene: &Scene,
) -> Result<Neglected, Untold> {
    let (zone, beta) = (rubbing.zone, problem.elastic.beta());
    let eta = problem.friction.ok_or(Untold)?;
    let known = |more: f64| if more.abs() <= MOST { Ok(more) } else { Err(Untold) };
    let narrow = on_half_plane(eta, beta);
    if layer.is_plain() {
        let friction = if rubbing.is_full { None } else { Some(known(narrow)?) };
        return Ok(Neglected { friction, force: None });
    }
    if rubbing.is_full && !tells_force(layer, problem) {
        return Ok(Neglected { friction: None, force: None });
    }
    let thinness = zone.contact() / layer.length();
    if thinness > SERVED_BY_NODES * MOST_TIMES as f64 {
        return Err(Untold);
    }
    // A level tells details shorter by sqrt 2.
    let finer = 2.0 * (thinness / SERVED).log2();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few
    let level = (COARSEST + finer.max(0.0)).ceil().min(FINEST) as u32;
    let quadrature = scene.solver.quadrature.as_ref().ok_or(Untold)?.refined(level);
    let mut coarse = Coarse::new(layer, problem, zone, quadrature.clone(), &grid(thinness))?;
    let force = coarse.more_force(layer, problem).filter(|force| force.is_finite());
    if rubbing.is_full {
        return Ok(Neglected { friction: None, force: Some(force.ok_or(Untold)?) });
    }
    // Beside the edge slip is that of a half-plane, but for outward slip and all slip of an incompressible surface:
    // these come of the layer alone.
    let slip = zone.one_minus_ratio();
    let is_of_edge = beta > 0.0 && rubbing.reported().is_some_and(|root| root.branch > 0.0);
    if slip < NARROWEST {
        return if is_of_edge { Ok(Neglected { friction: Some(known(narrow)?), force }) } else { Err(Untold) };
    }
    let own = coarse.more_friction(layer, problem)?;
    // On an incompressible half-plane there is no shear.
    let (plain, of_half_plane) = if beta == 0.0 {
        (0.0, 0.0)
    } else {
        let half_plane = Scene { layer: plan::half_plane(&scene.layer, &problem.layer), ..scene.clone() };
        let layer = PreparedLayer::of(&plan::choose(&half_plane))?;
        let coarse = Coarse::new(&layer, problem, zone, quadrature, &[])?;
        let of_half_plane = on_half_plane(coarse.goodman, beta);
        (coarse.more_friction(&layer, problem)?, of_half_plane)
    };
    let wide = if own.abs() < plain.abs() { of_half_plane * own / plain } else { of_half_plane + own - plain };
    let friction = match slip / (slip + NARROW) {
        _ if !is_of_edge => wide,
        share if wide > 0.0 && wide <= MOST => share * wide + (1.0 - share) * narrow,
        _ => narrow,
    };
    Ok(Neglected { friction: Some(known(friction)?), force })
}

/// Whether the force for a depth can be told: reciprocity takes depths from what is at rest, which a datum is not.
fn tells_force(layer: &PreparedLayer, problem: &Problem) -> bool {
    problem.layer.is_grounded() && layer.kernel(Component::Depth).is_some()
}

/// By how much more friction the coupled equations ask for on a half-plane where Goodman's approximation asks for
/// `eta`; infinite where no friction is enough.
///
/// Beside a stick zone the tractions turn into each other along `ln x`, by an angle in proportion to `atanh beta` where
/// Goodman's shear grows by `beta`: that angle is `atan` of the friction, but for what the slip zone makes of it,
///
/// ```text
/// atan(x) - beta g atan(beta x) = eta atanh(beta)/beta,    g = 1/6 + 0.055 beta^2 + 0.042 atan(beta x),
/// ```
///
/// where `g` is a fit to coupled half-planes (`tests/data/coupled_half_plane.csv`).
fn on_half_plane(eta: f64, beta: f64) -> f64 {
    let turned = if beta == 0.0 { eta } else { eta * beta.atanh() / beta };
    let mut angle = turned;
    for _ in 0..ROUNDS {
        if angle >= FRAC_PI_2 {
            return f64::INFINITY;
        }
        let in_slip = (beta * angle.tan()).atan();
        angle = turned + beta * (FIT[0] + FIT[1] * beta * beta + FIT[2] * in_slip) * in_slip;
    }
    angle.tan() / eta - 1.0
}

/// Goodman's solution under a flat punch as wide as the contact, with a unit force, at a coarse resolution.
struct Coarse {
    zone: StickZone,
    normal: Normal,
    shear: Shear,
    /// The friction coefficient that belongs to the stick zone.
    goodman: f64,
    /// The shear, where it is seen by a kernel.
    points: Vec<Point>,
}

impl Coarse {
    /// Solves it; the grid is that of the sums over the shear, of which a half-plane takes none.
    fn new(
        layer: &PreparedLayer,
        problem: &Problem,
        zone: StickZone,
        quadrature: Box<dyn Quadrature>,
        grid: &[Node],
    ) -> Result<Self, Refusal> {
        let beta = problem.elastic.beta();
        let mut normal = Normal::new(&*quadrature, Edge::Sharp)?;
        normal.press_flat(layer, zone.contact(), |_| 0.0)?;
        let mut shear = Shear::new(quadrature)?;
        shear.under(layer, &mut normal);
        let goodman = if layer.is_plain() {
            shear.know(&normal, beta, zone)
        } else {
            shear.solve(layer, &mut normal, beta, zone)?
        };
        let points = right_half(zone, &normal, &shear, grid);
        Ok(Self { zone, normal, shear, goodman, points })
    }

    /// By how much the friction coefficient of the stick zone grows when the pressure gives way to the one that the
    /// shear under it makes.
    fn more_friction(self, layer: &PreparedLayer, problem: &Problem) -> Result<f64, Refusal> {
        let Self { zone, mut normal, mut shear, goodman, points } = self;
        let beta = problem.elastic.beta();
        let at = normal.collocation().to_vec();
        let mut pressure = vec![0.0; at.len()];
        normal.values_into(&at, &mut pressure);
        let own = shear.values(&at, &pressure);
        let mut slopes: Vec<f64> = own.iter().map(|q| beta * q).collect();
        if !points.is_empty() {
            let mut distances = Vec::with_capacity(2 * points.len() * at.len());
            for Station { x, .. } in &at {
                for Point { at: Station { x: r, .. }, .. } in &points {
                    distances.extend([(x - r).abs(), x + r]);
                }
            }
            let mut kernel = vec![0.0; distances.len()];
            layer.kernel_values(Component::Coupling, &distances, &mut kernel);
            for (slope, kernel) in slopes.iter_mut().zip(kernel.chunks_exact(2 * points.len())) {
                // The shear is odd, its kernel even.
                let pairs = kernel.as_chunks::<2>().0.iter().zip(&points);
                *slope -= pairs.map(|([near, far], point)| (near - far) * point.shear * point.weight).sum::<f64>() / PI;
            }
        }
        normal.press_flat(layer, zone.contact(), |i| slopes[i])?;
        shear.under(layer, &mut normal);
        Ok(shear.solve(layer, &mut normal, beta, zone)? / goodman - 1.0)
    }

    /// By how much more force pushes the punch to a depth if the shear acts on the pressure.
    ///
    /// By reciprocity the shear lifts the punch under a unit force by `-int q u dx`, where `u` is what the pressure
    /// moves along the surface. Each further step lifts by much the same share of what the one before did: a geometric
    /// series.
    fn more_force(&mut self, layer: &PreparedLayer, problem: &Problem) -> Option<f64> {
        let Self { normal, shear, points, .. } = self;
        if !tells_force(layer, problem) {
            return None;
        }
        let depth = normal.sunk_flat(layer, problem)? / problem.elastic.a0();
        let at: Vec<Station> = points.iter().map(|point| point.at).collect();
        let (mut strain, mut pressure) = (vec![0.0; at.len()], vec![0.0; at.len()]);
        normal.potential_into(layer, Component::Coupling, shear.coupling(), &at, &mut strain);
        normal.values_into(&at, &mut pressure);
        // u, over A0, from the middle outwards: half of what a point stands for lies before it.
        let (mut moved, mut lift) = (0.0, 0.0);
        for ((strain, pressure), point) in strain.iter().zip(&pressure).zip(points) {
            let half = 0.5 * (strain - problem.elastic.beta() * pressure) * point.weight;
            lift -= 2.0 * point.shear * point.weight * (moved + half);
            moved += 2.0 * half;
        }
        let share = lift / depth;
        (share < MOST_LIFT).then(|| share / (1.0 - share))
    }
}

/// A point of the right half of the contact, the shear there and the length that it stands for.
struct Point {
    at: Station,
    shear: f64,
    weight: f64,
}

/// A grid for the sums over the shear, as much finer than the coarsest as kernels so short ask for.
fn grid(thinness: f64) -> Arc<Vec<Node>> {
    static GRIDS: Shelf<usize, Vec<Node>> = Shelf::new(MOST_NUMBERS, Vec::len);
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a few
    let times = ((thinness / SERVED_BY_NODES).ceil() as usize).clamp(1, MOST_TIMES).next_power_of_two();
    GRIDS.get(times, || double_exponential::nodes_up_to(1.0, NODES * times, END))
}

/// The right half of the contact from the middle outwards.
fn right_half(zone: StickZone, normal: &Normal, shear: &Shear, grid: &[Node]) -> Vec<Point> {
    let a = zone.half_width;
    // The gaps of the stick zone's points are to its own end, as its rule wants them.
    let sticking: Vec<Station> =
        grid.iter().map(|node| Station { x: a * node.from_lower, gap: a * node.to_upper }).collect();
    let slipping: Vec<Station> = grid.iter().map(|node| zone.in_slip(node)).collect();
    let (mut q, mut p) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
    shear.in_stick_into(&sticking, &mut q);
    normal.values_into(&slipping, &mut p);
    let sticks = sticking.iter().zip(q).map(|(at, q)| (zone.in_contact(*at), q, a));
    let slips = slipping.iter().zip(p).map(|(at, p)| (*at, shear.friction * p, zone.slip_width));
    let both = sticks.zip(grid).chain(slips.zip(grid));
    both.map(|((at, shear, length), node)| Point { at, shear, weight: length * node.weight }).collect()
}
