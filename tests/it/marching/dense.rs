//! Dense linear algebra in the plainest form, so that nothing is shared with the program under test.

/// Solves `matrix x = right` in place by elimination with row pivots; the matrix, by rows, is destroyed.
pub(super) fn solve(matrix: &mut [f64], right: &mut [f64]) {
    let n = right.len();
    for k in 0..n {
        let largest = |&a: &usize, &b: &usize| matrix[a * n + k].abs().total_cmp(&matrix[b * n + k].abs());
        let pivot = (k..n).max_by(largest).expect("a row is left");
        for j in k..n {
            matrix.swap(k * n + j, pivot * n + j);
        }
        right.swap(k, pivot);
        let (upper, lower) = matrix.split_at_mut((k + 1) * n);
        let row = &upper[k * n..];
        for (i, other) in lower.chunks_mut(n).enumerate() {
            let factor = other[k] / row[k];
            other[k..].iter_mut().zip(&row[k..]).for_each(|(o, r)| *o -= factor * r);
            right[k + 1 + i] -= factor * right[k];
        }
    }
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| matrix[k * n + j] * right[j]).sum();
        right[k] = (right[k] - known) / matrix[k * n + k];
    }
}

/// The lower factor of Cholesky, by rows: its leading blocks are the factors of the matrix's leading blocks.
pub(super) struct Cholesky {
    rows: Vec<Vec<f64>>,
}

impl Cholesky {
    /// Of the symmetric positive definite matrix with these entries.
    pub(super) fn new(n: usize, entry: impl Fn(usize, usize) -> f64) -> Self {
        let mut rows: Vec<Vec<f64>> = Vec::with_capacity(n);
        for i in 0..n {
            let mut row: Vec<f64> = Vec::with_capacity(i + 1);
            for (j, other) in rows.iter().enumerate() {
                let value = (entry(i, j) - dot(&row, &other[..j])) / other[j];
                row.push(value);
            }
            let square = entry(i, i) - dot(&row, &row);
            assert!(square > 0.0, "row {i}: not positive definite");
            row.push(square.sqrt());
            rows.push(row);
        }
        Self { rows }
    }

    /// Solves the leading block as large as `right` in place.
    pub(super) fn solve(&self, right: &mut [f64]) {
        let rows = &self.rows[..right.len()];
        for (i, row) in rows.iter().enumerate() {
            right[i] = (right[i] - dot(&row[..i], &right[..i])) / row[i];
        }
        for (i, row) in rows.iter().enumerate().rev() {
            right[i] /= row[i];
            let here = right[i];
            right[..i].iter_mut().zip(row).for_each(|(y, l)| *y -= here * l);
        }
    }
}

/// Scalar product, in four chains that the processor can run side by side.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a, b) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        sums.iter_mut().zip(a.iter().zip(b)).for_each(|(sum, (a, b))| *sum += a * b);
    }
    sums.iter().sum::<f64>() + rest
}
