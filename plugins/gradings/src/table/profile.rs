//! Curves through the rows of a table.

use super::floater_hormann::{DEGREE, Interpolant};
use super::rows::Rows;
use slipzone_api::{Fault, MODERATE, ModulusLaw, Poisson, short};
use std::sync::Arc;

/// The fewest rows.
const LEAST: usize = 4;

/// By how much of itself a table may end above the base: roundings of decimals and of units.
const ROUNDING: f64 = 1e-9;

/// By how much the logarithm of the modulus may leave those of the rows beside it, over the largest step between rows,
/// and at least.
///
/// A curve of the highest degree that strays no farther than the first of these is taken, or else the one that strays
/// least: between rows whose distances differ much those of higher degrees swing. None may stray beyond the second.
const STRAYS: f64 = 0.25;
const SWINGS: f64 = 0.5;
const LEAST_STEP: f64 = std::f64::consts::LN_2;

/// A curve of a lower degree that does not swing takes the place of one that may be off by so many times what its rows
/// are: between rows that are far closer together in one place than in another, those of higher degrees tell the
/// rounding of the decimals.
const MAGNIFIES: f64 = 1e3;

/// By how much of itself the modulus may leave the straight line between two rows before users are told: one that grows
/// exponentially does so where it grows by a factor of 1.9 from row to row.
const TOLD: f64 = 0.05;
/// How near to a row a curve is looked at, over the distance of the rows beside it: rows close together make it swing
/// nearer to them than to those farther off.
const BESIDE: f64 = 0.25;

/// A table this many times as deep as the layer is to have as many rows within it as a table has at least.
const FAR_DEEPER: f64 = 100.0;

/// The logarithm of the modulus, and Poisson's ratio, over depth in the user's unit.
#[derive(Debug)]
pub(super) struct Profile {
    curve: Interpolant,
    degree: usize,
    logarithms: Vec<f64>,
    /// Poisson's ratios; none where the layer has one.
    ratios: Vec<f64>,
    seen: Seen,
}

/// What a curve does between its rows.
#[derive(Debug, Default)]
struct Seen {
    /// By how much the logarithm of the modulus leaves those of the rows that it lies between, over the largest step
    /// between rows, at most; after which row, and at which depth.
    strays: f64,
    after: usize,
    at: f64,
    /// How many times what the rows are off by the curve may be off by.
    magnifies: f64,
    /// Whether Poisson's ratio leaves its range.
    overshoots: bool,
    /// By how much of it the modulus leaves the straight line between each row and the next, and at which depth.
    departures: Vec<(f64, f64)>,
}

impl Profile {
    pub(super) fn new(rows: &Rows, depth_unit: f64, modulus_unit: f64) -> Result<Self, Fault> {
        let count = rows.depths.len();
        if count < LEAST {
            let found = if count == 1 { "1 row".into() } else { format!("{count} rows") };
            return Err(Fault::new(&[], "too few rows").found(found).expected(format!("at least {LEAST}")));
        }
        let depths: Vec<f64> = rows.depths.iter().map(|depth| depth * depth_unit).collect();
        let are_apart = depths.windows(2).all(|pair| pair[0] < pair[1]);
        if !are_apart || !depths[1..].iter().all(|depth| MODERATE.contains(depth)) {
            let found = format!("depths from {:e} to {:e}", depths[1], depths[count - 1]);
            let fault = Fault::new(&["depth_unit"], "a unit in which depths cannot be told apart").found(found);
            return Err(fault.expected("depths between 1e-100 and 1e100"));
        }
        if let Some(modulus) = rows.moduli.iter().map(|m| m * modulus_unit).find(|modulus| !MODERATE.contains(modulus))
        {
            let fault = Fault::new(&["modulus_unit"], "a unit in which moduli are too large or too small");
            return Err(fault.found(format!("a modulus of {modulus:e}")).expected("moduli between 1e-100 and 1e100"));
        }
        let logarithms: Vec<f64> = rows.moduli.iter().map(|modulus| (modulus * modulus_unit).ln()).collect();
        let of_degree = |degree: usize| {
            let curve = Interpolant::new(depths.clone(), degree);
            let (logarithms, ratios) = (logarithms.clone(), rows.ratios.clone());
            Self { curve, degree, logarithms, ratios, seen: Seen::default() }.seen()
        };
        let highest = DEGREE.min(count - 1);
        let mut profile = of_degree(highest);
        for degree in (0..highest).rev() {
            if profile.rank() == (false, false, 0.0) {
                break;
            }
            let other = of_degree(degree);
            if other.rank() < profile.rank() {
                profile = other;
            }
        }
        let swings = if profile.seen.strays > SWINGS { Some(profile.swing()) } else { profile.overshoot() };
        swings.map_or(Ok(profile), Err)
    }

