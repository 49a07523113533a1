//! What the model takes for granted, checked on the solution.

use super::layer::Layer;
use super::normal::Normal;
use super::problem::Problem;
use super::stick::Shear;
use slipzone_api::double_exponential::{self, Node};
use slipzone_api::{Component, Station};
use std::f64::consts::PI;

/// Points at which a traction is checked over each zone.
const SAMPLES: usize = 64;
/// Relative excess that rounding and discretisation may cause.
const MARGIN: f64 = 1e-3;
/// Nodes on either side of the grids on which the slip is integrated.
const SLIP_NODES: usize = 8;
/// Nodes on either side of the grids over which the tractions are, and more of them per kernel length.
const SOURCE_NODES: (usize, f64) = (28, 8.0);

/// Points of `[0, half_width)` in cosine spacing: what happens beside an edge is as narrow as its field.
fn samples(half_width: f64) -> [Station; SAMPLES] {
    std::array::from_fn(|i| {
        let angle = 0.5 * PI * i as f64 / SAMPLES as f64;
        let gap = 2.0 * half_width * (0.25 * PI - 0.5 * angle).sin().powi(2);
        Station { x: half_width * angle.sin(), gap }
    })
}

/// Where the pressure pulls: `(x/b, p/mean)` of its lowest point, if it is negative anywhere.
pub(crate) fn tension(normal: &Normal) -> Option<(f64, f64)> {
    let b = normal.half_width;
    let mean = normal.force / (2.0 * b);
    let at = samples(b);
    let mut pressure = [0.0; SAMPLES];
    normal.values_into(&at, &mut pressure);
    let lowest = at
        .iter()
        .zip(pressure)
        .map(|(station, p)| (station.x / b, p / mean))
        .min_by(|one, other| one.1.total_cmp(&other.1))?;
    (lowest.1 < -1e-9).then_some(lowest)
}

/// Where friction cannot hold: `(x/b, |q|/(eta p))` of the worst point of the stick zone, if above 1.
pub(crate) fn overload(normal: &Normal, shear: &Shear) -> Option<(f64, f64)> {
    let at = samples(shear.zone.half_width);
    let (mut q, mut p) = ([0.0; SAMPLES], [0.0; SAMPLES]);
    shear.in_stick_into(&at, &mut q);
    normal.values_into(&at.map(|station| shear.zone.in_contact(station)), &mut p);
    let load = |i: usize| (at[i].x / normal.half_width, q[i].abs() / (shear.friction.abs() * p[i]));
    // q = 0 in the middle, whatever the limit.
    let worst = (1..SAMPLES).map(load).max_by(|one, other| one.1.total_cmp(&other.1))?;
    (worst.1 > 1.0 + MARGIN).then_some(worst)
}

/// Where the surface slides the wrong way beside the stick zone: `x/b` of the worst point.
///
/// Friction opposes sliding: `u(x) - u(a)` has the sign of `-q`, `x > a`.
pub(crate) fn wrong_slip(layer: &Layer, problem: &Problem, normal: &mut Normal, shear: &Shear) -> Option<f64> {
    let zone = shear.zone;
    let targets = double_exponential::nodes(1.0, SLIP_NODES);
    let strain = slip_strain(layer, problem, normal, shear, &targets);
    let mut slip = 0.0;
    let slips: Vec<(f64, f64)> = targets
        .iter()
        .zip(strain)
        .map(|(node, strain)| {
            // Trapezoidal rule in the grid's own variable, up to this node.
            let step = node.weight * strain;
            let here = slip + 0.5 * step;
            slip += step;
            (zone.in_slip(node).x / normal.half_width, here * shear.friction.signum())
        })
        .collect();
    let most = slips.iter().fold(0.0_f64, |most, s| most.max(s.1.abs()));
    let worst = slips.into_iter().max_by(|one, other| one.1.total_cmp(&other.1))?;
    (worst.1 > MARGIN * most).then_some(worst.0)
}

