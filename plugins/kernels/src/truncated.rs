//! The Fourier integrals of CC13, cut at a finite wave number.

use crate::even_table::{self, EvenTable};
use crate::integrand::Integrand;
use crate::wave_numbers::{Samples, too_wide};
use serde::{Deserialize, Serialize};
use slipzone_api::{
    Component, KernelRequest, KernelStrategy, KernelTable, LayerResponse, Parts, PartsMut, Positive, Refusal,
    SurfaceFlexibility,
};
use spec_math::cephes64::sici;
use std::f64::consts::FRAC_PI_2;

/// CC13 eqs. 43, 44 over `[0, S]`, and the leading `1/s` of the tail beyond in closed form.
///
/// What is left of the tail falls like `1/s^2`, so the kernel's error falls like `1/S` in a
/// neighbourhood `|t| < 1/S` of the origin and like `1/S^2` in the tractions. The leading term brings the
/// jump of the odd kernels and the logarithm of the even one:
/// `int_S^inf sin(st)/s ds = pi/2 sign(t) - Si(St)`, `int_S^inf cos(st)/s ds = Cin(St) - euler - ln S - ln|t|`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Truncated {
    /// `S` times the depth that the surface feels (the thickness of a homogeneous or exponential
    /// layer); left out, the solver raises it until the error estimate is met.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cutoff: Option<Positive>,
    /// Added refinements, chosen by the solver.
    #[serde(skip)]
    level: u32,
}

slipzone_api::register!(Kernel, "truncated", "Fourier integral cut at a finite wave number, leading tail in closed form",
    example: "type = \"truncated\"\ncutoff = 80.0",
    parameters: [("cutoff", "wave number times thickness at which the integral is cut", false, [40.0, 80.0, 320.0], Positive)],
    source: "CC13 eqs. 43, 44");

/// Cut-off at level 0, over the depth: `exp(-2 S d)` is then below round-off.
const FIRST_CUTOFF: f64 = 20.0;
/// At level 0 the cut-off resolves at least this phase over the reach: what is left of the tail beyond
/// ripples with wavelength `2 pi/S`, which must be short beside the contact.
const FIRST_BAND: f64 = 16.0;
/// Nodes per panel of wave numbers at level 0; each level adds two, so that a twin judges the panels too.
const FIRST_NODES: usize = 14;
/// Most interpolation nodes per kernel: what a thin layer may cost.
const MOST_NODES: usize = 4096;

#[typetag::serde(name = "truncated")]
impl KernelStrategy for Truncated {
    fn tabulate(&self, response: &dyn LayerResponse, request: &KernelRequest) -> Result<Box<dyn KernelTable>, Refusal> {
        let depth = crate::depth(response)?;
        let scale = f64::from(1_u32 << self.level.min(20));
        let chosen = (FIRST_CUTOFF / depth).max(FIRST_BAND / request.reach);
        let cutoff = match self.cutoff.map(|cutoff| cutoff.get() / depth) {
            // Below the first cut-off chosen, doubling gains little: a twin could not judge its coarser self.
            Some(given) if self.level > 0 => given.max(chosen) * scale,
            Some(given) => given,
            None => chosen * scale,
        };
        let per_panel = FIRST_NODES + 2 * self.level as usize;
        let samples = Samples::up_to(cutoff, response, depth, request.reach, per_panel)?;
        let band = samples.cutoff * request.reach;
        // Chebyshev coefficients of cos(band x) fall off beyond k = band, over a width of band^(1/3).
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a positive count; `as` saturates
        let nodes = (0.5 * (band + 8.0 * band.cbrt()) + 14.0).ceil() as usize;
        if nodes > MOST_NODES {
            return Err(too_wide(request.reach, cutoff));
        }
        let integral = Integral {
            samples: &samples,
            response,
            tail: response.tail(1).first().copied().unwrap_or_default(),
            pole: response.pole(),
        };
        let kernels = integral.tabulate(request.components, request.reach, nodes);
        Ok(Box::new(Table { kernels, length: depth, flexibility_evaluations: samples.s.len() }))
    }

    fn refined(&self, level: u32) -> Box<dyn KernelStrategy> {
        Box::new(Self { level: self.level + level, ..self.clone() })
    }

    fn is_pinned(&self) -> bool {
        self.cutoff.is_some()
    }
}

/// One layer's flexibility on the wave numbers, and what is known beyond them.
struct Integral<'a> {
    samples: &'a Samples,
    response: &'a dyn LayerResponse,
    tail: SurfaceFlexibility,
    /// Of `s Fuu/A0` at the origin: taken off, its transform is a jump alone.
    pole: f64,
}

