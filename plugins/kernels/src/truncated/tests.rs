//! Against kernels in closed form.

use super::*;
use crate::rational::{Rational, exact};
use std::sync::atomic::Ordering;

const ALL: [Component; 4] = [Component::NormalSlope, Component::ShearStrain, Component::Coupling, Component::Depth];

fn table(response: &dyn LayerResponse, level: u32, components: &[Component]) -> Box<dyn KernelTable> {
    let request = KernelRequest { reach: 2.0, components, accuracy: 1e-10 };
    Truncated::default().refined(level).tabulate(response, &request).expect("within reach")
}

/// Largest error over `0.25 <= |t| <= 2`, ten wavelengths of the ripples at the coarsest cut-off.
fn error(response: &dyn LayerResponse, level: u32, component: Component) -> f64 {
    let table = table(response, level, &[component]);
    let t: Vec<f64> = (0..=400).map(|i| 0.25 + 1.75 * f64::from(i) / 400.0).flat_map(|t| [t, -t]).collect();
    t.iter().map(|&t| (table.parts(component, t).value(t) - exact(component, t)).abs()).fold(0.0, f64::max)
}

#[test]
fn converges_to_second_order_in_the_cutoff() {
    let response = Rational::knowing(1);
    for component in ALL {
        let errors: Vec<f64> = (1..5).map(|level| error(&response, level, component)).collect();
        // What is left of the tail is 1/s^2, and 1/s^3 for the depth, which has one more 1/s.
        let order = if component == Component::Depth { 3.0 } else { 2.0 };
        for pair in errors.windows(2) {
            let observed = (pair[0] / pair[1]).log2();
            assert!((observed - order).abs() < 0.3, "{component:?}: order {observed:.2}, errors {errors:?}");
        }
    }
}

#[test]
fn without_the_leading_term_it_converges_to_first_order() {
    let response = Rational::default();
    let errors: Vec<f64> = (0..4).map(|level| error(&response, level, Component::NormalSlope)).collect();
    for pair in errors.windows(2) {
        assert!(((pair[0] / pair[1]).log2() - 1.0).abs() < 0.3, "{errors:?}");
    }
}

#[test]
fn the_parts_are_the_jump_and_the_logarithm() {
    let response = Rational::knowing(1);
    let table = table(&response, 0, &ALL);
    let at_origin = |component| table.parts(component, 0.0);
    // k_vv(0+) = -f(0+) = -pi/2; g(t) = -log t - euler + ..., and an odd smooth part vanishes at 0.
    let slope = at_origin(Component::NormalSlope);
    assert_eq!((slope.smooth, slope.sign, slope.log), (0.0, -FRAC_PI_2, 0.0));
    // What the cut leaves out at the origin: int_S^inf [1/s - 1/(1+s)] ds, and of the depth
    // int_S^inf 1/(s^2 (1+s)) ds.
    let s = FIRST_CUTOFF;
    let left_out = (1.0 / s).ln_1p();
    for (component, left_out) in [(Component::Coupling, left_out), (Component::Depth, left_out - 1.0 / s)] {
        let parts = at_origin(component);
        assert_eq!((parts.sign, parts.log), (0.0, -1.0), "{component:?}");
        // exp(-S), which the depth takes to be nothing, is 2e-9 at this coarsest cut-off.
        let expected = -0.577_215_664_901_532_9 + left_out;
        assert!((parts.smooth - expected).abs() < 2e-9, "{component:?}: {parts:?} against {expected}");
    }
}

#[test]
fn evaluates_the_flexibility_once_for_all_kernels() {
    let response = Rational::knowing(1);
    let counted = table(&response, 0, &ALL).flexibility_evaluations();
    assert_eq!(response.asked.load(Ordering::Relaxed), counted);
    assert!(counted <= 17 * 14, "{counted} wave numbers for a cut-off of 40");
}

#[test]
fn refuses_a_contact_too_wide_for_its_layer() {
    let response = Rational::knowing(1);
    let request = KernelRequest { reach: 1e6, components: &[Component::NormalSlope], accuracy: 1e-10 };
    let refusal = Truncated::default().tabulate(&response, &request).err().expect("a refusal");
    assert!(refusal.to_string().contains("more work than it is worth"), "{refusal}");
}
