//! Layers whose law is known only by its values: thin slices, refined until they no longer matter.

use crate::slice::{Slice, generator};
use crate::surface_tail;
use nalgebra::Matrix2;
use slipzone_api::{Elastic, LayerModel, LayerResponse, Refusal, SurfaceFlexibility};
use std::sync::Arc;

/// Largest `s delta` of the coarsest slices; the series in [`Slice::thin`] need not be exact on these.
const THIN: f64 = 0.5;

/// Coarsest number of slices between two breakpoints.
const FEWEST: usize = 4;

/// Change, relative to the value, that ends the refinement; what is left then is smaller by 1e3 or more.
const TOLERANCE: f64 = 3e-11;

/// Most slices in one pass: some milliseconds of work.
const MOST: usize = 1 << 14;

/// Depths at which the law is probed for its extremes, in each stretch between breakpoints.
const PROBES: u32 = 64;

/// A base is forgotten where `exp(-2 s y)` times the contrast of moduli, and times the square of the
/// polynomial that goes with it (below `exp(9)` there), drops under `exp(-39) = 1e-17`.
const FORGOTTEN: f64 = 48.0;

/// Any law on a rigid base.
///
/// The compliance is carried upwards slice by slice. A slice uses the law at its two Gauss points
/// (fourth-order Magnus expansion: S. Blanes, F. Casas, J. A. Oteo, J. Ros, Physics Reports 470 (2009)
/// 151-238, section 5), so breakpoints are never touched. The error is a series in even powers of the
/// thickness, from the fourth on: halving all slices and extrapolating removes one power after another.
#[derive(Debug)]
pub(crate) struct General {
    layer: Arc<LayerModel>,
    /// The surface modulus.
    unit: f64,
    /// 0, the breakpoints, 1.
    stretches: Vec<f64>,
    /// `ln(max mu/min mu)`.
    contrast: f64,
}

impl General {
    pub(crate) fn new(layer: Arc<LayerModel>) -> Self {
        let law = layer.law.as_ref();
        let inside = law.breakpoints().iter().copied().filter(|&y| y > 0.0 && y < 1.0);
        let stretches: Vec<f64> = [0.0].into_iter().chain(inside).chain([1.0]).collect();
        let (least, most) = stretches
            .windows(2)
            .flat_map(|y| (0..PROBES).map(move |k| y[0] + (y[1] - y[0]) * (f64::from(k) + 0.5) / f64::from(PROBES)))
            .map(|y| law.modulus(y).ln())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), mu| (least.min(mu), most.max(mu)));
        // Of a law without numbers nothing is left but the bound on the work.
        let contrast = (most - least).max(0.0);
        let unit = law.surface_modulus();
        Self { layer, unit, stretches, contrast }
    }

    /// Modulus in units of the surface modulus.
    fn modulus(&self, depth: f64) -> f64 {
        self.layer.law.modulus(depth) / self.unit
    }

    /// Compliance at the surface in units of `1/mu1`, `level` halvings after the coarsest slices; `None`
    /// when that takes too many of them.
    fn march(&self, s: f64, reach: f64, level: u32) -> Option<Matrix2<f64>> {
        let mut compliance = if reach < 1.0 {
            // The base is out of sight; any start does, the local half-plane least harm.
            surface_tail::half_plane_compliance(self.layer.elastic) / (s * self.modulus(reach))
        } else {
            Matrix2::zeros()
        };
        for stretch in self.stretches.windows(2).rev().filter(|stretch| stretch[0] < reach) {
            let (top, bottom) = (stretch[0], stretch[1].min(reach));
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // saturates, and is refused then
            let coarsest = ((s * (bottom - top) / THIN).ceil() as usize).max(FEWEST);
            let count = coarsest.saturating_mul(1_usize.checked_shl(level)?);
            if count > MOST {
                return None;
            }
            let delta = (bottom - top) / count as f64;
            for k in (0..count).rev() {
                compliance = self.through(s, top + (k as f64 + 0.5) * delta, delta, compliance);
            }
        }
        Some(compliance)
    }

    /// From the bottom to the top of the slice of thickness `delta` around `middle`.
    fn through(&self, s: f64, middle: f64, delta: f64, below: Matrix2<f64>) -> Matrix2<f64> {
        let offset = delta / 12.0_f64.sqrt();
        let (upper, lower) = (self.modulus(middle - offset), self.modulus(middle + offset));
        // Depths in units of delta, stresses in units of a modulus within the slice.
        let unit = (upper * lower).sqrt();
        let at = |modulus: f64| generator(self.layer.elastic, s * delta, 0.0, modulus / unit);
        let (upper, lower) = (at(upper), at(lower));
        let magnus = (upper + lower) / 2.0 + (lower * upper - upper * lower) * (3.0_f64.sqrt() / 12.0);
        let scale = delta / unit;
        Slice::thin(&magnus, 1.0).over(&(below / scale)) * scale
    }
}

