//! Kernels split into what is singular, known exactly, and a smooth rest.

mod beyond;
mod column;
mod exponential_integral;
mod felt;
mod legendre;
mod pieces;
mod power_series;
mod powers;
mod singular;
mod spectrum;
mod waves;

use crate::piece::{MOST_NODES, Pieces, worst};
use crate::table::Table;
use beyond::{Beyond, Cut, MOST_TERMS};
use column::Column;
use felt::Felt;
use num_complex::Complex64;
use pieces::Plan;
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};
use singular::Singular;
use slipzone_api::{
    Component, KernelRequest, KernelStrategy, KernelTable, LayerResponse, Positive, Refusal, SurfaceFlexibility,
};
use spectrum::{Spectrum, surface_gradient};
use std::f64::consts::FRAC_PI_2;
use std::num::NonZeroU8;
use waves::Waves;

/// The Fourier integral over `[0, S]` and, beyond, the whole series of `s F` in `1/s`, transformed exactly.
///
/// `k(t) = int_0^S M(s) sin(st) ds + sum_k c_k int_S^inf s^-k sin(st) ds`, and with a cosine for the even kernels. The
/// first integral is analytic in `t`; the second is `Im P(t) (i pi/2 - log t)`, `P = sum_k c_k (it)^(k-1)/(k-1)!`, plus
/// a power series (`t > 0`). So jump and logarithm are known to all orders and the rest is smooth: on short reaches a
/// power series as well, on others interpolated. Its tables bound their own error: `S`, the number of terms and the
/// wave numbers follow from the accuracy wanted.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Split {
    /// `S` times the depth that the surface feels; left out, chosen by the accuracy.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cutoff: Option<Positive>,
    /// Terms of the series used beyond `S`, at most 40 and as many as the grading tells; left out, chosen
    /// by the accuracy.
    #[serde(default, deserialize_with = "terms", skip_serializing_if = "Option::is_none")]
    pub terms: Option<NonZeroU8>,
}

slipzone_api::register!(Kernel, "split", "Fourier integral up to a wave number, series in 1/s beyond; jump and logarithm split off exactly",
    example: "type = \"split\"",
    parameters: [
        ("cutoff", "wave number times the depth that the surface feels, at which the series takes over", false, [10.0, 14.0, 40.0], Positive),
        ("terms", "terms of the series, 1 to 40", false, [8.0, 14.0, 22.0], Whole(1, 40)),
    ],
    source: "docs/theory.md section 3");

/// Reads `terms`; more than are ever asked for would not be used.
fn terms<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<NonZeroU8>, D::Error> {
    let Some(terms) = Option::<u8>::deserialize(deserializer)? else { return Ok(None) };
    let allowed = NonZeroU8::new(terms).filter(|terms| usize::from(terms.get()) <= MOST_TERMS);
    let refused = || D::Error::custom(format!("expected an integer from 1 to {MOST_TERMS}, found {terms}"));
    allowed.map(Some).ok_or_else(refused)
}

/// Terms of the series asked for at first: most often enough, and they cost as their square.
const FEW_TERMS: usize = 16;
/// Times the aim is tightened when the bound misses the accuracy, and by how much; or loosened where that is more than
/// can be told.
const ATTEMPTS: (u32, f64) = (6, 0.1);
/// By how much nearer structure is looked for when the cut leaves too much.
const NEARER: f64 = 0.4;
/// Rounding of a sum: this times the sum of its terms' sizes.
const ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Up to this phase at the cut no panel sees more waves than its nodes tell: sums over them are the transform.
const SLOW: f64 = 32.0;
/// Rounding of a wave by that of its phase, over the phase.
const PHASE: f64 = 2.0 * f64::EPSILON;
/// Rounding of `s F` that a flexibility may bring, over its size.
const ROUNDING_OF_FLEXIBILITY: f64 = 32.0 * f64::EPSILON;
/// Error that a flexibility is allowed, over what is wanted of the slopes and the depth that it feels, over what is
/// wanted of the depth, and at most.
const ROUGHNESS: (f64, f64) = (3e-3, 1e-2);
const ROUGHEST: f64 = 1e-11;
/// What is left of the depth's integrand beyond the cut is smaller than the slope's by `1/S`, at least by this.
const DEPTH_GAIN: f64 = 4.0;
/// Where `exp(-2 s d)` makes a kernel singular, in terms of `d`: at this times `i d`.
const ECHO: f64 = 2.0;
/// First width of the pieces over the depth, and over the window.
const WIDTH: (f64, f64) = (0.5, 0.7);

