//! One scene at one resolution: pressure, stick zone, and the numbers reported.

use super::checks;
use super::error_estimate::Numbers;
use super::layer::Layer;
use super::normal::{Pressure, SharpPunch};
use super::problem::LoadInLayerUnits;
use super::stick::{Shear, StickZone};
use super::stick_search::{Found, FrictionCurve};
use super::{Slip, contact_size};
use slipzone_api::{Refusal, Station};

/// Resolutions at which the whole friction curve is scanned for roots; finer ones follow those found.
const SCANNED_LEVELS: u32 = 2;
/// Friction below this share of the coefficient at every stick zone is rounding: there is no shear.
const NO_SHEAR: f64 = 1e-10;
/// Nodes on either side of the slip zone's grid: at the coarsest resolution, and added per level.
const SLIP_NODES: (usize, usize) = (24, 8);

/// A solved contact in layer units.
pub(crate) struct Contact {
    pub(crate) pressure: Pressure,
    /// Depth of the punch; `None` on a half-plane.
    indentation: Option<f64>,
    pub(crate) friction: Option<Stick>,
}

/// What friction makes of it.
pub(crate) struct Stick {
    /// The shear traction reported.
    pub(crate) shear: Shear,
    /// How it came about.
    pub(crate) verdict: Verdict,
    /// The roots, for the next resolution.
    pub(crate) found: Found,
}

/// Whether a stick zone was found, and whether it holds.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Verdict {
    /// A root at which both conditions of friction hold.
    Holds,
    /// Roots, but each fails a condition: what the first of them fails, and where.
    Fails(String),
    /// No root; the stick zone is narrower than what was looked for.
    TooNarrow,
    /// No root; the slip zone is narrower than what the resolution can tell.
    TooWide,
    /// No shear arises, whatever the zone: everything sticks without friction.
    NoShear,
    /// No root in between: the direction of slip changes along the contact.
    None,
}

impl Contact {
    /// Solves at one resolution; `coarser` is the same scene at half of it.
    pub(crate) fn solve(
        layer: &mut Layer,
        tolerance: f64,
        level: u32,
        coarser: Option<&Self>,
    ) -> Result<Self, Refusal> {
        let pressure = match layer.problem.fixed_half_width() {
            Some(half_width) => {
                let punch = SharpPunch::new(layer, half_width)?;
                let force = match layer.problem.load {
                    LoadInLayerUnits::Force(force) => force,
                    LoadInLayerUnits::Indentation(depth) => punch.force_at(layer, depth).unwrap_or(f64::NAN),
                    LoadInLayerUnits::HalfWidth(_) => f64::NAN,
                };
                if !(force.is_finite() && force > 0.0) {
                    return Err(Refusal::OutOfReach {
                        method: "load",
                        why: "no pressing force belongs to it under a punch of this width".into(),
                        remedy: "prescribe the force",
                    });
                }
                punch.under(force)
            }
            None => contact_size::pressed(layer, coarser.map(|c| c.pressure.half_width))?,
        };
        let friction = match layer.problem.friction {
            Some(eta) => {
                let coarse = coarser.and_then(|c| c.friction.as_ref()).filter(|_| level >= SCANNED_LEVELS);
                Some(Stick::solve(layer, &pressure, eta, tolerance, level, coarse)?)
            }
            None => None,
        };
        Ok(Self { indentation: pressure.depth(layer), pressure, friction })
    }

    /// The numbers reported, in layer units, by their path in the result.
    pub(crate) fn numbers(&self) -> Numbers {
        let p = &self.pressure;
        let b = p.half_width;
        let mut numbers = Numbers::from([
            ("load.force", p.force),
            ("load.half_width", b),
            ("pressure.centre", p.at(Station { x: 0.0, gap: b })),
            ("pressure.mean", p.force / (2.0 * b)),
            ("edge.stress_intensity", p.edge_factor / b.sqrt()),
            ("edge.ratio", p.edge_factor / p.force),
        ]);
        if let Some(depth) = self.indentation {
            numbers.insert("load.indentation", depth);
        }
        if let Some(peak) = self.peak() {
            numbers.insert("pressure.peak", peak);
        }
        if let Some(stick) = &self.friction {
            let zone = stick.shear.zone;
            numbers.insert("stick.half_width", zone.half_width);
            numbers.insert("stick.ratio", zone.half_width / b);
            numbers.insert("stick.one_minus_ratio", zone.slip_width / b);
        }
        numbers
    }

