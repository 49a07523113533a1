//! Whole equations: against closed forms and against themselves at twice the resolution.

use super::*;
use crate::fixtures;
use slipzone_api::reference::partial_slip::Stick;
use spec_math::cephes64::ellpk;
use std::f64::consts::PI;

/// Edge factor and pressure in the middle and at two gaps.
fn flat_numbers(kernel: &dyn KernelTable, n: usize) -> [f64; 4] {
    let mut rule = rule(1.0, Parity::Even, Edge::Sharp, n);
    let unknowns = flat_punch(rule.as_mut(), Some(kernel));
    let at = |gap: f64| value(rule.as_ref(), &unknowns, 1.0 - gap, gap);
    [rule.edge_factor(&unknowns), at(1.0), at(0.37), at(1e-12)]
}

fn worst(got: &[f64], exact: &[f64]) -> f64 {
    got.iter().zip(exact).map(|(g, e)| (g / e - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn eleven_digits_from_few_unknowns() {
    // A density with (c - x) log(c - x) in it, over a layer four times as thick as the contact is half-wide.
    let kernel = graded(4.0);
    let twice = flat_numbers(&kernel, 48);
    let once = flat_numbers(&kernel, 24);
    assert!(worst(&once[..2], &twice[..2]) < 1e-11, "edge factor and centre: {once:?}, {twice:?}");
    // Between the nodes half the digits' rate is to be had: sinc interpolation against trapezoidal sums.
    assert!(worst(&once, &twice) < 3e-9, "pressure anywhere: {once:?}, {twice:?}");
}

#[test]
fn convergence_is_exponential() {
    let kernel = graded(1.0);
    let exact = flat_numbers(&kernel, 96);
    let digits = [8, 16, 32].map(|n| -worst(&flat_numbers(&kernel, n), &exact).log10());
    // n/u_max, to which the digits should be proportional, grows by 1.6 and 1.7; the first end costs less than its
    // share.
    assert!(digits[1] > 1.4 * digits[0] && digits[2] > 1.45 * digits[1] && digits[2] > 11.0, "digits {digits:?}");
}

/// Kernel of a layer so thin that the whole of it, `(pi/2h)/sinh(pi t/2h)`, is local.
fn thin(h: f64) -> Made<impl Fn(f64) -> Parts + Send + Sync> {
    let parts = move |t: f64| {
        let y = 0.5 * PI * t / h;
        let difference = if y.abs() < 0.02 {
            y * (-1.0 / 6.0 + y * y * (7.0 / 360.0 - y * y * 31.0 / 15120.0))
        } else {
            1.0 / y.sinh() - 1.0 / y
        };
        Parts { smooth: 0.5 * PI / h * difference, ..Parts::default() }
    };
    Made { parts, length: h }
}

#[test]
fn thin_layers_are_summed_on_a_finer_grid() {
    let kernel = thin(0.03);
    let coarse = Made { parts: &kernel.parts, length: 10.0 };
    let exact = flat_numbers(&kernel, 128);
    let oversampled = worst(&flat_numbers(&kernel, 45)[..2], &exact[..2]);
    // 45 steps of the density give 3e-8; steps that the kernel outruns give nothing.
    assert!(oversampled < 1e-7, "oversampled: {oversampled:e}");
    let plain = worst(&flat_numbers(&coarse, 45)[..2], &exact[..2]);
    assert!(plain > 1e-3, "the same kernel said to be long: {plain:e}");
}

#[test]
fn potentials_agree_with_the_operator() {
    // K p at the collocation points, once as rows and once sampled and interpolated elsewhere.
    let kernel = thin(0.3);
    let mut fine = rule(1.0, Parity::Even, Edge::Sharp, 90);
    let unknowns = flat_punch(fine.as_mut(), Some(&kernel));
    let targets = [0.0, 0.2, -0.55, 0.97, 1.0].map(|x: f64| Station { x, gap: 1.0 - x.abs() });
    let potential = |rule: &mut dyn Rule, unknowns: &[f64]| {
        let (mut samples, mut out) = (Vec::new(), [0.0; 5]);
        rule.sample_potential(unknowns, (&kernel, Component::NormalSlope), &mut samples);
        rule.potential_into(&samples, (&kernel, Component::NormalSlope), &targets, &mut out);
        out
    };
    let exact = potential(fine.as_mut(), &unknowns);
    // The slope under a flat punch is zero, and so is the half of the operator that is the Cauchy part's.
    let mut half = rule(1.0, Parity::Even, Edge::Sharp, 45);
    let unknowns = flat_punch(half.as_mut(), Some(&kernel));
    let rows = operator(half.as_mut(), None);
    let (i, scale) = (7, half.row_scale().expect("scaled")[7]);
    let at = half.collocation()[i];
    let mut samples = Vec::new();
    half.sample_potential(&unknowns, (&kernel, Component::NormalSlope), &mut samples);
    let mut out = [0.0];
    half.potential_into(&samples, (&kernel, Component::NormalSlope), &[at], &mut out);
    assert_close(out[0], -dot(&rows[i * 46..(i + 1) * 46], &unknowns) / scale, 1e-12, "at a collocation point");
    for (got, exact) in potential(half.as_mut(), &unknowns).iter().zip(exact) {
        assert_close(*got, exact, 1e-9, "between them, by sinc interpolation");
    }
}

/// The shear that vanishes at the ends of a stick zone and outside, and strains it like a pressure of unit force beyond
/// which the contact goes on, but for a constant: that constant, and the shear at a gap.
///
/// The constant is the mean `(1/pi) int p/sqrt(a^2 - x^2) dx = 2 K(a)/pi^2`, the contact's half-width being 1.
fn stick(zone: Stick, n: usize, gap: f64) -> [f64; 2] {
    let mut rule = rule(zone.ratio, Parity::Odd, Edge::Continued, n);
    let rows = operator(rule.as_mut(), None);
    let (mut matrix, mut right) = (Vec::new(), Vec::new());
    for ((row, scale), at) in rows.chunks(n).zip(rule.row_scale().expect("scaled")).zip(rule.collocation()) {
        let root = ((zone.one_minus_ratio + at.gap) * (1.0 + at.x)).sqrt();
        matrix.extend_from_slice(row);
        matrix.push(*scale);
        right.push(scale / (PI * root));
    }
    matrix.extend_from_slice(rule.edge_condition().expect("a condition"));
    matrix.push(0.0);
    right.push(0.0);
    let mut unknowns = solve(&matrix, &right);
    let constant = unknowns.pop().expect("the last unknown");
    [constant, rule.value(&unknowns, Station { x: zone.ratio - gap, gap })]
}

#[test]
fn stick_zone_on_a_half_plane() {
    // The closer b comes to a, the more steps: p has a branch point there, on the map
    // d = 1/cosh u off the real axis, sinh u = ln(2 a/(b - a))/pi; the error is exp(-2 pi d n/u_max).
    for (zone, n) in [
        (Stick::from_ratio(1e-3), 16),
        (Stick::from_ratio(0.1), 16),
        (Stick::from_ratio(0.5), 22),
        (Stick::from_ratio(0.9), 32),
        (Stick::from_one_minus_ratio(1e-2), 45),
        (Stick::from_one_minus_ratio(1e-4), 64),
        (Stick::from_one_minus_ratio(1e-6), 90),
        (Stick::from_one_minus_ratio(1e-12), 181),
    ] {
        let [constant, _] = stick(zone, n, 0.1 * zone.ratio);
        let exact = 2.0 / (PI * PI) * ellpk(zone.one_minus_ratio * (1.0 + zone.ratio));
        assert_close(constant / exact, 1.0, 1e-10, &format!("the mean at {zone:?}"));
    }
}

#[test]
fn shear_in_the_stick_zone_converges_up_to_its_end() {
    let zone = Stick::from_ratio(0.5);
    let [_, scale] = stick(zone, 90, 0.4);
    // A rounding of the singular density stays, and beyond where the series is cut its first term stands for all.
    for (gap, tolerance) in [(0.4, 6e-11), (1e-2, 6e-11), (1e-6, 2e-10), (1e-12, 1e-9)] {
        let [[_, once], [_, twice]] = [45, 90].map(|n| stick(zone, n, gap));
        assert_close(once / scale, twice / scale, tolerance, &format!("q at gap {gap}"));
    }
}

#[test]
fn the_kernel_is_applied_to_what_is_finite_at_the_ends() {
    let mut rule = rule(2.0, Parity::Odd, Edge::Continued, 40);
    fixtures::applies_a_kernel_to_what_is_finite_at_the_ends(rule.as_mut(), 1e-9);
}

#[test]
fn a_parabola_on_a_half_plane() {
    // slope x: p = sqrt(1 - x^2), force pi/2; with x^3 added, p = (7/4 + U_2/4) sqrt(1 - x^2).
    let mut rule = rule(1.0, Parity::Even, Edge::Smooth, 40);
    let mut matrix = operator(rule.as_mut(), None);
    matrix.extend_from_slice(rule.edge_condition().expect("a condition"));
    let slopes = rule.collocation().iter().map(|v| v.x + v.x.powi(3));
    let mut right: Vec<f64> = slopes.zip(rule.row_scale().expect("scaled")).map(|(slope, s)| s * slope).collect();
    right.push(0.0);
    let unknowns = solve(&matrix, &right);
    for gap in [1.0, 0.3, 1e-3, 1e-6_f64] {
        let x = 1.0 - gap;
        let exact = (1.75 + 0.25 * (4.0 * x * x - 1.0)) * (gap * (2.0 - gap)).sqrt();
        // 1e-16 of the singular density that the edge condition holds down counts as 1e-16/gap.
        let got = value(rule.as_ref(), &unknowns, x, gap);
        assert_close(got / exact, 1.0, 1e-9, &format!("p at gap {gap}"));
    }
    let mut row = vec![0.0; unknowns.len()];
    rule.resultant_into(&mut row);
    assert_close(dot(&row, &unknowns), 0.875 * PI, 1e-12, "force");
}
