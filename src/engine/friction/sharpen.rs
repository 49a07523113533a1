//! The shear all along the stick zone, as sure as the rest.
//!
//! How wide the zone is follows from integrals of the shear, and is known far better than the shear itself. Where that
//! is asked for, the tangential equation is solved on finer grids in the zone found, and nothing else is
//! (docs/theory.md, "Error estimate").

use super::stick::Shear;
use super::stick_zone::StickZone;
use crate::engine::accuracy::error_estimate::{FASTEST_SHARPENED, SAFETY, SLIP_ROUNDING, apart, of_traces};
use crate::engine::accuracy::quantity::ShearTrace;
use crate::engine::prepared_layer::PreparedLayer;
use crate::engine::pressure::normal::Normal;
use slipzone_api::{Component, Refusal, Station};

/// Points of the stick zone at which two grids are compared; how far the first is from its end, over the half-width;
/// how far the last, over the width of the slip zone, for that is how fast the shear varies there.
const POINTS: usize = 12;
const FIRST: f64 = 0.7;
const LAST: f64 = 0.5;
/// Most grids.
const MOST_STEPS: u32 = 6;

/// Solves the shear of a zone on finer grids until it is known to the tolerance, from that of one near it that was
/// solved last, and leaves the last of them, or the one after which none would do; its error where the relative error
/// of the pressure is `of_pressure`. `None` where there is no finer grid. Where that of a coarser resolution shows that
/// it is known already, nothing is solved.
///
/// It is relative to the largest shear; what is nearer than [`StickZone::NEAR`] to the contact's edge is left out of
/// both.
pub(crate) fn sharpen(
    (shear, coarser): (&mut Shear, Option<&Shear>),
    layer: &PreparedLayer,
    normal: &mut Normal,
    beta: f64,
    zone: StickZone,
    (of_pressure, tolerance): (f64, f64),
) -> Result<Option<f64>, Refusal> {
    let points = points(zone);
    let mut before = sampled(shear, &points);
    let largest = largest(shear, normal, zone, &before);
    // The shear is driven by `beta p`, and by the potential of the coupling, which no grid of its own sharpens.
    let lost = normal.lost_between_samples(layer, Component::Coupling, shear.coupling()) / largest;
    let driven = of_pressure * (beta * normal.mean() / largest).abs() + SAFETY * lost;
    let enough = tolerance.max(driven).max(SLIP_ROUNDING);
    let between = |shear: &Shear| SAFETY * shear.lost_between() / largest;
    let is_known = |along: f64, between: f64| along.max(between) <= enough;
    let mut is_done = shear.along.is_some_and(|along| along <= enough);
    let mut earlier = 1.0;
    if let Some(coarser) = coarser {
        // Their grids over the slip zone are nearly the same: the finer may be no better than their difference.
        let late = apart(&before, &sampled(coarser, &points), largest);
        if shear.along.is_none() {
            let (along, between) = ((SAFETY * late).max(SLIP_ROUNDING), between(shear));
            is_done = is_known(along, between);
            shear.along = is_done.then_some(along.max(between));
        }
        earlier = late;
    }
    let mut errors = [f64::INFINITY; 2];
    for step in 1..=MOST_STEPS {
        if is_done || !shear.refine(layer, normal, beta, (zone, step))? {
            break;
        }
        let now = sampled(shear, &points);
        let late = apart(&now, &before, largest);
        let (along, between) = (of_traces((earlier, late), FASTEST_SHARPENED), between(shear));
        let error = along.max(between);
        shear.along = Some(error);
        is_done = is_known(along, between) || is_vain(errors[0], error, enough, MOST_STEPS - step);
        (before, earlier, errors) = (now, late, [errors[1], error]);
    }
    Ok(shear.along.map(|along| along.max(driven)))
}

/// Whether the steps left will not bring an error low enough, at the pace of the last two.
fn is_vain(before_last: f64, error: f64, enough: f64, steps_left: u32) -> bool {
    before_last.is_finite() && error * (error / before_last).powf(0.5 * f64::from(steps_left)) > enough
}

/// By how much a shear differs from that of a twin in a zone that is nearly its own, over the largest shear as
/// [`sharpen`] has it.
pub(crate) fn apart_from_twin(shear: &Shear, twin: &Shear, normal: &Normal) -> f64 {
    let points = points(shear.zone);
    let [own, other] = [sampled(shear, &points), sampled(twin, &points)];
    let largest = largest(shear, normal, shear.zone, &own);
    apart(&own, &other, largest)
}

/// What errors of the shear are relative to.
fn largest(shear: &Shear, normal: &Normal, zone: StickZone, sampled: &[f64; POINTS]) -> f64 {
    let end = if zone.is_crowded() { 0.0 } else { shear.at_edge.abs() };
    let least = end.max(ShearTrace::least(shear.friction) * normal.mean().abs());
    sampled.iter().fold(least, |most, q| most.max(q.abs()))
}

/// Points ever nearer to the end of the zone.
fn points(zone: StickZone) -> [Station; POINTS] {
    let (a, slip) = (zone.half_width, zone.slip_width);
    let last = (LAST * slip).max(StickZone::NEAR * zone.contact() - slip).min(FIRST * a);
    let next = (last / (FIRST * a)).powf(1.0 / (POINTS - 1) as f64);
    let mut gap = FIRST * a;
    std::array::from_fn(|_| {
        let station = Station { x: a - gap, gap };
        gap *= next;
        station
    })
}

fn sampled(shear: &Shear, points: &[Station; POINTS]) -> [f64; POINTS] {
    let mut shears = [0.0; POINTS];
    shear.in_stick_into(points, &mut shears);
    shears
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_taken_as_long_as_they_may_reach_what_is_asked_for() {
        // A tenth by each two steps, four left: a hundredth of it.
        assert!(!is_vain(1e-5, 1e-6, 1.1e-8, 4));
        assert!(is_vain(1e-5, 1e-6, 0.9e-8, 4));
        assert!(is_vain(1e-6, 1.1e-6, 1e-6, 2), "what grows reaches nothing");
        assert!(!is_vain(f64::INFINITY, 1.0, 1e-12, 4), "the first two steps tell no pace");
    }
}
