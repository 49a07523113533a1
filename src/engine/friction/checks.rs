//! What the model takes for granted, checked on the solution.

use super::stick::Shear;
use super::stick_zone::StickZone;
use crate::engine::numerics::climb::{NEARLY, highest};
use crate::engine::numerics::ways;
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::pressure::lookout::Lookout;
use crate::engine::pressure::normal::Normal;
use crate::engine::problem::Problem;
use slipzone_api::double_exponential::Node;
use slipzone_api::{Component, Station};
use std::f64::consts::PI;
use std::sync::Arc;

/// How near to its end a contact is looked at, over its half-width and over the layer's length.
const BESIDE_EDGE: f64 = 1e-3;
const SEEN: f64 = 0.2;
/// And a stick zone, over its own, unless it is a slice of a contact's, all of which are looked at together.
///
/// Under thin layers, `nu` = 0.48, the shear beside a zone that slips inwards in 1e-44 of the contact is 1.2 times what
/// friction bears, and less than that from a thousandth of the contact inwards.
const BESIDE_STICK: f64 = 1e-5;
/// A pressure pulls where it is negative by more than this share of the mean: it may round to less than nothing.
const PULLS: f64 = 1e-9;
/// A low pressure below this share of the mean may be negative between the points at which it is looked at.
const FAINT: f64 = 0.25;
/// Relative excess that rounding and discretisation may cause.
const MARGIN: f64 = 1e-3;
/// Nodes on either side of the grids on which the slip is integrated.
const SLIP_NODES: usize = 8;
/// Nodes on either side of the grids over which the tractions are, times [`StickZone::crowding`]: more where the slip
/// zone is narrow.
///
/// Measured on 3,000 random stick zones, in terms of the largest slip: errors of at most 2e-4, and below 4e-5 in all
/// but one of a hundred; with 6 nodes up to 5e-3. Without a thought for the crowding they reach 40 % where `1 - a/b` is
/// 3e-12.
const SOURCE_NODES: f64 = 8.0;
/// Those nodes per kernel length.
const SOURCE_NODES_PER_LENGTH: f64 = 8.0;
/// Most of those nodes.
const MOST_SOURCE_NODES: usize = 1 << 12;

/// Where the pressure pulls: `(x/b, p/mean)` of its lowest point, if it is negative anywhere; from points of a contact
/// of half-width `b`, the mean pressure, and the layer's length, in whose reach of the edge numbers are small beside
/// their errors.
pub(crate) fn tension(
    lookout: &mut Lookout,
    (b, mean, length): (f64, f64, f64),
    mut pressure_into: impl FnMut(&[Station], &mut [f64]),
) -> Option<(f64, f64)> {
    let Lookout { at, values: pulls, .. } = lookout;
    let pulls_into = |at: &[Station], out: &mut [f64]| {
        pressure_into(at, out);
        for p in out {
            *p /= -mean.abs();
        }
    };
    let (at, pull) = highest(inside(at, BESIDE_EDGE * b, length), pulls, |_| -FAINT, pulls_into)?;
    (pull > PULLS).then_some((at.x / b, -pull))
}

/// Where friction of a coefficient cannot hold: `(x/b, |q|/(eta p))` of the worst point of the stick zone, if above 1.
pub(crate) fn overload(
    layer: &PreparedLayer,
    normal: &Normal,
    shear: &Shear,
    eta: f64,
    is_slice: bool,
) -> Option<(f64, f64)> {
    let zone = shear.zone;
    // What friction bears of the shear, `eta p/|q|`: below nothing where the pressure pulls.
    let (at, bears) = Lookout::lend(|lookout| {
        shear.look(lookout);
        let Lookout { at, values, seen, beside: p } = lookout;
        let lacks_into = |at: &[Station], q: &mut [f64]| {
            seen.clear();
            seen.extend(at.iter().map(|at| zone.in_contact(*at)));
            p.resize(at.len(), 0.0);
            shear.in_stick_into(at, q);
            normal.values_into(seen, p);
            q.iter_mut().zip(&*p).for_each(|(q, p)| *q = -eta * p / q.abs());
        };
        let beside = if is_slice { BESIDE_EDGE } else { BESIDE_STICK };
        let inside = inside(at, beside * zone.half_width, layer.length());
        let highest = highest(inside, values, |_| -NEARLY.recip(), lacks_into);
        highest.map(|(at, lacks)| (at, -lacks))
    })?;
    is_too_little(bears).then(|| (at.x / normal.half_width, bears.max(0.0).recip()))
}

