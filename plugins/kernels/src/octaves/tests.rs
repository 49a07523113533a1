//! The tables against integrals in closed form, and against another strategy.

use super::*;
use crate::Split;
use crate::rational::{Rational, exact};
use slipzone_api::{Component, Elastic, Plane, Poisson, SurfaceFlexibility};
use std::f64::consts::PI;

const ALL: [Component; 4] = [Component::NormalSlope, Component::ShearStrain, Component::Coupling, Component::Depth];

fn table(response: &dyn LayerResponse, reach: f64, components: &[Component], accuracy: f64) -> Box<dyn KernelTable> {
    Octaves::default().tabulate(response, &KernelRequest { reach, components, accuracy }).expect("a table")
}

/// Distances from the reach down to well above where the wave numbers end.
fn distances(table: &dyn KernelTable, reach: f64) -> Vec<f64> {
    let least = 1e3 * table.nearest().expect("a kernel of any power");
    (0..400).map(|i| reach * (least / reach).powf(f64::from(i) / 399.0)).collect()
}

/// An error over a distance counts as much as the distance is long; the depth's counts as it is.
fn felt(component: Component, t: f64, error: f64) -> f64 {
    if component == Component::Depth { error } else { t * error }
}

/// `W = s (1 + s^2)^-q` in the slopes, `(1 + s^2)^-q` in the coupling: they fall like `s^(1 - 2q)` and `s^(-2q)`.
struct Broken {
    q: f64,
    /// Whether it tells the power with which it begins.
    is_known: bool,
    /// What the first slope is off by at any wave number.
    off: f64,
}

impl LayerResponse for Broken {
    fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        let even = (1.0 + s * s).powf(-self.q);
        Ok(SurfaceFlexibility { vv: 1.0 + s * even + self.off, uu: 1.0 + s * even, uv: even - self.elastic().beta() })
    }

    fn elastic(&self) -> Elastic {
        Elastic::new(Plane::Strain, Poisson::new(0.3).expect("in range"))
    }

    fn tail(&self, _: usize) -> Vec<SurfaceFlexibility> {
        Vec::new()
    }

    fn depth(&self) -> Option<f64> {
        Some(1.0)
    }

    fn broken_power(&self) -> Option<f64> {
        self.is_known.then_some(2.0 * self.q - 1.0)
    }
}

impl Broken {
    fn new(q: f64, is_known: bool) -> Self {
        Self { q, is_known, off: 0.0 }
    }

    /// Along the cut from `i` upwards: `sin(pi q) int_1^inf y^k (y^2 - 1)^-q exp(-ty) dy`, `k` being 1 for the slopes
    /// and 0 for the coupling; by the trapezoidal rule in `log(y - 1)`.
    fn kernel(&self, component: Component, t: f64) -> f64 {
        let step = 0.02;
        let term = |i: i32| {
            let u = (f64::from(i) * step).exp();
            let y = if component.is_odd() { 1.0 + u } else { 1.0 };
            u * y * (u * (2.0 + u)).powf(-self.q) * (-t * (1.0 + u)).exp()
        };
        (PI * self.q).sin() * step * (-20_000..3600).map(term).sum::<f64>()
    }
}

#[test]
fn kernels_like_a_broken_power_are_told_down_to_the_smallest_distances() {
    for (q, accuracy) in [(0.6, 1e-10), (0.85, 1e-10), (0.75, 1e-5)] {
        let (response, reach) = (Broken::new(q, false), 2.0);
        let table = table(&response, reach, &ALL[..3], accuracy);
        let bound = table.error().expect("a bound");
        assert!(bound <= accuracy, "q = {q}: {bound:e}");
        for t in distances(&*table, reach) {
            for component in &ALL[..3] {
                let found = table.parts(*component, t).value(t);
                let error = felt(*component, t, (found - response.kernel(*component, t)).abs());
                assert!(error <= accuracy, "q = {q}, {component:?} at {t:e}: {error:e}");
                let mirrored = table.parts(*component, -t).value(-t);
                let expected = if component.is_odd() { -found } else { found };
                assert!((mirrored - expected).abs() <= 1e-15 * found.abs(), "{component:?} at {t:e}");
            }
        }
    }
}

