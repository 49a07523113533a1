//! Every stick zone that a friction coefficient allows: roots of `eta(a) = +-eta`.

mod samples;

use super::stick::Shear;
use super::stick_zone::StickZone;
use crate::engine::numerics::root;
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::pressure::normal::Normal;
use arrayvec::ArrayVec;
use basin::RootError;
use samples::Sample;
use slipzone_api::Refusal;
use std::f64::consts::PI;

pub(crate) use samples::Samples;

/// Half of the bracket around a root that the asymptote predicts.
const PREDICTED: f64 = 0.25;
/// What is left of `eta(lambda) - eta` at a root, over `eta` or over what it is at the bracket's ends, is of the order
/// of the root's tolerance; beside a pole it is huge. (Over a tiny `eta` alone every root would look like one.)
const POLE: f64 = 0.01;
/// Most roots kept; two or three are the most ever seen.
const MOST_ROOTS: usize = 16;
/// Roots closer than this in `lambda` are one.
const SAME_ROOT: f64 = 1e-6;
/// Position tolerance of a root in `lambda`, over the tolerance of the scene: an error in `lambda` is at
/// most that much, relative, in either zone's width.
const ROOT_SHARE: f64 = 1e-3;
/// The scan's own roots are only a start.
const SCANNED: f64 = 1e-4;
/// Half of the first bracket around a root that was lost.
const LOST: f64 = 0.005;
/// How often a bracket is doubled.
const DOUBLED: u32 = 10;

/// The friction law at one resolution, as a function of `lambda = ln(a/(b - a))`.
pub(crate) struct FrictionCurve<'a> {
    pub(crate) layer: &'a PreparedLayer,
    pub(crate) normal: &'a mut Normal,
    pub(crate) shear: &'a mut Shear,
    pub(crate) beta: f64,
    /// Relative error wanted of the zones' widths.
    pub(crate) tolerance: f64,
}

/// A stick zone that balances.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Root {
    pub(crate) lambda: f64,
    /// `+1` for inward slip, `-1` for outward.
    pub(crate) branch: f64,
    /// `d eta/d lambda`.
    pub(crate) slope: f64,
    /// See [`root::Near::doubt`].
    pub(crate) doubt: f64,
}

/// What one scan found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Found {
    pub(crate) roots: ArrayVec<Root, MOST_ROOTS>,
    /// Below what a root lies that is below all stick zones looked for.
    pub(crate) narrower: Option<f64>,
    /// Whether one lies above all.
    pub(crate) wider: bool,
    /// Largest `|eta|` of the scan.
    pub(crate) largest: f64,
}

