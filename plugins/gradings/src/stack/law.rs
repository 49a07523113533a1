//! What a stack tells of itself, from what its sublayers tell.

use slipzone_api::taylor::Taylor;
use slipzone_api::{ModulusLaw, Sublayer};

/// Sublayers and where they begin.
#[derive(Debug)]
pub(super) struct Law {
    sublayers: Vec<Sublayer>,
    /// Depths of their tops; the first is 0.
    tops: Vec<f64>,
    breakpoints: Vec<f64>,
}

impl Law {
    pub(super) fn new(sublayers: Vec<Sublayer>) -> Self {
        let mut top = 0.0;
        let mut tops = Vec::with_capacity(sublayers.len());
        let mut breakpoints = Vec::with_capacity(sublayers.len());
        for Sublayer { thickness, law } in &sublayers {
            tops.push(top);
            breakpoints.push(top);
            breakpoints.extend(law.breakpoints().iter().map(|depth| top + depth * thickness));
            top += thickness;
        }
        // Of sublayers thinner than roundings, nothing is seen.
        breakpoints.dedup_by(|next, before| *next <= *before);
        breakpoints.retain(|depth| *depth > 0.0 && *depth < 1.0);
        Self { sublayers, tops, breakpoints }
    }

    /// The sublayer at a depth, and the depth in it.
    fn at(&self, depth: f64) -> (&dyn ModulusLaw, f64) {
        let index = self.tops.partition_point(|top| *top <= depth).saturating_sub(1);
        let Sublayer { thickness, law } = &self.sublayers[index];
        (&**law, ((depth - self.tops[index]) / thickness).clamp(0.0, 1.0))
    }

    /// A series over the first sublayer's depth, over that of the whole.
    fn rescaled(&self, series: Vec<f64>) -> Vec<f64> {
        Taylor::new(series).rescaled(self.sublayers[0].thickness.recip()).into_finite()
    }
}

impl ModulusLaw for Law {
    fn modulus(&self, depth: f64) -> f64 {
        let (law, depth) = self.at(depth);
        law.modulus(depth)
    }

    fn poisson(&self, depth: f64) -> Option<f64> {
        let (law, depth) = self.at(depth);
        law.poisson(depth)
    }

    fn surface_modulus(&self) -> f64 {
        self.sublayers[0].law.surface_modulus()
    }

    fn broken_power(&self) -> Option<f64> {
        self.sublayers[0].law.broken_power()
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        self.rescaled(self.sublayers[0].law.surface_series(terms))
    }

    fn poisson_series(&self, terms: usize) -> Vec<f64> {
        self.rescaled(self.sublayers[0].law.poisson_series(terms))
    }

    fn breakpoints(&self) -> &[f64] {
        &self.breakpoints
    }

    fn sublayers(&self) -> &[Sublayer] {
        &self.sublayers
    }
}
