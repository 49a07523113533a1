//! One load step of Coulomb friction, decided cell by cell.
//!
//! With the pressure given (Goodman), a step asks for the shear `q`, `|q| <= eta p`, such that a cell moves only
//! against a shear of `eta p`: a convex problem with one solution, since what shear does to the surface is symmetric
//! and positive. Found by the primal-dual active set: cells that would need more friction than there is let go, cells
//! that move the wrong way are caught.

use super::dense::{Cholesky, dot};

/// What a cell does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum State {
    Stick,
    /// The surface slides inwards, `q = eta p`.
    Inward,
    /// The surface slides outwards, `q = -eta p`.
    Outward,
}

/// Displacement of the cells' middles by the cells' shear, odd about the middle of the contact.
pub(super) struct Shear {
    rows: Vec<Vec<f64>>,
    factor: Cholesky,
}

impl Shear {
    /// `weight(d)`: displacement of a cell's middle by unit shear on a cell `d` cells away.
    pub(super) fn new(cells: usize, weight: &[f64]) -> Self {
        let entry = |i: usize, j: usize| weight[i.abs_diff(j)] - weight[i + j + 1];
        let rows = (0..cells).map(|i| (0..cells).map(|j| entry(i, j)).collect()).collect();
        Self { rows, factor: Cholesky::new(cells, entry) }
    }

    /// Displacements of all cells by the shear of the first ones.
    pub(super) fn displacement(&self, q: &[f64]) -> Vec<f64> {
        self.rows.iter().map(|row| dot(&row[..q.len()], q)).collect()
    }

    /// The shear of the cells in contact, which may bear `bound`; `rest` is where each would be without friction,
    /// relative to where it was before. `state` is a guess and becomes the answer.
    pub(super) fn step(&self, bound: &[f64], rest: &[f64], state: &mut [State]) -> Vec<f64> {
        for _ in 0..200 {
            let q = self.stuck(bound, rest, state);
            let moved = |i: usize| rest[i] + dot(&self.rows[i][..q.len()], &q);
            let mut changed = false;
            for i in 0..q.len() {
                let next = match state[i] {
                    State::Stick if q[i] > bound[i] => State::Inward,
                    State::Stick if q[i] < -bound[i] => State::Outward,
                    State::Inward if moved(i) > 0.0 => State::Stick,
                    State::Outward if moved(i) < 0.0 => State::Stick,
                    same => same,
                };
                changed |= next != state[i];
                state[i] = next;
            }
            if !changed {
                return q;
            }
        }
        panic!("cells keep changing their minds")
    }

    /// The shear when each cell does what its state says.
    fn stuck(&self, bound: &[f64], rest: &[f64], state: &[State]) -> Vec<f64> {
        let mut q: Vec<f64> = bound.iter().zip(state).map(|(c, s)| if *s == State::Outward { -c } else { *c }).collect();
        let sticking: Vec<usize> = (0..q.len()).filter(|i| state[*i] == State::Stick).collect();
        sticking.iter().for_each(|i| q[*i] = 0.0);
        let mut right: Vec<f64> =
            sticking.iter().map(|i| -rest[*i] - dot(&self.rows[*i][..q.len()], &q)).collect();
        if sticking.last().is_none_or(|last| last + 1 == sticking.len()) {
            self.factor.solve(&mut right);
        } else {
            // Islands: rare, and worth a factor of their own.
            Cholesky::new(sticking.len(), |i, j| self.rows[sticking[i]][sticking[j]]).solve(&mut right);
        }
        sticking.iter().zip(right).for_each(|(i, value)| q[*i] = value);
        q
    }
}
