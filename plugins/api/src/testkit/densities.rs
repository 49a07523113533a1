//! What every quadrature promises of densities that it is to find, and of kernels beside the Cauchy part: against
//! closed forms.

use super::rules::solve;
use crate::contract::ensure;
use crate::{Component, Edge, KernelTable, Parity, Parts, PartsMut, Quadrature, Rule, Span, Station};
use std::f64::consts::{FRAC_1_PI, PI};

/// Half of the intervals: not 1, lest a power of it be missing.
const HALF_WIDTH: f64 = 3.0;
/// How many steps finer than at first the rules are, or as many less as they refuse.
const FINER: u32 = 4;
/// What they may be off by, over the largest: what is looked for is smooth, and so are the kernels; rules of the second
/// order have some dozens of unknowns by then.
const WITHIN: f64 = 1e-3;
/// Where densities are looked at, over the half-width.
const AT: [f64; 6] = [-0.9, -0.35, 0.0, 0.2, 0.65, 0.97];

/// Finds a parabola's pressure, a shear amid slip, and a flat punch's pressure under a kernel.
pub(super) fn quadrature(config: &dyn Quadrature) -> Result<(), String> {
    let rule = |parity, edge| {
        let span = Span::symmetric(HALF_WIDTH, parity, edge);
        let finest = (0..=FINER).rev().find_map(|level| config.refined(level).rule(&span).ok());
        finest.ok_or_else(|| format!("there is no rule for {parity:?} {edge:?}"))
    };
    smooth(&mut *rule(Parity::Even, Edge::Smooth)?).map_err(|fault| format!("Even Smooth: {fault}"))?;
    continued(&mut *rule(Parity::Odd, Edge::Continued)?).map_err(|fault| format!("Odd Continued: {fault}"))?;
    sharp(&mut *rule(Parity::Even, Edge::Sharp)?).map_err(|fault| format!("Even Sharp: {fault}"))
}

/// `(1/pi) PV int sqrt(c^2 - r^2)/(x - r) dr = x`.
fn smooth(rule: &mut dyn Rule) -> Result<(), String> {
    let (rows, right) = equations(rule, None, |x| x);
    let unknowns = solve(&rows, &right);
    let root = |x: f64| (HALF_WIDTH * HALF_WIDTH - x * x).sqrt();
    values(rule, &unknowns, root)?;
    resultant(rule, &unknowns, 0.5 * PI * HALF_WIDTH * HALF_WIDTH)
}

/// `(1/pi) PV int r sqrt(c^2 - r^2)/(x - r) dr = x^2 - c^2/2`. One equation too many: how much a constant is to be
/// added to what is given, which is nothing.
fn continued(rule: &mut dyn Rule) -> Result<(), String> {
    let square = HALF_WIDTH * HALF_WIDTH;
    let (rows, right) = equations(rule, None, |x| x * x - 0.5 * square);
    let scale = scale(rule);
    let constant = scale.into_iter().chain(rule.edge_condition().map(|_| 0.0));
    let with_constant: Vec<f64> =
        rows.chunks(rule.unknowns()).zip(constant).flat_map(|(row, one)| row.iter().copied().chain([-one])).collect();
    let mut unknowns = solve(&with_constant, &right);
    let constant = unknowns.pop().expect("the constant");
    ensure(constant.abs() < WITHIN * square, || format!("what belongs to x sqrt(c^2 - x^2) is off by {constant}"))?;
    values(rule, &unknowns, |x| x * (square - x * x).sqrt())
}

/// Under `k(t) = t` a flat punch bears `p = (P/pi) [1 + x^2 - c^2/2]/sqrt(c^2 - x^2)`, and `1 + t^2` of it makes the
/// potential `(P/pi) (1 + c^2/2 + c^4/8)` in the middle.
fn sharp(rule: &mut dyn Rule) -> Result<(), String> {
    let square = HALF_WIDTH * HALF_WIDTH;
    let slope = Smooth(|t| t);
    let (mut rows, mut right) = equations(rule, Some((&slope, Component::NormalSlope)), |_| 0.0);
    let from = rows.len();
    rows.resize(from + rule.unknowns(), 0.0);
    rule.resultant_into(&mut rows[from..]);
    right.push(1.0);
    let unknowns = solve(&rows, &right);
    let over_root = |x: f64| FRAC_1_PI * (1.0 + x * x - 0.5 * square) / (square - x * x).sqrt();
    values(rule, &unknowns, over_root)?;
    let depth = Smooth(|t| 1.0 + t * t);
    let found = rule.potential_at_centre(&unknowns, (&depth, Component::Depth));
    let expected = FRAC_1_PI * (1.0 + 0.5 * square + 0.125 * square * square);
    ensure((found / expected - 1.0).abs() < WITHIN, || {
        format!("the potential of k = 1 + t^2 in the middle is {found}, but it is {expected}")
    })
}

/// A kernel that is nothing but smooth.
struct Smooth(fn(f64) -> f64);

impl KernelTable for Smooth {
    fn parts_into(&self, _: Component, distances: &[f64], out: PartsMut) {
        out.fill(distances, |t| Parts { smooth: (self.0)(t), ..Parts::default() });
    }

    fn length(&self) -> f64 {
        10.0 * HALF_WIDTH
    }

    fn flexibility_evaluations(&self) -> usize {
        0
    }
}

/// Factors of the rows of points.
fn scale(rule: &dyn Rule) -> Vec<f64> {
    rule.row_scale().map_or_else(|| vec![1.0; rule.collocation().len()], <[f64]>::to_vec)
}

/// The rows of a rule with its condition at the edge, and their right-hand sides where the density makes `given`.
fn equations(
    rule: &mut dyn Rule,
    kernel: Option<(&dyn KernelTable, Component)>,
    given: impl Fn(f64) -> f64,
) -> (Vec<f64>, Vec<f64>) {
    let (n, points) = (rule.unknowns(), rule.collocation().len());
    let mut rows = vec![0.0; n * points];
    rule.operator_into(kernel, &mut rows);
    let mut right: Vec<f64> = rule.collocation().iter().zip(scale(rule)).map(|(at, by)| by * given(at.x)).collect();
    if let Some(condition) = rule.edge_condition() {
        rows.extend_from_slice(condition);
        right.push(0.0);
    }
    (rows, right)
}

/// The values of a density are those of a function.
fn values(rule: &dyn Rule, unknowns: &[f64], expected: impl Fn(f64) -> f64) -> Result<(), String> {
    let stations = AT.map(|share| Station { x: share * HALF_WIDTH, gap: (1.0 - share.abs()) * HALF_WIDTH });
    let largest = stations.iter().map(|at| expected(at.x).abs()).fold(0.0, f64::max);
    let mut found = [f64::NAN; AT.len()];
    rule.values_into(unknowns, &stations, &mut found);
    for (at, found) in stations.iter().zip(found) {
        let expected = expected(at.x);
        ensure((found - expected).abs() < WITHIN * largest, || {
            format!("the density at {} is {found}, but it is {expected}", at.x)
        })?;
    }
    Ok(())
}

/// The integral of a density is a number.
fn resultant(rule: &dyn Rule, unknowns: &[f64], expected: f64) -> Result<(), String> {
    let mut row = vec![0.0; unknowns.len()];
    rule.resultant_into(&mut row);
    let found: f64 = row.iter().zip(unknowns).map(|(weight, unknown)| weight * unknown).sum();
    ensure((found / expected - 1.0).abs() < WITHIN, || format!("the resultant is {found}, but it is {expected}"))
}

#[cfg(test)]
mod tests;
