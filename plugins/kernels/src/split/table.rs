//! The tabulated kernels.

use super::pieces::Pieces;
use slipzone_api::{Component, KernelTable, Parts};

/// One kernel: its polynomials, piece after piece, each filled up to the same length.
struct Kernel {
    component: Component,
    terms: usize,
    rows: Vec<[f64; 3]>,
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
    /// Beyond it a kernel is `-1/t` or nothing; infinite where the pieces cover the reach.
    far: f64,
    length: f64,
    error: f64,
    flexibility_evaluations: usize,
}

/// Distances evaluated side by side.
const LANES: usize = 8;

/// Most cells: one look-up finds the piece, or the one before it.
const MOST_CELLS: f64 = 4096.0;

impl Table {
    pub(super) fn new(
        components: &[Component],
        pieces: Pieces,
        reach: f64,
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
                rows.extend(std::iter::repeat_n([0.0; 3], short));
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
        let end = ends.last().copied().unwrap_or(0.0);
        // A distance may round to beyond the reach.
        let far = if end >= reach { f64::INFINITY } else { end };
        let narrowest = (0..ends.len()).map(|k| ends[k] - if k == 0 { 0.0 } else { ends[k - 1] }).fold(end, f64::min);
        let cells = (end / narrowest).ceil().min(MOST_CELLS);
        let cells_per_length = cells / end;
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

    /// The piece that holds `x`.
    fn piece(&self, x: f64) -> usize {
        if self.ends.len() == 1 {
            return 0;
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // not negative; `as` saturates
        let cell = (x * self.cells_per_length) as usize;
        let mut piece = self.first_of_cell[cell.min(self.first_of_cell.len() - 1)] as usize;
        while x > self.ends[piece] && piece + 1 < self.ends.len() {
            piece += 1;
        }
        piece
    }

    /// The parts of one kernel at `LANES` distances; those in one piece go through its polynomials side by side.
    fn batch(&self, kernel: &Kernel, odd: bool, t: &[f64; LANES]) -> [Parts; LANES] {
        let x = t.map(f64::abs);
        let far = |x: f64| x > self.far;
        let first = if far(x[0]) { None } else { Some(self.piece(x[0])) };
        let together = x.iter().all(|&x| if far(x) { first.is_none() } else { Some(self.piece(x)) == first });
        if !together {
            return std::array::from_fn(|i| self.lanes(kernel, odd, &[t[i]], far(x[i]), None)[0]);
        }
        self.lanes(kernel, odd, t, first.is_none(), first)
    }

    /// Distances that are all far or all in one piece, which is looked up when it is not given.
    #[inline]
    fn lanes<const N: usize>(
        &self,
        kernel: &Kernel,
        odd: bool,
        t: &[f64; N],
        far: bool,
        piece: Option<usize>,
    ) -> [Parts; N] {
        if far {
            return t.map(|t| Parts { smooth: if odd { -1.0 / t } else { 0.0 }, sign: 0.0, log: 0.0 });
        }
        let piece = piece.unwrap_or_else(|| self.piece(t[0].abs()));
        let (slope, offset) = self.variables[piece];
        let at_origin = piece == 0;
        let v = t.map(|t| slope * if at_origin { t * t } else { t.abs() } + offset);
        let mut sums = [[0.0; N]; 3];
        for row in kernel.rows[piece * kernel.terms..(piece + 1) * kernel.terms].iter().rev() {
            for (sum, c) in sums.iter_mut().zip(row) {
                for (sum, v) in sum.iter_mut().zip(&v) {
                    *sum = *sum * v + c;
                }
            }
        }
        let [smooth, sign, log] = sums;
        std::array::from_fn(|i| {
            let factor = if at_origin { t[i] } else { t[i].signum() };
            if odd {
                Parts { smooth: smooth[i] * factor, sign: sign[i], log: log[i] * factor }
            } else {
                Parts { smooth: smooth[i], sign: sign[i] * factor, log: log[i] }
            }
        })
    }

    /// Hands the parts at all distances to `take`, in order.
    fn each(&self, component: Component, distances: &[f64], mut take: impl FnMut(usize, Parts)) {
        let (kernel, odd) = (self.kernel(component), component.is_odd());
        let (batches, rest) = distances.as_chunks::<LANES>();
        for (k, t) in batches.iter().enumerate() {
            for (i, parts) in self.batch(kernel, odd, t).into_iter().enumerate() {
                take(LANES * k + i, parts);
            }
        }
        for (i, t) in rest.iter().enumerate() {
            take(LANES * batches.len() + i, self.lanes(kernel, odd, &[*t], t.abs() > self.far, None)[0]);
        }
    }
}

impl KernelTable for Table {
    fn parts_into(&self, component: Component, distances: &[f64], out: &mut [Parts]) {
        assert_eq!(distances.len(), out.len(), "one set of parts for each distance");
        self.each(component, distances, |i, parts| out[i] = parts);
    }

    fn values_into(&self, component: Component, distances: &[f64], out: &mut [f64]) {
        assert_eq!(distances.len(), out.len(), "one value for each distance");
        self.each(component, distances, |i, parts| out[i] = parts.value(distances[i]));
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
