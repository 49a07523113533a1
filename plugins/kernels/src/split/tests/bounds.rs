//! Errors and their bounds: against closed forms, direct quadrature, another strategy and other cuts.

use super::*;
use crate::Truncated;
use crate::rational::{Rational, exact};
use proptest::prelude::*;

/// `mu = (1 + slope y)^2`: its series in `1/s` diverges.
#[derive(Debug)]
struct Quadratic(f64);

impl ModulusLaw for Quadratic {
    fn modulus(&self, depth: f64) -> f64 {
        (1.0 + self.0 * depth).powi(2)
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        let mut series = vec![1.0, 2.0 * self.0, self.0 * self.0];
        series.resize(terms, 0.0);
        series
    }
}

/// Largest difference, in the terms in which accuracy is asked for.
fn distance(component: Component, reach: f64, a: &[f64], b: &[f64]) -> f64 {
    let scale = if component == Component::Depth { 1.0 } else { reach };
    scale * a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn kernels_of_a_rational_response_are_si_and_ci() {
    let response = Rational::knowing(usize::MAX);
    for (reach, accuracy) in [(0.01, 1e-10), (0.4, 1e-4), (0.4, 1e-12), (2.0, 1e-10), (8.0, 1e-8), (40.0, 1e-10)] {
        let table = table(&response, reach, &ALL, accuracy);
        let bound = bound(&*table);
        assert!(bound <= accuracy, "reach {reach}: {bound:e} for {accuracy:e}");
        let t = distances(reach);
        for component in ALL {
            let expected: Vec<f64> = t.iter().map(|t| exact(component, *t)).collect();
            let error = distance(component, reach, &values(&*table, component, &t), &expected);
            // The closed form itself cancels two digits at t = 40.
            assert!(error <= bound + 1e-14 * reach, "{component:?}, reach {reach}: {error:e} above {bound:e}");
        }
    }
}

#[test]
fn a_series_that_is_short_or_unknown_widens_the_bound_and_never_breaks_it() {
    for terms in [0, 1, 2, 5] {
        let (reach, accuracy) = (0.4, 1e-10);
        let table = table(&Rational::knowing(terms), reach, &ALL, accuracy);
        let bound = bound(&*table);
        let t = distances(reach);
        for component in ALL {
            let expected: Vec<f64> = t.iter().map(|t| exact(component, *t)).collect();
            let error = distance(component, reach, &values(&*table, component, &t), &expected);
            assert!(error <= bound, "{terms} terms, {component:?}: {error:e} above {bound:e}");
        }
        if terms == 0 {
            assert!(bound > 1e-3, "nothing is known beyond the cut: {bound:e}");
        }
    }
}

#[test]
fn agrees_with_direct_quadrature_between_the_zeros_of_the_wave() {
    // mu1/mu3, t/h, and k_vv, k_uu, k_uv, G/A0 at nu = 0.3: the integrals themselves by another program (eigenvectors
    // of the depth equation, 24 Gauss nodes between zeros, Euler's transformation of the alternating sum).
    let expected = [
        (8.0, 1.0, [0.528_393_873_017_2, 0.389_330_580_173_4, 0.719_212_076_489_0, 0.287_773_413_672_3]),
        (0.125, 1.0, [-0.982_313_945_399_5, -0.681_970_100_195_7, 0.016_553_721_732_8, -0.007_617_152_694_3]),
        (8.0, 0.25, [3.949_696_548_412_5, 1.362_550_735_758_9, 0.071_201_618_717_7, 3.288_570_110_730_7]),
        (0.125, 3.0, [-0.334_263_402_106_7, -0.313_102_088_450_9, -0.004_239_183_443_6, -0.000_667_362_740_8]),
    ];
    for (ratio, t, kernels) in expected {
        let response = layer(Exponential(-f64::ln(ratio)), 0.3);
        for accuracy in [1e-6, 1e-12] {
            let table = table(&*response, 4.0, &ALL, accuracy);
            for (component, kernel) in ALL.into_iter().zip(kernels) {
                let error = (values(&*table, component, &[t])[0] - kernel).abs();
                // The other program's last digits.
                assert!(error <= bound(&*table) + 1e-12, "{component:?}, ratio {ratio}, t = {t}: {error:e}");
            }
        }
    }
}

#[test]
fn agrees_with_the_truncated_integral_on_a_homogeneous_layer() {
    // There both converge exponentially.
    let response = layer(Exponential(0.0), 0.45);
    let (reach, accuracy) = (2.0, 1e-11);
    let own = table(&*response, reach, &ALL, accuracy);
    let request = KernelRequest { reach, components: &ALL, accuracy };
    let other = Truncated::default().refined(2).tabulate(&*response, &request).expect("a table");
    let t = distances(reach);
    for component in ALL {
        let error = distance(component, reach, &values(&*own, component, &t), &values(&*other, component, &t));
        // exp(-2 S) (2 S)^2 at S = 20, the coarsest cut-off of `truncated`, is 7e-15; its panels need two refinements.
        assert!(error < bound(&*own) + 1e-13, "{component:?}: {error:e}");
    }
}

#[test]
fn a_law_with_a_diverging_series_meets_its_bound() {
    let response = layer(Quadratic(0.5), 0.3);
    for (reach, accuracy) in [(0.4, 1e-8), (8.0, 1e-6)] {
        let own = table(&*response, reach, &NORMAL, accuracy);
        assert!(bound(&*own) <= accuracy, "{:e} for {accuracy:e}", bound(&*own));
        let pinned = Split { cutoff: Positive::new(24.0).ok(), terms: NonZeroU8::new(18) };
        let request = KernelRequest { reach, components: &NORMAL, accuracy: 1e-11 };
        let other = pinned.tabulate(&*response, &request).expect("a table");
        let t = distances(reach);
        for component in NORMAL {
            let error = distance(component, reach, &values(&*own, component, &t), &values(&*other, component, &t));
            assert!(error <= bound(&*own) + bound(&*other), "{component:?}, reach {reach}: {error:e}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    /// Two tables with different cuts, terms and accuracies are as near to each other as their bounds say.
    #[test]
    fn bounds_hold(
        gamma in -9.2_f64..9.2,
        nu in -0.99_f64..0.5,
        reach in (-5.0_f64..2.0).prop_map(|e| 10.0_f64.powf(e)),
        accuracy in (-12.0_f64..-3.0).prop_map(|e| 10.0_f64.powf(e)),
        further in 1.1_f64..2.0,
        frictional in any::<bool>(),
    ) {
        let response = layer(Exponential(gamma), nu);
        let components = if frictional { &ALL[..] } else { &NORMAL[..] };
        let own = table(&*response, reach, components, accuracy);
        let pinned = Split {
            cutoff: Positive::new(further * (20.0_f64).max(3.0 * gamma.abs())).ok(),
            terms: NonZeroU8::new(36),
        };
        let request = KernelRequest { reach, components: &ALL, accuracy: 1e-13 };
        let other = pinned.tabulate(&*response, &request).expect("a table");
        let t = distances(reach);
        let allowed = bound(&*own) + bound(&*other);
        // Rounding stands in the way of the finest, above all where a soft base makes the kernel large.
        let possible = accuracy.max(1e-12 * reach.max(1.0) * if gamma < -4.0 { 1000.0 } else { 30.0 });
        prop_assert!(bound(&*own) <= possible, "bound {:e} for {accuracy:e}", bound(&*own));
        for &component in components {
            let error = distance(component, reach, &values(&*own, component, &t), &values(&*other, component, &t));
            prop_assert!(error <= allowed, "{component:?}: {error:e} above {allowed:e}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// The same where a coarse table is made of a flexibility that is no better than it must be, before a fine one or
    /// after.
    #[test]
    fn bounds_hold_of_rough_flexibilities(
        slope in 0.05_f64..3.0,
        nu in -0.99_f64..0.5,
        reach in (-2.0_f64..0.7).prop_map(|e| 10.0_f64.powf(e)),
        accuracy in (-9.5_f64..-4.0).prop_map(|e| 10.0_f64.powf(e)),
        coarse_first in any::<bool>(),
    ) {
        let response = layer(Quadratic(slope), nu);
        let first = table(&*response, reach, &ALL, if coarse_first { accuracy } else { 1e-12 });
        let second = table(&*response, reach, &ALL, if coarse_first { 1e-12 } else { accuracy });
        let (coarse, fine) = if coarse_first { (first, second) } else { (second, first) };
        let allowed = bound(&*coarse) + bound(&*fine);
        prop_assert!(bound(&*coarse) <= accuracy, "{:e} for {accuracy:e}", bound(&*coarse));
        let t = distances(reach);
        for component in ALL {
            let error = distance(component, reach, &values(&*coarse, component, &t), &values(&*fine, component, &t));
            prop_assert!(error <= allowed, "{component:?}: {error:e} above {allowed:e}");
        }
    }
}