impl Integral<'_> {
    /// All kernels at once: the waves at one `s` and `t` serve each of them.
    fn tabulate(&self, components: &[Component], reach: f64, nodes: usize) -> Vec<Kernel> {
        let weighted: Vec<Vec<f64>> = components.iter().map(|c| self.weighted(*c)).collect();
        let abscissae = even_table::nodes(reach, nodes);
        let mut values = vec![Vec::with_capacity(nodes); components.len()];
        let mut waves = vec![(0.0, 0.0); self.samples.s.len()];
        for &t in &abscissae {
            for (wave, s) in waves.iter_mut().zip(&self.samples.s) {
                *wave = (s * t).sin_cos();
            }
            for ((component, weighted), values) in components.iter().zip(&weighted).zip(&mut values) {
                values.push(self.smooth(*component, weighted, &waves, t));
            }
        }
        let kernel = |(&component, values): (&Component, &Vec<f64>)| Kernel {
            component,
            tail: self.tail_of(component),
            pole: self.pole_of(component),
            smooth: EvenTable::through(reach, self.samples.cutoff, values),
        };
        components.iter().zip(&values).map(kernel).collect()
    }

    fn tail_of(&self, component: Component) -> f64 {
        match component {
            Component::NormalSlope | Component::Depth => self.tail.vv,
            Component::ShearStrain => self.tail.uu - self.pole,
            Component::Coupling => self.tail.uv,
        }
    }

    fn pole_of(&self, component: Component) -> f64 {
        if component == Component::ShearStrain { self.pole } else { 0.0 }
    }

    /// Gauss weight times what stands before the wave, at each wave number.
    fn weighted(&self, component: Component) -> Vec<f64> {
        let integrand = Integrand::new(component, self.response);
        let nodes = self.samples.s.iter().zip(&self.samples.weight).zip(&self.samples.flexibility);
        nodes.map(|((s, weight), f)| weight * integrand.weight(*s, f)).collect()
    }

    /// The smooth part at `t > 0`, divided by `t` for an odd kernel.
    fn smooth(&self, component: Component, weighted: &[f64], waves: &[(f64, f64)], t: f64) -> f64 {
        let (tail, cutoff) = (self.tail_of(component), self.samples.cutoff);
        let terms = weighted.iter().zip(waves);
        if component.is_odd() {
            let sum: f64 = terms.map(|(m, (sin, _))| m * sin).sum();
            return (sum - tail * sici(cutoff * t).0) / t;
        }
        let sum: f64 = terms.map(|(m, (_, cos))| m * cos).sum();
        let (si, ci) = sici(cutoff * t);
        let beyond = match component {
            Component::Depth => (cutoff * t).cos() / cutoff + t * si,
            _ => t.ln() - ci, // Cin(St) - euler - ln S
        };
        sum + tail * beyond
    }
}

/// One kernel: the interpolant of its smooth part (over `t` for an odd kernel) and its leading tail.
struct Kernel {
    component: Component,
    tail: f64,
    pole: f64,
    smooth: EvenTable,
}

impl Kernel {
    fn parts(&self, t: f64, even: f64) -> Parts {
        match self.component {
            Component::NormalSlope | Component::ShearStrain => {
                Parts { smooth: t * even, sign: (self.tail + self.pole) * FRAC_PI_2, log: 0.0 }
            }
            Component::Coupling => Parts { smooth: even, sign: 0.0, log: -self.tail },
            // int_0^inf [1 - exp(-s)] cos(st)/s ds = 1/2 log(1 + 1/t^2), the length being the thickness.
            Component::Depth => {
                Parts { smooth: even + 0.5 * (t * t).ln_1p(), sign: -self.tail * FRAC_PI_2 * t, log: -1.0 }
            }
        }
    }
}

/// The tabulated kernels of one layer.
struct Table {
    kernels: Vec<Kernel>,
    length: f64,
    flexibility_evaluations: usize,
}

impl KernelTable for Table {
    fn parts_into(&self, component: Component, distances: &[f64], out: PartsMut) {
        let kernel = self.kernels.iter().find(|kernel| kernel.component == component);
        let kernel = kernel.unwrap_or_else(|| panic!("{component:?} was not requested"));
        out.fill(distances, |t| kernel.parts(t, kernel.smooth.at(t)));
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn flexibility_evaluations(&self) -> usize {
        self.flexibility_evaluations
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests;
