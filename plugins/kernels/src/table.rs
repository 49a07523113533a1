//! The tabulated kernels.

mod lanes;

use crate::origin::Origin;
use crate::piece::Pieces;
use lanes::Piece;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::elementary::ln;
use slipzone_api::{Component, KernelTable, PartsMut};

/// One kernel: its polynomials, piece after piece.
struct Kernel {
    component: Component,
    /// Coefficients of each part on each piece, highest power first, without the zeros that fill a row up.
    coefficients: Vec<f64>,
    /// Where those of each part of each piece begin, and where the last ones end.
    starts: Vec<usize>,
}

impl Kernel {
    fn new(component: Component, pieces: &[Vec<[f64; 3]>]) -> Self {
        let most = pieces.iter().map(|rows| 3 * rows.len()).sum();
        let (coefficients, starts) = (Vec::with_capacity(most), Vec::with_capacity(3 * pieces.len() + 1));
        let mut kernel = Self { component, coefficients, starts };
        kernel.starts.push(0);
        for rows in pieces {
            for part in 0..3 {
                let falling = rows.iter().rev().map(|row| row[part]);
                kernel.coefficients.extend(falling.skip_while(|c| *c == 0.0));
                kernel.starts.push(kernel.coefficients.len());
            }
        }
        kernel
    }

    /// The coefficients of the three parts on one piece.
    fn on(&self, piece: usize) -> [&[f64]; 3] {
        std::array::from_fn(|part| {
            let i = 3 * piece + part;
            &self.coefficients[self.starts[i]..self.starts[i + 1]]
        })
    }
}

/// Kernels as piecewise polynomials of the distance.
pub(crate) struct Table {
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
    nearest: Option<f64>,
    /// What stands in the place of the first piece.
    origin: Option<Origin>,
    error: f64,
    edge_error: f64,
    flexibility_evaluations: usize,
}

/// Distances of which the parts are kept at a time, where only values are wanted: whole blocks of vectors.
const BATCH: usize = 72;

/// The bit of the sign.
const SIGN_BIT: u64 = 1 << 63;

/// Most cells: one look-up finds the piece, or the one before it.
const MOST_CELLS: f64 = 4096.0;

impl Table {
    pub(crate) fn new(
        components: &[Component],
        pieces: Pieces,
        reach: f64,
        (length, nearest): (f64, Option<f64>),
        error: f64,
        flexibility_evaluations: usize,
    ) -> Self {
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
            kernels: components
                .iter()
                .zip(&pieces.kernels)
                .map(|(component, kernel)| Kernel::new(*component, &kernel.rows))
                .collect(),
            ends,
            first_of_cell,
            cells_per_length,
            far,
            length,
            nearest,
            origin: None,
            error,
            edge_error: 0.0,
            flexibility_evaluations,
        }
    }

    /// The same with what is wrong for edges alone.
    pub(crate) fn missing_at_edges(self, edge_error: f64) -> Self {
        Self { edge_error, ..self }
    }

    /// The same with powers of the distance in the place of the first piece.
    pub(crate) fn beginning_with(mut self, origin: Origin) -> Self {
        self.origin = Some(origin);
        self
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
        if self.nearest.is_some() {
            // A cell holds many that shrink towards the origin.
            return (piece + self.ends[piece..].partition_point(|end| *end < x)).min(self.ends.len() - 1);
        }
        while x > self.ends[piece] && piece + 1 < self.ends.len() {
            piece += 1;
        }
        piece
    }

    /// The piece that holds the first distance, and how many distances from there on it holds; `None` is what lies
    /// beyond all pieces.
    #[inline(always)]
    fn run<S: Simd>(&self, simd: S, distances: &[f64]) -> (Option<usize>, usize) {
        if self.ends.len() == 1 && self.far == f64::INFINITY {
            return (Some(0), distances.len());
        }
        let x = distances[0].abs();
        let (piece, range) = if x > self.far {
            (None, (self.far, f64::INFINITY))
        } else {
            let piece = self.piece(x);
            let last = piece + 1 == self.ends.len();
            let lower = if piece == 0 { -1.0 } else { self.ends[piece - 1] };
            (Some(piece), (lower, if last { self.far } else { self.ends[piece] }))
        };
        (piece, lanes::within(simd, distances, range).max(1))
    }

    /// Writes the parts; returns whether any has a logarithm.
    #[inline(always)]
    fn write<S: Simd>(&self, simd: S, kernel: &Kernel, mut t: &[f64], mut out: [&mut [f64]; 3]) -> bool {
        let odd = kernel.component.is_odd();
        let mut has_log = false;
        while !t.is_empty() {
            let (piece, count) = self.run(simd, t);
            let (here, later) = t.split_at(count);
            let [a, b, c] = out;
            let ((a, a_later), (b, b_later), (c, c_later)) =
                (a.split_at_mut(count), b.split_at_mut(count), c.split_at_mut(count));
            if let (Some(0), Some(origin)) = (piece, &self.origin) {
                has_log |= kernel.component == Component::Depth;
                origin.parts_into(kernel.component, here, [a, b, c]);
            } else if let Some(piece) = piece {
                let (slope, offset) = self.variables[piece];
                let coefficients = kernel.on(piece);
                has_log |= !coefficients[2].is_empty();
                let piece = Piece { slope, offset, at_origin: piece == 0, coefficients, odd: [odd, !odd, odd] };
                lanes::parts_into(simd, piece, here, [a, b, c]);
            } else {
                for (a, t) in a.iter_mut().zip(here) {
                    *a = if odd { -1.0 / t } else { 0.0 };
                }
                b.fill(0.0);
                c.fill(0.0);
            }
            t = later;
            out = [a_later, b_later, c_later];
        }
        has_log
    }
}

