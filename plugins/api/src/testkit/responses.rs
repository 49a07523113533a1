//! What every flexibility promises of a layer's response: against its differential equation, in small steps.

use crate::contract::{self, ensure};
use crate::{
    Base, Flexibility, LayerModel, LayerResponse, Material, Moduli, ModulusLaw, Plane, Poisson, Positive, Solid,
    SurfaceFlexibility,
};
use std::sync::Arc;

/// Steps through the layer. Their error goes with the fourth power of the shortest wave's, `MOST/STEPS`.
const STEPS: u32 = 2000;
/// Wave numbers, evenly spaced in their logarithms from `LEAST` to `MOST`, in units of `1/h`.
const WAVE_NUMBERS: u32 = 121;
const LEAST: f64 = 0.01;
const MOST: f64 = 40.0;
/// Largest difference allowed. That of the steps is below 1e-8 (`the_steps_are_fine_enough`).
const WITHIN: f64 = 1e-6;
/// Largest difference of one wave number alone and among others: these may share what they have in common.
const ALIKE: f64 = 1e-9;

/// Its responses to a few layers, of which it may refuse all but one, are those of their differential equation.
pub(super) fn flexibility(config: &dyn Flexibility) -> Result<(), String> {
    let mut served = 0;
    for (name, layer) in layers() {
        let layer = Arc::new(layer);
        let Ok(response) = config.respond(&layer) else { continue };
        served += 1;
        response_of(&layer, &*response).map_err(|fault| format!("{name}: {fault}"))?;
    }
    ensure(served > 0, || {
        let names: Vec<_> = layers().into_iter().map(|(name, _)| name).collect();
        format!("it refuses all layers that it is tried on: {}", names.join(", "))
    })
}

