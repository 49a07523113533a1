//! The tabulated kernels.

use super::pieces::Pieces;
use slipzone_api::{Component, KernelTable, Parts};

/// One kernel: its polynomials, piece after piece, each filled up to the same length.
struct Kernel {
    component: Component,
    terms: usize,
    rows: Vec<[f64; 4]>,
}

/// What `split` builds.
pub(super) struct Table {
    kernels: Vec<Kernel>,
    /// Per piece: `v = slope x + offset`, with `x = t^2` on the first and `|t|` on the others.
    variables: Vec<(f64, f64)>,
    ends: Vec<f64>,
    /// The first piece that reaches into each of the equal cells of `[0, far]`.
    first_of_cell: Vec<u32>,
    cells_per_length: f64,
    /// Beyond it a kernel is `-1/t` or nothing.
    far: f64,
    length: f64,
    error: f64,
    flexibility_evaluations: usize,
}

/// Most cells: one look-up finds the piece, or the one before it.
const MOST_CELLS: f64 = 4096.0;

impl Table {
    pub(super) fn new(
        components: &[Component],
        pieces: Pieces,
        length: f64,
        error: f64,
        flexibility_evaluations: usize,
    ) -> Self {
        let kernel = |(component, kernel): (&Component, super::pieces::Kernel)| {
            let terms = kernel.rows.iter().map(Vec::len).max().unwrap_or(0);
            let mut rows = Vec::with_capacity(terms * kernel.rows.len());
            for piece in kernel.rows {
                let short = terms - piece.len();
                rows.extend(piece);
                rows.extend(std::iter::repeat_n([0.0; 4], short));
            }
            Kernel { component: *component, terms, rows }
        };
        let ends = pieces.ends;
        let variable = |k: usize| {
            let (lower, upper) = (if k == 0 { 0.0 } else { ends[k - 1] }, ends[k]);
            if k == 0 {
                (2.0 / (upper * upper), -1.0)
            } else {
                (2.0 / (upper - lower), -(upper + lower) / (upper - lower))
            }
        };
        let far = ends.last().copied().unwrap_or(0.0);
        let narrowest = (0..ends.len()).map(|k| ends[k] - if k == 0 { 0.0 } else { ends[k - 1] }).fold(far, f64::min);
        let cells = (far / narrowest).ceil().min(MOST_CELLS);
        let cells_per_length = cells / far;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // few and positive
        let first_of_cell = (0..=cells as usize)
            .map(|cell| ends.partition_point(|end| *end <= cell as f64 / cells_per_length).min(ends.len() - 1) as u32)
            .collect();
        Self {
            variables: (0..ends.len()).map(variable).collect(),
            kernels: components.iter().zip(pieces.kernels).map(kernel).collect(),
            ends,
            first_of_cell,
            cells_per_length,
            far,
            length,
            error,
            flexibility_evaluations,
        }
    }

    fn kernel(&self, component: Component) -> &Kernel {
        let kernel = self.kernels.iter().find(|kernel| kernel.component == component);
        kernel.unwrap_or_else(|| panic!("{component:?} was not requested"))
    }

    /// The parts of one kernel at `t`.
    #[inline]
    fn at(&self, kernel: &Kernel, odd: bool, t: f64) -> Parts {
        let x = t.abs();
        if x > self.far {
            return Parts { smooth: if odd { -1.0 / t } else { 0.0 }, sign: 0.0, log: 0.0 };
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // not negative, and bounded
        let cell = (x * self.cells_per_length) as usize;
        let mut piece = self.first_of_cell[cell.min(self.first_of_cell.len() - 1)] as usize;
        while x > self.ends[piece] && piece + 1 < self.ends.len() {
            piece += 1;
        }
        let (slope, offset) = self.variables[piece];
        let v = slope * if piece == 0 { x * x } else { x } + offset;
        let mut sums = [0.0; 4];
        for row in kernel.rows[piece * kernel.terms..(piece + 1) * kernel.terms].iter().rev() {
            for (sum, c) in sums.iter_mut().zip(row) {
                *sum = *sum * v + c;
            }
        }
        let factor = if piece == 0 { t } else { t.signum() };
        if odd {
            Parts { smooth: sums[0] * factor, sign: sums[1], log: sums[2] * factor }
        } else {
            Parts { smooth: sums[0], sign: sums[1] * factor, log: sums[2] }
        }
    }
}

impl KernelTable for Table {
    fn parts_into(&self, component: Component, distances: &[f64], out: &mut [Parts]) {
        assert_eq!(distances.len(), out.len(), "one set of parts for each distance");
        let (kernel, odd) = (self.kernel(component), component.is_odd());
        for (t, out) in distances.iter().zip(out) {
            *out = self.at(kernel, odd, *t);
        }
    }

    fn values_into(&self, component: Component, distances: &[f64], out: &mut [f64]) {
        assert_eq!(distances.len(), out.len(), "one value for each distance");
        let (kernel, odd) = (self.kernel(component), component.is_odd());
        for (t, out) in distances.iter().zip(out) {
            *out = self.at(kernel, odd, *t).value(*t);
        }
    }

    fn error(&self) -> Option<f64> {
        Some(self.error)
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn flexibility_evaluations(&self) -> usize {
        self.flexibility_evaluations
    }
}