/// `W` is 1e-6 where wave numbers end, and fades out before. A kernel that goes on says how well, and one that ends
/// where nothing is felt nothing.
#[test]
fn what_an_edge_feels_of_waves_beyond_the_last_is_told() {
    let told = |q: f64, is_known: bool| table(&Broken::new(q, is_known), 2.0, &ALL[..2], 1e-8).edge_error();
    assert!((2e-7..2e-6).contains(&told(0.6, false)), "{:e}", told(0.6, false));
    for (q, is_known, most) in [(0.6, true, 1e-10), (0.75, false, 0.0), (0.85, false, 0.0)] {
        assert!(told(q, is_known) <= most, "q = {q}: {:e}", told(q, is_known));
    }
}

/// What the flexibility is off by at the shortest waves does not fade: octaves of it tell nothing more.
#[test]
fn no_wave_is_asked_for_that_tells_of_errors_alone() {
    let (response, reach) = (Broken { off: 3e-12, ..Broken::new(0.85, false) }, 2.0);
    let table = table(&response, reach, &ALL[..1], 1e-12);
    assert!(table.nearest().is_some_and(|nearest| nearest > 1e-21), "{:?}", table.nearest());
    assert!((1e-12..1e-11).contains(&table.edge_error()), "an edge feels it: {:e}", table.edge_error());
    for t in distances(&*table, reach) {
        let error = t * (table.parts(ALL[0], t).value(t) - response.kernel(ALL[0], t)).abs();
        assert!(error <= 1e-11, "at {t:e}: {error:e}");
    }
}

/// Down to distances at which no wave number is asked for: a power that is known ends nowhere.
#[test]
fn a_power_that_is_known_is_told_down_to_nothing() {
    for (q, accuracy) in [(0.6, 1e-10), (0.65, 1e-6), (0.75, 1e-10), (0.9, 1e-10)] {
        let (response, reach) = (Broken::new(q, true), 2.0);
        let table = table(&response, reach, &ALL[..2], accuracy);
        assert_eq!(table.power(), Some(2.0 * q - 1.0), "q = {q}");
        for i in 0..120 {
            let t = reach * 10.0_f64.powf(-0.2 * f64::from(i));
            for component in &ALL[..2] {
                let (found, expected) = (table.parts(*component, t).value(t), response.kernel(*component, t));
                let error = felt(*component, t, (found - expected).abs());
                assert!(error <= accuracy, "q = {q}, {component:?} at {t:e}: {error:e}");
                // Next to the origin the powers tell it as well as it is large.
                assert!(t > 1e-12 || (found / expected - 1.0).abs() < 1e-6, "q = {q} at {t:e}: {found:e}");
                let mirrored = table.parts(*component, -t).value(-t);
                assert!((mirrored + found).abs() <= 1e-15 * found.abs(), "{component:?} at {t:e}");
            }
        }
    }
}

/// An even kernel like `log t` at the origin, beside powers of `t^(1/2)`, and one like a power that meets none of what
/// is analytic.
#[test]
fn even_kernels_have_more_than_powers_beside_the_origin() {
    // W = (1 + s^2)^(-p/2), k = 2^(1/2 - p/2) sqrt(pi)/Gamma(p/2) t^((p - 1)/2) K_((1 - p)/2)(t): as above, q = p/2.
    struct Even(f64);
    impl LayerResponse for Even {
        fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
            let all = (1.0 + s * s).powf(-0.5 * self.0) + 0.5 * (1.0 + s * s).powf(-self.0);
            Ok(SurfaceFlexibility { vv: 1.0, uu: 1.0, uv: all - self.elastic().beta() })
        }

        fn elastic(&self) -> Elastic {
            Broken::new(self.0, true).elastic()
        }

        fn tail(&self, _: usize) -> Vec<SurfaceFlexibility> {
            Vec::new()
        }

        fn depth(&self) -> Option<f64> {
            Some(1.0)
        }

        fn broken_power(&self) -> Option<f64> {
            Some(self.0)
        }
    }
    for power in [0.5, 0.8] {
        let response = Even(power);
        let table = table(&response, 2.0, &ALL[2..3], 1e-10);
        assert_eq!(table.power(), Some(power));
        // `(1 + s^2)^-q` along the cut; q = 1/2 is `K_0(t)`.
        let part = |q: f64, t: f64| Broken::new(q, true).kernel(ALL[2], t);
        for i in 0..80 {
            let t = 2.0 * 10.0_f64.powf(-0.2 * f64::from(i));
            let expected = part(0.5 * power, t) + 0.5 * part(power, t);
            let error = t * (table.parts(ALL[2], t).value(t) - expected).abs();
            assert!(error <= 1e-10, "p = {power} at {t:e}: {error:e}");
        }
    }
}

