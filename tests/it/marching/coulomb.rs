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
        let mut q: Vec<f64> =
            bound.iter().zip(state).map(|(c, s)| if *s == State::Outward { -c } else { *c }).collect();
        let sticking: Vec<usize> = (0..q.len()).filter(|i| state[*i] == State::Stick).collect();
        for i in &sticking {
            q[*i] = 0.0;
        }
        let mut right: Vec<f64> = sticking.iter().map(|i| -rest[*i] - dot(&self.rows[*i][..q.len()], &q)).collect();
        if sticking.last().is_none_or(|last| last + 1 == sticking.len()) {
            self.factor.solve(&mut right);
        } else {
            // Islands: rare, and worth a factor of their own.
            Cholesky::new(sticking.len(), |i, j| self.rows[sticking[i]][sticking[j]]).solve(&mut right);
        }
        for (i, value) in sticking.iter().zip(right) {
            q[*i] = value;
        }
        q
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A surface with the logarithm alone, and a push that changes direction twice.
    #[test]
    fn friction_is_obeyed_from_any_guess() {
        let (cells, width) = (40, 0.025_f64);
        let weight: Vec<f64> = (0..=2 * cells).map(|d| -width * (width * (d as f64 + 0.3)).ln()).collect();
        let shear = Shear::new(cells, &weight);
        let bound: Vec<f64> = (0..cells).map(|i| 0.1 + 0.002 * (i % 7) as f64).collect();
        let rest: Vec<f64> = (0..cells).map(|i| 0.1 * (0.3 * i as f64).sin()).collect();
        let answers = [State::Stick, State::Inward, State::Outward].map(|guess| {
            let mut state = vec![guess; cells];
            let q = shear.step(&bound, &rest, &mut state);
            let moved: Vec<f64> = shear.displacement(&q).iter().zip(&rest).map(|(u, rest)| u + rest).collect();
            for (i, state) in state.iter().enumerate() {
                // Rounding of the dense system.
                let obeyed = match state {
                    State::Stick => moved[i].abs() < 1e-14 && q[i].abs() <= bound[i],
                    State::Inward => moved[i] <= 0.0 && (q[i] - bound[i]).abs() < 1e-15,
                    State::Outward => moved[i] >= 0.0 && (q[i] + bound[i]).abs() < 1e-15,
                };
                assert!(obeyed, "cell {i}: {state:?}, q = {} of {}, moved {}", q[i], bound[i], moved[i]);
            }
            for each in [State::Stick, State::Inward, State::Outward] {
                assert!(state.contains(&each), "the push is meant to cause all three, {each:?} is missing");
            }
            state
        });
        assert!(answers[0] == answers[1] && answers[1] == answers[2], "one solution");
    }
}
