//! What the model takes for granted, checked on the solution.

use super::layer::Layer;
use super::normal::Pressure;
use super::stick::Shear;
use slipzone_api::double_exponential;
use slipzone_api::{Component, Station};
use std::f64::consts::PI;

/// Points at which a traction is checked over each zone.
const SAMPLES: usize = 200;
/// Relative excess that rounding and discretisation may cause.
const MARGIN: f64 = 1e-3;
/// Nodes on either side of the grids on which the slip is integrated.
const SLIP_NODES: usize = 16;
/// Nodes on either side of the grids over which the tractions are.
const SOURCE_NODES: usize = 80;

/// Points of `[0, half_width)` in cosine spacing: what happens beside an edge is as narrow as its field.
fn samples(half_width: f64) -> impl Iterator<Item = Station> {
    (0..SAMPLES).map(move |i| {
        let angle = 0.5 * PI * i as f64 / SAMPLES as f64;
        let gap = 2.0 * half_width * (0.25 * PI - 0.5 * angle).sin().powi(2);
        Station { x: half_width * angle.sin(), gap }
    })
}

/// Where the pressure pulls: `(x/b, p/mean)` of its lowest point, if it is negative anywhere.
pub(crate) fn tension(pressure: &Pressure) -> Option<(f64, f64)> {
    let b = pressure.half_width;
    let mean = pressure.force / (2.0 * b);
    let lowest = samples(b)
        .map(|station| (station.x / b, pressure.at(station) / mean))
        .min_by(|one, other| one.1.total_cmp(&other.1))?;
    (lowest.1 < -1e-9).then_some(lowest)
}

/// Where friction cannot hold: `(x/b, |q|/(eta p))` of the worst point of the stick zone, if above 1.
pub(crate) fn overload(pressure: &Pressure, shear: &Shear) -> Option<(f64, f64)> {
    let (a, b) = (shear.zone.half_width, pressure.half_width);
    let worst = samples(a)
        .skip(1) // q = 0 in the middle, whatever the limit
        .map(|station| {
            let limit = shear.friction.abs() * pressure.at(shear.zone.in_contact(station));
            (station.x / b, shear.in_stick(station).abs() / limit)
        })
        .max_by(|one, other| one.1.total_cmp(&other.1))?;
    (worst.1 > 1.0 + MARGIN).then_some(worst)
}

/// Where the surface slides the wrong way beside the stick zone: `x/b` of the worst point.
///
/// Friction opposes sliding: `u(x) - u(a)` has the sign of `-q`, `x > a`.
pub(crate) fn wrong_slip(layer: &Layer, pressure: &Pressure, shear: &Shear) -> Option<f64> {
    let zone = shear.zone;
    let targets = double_exponential::nodes(zone.slip_width, SLIP_NODES);
    let strain = SlipStrain::new(layer, pressure, shear, &targets);
    let mut slip = 0.0;
    let slips: Vec<(f64, f64)> = targets
        .iter()
        .enumerate()
        .map(|(i, node)| {
            // Trapezoidal rule in the grid's own variable, up to this node.
            let step = node.weight * strain.at(i, node);
            let here = slip + 0.5 * step;
            slip += step;
            ((zone.half_width + node.from_lower) / pressure.half_width, here * shear.friction.signum())
        })
        .collect();
    let most = slips.iter().fold(0.0_f64, |most, s| most.max(s.1.abs()));
    let worst = slips.into_iter().max_by(|one, other| one.1.total_cmp(&other.1))?;
    (worst.1 > MARGIN * most).then_some(worst.0)
}

/// `u'(x)/A0` in the slip zone.
///
/// With `q = eta p sign(x) + z`, `z` living on the stick zone, the principal value over `p` comes from the
/// normal equation and only regular integrals are left (docs/theory.md, "Direction of slip").
struct SlipStrain<'a> {
    layer: &'a Layer<'a>,
    pressure: &'a Pressure,
    shear: &'a Shear,
    by_normal: Vec<f64>,
    by_shear: Vec<f64>,
    by_coupling: Vec<f64>,
    /// Sources in the stick zone: abscissa, distance to its edge, weight times `z`, weight times `p`.
    stick: Vec<[f64; 4]>,
    /// Sources in the slip zone: abscissa, weight times `p`.
    slip: Vec<[f64; 2]>,
}

impl<'a> SlipStrain<'a> {
    fn new(
        layer: &'a Layer<'a>,
        pressure: &'a Pressure,
        shear: &'a Shear,
        targets: &[double_exponential::Node],
    ) -> Self {
        let zone = shear.zone;
        let x: Vec<f64> = targets.iter().map(|node| zone.half_width + node.from_lower).collect();
        let stick = double_exponential::nodes(zone.half_width, SOURCE_NODES)
            .iter()
            .map(|node| {
                let station = Station { x: node.from_lower, gap: node.to_upper };
                let p = pressure.at(zone.in_contact(station));
                let z = shear.in_stick(station) - shear.friction * p;
                [station.x, station.gap, node.weight * z, node.weight * p]
            })
            .collect();
        let slip = double_exponential::nodes(zone.slip_width, SOURCE_NODES)
            .iter()
            .map(|node| [zone.half_width + node.from_lower, node.weight * pressure.at(zone.in_slip(node))])
            .collect();
        Self {
            layer,
            pressure,
            shear,
            by_normal: pressure.potential(layer, Component::NormalSlope, &x),
            by_shear: pressure.potential(layer, Component::ShearStrain, &x),
            by_coupling: pressure.potential(layer, Component::Coupling, &x),
            stick,
            slip,
        }
    }

