//! Every stick zone that a friction coefficient allows: roots of `eta(a) = +-eta`.

use super::layer::Layer;
use super::normal::Pressure;
use super::stick::{Shear, StickZone, shear};
use basin::{RootError, Toms748Root};
use slipzone_api::Refusal;

/// `ln(a/(b - a))` at the smallest stick zone looked for: `a/b = 7e-13`.
const NARROWEST: f64 = -28.0;
/// Below this the half-plane law `eta ~ 1/ln(b/a)` rules and roots lie far apart.
const COARSE_BELOW: f64 = -4.0;
/// The curve is trusted where the slip zone is this many times as wide as the finest gap resolved.
const RESOLVED: f64 = 4.0;
/// A finer resolution scans again what lies this close to the end of a coarser one's scan.
const OVERLAP: f64 = 1.0;
/// What is left of `eta(lambda) - eta` at a root, over `eta`, is of the order of the root's tolerance;
/// beside a pole it is huge.
const POLE: f64 = 0.1;
/// Roots closer than this in `lambda` are one.
const SAME_ROOT: f64 = 1e-6;
/// Position tolerance of a root in `lambda`, over the tolerance of the scene: an error in `lambda` is at
/// most that much, relative, in either zone's width.
const ROOT_SHARE: f64 = 1e-3;
/// First half-width of the bracket around a known root.
const FIRST_STEP: f64 = 0.005;
/// Widening steps tried around a root known from a coarser resolution.
const MOST_STEPS: u32 = 10;

/// The friction law at one resolution, as a function of `lambda = ln(a/(b - a))`.
pub(crate) struct FrictionCurve<'a> {
    pub(crate) layer: &'a Layer<'a>,
    pub(crate) pressure: &'a Pressure,
    /// Nodes on either side of the slip zone's grid.
    pub(crate) slip_nodes: usize,
    /// Relative error wanted of the zones' widths.
    pub(crate) tolerance: f64,
}

/// What the search at one resolution leaves for the next.
#[derive(Clone, Debug, Default)]
pub(crate) struct Found {
    /// Roots, as `(lambda, branch)`; the branch is `+1` for inward slip and `-1` for outward.
    pub(crate) roots: Vec<(f64, f64)>,
    /// `lambda` up to which the curve was scanned.
    scanned: f64,
    /// The samples of the scan, `(lambda, eta(lambda))`, ascending.
    pub(crate) samples: Vec<(f64, f64)>,
}

impl FrictionCurve<'_> {
    /// Shear traction and friction coefficient of one stick zone.
    pub(crate) fn shear(&self, lambda: f64) -> Result<Shear, Refusal> {
        let zone = StickZone::from_log(lambda, self.pressure.half_width);
        shear(self.layer, self.pressure, zone, self.slip_nodes)
    }

    fn friction(&self, lambda: f64) -> Result<f64, Refusal> {
        self.shear(lambda).map(|shear| shear.friction)
    }

    /// `lambda` of the widest stick zone that the resolution can tell from the whole contact.
    pub(crate) fn widest(&self) -> f64 {
        let resolved = RESOLVED * self.pressure.finest_gap() / self.pressure.half_width;
        -resolved.ln()
    }

    /// All roots of `eta(lambda) = +-eta` from a full scan.
    pub(crate) fn scan(&self, eta: f64) -> Result<Found, Refusal> {
        self.extend(eta, Found { scanned: NARROWEST, ..Found::default() })
    }

    /// The roots known from a coarser resolution, followed to this one.
    pub(crate) fn follow(&self, eta: f64, coarse: &Found) -> Result<Found, Refusal> {
        let mut found = Found { roots: Vec::new(), ..coarse.clone() };
        for &(lambda, branch) in &coarse.roots {
            let mut step = FIRST_STEP;
            for _ in 0..MOST_STEPS {
                let (lower, upper) = (lambda - step, (lambda + step).min(self.widest()));
                if let Some(root) = self.root_between(lower, upper, branch * eta)? {
                    found.roots.push((root, branch));
                    break;
                }
                step *= 2.0;
            }
        }
        Ok(found)
    }

    /// Adds the roots of the part of the curve that only this resolution can reach.
    pub(crate) fn scan_on(&self, eta: f64, mut found: Found) -> Result<Found, Refusal> {
        let end = found.scanned - OVERLAP;
        found.samples.retain(|(lambda, _)| *lambda < end);
        found.scanned = end;
        self.extend(eta, found)
    }

    /// Scans from where `found` ends to the widest stick zone.
    fn extend(&self, eta: f64, mut found: Found) -> Result<Found, Refusal> {
        while found.scanned < self.widest() {
            if found.samples.is_empty() {
                found.samples.push((NARROWEST, self.friction(NARROWEST)?));
            }
            let (from, value) = *found.samples.last().expect("the scan's first sample");
            let step = if from < COARSE_BELOW { 4.0 } else { 1.0 };
            let to = (from + step).min(self.widest());
            let next = self.friction(to)?;
            for branch in [1.0, -1.0] {
                let target = branch * eta;
                if (value - target) * (next - target) < 0.0
                    && let Some(root) = self.root_between(from, to, target)?
                    && !found.roots.iter().any(|(known, _)| (known - root).abs() < SAME_ROOT)
                {
                    found.roots.push((root, branch));
                }
            }
            found.samples.push((to, next));
            found.scanned = to;
        }
        Ok(found)
    }

    /// The root of `eta(lambda) = target` in an interval at whose ends the difference has two signs.
    fn root_between(&self, lower: f64, upper: f64, target: f64) -> Result<Option<f64>, Refusal> {
        let solver = Toms748Root::new(lower, upper).with_absolute_position_tolerance(ROOT_SHARE * self.tolerance);
        match solver.solve(|lambda| self.friction(lambda).map(|eta| eta - target)) {
            // A sign change may also be a pole, where the system for q is singular.
            Ok(root) => Ok((root.value().abs() < POLE * target.abs()).then_some(root.root())),
            Err(RootError::Evaluation(refusal)) => Err(refusal),
            Err(_) => Ok(None),
        }
    }
}
