//! The Cauchy part, the resultant and the values.

use super::*;

/// The pairs of which the contract says nothing.
#[test]
fn odd_densities_have_no_resultant_to_be_given() {
    for (edge, excess) in [(Edge::Sharp, 0), (Edge::Smooth, 1)] {
        let rule = rule(1.0, Parity::Odd, edge, 7, 4);
        assert_eq!(rule.collocation().len(), rule.unknowns() + excess, "{edge:?}");
        assert!(rule.edge_condition().is_none());
    }
}

/// `T_k` and `U_k` are no polynomials of the angle; over the longest panel (half-length 0.39) degree 20 leaves
/// `(6 0.39/2)^20/20! = 1e-17` of `cos(6 theta)`.
#[test]
fn cauchy_integrals_of_chebyshev_polynomials() {
    let (c, nodes, panels) = (2.5, 20, 6);
    let check = |parity, edge, polynomial: &dyn Fn(f64) -> f64, exact: &dyn Fn(f64) -> f64| {
        let mut rule = rule(c, parity, edge, nodes, panels);
        let rows = operator(rule.as_mut(), None);
        let got = apply(&rows, &unknowns(parity, edge, nodes, panels, polynomial));
        for ((got, at), scale) in got.iter().zip(rule.collocation()).zip(row_scale(rule.as_ref())) {
            let angle = 2.0 * (0.5 * at.gap / c).sqrt().asin();
            assert_close(*got, scale * exact(angle), 1e-12, &format!("{parity:?} {edge:?} at {angle}"));
        }
    };
    // (1/pi) PV int T_k(t)/((x - t) sqrt(1 - t^2)) dt = -U_{k-1}(x).
    for (k, parity) in [(4.0, Parity::Even), (5.0, Parity::Odd)] {
        check(parity, Edge::Sharp, &|a| (k * a).cos(), &|a| -(k * a).sin() / a.sin());
    }
    // (1/pi) PV int U_k(t) sqrt(1 - t^2)/(x - t) dt = T_{k+1}(x); f = F where smooth, F/sin where continued.
    for (k, parity) in [(4.0, Parity::Even), (5.0, Parity::Odd)] {
        check(parity, Edge::Smooth, &|a| ((k + 1.0) * a).sin(), &|a| ((k + 1.0) * a).cos());
    }
    check(Parity::Odd, Edge::Continued, &|a| (6.0 * a).sin() * a.sin(), &|a| (6.0 * a).cos());
    // The density t: t ln((1 + t)/(1 - t)) - 2 over pi, from which the end value has its logarithm.
    check(Parity::Odd, Edge::Continued, &|a| a.cos() * a.sin(), &|a| {
        (-2.0 * a.cos() * (0.5 * a).tan().ln() - 2.0) / PI
    });
}

/// `f = (1 - t^2) atanh(t)` is `gap log gap` at the end. By Tricomi's `2 H(u H u) = (H u)^2 - u^2` with `u = 1`,
/// `(1/pi) PV int atanh(r)/(x - r) dr = atanh(x)^2/pi - pi/4`, whence that of `f`.
#[test]
fn a_density_with_gap_log_gap_converges_exponentially() {
    let atanh = |angle: f64| -(0.5 * angle).tan().ln();
    let errors: Vec<f64> = [(6, 3), (9, 5), (12, 6), (15, 8)]
        .into_iter()
        .map(|(nodes, panels)| {
            let mut rule = rule(1.0, Parity::Odd, Edge::Smooth, nodes, panels);
            let rows = operator(rule.as_mut(), None);
            let density = |a: f64| a.sin().powi(2) * atanh(a);
            let got = apply(&rows, &unknowns(Parity::Odd, Edge::Smooth, nodes, panels, density));
            let exact = |at: &Station| {
                let angle = 2.0 * (0.5 * at.gap).sqrt().asin();
                angle.sin().powi(2) * (atanh(angle).powi(2) / PI - 0.25 * PI) + 1.0 / PI
            };
            let error = |(got, at): (&f64, &Station)| (got - exact(at)).abs();
            got.iter().zip(rule.collocation()).map(error).fold(0.0, f64::max)
        })
        .collect();
    // Measured: 5e-6, 3e-9, 7e-11, 3e-13.
    assert!(errors.windows(2).all(|pair| pair[1] < 0.05 * pair[0]), "{errors:?}");
    assert!(errors[3] < 3e-12, "{errors:?}");
}

type OfAngle<'a> = &'a dyn Fn(f64) -> f64;

/// Relative accuracy, down to gaps far below the innermost panel.
#[test]
fn values_keep_their_digits_towards_the_end() {
    let (c, nodes, panels) = (2.0, 16, 5);
    // f = (1 + t^2)/sin, (1 + t^2) sin, t: at the end unbounded, zero and finite.
    let polynomial = |a: f64| 1.0 + a.cos().powi(2);
    let cases: [(Parity, Edge, OfAngle, OfAngle); 3] = [
        (Parity::Even, Edge::Sharp, &polynomial, &|a| polynomial(a) / a.sin()),
        (Parity::Even, Edge::Smooth, &|a| polynomial(a) * a.sin(), &|a| polynomial(a) * a.sin()),
        (Parity::Odd, Edge::Continued, &|a| a.cos() * a.sin(), &|a| a.cos()),
    ];
    for (parity, edge, of_polynomial, of_density) in cases {
        let rule = rule(c, parity, edge, nodes, panels);
        let unknowns = unknowns(parity, edge, nodes, panels, of_polynomial);
        for gap in [1e-15, 1e-9, 1e-4, 0.3, 1.1, 1.7_f64] {
            let exact = of_density(2.0 * (0.5 * gap / c).sqrt().asin());
            let got = value(rule.as_ref(), &unknowns, Station { x: c - gap, gap });
            assert_close(got / exact, 1.0, 1e-12, &format!("{edge:?} at gap {gap:e}"));
            let mirrored = value(rule.as_ref(), &unknowns, Station { x: gap - c, gap });
            let sign = parity.mirror();
            assert_close(mirrored, sign * got, 0.0, "mirror image");
        }
    }
}