/// Whether friction that bears so much of the shear, `eta p/|q|`, bears less than all of it.
pub(crate) fn is_too_little(bears: f64) -> bool {
    bears * (1.0 + MARGIN) < 1.0
}

/// What friction does not bear at `x/b`, in words, where the shear is so many times what it does; infinitely many where
/// the pressure pulls.
pub(crate) fn overloaded(load: f64, at: f64) -> String {
    if load.is_finite() {
        format!("|q| reaches {load:.3} eta p at {}", place(at))
    } else {
        format!("the pressure pulls at {}", place(at))
    }
}

/// A place `x/b`, in words: beside the edge by how far it is from there.
pub(crate) fn place(at: f64) -> String {
    let from_edge = 1.0 - at;
    if from_edge < f64::EPSILON {
        "the edge".into()
    } else if from_edge < 1e-3 {
        format!("x = b - {from_edge:.0e} b")
    } else {
        format!("x = {at:.4} b")
    }
}

/// Points that are not nearer to the end than what happens beside it is wide.
fn inside(at: &[Station], beside: f64, length: f64) -> &[Station] {
    let nearest = beside.min(SEEN * length);
    &at[..at.partition_point(|at| at.gap > nearest)]
}

/// Room for checking the direction of slip, kept from zone to zone.
#[derive(Default)]
pub(crate) struct SlipCheck {
    targets: Arc<Vec<Node>>,
    at: Vec<Station>,
    samples: Vec<f64>,
    /// The potentials of the pressure at the targets: slope, strain, coupling.
    potentials: [Vec<f64>; 3],
    pressure: Vec<f64>,
    strain: Vec<f64>,
    stick: Sources,
    slip: Sources,
    distances: Vec<f64>,
    kernel: Vec<f64>,
}

/// Where a traction acts: abscissa, distance to the stick zone's edge, weight times what acts beyond
/// `eta p sign(x)`, weight times `p`.
#[derive(Default)]
struct Sources {
    grid: Arc<Vec<Node>>,
    points: Vec<[f64; 4]>,
    stations: Vec<Station>,
    shear: Vec<f64>,
    pressure: Vec<f64>,
}

impl SlipCheck {
    /// Where the surface slides the wrong way beside the stick zone: `x/b` of the worst point.
    ///
    /// Friction opposes sliding: `u(x) - u(a)` has the sign of `-q`, `x > a`.
    pub(crate) fn wrong_slip(
        &mut self,
        layer: &PreparedLayer,
        problem: &Problem,
        normal: &mut Normal,
        shear: &Shear,
    ) -> Option<f64> {
        let sign = shear.friction.signum();
        if !shear.zone.is_told() {
            // So near to the edge nothing but the half-plane's strain drives the slip.
            return (sign * problem.elastic.beta() < 0.0).then_some(1.0);
        }
        self.strain(layer, problem, normal, shear);
        // Trapezoidal rule in the grid's own variable, up to each node.
        let (mut slip, mut most, mut worst) = (0.0, 0.0_f64, (0.0, f64::NEG_INFINITY));
        for ((node, station), strain) in self.targets.iter().zip(&self.at).zip(&self.strain) {
            let step = node.weight * strain;
            let here = (slip + 0.5 * step) * sign;
            slip += step;
            most = most.max(here.abs());
            if here > worst.1 {
                worst = (station.x / normal.half_width, here);
            }
        }
        (worst.1 > MARGIN * most).then_some(worst.0)
    }

