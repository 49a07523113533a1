//! The Legendre series of one panel of wave numbers, and what it leaves unresolved.

use super::column::Column;
use bilby::GaussLegendre;
use slipzone_api::{LayerResponse, Refusal, SurfaceFlexibility};
use std::sync::OnceLock;

/// One stretch of wave numbers.
#[derive(Clone, Debug)]
pub(super) struct Panel {
    pub(super) middle: f64,
    pub(super) half: f64,
    /// Per kernel: `2 half` times the Legendre coefficients, with the signs of `i^l` put in (real for even
    /// `l`, imaginary for odd).
    pub(super) waves: Vec<Vec<f64>>,
    /// The nodes, and per kernel the values at them times their weights.
    pub(super) nodes: Vec<f64>,
    pub(super) weighted: Vec<Vec<f64>>,
}

/// Rounding of `s F`, of order one, in a Legendre coefficient: it is counted with the rounding of the whole.
const NOISE: f64 = 16.0 * f64::EPSILON;

/// Coefficients below this that no longer fall are noise that the flexibility brings: no panel resolves it.
pub(super) const LARGEST_NOISE: f64 = 1e-9;

/// One panel; what it leaves unresolved, the factor by which its coefficients fall, and `int |W|`, and whether what is
/// left is noise, per kernel.
pub(super) struct Sampled {
    pub(super) panel: Panel,
    pub(super) error: Vec<f64>,
    pub(super) ratio: Vec<f64>,
    pub(super) size: Vec<f64>,
    pub(super) noisy: Vec<bool>,
}

/// An end of a panel, and the flexibility `at` it: at the origin a little beside it, where the depth is defined too.
#[derive(Clone, Copy, Debug)]
pub(super) struct End {
    pub(super) s: f64,
    pub(super) at: f64,
    pub(super) flexibility: SurfaceFlexibility,
}

impl End {
    pub(super) fn new(response: &dyn LayerResponse, s: f64, at: f64) -> Result<Self, Refusal> {
        Ok(Self { s, at, flexibility: response.surface(at)? })
    }
}

/// Gauss nodes and the Legendre polynomials on them.
pub(super) struct Legendre {
    nodes: Vec<f64>,
    weights: Vec<f64>,
    /// `polynomials[l][i] = P_l(nodes[i])`.
    polynomials: Vec<Vec<f64>>,
    /// `largest[l]` is a bound on `|j_l|` everywhere.
    largest: Vec<f64>,
}

/// The rules made so far, by half their number of nodes: they are the same for every layer.
static RULES: [OnceLock<Legendre>; MOST_RULES] = [const { OnceLock::new() }; MOST_RULES];
/// Rules that are kept.
const MOST_RULES: usize = 64;

impl Legendre {
    /// The rule of an even number of nodes below 128, made when first asked for.
    pub(super) fn of(nodes: usize) -> &'static Self {
        RULES[nodes / 2].get_or_init(|| Self::new(nodes))
    }

    fn new(nodes: usize) -> Self {
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
        let largest = (0..4 * nodes.len()).map(|l| (LANDAU * (l as f64 + 0.5).powf(-5.0 / 6.0)).min(1.0)).collect();
        Self { nodes, weights, polynomials, largest }
    }

    /// Bounds on `|j_l|` up to a phase: `phase^l/(2l+1)!!`, and their largest values.
    fn waves(&self, phase: f64) -> Vec<f64> {
        let mut small = 1.0;
        let bound = |(l, largest): (usize, &f64)| {
            let bound = largest.min(small);
            small *= phase / (2 * l + 3) as f64;
            bound
        };
        self.largest.iter().enumerate().map(bound).collect()
    }

    /// Samples the panel between two ends for waves up to `reach`.
    pub(super) fn sample(
        &self,
        columns: &[Column],
        response: &dyn LayerResponse,
        lower: End,
        upper: End,
        (reach, summed): (f64, bool),
    ) -> Result<Sampled, Refusal> {
        let (middle, half) = (f64::midpoint(lower.s, upper.s), 0.5 * (upper.s - lower.s));
        let s: Vec<f64> = self.nodes.iter().map(|x| middle + half * x).collect();
        let mut f = vec![SurfaceFlexibility::default(); s.len()];
        response.surface_into(&s, &mut f)?;
        let panel = Panel {
            middle,
            half,
            waves: Vec::with_capacity(columns.len()),
            nodes: s,
            weighted: Vec::with_capacity(columns.len()),
        };
        let mut sampled = Sampled { panel, error: Vec::new(), ratio: Vec::new(), size: Vec::new(), noisy: Vec::new() };
        let waves = self.waves(half * reach);
        for column in columns {
            let weighted: Vec<f64> = (sampled.panel.nodes.iter().zip(&f).zip(&self.weights))
                .map(|((s, f), weight)| weight * column.weight(*s, f))
                .collect();
            let coefficients: Vec<f64> = self
                .polynomials
                .iter()
                .enumerate()
                .map(|(l, p)| (l as f64 + 0.5) * p.iter().zip(&weighted).map(|(p, w)| p * w).sum::<f64>())
                .collect();
            // The second evaluation: at the ends, where an unresolved P_n is largest.
            let seen = [lower, upper].map(|end| {
                let sum = legendre_sum(&coefficients, (end.at - middle) / half);
                (sum - column.weight(end.at, &end.flexibility)).abs()
            });
            let (error, ratio, noisy) = unresolved(&coefficients, seen[0].max(seen[1]), &waves, summed);
            sampled.error.push(2.0 * half * error);
            sampled.ratio.push(ratio);
            sampled.noisy.push(noisy);
            sampled.size.push(half * weighted.iter().map(|w| w.abs()).sum::<f64>());
            let wave = |(l, c): (usize, &f64)| if l % 4 < 2 { 2.0 * half * c } else { -2.0 * half * c };
            sampled.panel.waves.push(coefficients.iter().enumerate().map(wave).collect());
            sampled.panel.weighted.push(weighted.iter().map(|w| half * w).collect());
        }
        Ok(sampled)
    }
}