/// `u'(x)/A0` at nodes of the slip zone.
///
/// With `q = eta p sign(x) + z`, `z` living on the stick zone, the principal value over `p` comes from the
/// normal equation and only regular integrals are left (docs/theory.md, "Direction of slip").
fn slip_strain(layer: &Layer, problem: &Problem, normal: &mut Normal, shear: &Shear, targets: &[Node]) -> Vec<f64> {
    let (zone, eta) = (shear.zone, shear.friction);
    let (a0, beta) = (problem.elastic.a0(), problem.elastic.beta());
    let at: Vec<Station> = targets.iter().map(|node| zone.in_slip(node)).collect();
    let mut potential = |component| {
        let (mut samples, mut out) = (Vec::new(), vec![0.0; at.len()]);
        normal.sample_potential(layer, component, &mut samples);
        normal.potential_into(layer, component, &samples, &at, &mut out);
        out
    };
    let by_normal = potential(Component::NormalSlope);
    let by_shear = potential(Component::ShearStrain);
    let by_coupling = potential(Component::Coupling);
    let sources = Sources::new(layer, normal, shear);
    let mut near = vec![0.0; sources.stick.len()];
    let (mut far, mut beyond) = (near.clone(), vec![0.0; sources.slip.len()]);
    let mut strain = |(i, node): (usize, &Node)| {
        let (x, from_stick) = (at[i].x, zone.slip_width * node.from_lower);
        let values = |to: &dyn Fn(&[f64; 4]) -> f64, from: &[[f64; 4]], out: &mut [f64]| {
            let distances: Vec<f64> = from.iter().map(to).collect();
            layer.kernel_values(Component::ShearStrain, &distances, out);
        };
        values(&|s| from_stick + s[1], &sources.stick, &mut near);
        values(&|s| x + s[0], &sources.stick, &mut far);
        values(&|s| x + s[0], &sources.slip, &mut beyond);
        // (1/pi) PV int p/(x - r) dr from the normal equation.
        let principal = problem.slope(x) / a0 - by_normal[i];
        // Both halves of q = eta p sign(r) + z: 1/(x - r) and the kernel, folded.
        let cauchy = |[r, gap, ..]: &[f64; 4]| 2.0 * r / ((from_stick + gap) * (x + r));
        let by_z: f64 = sources
            .stick
            .iter()
            .zip(near.iter().zip(&far))
            .map(|(s, (near, far))| s[2] * (cauchy(s) + near - far))
            .sum();
        let mirrored = |(s, k): (&[f64; 4], &f64)| s[3] * (1.0 / (x + s[0]) + k);
        let by_mirror = sources.stick.iter().zip(&far).map(mirrored).sum::<f64>()
            + sources.slip.iter().zip(&beyond).map(mirrored).sum::<f64>();
        let p = normal.at(at[i]);
        -(eta * (principal + by_shear[i]) + (by_z - 2.0 * eta * by_mirror) / PI + beta * p - by_coupling[i])
    };
    targets.iter().enumerate().map(&mut strain).collect()
}

/// Sources of the strain beside the stick zone: abscissa, distance to the stick zone's edge, weight times
/// `z`, weight times `p`.
struct Sources {
    stick: Vec<[f64; 4]>,
    slip: Vec<[f64; 4]>,
}

