//! A layer of any law on any base, slice by slice.

use crate::coefficients::Coefficients;
use crate::panels::{Matter, Panel, Panels};
use crate::slice::{Slice, THIN};
use crate::surface_tail;
use nalgebra::Matrix2;
use slipzone_api::{Base, Elastic, LayerModel, LayerResponse, Material, Refusal, SurfaceFlexibility};
use std::sync::Arc;

/// A base is forgotten where `exp(-2 s y)` times the contrast of moduli, and times the square of the
/// polynomial that goes with it (below `exp(9)` there), drops under `exp(-39) = 1e-17`.
const FORGOTTEN: f64 = 48.0;

/// Terms of the surface series that the values of a law give, where it does not tell them itself.
const TERMS_BY_VALUES: usize = 8;

/// How many thicknesses of its first panel deep a law is no different from what its surface promises: polynomials fit
/// where the nearest singularity is about as far away as that.
const SMOOTH_DEPTH: f64 = 2.0;

/// No law is taken to have finer structure at its surface: one that has shows it in the kernel's bound.
const LEAST_DEPTH: f64 = 1.0 / 1024.0;

/// The compliance `d = C t`, carried from the base to the surface slice by slice.
#[derive(Debug)]
pub(crate) struct Layered {
    layer: Arc<LayerModel>,
    panels: Panels,
    /// Stiffness and contraction of the layer as a whole, on a base on which it slides.
    membrane: Option<(f64, f64)>,
}

impl Layered {
    /// Refuses a law that varies too fast.
    pub(crate) fn new(layer: Arc<LayerModel>, method: &'static str) -> Result<Self, Refusal> {
        let panels = Panels::new(&layer).ok_or(Refusal::OutOfReach {
            method,
            why: "the grading varies too fast over the depth, or is no number somewhere".into(),
            remedy: "smooth it",
        })?;
        let membrane = (layer.base == Base::Frictionless).then(|| panels.membrane());
        Ok(Self { layer, panels, membrane })
    }

    /// Compliance at the surface in units of `1/mu1`, `s > 0`.
    fn compliance(&self, s: f64) -> Matrix2<f64> {
        let reach = 0.5 * (FORGOTTEN + self.panels.contrast) / s;
        let panels = &self.panels.panels;
        let seen = &panels[..panels.partition_point(|panel| panel.top < reach)];
        let Some(deepest) = seen.last() else { unreachable!("a layer begins at depth 0") };
        let mut below = if reach < 1.0 {
            // The base is out of sight: any start does.
            Below::Solid(half_plane(Material { shear: deepest.unit, elastic: self.layer.elastic }, s))
        } else {
            self.base(s)
        };
        for panel in seen.iter().rev() {
            below = Below::Solid(through(panel, s, reach, &below));
        }
        match below {
            Below::Solid(compliance) => compliance,
            Below::Smooth => unreachable!("a layer has a panel"),
        }
    }

    fn base(&self, s: f64) -> Below {
        match self.layer.substrate() {
            Some(material) => Below::Solid(half_plane(material, s)),
            None if self.layer.base == Base::Frictionless => Below::Smooth,
            None => Below::Solid(Matrix2::zeros()),
        }
    }

    /// The limit at `s = 0`, the pole left out.
    fn at_origin(&self) -> SurfaceFlexibility {
        let a0 = self.layer.elastic.a0();
        if let Some(Material { shear, elastic }) = self.layer.substrate() {
            let ratio = elastic.a0() / (shear * a0);
            return SurfaceFlexibility { vv: ratio, uu: ratio, uv: -ratio * elastic.beta() };
        }
        let uv = self.membrane.map_or(0.0, |(stiffness, contraction)| contraction / (stiffness * a0));
        SurfaceFlexibility { uv, ..SurfaceFlexibility::default() }
    }
}