impl FrictionCurve<'_> {
    /// Friction coefficient of one stick zone; leaves its shear traction in `shear`.
    pub(crate) fn at(&mut self, lambda: f64) -> Result<f64, Refusal> {
        let zone = StickZone::from_log(lambda, self.normal.half_width);
        self.shear.solve(self.layer, self.normal, self.beta, zone)
    }

    /// [`Self::at`], unless the zone solved last is this one to within a relative error of its widths.
    pub(crate) fn at_or_near(&mut self, lambda: f64, error: f64) -> Result<(), Refusal> {
        let last = self.shear.zone;
        let is_near = (last.log() - lambda).abs() < error;
        let is_here = (last.contact() / self.normal.half_width - 1.0).abs() < 4.0 * f64::EPSILON;
        if !(self.shear.is_solved && is_near && is_here) {
            self.at(lambda)?;
        }
        Ok(())
    }

    /// `lambda` of the widest stick zones, `1 - a/b = 5e-131`: of what is beside wider ones squares may underflow.
    pub(crate) const WIDEST: f64 = 300.0;

    /// Whether stick zones of that `lambda` are looked for.
    pub(crate) fn reaches(lambda: f64) -> bool {
        (Self::NARROWEST..=Self::WIDEST).contains(&lambda)
    }

    /// Where the curve rises by less than this with `lambda`, beside wide zones, it is as good as flat.
    pub(crate) const FLAT: f64 = 3e-5;

    /// That of the narrowest that are sampled, `a/b = 7e-13`.
    pub(crate) const NARROWEST_SAMPLED: f64 = -28.0;

    /// That of the narrowest, where the curve follows its asymptote.
    pub(crate) const NARROWEST: f64 = -Self::WIDEST;

    /// All roots of `eta(lambda) = +-eta` within a sampled curve and beyond it, those of inward slip first.
    pub(crate) fn roots(&mut self, eta: f64, samples: &Samples) -> Result<Found, Refusal> {
        let is_enclosed = samples.enclose(eta);
        // Not kept for another coefficient: its last digits would depend on which came first.
        let continued = if is_enclosed { None } else { Some(self.continued(samples.clone())?) };
        let samples = continued.as_ref().unwrap_or(samples);
        let largest = samples.points.iter().fold(0.0_f64, |most, sample| most.max(sample.friction.abs()));
        let mut found = Found { largest, ..Found::default() };
        for branch in [1.0, -1.0] {
            let target = branch * eta;
            if !is_enclosed {
                self.below(target, samples, &mut found)?;
            }
            self.between_all(&samples.points, target, &mut found)?;
            for triple in samples.points.windows(3) {
                self.beside_extremum([triple[0], triple[1], triple[2]], target, &mut found)?;
            }
            if !is_enclosed {
                self.above(target, samples, &mut found)?;
            }
        }
        Ok(found)
    }

    /// The roots between samples with a sign change from one to the next.
    fn between_all(&mut self, samples: &[Sample], target: f64, found: &mut Found) -> Result<(), Refusal> {
        for (i, pair) in samples.windows(2).enumerate() {
            if (pair[0].friction - target) * (pair[1].friction - target) > 0.0 {
                continue;
            }
            let (from, to) = (pair[0].lambda, pair[1].lambda);
            let start = samples::expected(samples, i, target);
            let near = root::polish(start, to, SCANNED, |lambda| Ok(self.at(lambda)? - target))?;
            // Across a pole the sign changes too, and the curve is as steep as the bracket is narrow.
            let size = pair.iter().fold(target.abs(), |most, sample| most.max((sample.friction - target).abs()));
            let tame = |near: &root::Near| near.at >= from && near.slope.abs() * SCANNED < POLE * size;
            if let Some(root::Near { at: lambda, slope, .. }) = near.filter(tame) {
                // So coarse a resolution does not tell slopes for finer ones.
                found.add(Root { lambda, branch: target.signum(), slope, doubt: f64::INFINITY });
            } else if let Some(root) = self.root_between(from, to, target, SCANNED)? {
                found.add(root);
            }
        }
        Ok(())
    }

    /// Two roots may hide between samples of one sign where the curve turns around near the target: the
    /// parabola through three samples tells whether to look there.
    fn beside_extremum(&mut self, samples: [Sample; 3], target: f64, found: &mut Found) -> Result<(), Refusal> {
        let [l0, l1, l2] = samples.map(|sample| sample.lambda);
        let [f0, f1, f2] = samples.map(|sample| sample.friction - target);
        let turns = f0 * f1 > 0.0 && f1 * f2 > 0.0 && f1.abs() < f0.abs() && f1.abs() < f2.abs();
        if !turns {
            return Ok(());
        }
        let (rise, bend) = ((f2 - f0) / (l2 - l0), ((f2 - f1) / (l2 - l1) - (f1 - f0) / (l1 - l0)) / (l2 - l0));
        let vertex = (l1 - rise / (2.0 * bend)).clamp(l0, l2);
        // Half of the way to the target is near enough to look.
        let at_vertex = f1 - rise * rise / (4.0 * bend);
        if at_vertex * f1 > 0.5 * f1 * f1 {
            return Ok(());
        }
        let mut points = [samples.as_slice(), &[self.sample_at(vertex)?]].concat();
        points.sort_by(|one, other| one.lambda.total_cmp(&other.lambda));
        self.between_all(&points, target, found)
    }

    /// The root that the asymptote predicts below all samples.
    fn below(&mut self, target: f64, samples: &Samples, found: &mut Found) -> Result<(), Refusal> {
        let Some(&Sample { lambda, friction: value, .. }) = samples.points.first() else { return Ok(()) };
        // The curve falls towards zero there.
        if value * target <= 0.0 || value.abs() <= target.abs() {
            return Ok(());
        }
        if !samples.low {
            found.narrower = Some(lambda); // the scan went to its end
            return Ok(());
        }
        let slope = -2.0 / (PI * self.strained());
        let predicted = lambda + (target.recip() - value.recip()) / slope;
        // Where the pressure pulls in the middle the curve rises to a pole: no zone below takes less friction.
        if predicted >= lambda {
            return Ok(());
        }
        if predicted < Self::NARROWEST {
            found.narrower = Some(Self::NARROWEST);
            return Ok(());
        }
        self.near(predicted, Self::NARROWEST, lambda, target, found)
    }

    /// The root that the asymptote predicts above all samples.
    fn above(&mut self, target: f64, samples: &Samples, found: &mut Found) -> Result<(), Refusal> {
        let Some(&Sample { lambda, friction: value, .. }) = samples.points.last() else { return Ok(()) };
        if value >= target || (self.beta <= 0.0 && samples.high) {
            // The curve rises with the slope beta/pi.
            found.wider |= value.abs() < target.abs() && target > 0.0;
            return Ok(());
        }
        let predicted = lambda + (target - value) * PI / self.beta;
        if !samples.high || predicted > Self::WIDEST {
            found.wider |= target > 0.0;
            return Ok(());
        }
        self.near(predicted, lambda, Self::WIDEST, target, found)
    }

    /// The root near a predicted place, between two limits.
    fn near(&mut self, predicted: f64, least: f64, most: f64, target: f64, found: &mut Found) -> Result<(), Refusal> {
        if let Some(root) = self.around(predicted, PREDICTED, (least, most), target, SCANNED)? {
            found.add(root);
            return Ok(());
        }
        // Predicted just inside the range looked at, and just outside in truth.
        found.wider |= predicted > 0.0 && target > 0.0;
        if predicted < 0.0 {
            let is_below = self.at(least)? / target > 1.0;
            found.narrower.get_or_insert(if is_below { least } else { most });
        }
        Ok(())
    }

    /// A root known from a coarser resolution, followed to this one; `None` where it is lost.
    pub(crate) fn follow(&mut self, root: Root, eta: f64) -> Result<Option<Root>, Refusal> {
        let Root { lambda, branch, slope, doubt } = root;
        let target = branch * eta;
        if !Self::reaches(lambda) {
            return Ok(None);
        }
        let wanted = ROOT_SHARE * self.tolerance;
        let start = root::Near { at: lambda, slope, doubt };
        let near = root::polish(start, Self::WIDEST, wanted, |lambda| Ok(self.at(lambda)? - target))?;
        if let Some(root::Near { at: lambda, slope, doubt }) = near {
            return Ok(Some(Root { lambda, branch, slope, doubt }));
        }
        // Far from where it was.
        self.around(lambda, LOST, (Self::NARROWEST, Self::WIDEST), target, wanted)
    }

    /// The root in the first of ever wider brackets around a place, within limits, that holds one.
    fn around(
        &mut self,
        centre: f64,
        mut half: f64,
        (least, most): (f64, f64),
        target: f64,
        position: f64,
    ) -> Result<Option<Root>, Refusal> {
        for _ in 0..DOUBLED {
            let (lower, upper) = ((centre - half).max(least), (centre + half).min(most));
            if let Some(root) = self.root_between(lower, upper, target, position)? {
                return Ok(Some(root));
            }
            half *= 2.0;
        }
        Ok(None)
    }

    /// The root of `eta(lambda) = target` in an interval at whose ends the difference has two signs.
    fn root_between(&mut self, lower: f64, upper: f64, target: f64, position: f64) -> Result<Option<Root>, Refusal> {
        if lower >= upper {
            return Ok(None);
        }
        let mut size = target.abs();
        let excess = |lambda: f64| {
            let excess = self.at(lambda)? - target;
            if lambda <= lower || lambda >= upper {
                size = size.max(excess.abs());
            }
            Ok(excess)
        };
        match root::bracketed((lower, upper), position, excess) {
            // A sign change may also be a pole, where the system for q is singular. Where the slope is no number,
            // whoever follows the root brackets it anew.
            Ok(root::Bracketed { at: lambda, value, slope }) if value.abs() < POLE * size => {
                Ok(Some(Root { lambda, branch: target.signum(), slope, doubt: f64::INFINITY }))
            }
            Err(RootError::Evaluation(refusal)) => Err(refusal),
            _ => Ok(None),
        }
    }
}

impl Found {
    /// A single root.
    pub(crate) fn only(root: Root) -> Self {
        Self { roots: ArrayVec::from_iter([root]), ..Self::default() }
    }

    fn add(&mut self, root: Root) {
        let is_new = !self.roots.iter().any(|known| (known.lambda - root.lambda).abs() < SAME_ROOT);
        if is_new && !self.roots.is_full() {
            self.roots.push(root);
        }
    }
}
