//! The shear all along the stick zone, as sure as the rest.
//!
//! How wide the zone is follows from integrals of the shear, and is known far better than the shear itself. Where that is asked
//! for, the tangential equation is solved on finer grids in the zone found, and nothing else is (docs/theory.md, "Error
//! estimate").

use super::error_estimate::{FASTEST_SHARPENED, SAFETY, SLIP_ROUNDING, apart, of_traces};
use super::layer::Layer;
use super::normal::Normal;
use super::quantity::ShearTrace;
use super::stick::Shear;
use super::stick_zone::StickZone;
use slipzone_api::{Refusal, Station};

/// Points of the stick zone at which two grids are compared; how far the first is from its end, over the half-width; how far the
/// last, over the width of the slip zone, for that is how fast the shear varies there.
const POINTS: usize = 12;
const FIRST: f64 = 0.7;
const LAST: f64 = 0.5;
/// Most grids.
const MOST_STEPS: u32 = 6;

/// Solves the shear of a zone on finer grids until it is known to the tolerance, from that of one near it that was solved last, and
/// leaves the last of them; its error where the relative error of the pressure is `of_pressure`. `None` where there is no finer grid.
/// Where that of a coarser resolution shows that it is known already, nothing is solved.
///
/// It is relative to the largest shear; what is nearer than [`StickZone::NEAR`] to the contact's edge is left out of both.
pub(crate) fn sharpen(
    (shear, coarser): (&mut Shear, Option<&Shear>),
    layer: &Layer,
    normal: &mut Normal,
    beta: f64,
    zone: StickZone,
    (of_pressure, tolerance): (f64, f64),
) -> Result<Option<f64>, Refusal> {
    let points = points(zone);
    let mut before = sampled(shear, &points);
    let largest = largest(shear, normal, zone, &before);
    // The shear is driven by `beta p`.
    let driven = of_pressure * (beta * normal.mean() / largest).abs();
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
    for step in 1..=MOST_STEPS {
        if is_done || !shear.refine(layer, normal, beta, (zone, step))? {
            break;
        }
        let now = sampled(shear, &points);
        let late = apart(&now, &before, largest);
        let (along, between) = (of_traces((earlier, late), FASTEST_SHARPENED), between(shear));
        (shear.along, is_done) = (Some(along.max(between)), is_known(along, between));
        (before, earlier) = (now, late);
    }
    Ok(shear.along.map(|along| along.max(driven)))
}

/// By how much a shear differs from that of a twin in a zone that is nearly its own, over the largest shear as [`sharpen`] has it.
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
