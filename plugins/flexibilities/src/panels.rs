//! A layer as panels of depth on each of which its elastic constants are polynomials.

use crate::coefficients::{CONTRACTION, CROSS, Coefficients, MOST, Polynomial, SOFTNESS};
use crate::precision::Precision;
use crate::propagator::Propagator;
use crate::slices::Slices;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::chebyshev::in_powers;
use slipzone_api::{LayerModel, Material, ModulusLaw, Stretch, short};
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// A stretch of depth, in units of the thickness of the whole.
#[derive(Clone, Debug)]
pub(crate) struct Panel {
    pub(crate) top: f64,
    pub(crate) thickness: f64,
    /// Shear modulus of its stresses' unit at the top, in units of that at the surface.
    pub(crate) unit: f64,
    /// What it is made of.
    pub(crate) matter: Matter,
}

/// How a panel's constants vary.
#[derive(Clone, Debug)]
pub(crate) enum Matter {
    /// All are the same everywhere. What a slice of such a material does is shared.
    Homogeneous(Material, Arc<Propagator>),
    /// All but the modulus are the same everywhere, and that is `exp(gamma y)`, `y` from 0 to 1 over the panel.
    Exponential(Material, f64),
    /// Polynomials.
    Smooth(Box<Slices>),
}

impl Panel {
    /// The parts above and below a depth within.
    fn cut(&self, depth: f64) -> [Self; 2] {
        let bottom = self.top + self.thickness;
        [(self.top, depth), (depth, bottom)].map(|(top, bottom)| {
            let (start, part) = ((top - self.top) / self.thickness, (bottom - top) / self.thickness);
            let (unit, matter) = match &self.matter {
                Matter::Homogeneous(..) => (self.unit, self.matter.clone()),
                Matter::Exponential(material, gamma) => {
                    (self.unit * (gamma * start).exp(), Matter::Exponential(*material, gamma * part))
                }
                Matter::Smooth(slices) => {
                    (self.unit, Matter::Smooth(Box::new(slices.window(2.0 * start + part - 1.0, part))))
                }
            };
            Self { top, thickness: bottom - top, unit, matter }
        })
    }
}

/// The panels of a layer, top first.
#[derive(Clone, Debug)]
pub(crate) struct Panels {
    /// How precisely they follow the law.
    pub(crate) precision: &'static Precision,
    /// Each where the one above it ends.
    pub(crate) all: Vec<Panel>,
    /// `ln(max mu/min mu)`.
    pub(crate) contrast: f64,
    /// The first depth at which the constants have a kink or a jump, as told or as found.
    pub(crate) first_break: f64,
}

/// A law's own rounding may be larger than a panel's errors: coefficients below this that halving the panel leaves
/// above a part of what they were are taken for it. Those of a smooth law fall by far more, those of a jump are larger.
const NOISE: (f64, f64) = (1e-12, 0.3);

/// What of the rounding of a depth, over the thickness of a panel there, is taken for noise.
const NOISE_OF_DEPTH: f64 = 8.0;

/// The last of the constants, `beta/mu`, is a difference that vanishes where a solid is incompressible: its own
/// rounding is that of Poisson's ratio, relative to the first, `1/mu`. It is measured by this part of that at least
/// when it is taken for noise.
const FAINT: f64 = 1e-3;

/// Coefficients that must be small at the end of a series.
const LAST: usize = 3;

/// A panel as thin as this over its law holds a jump or a kink that the law does not tell: nothing else is that narrow.
const KINK: f64 = 1e-6;

/// Where the law begins with a broken power panels shrink towards the surface, each as thick as this part of what lies
/// above it, or thicker.
const SHRINKING: f64 = 0.1;

/// Even if it is not smooth a panel as thin as this is kept, all of it taken for what is at its top: what a jump is
/// taken for matters no more than its thickness.
const THINNEST: f64 = 1e-13;

/// The same over the depth, of laws that begin with a broken power of it, down to here.
const NEAREST: f64 = 1e-36;

/// Most panels: a law that asks for more is noise.
const MOST_PANELS: usize = 1 << 15;

