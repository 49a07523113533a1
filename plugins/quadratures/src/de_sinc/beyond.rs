//! What lies beyond the last node of the grid on which the kernel part is summed: that node stands for it.

use super::between::Between;
use super::grid::Grid;
use super::map::Place;
use super::sums::dot;
use slipzone_api::elementary::ln;

/// The last fine node, and the places beyond it for which it stands.
pub(super) struct Beyond {
    places: Vec<(Place, f64)>,
    fine_step: f64,
    /// What the node weighs by itself.
    own: f64,
    /// What it weighs with all places.
    pub(super) weight: f64,
    /// The shares of the node and of the places in that.
    shares: Vec<f64>,
    /// Their gaps.
    gaps: Vec<f64>,
    /// Means of the powers `1, 2, ...` of the gaps over that of the node, over 1, 2, ...: coefficients of the series of
    /// `-log(1 - gap)`.
    powers: [f64; POWERS],
}

/// Gap over a distance up to which the mean of logarithms is told by [`POWERS`] terms of a series: what is left out is
/// below `1e-19`.
const SMALL: f64 = 1e-3;
const POWERS: usize = 6;

impl Beyond {
    /// Of a fine node with the weight `own` and places with their shares of what the node has.
    pub(super) fn new(node: &Place, own: f64, places: Vec<(Place, f64)>, fine_step: f64) -> Self {
        let weights = || [own].into_iter().chain(places.iter().map(|(place, share)| fine_step * place.slope * share));
        let weight = weights().sum();
        let shares: Vec<f64> = weights().map(|part| part / weight).collect();
        let gaps: Vec<f64> = [node.gap].into_iter().chain(places.iter().map(|(place, _)| place.gap)).collect();
        let mut parts = shares.clone();
        let powers = std::array::from_fn(|i| {
            parts.iter_mut().zip(&gaps).for_each(|(part, gap)| *part *= gap / node.gap);
            parts.iter().sum::<f64>() / (i + 1) as f64
        });
        Self { places, fine_step, own, weight, shares, gaps, powers }
    }

    /// What of the last two `F` of a density that is finite at the end to take for the last one.
    pub(super) fn finite_end(&self, grid: &Grid, between: &Between) -> [f64; 2] {
        let between = between.sums_from_last();
        let own = self.own + between[0];
        let (mut factors, mut all) = ([0.0, own], own);
        let mut add = |weight: f64, (u, share): &(Place, f64)| {
            factors.iter_mut().zip(grid.finite_beyond(u)).for_each(|(sum, factor)| *sum += weight * factor);
            all += weight * share;
        };
        self.places.iter().for_each(|place| add(self.fine_step * place.0.slope, place));
        grid.beyond(1).iter().zip(&between[1..]).for_each(|(place, weight)| add(*weight, place));
        factors.map(|factor| factor / all)
    }

    /// The mean, by weight, of what is given at the node and at the places, and after those.
    pub(super) fn mean(&self, given: &[f64]) -> f64 {
        dot(&self.shares, given)
    }

    /// The mean of `log(distance - gap)`.
    pub(super) fn mean_log(&self, distance: f64) -> f64 {
        let ratio = self.gaps[0] / distance;
        if ratio > SMALL {
            return self.mean_of(|gap| ln(distance - gap));
        }
        ln(distance) - self.powers.iter().rev().fold(0.0, |sum, mean| (sum + mean) * ratio)
    }

    /// The mean of `log(gap)`.
    pub(super) fn mean_log_of_gap(&self) -> f64 {
        self.mean_of(ln)
    }

    /// The mean of something at each gap.
    fn mean_of(&self, of: impl Fn(f64) -> f64) -> f64 {
        self.gaps.iter().zip(&self.shares).map(|(gap, share)| share * of(*gap)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Close by, where each logarithm is taken, and far off, where a series tells all of them.
    #[test]
    fn means_of_logarithms_are_those_of_each() {
        let place = |k: usize| Place::new(3.0 + 0.01 * k as f64);
        let places: Vec<_> = (1..60).map(|k| (place(k), 1.0)).collect();
        let beyond = Beyond::new(&place(0), 0.01 * place(0).slope, places, 0.01);
        assert!((beyond.shares.iter().sum::<f64>() - 1.0).abs() < 1e-15);
        for ratio in [1.1, 3.0, 900.0, 1100.0, 1e5, 1e12] {
            let distance = ratio * beyond.gaps[0];
            // `log(distance - gap) - log distance`, which sums of the logarithms round to their own size.
            let each = |(k, share): (usize, &f64)| share * (-place(k).gap / distance).ln_1p();
            let mean: f64 = beyond.shares.iter().enumerate().map(each).sum();
            let error = beyond.mean_log(distance) - distance.ln() - mean;
            assert!(error.abs() < 16.0 * f64::EPSILON * distance.ln().abs(), "{error:e} at {ratio} times the gap");
        }
    }
}
