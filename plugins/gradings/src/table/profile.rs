//! Curves through the rows of a table.

use super::floater_hormann::{DEGREE, Interpolant};
use super::rows::Rows;
use slipzone_api::{Fault, ModulusLaw, Poisson, short};
use std::sync::{Arc, OnceLock};

/// The fewest rows.
const LEAST: usize = 4;

/// By how much of itself a table may end above the base: roundings of decimals and of units.
const ROUNDING: f64 = 1e-9;

/// By how much the logarithm of the modulus may leave those of the rows beside it, over the largest step between rows, and at least.
///
/// A curve of the highest degree that strays no farther than the first of these is taken, or else the one that strays least: between rows
/// whose distances differ much those of higher degrees swing. None may stray beyond the second.
const STRAYS: f64 = 0.25;
const SWINGS: f64 = 0.5;
const LEAST_STEP: f64 = std::f64::consts::LN_2;

/// By how much of itself the modulus may leave the straight line between two rows before users are told: one that grows exponentially
/// does so where it grows by a factor of 1.9 from row to row.
const TOLD: f64 = 0.05;
/// Where that is looked for, over the distance of two rows: a curve that swings may cross the line half-way.
const LOOKED: [f64; 3] = [0.25, 0.5, 0.75];

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
    /// By how much of it the modulus leaves the straight line between each row and the next, and at which depth; found when asked for.
    departures: OnceLock<Vec<(f64, f64)>>,
}

impl Profile {
    pub(super) fn new(rows: &Rows, depth_unit: f64, modulus_unit: f64) -> Result<Self, Fault> {
        let count = rows.depths.len();
        if count < LEAST {
            let found = if count == 1 { "1 row".into() } else { format!("{count} rows") };
            return Err(Fault::new(&[], "too few rows").found(found).expected(format!("at least {LEAST}")));
        }
        let depths: Vec<f64> = rows.depths.iter().map(|depth| depth * depth_unit).collect();
        let logarithms: Vec<f64> = rows.moduli.iter().map(|modulus| (modulus * modulus_unit).ln()).collect();
        let of_degree = |degree: usize| {
            let curve = Interpolant::new(depths.clone(), degree);
            let (logarithms, ratios) = (logarithms.clone(), rows.ratios.clone());
            let profile = Self { curve, degree, logarithms, ratios, departures: OnceLock::new() };
            let strays = if profile.overshoot().is_some() { f64::INFINITY } else { profile.strays().0 };
            (strays, profile)
        };
        let highest = DEGREE.min(count - 1);
        let (mut least, mut profile) = of_degree(highest);
        for degree in (0..highest).rev() {
            if least <= STRAYS {
                break;
            }
            let (strays, other) = of_degree(degree);
            if strays < least {
                (least, profile) = (strays, other);
            }
        }
        if least <= SWINGS {
            return Ok(profile);
        }
        profile.swing().or_else(|| profile.overshoot()).map_or(Ok(profile), Err)
    }

    /// By how much the logarithm of the modulus leaves those of the rows that it lies between, over the largest step between rows, half-way
    /// between two of them, at most; after which row, and at which depth.
    fn strays(&self) -> (f64, usize, f64) {
        let (depths, logarithms) = (self.curve.nodes(), &self.logarithms);
        let step = logarithms.windows(2).fold(LEAST_STEP, |most, ends| most.max((ends[1] - ends[0]).abs()));
        let mut worst = (0.0, 0, depths[0]);
        for (i, (ends, rows)) in depths.windows(2).zip(logarithms.windows(2)).enumerate() {
            let depth = f64::midpoint(ends[0], ends[1]);
            let logarithm = self.curve.at(depth, logarithms);
            let strays = (logarithm - rows[0].max(rows[1])).max(rows[0].min(rows[1]) - logarithm) / step;
            // What is no number strays as far as can be.
            let strays = if strays.is_nan() { f64::INFINITY } else { strays };
            if strays > worst.0 {
                worst = (strays, i, depth);
            }
        }
        worst
    }

    /// By how much of it the modulus leaves the straight line between each row and the next, and at which depth.
    fn departures(&self) -> &[(f64, f64)] {
        self.departures.get_or_init(|| {
            let gaps = self.curve.nodes().windows(2).zip(self.logarithms.windows(2));
            let of = |(ends, rows): (&[f64], &[f64])| {
                let departure = |part: f64| {
                    let depth = ends[0] + part * (ends[1] - ends[0]);
                    let line = rows[0].exp() + part * (rows[1].exp() - rows[0].exp());
                    (self.curve.at(depth, &self.logarithms).exp() / line - 1.0, depth)
                };
                farthest(LOOKED.into_iter().map(departure)).unwrap_or_default()
            };
            gaps.map(of).collect()
        })
    }

    /// By how much the modulus leaves straight lines between rows above a depth, if that is to be told.
    fn departure(&self, base: f64) -> Option<String> {
        let (departure, depth) = farthest(self.departures().iter().copied().filter(|(_, depth)| *depth <= base))?;
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

    /// A modulus far beyond those of the rows that it lies between: a steep step makes a smooth curve swing on both sides.
    fn swing(&self) -> Option<Fault> {
        let (depths, logarithms) = (self.curve.nodes(), &self.logarithms);
        let (strays, i, depth) = self.strays();
        if strays <= SWINGS {
            return None;
        }
        let slope = |i: &usize| ((logarithms[i + 1] - logarithms[*i]) / (depths[i + 1] - depths[*i])).abs();
        let steepest = (0..depths.len() - 1).max_by(|one, other| slope(one).total_cmp(&slope(other)))?;
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
        Some(fault.hint(format!(
            "it is steepest between {} and {}: give more rows beside these, or one in place of both; a jump, and straight lines from \
             row to row, are a `stack`",
            row(steepest),
            row(steepest + 1)
        )))
    }

    /// A Poisson's ratio out of range between rows that are in range.
    fn overshoot(&self) -> Option<Fault> {
        if self.ratios.is_empty() {
            return None;
        }
        self.curve.nodes().windows(2).find_map(|ends| {
            let depth = 0.5 * (ends[0] + ends[1]);
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
                "curves of higher degrees swing between them".to_owned()
            };
            format!("the curve through the rows of the grading is of degree {degree}, not {DEGREE}: {why}")
        });
        lower.into_iter().chain(self.profile.departure(self.thickness)).collect()
    }
}
