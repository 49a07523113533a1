//! The integral over `[0, S]`: Legendre series of what stands before the wave, panel by panel.

use super::column::Column;
use super::spherical_bessel;
use bilby::GaussLegendre;
use num_complex::Complex64;
use slipzone_api::{LayerResponse, Refusal, SurfaceFlexibility};

/// One stretch of wave numbers.
#[derive(Clone, Debug)]
struct Panel {
    middle: f64,
    half: f64,
    /// Per kernel: `2 half` times the Legendre coefficients, with the signs of `i^l` put in (real for even
    /// `l`, imaginary for odd).
    waves: Vec<Vec<f64>>,
}

/// `int_0^S W(s) exp(ist) ds` for each kernel.
///
/// On each panel `W = sum_l w_l P_l` with `int_{-1}^{1} P_l(x) exp(i w x) dx = 2 i^l j_l(w)` (DLMF 10.54.2), so
/// the flexibility is sampled as its own shape asks, not as the wave does. With Gauss nodes a slow wave
/// gets the sum that Gauss quadrature would give: resolved by half as many nodes.
#[derive(Clone, Debug, Default)]
pub(super) struct Spectrum {
    panels: Vec<Panel>,
    /// Bound on what is unresolved, per kernel.
    pub(super) error: Vec<f64>,
    /// What of it is the flexibility's own noise.
    pub(super) noise: Vec<f64>,
    /// `int_0^S |W| ds`, per kernel.
    pub(super) size: Vec<f64>,
    /// Wave numbers asked for, the failed panels' included.
    pub(super) evaluations: usize,
}

/// Part of the error that each panel may have: most often there are two.
const SHARE: f64 = 0.15;
/// Nodes of a panel by digit wanted, under a slow wave and under a fast one.
const NODES_BY_DIGIT: (f64, f64) = (2.0, 3.6);
/// Fewest and most nodes of a panel.
const NODES: (f64, f64) = (6.0, 56.0);
/// Phase of the wave over half a panel up to which it is slow.
const SLOW: f64 = 8.0;
/// Beyond this distance the waves are fast anyway, or the kernel is nothing but `-1/t`.
const FAR: f64 = 32.0;
/// A first panel that fails is cut here: towards the origin the structure of a strong gradient is finer.
const FIRST_SPLIT: f64 = 0.2;
/// Most wave numbers for one table.
const MOST_SAMPLES: usize = 4096;

impl Spectrum {
    /// Samples `[0, cutoff]`, where the flexibility is `at_cutoff`.
    pub(super) fn new(
        columns: &[Column],
        response: &dyn LayerResponse,
        cutoff: f64,
        at_cutoff: SurfaceFlexibility,
        reach: f64,
    ) -> Result<Self, Refusal> {
        let mut spectrum = Self {
            panels: Vec::new(),
            error: vec![0.0; columns.len()],
            noise: vec![0.0; columns.len()],
            size: vec![0.0; columns.len()],
            evaluations: 1,
        };
        let aim = columns.iter().map(|column| column.aim).fold(f64::INFINITY, f64::min);
        let reach = reach.min(FAR);
        let slow = 0.5 * reach * cutoff <= SLOW;
        let by_digit = if slow { NODES_BY_DIGIT.0 } else { NODES_BY_DIGIT.1 };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a small positive count
        let nodes = (-by_digit * aim.log10()).ceil().clamp(NODES.0, NODES.1) as usize;
        let rule = Legendre::new(nodes);
        let origin = (0.0, response.surface(0.0)?);
        let end = (cutoff, at_cutoff);
        let middle = (FIRST_SPLIT * cutoff, response.surface(FIRST_SPLIT * cutoff)?);
        spectrum.evaluations += 1;
        let mut stack = vec![(middle, end, f64::INFINITY), (origin, middle, f64::INFINITY)];
        while let Some((lower, upper, before)) = stack.pop() {
            let Sampled { panel, error, size, noisy } = rule.sample(columns, response, lower, upper, reach)?;
            spectrum.evaluations += nodes;
            // In units of the aim.
            let worst = columns.iter().zip(&error).map(|(column, error)| error / column.aim).fold(0.0, f64::max);
            let stalled = noisy || (worst > STALL * before && error.iter().all(|error| *error < LARGEST_NOISE));
            let given_up = spectrum.evaluations + nodes > MOST_SAMPLES || upper.0 - lower.0 < cutoff * 1e-6;
            if worst <= SHARE || stalled || given_up {
                if stalled && worst > SHARE {
                    for (noise, error) in spectrum.noise.iter_mut().zip(&error) {
                        *noise += error;
                    }
                }
                spectrum.panels.push(panel);
                for (sum, error) in spectrum.error.iter_mut().zip(error) {
                    *sum += error;
                }
                for (sum, size) in spectrum.size.iter_mut().zip(size) {
                    *sum += size;
                }
                continue;
            }
            let at = if lower.0 == 0.0 { FIRST_SPLIT * upper.0 } else { f64::midpoint(lower.0, upper.0) };
            let middle = (at, response.surface(at)?);
            spectrum.evaluations += 1;
            stack.push((middle, upper, worst));
            stack.push((lower, middle, worst));
        }
        Ok(spectrum)
    }

