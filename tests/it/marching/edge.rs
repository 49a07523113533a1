//! Where sticking ends, to a fraction of a cell.
//!
//! What friction could bear beyond what it bears, `eta p - |q|`, vanishes there like the distance to the power 3/2,
//! since a point's own rate vanishes like the square root when the stick zone reaches it. Its power 2/3 is smooth, the
//! more so in `sqrt(b^2 - x^2)`, which takes the pressure's own square root out of it: a polynomial through a few
//! dozen cells inside has its root at the edge.

use super::coulomb::State;
use super::dense::solve;
use super::march::End;

/// The polynomial is fitted to this fraction of the contact.
const SPAN: usize = 10;
/// Cells next to the edge that are left out: the step shows there.
const SKIP: usize = 3;
/// Coefficients of the polynomial.
const TERMS: usize = 5;

/// `a/b`, of a contact of half-width 1 whose stick zone is one interval around the middle.
pub(super) fn stick_ratio(end: &End, eta: f64) -> f64 {
    let cells = end.state.len();
    let stuck = end.state.iter().take_while(|state| **state == State::Stick).count();
    assert!(end.state[stuck..].iter().all(|state| *state != State::Stick), "one stick zone");
    let fitted = cells / SPAN;
    assert!(SKIP + 2 * TERMS < fitted && fitted < stuck && stuck < cells, "room for a fit: {stuck} of {cells} stick");
    let root = |x: f64| (1.0 - x * x).sqrt();
    let (edge, inner) = (root(stuck as f64 / cells as f64), root((stuck - fitted) as f64 / cells as f64));
    let sign = if end.state[stuck] == State::Outward { -1.0 } else { 1.0 };
    let (mut matrix, mut right) = (vec![0.0; TERMS * TERMS], vec![0.0; TERMS]);
    for i in stuck - fitted..stuck - SKIP {
        let w = (root((i as f64 + 0.5) / cells as f64) - edge) / (inner - edge);
        let spare = (eta * end.p[i] - sign * end.q[i]).powf(2.0 / 3.0);
        let mut powers = [1.0; TERMS];
        (1..TERMS).for_each(|k| powers[k] = w * powers[k - 1]);
        for (row, high) in powers.iter().enumerate() {
            powers.iter().enumerate().for_each(|(column, low)| matrix[row * TERMS + column] += high * low);
            right[row] += high * spare;
        }
    }
    solve(&mut matrix, &mut right);
    let value = |w: f64| right.iter().rev().fold(0.0, |sum, c| sum * w + c);
    // By secants: the root is a fraction of a cell away.
    let (mut before, mut now) = (0.05, 0.0);
    for _ in 0..30 {
        let (there, here) = (value(before), value(now));
        if there - here == 0.0 {
            break;
        }
        (before, now) = (now, now - here * (now - before) / (here - there));
    }
    root(edge + (inner - edge) * now)
}
