//! A panel in slices thin enough for a wave.

use crate::coefficients::Coefficients;
use crate::precision::Precision;
use crate::propagator::Propagator;
use std::borrow::Cow;
use std::sync::OnceLock;

/// Halvings of which the slices are kept.
const KEPT: usize = 8;

/// Slices kept of one halving: deeper ones no wave feels that asks for such thin ones.
type Level = OnceLock<Box<[OnceLock<Propagator>]>>;

/// A stretch over which the constants are polynomials, and its slices as far as they have been asked for.
#[derive(Clone, Debug)]
pub(crate) struct Slices {
    /// In a variable from -1 at the top to 1 at the bottom.
    pub(crate) coefficients: Coefficients,
    precision: &'static Precision,
    levels: [Level; KEPT],
}

impl Slices {
    pub(crate) fn new(coefficients: &Coefficients, precision: &'static Precision) -> Self {
        Self { coefficients: *coefficients, precision, levels: Default::default() }
    }

    /// The same over a part.
    pub(crate) fn window(&self, start: f64, width: f64) -> Self {
        Self::new(&self.coefficients.window(start, width), self.precision)
    }

    /// The `k`-th of `2^halvings` slices from the top.
    pub(crate) fn get(&self, halvings: u32, k: usize) -> Cow<'_, Propagator> {
        let count = 1_usize << halvings;
        let make = || {
            let width = 2.0 / count as f64;
            let bottom = (k + 1) as f64 * width - 1.0;
            Propagator::new(self.precision, |z| self.coefficients.at(bottom - width * z))
        };
        let Some(level) = self.levels.get(halvings as usize) else { return Cow::Owned(make()) };
        let slices = level.get_or_init(|| std::iter::repeat_with(OnceLock::new).take(count).collect());
        Cow::Borrowed(slices[k].get_or_init(make))
    }
}
