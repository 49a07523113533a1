//! The Legendre series of one panel of wave numbers, and what it leaves unresolved.

use super::column::Column;
use crate::legendre_waves::{values, waves_of};
use arrayvec::ArrayVec;
use bilby::GaussLegendre;
use pulp::{Arch, Simd, WithSimd};
use slipzone_api::elementary::LANES;
use slipzone_api::{LayerResponse, Refusal, SurfaceFlexibility};
use std::sync::OnceLock;

/// One stretch of wave numbers.
#[derive(Clone, Debug)]
pub(super) struct Panel {
    pub(super) middle: f64,
    pub(super) half: f64,
    pub(super) nodes: Vec<f64>,
    /// Per kernel, one after the other: `2 half` times the Legendre coefficients, with the signs of `i^l` put in (real
    /// for even `l`, imaginary for odd); none where sums over the nodes do.
    waves: Vec<f64>,
    /// Per kernel, one after the other: the values at the nodes times their weights on `[-1, 1]`.
    weighted: Vec<f64>,
}

impl Panel {
    /// Each kernel's coefficients, if there are any.
    pub(super) fn waves(&self) -> impl Iterator<Item = &[f64]> {
        self.waves.chunks_exact(self.nodes.len())
    }

    /// A kernel's weighted values.
    pub(super) fn weighted(&self, kernel: usize) -> &[f64] {
        let count = self.nodes.len();
        &self.weighted[kernel * count..(kernel + 1) * count]
    }
}

/// Rounding of `s F`, of order one, in a Legendre coefficient: it is counted with the rounding of the whole.
const NOISE: f64 = 16.0 * f64::EPSILON;

/// The flexibility's error is counted twice: as it is, and for what it hides of a panel's last coefficients.
const TWICE: f64 = 2.0;

/// Coefficients below this that no longer fall are noise that the flexibility brings: no panel resolves it.
pub(super) const LARGEST_NOISE: f64 = 1e-9;

/// What a panel tells of one kernel.
pub(super) struct Resolved {
    /// What it leaves unresolved.
    pub(super) error: f64,
    /// The factor by which its coefficients fall.
    pub(super) ratio: f64,
    pub(super) size: Size,
    /// Whether what is left is noise.
    pub(super) noisy: bool,
}

/// What an integral is measured by.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Size {
    /// `int |W| ds`.
    pub(super) whole: f64,
    /// What the flexibility's error may make of it.
    pub(super) roughened: f64,
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
    /// `(l + 1/2) P_l` for all `l` at one node after the other, the negative half, each filled up with zeros to whole
    /// vectors: the nodes are symmetric.
    polynomials: Vec<f64>,
    /// `largest[l]` is a bound on `|j_l|` everywhere.
    largest: Vec<f64>,
}

/// The rules made so far, by half their number of nodes: they are the same for every layer.
static RULES: [OnceLock<Legendre>; MOST_RULES] = [const { OnceLock::new() }; MOST_RULES];
/// Most nodes of a rule.
pub(super) const MOST: usize = 56;
const MOST_RULES: usize = MOST / 2 + 1;
/// Orders of a wave that are looked at, over the number of nodes.
const ORDERS: usize = 4;

