//! The tables of real layers: their parts, their far end, their work. `bounds` holds the errors against what they
//! claim.

mod bounds;

use super::*;
use slipzone_api::taylor::Taylor;
use slipzone_api::{
    Base, Elastic, Flexibility, LayerModel, Moduli, ModulusLaw, Parts, PartsVec, Plane, Poisson, Solid,
    SurfaceFlexibility,
};
use slipzone_flexibilities::Compliance;
use std::f64::consts::{FRAC_PI_2, LN_2};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

const ALL: [Component; 4] = [Component::NormalSlope, Component::ShearStrain, Component::Coupling, Component::Depth];
const NORMAL: [Component; 2] = [Component::NormalSlope, Component::Depth];

#[derive(Debug)]
struct Exponential(f64);

impl ModulusLaw for Exponential {
    fn modulus(&self, depth: f64) -> f64 {
        (self.0 * depth).exp()
    }

    fn exponent(&self) -> Option<f64> {
        Some(self.0)
    }
}

fn layer(law: impl ModulusLaw + 'static, nu: f64) -> Box<dyn LayerResponse> {
    let solid = Solid { plane: Plane::Strain, poisson: Poisson::new(nu).expect("in range"), moduli: Moduli::Shear };
    let model = Arc::new(LayerModel::new(Box::new(law), solid, Base::Rigid));
    Compliance {}.respond(&model).expect("a bonded layer")
}

fn table(response: &dyn LayerResponse, reach: f64, components: &[Component], accuracy: f64) -> Box<dyn KernelTable> {
    Split::default().tabulate(response, &KernelRequest { reach, components, accuracy }).expect("a table")
}

fn bound(table: &dyn KernelTable) -> f64 {
    table.error().expect("split bounds its error")
}

/// Distances of both signs, crowded towards the origin and up to the reach.
fn distances(reach: f64) -> Vec<f64> {
    let small = (0..60).map(|i| reach * 10.0_f64.powf(-0.2 * f64::from(i)));
    small.chain((1..200).map(|i| reach * f64::from(i) / 200.0)).flat_map(|t| [t, -t]).collect()
}

fn parts(table: &dyn KernelTable, component: Component, distances: &[f64]) -> Vec<Parts> {
    let mut parts = PartsVec::new(distances.len());
    table.parts_into(component, distances, parts.first(distances.len()));
    (0..distances.len()).map(|i| parts.at(i)).collect()
}

fn values(table: &dyn KernelTable, component: Component, distances: &[f64]) -> Vec<f64> {
    let mut out = vec![0.0; distances.len()];
    table.values_into(component, distances, &mut out);
    out
}

#[test]
fn the_jump_and_the_logarithm_are_the_first_term_of_the_series() {
    // mu1/mu3 = 8, h = 5 b, nu = 0.3: k_vv(0+) b = 0.793 (docs/theory.md section 3).
    let response = layer(Exponential(-3.0 * LN_2), 0.3);
    let first = response.tail(1)[0];
    for reach in [0.4, 40.0] {
        let table = table(&*response, reach, &ALL, 1e-10);
        let at_origin = |component| table.parts(component, 0.0);
        let slope = at_origin(Component::NormalSlope);
        assert!((slope.sign / 5.0 - 0.793).abs() < 5e-4, "{slope:?}");
        assert_eq!((slope.smooth, slope.log), (0.0, 0.0), "odd functions");
        for (component, sign, log) in [
            (Component::NormalSlope, FRAC_PI_2 * first.vv, 0.0),
            (Component::ShearStrain, FRAC_PI_2 * first.uu, 0.0),
            (Component::Coupling, 0.0, -first.uv),
            (Component::Depth, 0.0, -1.0),
        ] {
            let parts = at_origin(component);
            // Interpolated to the accuracy of the kernel, 1e-10/reach or better.
            assert!((parts.sign - sign).abs() < 1e-10 && (parts.log - log).abs() < 1e-10, "{component:?}: {parts:?}");
        }
    }
}

#[test]
fn the_singular_parts_are_the_series_near_the_origin() {
    // P = c1 + c2 it - c3 t^2/2 - c4 it^3/6 + ...; at t = 0.01 the terms left out are below 1e-11.
    let response = layer(Exponential(-3.0 * LN_2), 0.3);
    let tail = response.tail(5);
    let t: f64 = 0.01;
    for reach in [0.4, 40.0] {
        let table = table(&*response, reach, &ALL, 1e-10);
        for component in ALL {
            let c: Vec<f64> = match component {
                Component::NormalSlope => tail.iter().map(|c| c.vv).collect(),
                Component::ShearStrain => tail.iter().map(|c| c.uu).collect(),
                Component::Coupling => tail.iter().map(|c| c.uv).collect(),
                Component::Depth => std::iter::once(1.0).chain(tail.iter().map(|c| c.vv)).collect(),
            };
            let re = c[0] - c[2] * t * t / 2.0 + c[4] * t.powi(4) / 24.0;
            let im = c[1] * t - c[3] * t.powi(3) / 6.0;
            let (sign, log) = if component.is_odd() { (FRAC_PI_2 * re, -im) } else { (-FRAC_PI_2 * im, -re) };
            let parts = table.parts(component, t);
            let error = (parts.sign - sign).abs().max((parts.log - log).abs());
            // Interpolated as finely as the kernel.
            assert!(error < 1e-9, "{component:?}, reach {reach}: {error:e}");
        }
    }
}