/// Largest relative error at the law's probes: above its rounding and that of polynomials, so that nothing counts but
/// what the nodes have missed.
const PROBED: f64 = 1e-12;

/// Where the constants are looked at beside the nodes.
const BESIDE: [f64; 2] = [-0.991, 0.983];

impl Panels {
    /// Says where a law varies too fast, or is no finite number.
    pub(crate) fn new(layer: &LayerModel, precision: &'static Precision) -> Result<Self, String> {
        let mut panels = Self { precision, all: Vec::new(), contrast: 0.0, first_break: 1.0 };
        let mut extremes = (f64::INFINITY, 0.0_f64);
        for stretch in layer.law.stretches() {
            if !panels.all.is_empty() && !stretch.is_continued {
                panels.first_break = panels.first_break.min(stretch.in_whole(stretch.from));
            }
            panels.add(layer, &stretch, |shear| extremes = (extremes.0.min(shear), extremes.1.max(shear)))?;
        }
        panels.contrast = (extremes.1 / extremes.0).ln();
        if !panels.contrast.is_finite() {
            return Err(format!("the modulus goes from {} to {}", short(extremes.0), short(extremes.1)));
        }
        Ok(panels)
    }

    /// Adds a stretch, and shows `see` the moduli that it meets.
    fn add(&mut self, layer: &LayerModel, stretch: &Stretch, mut see: impl FnMut(f64)) -> Result<(), String> {
        let Stretch { law, thickness, from, to, .. } = *stretch;
        if let Some(gamma) = law.exponent() {
            let (material, span) = (layer.material(law, from), to - from);
            see(material.shear);
            see(layer.material(law, to).shear);
            let matter = if gamma == 0.0 {
                Matter::Homogeneous(material, self.propagator(material))
            } else {
                Matter::Exponential(material, gamma * span)
            };
            let top = stretch.in_whole(from);
            self.all.push(Panel { top, thickness: span * thickness, unit: material.shear, matter });
            return Ok(());
        }
        let is_broken = law.broken_power().is_some_and(|power| power < 1.0);
        // Depths over the law's own range, deepest on the stack first.
        let mut stack = vec![(from, to - from, f64::INFINITY)];
        while let Some((start, width, before)) = stack.pop() {
            let (top, wide) = (stretch.in_whole(start), width * thickness);
            let fit = Fit::of(layer, law, (start, width), self.precision).ok_or_else(|| {
                format!("constants of the solid are no finite numbers somewhere from y = {} h on", short(top))
            })?;
            let thinnest = if is_broken { (THINNEST * (start + width)).max(NEAREST) } else { THINNEST };
            let is_thinnest = wide <= thinnest || width <= thinnest;
            // A depth is rounded, too, and a law that varies over the panel with it; so thin a panel hardly matters,
            // unless it is very soft or very stiff.
            let rounding = NOISE_OF_DEPTH * f64::EPSILON * (start + width) / width;
            let weight = wide * fit.extremes.1.max(fit.extremes.0.recip());
            let is_rounding = fit.error < rounding && fit.error * weight < NOISE.0;
            let is_noise = (fit.error < NOISE.0 || is_rounding) && fit.error > NOISE.1 * before;
            let fits = fit.is_smooth || is_noise;
            // A film between the nodes: none of them tells.
            let most = PROBED.max(rounding);
            let missed = if fits { fit.missed(layer, stretch, (start, width), most) } else { None };
            if (!fits || missed.is_some()) && !is_thinnest {
                let (half, error) = (0.5 * width, missed.unwrap_or(fit.error));
                stack.push((start + half, half, error));
                stack.push((start, half, error));
                continue;
            }
            // At the surface itself nothing can be split off but what its derivatives tell; panels that shrink towards
            // it are no kink.
            let is_narrow = !is_broken || wide < SHRINKING * top;
            if width < KINK && top > KINK * thickness && is_narrow {
                self.first_break = self.first_break.min(top);
            }
            see(fit.extremes.0);
            see(fit.extremes.1);
            // At the surface the law's slope counts, too.
            let (unit, matter) = if fit.is_smooth || is_noise || top == 0.0 {
                (fit.unit, Matter::Smooth(Box::new(Slices::new(&fit.coefficients, self.precision))))
            } else {
                let material = layer.material(law, start);
                (material.shear, Matter::Homogeneous(material, self.propagator(material)))
            };
            self.all.push(Panel { top, thickness: wide, unit, matter });
            if self.all.len() > MOST_PANELS {
                let reached = short(top);
                return Err(format!("the grading varies too fast: {MOST_PANELS} slices only reach y = {reached} h"));
            }
        }
        Ok(())
    }