impl Legendre {
    /// The rule of an even number of nodes, up to [`MOST`], made when first asked for.
    pub(super) fn of(nodes: usize) -> &'static Self {
        RULES[nodes / 2].get_or_init(|| Self::new(nodes))
    }

    fn new(nodes: usize) -> Self {
        let gauss = GaussLegendre::new(nodes).expect("at least one node");
        let (nodes, weights) = (gauss.rule().nodes.clone(), gauss.rule().weights.clone());
        let scaled = |(l, p): (usize, f64)| (l as f64 + 0.5) * p;
        let (count, half) = (nodes.len(), nodes.len() / 2);
        let filled = count.next_multiple_of(LANES);
        let mut polynomials = vec![0.0; half * filled];
        for (row, x) in polynomials.chunks_exact_mut(filled).zip(&nodes) {
            row.iter_mut().zip(values(*x).take(count).enumerate().map(scaled)).for_each(|(to, p)| *to = p);
        }
        let largest =
            (0..ORDERS * nodes.len()).map(|l| (LANDAU * (l as f64 + 0.5).powf(-5.0 / 6.0)).min(1.0)).collect();
        Self { nodes, weights, polynomials, largest }
    }

    /// Bounds on `|j_l|` up to a phase, as long as they matter: `phase^l/(2l+1)!!`, and their largest values.
    fn waves(&self, phase: f64) -> ArrayVec<f64, { ORDERS * MOST }> {
        let mut small = 1.0;
        let bound = |(l, largest): (usize, &f64)| {
            let bound = largest.min(small);
            small *= phase / (2 * l + 3) as f64;
            bound
        };
        self.largest.iter().enumerate().map(bound).take_while(|wave| *wave > NO_WAVE).collect()
    }

    /// Samples the panel between two ends for waves up to `reach`, which are `summed` over the nodes or told by their
    /// orders.
    pub(super) fn sample(
        &self,
        columns: &[Column],
        response: &dyn LayerResponse,
        lower: End,
        upper: End,
        (reach, summed): (f64, bool),
    ) -> Result<(Panel, Vec<Resolved>), Refusal> {
        let (middle, half) = (f64::midpoint(lower.s, upper.s), 0.5 * (upper.s - lower.s));
        let nodes: Vec<f64> = self.nodes.iter().map(|x| middle + half * x).collect();
        let count = nodes.len();
        let mut room = [SurfaceFlexibility::default(); MOST];
        let f = &mut room[..count];
        response.surface_into(&nodes, f)?;
        let all = count * columns.len();
        let (mut weighted, mut coefficients) = (Vec::with_capacity(all), [0.0; MOST]);
        let mut told = Vec::with_capacity(if summed { 0 } else { all });
        let waves = self.waves(half * reach);
        let (ends, mut at_ends) = ([lower, upper], [[0.0; MOST]; 2]);
        for (polynomials, end) in at_ends.iter_mut().zip(ends) {
            polynomials[..count].iter_mut().zip(values((end.at - middle) / half)).for_each(|(to, p)| *to = p);
        }
        let resolve = |column: &Column| {
            let mut size = 0.0;
            let weigh = |((s, f), weight): ((&f64, &SurfaceFlexibility), &f64)| {
                let value = weight * column.weight(*s, f);
                size += value.abs();
                value
            };
            let first = weighted.len();
            weighted.extend(nodes.iter().zip(&*f).zip(&self.weights).map(weigh));
            let polynomials = &self.polynomials;
            Arch::new().dispatch(Coefficients { polynomials, weighted: &weighted[first..], out: &mut coefficients });
            let coefficients = &coefficients[..count];
            // What the flexibility's error may make of the integral over [-1, 1].
            let mut rough = 0.0;
            if column.roughness > 0.0 {
                let nodes = nodes.iter().zip(&*f).zip(&self.weights);
                let exposed: f64 = nodes.map(|((s, f), weight)| weight * column.exposed(*s, f)).sum();
                rough = column.roughness * exposed;
            }
            // The second evaluation: at the ends, where an unresolved P_n is largest.
            let seen = ends.iter().zip(&at_ends).fold(0.0_f64, |most, (end, p)| {
                let sum: f64 = coefficients.iter().zip(p).map(|(c, p)| c * p).sum();
                most.max((sum - column.weight(end.at, &end.flexibility)).abs())
            });
            let noise = NOISE.max(0.5 * rough);
            let (error, ratio, noisy) = unresolved(coefficients, (seen, noise), &waves, lower.s == 0.0, summed);
            if !summed {
                told.extend(waves_of(coefficients, half));
            }
            let size = Size { whole: half * size, roughened: TWICE * half * rough };
            Resolved { error: 2.0 * half * error, ratio, size, noisy }
        };
        let resolved = columns.iter().map(resolve).collect();
        Ok((Panel { middle, half, nodes, waves: told, weighted }, resolved))
    }
}

/// Writes the Legendre coefficients of a function, from its values at the nodes times the weights.
struct Coefficients<'a> {
    polynomials: &'a [f64],
    weighted: &'a [f64],
    out: &'a mut [f64; MOST],
}

