//! The rule against integrals in closed form.

use super::*;
use slipzone_api::reference::{flat_punch, partial_slip};
use slipzone_api::{Component, Density, KernelTable, Parts, Station};
use std::f64::consts::PI;

fn rule(c: f64, parity: Parity, edge: Edge, nodes: usize, panels: usize) -> Box<dyn Rule> {
    let quadrature = GradedPanels { nodes: Some(Count(nodes)), panels: Some(Count(panels)), level: 0 };
    quadrature.rule(&Span::symmetric(c, parity, edge)).expect("a symmetric span")
}

fn operator(rule: &mut dyn Rule, kernel: Option<(&dyn KernelTable, Component)>) -> Vec<f64> {
    let mut rows = vec![0.0; rule.unknowns() * rule.collocation().len()];
    rule.operator_into(kernel, &mut rows);
    rows
}

/// Gaussian elimination with partial pivoting; `a` is square, row by row.
fn solve(mut a: Vec<f64>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|i, j| a[i * n + k].abs().total_cmp(&a[j * n + k].abs())).expect("rows left");
        for j in 0..n {
            a.swap(k * n + j, pivot * n + j);
        }
        b.swap(k, pivot);
        for i in k + 1..n {
            let factor = a[i * n + k] / a[k * n + k];
            for j in k..n {
                a[i * n + j] -= factor * a[k * n + j];
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        for j in k + 1..n {
            b[k] -= a[k * n + j] * b[j];
        }
        b[k] /= a[k * n + k];
    }
    b
}

/// Friction coefficient over `beta` at which the half-plane's stick zone ends at `a` (b = 1).
fn stick_friction(one_minus: f64, nodes: usize, panels: usize) -> f64 {
    let a = 1.0 - one_minus;
    let mut rule = rule(a, Parity::Odd, Edge::Continued, nodes, panels);
    let rows = operator(rule.as_mut(), None);
    let n = rule.unknowns();
    let outer = one_minus * (1.0 + a);
    let scale = rule.row_scale().expect("scaled").to_vec();
    let (mut matrix, mut right) = (Vec::new(), Vec::new());
    for ((row, at), scale) in rows.chunks(n).zip(rule.collocation()).zip(scale) {
        let inner = at.gap * (2.0 * a - at.gap);
        let s = (outer + inner).sqrt();
        let slip = -2.0 * (s + outer.sqrt()).ln() + inner.ln();
        matrix.extend_from_slice(row);
        matrix.push(scale * slip / (PI * PI * s));
        right.push(-scale / (PI * s));
    }
    *solve(matrix, right).last().expect("eta")
}

#[test]
fn experiment() {
    for (m, l) in [(6, 3), (7, 4), (9, 5), (11, 6), (13, 7), (15, 9), (18, 11), (21, 13)] {
        for k in [1e-3, 0.5, 0.1, 1e-2, 1e-4, 1e-6, 1e-8, 1e-12] {
            let k: f64 = k;
            let (one_minus, what) = if k == 1e-3 { (1.0 - k, "k") } else { (k, "1-k") };
            let got = stick_friction(one_minus, m, l);
            let exact = partial_slip::friction(partial_slip::Stick::from_one_minus_ratio(one_minus), 1.0);
            print!("  {what}={k:.0e}: {:.1e}", got / exact - 1.0);
        }
        println!("   ({m},{l})");
    }
}
