//! The convex cubic spline closest to a table's points.
//!
//! Lengths along `x` are in units of the last of them, heights in units of their range. Half the spline, `x >= 0`, is
//! `g = a + s x + double integral of g''`, with `g''` piecewise linear between its values `c_j` at the knots: `a` is
//! free, and `s >= 0`, `c_j >= 0` make it convex. Within each interval of the finest knots all of this is one cubic, so the
//! points of an interval are first reduced, without loss, to the four equations that their squares ask of its
//! coefficients (QR by rotations); what is then solved has at most 128 rows, however many points there are.

use super::rows::Rows;
use super::scatter;
use super::strays::strays;
use nalgebra::{DMatrix, DVector};
use slipzone_api::{Fault, Flaw, PunchShape, short};

/// The most pieces.
const PIECES: usize = 32;

/// The fewest distances from the middle.
const FEWEST: usize = 4;

/// Of slopes, what need not be told from a smooth function.
const SMOOTH: f64 = 1e-10;

/// A slope below this, over the mean one of the rows, is none.
const LEVEL: f64 = 1e-9;

/// How much more a corner in the middle must gain than a coefficient.
const CORNER: f64 = 10.0;

/// By how much of the height at the contact's edge the shape may leave straight lines from row to row before users are told: a parabola
/// does so where two rows or fewer are under half of the contact.
const TOLD: f64 = 0.05;

/// A point of the folded table, scaled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    /// Distance from the middle.
    pub(super) x: f64,
    pub(super) height: f64,
    /// Whether it stood on the left.
    pub(super) left: bool,
}

/// A fitted table.
#[derive(Clone, Debug)]
pub(super) struct Profile {
    /// The last point's distance from the middle.
    reach: f64,
    pieces: Vec<Piece>,
    noise: f64,
    kinks: Vec<f64>,
    corners: Vec<f64>,
    /// Ascending.
    flaws: Vec<Flaw>,
    /// Where rows are that are no part of the shape; ascending.
    strays: Vec<f64>,
    /// Each deeper than those before.
    sags: Vec<Sag>,
}

/// By how much the shape lies below the straight line between two rows.
#[derive(Clone, Copy, Debug)]
struct Sag {
    /// Where the first of the rows is.
    from: f64,
    /// Half-way between them.
    at: f64,
    depth: f64,
}

/// A stretch on which the spline is one cubic; all in the user's units.
#[derive(Clone, Copy, Debug, Default)]
struct Piece {
    from: f64,
    height: f64,
    slope: f64,
    /// `g''` at the beginning.
    bend: f64,
    /// `g'''`.
    growth: f64,
}

impl Piece {
    fn height(&self, x: f64) -> f64 {
        let t = x - self.from;
        self.height + t * (self.slope + t * (0.5 * self.bend + t * self.growth / 6.0))
    }

    fn slope(&self, x: f64) -> f64 {
        let t = x - self.from;
        self.slope + t * (self.bend + 0.5 * t * self.growth)
    }
}

/// A spline in scaled units: height and slope in the middle, knots, and `g''` at each.
pub(super) struct Spline {
    offset: f64,
    corner: f64,
    knots: Vec<f64>,
    bends: Vec<f64>,
}

