//! The convex cubic spline closest to a table's points.
//!
//! Lengths along `x` are in units of the last of them, heights in units of their range. Half the spline, `x >= 0`, is
//! `g = a + s x + double integral of g''`, with `g''` piecewise linear between its values `c_j` at the knots: `a` is
//! free, and `s >= 0`, `c_j >= 0` make it convex. Within each interval of the finest knots all of this is one cubic, so
//! the points of an interval are first reduced, without loss, to the four equations that their squares ask of its
//! coefficients (QR by rotations); what is then solved has at most 128 rows, or 256 for the finer one, however many
//! points there are.

use super::folded::Point;
use nalgebra::{DMatrix, DVector};

/// How much more a corner in the middle must gain than a coefficient.
const CORNER: f64 = 10.0;

/// A stretch on which a spline is one cubic.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Piece {
    pub(super) from: f64,
    pub(super) height: f64,
    pub(super) slope: f64,
    /// `g''` at the beginning.
    pub(super) bend: f64,
    /// `g'''`.
    pub(super) growth: f64,
}

impl Piece {
    pub(super) fn height(&self, x: f64) -> f64 {
        let t = x - self.from;
        self.height + t * (self.slope + t * (0.5 * self.bend + t * self.growth / 6.0))
    }

    pub(super) fn slope(&self, x: f64) -> f64 {
        let t = x - self.from;
        self.slope + t * (self.bend + 0.5 * t * self.growth)
    }
}

/// A spline in scaled units: height and slope in the middle, knots, and `g''` at each.
pub(super) struct Spline {
    offset: f64,
    pub(super) corner: f64,
    knots: Vec<f64>,
    pub(super) bends: Vec<f64>,
}

impl Spline {
    pub(super) fn pieces(&self) -> Vec<Piece> {
        let mut piece = Piece { from: 0.0, height: self.offset, slope: self.corner, ..Piece::default() };
        let stretches = self.knots.windows(2).zip(self.bends.windows(2));
        stretches
            .map(|(ends, bends)| {
                let width = ends[1] - ends[0];
                piece = Piece { from: ends[0], bend: bends[0], growth: (bends[1] - bends[0]) / width, ..piece };
                let this = piece;
                piece = Piece { height: this.height(ends[1]), slope: this.slope(ends[1]), ..piece };
                this
            })
            .collect()
    }
}

/// The piece in which a point lies.
pub(super) fn at(pieces: &[Piece], x: f64) -> &Piece {
    &pieces[pieces.partition_point(|piece| piece.from <= x).saturating_sub(1)]
}

/// The spline to be had, and the sum of squares that it leaves over.
pub(super) fn best(points: &[Point], distances: usize, rounding: f64) -> (Spline, f64) {
    let count = points.len() as f64;
    let most = [32, 16, 8, 4, 2].into_iter().find(|&pieces| 2 * (pieces + 2) <= distances).unwrap_or(1);
    let finest = knots(points, most);
    let reduced = reduce(points, &finest);
    let mut best: Option<(f64, Spline, f64)> = None;
    let mut pieces = 1;
    while pieces <= most {
        for corner in [false, true] {
            let coefficients = pieces + 2 + usize::from(corner);
            if coefficients > (distances / 2).max(3) {
                continue; // that would pass through the points, noise and all
            }
            let (spline, left_over) = solve(&reduced, &finest, most / pieces, corner);
            let mean = (left_over / count).max(rounding * rounding);
            let price = pieces as f64 + 2.0 + if corner { CORNER } else { 0.0 };
            let score = count * mean.ln() + price * count.ln();
            if best.as_ref().is_none_or(|(least, ..)| score < *least) {
                best = Some((score, spline, left_over));
            }
        }
        pieces *= 2;
    }
    let (_, spline, left_over) = best.expect("one piece without a corner is always tried");
    (spline, left_over)
}