    /// `u'(x)/A0` at nodes of the slip zone.
    ///
    /// With `q = eta p sign(x) + z`, `z` living on the stick zone, the principal value over `p` comes from the
    /// normal equation and only regular integrals are left (docs/theory.md, "Direction of slip").
    fn strain(&mut self, layer: &PreparedLayer, problem: &Problem, normal: &mut Normal, shear: &Shear) {
        let (zone, eta) = (shear.zone, shear.friction);
        let (a0, beta) = (problem.elastic.a0(), problem.elastic.beta());
        if self.targets.is_empty() {
            self.targets = ways::grid(SLIP_NODES);
        }
        self.at.clear();
        self.at.extend(self.targets.iter().map(|node| zone.in_slip(node)));
        let [by_slope, by_strain, by_coupling] = &mut self.potentials;
        for (out, component) in [(by_slope, Component::NormalSlope), (by_strain, Component::ShearStrain)] {
            out.resize(self.at.len(), 0.0);
            normal.sample_potential(layer, component, &mut self.samples);
            normal.potential_into(layer, component, &self.samples, &self.at, out);
        }
        by_coupling.resize(self.at.len(), 0.0);
        normal.potential_into(layer, Component::Coupling, shear.coupling(), &self.at, by_coupling);
        self.pressure.resize(self.at.len(), 0.0);
        normal.values_into(&self.at, &mut self.pressure);
        self.stick.in_stick(layer, normal, shear);
        self.slip.in_slip(layer, normal, zone);
        self.strain.clear();
        for (i, node) in self.targets.iter().enumerate() {
            let (x, from_stick) = (self.at[i].x, zone.slip_width * node.from_lower);
            // (1/pi) PV int p/(x - r) dr from the normal equation.
            let principal = problem.slope(x) / a0 - self.potentials[0][i];
            // From the stick zone, from its mirror image and from that of the slip zone.
            let (stick, slip) = (&self.stick.points, &self.slip.points);
            self.distances.clear();
            self.distances.extend(stick.iter().map(|[_, gap, ..]| from_stick + gap));
            self.distances.extend(stick.iter().chain(slip).map(|[r, ..]| x + r));
            self.kernel.resize(self.distances.len(), 0.0);
            layer.kernel_values(Component::ShearStrain, &self.distances, &mut self.kernel);
            let (near, far) = self.kernel.split_at(stick.len());
            // Both halves of q = eta p sign(r) + z: 1/(x - r) and the kernel, folded.
            let mirror = |[r, _, _, p]: &[f64; 4], kernel: f64| 2.0 * eta * p * (1.0 / (x + r) + kernel);
            let both = |point: &[f64; 4], near: f64, far: f64| {
                let [r, gap, z, _] = point;
                z * (2.0 * r / ((from_stick + gap) * (x + r)) + near - far) - mirror(point, far)
            };
            let sticking: f64 = stick.iter().zip(near).zip(far).map(|((s, near), far)| both(s, *near, *far)).sum();
            let slipping: f64 = slip.iter().zip(&far[stick.len()..]).map(|(s, far)| mirror(s, *far)).sum();
            let regular = sticking - slipping;
            let by_q = eta * (principal + self.potentials[1][i]) + regular / PI;
            self.strain.push(-(by_q + beta * self.pressure[i] - self.potentials[2][i]));
        }
    }
}

impl Sources {
    /// A grid of unit length for a part of the contact of that width.
    fn resolve(&mut self, layer: &PreparedLayer, zone: StickZone, width: f64) {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a positive count; `as` saturates
        let [least, for_kernel] = [SOURCE_NODES * zone.crowding(), SOURCE_NODES_PER_LENGTH * width / layer.length()]
            .map(|count| count as usize);
        let nodes = for_kernel.clamp(least, MOST_SOURCE_NODES);
        if self.grid.len() != 2 * nodes + 1 {
            self.grid = ways::grid(nodes);
        }
        self.pressure.resize(self.grid.len(), 0.0);
        self.stations.clear();
        self.points.clear();
    }