impl Spline {
    fn pieces(&self) -> Vec<Piece> {
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

/// The points of a table, from the middle outwards, scaled.
struct Folded {
    points: Vec<Point>,
    /// How many distances from the middle they have.
    distances: usize,
    /// The last distance from the middle, and the range of the heights, in the units of the rows.
    reach: f64,
    range: f64,
    /// The height of the first point, in the unit of the rows: it counts as 0.
    tip: f64,
    /// What rounding makes of the heights.
    rounding: f64,
    /// The last decimal to which all heights are given, in units of their range; 0 where they have more than are told apart.
    decimal: f64,
}

impl Folded {
    /// Points with ascending `x`, given in those units.
    ///
    /// # Errors
    /// When they are too few, too far from the middle, or all of one height.
    fn new(rows: &[[f64; 2]], [x_unit, height_unit]: [f64; 2]) -> Result<Self, Fault> {
        let count = rows.len();
        let mut points: Vec<Point> =
            rows.iter().map(|&[x, height]| Point { x: x.abs(), height, left: x < 0.0 }).collect();
        points.sort_by(|one, other| one.x.total_cmp(&other.x));
        let distances = 1 + points.windows(2).filter(|pair| pair[0].x < pair[1].x).count();
        let (Some(first), Some(last)) = (points.first().copied(), points.last().copied()) else {
            return Err(Fault::new(&[], "no rows")
                .found("0 rows")
                .expected(format!("at least {FEWEST} rows of x and height")));
        };
        if distances < FEWEST {
            let found = if distances == count {
                format!("{count} rows")
            } else {
                format!("{count} rows, {distances} of them apart from their mirror images")
            };
            return Err(Fault::new(&[], "too few rows")
                .found(found)
                .expected(format!("at least {FEWEST} on one side of the middle")));
        }
        if first.x > 0.25 * last.x {
            return Err(Fault::new(&[], "no row near the middle of the punch")
                .found(format!("x from {} to {}", first.x * x_unit, last.x * x_unit))
                .expected("rows around x = 0, where the punch touches first")
                .hint("measure x from the middle of the punch"));
        }
        let highest = points.iter().map(|point| point.height.abs()).fold(0.0, f64::max);
        let range = points.iter().map(|point| (point.height - first.height).abs()).fold(0.0, f64::max);
        if range <= 4.0 * f64::EPSILON * highest {
            return Err(Fault::new(&[], "all heights are the same")
                .found(format!("{} everywhere", first.height * height_unit))
                .expected("heights that grow with |x|")
                .hint("a flat punch is `type = \"flat\"`"));
        }
        let decimal = last_decimal(&points, range) / range;
        for point in &mut points {
            *point = Point { x: point.x / last.x, height: (point.height - first.height) / range, left: point.left };
        }
        let rounding = 4.0 * f64::EPSILON * (1.0 + highest / range);
        Ok(Self { points, distances, reach: last.x, tip: first.height, range, rounding, decimal })
    }

    /// That no convex curve through them rises.
    fn never_rises(&self, [x_unit, height_unit]: [f64; 2]) -> Fault {
        let Self { points, reach, range, .. } = self;
        let lowest =
            points.iter().fold(points[0], |lowest, next| if next.height < lowest.height { *next } else { lowest });
        let found = if lowest.height < 0.0 {
            let (depth, x) = (-lowest.height * range * height_unit, lowest.x * reach * x_unit);
            format!("the height at |x| = {x} is {depth} below that of the first row")
        } else {
            "heights that no convex curve follows upwards".to_owned()
        };
        Fault::new(&[], "the heights do not grow with |x|")
            .found(found)
            .expected("heights that grow outwards from the middle, where the punch touches first")
            .hint("heights count away from the surface: change their sign if the rows count them the other way")
    }
}

/// A table's points, and the curve that comes closest to them.
pub(super) struct Fit {
    folded: Folded,
    /// In scaled units.
    pieces: Vec<Piece>,
    /// How many coefficients it has.
    coefficients: usize,
    /// The sum of squares that it leaves over, scaled.
    left_over: f64,
}

impl Fit {
    /// The fit of rows with ascending `x`, given in those units.
    pub(super) fn new(rows: &[[f64; 2]], units: [f64; 2]) -> Result<Self, Fault> {
        let folded = Folded::new(rows, units)?;
        let (spline, left_over) = best(&folded.points, folded.distances, folded.rounding);
        let pieces = spline.pieces();
        let coefficients = 1 + usize::from(spline.corner > 0.0) + spline.bends.len();
        Ok(Self { folded, pieces, coefficients, left_over })
    }

    /// Whether it does so outwards.
    pub(super) fn rises(&self) -> bool {
        self.pieces.last().is_some_and(|piece| piece.slope(1.0) > LEVEL)
    }

    /// How far a row is above it, in the unit of the rows.
    pub(super) fn off(&self, [x, height]: [f64; 2]) -> f64 {
        let Folded { reach, range, tip, .. } = &self.folded;
        let x = x.abs() / reach;
        height - (tip + range * at(&self.pieces, x).height(x))
    }

    /// The sum of squares that it leaves over, in the unit of the rows.
    pub(super) fn left_over(&self) -> f64 {
        self.left_over * self.folded.range * self.folded.range
    }

    /// What rounding makes of heights, and the last decimal to which they are given.
    pub(super) fn rounding(&self) -> f64 {
        self.folded.rounding * self.folded.range
    }

    pub(super) fn decimal(&self) -> f64 {
        self.folded.decimal * self.folded.range
    }

    /// How many more points it has than coefficients; `None` where none.
    pub(super) fn spare(&self) -> Option<f64> {
        let spare = self.folded.points.len().checked_sub(self.coefficients).filter(|spare| *spare > 0)?;
        Some(spare as f64)
    }
}

/// The power of ten of which all heights are whole multiples; 0 where none is that is worth asking for.
fn last_decimal(points: &[Point], range: f64) -> f64 {
    /// How far below the range it is looked for, and by how much a multiple may be off.
    const DIGITS: i32 = 9;
    const WHOLE: f64 = 1e-5;
    #[allow(clippy::cast_possible_truncation)] // a power of ten within the range of numbers
    let first = range.log10().floor() as i32;
    let decimals = (0..=DIGITS).map(|digit| 10_f64.powi(first - digit));
    let is_told = |decimal: &f64| {
        let multiples = points.iter().map(|point| point.height / decimal);
        multiples.into_iter().all(|multiple| (multiple - multiple.round()).abs() < WHOLE)
    };
    decimals.into_iter().find(is_told).unwrap_or(0.0)
}

impl Profile {
    /// Fits points with ascending `x`, given in those units.
    ///
    /// # Errors
    /// When they are too few, too far from the middle, or do not rise from there.
    pub(super) fn fit(rows: &Rows, units @ [x_unit, height_unit]: [f64; 2]) -> Result<Self, Fault> {
        let (strays, fit) = strays(rows, Fit::new(rows, units)?, units);
        if !fit.rises() {
            return Err(fit.folded.never_rises(units));
        }
        let Fit { folded, pieces, left_over, .. } = fit;
        let Folded { points, reach, range, rounding, decimal, .. } = folded;
        let fitted = |x: f64| at(&pieces, x).height(x);
        let residuals: Vec<f64> = points.iter().map(|point| point.height - fitted(point.x)).collect();
        let flaws = scatter::flaws(&points, &residuals, (rounding, decimal));
        let (reach, rise) = (reach * x_unit, range * height_unit);
        let noise = (left_over / points.len() as f64).sqrt() * rise;
        let sags = deepest(&points, fitted).map(|Sag { from, at, depth }| Sag {
            from: from * reach,
            at: at * reach,
            depth: depth * rise,
        });
        let mut profile = Self { sags: sags.collect(), ..Self::in_units(&pieces, reach, rise, noise, flaws) };
        profile.leave_out(strays.into_iter().map(|stray| rows[stray][0].abs() * x_unit));
        Ok(profile)
    }

    /// Takes note of rows at those places that are no part of the shape.
    fn leave_out(&mut self, strays: impl Iterator<Item = f64>) {
        self.strays.extend(strays);
        self.strays.sort_by(f64::total_cmp);
        self.flaws.extend(
            self.strays.iter().map(|x| Flaw { what: "a row of the punch's table is far off the others".into(), x: *x }),
        );
        self.flaws.sort_by(|one, other| one.x.total_cmp(&other.x));
    }

    fn in_units(pieces: &[Piece], reach: f64, rise: f64, noise: f64, mut flaws: Vec<Flaw>) -> Self {
        let steepest = pieces.last().map_or(0.0, |piece| piece.slope(1.0));
        let corner = pieces.first().map_or(0.0, |piece| piece.slope);
        // A jump of g''' by J changes slopes within the punch by J/2 at most.
        let growths = std::iter::once(0.0).chain(pieces.iter().map(|piece| piece.growth));
        let jumps = growths.zip(pieces).filter(|(before, piece)| {
            let has_corner = piece.from == 0.0 && corner > 0.0;
            has_corner || 0.5 * (piece.growth - before).abs() > SMOOTH * steepest
        });
        let kinks = jumps.map(|(_, piece)| piece.from * reach).collect();
        let tip = pieces.first().map_or(0.0, |piece| piece.height);
        let scaled = pieces.iter().map(|piece| Piece {
            from: piece.from * reach,
            height: (piece.height - tip) * rise,
            slope: piece.slope * rise / reach,
            bend: piece.bend * rise / reach / reach,
            growth: piece.growth * rise / reach / reach / reach,
        });
        for flaw in &mut flaws {
            flaw.x *= reach;
        }
        flaws.sort_by(|one, other| one.x.total_cmp(&other.x));
        let corners = if corner > 0.0 { vec![0.0] } else { Vec::new() };
        Self { reach, pieces: scaled.collect(), noise, kinks, corners, flaws, strays: Vec::new(), sags: Vec::new() }
    }
}

/// Between which neighbours a convex curve lies deeper below the straight line between them than between any before, from the middle outwards.
fn deepest(points: &[Point], fitted: impl Fn(f64) -> f64) -> impl Iterator<Item = Sag> {
    let gaps = points.windows(2).filter(|pair| pair[0].x < pair[1].x);
    let mut most = 0.0;
    gaps.filter_map(move |pair| {
        let (from, to) = (pair[0].x, pair[1].x);
        let at = f64::midpoint(from, to);
        let depth = f64::midpoint(fitted(from), fitted(to)) - fitted(at);
        (depth > most).then(|| {
            most = depth;
            Sag { from, at, depth }
        })
    })
}

/// The piece in which a point lies.
fn at(pieces: &[Piece], x: f64) -> &Piece {
    &pieces[pieces.partition_point(|piece| piece.from <= x).saturating_sub(1)]
}

/// The spline to be had, and the sum of squares that it leaves over.
fn best(points: &[Point], distances: usize, rounding: f64) -> (Spline, f64) {
    let count = points.len() as f64;
    let most = [32, 16, 8, 4, 2].into_iter().find(|&pieces| 2 * (pieces + 2) <= distances).unwrap_or(1).min(PIECES);
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

/// The convex spline on every `stride`-th of the finest knots, with or without a corner, and the sum of squares left over.
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

impl PunchShape for Profile {
    fn height(&self, x: f64) -> f64 {
        let x = x.abs();
        // Written so that what is no number is outside.
        if x <= self.reach { at(&self.pieces, x).height(x) } else { f64::NAN }
    }

    fn slope(&self, x: f64) -> f64 {
        if x == 0.0 {
            return 0.0;
        }
        let outward = x.abs();
        if outward <= self.reach { at(&self.pieces, outward).slope(outward).copysign(x) } else { f64::NAN }
    }

    fn natural_length(&self) -> f64 {
        0.25 * self.reach
    }

    fn reach(&self) -> Option<f64> {
        Some(self.reach)
    }

    fn face(&self) -> f64 {
        let is_level = |piece: &&Piece| piece.slope == 0.0 && piece.bend == 0.0 && piece.growth == 0.0;
        self.pieces.iter().find(|piece| !is_level(piece)).map_or(0.0, |piece| piece.from)
    }

    fn flaw(&self, half_width: f64) -> Option<Flaw> {
        let flaw = self.flaws.first().filter(|flaw| flaw.x <= half_width).cloned();
        let end = (half_width > self.reach).then(|| Flaw { what: "the table ends".into(), x: self.reach });
        flaw.or(end)
    }

    fn kinks(&self) -> &[f64] {
        &self.kinks
    }

    fn corners(&self) -> &[f64] {
        &self.corners
    }

    fn noise(&self) -> Option<f64> {
        Some(self.noise)
    }

    fn remarks(&self, half_width: f64) -> Vec<String> {
        let strays = self.strays.first().map(|x| match self.strays.len() {
            1 => format!("the row of the punch's table at |x| = {} is far off the others and left out", short(*x)),
            count => {
                format!(
                    "{count} rows of the punch's table, the first at |x| = {}, are far off the others and left out",
                    short(*x)
                )
            }
        });
        let within = &self.sags[..self.sags.partition_point(|sag| sag.from < half_width)];
        let sag = within.last().map(|sag| (sag, sag.depth / self.height(half_width)));
        let sparse = sag.filter(|(_, share)| *share > TOLD).map(|(Sag { at, .. }, share)| {
            let by =
                if share < 1.0 { format!("up to {:.0} % of its height", 100.0 * share) } else { "more than its height".into() };
            format!(
                "the punch has few rows under the contact: between them it is a smooth convex curve, which lies below straight lines from \
                 row to row by {by} at the contact's edge, most at x = {}",
                short(*at)
            )
        });
        strays.into_iter().chain(sparse).collect()
    }
}