#[typetag::serde(name = "split")]
impl KernelStrategy for Split {
    fn tabulate(&self, response: &dyn LayerResponse, request: &KernelRequest) -> Result<Box<dyn KernelTable>, Refusal> {
        let felt = self.felt(response, request)?;
        let (mut depth, mut accuracy, mut evaluations) = (felt.depth, request.accuracy, felt.evaluations);
        let mut best: Option<Draft> = None;
        let (mut attempts, mut may_be_rough) = (ATTEMPTS.0, !self.is_pinned());
        while attempts > 0 {
            let mut draft = self.drafted(response, request, depth, accuracy, may_be_rough)?;
            evaluations += draft.evaluations;
            draft.error += felt.left;
            let too_rough = draft.roughened > 0.5 * request.accuracy;
            let rounded = draft.rounding > 0.5 * request.accuracy;
            let is_covered = draft.error.is_finite();
            // The grading has structure closer to the surface than it seemed, and that shows above rounding.
            let is_deep = is_covered && draft.beyond > 0.5 * request.accuracy.max(draft.rounding);
            if is_deep {
                depth *= NEARER;
            }
            let noise = draft.rounding;
            if best.as_ref().is_none_or(|best| draft.error < best.error) {
                best = Some(draft);
            }
            if !is_covered && !self.is_pinned() {
                if best.as_ref().is_some_and(|best| best.error.is_finite()) {
                    break;
                }
                // Where what was covered is noisier than the loosest of them would allow, more attempts are vain.
                if noise > accuracy / ATTEMPTS.1.powi(attempts.cast_signed() - 1) {
                    break;
                }
                // Noise passes for structure, and pieces ever narrower do not cover the reach.
                (attempts, accuracy) = (attempts - 1, accuracy / ATTEMPTS.1);
                continue;
            }
            let error = best.as_ref().map_or(f64::INFINITY, |best| best.error);
            if error <= request.accuracy {
                break;
            }
            // It is on a soft base, where the flexibility is large: as well as can be, then.
            if too_rough {
                may_be_rough = false;
                continue;
            }
            if rounded && !is_deep || accuracy > request.accuracy || self.is_pinned() {
                break;
            }
            (attempts, accuracy) = (attempts - 1, accuracy * ATTEMPTS.1);
        }
        let draft = best.expect("at least one attempt");
        if !draft.error.is_finite() {
            return Err(Refusal::OutOfReach {
                method: "split",
                why: format!("the kernel is too rough beside t = 0 to be told to {:.0e}", request.accuracy),
                remedy: "ask for a coarser tolerance, or take the kernel strategy `octaves` and the quadrature `graded-panels`",
            });
        }
        Ok(Box::new(Table::new(
            request.components,
            draft.pieces,
            request.reach,
            (draft.length, None),
            draft.error,
            evaluations,
        )))
    }

    fn refined(&self, _level: u32) -> Box<dyn KernelStrategy> {
        Box::new(self.clone())
    }

    fn is_pinned(&self) -> bool {
        self.cutoff.is_some() || self.terms.is_some()
    }
}

/// One attempt at the tables.
struct Draft {
    pieces: Pieces,
    length: f64,
    /// In the terms of the request.
    error: f64,
    /// The part of it that no effort removes.
    rounding: f64,
    /// The part that a cut further out removes.
    beyond: f64,
    /// The part that a better flexibility removes.
    roughened: f64,
    evaluations: usize,
}