    /// Longest series of a panel.
    pub(super) fn terms(&self) -> usize {
        self.panels.iter().flat_map(|panel| &panel.waves).map(Vec::len).max().unwrap_or(0)
    }

    /// Adds the transforms at `t` to `out`; `scratch` holds [`Self::terms`] numbers.
    pub(super) fn add(&self, t: f64, scratch: &mut [f64], out: &mut [Complex64]) {
        for panel in &self.panels {
            spherical_bessel::sequence(panel.half * t, scratch);
            let wave = Complex64::cis(panel.middle * t);
            for (out, waves) in out.iter_mut().zip(&panel.waves) {
                let (mut re, mut im) = (0.0, 0.0);
                for (w, j) in waves.chunks_exact(2).zip(scratch.chunks_exact(2)) {
                    re += w[0] * j[0];
                    im += w[1] * j[1];
                }
                *out += wave * Complex64::new(re, im);
            }
        }
    }
}

/// Rounding of `s F`, of order one, in a Legendre coefficient: it is counted with the rounding of the whole.
const NOISE: f64 = 16.0 * f64::EPSILON;

/// Coefficients below this that no longer fall are noise that the flexibility brings: no panel resolves it.
const LARGEST_NOISE: f64 = 1e-9;

/// A panel that was halved and has not come below this part of its error is as good as it gets.
const STALL: f64 = 0.3;

/// One panel, what it leaves unresolved and `int |W|` per kernel, and whether that is noise.
struct Sampled {
    panel: Panel,
    error: Vec<f64>,
    size: Vec<f64>,
    noisy: bool,
}

/// An end of a panel and the flexibility there.
type End = (f64, SurfaceFlexibility);

/// Gauss nodes and the Legendre polynomials on them.
struct Legendre {
    nodes: Vec<f64>,
    weights: Vec<f64>,
    /// `polynomials[l][i] = P_l(nodes[i])`.
    polynomials: Vec<Vec<f64>>,
}

impl Legendre {
    /// An even number of at least `nodes`.
    fn new(nodes: usize) -> Self {
        let nodes = nodes.next_multiple_of(2);
        let gauss = GaussLegendre::new(nodes).expect("at least one node");
        let (nodes, weights) = (gauss.rule().nodes.clone(), gauss.rule().weights.clone());
        let mut polynomials = vec![vec![1.0; nodes.len()], nodes.clone()];
        for l in 2..nodes.len() {
            let a = (2 * l - 1) as f64 / l as f64;
            let next = (0..nodes.len())
                .map(|i| a * nodes[i] * polynomials[l - 1][i] - (a - 1.0) * polynomials[l - 2][i])
                .collect();
            polynomials.push(next);
        }
        Self { nodes, weights, polynomials }
    }

