//! A layer of any law on any base, slice by slice.

use crate::panels::{Matter, Panel, Panels};
use crate::precision::Precision;
use crate::propagator::{Propagator, Rows};
use crate::slice::{Slice, THIN};
use crate::surface_tail;
use nalgebra::Matrix2;
use pulp::{Arch, Scalar, Simd, WithSimd};
use slipzone_api::{Base, Elastic, LayerModel, LayerResponse, Material, Refusal, SurfaceFlexibility};
use std::sync::Arc;

/// Wave numbers that are carried upwards together, by which factor they may differ, and up to where that is no matter.
const LANES: usize = 4;
const ALIKE: f64 = 2.0;
const FEW: f64 = 20.0;

/// Most terms of the surface series of a law that is no exponential: they cost as their fourth power, and the series is
/// asymptotic.
const MOST_TERMS: usize = 24;

/// Terms of the surface series that the values of a law give, where it does not tell them itself.
const TERMS_BY_VALUES: usize = 8;

/// No law is taken to have finer structure at its surface: one that has shows it in the kernel's bound.
const LEAST_DEPTH: f64 = 1.0 / 32.0;

/// The compliance `d = C t`, carried from the base to the surface slice by slice, to a given precision.
#[derive(Clone, Debug)]
pub(crate) struct Layered {
    layer: Arc<LayerModel>,
    panels: Panels,
    /// Who carries it, for refusals.
    method: &'static str,
    /// Stiffness and contraction of the layer as a whole, on a base on which it slides.
    membrane: Option<(f64, f64)>,
}

impl Layered {
    /// Refuses a law that varies too fast, or is no finite number somewhere.
    pub(crate) fn new(
        layer: Arc<LayerModel>,
        precision: &'static Precision,
        method: &'static str,
    ) -> Result<Self, Refusal> {
        let panels =
            Panels::new(&layer, precision).map_err(|why| Refusal::OutOfReach { method, why, remedy: "smooth it" })?;
        let membrane = (layer.base == Base::Frictionless).then(|| panels.membrane());
        Ok(Self { layer, panels, method, membrane })
    }

    /// Compliance at the surface in units of `1/mu1`, at wave numbers above 0.
    #[inline(always)]
    fn compliance<S: Simd, const L: usize>(&self, s: &[f64; L]) -> Compliances<L> {
        let reach = self.reach(s);
        let mut column = self.standing(s, reach);
        column.carry::<S>(&self.panels.all, s, (reach, self.panels.precision.thick));
        column.unscaled(s)
    }

    /// The same, and what a traction on the surface displaces at the depth `datum`, above which the first `above`
    /// panels lie.
    fn compliance_and_datum(&self, s: f64, datum: f64, above: usize) -> (Compliances<1>, Matrix2<f64>) {
        let s = [s];
        // What a load does at a depth y falls like exp(-s y), what it does there and back like the square.
        let reach = 2.0 * self.reach(&s);
        if reach <= datum {
            return (self.compliance::<Scalar, 1>(&s), Matrix2::zeros());
        }
        let ((above, below), thick) = (self.panels.all.split_at(above), self.panels.precision.thick);
        let mut column = self.standing(&s, reach);
        column.carry::<Scalar>(below, &s, (reach, thick));
        let there = matrix(&column.unscaled(&s), 0);
        column.transfer = Some([Matrix2::identity()]);
        column.carry::<Scalar>(above, &s, (reach, thick));
        (column.unscaled(&s), there * column.transfer.map_or_else(Matrix2::zeros, |[transfer]| transfer))
    }

