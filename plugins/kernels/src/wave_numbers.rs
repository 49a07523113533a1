//! The flexibility on Gauss panels of wave numbers.

use bilby::GaussLegendre;
use slipzone_api::{LayerResponse, Refusal, SurfaceFlexibility};

/// Nodes and weights of an integral over wave numbers `[0, cutoff]`, and the flexibility at each.
#[derive(Clone, Debug, Default)]
pub(crate) struct Samples {
    pub(crate) s: Vec<f64>,
    pub(crate) weight: Vec<f64>,
    pub(crate) flexibility: Vec<SurfaceFlexibility>,
    /// Where the last panel ends.
    pub(crate) cutoff: f64,
}

/// Where the refinement towards `s = 0` stops, over the depth of all that is felt.
///
/// A strongly graded layer has structure there (docs/theory.md section 3); below this its flexibility
/// is a Taylor polynomial even at modulus ratios of 1e6.
const SMALLEST_PANEL: f64 = 1.0 / 256.0;

/// A panel on which nothing but the tail is left, to this absolute size, is the last one: the rounding of
/// a flexibility of order one.
const NOTHING_LEFT: f64 = 1e-13;

/// Most wave numbers for one table.
const MOST_SAMPLES: usize = 1 << 14;

impl Samples {
    /// Panels that double in width from the origin, no wider than what `per_panel` nodes resolve of
    /// `cos(s t)` for `|t| <= reach`. They end at `cutoff`, or before it where the flexibility has
    /// already settled on its tail (a homogeneous layer does so at about `20/depth`).
    pub(crate) fn up_to(
        cutoff: f64,
        response: &dyn LayerResponse,
        depth: f64,
        reach: f64,
        per_panel: usize,
    ) -> Result<Self, Refusal> {
        // Gauss with n nodes takes cos(k x) on [-1, 1] to round-off for k up to about n/2.
        let widest = per_panel as f64 / reach;
        let rule = GaussLegendre::new(per_panel).expect("at least one node");
        // A base far below the first interface is felt by long waves.
        let extent = response.extent().map_or(depth, |extent| extent.max(depth));
        let (beta, tail) = (response.elastic().beta(), response.tail(1).first().copied().unwrap_or_default());
        let mut samples = Self::default();
        while samples.cutoff < cutoff {
            let lower = samples.cutoff;
            let doubled = if lower == 0.0 { SMALLEST_PANEL / extent } else { lower };
            let upper = (lower + doubled.min(widest)).min(cutoff);
            if samples.s.len() > MOST_SAMPLES {
                return Err(too_wide(reach, cutoff));
            }
            let (middle, half) = (0.5 * (lower + upper), 0.5 * (upper - lower));
            let from = samples.s.len();
            samples.s.extend(rule.rule().nodes.iter().map(|node| middle + half * node));
            samples.weight.extend(rule.rule().weights.iter().map(|weight| half * weight));
            samples.flexibility.resize(samples.s.len(), SurfaceFlexibility::default());
            response.surface_into(&samples.s[from..], &mut samples.flexibility[from..])?;
            samples.cutoff = upper;
            let left = samples.s[from..].iter().zip(&samples.flexibility[from..]).fold(0.0_f64, |most, (s, f)| {
                let rest = [f.vv - 1.0 - tail.vv / s, f.uu - 1.0 - tail.uu / s, f.uv + beta - tail.uv / s];
                rest.iter().fold(most, |most, r| most.max(r.abs()))
            });
            if left < NOTHING_LEFT {
                break;
            }
        }
        Ok(samples)
    }
}

/// The refusal of a contact so wide beside the layer that its kernel would cost too much.
pub(crate) fn too_wide(reach: f64, cutoff: f64) -> Refusal {
    Refusal::OutOfReach {
        method: "truncated",
        why: format!("a kernel up to |t| = {reach:.2e} h cut at S = {cutoff:.2e}/h takes more work than it is worth"),
        remedy: "ask for a coarser tolerance or a smaller cutoff, or make the layer thicker beside the contact",
    }
}
