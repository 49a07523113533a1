//! Tractions along a solved contact, and the strain left on its surface.

use super::Solved;
use crate::engine::accuracy::quantity::Quantity;
use crate::engine::friction::rubbing::Rubbing;
use crate::engine::friction::stick_zone::StickZone;
use crate::engine::friction::strain::Strains;
use crate::engine::solution::Profile;
use crate::scene::Scene;
use slipzone_api::{Refusal, Station};

/// Points at which tractions are told before the budget is looked at again, and those of a stack, each of which is told
/// by many flat punches.
const AT_ONCE: usize = 1024;
const STACKED_AT_ONCE: usize = 32;

impl Solved<'_> {
    /// Tractions at the points that the scene asks for, in its units.
    pub(super) fn profile(&mut self, scene: &Scene) -> Result<Profile, Refusal> {
        if let Some(x) = &scene.output.x {
            return self.tractions(x, scene);
        }
        // Equally spaced points are their own mirror images, and so are the tractions: the right half will do.
        let last = scene.output.points - 1;
        let right: Vec<f64> = (last.div_ceil(2)..=last).map(|i| (2 * i - last) as f64 / last as f64).collect();
        let half = self.tractions(&right, scene)?;
        let left = scene.output.points / 2;
        Ok(Profile {
            x: with_mirror(&half.x, left, |x| -x),
            pressure: with_mirror(&half.pressure, left, |p| p),
            shear: half.shear.map(|shear| with_mirror(&shear, left, |q| q.map(|q| 0.0 - q))),
            strain: None,
        })
    }

    /// Tractions at points in units of the half-width.
    fn tractions(&mut self, relative: &[f64], scene: &Scene) -> Result<Profile, Refusal> {
        let (b, as_told) = (self.half_width(), self.friction_as_told());
        let Self { layer, problem, stage, judged, .. } = self;
        // The ends stand where the contact is said to end, to the last digit.
        let told = super::load(scene.load, problem, &judged.outcome.numbers).half_width;
        let half_width = told.unwrap_or(b * problem.length);
        let sharp = stage.contact.normal.is_sharp();
        let value = |found: Option<f64>| match found {
            // Beside a corner it is unbounded. No number anywhere is a fault, which is told.
            Some(value) => (!value.is_infinite()).then_some(value * problem.stress),
            None => (!sharp).then_some(0.0),
        };
        let station = |x: &f64| Station { x: x * b, gap: (1.0 - x.abs()) * b };
        let mut inside: Vec<Station> = relative.iter().map(station).collect();
        inside.retain(|station| station.gap > 0.0);
        let mut pressure = vec![0.0; inside.len()];
        let mut shear = Some(Vec::with_capacity(inside.len()));
        let at_once = if problem.is_stacked() { STACKED_AT_ONCE } else { AT_ONCE };
        for (at, pressure) in inside.chunks(at_once).zip(pressure.chunks_mut(at_once)) {
            layer.meter().within()?;
            stage.pressure_into(problem, at, pressure);
            let found = stage.shear(problem, at, pressure);
            shear = shear.zip(found).map(|(mut all, found)| {
                all.extend(found);
                all
            });
        }
        // Points on the edge or beyond it have no value of their own.
        let spread = |values: Vec<f64>| {
            let mut values = values.into_iter();
            relative.iter().map(|x| value(if station(x).gap > 0.0 { values.next() } else { None })).collect()
        };
        let is_known = judged.outcome.rubbing.as_ref().is_none_or(Rubbing::has_zone);
        let shear = shear.filter(|_| is_known).map(|shear| spread(shear.into_iter().map(|q| q * as_told).collect()));
        Ok(Profile {
            x: relative.iter().map(|x| x * half_width).collect(),
            pressure: spread(pressure),
            shear,
            strain: None,
        })
    }

    /// The scene's friction coefficient over that of the stick zone found, which is as far from it as the zone is from
    /// its root: what slides bears `eta p` to the last digit.
    fn friction_as_told(&self) -> f64 {
        let found = self.judged.outcome.rubbing.as_ref().and_then(Rubbing::reported).and(self.stage.signed_friction());
        self.problem.friction.zip(found).map_or(1.0, |(told, found)| told / found.abs())
    }

    /// Adds the strain left in the stick zone to the tractions, where it can be told. How uncertain it is, over `A0 eta
    /// P/(2b)`: by what coarser grids change it, and by what the errors of the tractions make of it.
    pub(super) fn add_strain(&mut self, scene: &Scene, profile: &mut Profile) -> Result<Option<f64>, Refusal> {
        let (problem, judged, b) = (self.problem, self.judged, self.half_width());
        let rubbing = judged.outcome.rubbing.as_ref().filter(|rubbing| rubbing.has_zone());
        let Some((rubbing, friction)) = rubbing.zip(problem.friction) else { return Ok(None) };
        let relative = profile.x.iter().map(|x| x / (problem.length * b));
        let mean = judged.outcome.numbers.get(Quantity::Mean).unwrap_or(0.0);
        let scale = problem.elastic.a0() * friction * mean;
        let wanted = scene.solver.tolerance.get() * scale;
        let Some(Strains { each, apart }) = self.strain((relative, wanted), rubbing.zone)? else { return Ok(None) };
        // Where the pressure is unbounded there is none.
        let told = each.into_iter().zip(&profile.pressure).map(|(strain, p)| p.and(strain));
        profile.strain = Some(told.collect());
        let of_pressure = problem.elastic.beta().abs() / friction * judged.doubt.unwrap_or(0.0);
        let error = apart / scale + judged.of_shear.unwrap_or(0.0) + of_pressure;
        Ok(error.is_finite().then_some(error))
    }

    /// The strain left in the stick zone at points in units of the half-width, the same on either side, and how
    /// uncertain it is where the tractions are exact.
    fn strain(
        &mut self,
        (relative, wanted): (impl Iterator<Item = f64>, f64),
        zone: StickZone,
    ) -> Result<Option<Strains<Option<f64>>>, Refusal> {
        let b = zone.contact();
        let at: Vec<f64> = relative.map(|x| x.abs() * b).collect();
        let mut sticking: Vec<f64> = at.iter().copied().filter(|x| *x < zone.half_width).collect();
        // Each distance once, though it comes on both sides.
        sticking.sort_by(f64::total_cmp);
        sticking.dedup_by(|one, other| one.to_bits() == other.to_bits());
        let found = self.stage.strain(self.layer, self.problem, (&sticking, wanted))?;
        let Some(Strains { each, apart }) = found else { return Ok(None) };
        let one = |x: f64| {
            let found = sticking.binary_search_by(|other| other.total_cmp(&x)).ok()?;
            each[found].filter(|strain| strain.is_finite())
        };
        Ok(Some(Strains { each: at.into_iter().map(one).collect(), apart }))
    }

    /// In layer units.
    fn half_width(&self) -> f64 {
        self.judged.outcome.numbers.get(Quantity::HalfWidth).unwrap_or(0.0)
    }
}

/// The mirror images of the outer `left` values, which are all but that of a point in the middle, and the values.
fn with_mirror<T: Copy>(right: &[T], left: usize, mirror: impl Fn(T) -> T) -> Vec<T> {
    let mut all = Vec::with_capacity(left + right.len());
    all.extend(right[right.len() - left..].iter().rev().map(|value| mirror(*value)));
    all.extend_from_slice(right);
    all
}