    /// Depth below which nothing is felt at the surface.
    fn reach(&self, s: &[f64]) -> f64 {
        0.5 * (self.panels.precision.forgotten + self.panels.contrast) / s.iter().copied().fold(f64::INFINITY, f64::min)
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
                Column { scaled: [[[0.0; L]; 2]; 2], slides: self.layer.base == Base::Frictionless, transfer: None }
            }
        }
    }

    /// `s F/A0` of a compliance. That of a base so much softer than the surface that squares of its compliance overflow
    /// is no number.
    fn told(&self, compliance: &Matrix2<f64>, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        let told = surface_tail::scaled(compliance, s, self.layer.elastic);
        if told.vv.is_finite() && told.uu.is_finite() && told.uv.is_finite() {
            return Ok(told);
        }
        Err(Refusal::OutOfReach {
            method: self.method,
            why: format!("the moduli over the depth differ by a factor of {:.0e}", self.panels.contrast.exp()),
            remedy: "give the softer part a modulus closer to that of the surface",
        })
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
        self.told(&matrix(&self.compliance::<Scalar, 1>(&[s]), 0), s)
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
                *out = self.told(&matrix(&compliance, i), s[i])?;
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
            Matter::Homogeneous(material, _) => surface_tail::exponential(material.elastic, 0.0, terms),
            Matter::Exponential(material, gamma) => {
                surface_tail::exponential(material.elastic, gamma / thickness, terms)
            }
            Matter::Smooth(slices) => surface_tail::of(&self.layer, terms.min(MOST_TERMS)).unwrap_or_else(|| {
                let own = slices.coefficients.window(-1.0, 2.0 / thickness);
                surface_tail::by_values(self.layer.elastic, &own, terms.min(TERMS_BY_VALUES))
            }),
        }
    }

    fn pole(&self) -> f64 {
        self.membrane.map_or(0.0, |(stiffness, _)| 1.0 / (stiffness * self.layer.elastic.a0()))
    }

    fn against_datum(&self) -> Option<Box<dyn LayerResponse>> {
        let datum = self.layer.datum?;
        let mut cut = self.clone();
        if let (true, Some(material)) = (datum > 1.0, self.layer.substrate()) {
            cut.panels.extend(material, datum);
        }
        let above = cut.panels.cut(datum);
        Some(Box::new(AgainstDatum { layer: self.clone(), cut, above, datum }))
    }

    fn depth(&self) -> Option<f64> {
        let promised = |panel: &Panel| match panel.matter {
            Matter::Homogeneous(..) | Matter::Exponential(..) => 1.0,
            Matter::Smooth(_) => panel.top + self.panels.precision.shown * panel.thickness,
        };
        let smooth = self.panels.all.iter().map(promised).fold(1.0, f64::min);
        Some(self.panels.first_break.min(smooth.max(LEAST_DEPTH)))
    }

    fn thickness(&self) -> Option<f64> {
        Some(1.0)
    }

    fn broken_power(&self) -> Option<f64> {
        self.layer.law.broken_power()
    }

    fn is_homogeneous(&self) -> bool {
        self.layer.exponent() == Some(0.0)
    }

    fn breaks(&self) -> bool {
        self.depth() == Some(self.panels.first_break) && self.panels.first_break < 1.0
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
        self.layer.compliance::<S, LANES>(&self.s)
    }
}

/// A layer whose vertical displacements are counted from a depth.
#[derive(Debug)]
struct AgainstDatum {
    layer: Layered,
    /// The same with an end of a panel at the datum, and how many panels lie above it.
    cut: Layered,
    above: usize,
    datum: f64,
}

impl LayerResponse for AgainstDatum {
    fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        if s == 0.0 {
            return Ok(SurfaceFlexibility { vv: 0.0, ..self.layer.at_origin() });
        }
        let (surface, there) = self.cut.compliance_and_datum(s, self.datum, self.above);
        let surface = matrix(&surface, 0);
        let vv = self.layer.told(&(surface - there), s)?.vv;
        Ok(SurfaceFlexibility { vv, ..self.layer.told(&surface, s)? })
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

    fn thickness(&self) -> Option<f64> {
        self.layer.thickness().map(|thickness| thickness.min(0.5 * self.datum))
    }

    fn extent(&self) -> Option<f64> {
        self.layer.thickness()
    }

    fn broken_power(&self) -> Option<f64> {
        self.layer.broken_power()
    }

    fn is_homogeneous(&self) -> bool {
        self.layer.is_homogeneous()
    }

