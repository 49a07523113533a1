//! How wide a growing contact becomes under a load.

use super::layer::Layer;
use super::normal::{Pressure, smooth_punch};
use super::problem::{LoadInLayerUnits, Problem};
use basin::{RootError, Toms748Root};
use slipzone_api::Refusal;
use std::f64::consts::{FRAC_PI_2, LN_2};

/// Steps of the walk towards a sign change; each is at least a factor of 2 at the coarsest resolution.
const MOST_STEPS: u32 = 200;
/// A step this small ends the walk where a contact cannot be solved.
const SMALLEST_STEP: f64 = 0.1;
/// First half-width tried on a layer: wider ones cost more, and the walk gets there when it must.
const WIDEST_START: f64 = 2.0;

/// An excess this small is one of rounding, of the kernel tables included.
const ROUNDING: f64 = 1e-11;

/// The pressure under a punch whose contact grows, at the load of the problem.
///
/// `known`: the half-width at a coarser resolution, where there was one.
pub(crate) fn pressed(layer: &mut Layer, known: Option<f64>) -> Result<Pressure, Refusal> {
    let target = match layer.problem.load {
        LoadInLayerUnits::HalfWidth(b) => return smooth_punch(layer, b),
        LoadInLayerUnits::Force(target) | LoadInLayerUnits::Indentation(target) => target,
    };
    let by_force = matches!(layer.problem.load, LoadInLayerUnits::Force(_));
    let (start, step) = match known {
        Some(b) => (b, 0.01),
        None if layer.has_depth() => (half_plane_size(layer.problem, target, by_force).min(WIDEST_START), LN_2),
        None => (half_plane_size(layer.problem, target, by_force), LN_2),
    };
    // One table for the walk's first steps: a wider one would differ in its last bits.
    layer.reach(start * step.exp())?;
    // ln(reached/target) is nearly linear in ln b for any punch.
    let mut excess = |log_b: f64| -> Result<f64, Refusal> {
        let pressure = smooth_punch(layer, log_b.exp())?;
        let reached = if by_force { Some(pressure.force) } else { pressure.depth(layer) };
        match reached {
            Some(reached) if reached > 0.0 => Ok((reached / target).ln()),
            _ => Err(no_size(format!(
                "at this resolution a contact of half-width {:.3e} h bears no load: it is too wide beside the layer for \
                 the nodes, or the cutoff too small",
                log_b.exp()
            ))),
        }
    };
    let (lower, upper) = bracket(&mut excess, start.ln(), step)?;
    let log_b = match Toms748Root::new(lower, upper).with_absolute_position_tolerance(1e-14).solve(&mut excess) {
        Ok(root) => root.root(),
        // The walk widens the kernel tables, which changes last bits: a root at one end may lose its sign.
        Err(RootError::NotBracketed { lower, f_lower, .. }) if f_lower.abs() < ROUNDING => lower,
        Err(RootError::NotBracketed { upper, f_upper, .. }) if f_upper.abs() < ROUNDING => upper,
        Err(RootError::Evaluation(refusal)) => return Err(refusal),
        Err(other) => return Err(no_size(other.to_string())),
    };
    smooth_punch(layer, log_b.exp())
}

/// Walks from `start` towards the sign change of an increasing function, in growing steps.
fn bracket(
    excess: &mut impl FnMut(f64) -> Result<f64, Refusal>,
    start: f64,
    mut step: f64,
) -> Result<(f64, f64), Refusal> {
    let from = excess(start)?;
    let direction = if from > 0.0 { -1.0 } else { 1.0 };
    let (mut here, mut growth) = (start, 2.0);
    for _ in 0..MOST_STEPS {
        let next = here + direction * step;
        match excess(next) {
            Ok(excess) if excess * direction >= 0.0 => return Ok((here.min(next), here.max(next))),
            Ok(_) => {
                here = next;
                step = (growth * step).min(2.0 * LN_2);
            }
            Err(refusal) if step < SMALLEST_STEP => return Err(refusal),
            // Beyond what this resolution can solve; the load may be borne before.
            Err(_) => {
                step *= 0.5;
                growth = 1.0;
            }
        }
    }
    Err(no_size(format!("no half-width between {:.3e} h and {:.3e} h bears the load", start.exp(), here.exp())))
}

/// The half-width on a half-plane, within a factor of 2; exact formulas for the cylinder
/// (`P = pi b g'(b)/(2 A0)`), and of the right size for other convex shapes.
fn half_plane_size(problem: &Problem, target: f64, by_force: bool) -> f64 {
    let reached = |b: f64| {
        if by_force { FRAC_PI_2 * b * problem.slope(b) / problem.elastic.a0() } else { 2.0 * problem.height(b) }
    };
    let mut b = problem.natural_length();
    // Each loop ends: b leaves the range of floating point numbers after 2100 steps at the latest.
    while reached(b) > target && b > f64::MIN_POSITIVE {
        b *= 0.5;
    }
    while reached(b) < target && b < f64::MAX / 4.0 {
        b *= 2.0;
    }
    b
}

fn no_size(why: String) -> Refusal {
    Refusal::OutOfReach { method: "contact size", why, remedy: "check the load against the punch and the layer" }
}
