//! A homogeneous layer on a rigid base, against numbers of an independent program.

use super::*;
use crate::graded_panels::legendre::Gauss;
use slipzone_api::double_exponential;
use slipzone_api::reference::homogeneous_layer::bonded;
use slipzone_api::{Elastic, Plane, Poisson};

/// Kernels by their Fourier integrals up to `s h = 24`, beyond which `w^2 exp(-2 w)` is below 1e-18.
struct Layer {
    thickness: f64,
    elastic: Elastic,
    /// Wave number, weight and `M` of the three kernels.
    waves: Vec<(f64, f64, [f64; 3])>,
}

impl Layer {
    /// For distances up to 2.
    fn new(thickness: f64, poisson: f64) -> Self {
        let elastic = Elastic::new(Plane::Strain, Poisson::new(poisson).expect("admissible"));
        // Panels of 1.5 units of w = s h, and of at most ten radians of the farthest wave.
        let panels = (16.0_f64).max(4.8 / thickness).ceil();
        let (gauss, half) = (Gauss::new(16), 12.0 / panels);
        let panel = |k: u32| f64::from(k) * 2.0 * half;
        let lower = (0..1000).map(panel).take_while(|lower| *lower < 24.0 - half);
        let wave = |w: f64, weight: f64| {
            let flexibility = bonded(elastic, w);
            let m = [flexibility.vv - 1.0, flexibility.uu - 1.0, flexibility.uv + elastic.beta()];
            (w / thickness, weight / thickness, m)
        };
        let waves = lower
            .flat_map(|lower| gauss.z.iter().zip(&gauss.w).map(move |(z, w)| (lower + half * (1.0 + z), half * w)))
            .map(|(w, weight)| wave(w, weight))
            .collect();
        Self { thickness, elastic, waves }
    }
}

impl KernelTable for Layer {
    fn parts_into(&self, component: Component, distances: &[f64], out: PartsMut) {
        out.fill(distances, |t| {
            let term = |(s, weight, m): &(f64, f64, [f64; 3])| match component {
                Component::NormalSlope => weight * m[0] * (s * t).sin(),
                Component::ShearStrain => weight * m[1] * (s * t).sin(),
                Component::Coupling => weight * m[2] * (s * t).cos(),
                Component::Depth => f64::NAN,
            };
            Parts { smooth: self.waves.iter().map(term).sum(), ..Parts::default() }
        });
    }

    fn length(&self) -> f64 {
        // M falls like exp(-2 s h): the kernels are singular at +-2ih.
        2.0 * self.thickness
    }

    fn flexibility_evaluations(&self) -> usize {
        self.waves.len()
    }
}

/// Pressure under a flat punch of half-width 1 and unit force.
fn pressure(layer: &Layer, nodes: usize, panels: usize) -> (Box<dyn Rule>, Vec<f64>) {
    let mut rule = rule(1.0, Parity::Even, Edge::Sharp, nodes, panels);
    let mut matrix = operator(rule.as_mut(), Some((layer, Component::NormalSlope)));
    let mut right = vec![0.0; rule.unknowns()];
    rule.resultant_into(&mut right);
    matrix.extend_from_slice(&right);
    right.fill(0.0);
    *right.last_mut().expect("one at least") = 1.0;
    let unknowns = solve(&matrix, &right);
    (rule, unknowns)
}

/// The friction coefficient with which the stick zone under a flat punch of half-width 1 is `a`.
fn friction(layer: &Layer, a: f64) -> f64 {
    let (mut outer, p) = pressure(layer, 10, 5);
    let mut stick = rule(a, Parity::Odd, Edge::Continued, 10, 5);
    let rows = operator(stick.as_mut(), Some((layer, Component::ShearStrain)));
    let stations = stick.collocation();
    let in_contact: Vec<Station> = stations.iter().map(|at| Station { x: at.x, gap: at.gap + (1.0 - a) }).collect();
    let (mut samples, mut by_pressure) = (Vec::new(), vec![0.0; stations.len()]);
    outer.sample_potential(&p, (layer, Component::Coupling), &mut samples);
    outer.potential_into(&samples, (layer, Component::Coupling), &in_contact, &mut by_pressure);

    // Seen from a collocation point at gap g, 1/(x - r) has its pole at the distance 1/cosh(u(g)) from the axis of
    // u, 0.17 for g = 1e-8: a step of 1/40 leaves exp(-2 pi 40 0.17) = 1e-18, the usual 1/10 leaves 1e-5.
    let slip = double_exponential::nodes(1.0 - a, 160);
    let traction: Vec<f64> = slip
        .iter()
        .map(|node| node.weight * value(outer.as_ref(), &p, Station { x: 1.0 - node.to_upper, gap: node.to_upper }))
        .collect();
    let (mut matrix, mut right) = (Vec::new(), Vec::new());
    for (i, (row, scale)) in rows.chunks(stick.unknowns()).zip(row_scale(stick.as_ref())).enumerate() {
        // Distances to the two slip zones, the near one without cancellation.
        let near = slip.iter().map(|node| -(stations[i].gap + node.from_lower));
        let far = slip.iter().map(|node| stations[i].x + a + node.from_lower);
        let distances: Vec<f64> = near.chain(far).collect();
        let mut kernel = vec![0.0; distances.len()];
        layer.values_into(Component::ShearStrain, &distances, &mut kernel);
        let whole: Vec<f64> = distances.iter().zip(&kernel).map(|(t, k)| 1.0 / t + k).collect();
        let (near, far) = whole.split_at(slip.len());
        let by_slip: f64 = traction.iter().zip(near.iter().zip(far)).map(|(p, (near, far))| p * (near - far)).sum();
        matrix.extend_from_slice(row);
        matrix.push(scale * by_slip / PI);
        let p_here = value(outer.as_ref(), &p, in_contact[i]);
        right.push(scale * (by_pressure[i] - layer.elastic.beta() * p_here));
    }
    *solve(&matrix, &right).last().expect("eta")
}

/// Twelve digits (eleven on the thin layer) are known of the edge factor and of `p(0)`.
#[test]
fn pressure_on_a_bonded_layer() {
    for (thickness, poisson, edge, middle, nodes, panels) in [
        (5.0, 0.3, 0.309_722_033_261, 0.327_009_026_499, 10, 5),
        (2.0, 0.3, 0.276_999_605_75, 0.362_144_496_643, 10, 5),
        (0.1, 0.45, 0.054_266_894_922, 0.527_001_401_57, 15, 7),
    ] {
        let (rule, p) = pressure(&Layer::new(thickness, poisson), nodes, panels);
        let what = format!("h = {thickness}");
        assert_close(rule.edge_factor(&p) / edge, 1.0, 2e-11, &format!("edge factor, {what}"));
        let centre = value(rule.as_ref(), &p, Station { x: 0.0, gap: 1.0 });
        assert_close(centre / middle, 1.0, 2e-11, &format!("pressure in the middle, {what}"));
    }
}

/// Ten digits of `a/b` are known; `eta` varies like `-beta/pi log(1 - a/b)`, so that it keeps nine of them.
#[test]
fn stick_zones_on_a_bonded_layer() {
    for (thickness, ratio, eta) in
        [(5.0, 0.915_404_914_5, 0.3), (2.0, 0.754_937_133_7, 0.1), (10.0, 0.119_811_456_3, 0.1)]
    {
        let got = friction(&Layer::new(thickness, 0.3), ratio);
        assert_close(got / eta, 1.0, 2e-9, &format!("h = {thickness}, a/b = {ratio}"));
    }
}