/// The spline of twice as many pieces, or as many as the points can tell, with a corner if that one has one.
pub(super) fn finer(points: &[Point], distances: usize, than: &[Piece]) -> Spline {
    let knots = knots(points, (2 * than.len()).min(distances - 2));
    let corner = than.first().is_some_and(|piece| piece.slope > 0.0);
    solve(&reduce(points, &knots), &knots, 1, corner).0
}

/// Knots between which the points are shared out evenly, from 0 to 1.
fn knots(points: &[Point], pieces: usize) -> Vec<f64> {
    let mut apart: Vec<f64> = points.iter().map(|point| point.x).collect();
    apart.dedup();
    let last = apart.len() - 1;
    let inner = (1..pieces).map(|i| apart[i * last / pieces]);
    std::iter::once(0.0).chain(inner).chain([1.0]).collect()
}

/// What the points of one interval ask of its cubic `sum_k p_k P_k(s)`, `P_k` Legendre's polynomials over it:
/// `triangle p = target`, and a sum of squares that no cubic takes away.
#[derive(Clone, Copy, Default)]
struct Asked {
    triangle: [[f64; 4]; 4],
    target: [f64; 4],
    left_over: f64,
}

impl Asked {
    /// Takes in one more equation, `sum_k row_k p_k = value`, by rotating it into the triangle.
    fn add(&mut self, mut row: [f64; 4], mut value: f64) {
        for k in 0..4 {
            let length = self.triangle[k][k].hypot(row[k]);
            if length == 0.0 {
                continue;
            }
            let (cosine, sine) = (self.triangle[k][k] / length, row[k] / length);
            for (upper, lower) in self.triangle[k].iter_mut().zip(&mut row).skip(k) {
                (*upper, *lower) = (cosine * *upper + sine * *lower, cosine * *lower - sine * *upper);
            }
            let upper = self.target[k];
            self.target[k] = cosine * upper + sine * value;
            value = cosine * value - sine * upper;
        }
        self.left_over += value * value;
    }
}

fn reduce(points: &[Point], knots: &[f64]) -> Vec<Asked> {
    let mut intervals = vec![Asked::default(); knots.len() - 1];
    let mut interval = 0;
    for point in points {
        while interval + 2 < knots.len() && point.x > knots[interval + 1] {
            interval += 1;
        }
        let (from, to) = (knots[interval], knots[interval + 1]);
        let s = (point.x - from) / (to - from) * 2.0 - 1.0;
        let row = [1.0, s, 1.5 * s * s - 0.5, s * (2.5 * s * s - 1.5)];
        intervals[interval].add(row, point.height);
    }
    intervals
}

