//! What the nodes of a panel contribute to a sum over any places on it.

use std::f64::consts::PI;

/// Places at a time.
const LANES: usize = 8;

/// Places on a panel, from -1 to 1, and what polynomials are multiplied with there: `LANES` at a time.
#[derive(Default)]
pub(super) struct Weighted {
    places: Vec<f64>,
    weights: Vec<f64>,
    /// Sums of each Chebyshev polynomial over every `LANES`-th place.
    moments: Vec<[f64; LANES]>,
}

impl Weighted {
    pub(super) fn clear(&mut self) {
        self.places.clear();
        self.weights.clear();
    }

    pub(super) fn push(&mut self, place: f64, weight: f64) {
        self.places.push(place);
        self.weights.push(weight);
    }
}

/// Polynomials by their values at Chebyshev-Lobatto points, ascending, in terms of Chebyshev polynomials.
///
/// Sums are taken of these, three operations each in lanes that know nothing of each other, where Lagrange's ask for a
/// division.
pub(super) struct Shares {
    /// `rows[k * (degree + 1) + i]`: of the `k`-th Chebyshev polynomial in what is one at the node `i` and zero at the
    /// others.
    rows: Vec<f64>,
    width: usize,
}

impl Shares {
    pub(super) fn new(degree: usize) -> Self {
        let width = degree + 1;
        let halved = |k: usize| if k == 0 || k == degree { 0.5 } else { 1.0 };
        // The nodes are -cos(i pi/degree).
        let entry = |k: usize, i: usize| {
            let value = (PI * ((k * (degree - i)) % (2 * degree)) as f64 / degree as f64).cos();
            2.0 / degree as f64 * halved(k) * halved(i) * value
        };
        let rows = (0..width).flat_map(|k| (0..width).map(move |i| entry(k, i))).collect();
        Self { rows, width }
    }

    /// Adds to `of_nodes` what each node contributes to the sum of a polynomial at the places times their weights.
    pub(super) fn add_into(&self, at: &mut Weighted, of_nodes: &mut [f64]) {
        if at.places.is_empty() {
            return;
        }
        let filled = at.places.len().next_multiple_of(LANES);
        at.places.resize(filled, 0.0);
        at.weights.resize(filled, 0.0);
        at.moments.clear();
        at.moments.resize(self.width, [0.0; LANES]);
        for (places, weights) in at.places.as_chunks::<LANES>().0.iter().zip(at.weights.as_chunks::<LANES>().0) {
            // The weight times T_(k - 1), which for k = 0 is T_1, and times T_k.
            let mut before: [f64; LANES] = std::array::from_fn(|i| places[i] * weights[i]);
            let mut here = *weights;
            for sums in &mut at.moments {
                for i in 0..LANES {
                    sums[i] += here[i];
                    let next = 2.0 * places[i] * here[i] - before[i];
                    before[i] = here[i];
                    here[i] = next;
                }
            }
        }
        for (sums, row) in at.moments.iter().zip(self.rows.chunks_exact(self.width)) {
            let moment: f64 = sums.iter().sum();
            of_nodes.iter_mut().zip(row).for_each(|(out, entry)| *out += moment * entry);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::graded_panels::mesh::Mesh;

    #[test]
    fn nodes_share_a_sum_as_polynomials_do() {
        let mesh = Mesh::new(9, 2, 1, false);
        let at: Vec<(f64, f64)> = (0..19).map(|i| ((1.7 * f64::from(i)).cos(), 0.3 + f64::from(i % 5))).collect();
        let mut weighted = Weighted::default();
        for (place, weight) in &at {
            weighted.push(*place, *weight);
        }
        let (mut got, mut values) = (vec![0.0; 10], vec![0.0; 10]);
        Shares::new(9).add_into(&mut weighted, &mut got);
        let mut expected = vec![0.0; 10];
        for (place, weight) in at {
            mesh.basis_into(1.0 + place, &mut values);
            expected.iter_mut().zip(&values).for_each(|(sum, value)| *sum += weight * value);
        }
        for (got, expected) in got.iter().zip(expected) {
            assert!((got - expected).abs() < 1e-13, "{got} for {expected}");
        }
    }
}
