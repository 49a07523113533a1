//! A layer of any law on any base, slice by slice.

use crate::coefficients::{self, Coefficients, Compliances};
use crate::panels::{Matter, Panel, Panels};
use crate::slice::{Slice, THIN};
use crate::surface_tail;
use nalgebra::Matrix2;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::{Base, Elastic, LayerModel, LayerResponse, Material, Refusal, SurfaceFlexibility};
use std::sync::Arc;

/// A base is forgotten where `exp(-2 s y)` times the contrast of moduli, and times the square of the polynomial that goes
/// with it (below `exp(8)` there), drops under `exp(-33) = 5e-15`: what is put in its place is as good to a digit at least.
const FORGOTTEN: f64 = 41.0;

/// Largest `s delta` of a slice in which the constants vary.
const THICK: f64 = 2.0;

/// Wave numbers that are carried upwards together, by which factor they may differ, and up to where that is no matter.
const LANES: usize = 4;
const ALIKE: f64 = 2.0;
const FEW: f64 = 20.0;

/// Most terms of the surface series of a law that is no exponential: they cost as their fourth power, and the series is
/// asymptotic.
const MOST_TERMS: usize = 24;

/// Terms of the surface series that the values of a law give, where it does not tell them itself.
const TERMS_BY_VALUES: usize = 8;

/// By how many of its thicknesses below its top a panel shows a law to be no different from what is above: polynomials
/// fit where the nearest singularity is about as far away as that.
const SMOOTH_DEPTH: f64 = 4.0;