    fn sample(
        &self,
        columns: &[Column],
        response: &dyn LayerResponse,
        lower: End,
        upper: End,
        reach: f64,
    ) -> Result<Sampled, Refusal> {
        let (middle, half) = (f64::midpoint(lower.0, upper.0), 0.5 * (upper.0 - lower.0));
        let s: Vec<f64> = self.nodes.iter().map(|x| middle + half * x).collect();
        let mut f = vec![SurfaceFlexibility::default(); s.len()];
        response.surface_into(&s, &mut f)?;
        let panel = Panel { middle, half, waves: Vec::with_capacity(columns.len()) };
        let mut sampled = Sampled { panel, error: Vec::new(), size: Vec::new(), noisy: false };
        for column in columns {
            let weighted: Vec<f64> =
                s.iter().zip(&f).zip(&self.weights).map(|((s, f), weight)| weight * column.weight(*s, f)).collect();
            let coefficients: Vec<f64> = self
                .polynomials
                .iter()
                .enumerate()
                .map(|(l, p)| (l as f64 + 0.5) * p.iter().zip(&weighted).map(|(p, w)| p * w).sum::<f64>())
                .collect();
            // The second evaluation: at the ends, where an unresolved P_n is largest.
            let at_upper = coefficients.iter().sum::<f64>() - column.weight(upper.0, &upper.1);
            let alternating = coefficients.iter().zip([1.0, -1.0].iter().cycle()).map(|(c, sign)| c * sign);
            let at_lower = if lower.0 > 0.0 || column.component.is_odd() {
                alternating.sum::<f64>() - column.weight(lower.0, &lower.1)
            } else {
                0.0
            };
            let (error, noisy) = unresolved(&coefficients, at_upper.abs().max(at_lower.abs()), half * reach);
            sampled.error.push(2.0 * half * error);
            sampled.noisy |= noisy;
            sampled.size.push(half * weighted.iter().map(|w| w.abs()).sum::<f64>());
            let wave = |(l, c): (usize, &f64)| if l % 4 < 2 { 2.0 * half * c } else { -2.0 * half * c };
            sampled.panel.waves.push(coefficients.iter().enumerate().map(wave).collect());
        }
        Ok(sampled)
    }
}

/// What `n` Gauss nodes leave of `int W(x) exp(iwx) dx/2`, `|w| <= phase`, for a function whose Legendre
/// coefficients fall geometrically: those from the `n`-th on, and what they feign in the lower ones
/// (`P_(2n-l)` looks like `P_l` on the nodes), each times `|j_l| <= phase^l/(2l+1)!!`.
///
/// `seen` is the error of the interpolant seen at the ends. Also tells whether the coefficients have ended in noise.
fn unresolved(coefficients: &[f64], seen: f64, phase: f64) -> (f64, bool) {
    let n = coefficients.len();
    let most = |range: std::ops::Range<usize>| coefficients[range].iter().fold(0.0_f64, |most, c| most.max(c.abs()));
    let last = (most(n - 3..n).max(seen) - NOISE).max(0.0);
    let earlier = most(n / 2 - 2..n / 2 + 1).max(f64::MIN_POSITIVE);
    let noisy = last > 0.3 * earlier && last < LARGEST_NOISE;
    if noisy {
        // Not a series any more: the size of the noise, which each sample has, over the panel.
        return (4.0 * last, true);
    }
    let ratio = (last / earlier).powf(2.0 / n as f64).clamp(0.05, SLOWEST);
    let (mut sum, mut bessel, mut feigned) = (0.0, 1.0_f64, last * ratio.powi(i32::try_from(n).unwrap_or(i32::MAX)));
    for l in 0..n {
        sum += feigned * bessel.min(1.0);
        feigned /= ratio;
        bessel *= phase / (2 * l + 3) as f64;
    }
    let mut left_out = last;
    for l in n..4 * n {
        sum += left_out * bessel.min(1.0);
        left_out *= ratio;
        bessel *= phase / (2 * l + 3) as f64;
    }
    (sum, false)
}

/// Slowest decay assumed from one Legendre coefficient to the next.
const SLOWEST: f64 = 0.95;