    /// What makes a curve worse than one of another degree, the worst first: that it swings, that it magnifies what the
    /// rows are off by, that it strays.
    fn rank(&self) -> (bool, bool, f64) {
        let Seen { strays, magnifies, overshoots, .. } = self.seen;
        (strays > SWINGS || overshoots, magnifies > MAGNIFIES, if strays > STRAYS { strays } else { 0.0 })
    }

    /// Depths after a row at which the curve is looked at: half-way to the next, a quarter of the way from each, as it
    /// may cross a line half-way, and each time half as far from a row as long as those on its other side are as near.
    fn looked_at(&self, row: usize) -> impl Iterator<Item = f64> {
        let depths = self.curve.nodes();
        let (from, to) = (depths[row], depths[row + 1]);
        let gap = to - from;
        let before = row.checked_sub(1).map_or(gap, |before| from - depths[before]);
        let after = depths.get(row + 2).map_or(gap, |after| after - to);
        let halved = move |beside: f64| {
            let halves = std::iter::successors(Some(0.25 * gap), |half| Some(0.5 * half));
            halves.take_while(move |half| *half >= BESIDE * beside.min(gap))
        };
        let beside = halved(before).map(move |half| from + half).chain(halved(after).map(move |half| to - half));
        [f64::midpoint(from, to)].into_iter().chain(beside)
    }

    /// With what is seen of the curve between its rows.
    fn seen(self) -> Self {
        let (depths, logarithms) = (self.curve.nodes(), &self.logarithms);
        let step = logarithms.windows(2).fold(LEAST_STEP, |most, ends| most.max((ends[1] - ends[0]).abs()));
        let mut seen = Seen::default();
        for (i, (ends, rows)) in depths.windows(2).zip(logarithms.windows(2)).enumerate() {
            let mut departures = Vec::new();
            for depth in self.looked_at(i) {
                let (logarithm, magnifies) = self.curve.magnified(depth, logarithms);
                seen.magnifies = seen.magnifies.max(magnifies);
                let strays = (logarithm - rows[0].max(rows[1])).max(rows[0].min(rows[1]) - logarithm) / step;
                // What is no number strays as far as can be.
                let strays = if strays.is_nan() { f64::INFINITY } else { strays };
                if strays > seen.strays {
                    (seen.strays, seen.after, seen.at) = (strays, i, depth);
                }
                let part = (depth - ends[0]) / (ends[1] - ends[0]);
                let line = rows[0].exp() + part * (rows[1].exp() - rows[0].exp());
                departures.push((logarithm.exp() / line - 1.0, depth));
            }
            seen.departures.extend(farthest(departures.into_iter()));
        }
        seen.overshoots = self.overshoot().is_some();
        Self { seen, ..self }
    }

    /// By how much the modulus leaves straight lines between rows above a depth, if that is to be told.
    fn departure(&self, base: f64) -> Option<String> {
        let (departure, depth) = farthest(self.seen.departures.iter().copied().filter(|(_, depth)| *depth <= base))?;
        (departure.abs() > TOLD).then(|| {
            format!(
                "between its rows the grading is a smooth curve, which leaves straight lines from row to row by up to {:.0} %: at depth \
                 {} the modulus is that much {}",
                100.0 * departure.abs(),
                short(depth),
                if departure > 0.0 { "larger" } else { "smaller" }
            )
        })
    }

    /// A modulus far beyond those of the rows that it lies between: a steep step makes a smooth curve swing on both
    /// sides.
    fn swing(&self) -> Fault {
        let (depths, logarithms) = (self.curve.nodes(), &self.logarithms);
        let Seen { after: i, at: depth, .. } = self.seen;
        let slope = |i: &usize| ((logarithms[i + 1] - logarithms[*i]) / (depths[i + 1] - depths[*i])).abs();
        let steepest = (0..depths.len() - 1).max_by(|one, other| slope(one).total_cmp(&slope(other))).unwrap_or(i);
        let row = |i: usize| format!("{} at depth {}", short(logarithms[i].exp()), depths[i]);
        let fault = Fault::new(&[], "the curve through the moduli swings far beyond them")
            .found(format!(
                "{} at depth {}, between the rows with {} and {}",
                short(self.curve.at(depth, logarithms).exp()),
                short(depth),
                row(i),
                row(i + 1)
            ))
            .expected("rows between which a smooth curve stays near them");
        fault.hint(format!(
            "it is steepest between {} and {}: give more rows beside these, or one in place of both; a jump, and straight lines from \
             row to row, are a `stack`",
            row(steepest),
            row(steepest + 1)
        ))
    }