/// All parts at some distances.
struct WriteParts<'a> {
    table: &'a Table,
    kernel: &'a Kernel,
    distances: &'a [f64],
    out: PartsMut<'a>,
}

impl WithSimd for WriteParts<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let PartsMut { smooth, sign, log } = self.out;
        self.table.write(simd, self.kernel, self.distances, [smooth, sign, log]);
    }
}

/// Values at some distances.
struct WriteValues<'a> {
    table: &'a Table,
    kernel: &'a Kernel,
    distances: &'a [f64],
    out: &'a mut [f64],
}

impl WithSimd for WriteValues<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let mut parts = [[0.0; BATCH]; 3];
        for (t, out) in self.distances.chunks(BATCH).zip(self.out.chunks_mut(BATCH)) {
            let [smooth, sign, log] = &mut parts;
            let (smooth, sign, log) = (&mut smooth[..t.len()], &mut sign[..t.len()], &mut log[..t.len()]);
            let has_log = self.table.write(simd, self.kernel, t, [&mut *smooth, &mut *sign, &mut *log]);
            for (((out, t), smooth), sign) in out.iter_mut().zip(t).zip(smooth).zip(sign) {
                // Times the sign of `t`.
                *out = *smooth + f64::from_bits(sign.to_bits() ^ (t.to_bits() & SIGN_BIT));
            }
            if has_log {
                for ((out, t), log) in out.iter_mut().zip(t).zip(log) {
                    *out += *log * ln(t.abs());
                }
            }
        }
    }
}

impl KernelTable for Table {
    fn parts_into(&self, component: Component, distances: &[f64], out: PartsMut) {
        out.assert_len(distances.len());
        Arch::new().dispatch(WriteParts { table: self, kernel: self.kernel(component), distances, out });
    }

    fn values_into(&self, component: Component, distances: &[f64], out: &mut [f64]) {
        assert_eq!(distances.len(), out.len(), "one value for each distance");
        Arch::new().dispatch(WriteValues { table: self, kernel: self.kernel(component), distances, out });
    }

    fn error(&self) -> Option<f64> {
        Some(self.error)
    }

    fn edge_error(&self) -> f64 {
        self.edge_error
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn nearest(&self) -> Option<f64> {
        self.nearest
    }

    fn power(&self) -> Option<f64> {
        self.origin.as_ref().map(|origin| origin.power)
    }

    fn flexibility_evaluations(&self) -> usize {
        self.flexibility_evaluations
    }
}