/// Removes the error of order `delta^order` from the results for `delta` and `delta/2`.
fn extrapolated(finer: SurfaceFlexibility, coarser: SurfaceFlexibility, order: i32) -> SurfaceFlexibility {
    let weight = 1.0 / (f64::powi(2.0, order) - 1.0);
    let one = |finer: f64, coarser: f64| finer + (finer - coarser) * weight;
    SurfaceFlexibility { vv: one(finer.vv, coarser.vv), uu: one(finer.uu, coarser.uu), uv: one(finer.uv, coarser.uv) }
}

/// Whether two results differ by round-off only; `uv` is bounded by `sqrt(vv uu)` and may be 0.
fn agree(x: SurfaceFlexibility, y: SurfaceFlexibility) -> bool {
    (x.vv - y.vv).abs() <= TOLERANCE * y.vv
        && (x.uu - y.uu).abs() <= TOLERANCE * y.uu
        && (x.uv - y.uv).abs() <= TOLERANCE * (y.vv * y.uu).sqrt()
}

impl LayerResponse for General {
    fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        let reach = (0.5 * (FORGOTTEN + self.contrast) / s).min(1.0);
        // Neville's table of the compliances over slices of thickness delta, delta/2, delta/4, ...
        let mut row: Vec<SurfaceFlexibility> = Vec::new();
        for level in 0.. {
            let Some(compliance) = self.march(s, reach, level) else { break };
            let mut finer = surface_tail::scaled(&compliance, s, self.layer.elastic);
            let last = row.last().copied();
            let mut order = 4;
            for coarser in &mut row {
                let next = extrapolated(finer, *coarser, order);
                *coarser = finer;
                finer = next;
                order += 2;
            }
            row.push(finer);
            if last.is_some_and(|last| agree(last, finer)) {
                return Ok(finer);
            }
        }
        Err(Refusal::OutOfReach {
            method: "compliance",
            why: format!("the law varies too fast for {MOST} slices at wave number s = {s:.6e}/h"),
            remedy: "give the law's kinks and jumps as breakpoints, or smooth it",
        })
    }

    fn elastic(&self) -> Elastic {
        self.layer.elastic
    }

    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        surface_tail::smooth(self.layer.elastic, &self.layer.law.surface_series(terms + 1), terms)
    }

    fn depth(&self) -> Option<f64> {
        Some(self.stretches[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Compliance;
    use crate::fixtures::{Opaque, at, bonded, distance, exponential};
    use slipzone_api::{Flexibility, Plane};

    type Law = fn(f64) -> f64;

    fn general(modulus: Law, breakpoints: &'static [f64], nu: f64) -> Arc<LayerModel> {
        bonded(Opaque { modulus, breakpoints }, Plane::Strain, nu)
    }

    #[test]
    fn agrees_with_the_exponential_law_in_disguise() {
        let disguises: [(f64, Law); 5] = [
            (0.0, |_| 3.0),
            (2.0, |y| 5.0 * (2.0 * y).exp()),
            (-2.0, |y| (-2.0 * y).exp()),
            (13.8, |y| (13.8 * y).exp()),
            (-13.8, |y| (-13.8 * y).exp()),
        ];
        for (gamma, modulus) in disguises {
            for nu in [-0.9, 0.3, 0.5] {
                for s in [1e-6, 0.01, 1.0, 12.0, 40.0, 700.0, 1e5] {
                    let (open, disguised) = (exponential(gamma, nu), general(modulus, &[], nu));
                    let difference = distance(at(&Compliance {}, &disguised, s), at(&Compliance {}, &open, s));
                    // Extrapolation ends near round-off; 1e-13 of `exponential` at 13.8 comes on top.
                    assert!(difference < 3e-13, "gamma = {gamma}, nu = {nu}, s = {s}: {difference:e}");
                }
            }
        }
    }

    /// `nu = 0.3`, plane strain, `[vv, uu, uv]` at `s = 0.01, 1, 20`, by mpmath with 60 digits: the propagator as a
    /// product of `expm` of the two layers, and of 8 steps of the Taylor series of `z' = K(y) z` to order 40.
    #[allow(clippy::excessive_precision, clippy::unreadable_literal)] // as they were computed
    const TWO_LAYERS: [[f64; 3]; 3] = [
        [0.0014030652669467727143, 0.0049105789710694541855, 1.8333248922619624069e-6],
        [0.14173485284160875022, 0.40772625291107262004, 0.0061087460323505935931],
        [0.99745009365220761592, 0.99827378205122040048, -0.28361741038994007546],
    ];
    #[allow(clippy::excessive_precision, clippy::unreadable_literal)]
    const POWER_LAW: [[f64; 3]; 3] = [
        [0.0027211041091330635755, 0.009523168317859985147, 5.8872948572039376961e-6],
        [0.27732038640847239493, 0.61234724590284362674, 0.0074743399384353587663],
        [0.94274079590762698323, 0.97593453547825306552, -0.26227116594969684214],
    ];

    #[test]
    fn golden_values_of_a_stack_and_a_power_law() {
        let stack = general(|y| if y < 0.25 { 1.0 } else { 8.0 }, &[0.25], 0.3);
        let power = general(|y| (1.0 + y / 2.0).powi(2), &[], 0.3);
        assert_eq!(Compliance {}.respond(&stack).unwrap().depth(), Some(0.25));
        for (layer, golden) in [(stack, TWO_LAYERS), (power, POWER_LAW)] {
            for (s, [vv, uu, uv]) in [0.01, 1.0, 20.0].into_iter().zip(golden) {
                let difference = distance(at(&Compliance {}, &layer, s), SurfaceFlexibility { vv, uu, uv });
                // Round-off of a few hundred slices.
                assert!(difference < 1e-13, "s = {s}: {difference:e}");
            }
        }
    }

    #[test]
    fn a_steep_but_smooth_law_is_resolved() {
        // Steps up by a factor of 4 within 2 % of the depth, without a breakpoint: with and without one in
        // the middle of the step the slices differ, the result must not.
        let step = |y: f64| 5.0 + 3.0 * ((y - 0.37) / 0.01).tanh();
        let (plain, split) = (general(step, &[], 0.3), general(step, &[0.37], 0.3));
        for s in [1e-3, 1.0, 10.0, 100.0] {
            let difference = distance(at(&Compliance {}, &plain, s), at(&Compliance {}, &split, s));
            assert!(difference < 1e-11, "s = {s}: {difference:e}"); // TOLERANCE
        }
    }

    #[test]
    fn work_is_bounded() {
        // Noise, a kink that is not told, no numbers at all.
        let laws: [Law; 3] = [|y| 2.0 + (1e7 * y).sin(), |y| 1.0 + (y - 0.3).abs(), |_| f64::NAN];
        for modulus in laws {
            let layer = general(modulus, &[], 0.3);
            let mut out = [SurfaceFlexibility::default()];
            let refusal = Compliance {}.respond(&layer).unwrap().surface_into(&[1.0], &mut out);
            assert!(matches!(refusal, Err(Refusal::OutOfReach { .. })), "{refusal:?}");
        }
    }
}
