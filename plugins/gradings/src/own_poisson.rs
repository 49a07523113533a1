//! Laws with a Poisson's ratio of their own.

use slipzone_api::{ModulusLaw, Poisson, Sublayer};
use std::sync::Arc;

/// A law, or a sublayer of it, with a Poisson's ratio wherever it names none itself.
#[derive(Debug)]
pub(crate) struct OwnPoisson {
    whole: Arc<dyn ModulusLaw>,
    /// The sublayer of the whole, of that one's sublayers, ... that is meant.
    path: Vec<usize>,
    poisson: Poisson,
    sublayers: Vec<Sublayer>,
}

impl OwnPoisson {
    /// The law with that ratio.
    pub(crate) fn new(law: Box<dyn ModulusLaw>, poisson: Poisson) -> Self {
        Self::part(&Arc::from(law), Vec::new(), poisson)
    }

    fn part(whole: &Arc<dyn ModulusLaw>, path: Vec<usize>, poisson: Poisson) -> Self {
        let mut part = Self { whole: Arc::clone(whole), path, poisson, sublayers: Vec::new() };
        let sublayers = part.law().sublayers().iter().enumerate().map(|(index, sublayer)| {
            let path = part.path.iter().copied().chain([index]).collect();
            Sublayer { thickness: sublayer.thickness, law: Box::new(Self::part(whole, path, poisson)) }
        });
        part.sublayers = sublayers.collect();
        part
    }

    fn law(&self) -> &dyn ModulusLaw {
        self.path.iter().fold(&*self.whole, |law, &index| &*law.sublayers()[index].law)
    }
}

impl ModulusLaw for OwnPoisson {
    fn modulus(&self, depth: f64) -> f64 {
        self.law().modulus(depth)
    }

    fn poisson(&self, depth: f64) -> Option<f64> {
        self.law().poisson(depth).or(Some(self.poisson.get()))
    }

    fn surface_modulus(&self) -> f64 {
        self.law().surface_modulus()
    }

    fn exponent(&self) -> Option<f64> {
        self.law().exponent()
    }

    fn broken_power(&self) -> Option<f64> {
        self.law().broken_power()
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        self.law().surface_series(terms)
    }

    fn poisson_series(&self, terms: usize) -> Vec<f64> {
        if self.law().poisson(0.0).is_some() {
            return self.law().poisson_series(terms);
        }
        (0..terms).map(|k| if k == 0 { self.poisson.get() } else { 0.0 }).collect()
    }

    fn breakpoints(&self) -> &[f64] {
        self.law().breakpoints()
    }

    fn details(&self) -> &[f64] {
        self.law().details()
    }

    fn probes(&self) -> &[f64] {
        self.law().probes()
    }

    fn sublayers(&self) -> &[Sublayer] {
        &self.sublayers
    }

    fn remarks(&self) -> Vec<String> {
        self.law().remarks()
    }
}
