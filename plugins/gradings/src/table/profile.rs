//! Curves through the rows of a table.

use super::floater_hormann::Interpolant;
use super::rows::Rows;
use slipzone_api::{Fault, ModulusLaw, Poisson, short};
use std::sync::Arc;

/// The fewest rows.
const LEAST: usize = 4;

/// By how much of itself a table may end above the base: roundings of decimals and of units.
const ROUNDING: f64 = 1e-9;

/// By how much the logarithm of the modulus may leave those of the rows beside it, where no step between rows is larger.
const SWING: f64 = std::f64::consts::LN_2;

/// A table this many times as deep as the layer is to have as many rows within it as a table has at least.
const FAR_DEEPER: f64 = 100.0;

/// The logarithm of the modulus, and Poisson's ratio, over depth in the user's unit.
#[derive(Debug)]
pub(super) struct Profile {
    curve: Interpolant,
    logarithms: Vec<f64>,
    /// Poisson's ratios; none where the layer has one.
    ratios: Vec<f64>,
}

impl Profile {
    pub(super) fn new(rows: &Rows, depth_unit: f64, modulus_unit: f64) -> Result<Self, Fault> {
        let count = rows.depths.len();
        if count < LEAST {
            let found = if count == 1 { "1 row".into() } else { format!("{count} rows") };
            return Err(Fault::new(&[], "too few rows").found(found).expected(format!("at least {LEAST}")));
        }
        let curve = Interpolant::new(rows.depths.iter().map(|depth| depth * depth_unit).collect());
        let logarithms = rows.moduli.iter().map(|modulus| (modulus * modulus_unit).ln()).collect();
        let profile = Self { curve, logarithms, ratios: rows.ratios.clone() };
        profile.swing().or_else(|| profile.overshoot()).map_or(Ok(profile), Err)
    }

    /// A modulus far beyond those of the rows that it lies between: a steep step makes a smooth curve swing on both sides.
    fn swing(&self) -> Option<Fault> {
        let (depths, logarithms) = (self.curve.nodes(), &self.logarithms);
        let step = |i: usize| (logarithms[i + 1] - logarithms[i]).abs();
        let between = 0..depths.len() - 1;
        let allowed = between.clone().map(step).fold(SWING, f64::max);
        let (i, depth, logarithm) = between.clone().find_map(|i| {
            let depth = f64::midpoint(depths[i], depths[i + 1]);
            let logarithm = self.curve.at(depth, logarithms);
            let (least, most) = (logarithms[i].min(logarithms[i + 1]), logarithms[i].max(logarithms[i + 1]));
            // Written so that what is no number is not within.
            let is_within = logarithm >= least - allowed && logarithm <= most + allowed;
            (!is_within).then_some((i, depth, logarithm))
        })?;
        let slope = |i: usize| step(i) / (depths[i + 1] - depths[i]);
        let steepest = between.max_by(|one, other| slope(*one).total_cmp(&slope(*other)))?;
        let row = |i: usize| format!("{} at depth {}", short(logarithms[i].exp()), depths[i]);
        let fault = Fault::new(&[], "the curve through the moduli swings far beyond them")
            .found(format!(
                "{} at depth {}, between the rows with {} and {}",
                short(logarithm.exp()),
                short(depth),
                row(i),
                row(i + 1)
            ))
            .expected("rows between which a smooth curve stays near them");
        Some(fault.hint(format!(
            "it is steepest between {} and {}: give more rows beside these, or one in place of both; a jump is a `stack`",
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
        Ok(Box::new(Law { profile: self, thickness }))
    }
}

#[derive(Debug)]
struct Law {
    profile: Arc<Profile>,
    thickness: f64,
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
}
