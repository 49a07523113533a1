//! The rule against integrals in closed form, and whole equations against themselves.

mod measure;

use super::*;
use slipzone_api::{Component, Density, KernelTable, Parts, Station};

/// A made-up kernel `smooth(t) + sign(t) sign(t) + log|t| log(t)`.
struct Made<S: Fn(f64) -> Parts + Send + Sync> {
    parts: S,
    length: f64,
}

impl<S: Fn(f64) -> Parts + Send + Sync> KernelTable for Made<S> {
    fn parts_into(&self, _: Component, distances: &[f64], out: &mut [Parts]) {
        for (t, out) in distances.iter().zip(out) {
            *out = (self.parts)(*t);
        }
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn flexibility_evaluations(&self) -> usize {
        0
    }
}

fn rule_of(c: f64, parity: Parity, edge: Edge, resolution: Resolution) -> DeSincRule {
    DeSincRule::new(c, resolution, resolution::grid(resolution, parity == Parity::Odd, edge))
}

fn operator(rule: &mut dyn Rule, kernel: Option<(&dyn KernelTable, Component)>) -> Vec<f64> {
    let mut rows = vec![0.0; rule.unknowns() * rule.collocation().len()];
    rule.operator_into(kernel, &mut rows);
    rows
}

/// Gaussian elimination with row pivoting; `matrix` is row-major.
fn solve(matrix: &[f64], right: &[f64]) -> Vec<f64> {
    let n = right.len();
    let mut rows: Vec<Vec<f64>> = matrix.chunks(n).zip(right).map(|(r, b)| [r, &[*b]].concat()).collect();
    for k in 0..n {
        let pivot = (k..n).max_by(|a, b| rows[*a][k].abs().total_cmp(&rows[*b][k].abs())).expect("a row");
        rows.swap(k, pivot);
        let (done, below) = rows.split_at_mut(k + 1);
        let top = &done[k];
        for row in below {
            let factor = row[k] / top[k];
            for (entry, t) in row[k..].iter_mut().zip(&top[k..]) {
                *entry -= factor * t;
            }
        }
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| rows[k][j] * x[j]).sum();
        x[k] = (rows[k][n] - known) / rows[k][k];
    }
    x
}

/// A flat punch under unit force.
fn flat_punch(rule: &mut DeSincRule, kernel: Option<&dyn KernelTable>) -> Vec<f64> {
    let mut rows = operator(rule, kernel.map(|k| (k, Component::NormalSlope)));
    let mut last = vec![0.0; rule.unknowns()];
    rule.resultant_into(&mut last);
    rows.extend(&last);
    let mut right = vec![0.0; rule.unknowns()];
    right[rule.unknowns() - 1] = 1.0;
    solve(&rows, &right)
}

fn pressure(rule: &DeSincRule, unknowns: &[f64], x: f64, gap: f64) -> f64 {
    rule.value(Density { unknowns, carrier: 0.0 }, Station { x, gap })
}