/// Layers on which a flexibility is tried.
fn layers() -> [(&'static str, LayerModel); 5] {
    let shear = Positive::new(3.0).expect("a positive constant");
    let [poisson, below] = [0.3, 0.4].map(|nu| Poisson::new(nu).expect("a ratio in range"));
    let solid = Solid { plane: Plane::Strain, poisson, moduli: Moduli::Shear };
    let half_plane = Base::HalfPlane { shear, poisson: below };
    let exponential = |gamma, base| LayerModel::new(Box::new(Exponential(gamma)), solid, base);
    [
        ("a homogeneous layer on a rigid base", exponential(0.0, Base::Rigid)),
        ("exp(1.5 y) on a rigid base", exponential(1.5, Base::Rigid)),
        ("exp(-1.5 y) on a half-plane", exponential(-1.5, half_plane)),
        ("1 + 2 y on a rigid base", LayerModel::new(Box::new(Linear(2.0)), solid, Base::Rigid)),
        ("exp(1.5 y) without a base", exponential(1.5, Base::Infinite)),
    ]
}

/// `exp(gamma y)`.
#[derive(Debug)]
struct Exponential(f64);

impl ModulusLaw for Exponential {
    fn modulus(&self, depth: f64) -> f64 {
        (self.0 * depth).exp()
    }

    fn exponent(&self) -> Option<f64> {
        Some(self.0)
    }
}

/// `1 + slope y`.
#[derive(Debug)]
struct Linear(f64);

impl ModulusLaw for Linear {
    fn modulus(&self, depth: f64) -> f64 {
        1.0 + self.0 * depth
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        [1.0, self.0].into_iter().chain(std::iter::repeat(0.0)).take(terms).collect()
    }
}

/// What one response says of one layer.
fn response_of(layer: &LayerModel, response: &dyn LayerResponse) -> Result<(), String> {
    contract::response(response)?;
    let elastic = response.elastic();
    ensure((elastic.kappa - layer.elastic.kappa).abs() < ALIKE, || {
        format!("elastic() is {elastic:?}, the surface's is {:?}", layer.elastic)
    })?;
    let all: Vec<f64> = (0..WAVE_NUMBERS).map(wave_number).collect();
    // The highest may be refused, as by a method that overflows there.
    let told: Vec<_> = all.iter().map_while(|s| Some((*s, response.surface(*s).ok()?))).collect();
    ensure(told.len() > all.len() / 2, || match response.surface(all[told.len()]) {
        Err(refusal) => format!("surface({}) is refused: {refusal}", all[told.len()]),
        Ok(_) => "surface() is refused now and then".into(),
    })?;
    for (s, found) in &told {
        // The equations of a solid without end have no place to begin.
        if layer.base != Base::Infinite {
            let expected = marched(layer, *s);
            ensure(apart(*found, expected) < WITHIN, || format!("surface({s}) = {found:?}, but it is {expected:?}"))?;
        }
    }
    let (wave_numbers, alone): (Vec<_>, Vec<_>) = told.into_iter().unzip();
    let mut together = vec![SurfaceFlexibility::default(); wave_numbers.len()];
    response.surface_into(&wave_numbers, &mut together).map_err(|e| format!("surface_into() is refused: {e}"))?;
    let pairs = wave_numbers.iter().zip(alone.iter().zip(&together));
    for (s, (alone, together)) in pairs {
        ensure(apart(*together, *alone) < ALIKE, || {
            format!("surface_into() has {together:?} at {s}, but surface() {alone:?}")
        })?;
    }
    tail(response, (*wave_numbers.last().expect("more than one"), *alone.last().expect("as many")))
}

/// The `i`-th wave number.
fn wave_number(i: u32) -> f64 {
    LEAST * (MOST / LEAST).powf(f64::from(i) / f64::from(WAVE_NUMBERS - 1))
}

/// The series in `1/s`, where there is one, tells a short wave as well as the terms of these laws let it.
fn tail(response: &dyn LayerResponse, (s, found): (f64, SurfaceFlexibility)) -> Result<(), String> {
    const TERMS: usize = 8;
    /// Of these laws each coefficient is less than this to the power of its place: of `1 + 2 y` the ninth is 1.7e6.
    const GROWTH: f64 = 5.5;
    let terms = response.tail(TERMS);
    ensure(terms.len() <= TERMS, || format!("tail({TERMS}) has {} terms", terms.len()))?;
    if terms.is_empty() {
        return Ok(());
    }
    let limit = SurfaceFlexibility { vv: 1.0, uu: 1.0, uv: -response.elastic().beta() };
    let sum = terms.iter().rev().fold(SurfaceFlexibility::default(), |rest, term| SurfaceFlexibility {
        vv: (term.vv + rest.vv) / s,
        uu: (term.uu + rest.uu) / s,
        uv: (term.uv + rest.uv) / s,
    });
    let told = SurfaceFlexibility { vv: limit.vv + sum.vv, uu: limit.uu + sum.uu, uv: limit.uv + sum.uv };
    // What the base adds to it.
    let of_base = response.depth().map_or(0.0, |depth| (1.0 + s) * (-2.0 * s * depth).exp());
    #[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap)] // four
    let left = (GROWTH / s).powi(terms.len() as i32 + 1) + of_base + ALIKE;
    ensure(apart(told, found) < left, || {
        format!("the limit and tail() give {told:?} at s = {s}, but surface() is {found:?}")
    })
}

/// Largest difference, `uv` by the scale `sqrt(vv uu)` that bounds it; infinite where one is no number.
fn apart(found: SurfaceFlexibility, expected: SurfaceFlexibility) -> f64 {
    let SurfaceFlexibility { vv, uu, .. } = expected;
    let each = [(found.vv - vv) / vv, (found.uu - uu) / uu, (found.uv - expected.uv) / (vv * uu).sqrt()];
    each.into_iter().map(|part| if part.is_nan() { f64::INFINITY } else { part.abs() }).fold(0.0, f64::max)
}

/// `s F/A0` of a layer on a base that has a compliance, by steps of Runge and Kutta from the base up (theory.md section
/// 2).
fn marched(layer: &LayerModel, s: f64) -> SurfaceFlexibility {
    let mut compliance = layer.substrate().map_or([0.0; 3], |Material { shear, elastic }| {
        let of_half_plane = -elastic.a0() / (shear * s);
        [of_half_plane, -elastic.beta() * of_half_plane, of_half_plane]
    });
    let step = -1.0 / f64::from(STEPS);
    let ahead = |from: [f64; 3], slope: [f64; 3], by: f64| -> [f64; 3] { [0, 1, 2].map(|i| from[i] + by * slope[i]) };
    for i in (0..STEPS).rev() {
        let [top, middle, bottom] = [0.0, 0.5, 1.0].map(|part| (f64::from(i) + part) / f64::from(STEPS));
        let first = slope(layer, s, bottom, compliance);
        let second = slope(layer, s, middle, ahead(compliance, first, 0.5 * step));
        let third = slope(layer, s, middle, ahead(compliance, second, 0.5 * step));
        let fourth = slope(layer, s, top, ahead(compliance, third, step));
        let mean = [0, 1, 2].map(|i| (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]) / 6.0);
        compliance = ahead(compliance, mean, step);
    }
    let [uu, uv, vv] = compliance.map(|entry| -s * entry / layer.elastic.a0());
    SurfaceFlexibility { vv, uu, uv }
}

/// `dC/dy = B + A C + C A^T - C D C` of the entries `uu`, `uv`, `vv`.
fn slope(layer: &LayerModel, s: f64, depth: f64, [uu, uv, vv]: [f64; 3]) -> [f64; 3] {
    let Material { shear, elastic } = layer.material(&*layer.law, depth);
    let kappa = elastic.kappa;
    let (lambda, stiffness) = ((3.0 - kappa) / (1.0 + kappa), 8.0 * shear * s * s / (1.0 + kappa));
    [
        1.0 / shear + 2.0 * s * uv - stiffness * uu * uu,
        s * (vv - lambda * uu) - stiffness * uu * uv,
        elastic.beta() / shear - 2.0 * s * lambda * uv - stiffness * uv * uv,
    ]
}

#[cfg(test)]
mod tests;