    /// A Poisson's ratio out of range between rows that are in range.
    fn overshoot(&self) -> Option<Fault> {
        if self.ratios.is_empty() {
            return None;
        }
        let mut depths = (0..self.ratios.len() - 1).flat_map(|row| self.looked_at(row));
        depths.find_map(|depth| {
            let ratio = self.curve.at(depth, &self.ratios);
            Poisson::new(ratio).is_err().then(|| {
                Fault::new(&[], "the curve through the Poisson's ratios leaves their range")
                    .found(format!("{ratio:.6} at depth {}, between two rows", short(depth)))
                    .expected("a curve above -1 and up to 0.5")
                    .hint("give more rows there, or ratios that change less abruptly; a jump is a `stack`")
            })
        })
    }

    /// The law of a layer of that thickness; in words, why there is none.
    pub(super) fn law(self: Arc<Self>, thickness: f64) -> Result<Box<dyn ModulusLaw>, String> {
        let last = self.curve.nodes()[self.curve.nodes().len() - 1];
        if last < thickness * (1.0 - ROUNDING) {
            return Err(format!(
                "the rows end at depth {last}, above the base at {thickness}; add a row at or below the base, or check \
                 `depth_unit` and the thickness"
            ));
        }
        let within = self.curve.nodes().partition_point(|depth| *depth <= thickness * (1.0 + ROUNDING));
        if within < LEAST && last > FAR_DEEPER * thickness {
            return Err(format!(
                "the base is at {thickness} and the rows go down to depth {last}, {within} of {} within the layer; check \
                 `depth_unit` and the thickness, or give at least {LEAST} rows there",
                self.curve.nodes().len()
            ));
        }
        let rows = self.curve.nodes().iter().map(|depth| depth / thickness).take_while(|depth| *depth <= 1.0).collect();
        Ok(Box::new(Law { profile: self, thickness, rows }))
    }
}

/// The departure that is farthest from none, and its depth.
fn farthest(departures: impl Iterator<Item = (f64, f64)>) -> Option<(f64, f64)> {
    departures.max_by(|one, other| one.0.abs().total_cmp(&other.0.abs()))
}

#[derive(Debug)]
struct Law {
    profile: Arc<Profile>,
    thickness: f64,
    /// Depths of those in the layer, over the thickness.
    rows: Vec<f64>,
}

impl ModulusLaw for Law {
    fn modulus(&self, depth: f64) -> f64 {
        self.profile.curve.at(depth * self.thickness, &self.profile.logarithms).exp()
    }

    fn poisson(&self, depth: f64) -> Option<f64> {
        if self.profile.ratios.is_empty() {
            return None;
        }
        Some(self.profile.curve.at(depth * self.thickness, &self.profile.ratios))
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        let logarithm = self.profile.curve.series(&self.profile.logarithms, self.thickness, terms);
        logarithm.with_value(0.0).exp().into_finite()
    }

    fn poisson_series(&self, terms: usize) -> Vec<f64> {
        if self.profile.ratios.is_empty() {
            return Vec::new();
        }
        self.profile.curve.series(&self.profile.ratios, self.thickness, terms).into_finite()
    }

    fn probes(&self) -> &[f64] {
        &self.rows
    }

    fn remarks(&self) -> Vec<String> {
        let (degree, rows) = (self.profile.degree, self.profile.curve.nodes().len());
        let lower = (degree != DEGREE).then(|| {
            let why = if degree + 1 == rows {
                format!("{rows} rows allow no higher one")
            } else {
                "curves of higher degrees swing between them, or would, were one off by a thousandth".to_owned()
            };
            format!("the curve through the rows of the grading is of degree {degree}, not {DEGREE}: {why}")
        });
        lower.into_iter().chain(self.profile.departure(self.thickness)).collect()
    }
}