    /// Of a slice of a material in units of its own modulus: that of a panel above which is made of the like.
    fn propagator(&self, material: Material) -> Arc<Propagator> {
        let like = |panel: &Panel| match &panel.matter {
            Matter::Homogeneous(own, propagator) if own.elastic == material.elastic => Some(Arc::clone(propagator)),
            _ => None,
        };
        let constants = Coefficients::of(material, material.shear);
        self.all
            .iter()
            .rev()
            .find_map(like)
            .unwrap_or_else(|| Arc::new(Propagator::new(self.precision, self.precision.thick, |_| constants)))
    }

    /// Adds what lies between the layer and a depth below it.
    pub(crate) fn extend(&mut self, substrate: Material, depth: f64) {
        let matter = Matter::Homogeneous(substrate, self.propagator(substrate));
        self.all.push(Panel { top: 1.0, thickness: depth - 1.0, unit: substrate.shear, matter });
    }

    /// Cuts the panel that holds a depth in two there; returns the number of panels above it.
    pub(crate) fn cut(&mut self, depth: f64) -> usize {
        let at = self.all.partition_point(|panel| panel.top + panel.thickness <= depth);
        if self.all.get(at).is_none_or(|panel| panel.top >= depth) {
            return at;
        }
        let parts = self.all[at].cut(depth);
        self.all.splice(at..=at, parts);
        at + 1
    }

    /// `int 8 mu/(1 + kappa) dy` and `int lambda dy` over the layer: how it resists being stretched as a whole, and how
    /// far it gives way to a pressure by that.
    pub(crate) fn membrane(&self) -> (f64, f64) {
        let mean = |polynomial: &Polynomial| -> f64 {
            let even = polynomial.coefficients().iter().step_by(2);
            even.zip(0..).map(|(c, k)| c / f64::from(2 * k + 1)).sum()
        };
        self.all.iter().fold((0.0, 0.0), |(stiffness, contraction), panel| {
            let (own, contracted) = match &panel.matter {
                Matter::Homogeneous(Material { elastic, .. }, _) => (8.0 / (1.0 + elastic.kappa), elastic.lambda()),
                Matter::Exponential(Material { elastic, .. }, gamma) => {
                    (8.0 / (1.0 + elastic.kappa) * gamma.exp_m1() / gamma, elastic.lambda())
                }
                Matter::Smooth(slices) => {
                    let Coefficients { stiffness, contraction, .. } = &slices.coefficients;
                    (mean(stiffness), mean(contraction))
                }
            };
            (stiffness + own * panel.unit * panel.thickness, contraction + contracted * panel.thickness)
        })
    }
}

/// The constants over one stretch of a law, as polynomials.
struct Fit {
    coefficients: Coefficients,
    unit: f64,
    /// Smallest and largest modulus seen.
    extremes: (f64, f64),
    is_smooth: bool,
    /// The largest of each constant.
    sizes: [f64; 4],
    /// The largest of what should be small, relative, where it is felt.
    error: f64,
}