/// No law is taken to have finer structure at its surface: one that has shows it in the kernel's bound.
const LEAST_DEPTH: f64 = 1.0 / 32.0;

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

    /// Compliance at the surface in units of `1/mu1`, at wave numbers above 0.
    #[inline(always)]
    fn compliance<const L: usize>(&self, s: &[f64; L]) -> Compliances<L> {
        let reach = self.reach(s);
        let mut column = self.standing(s, reach);
        self.carry(s, (0.0, reach.min(1.0)), &mut column);
        column.compliance
    }

    /// The same, and what a traction on the surface displaces at the depth `datum`.
    fn compliance_and_datum(&self, s: f64, datum: f64) -> (Compliances<1>, Matrix2<f64>) {
        let s = [s];
        // What a load does at a depth y falls like exp(-s y), what it does there and back like the square.
        let reach = 2.0 * self.reach(&s);
        if reach <= datum {
            return (self.compliance(&s), Matrix2::zeros());
        }
        let mut column = self.standing(&s, reach);
        self.carry(&s, (datum, reach.min(1.0)), &mut column);
        let there = matrix(&column.compliance, 0);
        column.transfer = Some([Matrix2::identity()]);
        if let (true, Some(material)) = (datum > 1.0, self.layer.substrate()) {
            let matter = Matter::Exponential(material, 0.0);
            Panel { top: 1.0, thickness: datum - 1.0, unit: material.shear, matter }.carry(
                &s,
                (1.0, datum),
                &mut column,
            );
        }
        self.carry(&s, (0.0, datum.min(reach).min(1.0)), &mut column);
        (column.compliance, there * column.transfer.map_or_else(Matrix2::zeros, |[transfer]| transfer))
    }

    /// Depth below which nothing is felt at the surface.
    fn reach(&self, s: &[f64]) -> f64 {
        0.5 * (FORGOTTEN + self.panels.contrast) / s.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Carries columns from the lower to the upper of two depths.
    #[inline(always)]
    fn carry<const L: usize>(&self, s: &[f64; L], span: (f64, f64), column: &mut Column<L>) {
        let panels = &self.panels.all;
        let from = panels.partition_point(|panel| panel.top + panel.thickness <= span.0);
        let to = panels.partition_point(|panel| panel.top < span.1);
        for panel in panels[from.min(to)..to].iter().rev() {
            panel.carry(s, span, column);
        }
    }

    /// What the layer stands on, as far as it is felt: where its base is out of sight any start does.
    fn standing<const L: usize>(&self, s: &[f64; L], reach: f64) -> Column<L> {
        if reach < 1.0 {
            let panels = &self.panels.all;
            let deepest = &panels[panels.partition_point(|panel| panel.top < reach) - 1];
            return Column::half_plane(Material { shear: deepest.unit, elastic: self.layer.elastic }, s);
        }
        match self.layer.substrate() {
            Some(material) => Column::half_plane(material, s),
            None => {
                Column { compliance: [[[0.0; L]; 2]; 2], slides: self.layer.base == Base::Frictionless, transfer: None }
            }
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
        Ok(surface_tail::scaled(&matrix(&self.compliance(&[s]), 0), s, self.layer.elastic))
    }

    fn surface_into(&self, wave_numbers: &[f64], out: &mut [SurfaceFlexibility]) -> Result<(), Refusal> {
        assert_eq!(wave_numbers.len(), out.len(), "one flexibility per wave number");
        for (some, out) in wave_numbers.chunks(LANES).zip(out.chunks_mut(LANES)) {
            let (least, most) = some.iter().fold((f64::INFINITY, 0.0_f64), |(l, m), s| (l.min(*s), m.max(*s)));
            if least <= 0.0 || most > FEW.max(ALIKE * least) {
                for (s, out) in some.iter().zip(out) {
                    *out = self.surface(*s)?;
                }
                continue;
            }
            let s: [f64; LANES] = std::array::from_fn(|i| some[i.min(some.len() - 1)]);
            let compliance = Arch::new().dispatch(Rise { layer: self, s });
            for (i, out) in out.iter_mut().enumerate() {
                *out = surface_tail::scaled(&matrix(&compliance, i), s[i], self.layer.elastic);
            }
        }
        Ok(())
    }

    fn elastic(&self) -> Elastic {
        self.layer.elastic
    }

    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        let Panel { thickness, matter, .. } = &self.panels.all[0];
        match matter {
            Matter::Exponential(material, gamma) => {
                surface_tail::exponential(material.elastic, gamma / thickness, terms)
            }
            Matter::Smooth(coefficients) => surface_tail::of(&self.layer, terms.min(MOST_TERMS)).unwrap_or_else(|| {
                let own = coefficients.window(-1.0, 2.0 / thickness);
                surface_tail::by_values(self.layer.elastic, &own, terms.min(TERMS_BY_VALUES))
            }),
        }
    }

    fn pole(&self) -> f64 {
        self.membrane.map_or(0.0, |(stiffness, _)| 1.0 / (stiffness * self.layer.elastic.a0()))
    }

    fn against_datum(&self) -> Option<Box<dyn LayerResponse>> {
        let datum = self.layer.datum?;
        Some(Box::new(AgainstDatum { layer: self.clone(), datum }))
    }

    fn depth(&self) -> Option<f64> {
        let promised = |panel: &Panel| match panel.matter {
            Matter::Exponential(..) => 1.0,
            Matter::Smooth(_) => panel.top + SMOOTH_DEPTH * panel.thickness,
        };
        let smooth = self.panels.all.iter().map(promised).fold(1.0, f64::min);
        Some(self.panels.first_break.min(smooth.max(LEAST_DEPTH)))
    }
}

/// [`Layered::compliance`] in the vectors that the machine has.
struct Rise<'a> {
    layer: &'a Layered,
    s: [f64; LANES],
}