#[test]
fn parts_are_continuous_even_or_odd_and_of_the_order_of_the_kernel() {
    for gamma in [-9.2, -2.0, 2.0, 9.2] {
        let response = layer(Exponential(gamma), 0.3);
        for reach in [0.4, 4.0, 60.0] {
            let accuracy = 1e-10;
            let table = table(&*response, reach, &ALL, accuracy);
            let step = reach / 20_000.0;
            let t: Vec<f64> = (0..20_000).map(|i| step * f64::from(i)).collect();
            let mirrored: Vec<f64> = t.iter().map(|t| -t).collect();
            for component in ALL {
                let (parts, other) = (parts(&*table, component, &t), parts(&*table, component, &mirrored));
                let kernel = t.iter().zip(&parts).skip(20).fold(0.0_f64, |most, (t, p)| most.max(p.value(*t).abs()));
                let largest = kernel.max(12.0 * response.tail(1)[0].vv.abs().max(1.0));
                let parity = if component.is_odd() { -1.0 } else { 1.0 };
                let slope = 40.0 * largest / table.length().min(1.0);
                for (i, (p, o)) in parts.iter().zip(&other).enumerate().skip(1) {
                    assert_eq!((o.smooth, o.sign, o.log), (parity * p.smooth, -parity * p.sign, parity * p.log));
                    let sizes = [p.smooth, p.sign, p.log].map(f64::abs);
                    assert!(sizes.iter().all(|size| *size < 2.0 * largest), "{component:?} at {}: {p:?}", t[i]);
                    let before = parts[i - 1];
                    let jump =
                        (p.smooth - before.smooth).abs() + (p.sign - before.sign).abs() + (p.log - before.log).abs();
                    assert!(jump < slope * step + 20.0 * accuracy, "{component:?} at {}: {jump:e}", t[i]);
                }
            }
        }
    }
}

#[test]
fn values_are_those_of_the_parts() {
    let table = table(&*layer(Exponential(1.5), 0.2), 6.0, &ALL, 1e-9);
    let t = distances(6.0);
    for component in ALL {
        let parts = parts(&*table, component, &t);
        let from_parts: Vec<f64> = t.iter().zip(parts).map(|(t, p)| p.value(*t)).collect();
        assert_eq!(values(&*table, component, &t), from_parts);
    }
}

#[test]
fn far_away_the_kernel_undoes_the_half_plane() {
    let table = table(&*layer(Exponential(2.0), 0.3), 2000.0, &ALL, 1e-6);
    let t = [100.0, -500.0, 2000.0];
    for component in ALL {
        let expected = t.map(|t| if component.is_odd() { -1.0 / t } else { 0.0 });
        assert_eq!(values(&*table, component, &t), expected, "{component:?}");
    }
}

#[test]
fn few_wave_numbers_are_enough_and_all_are_counted() {
    // mu1/mu3 = 8, nu = 0.3. One table in Truncated to 1e-6 takes hundreds.
    let response = layer(Exponential(-3.0 * LN_2), 0.3);
    let cases = [
        (5.0, 1e-4, 32),
        (5.0, 1e-10, 58),
        (1000.0, 1e-10, 56),
        (0.5, 1e-10, 76),
        (0.1, 1e-10, 88),
        (0.05, 1e-14, 431),
    ];
    // The last asks for more than double precision allows, which one attempt tells.
    for (thickness, accuracy, most) in cases {
        let counted = table(&*response, 2.0 / thickness, &NORMAL, accuracy).flexibility_evaluations();
        assert!(counted <= most, "h/b = {thickness}, {accuracy:e}: {counted}");
    }
}

/// `1 + y^2 log(y + 1e-5)` over a depth of 0.3.
#[derive(Debug)]
struct Rough;

impl ModulusLaw for Rough {
    fn modulus(&self, depth: f64) -> f64 {
        let y = 0.3 * depth;
        1.0 + y * y * (y + 1e-5).ln()
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        let logarithm = Taylor::line(1e-5, 0.3, terms).ln();
        let depth = || Taylor::line(0.0, 0.3, terms);
        (depth() * depth() * logarithm + 1.0).into_finite()
    }
}

/// A response that counts at how many wave numbers it was asked.
struct Counted(Box<dyn LayerResponse>, AtomicUsize);

impl LayerResponse for Counted {
    fn surface(&self, wave_number: f64) -> Result<SurfaceFlexibility, Refusal> {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.surface(wave_number)
    }

    fn elastic(&self) -> Elastic {
        self.0.elastic()
    }

    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        self.0.tail(terms)
    }

    fn depth(&self) -> Option<f64> {
        self.0.depth()
    }

    fn thickness(&self) -> Option<f64> {
        self.0.thickness()
    }
}

/// Parts that cancel each other down to noise are looked at once: coarser tables of them are as noisy, and cost more.
#[test]
fn noise_is_not_looked_at_again() {
    let counted = Counted(layer(Rough, 0.3), AtomicUsize::new(0));
    let request = KernelRequest { reach: 2.0 / 0.3, components: &NORMAL, accuracy: 7e-10 };
    assert!(matches!(Split::default().tabulate(&counted, &request), Err(Refusal::OutOfReach { .. })));
    // One attempt takes 460 of them, all six 2,100.
    let evaluations = counted.1.into_inner();
    assert!((400..600).contains(&evaluations), "{evaluations}");
}