impl Fit {
    /// Over depths from `start` on; `None` where the law is not finite.
    fn of(layer: &LayerModel, law: &dyn ModulusLaw, (start, width): (f64, f64), precision: &Precision) -> Option<Self> {
        let at = |x: f64| layer.material(law, start + 0.5 * width * (1.0 + x));
        let unit = at(0.0).shear;
        let mut values = [[0.0; 4]; MOST];
        let mut extremes = (f64::INFINITY, 0.0_f64);
        for (values, x) in values.iter_mut().zip(&Chebyshev::get().nodes) {
            let material = at(*x);
            extremes = (extremes.0.min(material.shear), extremes.1.max(material.shear));
            *values = Coefficients::of(material, unit);
        }
        if !values.iter().flatten().all(|value| value.is_finite()) {
            return None;
        }
        let (fitted, last) = Arch::new().dispatch(Through(&values, precision.dropped));
        let is_smooth = last.iter().all(|error| *error <= precision.fit.0);
        let [softness, stiffness, contraction, cross] = fitted;
        let coefficients = Coefficients { softness, stiffness, contraction, cross };
        let mut fit = Self { coefficients, unit, extremes, is_smooth, sizes: sizes(&values), error: 0.0 };
        fit.error = fit.felt(last);
        for x in BESIDE {
            let beside = fit.off(x, at(x));
            fit.is_smooth &= beside.iter().all(|error| *error <= precision.fit.1);
            fit.error = fit.error.max(fit.felt(beside));
        }
        Some(fit)
    }

    /// How far each constant is off that of a material, over its largest.
    fn off(&self, x: f64, material: Material) -> [f64; 4] {
        let (own, value) = (self.coefficients.at(x), Coefficients::of(material, self.unit));
        let off = |i: usize| if self.sizes[i] == 0.0 { 0.0 } else { (own[i] - value[i]).abs() / self.sizes[i] };
        std::array::from_fn(off)
    }

    /// What is felt of the relative errors of all constants: the largest.
    fn felt(&self, mut errors: [f64; 4]) -> f64 {
        if errors[CROSS] > 0.0 {
            errors[CROSS] *= self.sizes[CROSS] / self.sizes[CROSS].max(FAINT * self.sizes[SOFTNESS]);
        }
        errors.into_iter().fold(0.0, f64::max)
    }

    /// How far a constant is off at the first of the law's probes at which one is off by more than that.
    fn missed(&self, layer: &LayerModel, stretch: &Stretch, (start, width): (f64, f64), most: f64) -> Option<f64> {
        stretch.probes(start, start + width).iter().find_map(|depth| {
            let x = 2.0 * (depth - start) / width - 1.0;
            let off = self.felt(self.off(x, layer.material(stretch.law, *depth)));
            (off > most).then_some(off)
        })
    }
}

/// Chebyshev nodes, and what leads from values there to a polynomial.
struct Chebyshev {
    nodes: [f64; MOST],
    /// Rows: `cos(k theta_j)`.
    cosines: [[f64; MOST]; MOST],
    /// Columns: coefficients of `T_k`.
    powers: [[f64; MOST]; MOST],
}

impl Chebyshev {
    fn get() -> &'static Self {
        static CHEBYSHEV: OnceLock<Chebyshev> = OnceLock::new();
        CHEBYSHEV.get_or_init(|| {
            let angle = |j: usize| PI * (2 * j + 1) as f64 / (2 * MOST) as f64;
            let powers: [[f64; MOST]; MOST] = in_powers([0.0, 1.0]);
            Self {
                nodes: std::array::from_fn(|j| angle(j).cos()),
                cosines: std::array::from_fn(|k| std::array::from_fn(|j| (k as f64 * angle(j)).cos())),
                powers: std::array::from_fn(|j| std::array::from_fn(|k| powers[k][j])),
            }
        })
    }
}

/// The largest of each constant. The contraction counts beside 1, and its rounding is Poisson's ratio's: one that
/// vanishes is measured by a part of that.
fn sizes(values: &[[f64; 4]; MOST]) -> [f64; 4] {
    let least = std::array::from_fn(|i| if i == CONTRACTION { FAINT } else { 0.0 });
    values.iter().fold(least, |most, values| std::array::from_fn(|i| values[i].abs().max(most[i])))
}

/// The polynomials through values of four constants at the nodes, rounding dropped, and the last coefficients of their
/// series, relative.
struct Through<'a>(&'a [[f64; 4]; MOST], f64);