impl WithSimd for Rise<'_> {
    type Output = Compliances<LANES>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Compliances<LANES> {
        self.layer.compliance(&self.s)
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
        let surface = matrix(&surface, 0);
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

/// Parts of the layer, as they are carried upwards at some wave numbers.
#[derive(Debug)]
struct Column<const L: usize> {
    /// On top, in units of `1/mu1`.
    compliance: Compliances<L>,
    /// Whether there is nothing yet but a rigid base without friction.
    slides: bool,
    /// Tractions at the datum for tractions on top, once the datum is passed.
    transfer: Option<[Matrix2<f64>; L]>,
}

impl<const L: usize> Column<L> {
    fn half_plane(material: Material, s: &[f64; L]) -> Self {
        let compliance = surface_tail::half_plane_compliance(material.elastic) / material.shear;
        let entry = |i: usize, j: usize| s.map(|s| compliance[(i, j)] / s);
        let compliance = [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]];
        Self { compliance, slides: false, transfer: None }
    }

    /// Puts a slice on top of one of the columns; the scales are the units of compliance at its top and at its bottom.
    fn raise(&mut self, i: usize, slice: &Slice, (top_scale, bottom_scale): (f64, f64)) {
        let compliance = if self.slides {
            slice.over_smooth_base()
        } else {
            let below = matrix(&self.compliance, i) / bottom_scale;
            if let Some(transfer) = &mut self.transfer {
                transfer[i] *= slice.traction(&below);
            }
            slice.over(&below)
        };
        for (row, entries) in compliance.row_iter().zip(&mut self.compliance) {
            for (entry, lanes) in row.iter().zip(entries) {
                lanes[i] = entry * top_scale;
            }
        }
    }

    /// Puts a slice of polynomial coefficients, in the distance from its bottom, on top of all columns; `s` are the wave
    /// numbers over its thickness.
    #[inline(always)]
    fn rise(&mut self, coefficients: &Coefficients, s: &[f64; L], scale: f64) {
        let (none, one) = ([0.0; L], [1.0; L]);
        let bottom = if self.slides {
            self.slides = false;
            [[one, none], [none, none], [none, none], [none, one]]
        } else {
            let scaled = self.compliance.map(|row| row.map(|lanes| lanes.map(|c| c / scale)));
            [scaled[0], scaled[1], [one, none], [none, one]]
        };
        let top = coefficients.rise(s, bottom);
        if let Some(transfer) = &mut self.transfer {
            for (i, transfer) in transfer.iter_mut().enumerate() {
                let tractions = Matrix2::new(top[2][0][i], top[2][1][i], top[3][0][i], top[3][1][i]);
                *transfer *= tractions.try_inverse().unwrap_or_else(Matrix2::zeros);
            }
        }
        self.compliance = coefficients::compliance(&top).map(|row| row.map(|lanes| lanes.map(|c| c * scale)));
    }
}

/// One of some compliances.
fn matrix<const L: usize>(compliances: &Compliances<L>, i: usize) -> Matrix2<f64> {
    Matrix2::from_fn(|row, column| compliances[row][column][i])
}

impl Panel {
    /// Carries columns through as much of the panel as lies within `span`.
    #[inline(always)]
    fn carry<const L: usize>(&self, s: &[f64; L], span: (f64, f64), column: &mut Column<L>) {
        let (top, bottom) = (span.0.max(self.top), span.1.min(self.top + self.thickness));
        // The whole, where it is the whole: a thin panel far down has no digits in the difference.
        let is_whole = span.0 <= self.top && span.1 >= self.top + self.thickness;
        let depth = if is_whole { self.thickness } else { bottom - top };
        // In units of the panel: where the part begins, and how thick it is.
        let (start, part) = ((top - self.top) / self.thickness, depth / self.thickness);
        let most = s.iter().fold(0.0_f64, |most, s| most.max(*s));
        match &self.matter {
            // One slice of constant coefficients: the wave numbers rise together.
            Matter::Exponential(material, 0.0) if most * depth <= THICK => {
                let coefficients = Coefficients::constant(*material);
                column.rise(&coefficients, &s.map(|s| s * depth), depth / self.unit);
            }
            Matter::Exponential(material, gamma) => {
                let (unit, gamma) = (self.unit * (gamma * start).exp(), gamma * part);
                let scale = depth / unit;
                for (i, s) in s.iter().enumerate() {
                    let doublings = ((s * depth).max(gamma.abs()) / THIN).log2().ceil().max(0.0);
                    let delta = (-doublings).exp2();
                    let mut slice = Slice::thin(*material, gamma * delta, s * depth * delta);
                    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small whole number
                    for _ in 0..doublings as u32 {
                        slice = slice.doubled();
                    }
                    column.raise(i, &slice, (scale * delta, scale * delta / gamma.exp()));
                }
                column.slides = false;
            }
            Matter::Smooth(coefficients) => {
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // `s depth` is bounded
                let count = ((most * depth / THICK).ceil() as usize).max(1);
                let (start, width) = (-1.0 + 2.0 * start, 2.0 * part / count as f64);
                let delta = depth / count as f64;
                let waves = s.map(|s| s * delta);
                for k in (1..=count).rev() {
                    let own = coefficients.window(start + k as f64 * width, -width);
                    column.rise(&own, &waves, delta / self.unit);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