    fn breaks(&self) -> bool {
        self.layer.breaks()
    }
}

/// A compliance `d = C t` for each of some wave numbers: rows `u`, `v`, columns `sigma_xy`, `sigma_yy`.
type Compliances<const L: usize> = [[[f64; L]; 2]; 2];

/// Parts of the layer, as they are carried upwards at some wave numbers.
#[derive(Debug)]
struct Column<const L: usize> {
    /// The compliance on top, in units of `1/mu1`, of `(u, v/s)` to `(sigma_xy, sigma_yy/s)`.
    scaled: Compliances<L>,
    /// Whether there is nothing yet but a rigid base without friction.
    slides: bool,
    /// Tractions at the datum for tractions on top, once the datum is passed.
    transfer: Option<[Matrix2<f64>; L]>,
}

impl<const L: usize> Column<L> {
    fn half_plane(material: Material, s: &[f64; L]) -> Self {
        let compliance = surface_tail::half_plane_compliance(material.elastic) / material.shear;
        let entry = |i: usize, j: usize, power: i32| s.map(|s| compliance[(i, j)] * s.powi(power));
        let scaled = [[entry(0, 0, -1), entry(0, 1, 0)], [entry(1, 0, -2), entry(1, 1, -1)]];
        Self { scaled, slides: false, transfer: None }
    }

    /// The compliance on top.
    fn unscaled(&self, s: &[f64; L]) -> Compliances<L> {
        let [[xx, xy], [yx, yy]] = self.scaled;
        [[xx, std::array::from_fn(|i| xy[i] / s[i])], [std::array::from_fn(|i| yx[i] * s[i]), yy]]
    }

    /// Carries the column through panels in slices up to `thick`, but for what is deeper than `reach`.
    #[inline(always)]
    fn carry<S: Simd>(&mut self, panels: &[Panel], s: &[f64; L], (reach, thick): (f64, f64)) {
        let felt = panels.partition_point(|panel| panel.top < reach);
        for panel in panels[..felt].iter().rev() {
            panel.carry::<S, L>((s, reach, thick), self);
        }
    }

    /// Puts a slice on top of one of the columns; the scales are the units of compliance at its top and at its bottom.
    fn raise(&mut self, i: usize, s: f64, slice: &Slice, (top_scale, bottom_scale): (f64, f64)) {
        let [[xx, xy], [yx, yy]] = &mut self.scaled;
        let compliance = if self.slides {
            slice.over_smooth_base()
        } else {
            let below = Matrix2::new(xx[i], xy[i] / s, yx[i] * s, yy[i]) / bottom_scale;
            if let Some(transfer) = &mut self.transfer {
                transfer[i] *= slice.traction(&below);
            }
            slice.over(&below)
        } * top_scale;
        (xx[i], xy[i], yx[i], yy[i]) = (compliance.m11, compliance.m12 * s, compliance.m21 / s, compliance.m22);
    }