impl Split {
    /// One attempt, by a flexibility that is not told better than it need be where it `may_be_rough`.
    fn drafted(
        &self,
        response: &dyn LayerResponse,
        request: &KernelRequest,
        depth: f64,
        accuracy: f64,
        may_be_rough: bool,
    ) -> Result<Draft, Refusal> {
        // The flexibility's own error is to be a small part of the whole.
        let (slope, value) = (ROUGHNESS.0 * depth * accuracy / request.reach, ROUGHNESS.1 * accuracy);
        let roughness = slope.min(value).min(ROUGHEST);
        match if may_be_rough { response.roughly(roughness) } else { None } {
            Some(rough) => self.draft(rough, request, depth, (accuracy, roughness)),
            None => self.draft(response, request, depth, (accuracy, 0.0)),
        }
    }

    fn draft(
        &self,
        response: &dyn LayerResponse,
        request: &KernelRequest,
        depth: f64,
        (accuracy, roughness): (f64, f64),
    ) -> Result<Draft, Refusal> {
        let reach = request.reach;
        let mut plan = self.plan(response, request, depth, (accuracy, roughness), FEW_TERMS);
        let mut short = plan.settled && power_series::serve(&plan.columns, plan.cut, depth, reach);
        if !short {
            plan = self.plan(response, request, depth, (accuracy, roughness), MOST_TERMS);
            short = power_series::serve(&plan.columns, plan.cut, depth, reach);
        }
        let Integral { columns, cut, gradient, .. } = plan;
        let (beyond_error, at_cutoff) = cut.rest(&columns, response, depth)?;
        let slow = cut.cutoff * reach <= SLOW;
        let spectrum = Spectrum::new(&columns, response, (cut.cutoff, at_cutoff), (reach, gradient), short || slow)?;
        let beyond = Beyond::new(cut, &columns);
        let mut rounded: Vec<f64> = (0..columns.len())
            .map(|i| {
                let phase = if slow && !short { PHASE * cut.cutoff * reach } else { 0.0 };
                (ROUNDING_OF_FLEXIBILITY + phase) * spectrum.kernels[i].size.whole
                    + ROUNDING * beyond.size(i)
                    + 2.0 * f64::EPSILON * cut.cutoff
            })
            .collect();
        let (pieces, length) = if short {
            let (pieces, powers) = power_series::pieces(&columns, &spectrum, &beyond, reach);
            for (rounded, powers) in rounded.iter_mut().zip(powers) {
                *rounded += powers;
            }
            (pieces, depth)
        } else {
            let thickness = response.thickness().unwrap_or(depth);
            let is_local = response.surface(0.0)? == SurfaceFlexibility::default() && response.pole() == 0.0;
            interpolated(&columns, (&spectrum, slow), &beyond, &rounded, (depth, thickness), (reach, is_local))
        };
        let (mut error, mut rounding, mut left, mut roughened) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
        for (i, column) in columns.iter().enumerate() {
            let scale = if column.component == Component::Depth { 1.0 } else { reach };
            let of_spectrum = &spectrum.kernels[i];
            rounding = worst(rounding, scale * (rounded[i] + pieces.kernels[i].noise + of_spectrum.noise));
            left = worst(left, scale * beyond_error[i]);
            roughened = worst(roughened, scale * of_spectrum.size.roughened);
            let of_all = beyond_error[i] + of_spectrum.error + of_spectrum.size.roughened + pieces.kernels[i].error;
            error = worst(error, scale * (of_all + rounded[i]));
        }
        Ok(Draft {
            pieces,
            length,
            error,
            rounding,
            beyond: left,
            roughened,
            evaluations: spectrum.evaluations + beyond::CHECKS,
        })
    }
}

impl Split {
    /// How deep the surface's own law goes on.
    fn felt(&self, response: &dyn LayerResponse, request: &KernelRequest) -> Result<Felt, Refusal> {
        let nearest = crate::depth(response)?;
        // Past a deeper one there would be little to gain, and of a law that is smooth nothing comes back.
        let is_shallow = |thickness: &f64| response.breaks() && felt::NEARER * nearest < *thickness;
        let thickness = response.thickness().filter(|thickness| is_shallow(thickness) && !self.is_pinned());
        let Some(thickness) = thickness else { return Ok(Felt::down_to(nearest)) };
        let plan = self.plan(response, request, thickness, (request.accuracy, 0.0), FEW_TERMS);
        Felt::of(response, (&plan.columns, plan.cut), (nearest, thickness), (request.accuracy, request.reach))
    }
}