    fn at(&self, i: usize, node: &double_exponential::Node) -> f64 {
        let zone = self.shear.zone;
        let x = zone.half_width + node.from_lower;
        let eta = self.shear.friction;
        let a0 = self.layer.problem.elastic.a0();
        let beta = self.layer.problem.elastic.beta();

        // (1/pi) PV int p/(x - r) dr from the normal equation.
        let principal = self.layer.problem.slope(x) / a0 - self.by_normal[i];
        // Both halves of q = eta p sign(r) + z: 1/(x - r) and the kernel, folded.
        let values = |distances: Vec<f64>| self.layer.kernel_values(Component::ShearStrain, &distances);
        let near = values(self.stick.iter().map(|s| x - s[0]).collect());
        let far = values(self.stick.iter().map(|s| x + s[0]).collect());
        let by_z: f64 = self
            .stick
            .iter()
            .zip(near.iter().zip(&far))
            .map(|(&[r, gap, z, _], (near, far))| z * (2.0 * r / ((node.from_lower + gap) * (x + r)) + near - far))
            .sum();
        let beyond = values(self.slip.iter().map(|s| x + s[0]).collect());
        let mirrored = |r: f64, p: f64, k: f64| p * (1.0 / (x + r) + k);
        let by_mirror: f64 = self.stick.iter().zip(far).map(|(s, k)| mirrored(s[0], s[3], k)).sum::<f64>()
            + self.slip.iter().zip(beyond).map(|(s, k)| mirrored(s[0], s[1], k)).sum::<f64>();

        let p = self.pressure.at(zone.in_slip(node));
        -(eta * (principal + self.by_shear[i]) + (by_z - 2.0 * eta * by_mirror) / PI + beta * p - self.by_coupling[i])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::layer::{Layer, Work};
    use crate::engine::normal::SharpPunch;
    use crate::engine::problem::Problem;
    use crate::engine::stick_search::FrictionCurve;
    use crate::plan;
    use crate::scene::parse;

    /// docs/theory.md, "Direction of slip": at nu = 0.45, h = 0.5 b and eta = 0.1 the true root slips outwards
    /// with a/b = 0.281461; a second one at 1 - a/b = 1.6e-4 would need |q| = 2.7 eta p inside the stick zone.
    #[test]
    fn a_spurious_root_is_turned_down_and_the_true_one_accepted() {
        let text = "format = 1\n\
            layer = { thickness = 0.5, poisson = 0.45, grading = { type = \"homogeneous\", modulus = 1.0 } }\n\
            punch = { type = \"flat\", half_width = 1.0 }\n\
            friction = { type = \"goodman\", coefficient = 0.1 }\nload = { force = 1.0 }\n";
        let chosen = plan::choose(&parse("spurious.toml", text).expect("a good scene"));
        let problem = Problem::new(&chosen.scene).expect("a flat punch");
        let response = chosen.methods.flexibility.respond(&problem.layer).expect("a bonded layer");
        // 256 nodes resolve the slip zone of the spurious root.
        let (kernel, quadrature) = (chosen.methods.kernel.refined(2), chosen.methods.quadrature.refined(5));
        let work = Work::default();
        let mut layer = Layer::new(&problem, response.as_ref(), kernel.as_ref(), quadrature.as_ref(), &work);
        let pressure = SharpPunch::new(&mut layer, 2.0).expect("a pressure").under(2.0);
        assert!(tension(&pressure).is_none());
        let curve = FrictionCurve { layer: &layer, pressure: &pressure, slip_nodes: 64, tolerance: 1e-6 };

        let shear_at = |one_minus_ratio: f64| {
            let shear = curve.shear((1.0 / one_minus_ratio - 1.0).ln()).expect("a shear");
            assert!((shear.friction + 0.1).abs() < 5e-3, "a root of eta(a) = -0.1: {}", shear.friction);
            shear
        };
        let spurious = shear_at(1.6e-4);
        let (x, load) = overload(&pressure, &spurious).expect("friction cannot hold");
        assert!(x < 0.999 && (load - 2.7).abs() < 0.1, "|q| = {load} eta p at {x} b");
        let genuine = shear_at(1.0 - 0.281_461);
        assert_eq!(overload(&pressure, &genuine), None);
        assert_eq!(wrong_slip(&layer, &pressure, &genuine), None);

        // The strain starts from the stick zone's, which is 0, at the zone's edge: every term of it counts. 1e-3 is
        // far above the discretisation (3e-6) and far below any term left out.
        let targets = double_exponential::nodes(genuine.zone.slip_width, SLIP_NODES);
        let strain = SlipStrain::new(&layer, &pressure, &genuine, &targets);
        let (at_edge, amid) = (strain.at(0, &targets[0]), strain.at(SLIP_NODES, &targets[SLIP_NODES]));
        assert!(at_edge.abs() < 1e-3 * amid.abs(), "u'(a) = {at_edge} beside {amid} in the middle of the slip zone");
    }
}
