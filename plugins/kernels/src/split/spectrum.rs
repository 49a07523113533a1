//! The integral over `[0, S]`: Legendre series of what stands before the wave, panel by panel.

use super::column::Column;
use super::legendre::{self, End, LARGEST_NOISE, Legendre, Panel, Size};
use super::powers::Moments;
use crate::legendre_waves::add_transforms;
use num_complex::Complex64;
use slipzone_api::{LayerResponse, Refusal, SurfaceFlexibility};

/// `int_0^S W(s) exp(ist) ds` for each kernel.
///
/// On each panel `W = sum_l w_l P_l` with `int_{-1}^{1} P_l(x) exp(i w x) dx = 2 i^l j_l(w)` (DLMF 10.54.2), so
/// the flexibility is sampled as its own shape asks, not as the wave does. With Gauss nodes a slow wave
/// gets the sum that Gauss quadrature would give: resolved by half as many nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct Spectrum {
    panels: Vec<Panel>,
    pub(super) kernels: Vec<Told>,
    /// Wave numbers asked for, the failed panels' included.
    pub(super) evaluations: usize,
}

/// What all panels tell of one kernel.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Told {
    /// Bound on what is unresolved.
    pub(super) error: f64,
    /// What of it is the flexibility's own noise.
    pub(super) noise: f64,
    pub(super) size: Size,
}

/// Part of the error that each panel may have: most often there are two.
const SHARE: f64 = 0.35;
/// Nodes that a panel takes, fitted to some thousand layers: enough for nine out of ten: another try costs as many
/// again.
#[derive(Clone, Copy)]
struct Guess {
    least: f64,
    /// By digit wanted.
    digit: f64,
    /// By digit and by the gradient of a surface that is stiffer than what lies below it, or softer.
    stiff: f64,
    soft: f64,
    /// By digit and by `beta`.
    beta: f64,
}
const FIRST: Guess = Guess { least: 0.8, digit: 2.0, stiff: 0.45, soft: 0.07, beta: 0.65 };
const SECOND: Guess = Guess { least: 6.0, digit: 1.38, stiff: 0.08, soft: 0.025, beta: 0.2 };
/// Nodes added by each unit of the wave's phase over half a panel, and the phase by digit from which the orders of the
/// panel itself are all that counts.
const NODES_BY_PHASE: f64 = 0.7;
const FAST: f64 = 1.7;
/// Fewest and most nodes of a panel.
const NODES: (usize, usize) = (8, legendre::MOST);
/// A panel that fails is sampled anew where up to this many times its nodes should do, and divided otherwise.
const ANEW: f64 = 1.7;
/// Beyond this distance the waves are fast for every panel, or the kernel is nothing but `-1/t`: a surface 1e4 times
/// stiffer than the base feels its edge over 160 thicknesses.
const FAR: f64 = 400.0;
/// A first panel that fails is cut here: towards the origin the structure of a strong gradient is finer.
const FIRST_SPLIT: f64 = 0.2;
/// Where the first panel is looked at beside its nodes, over its width.
const BESIDE_ORIGIN: f64 = 1e-4;
/// The same over the inverse of the solid's extent, where that is less. A datum of 2e-5 thicknesses made the first
/// panel so wide that all of what the layer is lay beside its place: the indentation was that of a half-plane, 16 % to
/// 100 % off.
const BESIDE_EXTENT: f64 = 0.1;
/// Most wave numbers for one table.
const MOST_SAMPLES: usize = 4096;

