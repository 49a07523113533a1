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
#[derive(Clone, Debug)]
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
        let reach = self.reach(s);
        let mut column = Column::on(self.base(s, reach));
        self.carry(s, (0.0, reach.min(1.0)), &mut column);
        column.compliance()
    }

    /// The same, and the compliance that a traction on the surface has at the depth `datum`: displacements there.
    fn compliance_and_datum(&self, s: f64, datum: f64) -> (Matrix2<f64>, Matrix2<f64>) {
        let reach = self.reach(s);
        if reach <= datum {
            return (self.compliance(s), Matrix2::zeros());
        }
        let mut column = Column::on(self.base(s, reach));
        self.carry(s, (datum, reach.min(1.0)), &mut column);
        let there = column.compliance();
        column.transfer = Some(Matrix2::identity());
        if let (true, Some(material)) = (datum > 1.0, self.layer.substrate()) {
            let matter = Matter::Exponential(material, 0.0);
            Panel { top: 1.0, thickness: datum - 1.0, unit: material.shear, matter }.carry(s, (1.0, datum), &mut column);
        }
        self.carry(s, (0.0, datum.min(reach).min(1.0)), &mut column);
        (column.compliance(), there * column.transfer.unwrap_or_default())
    }

    /// Depth below which nothing is felt at the surface.
    fn reach(&self, s: f64) -> f64 {
        0.5 * (FORGOTTEN + self.panels.contrast) / s
    }

    /// Carries a column from the lower to the upper of two depths.
    fn carry(&self, s: f64, span: (f64, f64), column: &mut Column) {
        let panels = &self.panels.panels;
        let from = panels.partition_point(|panel| panel.top + panel.thickness <= span.0);
        let to = panels.partition_point(|panel| panel.top < span.1);
        for panel in panels[from.min(to)..to].iter().rev() {
            panel.carry(s, span, column);
        }
    }

    /// What the layer stands on, as far as it is felt: where its base is out of sight any start does.
    fn base(&self, s: f64, reach: f64) -> Below {
        if reach < 1.0 {
            let panels = &self.panels.panels;
            let deepest = &panels[panels.partition_point(|panel| panel.top < reach) - 1];
            return Below::Solid(half_plane(Material { shear: deepest.unit, elastic: self.layer.elastic }, s));
        }
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

    fn against_datum(&self) -> Option<Box<dyn LayerResponse>> {
        Some(Box::new(AgainstDatum { layer: self.clone(), datum: self.layer.datum? }))
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

/// A layer whose vertical displacements are counted from a depth.
#[derive(Debug)]
struct AgainstDatum {
    layer: Layered,
    datum: f64,
}

impl LayerResponse for AgainstDatum {
    fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        if s == 0.0 {
            return Ok(SurfaceFlexibility { vv: 0.0, ..self.layer.at_origin() });
        }
        let (surface, there) = self.layer.compliance_and_datum(s, self.datum);
        let elastic = self.layer.layer.elastic;
        let vv = surface_tail::scaled(&(surface - there), s, elastic).vv;
        Ok(SurfaceFlexibility { vv, ..surface_tail::scaled(&surface, s, elastic) })
    }

    fn elastic(&self) -> Elastic {
        self.layer.elastic()
    }

    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        self.layer.tail(terms)
    }

    /// What reaches the datum falls like `exp(-s datum)`.
    fn depth(&self) -> Option<f64> {
        self.layer.depth().map(|depth| depth.min(0.5 * self.datum))
    }
}

/// What a slice stands on.
#[derive(Clone, Copy, Debug)]
enum Below {
    /// A solid of that compliance, in units of `1/mu1`.
    Solid(Matrix2<f64>),
    /// A rigid body without friction.
    Smooth,
}

/// A part of the layer, as it is carried upwards.
#[derive(Debug)]
struct Column {
    below: Below,
    /// Tractions at the datum for tractions on top, once the datum is passed.
    transfer: Option<Matrix2<f64>>,
}

impl Column {
    fn on(below: Below) -> Self {
        Self { below, transfer: None }
    }

    fn compliance(&self) -> Matrix2<f64> {
        match self.below {
            Below::Solid(compliance) => compliance,
            Below::Smooth => unreachable!("a layer has a panel"),
        }
    }

    /// Puts a slice on top; the scales are the units of compliance at its top and at its bottom.
    fn raise(&mut self, slice: &Slice, (top_scale, bottom_scale): (f64, f64)) {
        let compliance = match self.below {
            Below::Solid(compliance) => {
                let below = compliance / bottom_scale;
                if let Some(transfer) = &mut self.transfer {
                    *transfer *= slice.traction(&below);
                }
                slice.over(&below)
            }
            Below::Smooth => slice.over_smooth_base(),
        };
        self.below = Below::Solid(compliance * top_scale);
    }
}

/// A half-plane's compliance in units of `1/mu1`.
fn half_plane(material: Material, s: f64) -> Matrix2<f64> {
    surface_tail::half_plane_compliance(material.elastic) / (s * material.shear)
}

impl Panel {
    /// Carries a column through as much of the panel as lies within `span`.
    fn carry(&self, s: f64, span: (f64, f64), column: &mut Column) {
        let (top, bottom) = (span.0.max(self.top), span.1.min(self.top + self.thickness));
        let depth = if top == self.top && bottom == self.top + self.thickness { self.thickness } else { bottom - top };
        // In units of the panel: where the part begins, and how thick it is.
        let (start, part) = ((top - self.top) / self.thickness, depth / self.thickness);
        match &self.matter {
            Matter::Exponential(material, gamma) => {
                let unit = self.unit * (gamma * start).exp();
                let gamma = gamma * part;
                let doublings = ((s * depth).max(gamma.abs()) / THIN).log2().ceil().max(0.0);
                let delta = (-doublings).exp2();
                let mut slice = Slice::thin(&Coefficients::exponential(*material, gamma * delta), s * depth * delta);
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small whole number
                for _ in 0..doublings as u32 {
                    slice = slice.doubled();
                }
                let scale = depth * delta / unit;
                column.raise(&slice, (scale, scale / gamma.exp()));
            }
            Matter::Smooth(coefficients) => {
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // `s depth` is bounded
                let count = ((s * depth / THIN).ceil() as usize).max(1);
                let (start, width) = (-1.0 + 2.0 * start, 2.0 * part / count as f64);
                let (delta, scale) = (depth / count as f64, depth / (count as f64 * self.unit));
                for k in (0..count).rev() {
                    let slice = Slice::thin(&coefficients.window(start + k as f64 * width, width), s * delta);
                    column.raise(&slice, (scale, scale));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