/// The convex spline on every `stride`-th of the finest knots, with or without a corner, and the sum of squares left
/// over.
fn solve(reduced: &[Asked], finest: &[f64], stride: usize, corner: bool) -> (Spline, f64) {
    let knots: Vec<f64> = finest.iter().copied().step_by(stride).collect();
    // Columns: offset, corner, g'' at the knots.
    let columns = knots.len() + 2;
    let mut matrix = DMatrix::zeros(4 * reduced.len(), columns);
    let mut target = DVector::zeros(4 * reduced.len());
    let unit = |column: usize| DVector::from_fn(columns, |j, _| f64::from(u8::from(j == column)));
    // Height, slope and g'' at the beginning of an interval, as combinations of the columns.
    let (mut height, mut slope) = (unit(0), unit(1));
    let bend = |index: usize| {
        let (coarse, part) = (index / stride, index % stride);
        if part == 0 {
            return unit(coarse + 2);
        }
        let share = (finest[index] - knots[coarse]) / (knots[coarse + 1] - knots[coarse]);
        unit(coarse + 2) * (1.0 - share) + unit(coarse + 3) * share
    };
    for (index, asked) in reduced.iter().enumerate() {
        let width = finest[index + 1] - finest[index];
        let (here, there) = (bend(index), bend(index + 1));
        // Of 1, t, t^2, t^3 with t from 0 to 1 over the interval; then of Legendre's polynomials.
        let (one, square) = (&slope * width, &here * (0.5 * width * width));
        let cube = (&there - &here) * (width * width / 6.0);
        let legendre = [
            &height + &one / 2.0 + &square / 3.0 + &cube / 4.0,
            &one / 2.0 + &square / 2.0 + &cube * 0.45,
            &square / 6.0 + &cube / 4.0,
            &cube / 20.0,
        ];
        for (k, row) in asked.triangle.iter().enumerate() {
            let mut equation = DVector::zeros(columns);
            for (coefficient, polynomial) in row.iter().zip(&legendre) {
                equation.axpy(*coefficient, polynomial, 1.0);
            }
            matrix.set_row(4 * index + k, &equation.transpose());
            target[4 * index + k] = asked.target[k];
        }
        height += &slope * width + &here * (width * width / 3.0) + &there * (width * width / 6.0);
        slope += (here + there) * (0.5 * width);
    }
    let taken: Vec<usize> = (0..columns).filter(|&column| corner || column != 1).collect();
    let found = nonnegative(&matrix, &target, &taken);
    let rest = &target - &matrix * &found;
    let left_over = rest.norm_squared() + reduced.iter().map(|asked| asked.left_over).sum::<f64>();
    let spline = Spline { offset: found[0], corner: found[1], knots, bends: found.iter().skip(2).copied().collect() };
    (spline, left_over)
}

/// Least squares over the columns `taken`, none of the unknowns below 0 but the first: the active-set method of C. L.
/// Lawson, R. J. Hanson, Solving Least Squares Problems (1974), chapter 23.
fn nonnegative(matrix: &DMatrix<f64>, target: &DVector<f64>, taken: &[usize]) -> DVector<f64> {
    let all = least_squares(matrix, target, taken);
    if taken.iter().all(|&column| column == 0 || all[column] >= 0.0) {
        return all;
    }
    let mut free = vec![0];
    let mut found = least_squares(matrix, target, &free);
    let sizes: Vec<f64> = matrix.column_iter().map(|column| column.norm()).collect();
    // The method ends by itself; rounding might make it go round in circles.
    for _ in 0..4 * taken.len() {
        let pull = matrix.tr_mul(&(target - matrix * &found));
        let strongest = taken
            .iter()
            .copied()
            .filter(|column| !free.contains(column))
            .map(|column| (pull[column] / sizes[column], column))
            .max_by(|one, other| one.0.total_cmp(&other.0));
        match strongest {
            Some((pull, column)) if pull > 1e-14 * target.norm() => free.push(column),
            _ => break,
        }
        loop {
            let wanted = least_squares(matrix, target, &free);
            let blocked = free
                .iter()
                .filter(|&&column| column != 0 && wanted[column] <= 0.0)
                .map(|&column| found[column] / (found[column] - wanted[column]))
                .min_by(f64::total_cmp);
            let Some(step) = blocked else {
                found = wanted;
                break;
            };
            found += (&wanted - &found) * step;
            free.retain(|&column| column == 0 || (wanted[column] > 0.0 || found[column] > 1e-15));
            for column in 1..found.len() {
                if !free.contains(&column) {
                    found[column] = 0.0;
                }
            }
        }
    }
    found
}

/// Least squares over some of the columns, the other unknowns 0.
fn least_squares(matrix: &DMatrix<f64>, target: &DVector<f64>, columns: &[usize]) -> DVector<f64> {
    let factors = matrix.select_columns(columns).qr();
    let mut right = target.clone();
    factors.q_tr_mul(&mut right);
    let right = right.rows(0, columns.len()).into_owned();
    let solved = factors.r().solve_upper_triangular(&right);
    let mut found = DVector::zeros(matrix.ncols());
    if let Some(solved) = solved {
        for (column, value) in columns.iter().zip(solved.iter()) {
            found[*column] = *value;
        }
    }
    found
}