/// What `n` Gauss nodes leave of `int W(x) exp(iwx) dx/2` for a function whose Legendre coefficients fall
/// geometrically, `waves[l]` being a bound on `|j_l(w)|`: the coefficients from the `n`-th on, and what they feign in the
/// lower ones (`P_(2n-l)` looks like `P_l` on the nodes). `summed` at the nodes, not by orders of the wave, it is also
/// `P_(n+j)` in the wave that is taken for `P_(n-j)`.
///
/// `seen` is the error of the interpolant seen at the ends. Also returns the factor from one coefficient to the next, and
/// whether they have ended in noise.
fn unresolved(coefficients: &[f64], seen: f64, waves: &[f64], summed: bool) -> (f64, f64, bool) {
    let n = coefficients.len();
    let most = |range: std::ops::Range<usize>| coefficients[range].iter().fold(0.0_f64, |most, c| most.max(c.abs()));
    let last = (most(n - 3..n).max(seen) - NOISE).max(0.0);
    let earlier = most(n / 2 - 2..n / 2 + 1).max(f64::MIN_POSITIVE);
    let noisy = last > 0.3 * earlier && last < LARGEST_NOISE;
    if noisy {
        // Not a series any more: the size of the noise, which each sample has, over the panel.
        return (4.0 * last, SLOWEST, true);
    }
    // Overall, over the last half and over the last quarter: where a fast decay hides a slow one, it shows last.
    let first = most(0..3).max(f64::MIN_POSITIVE);
    let (lately, before) = (most(n - 4..n), most(3 * n / 4 - 4..3 * n / 4).max(f64::MIN_POSITIVE));
    let ratio = (last / earlier).powf(2.0 / n as f64).max((last / first).powf(1.0 / n as f64));
    let local = if lately > NOISE { (lately / before).powf(1.0 / (n - 3 * n / 4) as f64) } else { 0.0 };
    let ratio = ratio.max(local).powf(CAUTION).clamp(0.05, SLOWEST);
    let (mut sum, mut feigned) = (0.0, last * ratio.powi(i32::try_from(n).unwrap_or(i32::MAX)));
    for wave in &waves[..n] {
        sum += feigned * wave;
        feigned /= ratio;
    }
    let mut left_out = last;
    for wave in &waves[n..] {
        sum += left_out * wave;
        left_out *= ratio;
    }
    if summed {
        let mut mirrored = last;
        for (l, wave) in (n..2 * n).zip(&waves[n..]) {
            sum += mirrored * wave * ((2 * l + 1) as f64 / (4 * n - 2 * l - 1) as f64);
            mirrored /= ratio;
        }
    }
    (sum, ratio, false)
}

/// `sum_l coefficients[l] P_l(x)`.
fn legendre_sum(coefficients: &[f64], x: f64) -> f64 {
    let (mut before, mut p, mut sum) = (0.0, 1.0, 0.0);
    for (l, c) in coefficients.iter().enumerate() {
        sum += c * p;
        let a = (2 * l + 1) as f64 / (l + 1) as f64;
        (before, p) = (p, a * x * p - (a - 1.0) * before);
    }
    sum
}

/// `|J_nu| < 0.6749 nu^(-1/3)` (Landau), at `x >= nu` where it is largest, times `sqrt(pi/2x)`.
const LANDAU: f64 = 0.846;

/// Power to which the decay seen is raised before it is trusted for as many coefficients again: it may slow down.
const CAUTION: f64 = 0.92;

/// Slowest decay assumed from one Legendre coefficient to the next.
const SLOWEST: f64 = 0.95;
