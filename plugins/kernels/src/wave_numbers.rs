//! Gauss panels over the wave numbers `[0, S]`.

use bilby::GaussLegendre;

/// Nodes and weights of an integral over the wave number.
#[derive(Clone, Debug, Default)]
pub(crate) struct WaveNumbers {
    pub(crate) s: Vec<f64>,
    pub(crate) weight: Vec<f64>,
}

/// Where the refinement towards `s = 0` stops, in `1/depth`.
///
/// A strongly graded layer has structure there (docs/theory.md section 3); below this its flexibility
/// is a Taylor polynomial even at modulus ratios of 1e6.
const SMALLEST_PANEL: f64 = 1.0 / 256.0;

impl WaveNumbers {
    /// Panels that double in width from the origin, no wider than what `per_panel` nodes resolve of
    /// `cos(s t)` for `|t| <= reach`; the last one ends at `cutoff`.
    pub(crate) fn up_to(cutoff: f64, depth: f64, reach: f64, per_panel: usize) -> Self {
        // Gauss with n nodes takes cos(k x) on [-1, 1] to round-off for k up to about n/2.
        let widest = per_panel as f64 / reach;
        let rule = GaussLegendre::new(per_panel).expect("at least one node");
        let mut grid = Self::default();
        let mut lower = 0.0;
        while lower < cutoff {
            let doubled = if lower == 0.0 { SMALLEST_PANEL / depth } else { lower };
            let upper = (lower + doubled.min(widest)).min(cutoff);
            let (middle, half) = (0.5 * (lower + upper), 0.5 * (upper - lower));
            for (node, weight) in rule.rule().nodes.iter().zip(&rule.rule().weights) {
                grid.s.push(middle + half * node);
                grid.weight.push(half * weight);
            }
            lower = upper;
        }
        grid
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_an_oscillating_decay() {
        let (cutoff, reach) = (40.0, 10.0);
        let grid = WaveNumbers::up_to(cutoff, 1.0, reach, 16);
        let got: f64 = grid.s.iter().zip(&grid.weight).map(|(s, w)| w * (-s).exp() * (s * reach).cos()).sum();
        let exact = 1.0 / (1.0 + reach * reach); // what lies beyond the cut-off is below exp(-40)
        assert!((got - exact).abs() < 1e-15, "{got} against {exact}");
    }
}
