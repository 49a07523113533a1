//! Small contact problems.

use super::*;
use slipzone_api::reference::partial_slip::{self, Stick};

/// Friction coefficient over `beta` at which the stick zone under a flat punch on a half-plane ends at
/// `1 - one_minus` of the half-width 1.
///
/// `H q + eta J = -beta p` with `p = 1/(pi s)`, `s^2 = 1 - x^2`, and `J` the share of the slip zones,
/// `-ln((s + w)/(s - w))/(pi^2 s)`, `w^2 = 1 - a^2`.
fn stick_friction(one_minus: f64, nodes: usize, panels: usize) -> f64 {
    let a = 1.0 - one_minus;
    let mut rule = rule(a, Parity::Odd, Edge::Continued, nodes, panels);
    let rows = operator(rule.as_mut(), None);
    let outer = one_minus * (1.0 + a);
    let (mut matrix, mut right) = (Vec::new(), Vec::new());
    for ((row, at), scale) in rows.chunks(rule.unknowns()).zip(rule.collocation()).zip(row_scale(rule.as_ref())) {
        let inner = at.gap * (2.0 * a - at.gap);
        let s = (outer + inner).sqrt();
        matrix.extend_from_slice(row);
        matrix.push(-scale * (2.0 * (s + outer.sqrt()).ln() - inner.ln()) / (PI * PI * s));
        right.push(-scale / (PI * s));
    }
    *solve(&matrix, &right).last().expect("eta")
}

#[test]
fn stick_zones_on_a_half_plane_of_any_size() {
    // Branch point of p at the distance 1 - a beyond the end of the stick zone: panels down to
    // pi/4 4^-10 = 7e-7 serve gaps down to its square.
    for one_minus in [1.0 - 1e-3, 0.5, 0.1, 1e-2, 1e-4, 1e-6, 1e-9, 1e-12] {
        let exact = partial_slip::friction(Stick::from_one_minus_ratio(one_minus), 1.0);
        let got = stick_friction(one_minus, 18, 12);
        // 216 unknowns, condition below 1e3: 1e-13 of rounding at most.
        assert_close(got / exact, 1.0, 1e-13, &format!("eta/beta at 1 - a/b = {one_minus:e}"));
    }
    // Few unknowns where the zones are of like size.
    let exact = partial_slip::friction(Stick::from_ratio(0.5), 1.0);
    assert_close(stick_friction(0.5, 9, 3) / exact, 1.0, 1e-10, "27 unknowns");
}

/// `H p = x/c` has the solution `sqrt(c^2 - x^2)/c`.
#[test]
fn a_parabola_on_a_half_plane_to_its_edge() {
    let c = 2.0;
    let mut rule = rule(c, Parity::Even, Edge::Smooth, 16, 6);
    let matrix = operator(rule.as_mut(), None);
    let right: Vec<f64> = rule.collocation().iter().map(|at| at.x / c).collect();
    let unknowns = solve(&matrix, &right);
    let mut row = vec![0.0; rule.unknowns()];
    rule.resultant_into(&mut row);
    assert_close(apply(&row, &unknowns)[0], 0.5 * PI * c, 1e-13, "resultant");
    for gap in [2.0, 0.1, 1e-3, 1e-5, 1e-7] {
        let exact = (gap * (2.0 * c - gap)).sqrt() / c;
        // Rounding of the right side is amplified like its own size over sqrt(gap).
        let tolerance = 1e-13 + 1e-14 / exact;
        let got = value(rule.as_ref(), &unknowns, Station { x: c - gap, gap });
        assert_close(got / exact, 1.0, tolerance, &format!("pressure at gap {gap:e}"));
    }
}

/// Odd, with jump and logarithm, as the slope under pressure on a graded layer; poles at `+-i length`.
fn graded(t: f64, length: f64) -> Parts {
    let s = t / length;
    let fade = 1.0 / (1.0 + s * s);
    Parts { smooth: -s * fade / length, sign: 0.6 * fade / length, log: 0.4 * s * fade / length }
}

/// `-1/t + pi/(2 h sinh(pi t/2h))`, `h` half the length: with the Cauchy kernel it decays exponentially.
fn local(t: f64, length: f64) -> Parts {
    let scale = PI / length;
    let z = scale * t;
    // 1/sinh(z) - 1/z; the next term of the series is 31/15120 z^5 = 1e-16 of the first at 0.01.
    let rest = if z.abs() < 0.01 { z * (-1.0 / 6.0 + z * z * (7.0 / 360.0)) } else { 1.0 / z.sinh() - 1.0 / z };
    Parts { smooth: scale * rest, ..Parts::default() }
}

/// Edge factor, pressure in the middle, off it, and near the edge, under a flat punch of half-width 1 and
/// unit force.
fn flat_punch(kernel: &dyn KernelTable, nodes: usize, panels: usize) -> [f64; 4] {
    let mut rule = rule(1.0, Parity::Even, Edge::Sharp, nodes, panels);
    let mut matrix = operator(rule.as_mut(), Some((kernel, Component::NormalSlope)));
    let mut row = vec![0.0; rule.unknowns()];
    rule.resultant_into(&mut row);
    matrix.extend_from_slice(&row);
    let mut right = vec![0.0; rule.unknowns()];
    *right.last_mut().expect("one at least") = 1.0;
    let unknowns = solve(&matrix, &right);
    let pressure = |gap: f64| value(rule.as_ref(), &unknowns, Station { x: 1.0 - gap, gap });
    [rule.edge_factor(&unknowns), pressure(1.0), pressure(0.3), pressure(1e-6)]
}

fn largest_difference(one: [f64; 4], other: [f64; 4]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn a_graded_kernel_gains_digits_at_every_level() {
    let kernel = Made { parts: |t| graded(t, 1.0), length: 1.0 };
    let best = flat_punch(&kernel, 22, 11);
    // The solver's own ladder. Measured: 3e-6, 4e-8, 1e-9, 2e-11, 2e-14.
    let errors: Vec<f64> = (0..5)
        .map(|level| GradedPanels { level, ..GradedPanels::default() }.counts())
        .map(|(nodes, panels)| largest_difference(flat_punch(&kernel, nodes, panels), best))
        .collect();
    // A digit at least for every factor of 1.4 to 1.8 in the unknowns; at the end 106 of them reach rounding.
    assert!(errors.windows(2).all(|pair| pair[1] < 0.1 * pair[0]), "{errors:?}");
    assert!(errors[0] < 1e-5 && errors[4] < 1e-12, "{errors:?}");
}

#[test]
fn thin_layers_agree_with_more_than_twice_the_unknowns() {
    // Contacts of 20 and 200 thicknesses, 107 unknowns in either case. Measured: 6e-11 and 4e-11.
    for length in [0.1, 0.01] {
        let kernel = Made { parts: |t| local(t, length), length };
        let error = largest_difference(flat_punch(&kernel, 15, 7), flat_punch(&kernel, 22, 11));
        assert!(error < 2e-10, "length {length}: {error:.1e}");
    }
}
