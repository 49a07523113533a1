//! What lies beyond the last node of the grid on which the kernel part is summed: that node stands for it.

use super::between::Between;
use super::grid::Grid;
use super::map::Place;

/// The last fine node, and the places beyond it for which it stands.
pub(super) struct Beyond {
    /// What the node weighs by itself.
    pub(super) weight: f64,
    pub(super) places: Vec<(Place, f64)>,
    pub(super) fine_step: f64,
}

impl Beyond {
    /// What the places weigh.
    pub(super) fn weights(&self) -> impl Iterator<Item = f64> {
        self.places.iter().map(|(place, share)| self.fine_step * place.slope * share)
    }

    /// What of the last two `F` of a density that is finite at the end to take for the last one.
    pub(super) fn finite_end(&self, grid: &Grid, between: &Between) -> [f64; 2] {
        let between = between.sums_from_last();
        let own = self.weight + between[0];
        let (mut factors, mut all) = ([0.0, own], own);
        let mut add = |weight: f64, (u, share): &(Place, f64)| {
            factors.iter_mut().zip(grid.finite_beyond(u)).for_each(|(sum, factor)| *sum += weight * factor);
            all += weight * share;
        };
        self.places.iter().for_each(|place| add(self.fine_step * place.0.slope, place));
        grid.beyond(1).iter().zip(&between[1..]).for_each(|(place, weight)| add(*weight, place));
        factors.map(|factor| factor / all)
    }

    /// The mean, by weight, of what is given at the node and at the places.
    pub(super) fn mean(&self, at_node: f64, at_places: &[f64]) -> f64 {
        let (mut sum, mut all) = (self.weight * at_node, self.weight);
        for (weight, at) in self.weights().zip(at_places) {
            sum += weight * at;
            all += weight;
        }
        sum / all
    }
}