    /// The tractions in the stick zone.
    fn in_stick(&mut self, layer: &PreparedLayer, normal: &Normal, shear: &Shear) {
        let (zone, a) = (shear.zone, shear.zone.half_width);
        self.resolve(layer, zone, a);
        self.shear.resize(self.grid.len(), 0.0);
        self.stations.extend(self.grid.iter().map(|n| Station { x: a * n.from_lower, gap: a * n.to_upper }));
        shear.in_stick_into(&self.stations, &mut self.shear);
        self.stations.iter_mut().for_each(|station| *station = zone.in_contact(*station));
        normal.values_into(&self.stations, &mut self.pressure);
        for (i, node) in self.grid.iter().enumerate() {
            let (weight, p) = (a * node.weight, self.pressure[i]);
            let z = self.shear[i] - shear.friction * p;
            self.points.push([a * node.from_lower, a * node.to_upper, weight * z, weight * p]);
        }
    }

    /// The pressure in the slip zone.
    fn in_slip(&mut self, layer: &PreparedLayer, normal: &Normal, zone: StickZone) {
        self.resolve(layer, zone, zone.slip_width);
        self.stations.extend(self.grid.iter().map(|node| zone.in_slip(node)));
        normal.values_into(&self.stations, &mut self.pressure);
        for ((node, station), p) in self.grid.iter().zip(&self.stations).zip(&self.pressure) {
            let width = zone.slip_width;
            self.points.push([station.x, width * node.from_lower, 0.0, width * node.weight * p]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::friction::stick_search::FrictionCurve;
    use crate::engine::prepared_layer::Wanted;
    use crate::plan;
    use crate::scene::parse;
    use slipzone_api::Edge;

    #[test]
    fn a_place_beside_the_edge_is_told_from_there() {
        let told = [0.52917, 0.998, 1.0 - 3e-7, 1.0].map(place);
        assert_eq!(told, ["x = 0.5292 b", "x = 0.9980 b", "x = b - 3e-7 b", "the edge"]);
    }

    #[test]
    fn what_pulls_is_not_said_to_be_infinitely_loaded() {
        assert_eq!(overloaded(1.0185, 0.5), "|q| reaches 1.018 eta p at x = 0.5000 b");
        assert_eq!(overloaded(f64::INFINITY, 0.5), "the pressure pulls at x = 0.5000 b");
    }

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
        let mut layer = PreparedLayer::new(&problem, &chosen.methods).expect("a bonded layer");
        layer.tabulate(2.0, Wanted { frictional: true, deep: true, accuracy: 1e-8, level: 2 }).expect("kernels");
        // 256 nodes resolve the slip zone of the spurious root.
        let quadrature = chosen.methods.quadrature.refined(5);
        let mut normal = Normal::new(quadrature.as_ref(), Edge::Sharp).expect("a rule");
        normal.press_sharp(&layer, &problem, 2.0).expect("a pressure");
        let sizes = (2.0, normal.mean(), layer.length());
        let mut lookout = Lookout::default();
        normal.look(&mut lookout);
        assert!(tension(&mut lookout, sizes, |at, out| normal.values_into(at, out)).is_none());
        let mut shear = Shear::new(quadrature).expect("a rule");
        shear.under(&layer, &mut normal);

        let beta = problem.elastic.beta();
        let mut solve = |one_minus_ratio: f64| {
            let (layer, normal, shear) = (&layer, &mut normal, &mut shear);
            let mut curve = FrictionCurve { layer, normal, shear, beta, tolerance: 1e-6 };
            let friction = curve.at((1.0 / one_minus_ratio - 1.0).ln()).expect("a shear");
            assert!((friction + 0.1).abs() < 5e-3, "a root of eta(a) = -0.1: {friction}");
            let mut check = SlipCheck::default();
            let wrong = check.wrong_slip(curve.layer, &problem, curve.normal, curve.shear);
            (overload(curve.layer, curve.normal, curve.shear, 0.1, false), wrong, check.strain)
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
