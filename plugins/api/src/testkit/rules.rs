//! What every quadrature promises of its rules.

use crate::contract::{self, ensure};
use crate::reference::flat_punch;
use crate::{Edge, Parity, Quadrature, Rule, Span, Station};

/// Equations are as many as the unknowns want, at points that ascend; a flat punch on a half-plane is exact.
pub(super) fn quadrature(config: &dyn Quadrature) -> Result<(), String> {
    for (parity, edge) in [(Parity::Even, Edge::Sharp), (Parity::Even, Edge::Smooth), (Parity::Odd, Edge::Continued)] {
        let rule = config.rule(&Span::symmetric(1.0, parity, edge)).map_err(|e| format!("no rule: {e}"))?;
        counts(&*rule, parity, edge).map_err(|fault| format!("{parity:?} {edge:?}: {fault}"))?;
    }
    let span = Span::symmetric(HALF_WIDTH, Parity::Even, Edge::Sharp);
    flat(config.rule(&span).map_err(|e| format!("no rule: {e}"))?.as_mut())
}

/// Of a rule on `[-1, 1]`.
fn counts(rule: &dyn Rule, parity: Parity, edge: Edge) -> Result<(), String> {
    let (unknowns, points) = (rule.unknowns(), rule.collocation());
    contract::rule(rule, parity, edge)?;
    // Points may be so near an end that their abscissae are equal: their gaps are not.
    let ascend = points.windows(2).all(|pair| pair[0].x <= pair[1].x && pair[0].gap > pair[1].gap);
    ensure(ascend && points.iter().all(|at| at.x >= 0.0), || format!("{points:?} do not ascend from the middle"))?;
    let apart = points.iter().find(|at| (at.x + at.gap - 1.0).abs() > 4.0 * f64::EPSILON);
    ensure(apart.is_none(), || format!("x and gap do not add up to the half-width at {apart:?}"))?;
    let mut row = vec![f64::NAN; unknowns];
    rule.resultant_into(&mut row);
    let is_resultant = row.iter().all(|weight| if parity == Parity::Odd { *weight == 0.0 } else { *weight > 0.0 });
    ensure(is_resultant, || format!("resultant_into() writes {row:?}"))
}

/// The half-width of the flat punch: not 1, lest a power of it be missing.
const HALF_WIDTH: f64 = 3.0;

/// `p = P/(pi sqrt(c^2 - x^2))` under a unit force: only rounding is left, that of an elimination.
fn flat(rule: &mut dyn Rule) -> Result<(), String> {
    const ROUNDING: f64 = 1e-12;
    let n = rule.unknowns();
    let mut rows = vec![0.0; n * n];
    rule.operator_into(None, &mut rows[..n * (n - 1)]);
    rule.resultant_into(&mut rows[n * (n - 1)..]);
    let mut right = vec![0.0; n];
    right[n - 1] = 1.0;
    let unknowns = solve(&rows, &right);
    let ratio = rule.edge_factor(&unknowns) / flat_punch::EDGE_RATIO;
    ensure((ratio - 1.0).abs() < ROUNDING, || format!("edge_factor() of a flat punch is {ratio} times what it is"))?;
    for gap in [HALF_WIDTH, 1.0, 1e-3, 1e-12, 1e-100] {
        let p = rule.value(&unknowns, Station { x: HALF_WIDTH - gap, gap });
        let ratio = p / flat_punch::pressure(1.0, HALF_WIDTH, gap);
        ensure((ratio - 1.0).abs() < ROUNDING, || {
            format!("value() under a flat punch is {ratio} times what it is at the gap {gap}")
        })?;
    }
    Ok(())
}

/// Gaussian elimination with partial pivoting, for tests; `matrix` is square, row by row.
///
/// # Panics
/// When the sizes do not fit.
pub fn solve(matrix: &[f64], right: &[f64]) -> Vec<f64> {
    let n = right.len();
    assert_eq!(matrix.len(), n * n, "a square matrix");
    let mut rows: Vec<Vec<f64>> = matrix.chunks(n).zip(right).map(|(row, b)| [row, &[*b]].concat()).collect();
    for k in 0..n {
        let pivot = (k..n).max_by(|a, b| rows[*a][k].abs().total_cmp(&rows[*b][k].abs())).expect("a row");
        rows.swap(k, pivot);
        let (done, below) = rows.split_at_mut(k + 1);
        for row in below {
            let factor = row[k] / done[k][k];
            for (entry, top) in row[k..].iter_mut().zip(&done[k][k..]) {
                *entry -= factor * top;
            }
        }
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = rows[k][k + 1..n].iter().zip(&x[k + 1..]).map(|(a, x)| a * x).sum();
        x[k] = (rows[k][n] - known) / rows[k][k];
    }
    x
}

#[cfg(test)]
mod tests;