    /// The largest pressure; `None` where it is unbounded.
    fn peak(&self) -> Option<f64> {
        const SAMPLES: usize = 400;
        if self.pressure.edge_factor > 0.0 {
            return None;
        }
        let b = self.pressure.half_width;
        let step = b / SAMPLES as f64;
        let p = |i: usize| self.pressure.at(Station { x: i as f64 * step, gap: b - i as f64 * step });
        let samples: Vec<f64> = (0..SAMPLES).map(p).collect();
        let (top, _) = samples.iter().enumerate().max_by(|one, other| one.1.total_cmp(other.1))?;
        if top == 0 || top == SAMPLES - 1 {
            return Some(samples[top]);
        }
        // Vertex of the parabola through the highest sample and its neighbours.
        let (left, middle, right) = (samples[top - 1], samples[top], samples[top + 1]);
        let slope = 0.5 * (right - left);
        Some(middle + 0.5 * slope * slope / (2.0 * middle - left - right))
    }

    /// Direction of slip of the shear reported, where there is one to tell.
    pub(crate) fn slip(&self) -> Option<Slip> {
        let stick = self.friction.as_ref()?;
        if matches!(stick.verdict, Verdict::NoShear | Verdict::TooWide) {
            return None; // nothing slips, or too narrow a zone to tell which way
        }
        Some(if stick.shear.friction < 0.0 { Slip::Outward } else { Slip::Inward })
    }
}

impl Stick {
    fn solve(
        layer: &Layer,
        pressure: &Pressure,
        eta: f64,
        tolerance: f64,
        level: u32,
        coarse: Option<&Self>,
    ) -> Result<Self, Refusal> {
        let slip_nodes = SLIP_NODES.0 + SLIP_NODES.1 * level as usize;
        let curve = FrictionCurve { layer, pressure, slip_nodes, tolerance };
        let mut found = match coarse {
            Some(coarse) => curve.follow(eta, &coarse.found)?,
            None => curve.scan(eta)?,
        };
        let mut best = first_that_holds(&curve, &found)?;
        if coarse.is_some() && best.as_ref().is_none_or(|(_, verdict)| *verdict != Verdict::Holds) {
            found = curve.scan_on(eta, found)?;
            best = first_that_holds(&curve, &found)?;
        }
        if let Some((shear, verdict)) = best {
            return Ok(Self { shear, verdict, found });
        }
        if found.samples.iter().all(|(_, friction)| friction.abs() < NO_SHEAR * eta) {
            let all = StickZone { half_width: pressure.half_width, slip_width: 0.0 };
            let shear = curve.shear(0.0)?.rescaled(0.0).over(all);
            return Ok(Self { shear, verdict: Verdict::NoShear, found });
        }
        let (narrow, wide) = (found.samples.first(), found.samples.last());
        let (lambda, verdict) = match (narrow, wide) {
            (Some(narrow), _) if narrow.1.abs() > eta => (narrow.0, Verdict::TooNarrow),
            (_, Some(wide)) if wide.1.abs() < eta => (wide.0, Verdict::TooWide),
            (Some(narrow), _) => (narrow.0, Verdict::None),
            (None, _) => (curve.widest(), Verdict::None),
        };
        let shear = curve.shear(lambda)?;
        let sliding = eta.copysign(shear.friction);
        let shear = match verdict {
            // The narrowest stick zone looked for wants more friction than there is: all but it slides.
            Verdict::TooNarrow => shear.rescaled(sliding),
            // The widest one needs less; what slips beyond it slides at the limit all the same.
            Verdict::TooWide => shear.sliding_at(sliding),
            _ => shear,
        };
        Ok(Self { shear, verdict, found })
    }
}

/// The first root at which friction holds, or else the first root and what it fails; `None` without roots.
fn first_that_holds(curve: &FrictionCurve, found: &Found) -> Result<Option<(Shear, Verdict)>, Refusal> {
    let mut failure = None;
    for &(lambda, _) in &found.roots {
        let shear = curve.shear(lambda)?;
        match violation(curve.layer, curve.pressure, &shear) {
            None => return Ok(Some((shear, Verdict::Holds))),
            Some(what) => failure = failure.or(Some((shear, Verdict::Fails(what)))),
        }
    }
    Ok(failure)
}

/// The condition of friction that a stick zone fails, and where.
fn violation(layer: &Layer, pressure: &Pressure, shear: &Shear) -> Option<String> {
    let direction = if shear.friction < 0.0 { "outward" } else { "inward" };
    let ratio = shear.zone.half_width / pressure.half_width;
    if let Some((x, load)) = checks::overload(pressure, shear) {
        return Some(format!(
            "with {direction} slip and a/b = {ratio:.6}, |q| reaches {load:.3} eta p at x = {x:.4} b inside the stick zone"
        ));
    }
    checks::wrong_slip(layer, pressure, shear).map(|x| {
        format!("with {direction} slip and a/b = {ratio:.6}, the surface slides the other way at x = {x:.4} b")
    })
}