impl WithSimd for Coefficients<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        const { assert!(LANES.is_multiple_of(S::F64_LANES) && MOST.is_multiple_of(LANES), "rows of whole vectors") };
        let Self { polynomials, weighted, out } = self;
        let (count, vectors) = (weighted.len(), LANES / S::F64_LANES);
        let filled = count.next_multiple_of(LANES);
        let sums = S::as_mut_simd_f64s(&mut out[..filled]).0;
        sums.fill(simd.splat_f64s(0.0));
        for (i, polynomials) in polynomials.chunks_exact(filled).enumerate() {
            let (left, right) = (weighted[i], weighted[count - 1 - i]);
            // P_l(-x) = (-1)^l P_l(x).
            let factors: [f64; LANES] =
                std::array::from_fn(|l| if l.is_multiple_of(2) { left + right } else { left - right });
            let (factors, polynomials) = (S::as_simd_f64s(&factors).0, S::as_simd_f64s(polynomials).0);
            for (sums, p) in sums.chunks_exact_mut(vectors).zip(polynomials.chunks_exact(vectors)) {
                for j in 0..vectors {
                    sums[j] = simd.mul_add_e_f64s(factors[j], p[j], sums[j]);
                }
            }
        }
    }
}

/// What `n` Gauss nodes leave of `int W(x) exp(iwx) dx/2` for a function whose Legendre coefficients fall
/// geometrically, `waves[l]` being a bound on `|j_l(w)|`: the coefficients from the `n`-th on, and what they feign in
/// the lower ones (`P_(2n-l)` looks like `P_l` on the nodes). `summed` at the nodes, not by orders of the wave, it is
/// also `P_(n+j)` in the wave that is taken for `P_(n-j)`.
///
/// `seen` is the error of the interpolant seen at the ends, and the `noise` in the values is counted elsewhere. Also
/// returns the factor from one coefficient to the next, and whether they have ended in noise.
fn unresolved(
    coefficients: &[f64],
    (seen, noise): (f64, f64),
    waves: &[f64],
    at_origin: bool,
    summed: bool,
) -> (f64, f64, bool) {
    let n = coefficients.len();
    let most = |range: std::ops::Range<usize>| coefficients[range].iter().fold(0.0_f64, |most, c| most.max(c.abs()));
    let last = (most(n - 3..n).max(seen) - noise).max(0.0);
    let earlier = most(n / 2 - 2..n / 2 + 1).max(f64::MIN_POSITIVE);
    let noisy = last > 0.3 * earlier && last < LARGEST_NOISE;
    if noisy {
        // Not a series any more: the size of the noise, which each sample has, over the panel.
        return (4.0 * last, SLOWEST, true);
    }
    let first = most(0..3).max(f64::MIN_POSITIVE);
    let overall = (last / first).powf(1.0 / n as f64);
    let (ratio, last) = if !at_origin {
        // The last few come before the `n`-th.
        (overall, (last * overall).max(seen))
    } else if first < SOFT {
        (overall.powf(CAUTION.0), last)
    } else {
        // A fast decay may hide a slow one, which shows last.
        let (lately, before) = (most(n - 4..n), most(3 * n / 4 - 4..3 * n / 4).max(f64::MIN_POSITIVE));
        let local = if lately > noise { (lately / before).powf(1.0 / (n - 3 * n / 4) as f64) } else { 0.0 };
        ((last / earlier).powf(2.0 / n as f64).max(overall).max(local).powf(CAUTION.1), last)
    };
    let ratio = ratio.clamp(0.05, SLOWEST);
    let grow = 1.0 / ratio;
    let (slow, fast) = waves.split_at(n.min(waves.len()));
    let (mut sum, mut feigned) = (0.0, last * ratio.powi(i32::try_from(n).unwrap_or(i32::MAX)));
    for wave in slow {
        sum += feigned * wave;
        feigned *= grow;
    }
    let mut left_out = last;
    for wave in fast {
        sum += left_out * wave;
        left_out *= ratio;
    }
    if summed {
        let mut mirrored = last;
        for (l, wave) in (n..2 * n).zip(fast) {
            sum += mirrored * wave * ((2 * l + 1) as f64 / (4 * n - 2 * l - 1) as f64);
            mirrored *= grow;
        }
    }
    (sum, ratio, false)
}

/// Waves below this matter to no coefficient.
const NO_WAVE: f64 = 1e-26;

/// `|J_nu| < 0.6749 nu^(-1/3)` (Landau), at `x >= nu` where it is largest, times `sqrt(pi/2x)`.
const LANDAU: f64 = 0.846;

/// Coefficients above this at the origin are those of a surface on something much softer, which has structure on the
/// scale of the modulus ratio there.
const SOFT: f64 = 3.0;

/// Power to which the decay seen at the origin is raised before it is trusted for as many coefficients again, for it
/// may slow down: on something about as soft, and on something much softer.
const CAUTION: (f64, f64) = (0.95, 0.85);

/// Slowest decay assumed from one Legendre coefficient to the next.
const SLOWEST: f64 = 0.95;