/// The longest waves that a contact much wider than the layer is thick feels: the window ended within the first band.
#[test]
fn waves_much_longer_than_the_layer_are_told() {
    let response = Rational::knowing(0);
    for reach in [300.0, 3e3, 1e5] {
        let table = table(&response, reach, &ALL[..3], 1e-8);
        for t in [1.0, 0.5, 0.1, 0.01].map(|share| share * reach) {
            for component in &ALL[..3] {
                let error = (table.parts(*component, t).value(t) - exact(*component, t)).abs();
                assert!(t * error < 1e-7, "{component:?}, reach {reach:e}, t = {t:e}: {error:e}");
            }
        }
    }
}

/// Asked for nothing but the depth, over distances far smaller than all that is known: it was cut at its first octave.
#[test]
fn the_depth_alone_is_told_as_well() {
    let response = Rational::knowing(0);
    for reach in [1.0, 1e-80] {
        let table = table(&response, reach, &ALL[3..], 1e-6);
        for t in [1.0, 0.3, 1e-2].map(|share| share * reach) {
            let error = (table.parts(ALL[3], t).value(t) - exact(ALL[3], t)).abs();
            assert!(error < 1e-6, "reach {reach:e}: {error:e}");
        }
    }
}

/// With a jump and a logarithm, which are summed up of octaves here.
#[test]
fn kernels_of_a_rational_response_are_si_and_ci() {
    let response = Rational::knowing(0);
    for (reach, accuracy) in [(0.4, 1e-10), (8.0, 1e-8), (40.0, 1e-10)] {
        let table = table(&response, reach, &ALL, accuracy);
        let bound = table.error().expect("a bound");
        assert!(bound <= 2.0 * accuracy, "reach {reach}: {bound:e}");
        for t in distances(&*table, reach) {
            for component in ALL {
                let error = felt(component, t, (table.parts(component, t).value(t) - exact(component, t)).abs());
                assert!(error <= accuracy, "{component:?}, reach {reach}, t = {t:e}: {error:e}");
            }
        }
    }
}

/// Beside the origin, where waves end, what is left out of the slope is as good as nothing to a contact: the integral
/// over the nearest distances is that of `split`, whose jump is exact.
#[test]
fn what_fades_out_is_not_felt() {
    let (response, reach) = (Rational::knowing(usize::MAX), 0.4);
    let request = KernelRequest { reach, components: &ALL[..1], accuracy: 1e-8 };
    let sharp = Split::default().tabulate(&response, &request).expect("a table");
    let faded = table(&response, reach, &ALL[..1], 1e-8);
    let nearest = faded.nearest().expect("a kernel of any power");
    let step = nearest / 64.0;
    let missing: f64 = (0..64 * 400)
        .map(|i| {
            let t = (f64::from(i) + 0.5) * step;
            step * (sharp.parts(ALL[0], t).value(t) - faded.parts(ALL[0], t).value(t))
        })
        .sum();
    assert!(missing.abs() < 3.0 * nearest && nearest < 1e-3 * reach, "{missing:e} at {nearest:e}");
}
