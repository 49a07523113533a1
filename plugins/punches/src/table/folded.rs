//! A table's points folded about the middle and scaled.

use slipzone_api::Fault;

/// The fewest distances from the middle.
const FEWEST: usize = 4;

/// A point of the folded table, scaled.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    /// Distance from the middle.
    pub(super) x: f64,
    pub(super) height: f64,
    /// Whether it stood on the left.
    pub(super) left: bool,
}

/// The points of a table, from the middle outwards, scaled.
pub(super) struct Folded {
    pub(super) points: Vec<Point>,
    /// How many distances from the middle they have.
    pub(super) distances: usize,
    /// The last distance from the middle, and the range of the heights, in the units of the rows.
    pub(super) reach: f64,
    pub(super) range: f64,
    /// The height of the first point, in the unit of the rows: it counts as 0.
    pub(super) tip: f64,
    /// What rounding makes of the heights.
    pub(super) rounding: f64,
    /// The last decimal to which all heights are given, in units of their range; 0 where they have more than are told
    /// apart.
    pub(super) decimal: f64,
}

impl Folded {
    /// Points with ascending `x`, given in those units.
    ///
    /// # Errors
    /// When they are too few, too far from the middle, or all of one height.
    pub(super) fn new(rows: &[[f64; 2]], [x_unit, height_unit]: [f64; 2]) -> Result<Self, Fault> {
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
    pub(super) fn never_rises(&self, [x_unit, height_unit]: [f64; 2]) -> Fault {
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
