//! What every kernel strategy promises of its tables: against kernels that are known in closed form.

use crate::contract::{self, ensure};
use crate::{
    Component, Elastic, KernelRequest, KernelStrategy, KernelTable, LayerResponse, Plane, Refusal, SurfaceFlexibility,
};
use std::f64::consts::FRAC_PI_2;

/// The kernels that are asked for.
const COMPONENTS: [Component; 4] =
    [Component::Depth, Component::NormalSlope, Component::ShearStrain, Component::Coupling];
/// What is asked of their errors.
const ACCURACY: f64 = 1e-9;
/// Where they are looked at, over the reach; a strategy without a bound only from the last few on.
const DISTANCES: [f64; 8] = [1e-6, 1e-3, 0.03, 0.1, 0.3, 0.55, 0.8, 1.0];
const UNBOUNDED: usize = 3;
/// How many times its bound an error may be: bounds are estimates.
const BOUNDS: f64 = 3.0;
/// Nearer than this over the reach an error counts by how near it is: it is felt over no more than that.
const NEAR: f64 = 0.03;
/// What rounding leaves.
const ROUNDING: f64 = 1e-12;
/// Finer by so many levels, a strategy without a bound is to be off by less than this part of what it was.
const FINER: (u32, f64) = (2, 0.7);

/// Its tables of a few flexibilities, of which it may refuse all but one, are the transforms of these.
pub(super) fn kernel(config: &dyn KernelStrategy) -> Result<(), String> {
    let mut served = 0;
    for (name, known, reach) in [
        ("graded, wide", Known::GRADED, 4.0),
        ("graded, narrow", Known::GRADED, 0.25),
        ("homogeneous, wide", Known::HOMOGENEOUS, 4.0),
        ("homogeneous, narrow", Known::HOMOGENEOUS, 0.25),
    ] {
        let request = KernelRequest { reach, components: &COMPONENTS, accuracy: ACCURACY };
        let tabulated = config.serves(&known).and_then(|()| config.tabulate(&known, &request));
        let Ok(table) = tabulated else { continue };
        served += 1;
        table_of(config, (&known, &*table), &request).map_err(|fault| format!("a surface that is {name}: {fault}"))?;
    }
    ensure(served > 0, || "it refuses all flexibilities that it is tried on".into())
}

/// What one table says of one flexibility.
fn table_of(
    config: &dyn KernelStrategy,
    (known, table): (&Known, &dyn KernelTable),
    request: &KernelRequest,
) -> Result<(), String> {
    contract::table(table)?;
    let distances = DISTANCES.map(|share| share * request.reach);
    for component in COMPONENTS {
        agreeing(table, component, &distances)?;
    }
    if let Some(error) = table.error() {
        let (worst, what) = off(known, table, &distances, request.reach);
        return ensure(worst <= BOUNDS * error + ROUNDING, || {
            format!("{what} is off by {worst:e} over the reach, where error() = {error:e}")
        });
    }
    let (level, share) = FINER;
    let finer =
        config.refined(level).tabulate(known, request).map_err(|e| format!("refined({level}) is refused: {e}"))?;
    let [(coarse, _), (fine, what)] =
        [table, &*finer].map(|table| off(known, table, &distances[UNBOUNDED..], request.reach));
    ensure(fine <= share * coarse + ACCURACY, || {
        format!("{what} is off by {fine:e} over the reach by refined({level}), and without by {coarse:e}")
    })
}

/// A table's methods tell the same, and of either sign what the kernel's parity says.
fn agreeing(table: &dyn KernelTable, component: Component, distances: &[f64]) -> Result<(), String> {
    let mut values = vec![f64::NAN; distances.len()];
    table.values_into(component, distances, &mut values);
    for (t, value) in distances.iter().zip(values) {
        let of_parts = table.parts(component, *t).value(*t);
        let mirrored = if component.is_odd() { -1.0 } else { 1.0 } * table.parts(component, -t).value(-t);
        for (other, name) in [(of_parts, "parts"), (mirrored, "the distance's mirror image")] {
            ensure((other - value).abs() <= ROUNDING * (1.0 + value.abs()), || {
                format!("{component:?} at {t}: values_into() has {value}, but by {name} it is {other}")
            })?;
        }
    }
    Ok(())
}

/// The largest error in the terms of [`KernelRequest::accuracy`], infinite where there is no number, and what has it.
fn off(known: &Known, table: &dyn KernelTable, distances: &[f64], reach: f64) -> (f64, String) {
    let each = COMPONENTS.into_iter().flat_map(|component| distances.iter().map(move |t| (component, *t)));
    let errors = each.map(|(component, t)| {
        let scale = if component == Component::Depth { 1.0 } else { reach } * (t / (NEAR * reach)).min(1.0);
        let error = scale * (table.parts(component, t).value(t) - known.kernel(component, t)).abs();
        (if error.is_nan() { f64::INFINITY } else { error }, format!("{component:?} at {t}"))
    });
    errors.reduce(|worst, next| if next.0 > worst.0 { next } else { worst }).expect("some distances")
}

/// A flexibility whose kernels are elementary: `vv = 1 - e + g s/(1 + s^2)`, `uu = 1 - (1 + s) e + g s/(1 + s^2)`,
/// `uv = -beta (1 - e) + c [1/(1 + s^2) - e]` with `e = exp(-2 s)`.
struct Known {
    /// `g`: the kernels' jump.
    jump: f64,
    /// `c`.
    coupled: f64,
}

impl Known {
    const HOMOGENEOUS: Self = Self { jump: 0.0, coupled: 0.0 };
    const GRADED: Self = Self { jump: 0.4, coupled: 0.1 };

    /// The kernel at `t > 0`.
    fn kernel(&self, component: Component, t: f64) -> f64 {
        let (square, fading) = (4.0 + t * t, FRAC_PI_2 * (-t).exp());
        match component {
            Component::Depth => 0.5 * (4.0 / (t * t)).ln_1p() + self.jump * fading,
            Component::NormalSlope => self.jump * fading - t / square,
            Component::ShearStrain => self.jump * fading - t / square - 4.0 * t / (square * square),
            Component::Coupling => 2.0 * (self.elastic().beta() - self.coupled) / square + self.coupled * fading,
        }
    }
}

impl LayerResponse for Known {
    fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        let (left, gone, algebraic) = ((-2.0 * s).exp(), -(-2.0 * s).exp_m1(), (1.0 + s * s).recip());
        Ok(SurfaceFlexibility {
            vv: gone + self.jump * s * algebraic,
            uu: gone - s * left + self.jump * s * algebraic,
            uv: self.coupled * (algebraic - left) - self.elastic().beta() * gone,
        })
    }

    fn elastic(&self) -> Elastic {
        Elastic::of(Plane::Strain, 0.3)
    }

    /// As far as kernels can tell.
    fn is_homogeneous(&self) -> bool {
        self.jump == 0.0
    }

    /// Of `s/(1 + s^2)` and `1/(1 + s^2)`.
    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        let term = |k: usize| {
            let sign = if ((k - 1) / 2).is_multiple_of(2) { 1.0 } else { -1.0 };
            let slope = if k % 2 == 1 { sign * self.jump } else { 0.0 };
            let coupling = if k.is_multiple_of(2) { sign * self.coupled } else { 0.0 };
            SurfaceFlexibility { vv: slope, uu: slope, uv: coupling }
        };
        (1..=terms).map(term).collect()
    }

    fn depth(&self) -> Option<f64> {
        Some(1.0)
    }
}

#[cfg(test)]
mod tests;
