//! A fitted table as a punch's shape.

use super::fit::Fit;
use super::folded::{Folded, Point};
use super::rows::Rows;
use super::scatter;
use super::spline::{Piece, at, finer};
use super::strays::strays;
use slipzone_api::{Fault, Flaw, MODERATE, PunchShape, of_height, short};

/// Of slopes, what need not be told from a smooth function.
const SMOOTH: f64 = 1e-10;

/// Places under a contact at which a curve and a finer one are compared.
const LOOKS: u32 = 16;

/// By how much of the height at the contact's edge the shape may leave straight lines from row to row before users are
/// told: a parabola does so where two rows or fewer are under half of the contact.
const TOLD: f64 = 0.05;

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
    /// The curve of more pieces, which tells how sure this one is.
    finer: Vec<Piece>,
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
        let Folded { points, distances, reach, range, rounding, decimal, .. } = folded;
        let fitted = |x: f64| at(&pieces, x).height(x);
        let residuals: Vec<f64> = points.iter().map(|point| point.height - fitted(point.x)).collect();
        let flaws = scatter::flaws(&points, &residuals, (rounding, decimal));
        let (reach, rise) = (reach * x_unit, range * height_unit);
        for (key, what, length) in [("x_unit", "the half-width of the table", reach), ("height_unit", "the rise", rise)]
        {
            if !MODERATE.contains(&length) {
                let fault = Fault::new(&[key], "a unit in which the punch is too large or too small");
                return Err(fault.found(format!("{what} {length:e}")).expected("lengths between 1e-100 and 1e100"));
            }
        }
        let noise = (left_over / points.len() as f64).sqrt() * rise;
        let sags = deepest(&points, fitted).map(|Sag { from, at, depth }| Sag {
            from: from * reach,
            at: at * reach,
            depth: depth * rise,
        });
        let finer = scaled(&finer(&points, distances, &pieces).pieces(), reach, rise);
        let mut profile = Self { sags: sags.collect(), finer, ..Self::in_units(&pieces, reach, rise, noise, flaws) };
        profile.leave_out(strays.into_iter().map(|stray| rows[stray][0].abs() * x_unit));
        Ok(profile)
    }

    /// Takes note of rows at those places that are no part of the shape.
    fn leave_out(&mut self, strays: impl Iterator<Item = f64>) {
        self.strays.extend(strays);
        self.strays.sort_by(f64::total_cmp);
        self.flaws
            .extend(self.strays.iter().map(|x| Flaw::new("a row of the punch's table is far off the others", *x)));
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
        for flaw in &mut flaws {
            flaw.x *= reach;
        }
        flaws.sort_by(|one, other| one.x.total_cmp(&other.x));
        let corners = if corner > 0.0 { vec![0.0] } else { Vec::new() };
        Self {
            reach,
            pieces: scaled(pieces, reach, rise),
            noise,
            kinks,
            corners,
            flaws,
            strays: Vec::new(),
            sags: Vec::new(),
            finer: Vec::new(),
        }
    }
}

/// Pieces in the units of the scene, their height counted from that of the tip.
fn scaled(pieces: &[Piece], reach: f64, rise: f64) -> Vec<Piece> {
    let tip = pieces.first().map_or(0.0, |piece| piece.height);
    let scaled = pieces.iter().map(|piece| Piece {
        from: piece.from * reach,
        height: (piece.height - tip) * rise,
        slope: piece.slope * rise / reach,
        bend: piece.bend * rise / reach / reach,
        growth: piece.growth * rise / reach / reach / reach,
    });
    scaled.collect()
}

/// Between which neighbours a convex curve lies deeper below the straight line between them than between any before,
/// from the middle outwards.
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
        let end = (half_width > self.reach).then(|| Flaw::new("the table ends", self.reach));
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

    fn doubt(&self, half_width: f64) -> Option<f64> {
        let places = (1..=LOOKS).map(|i| half_width * f64::from(i) / f64::from(LOOKS));
        let apart = places.map(|x| (at(&self.finer, x).height(x) - self.height(x)).abs());
        Some(apart.fold(0.0, f64::max) / self.height(half_width))
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
            let by = of_height("up to ", share);
            format!(
                "the punch has few rows under the contact: between them it is a smooth convex curve, which lies below straight lines from \
                 row to row by {by} at the contact's edge, most at x = {}",
                short(*at)
            )
        });
        let corner = self.corners.first().and(self.pieces.first()).map(|piece| {
            format!(
                "the shape fitted to the punch's heights has a corner at x = 0, of slope {:.1e} on either side: \
                 the pressure is unbounded there",
                piece.slope
            )
        });
        strays.into_iter().chain(corner).chain(sparse).collect()
    }
}