impl Spectrum {
    /// Samples `[0, cutoff]`, where the flexibility is `at_cutoff`; `gradient` is the surface's `mu'/mu`.
    pub(super) fn new(
        columns: &[Column],
        response: &dyn LayerResponse,
        (cutoff, at_cutoff): (f64, SurfaceFlexibility),
        (reach, gradient): (f64, f64),
        summed: bool,
    ) -> Result<Self, Refusal> {
        let mut spectrum =
            Self { panels: Vec::with_capacity(2), kernels: vec![Told::default(); columns.len()], evaluations: 1 };
        let aim = columns.iter().map(|column| column.aim).fold(f64::INFINITY, f64::min);
        let reach = reach.min(FAR);
        let digits = -aim.log10();
        let beta = response.elastic().beta();
        let nodes = |width: f64, guess: Guess| {
            let by_digit =
                guess.digit + guess.stiff * (-gradient).max(0.0) - guess.soft * gradient.max(0.0) - guess.beta * beta;
            let phase = (0.5 * width * reach).min(FAST * digits);
            even(guess.least + digits * by_digit + NODES_BY_PHASE * phase)
        };
        let of_extent = response.extent().map_or(f64::INFINITY, |extent| BESIDE_EXTENT / extent);
        let beside_origin = |width: f64| (BESIDE_ORIGIN * width).min(of_extent);
        let origin = End::new(response, 0.0, beside_origin(FIRST_SPLIT * cutoff))?;
        let end = End { s: cutoff, at: cutoff, flexibility: at_cutoff };
        let middle = End::new(response, FIRST_SPLIT * cutoff, FIRST_SPLIT * cutoff)?;
        spectrum.evaluations += 1;
        let mut stack: Vec<(End, End, usize, f64, bool)> = vec![
            (middle, end, nodes(end.s - middle.s, SECOND), f64::INFINITY, false),
            (origin, middle, nodes(middle.s, FIRST), f64::INFINITY, false),
        ];
        while let Some((lower, upper, nodes, before, was_noisy)) = stack.pop() {
            let (panel, resolved) = Legendre::of(nodes).sample(columns, response, lower, upper, (reach, summed))?;
            spectrum.evaluations += nodes;
            // In units of the aim; of noise nothing more is expected, once a finer panel finds it, too: what a faint
            // break sends back may be as small.
            let noisy = resolved.iter().any(|resolved| resolved.noisy);
            let missed = columns.iter().zip(&resolved).filter(|(_, resolved)| !(resolved.noisy && was_noisy));
            let worst = missed.map(|(column, resolved)| resolved.error / column.aim).fold(0.0, f64::max);
            let stalled = worst > STALL * before && resolved.iter().all(|resolved| resolved.error < LARGEST_NOISE);
            let given_up = spectrum.evaluations + nodes > MOST_SAMPLES || upper.s - lower.s < cutoff * 1e-6;
            if worst <= SHARE || stalled || given_up {
                spectrum.panels.push(panel);
                for (told, resolved) in spectrum.kernels.iter_mut().zip(&resolved) {
                    told.error += resolved.error;
                    told.noise += if resolved.noisy && was_noisy || stalled { resolved.error } else { 0.0 };
                    told.size.whole += resolved.size.whole;
                    told.size.roughened += resolved.size.roughened;
                }
                continue;
            }
            // Under a slow wave the error falls by two factors for each node.
            let factor = resolved.iter().map(|resolved| resolved.ratio).fold(0.0, f64::max);
            let by_node = if 0.5 * (upper.s - lower.s) * reach < 0.5 * nodes as f64 { 2.0 } else { 1.0 };
            let needed = nodes as f64 + 1.0 - (worst / SHARE).ln() / (by_node * factor.ln());
            if needed <= (ANEW * nodes as f64).min(NODES.1 as f64) {
                let needed = even(needed.max(nodes as f64 + 2.0));
                stack.push((lower, upper, needed, worst, noisy));
                continue;
            }
            let at = if lower.s == 0.0 { FIRST_SPLIT * upper.s } else { f64::midpoint(lower.s, upper.s) };
            let middle = End::new(response, at, at)?;
            spectrum.evaluations += 1;
            stack.push((middle, upper, nodes, worst, noisy));
            // Beside the origin, as the narrower panel sees it.
            let lower = if lower.s == 0.0 { End::new(response, 0.0, beside_origin(at))? } else { lower };
            stack.push((lower, middle, nodes, worst, noisy));
        }
        Ok(spectrum)
    }

    /// `int_0^S W(s) (s/S)^m ds` of one kernel as its nodes give it, and the sum of the terms' sizes: for each odd or
    /// each even `m`.
    pub(super) fn moments(&self, column: usize, odd: bool, cutoff: f64) -> Moments {
        let first = self.panels.iter().flat_map(|panel| {
            let weighted = panel.weighted(column).iter().map(|weighted| panel.half * weighted);
            panel.nodes.iter().zip(weighted).map(|(s, weighted)| {
                let x = s / cutoff;
                (x, if odd { weighted * x } else { weighted })
            })
        });
        Moments::new(self.panels.iter().map(|panel| panel.nodes.len()).sum(), first)
    }

    /// The panels, in no order.
    pub(super) fn panels(&self) -> &[Panel] {
        &self.panels
    }

    /// Longest series of a panel.
    pub(super) fn terms(&self) -> usize {
        self.panels.iter().flat_map(Panel::waves).map(<[f64]>::len).max().unwrap_or(0)
    }

    /// Adds the transforms at `t` to `out`; `scratch` holds [`Self::terms`] numbers.
    pub(super) fn add(&self, t: f64, scratch: &mut [f64], out: &mut [Complex64]) {
        for panel in &self.panels {
            add_transforms((panel.middle, panel.half), panel.waves(), t, scratch, out);
        }
    }
}

/// A panel that was refined and has not come below this part of its error is as good as it gets.
const STALL: f64 = 0.3;

/// `mu'/mu` at the surface, as far as the series tells: the first coefficient of `s Fuu/A0` is `-mu'/(2 mu)`.
pub(super) fn surface_gradient(tail: &[SurfaceFlexibility]) -> f64 {
    tail.first().map_or(0.0, |c| -2.0 * c.uu)
}

/// The even number of nodes at or above `wanted`, within the bounds.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // `as` saturates
fn even(wanted: f64) -> usize {
    (wanted.ceil() as usize).clamp(NODES.0, NODES.1).next_multiple_of(2)
}