impl Sources {
    fn new(layer: &Layer, normal: &Normal, shear: &Shear) -> Self {
        let zone = shear.zone;
        let nodes = |width: f64| {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a positive count; `as` saturates
            let for_kernel = (SOURCE_NODES.1 * width / layer.length()) as usize;
            double_exponential::nodes(1.0, for_kernel.clamp(SOURCE_NODES.0, 1 << 12))
        };
        let a = zone.half_width;
        let grid = nodes(a);
        let at: Vec<Station> =
            grid.iter().map(|node| Station { x: a * node.from_lower, gap: a * node.to_upper }).collect();
        let (mut q, mut p) = (vec![0.0; at.len()], vec![0.0; at.len()]);
        shear.in_stick_into(&at, &mut q);
        let in_contact: Vec<Station> = at.iter().map(|station| zone.in_contact(*station)).collect();
        normal.values_into(&in_contact, &mut p);
        let stick = |(i, node): (usize, &Node)| {
            let weight = a * node.weight;
            [at[i].x, at[i].gap, weight * (q[i] - shear.friction * p[i]), weight * p[i]]
        };
        let stick = grid.iter().enumerate().map(stick).collect();
        let grid = nodes(zone.slip_width);
        let slip = |node: &Node| {
            let station = zone.in_slip(node);
            let weight = zone.slip_width * node.weight;
            [station.x, zone.slip_width * node.from_lower, 0.0, weight * normal.at(station)]
        };
        Self { stick, slip: grid.iter().map(slip).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::layer::Wanted;
    use crate::engine::stick_search::FrictionCurve;
    use crate::plan;
    use crate::scene::parse;
    use slipzone_api::Edge;

    /// docs/theory.md, "Direction of slip": at nu = 0.45, h = 0.5 b and eta = 0.1 the true root slips outwards
    /// with a/b = 0.281461; a second one at 1 - a/b = 1.6e-4 would need |q| = 2.7 eta p inside the stick zone.
    #[test]
    fn a_spurious_root_is_turned_down_and_the_true_one_accepted() {
        let text = "format = 1\n\
            layer = { thickness = 0.5, poisson = 0.45, grading = { type = \"homogeneous\", modulus = 1.0 } }\n\
            punch = { type = \"flat\", half_width = 1.0 }\n\
            friction = { type = \"goodman\", coefficient = 0.1 }\nload = { force = 1.0 }\n\
            [solver]\nkernel = { type = \"truncated\" }\nquadrature = { type = \"gauss-chebyshev\" }\n";
        let chosen = plan::choose(&parse("spurious.toml", text).expect("a good scene"));
        let problem = Problem::new(&chosen.scene).expect("a flat punch");
        let mut layer = Layer::new(&problem, &chosen.methods).expect("a bonded layer");
        layer.tabulate(Wanted { half_width: 2.0, frictional: true, accuracy: 1e-8, level: 2 }).expect("kernels");
        // 256 nodes resolve the slip zone of the spurious root.
        let quadrature = chosen.methods.quadrature.refined(5);
        let mut normal = Normal::new(quadrature.as_ref(), Edge::Sharp).expect("a rule");
        normal.press_sharp(&layer, &problem, 2.0).expect("a pressure");
        assert!(tension(&normal).is_none());
        let mut shear = Shear::new(quadrature).expect("a rule");
        shear.under(&layer, &mut normal);

        let beta = problem.elastic.beta();
        let mut solve = |one_minus_ratio: f64| {
            let (layer, normal, shear) = (&layer, &mut normal, &mut shear);
            let mut curve = FrictionCurve { layer, normal, shear, beta, tolerance: 1e-6 };
            let friction = curve.at((1.0 / one_minus_ratio - 1.0).ln()).expect("a shear");
            assert!((friction + 0.1).abs() < 5e-3, "a root of eta(a) = -0.1: {friction}");
            let targets = double_exponential::nodes(1.0, SLIP_NODES);
            let strain = slip_strain(curve.layer, &problem, curve.normal, curve.shear, &targets);
            let overload = overload(curve.normal, curve.shear);
            (overload, wrong_slip(curve.layer, &problem, curve.normal, curve.shear), strain)
        };
        let (overloaded, ..) = solve(1.6e-4);
        let (x, load) = overloaded.expect("friction cannot hold");
        assert!(x < 0.999 && (load - 2.7).abs() < 0.1, "|q| = {load} eta p at {x} b");
        let (overloaded, wrong, strain) = solve(1.0 - 0.281_461);
        assert_eq!((overloaded, wrong), (None, None));

        // The strain starts from the stick zone's, which is 0, at the zone's edge: every term of it counts. 1e-3 is
        // above the discretisation and far below any term left out.
        let (at_edge, amid) = (strain[0], strain[SLIP_NODES]);
        assert!(at_edge.abs() < 1e-3 * amid.abs(), "u'(a) = {at_edge} beside {amid} in the middle of the slip zone");
    }
}