impl LayerResponse for Layered {
    fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        if s == 0.0 {
            return Ok(self.at_origin());
        }
        Ok(surface_tail::scaled(&self.compliance(s), s, self.layer.elastic))
    }

    fn elastic(&self) -> Elastic {
        self.layer.elastic
    }

    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        let Panel { thickness, matter, .. } = &self.panels.panels[0];
        match matter {
            Matter::Exponential(material, gamma) => {
                surface_tail::exponential(material.elastic, gamma / thickness, terms)
            }
            Matter::Smooth(coefficients) => surface_tail::of(&self.layer, terms).unwrap_or_else(|| {
                let own = coefficients.window(-1.0, 2.0 / thickness);
                surface_tail::by_values(self.layer.elastic, &own, terms.min(TERMS_BY_VALUES))
            }),
        }
    }

    fn pole(&self) -> f64 {
        self.membrane.map_or(0.0, |(stiffness, _)| 1.0 / (stiffness * self.layer.elastic.a0()))
    }

    fn depth(&self) -> Option<f64> {
        let Panel { thickness, matter, .. } = &self.panels.panels[0];
        let smooth = match matter {
            Matter::Exponential(..) => 1.0,
            Matter::Smooth(_) => (SMOOTH_DEPTH * thickness).max(LEAST_DEPTH),
        };
        Some(self.panels.first_break.min(smooth))
    }
}

/// What a panel stands on.
#[derive(Clone, Copy, Debug)]
enum Below {
    /// A solid of that compliance, in units of `1/mu1`.
    Solid(Matrix2<f64>),
    /// A rigid body without friction.
    Smooth,
}

impl Below {
    /// Compliance at the top of a slice on it, in units of `top_scale`; `bottom_scale` is the unit at its bottom.
    fn under(self, slice: &Slice, (top_scale, bottom_scale): (f64, f64)) -> Matrix2<f64> {
        let compliance = match self {
            Self::Solid(compliance) => slice.over(&(compliance / bottom_scale)),
            Self::Smooth => slice.over_smooth_base(),
        };
        compliance * top_scale
    }
}

/// A half-plane's compliance in units of `1/mu1`.
fn half_plane(material: Material, s: f64) -> Matrix2<f64> {
    surface_tail::half_plane_compliance(material.elastic) / (s * material.shear)
}

/// Compliance at the top of a panel, given what is below it; of what is deeper than `reach` nothing is felt.
fn through(panel: &Panel, s: f64, reach: f64, below: &Below) -> Matrix2<f64> {
    // What is cut off begins below a whole layer, or does not matter.
    let depth = if reach < 1.0 { panel.thickness.min(reach - panel.top) } else { panel.thickness };
    match &panel.matter {
        Matter::Exponential(material, gamma) => {
            let gamma = gamma * (depth / panel.thickness);
            let doublings = ((s * depth).max(gamma.abs()) / THIN).log2().ceil().max(0.0);
            let delta = (-doublings).exp2();
            let mut slice = Slice::thin(&Coefficients::exponential(*material, gamma * delta), s * depth * delta);
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small whole number
            for _ in 0..doublings as u32 {
                slice = slice.doubled();
            }
            let scale = depth * delta / panel.unit;
            below.under(&slice, (scale, scale / gamma.exp()))
        }
        Matter::Smooth(coefficients) => {
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // `s depth` is bounded
            let count = ((s * depth / THIN).ceil() as usize).max(1);
            let (delta, width) = (depth / count as f64, 2.0 * depth / (panel.thickness * count as f64));
            let scale = delta / panel.unit;
            let slice = |k: usize| Slice::thin(&coefficients.window(-1.0 + k as f64 * width, width), s * delta);
            let lowest = below.under(&slice(count - 1), (scale, scale));
            (0..count - 1).rev().fold(lowest, |below, k| Below::Solid(below).under(&slice(k), (scale, scale)))
        }
    }
}

#[cfg(test)]
mod tests;