impl WithSimd for Through<'_> {
    type Output = ([Polynomial; 4], [f64; 4]);

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Self::Output {
        let Self(values, dropped) = self;
        let rule = Chebyshev::get();
        let sizes = sizes(values);
        // What varies alone, so that what does not vary is a constant.
        let level = values[MOST / 2];
        let varying = values.map(|values| std::array::from_fn(|i| values[i] - level[i]));
        let mut series = [[0.0; 4]; MOST];
        for (k, (series, cosines)) in series.iter_mut().zip(&rule.cosines).enumerate() {
            add_products(series, cosines, &varying);
            let scale = if k == 0 { 1.0 } else { 2.0 } / MOST as f64;
            *series = series.map(|c| c * scale);
        }
        series[0] = std::array::from_fn(|i| series[0][i] + level[i]);
        let mut last = [0.0_f64; 4];
        let mut counts = [1; 4];
        for (k, series) in series.iter_mut().enumerate() {
            for i in 0..4 {
                if k >= MOST - LAST && sizes[i] != 0.0 {
                    last[i] = last[i].max(series[i].abs() / sizes[i]);
                }
                if series[i].abs() > dropped * sizes[i] {
                    counts[i] = k + 1;
                }
            }
        }
        for (k, series) in series.iter_mut().enumerate() {
            *series = std::array::from_fn(|i| if k < counts[i] { series[i] } else { 0.0 });
        }
        let mut terms = [[0.0; 4]; MOST];
        for (term, powers) in terms.iter_mut().zip(&rule.powers) {
            add_products(term, powers, &series);
        }
        let polynomial = |i: usize| Polynomial::new(&terms.map(|term| term[i])[..counts[i]]);
        (std::array::from_fn(polynomial), last)
    }
}

/// `sum += factors values`, one after the other.
#[inline(always)]
fn add_products(sum: &mut [f64; 4], factors: &[f64; MOST], values: &[[f64; 4]; MOST]) {
    for (factor, value) in factors.iter().zip(values) {
        for i in 0..4 {
            sum[i] += factor * value[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::Compliance;
    use crate::fixtures::{Opaque, Probed, at, bonded, distance};
    use slipzone_api::Plane;

    type Law = fn(f64) -> f64;

    /// Films between the nodes of a panel, and at its end, and of a width that no node would meet: with none but the
    /// nodes asked, the layer was homogeneous.
    #[test]
    fn a_film_between_the_nodes_is_seen_by_a_probe() {
        let films: [(Law, &'static [f64]); 3] = [
            (|y| 1.0 - 0.999 * (-((y - 0.33) / 0.002).powi(2)).exp(), &[0.32, 0.34]),
            (|y| 1.0 - 0.999 * (-((y - 0.5003) / 2e-4).powi(2)).exp(), &[0.499, 0.5016]),
            (|y| 1.0 + 9.0 * (-(y / 4e-4).powi(2)).exp(), &[0.002]),
        ];
        for (modulus, breakpoints) in films {
            let probes = (0..=10_000).map(|i| f64::from(i) / 1e4).collect();
            let probed = Probed { law: Opaque { modulus, breakpoints: &[] }, probes };
            let probed = bonded(probed, Plane::Strain, 0.3);
            let told = bonded(Opaque { modulus, breakpoints }, Plane::Strain, 0.3);
            for s in [0.01, 1.0, 20.0] {
                let difference = distance(at(&Compliance {}, &probed, s), at(&Compliance {}, &told, s));
                assert!(difference < 1e-11, "{breakpoints:?}, s = {s}: {difference:e}"); // TOLERANCE
            }
        }
    }

    /// Whatever a law rounds to at its probes is no film: the panels are those of a law without any.
    #[test]
    fn probes_of_a_smooth_law_cost_no_panel() {
        let count = |modulus: Law, nu: f64, probes: usize| {
            let probes = (0..=probes).map(|i| i as f64 / probes as f64).collect();
            let law = Probed { law: Opaque { modulus, breakpoints: &[] }, probes };
            super::Panels::new(&bonded(law, Plane::Strain, nu), &crate::precision::FULL).unwrap().all.len()
        };
        for modulus in [|y| 1.0 + 3.0 * y, |y: f64| (1.0 + y / 0.01).powf(1.7), |y: f64| 5.0 + (30.0 * y).sin()] {
            for nu in [-0.9, 0.3, 0.499_999_99] {
                assert_eq!(count(modulus, nu, 1000), count(modulus, nu, 1), "nu = {nu}");
            }
        }
    }
}