    /// Puts a slice of some depth on top of all columns, stresses in the unit `unit`; `s` are the wave numbers over its
    /// depth.
    #[inline(always)]
    fn rise(&mut self, [displacements, tractions]: &[Rows<L>; 2], s: &[f64; L], depth: f64, unit: f64) {
        let (softness, squared) = (depth / unit, depth * depth / unit);
        let (per_softness, per_squared) = (softness.recip(), squared.recip());
        let [[xx, xy], [yx, yy]] = &mut self.scaled;
        for i in 0..L {
            (xx[i], xy[i], yx[i], yy[i]) =
                (xx[i] * per_softness, xy[i] * unit, yx[i] * per_squared, yy[i] * per_softness);
        }
        // Two states: each with a unit traction and what displacements go with that; on a base on which the layer
        // slides with a unit of what that leaves free.
        let free = if self.slides { [0, 3] } else { [2, 3] };
        self.slides = false;
        let mut top = [[[0.0; L]; 2]; 4];
        for (top, row) in top.iter_mut().zip(displacements.iter().chain(tractions)) {
            for (j, top) in top.iter_mut().enumerate() {
                let below = [&self.scaled[0][j], &self.scaled[1][j]];
                for i in 0..L {
                    top[i] = row[0][i] * below[0][i] + row[1][i] * below[1][i] + row[free[j]][i];
                }
            }
        }
        let [u, w, sigma, tau] = &top;
        if let Some(transfer) = &mut self.transfer {
            for (i, transfer) in transfer.iter_mut().enumerate() {
                let tractions = Matrix2::new(sigma[0][i], sigma[1][i] / s[i], tau[0][i] * s[i], tau[1][i]);
                *transfer *= tractions.try_inverse().unwrap_or_else(Matrix2::zeros);
            }
        }
        let [[xx, xy], [yx, yy]] = &mut self.scaled;
        for i in 0..L {
            let determinant = (sigma[0][i] * tau[1][i] - sigma[1][i] * tau[0][i]).recip();
            let scaled = softness * determinant;
            xx[i] = (u[0][i] * tau[1][i] - u[1][i] * tau[0][i]) * scaled;
            xy[i] = (u[1][i] * sigma[0][i] - u[0][i] * sigma[1][i]) * (determinant / unit);
            yx[i] = (w[0][i] * tau[1][i] - w[1][i] * tau[0][i]) * (squared * determinant);
            yy[i] = (w[1][i] * sigma[0][i] - w[0][i] * sigma[1][i]) * scaled;
        }
    }
}

/// One of some compliances.
fn matrix<const L: usize>(compliances: &Compliances<L>, i: usize) -> Matrix2<f64> {
    Matrix2::from_fn(|row, column| compliances[row][column][i])
}

impl Panel {
    /// Carries columns through the panel in slices up to `thick`, but for what is deeper than `reach`.
    #[inline(always)]
    fn carry<S: Simd, const L: usize>(&self, (s, reach, thick): (&[f64; L], f64, f64), column: &mut Column<L>) {
        // The whole, where it is the whole: a thin panel far down has no digits in the difference.
        let is_whole = reach >= self.top + self.thickness;
        let depth = if is_whole { self.thickness } else { reach - self.top };
        let (least, most) = s.iter().fold((f64::INFINITY, 0.0_f64), |(least, most), s| (s.min(least), s.max(most)));
        match &self.matter {
            Matter::Homogeneous(_, propagator) => {
                #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // `s depth` is bounded
                let count = ((most * depth / thick).ceil() as usize).max(1);
                let delta = depth / count as f64;
                let waves = s.map(|s| s * delta);
                let rows = rows::<S, L>(propagator, &waves);
                for _ in 0..count {
                    column.rise(&rows, &waves, delta, self.unit);
                }
            }
            Matter::Exponential(material, gamma) => {
                let gamma = gamma * (depth / self.thickness);
                let scale = depth / self.unit;
                for (i, s) in s.iter().enumerate() {
                    let doublings = ((s * depth).max(gamma.abs()) / THIN).log2().ceil().max(0.0);
                    let delta = (-doublings).exp2();
                    let mut slice = Slice::thin(*material, gamma * delta, s * depth * delta);
                    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small whole number
                    for _ in 0..doublings as u32 {
                        slice = slice.doubled();
                    }
                    column.raise(i, *s, &slice, (scale * delta, scale * delta / gamma.exp()));
                }
                column.slides = false;
            }
            Matter::Smooth(slices) => {
                slices.walk((self.top, self.thickness), (depth, least, most), |slice, delta| {
                    let waves = s.map(|s| s * delta);
                    column.rise(&rows::<S, L>(slice, &waves), &waves, delta, self.unit);
                });
            }
        }
    }
}

/// What a slice does at wave numbers over its thickness.
#[inline(always)]
fn rows<S: Simd, const L: usize>(propagator: &Propagator, s: &[f64; L]) -> [Rows<L>; 2] {
    let q = s.map(|s| s * s);
    propagator.at::<S, L>(&q, q.iter().fold(0.0, |most, q| q.max(most)))
}

#[cfg(test)]
mod tests;