/// What is to be integrated, and how.
struct Integral {
    columns: Vec<Column>,
    cut: Cut,
    /// `mu'/mu` at the surface.
    gradient: f64,
    /// Whether as many terms of the series as were asked for are enough.
    settled: bool,
}

impl Split {
    fn plan(
        &self,
        response: &dyn LayerResponse,
        request: &KernelRequest,
        depth: f64,
        (accuracy, roughness): (f64, f64),
        terms: usize,
    ) -> Integral {
        let tail = response.tail(terms);
        let column = |c: &Component| Column::new(*c, response, &tail, accuracy, request.reach).roughened(roughness);
        let columns: Vec<Column> = request.components.iter().map(column).collect();
        let slope_aim =
            columns.iter().map(|c| if c.component == Component::Depth { DEPTH_GAIN * c.aim } else { c.aim });
        let (mut cut, settled) = Cut::choose(&tail, depth, slope_aim.fold(f64::INFINITY, f64::min));
        if response.pole() != 0.0 {
            // What is left of a column without its pole `c/s` is `-c/s`: the series' first term, whatever the tail
            // says.
            cut.terms = cut.terms.max(tail.len().min(1));
        }
        if let Some(cutoff) = self.cutoff {
            cut.cutoff = cutoff.get() / depth;
        }
        if let Some(terms) = self.terms {
            cut.terms = usize::from(terms.get()).min(tail.len());
        }
        Integral { columns, cut, gradient: surface_gradient(&tail), settled: settled && !self.is_pinned() }
    }
}

/// The kernels by interpolation, and the shortest length over which their parts vary.
fn interpolated(
    columns: &[Column],
    (spectrum, slow): (&Spectrum, bool),
    beyond: &Beyond,
    rounded: &[f64],
    (depth, thickness): (f64, f64),
    (reach, is_local): (f64, bool),
) -> (Pieces, f64) {
    let aim = columns.iter().map(|column| column.aim).fold(f64::INFINITY, f64::min);
    let singular: Vec<Singular> = columns.iter().map(|column| Singular::new(column, thickness, reach)).collect();
    let window = singular.iter().map(Singular::width).fold(f64::INFINITY, f64::min);
    let plan = Plan {
        reach,
        is_local,
        width: if window.is_finite() || reach > depth { (WIDTH.0 * depth).min(WIDTH.1 * window) } else { reach },
        widest: (WIDTH.0 * thickness).min(WIDTH.1 * window),
        local: if window.is_finite() { singular.iter().map(Singular::gone).fold(0.0, f64::max) } else { 0.0 },
        kernels: columns
            .iter()
            .zip(rounded)
            .map(|(column, rounded)| (column.component.is_odd(), rounded.max(0.1 * column.aim)))
            .collect(),
    };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small positive count
    let nodes = (5.0 - aim.log10()).clamp(6.0, MOST_NODES as f64) as usize;
    let digits = beyond.digits(columns);
    let waves = slow.then(|| Waves::new(columns, spectrum));
    let mut bessel = vec![0.0; if slow { 0 } else { spectrum.terms() }];
    let mut sums = vec![0.0; columns.len()];
    let mut integrals = vec![Complex64::default(); beyond.terms()];
    let mut transforms = vec![Complex64::default(); columns.len()];
    let pieces = Pieces::new(&plan, nodes, |t, out| {
        transforms.fill(Complex64::default());
        sums.fill(0.0);
        match &waves {
            Some(waves) => waves.add(t, &mut sums),
            None => spectrum.add(t, &mut bessel, &mut transforms),
        }
        beyond.add((t, digits), &mut integrals, &mut transforms);
        let each = out.iter_mut().zip(&transforms).zip(&sums).zip(columns).zip(&singular);
        for ((((out, transform), sum), column), singular) in each {
            let value = if column.component.is_odd() { transform.im + FRAC_PI_2 * column.pole } else { transform.re };
            let (sign, log) = singular.at(t);
            *out = [sum + value - sign - t.ln() * log, sign, log];
        }
    });
    // What the depth sends back is singular at twice its distance, windows before that.
    let nearest = if window.is_finite() || reach <= depth { depth } else { ECHO * depth };
    (pieces, nearest.min(window))
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests;
