//! A panel in slices thin enough for a wave.

use crate::coefficients::Coefficients;
use crate::precision::Precision;
use crate::propagator::Propagator;
use std::borrow::Cow;
use std::sync::OnceLock;

/// Halvings of which slices are kept, and how many of each: waves that ask for such thin ones do so above all near the
/// top.
const KEPT: usize = 16;
const KEPT_OF_EACH: usize = 8;

/// By how much the wave number of a slice, over its thickness, may exceed that over its depth.
const FARTHER: f64 = 1.0;

/// Times as thick as deep from which on a panel is no more halved from its whole down. It is some thirty halvings from
/// there to the thinnest slice, and 64 would be too many to count.
const FAR: f64 = 1_048_576.0;

/// Slices kept of one halving.
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

    /// Shows to `rise` the slices, and how thick they are, from the deepest that begins above a depth upwards: halves
    /// of halves of the panel, as thick as their depth allows. The panel's place is its top and its thickness; wave
    /// numbers are between `least` and `most`.
    #[inline(always)] // what rises through them does so in the machine's vectors
    pub(crate) fn walk(
        &self,
        (panel, thickness): (f64, f64),
        (depth, least, most): (f64, f64, f64),
        mut rise: impl FnMut(&Propagator, f64),
    ) {
        // Of a panel that is far thicker than deep its first part is enough, or there are more parts than can be
        // counted.
        let first = if depth > 0.0 && thickness > FAR * depth { halvings_to(thickness / (FAR * depth)) } else { 0 };
        let (mut halvings, mut k) = (first, 0_usize);
        loop {
            let delta = thickness * (-f64::from(halvings)).exp2();
            let below_panel = k as f64 * delta;
            if below_panel < depth {
                let top = panel + below_panel;
                let thickest = self.precision.thickest(delta / top);
                if most * delta > thickest.min(self.precision.thick.max(FARTHER + least * top)) {
                    (halvings, k) = (halvings + 1, 2 * k + 1);
                    continue;
                }
                rise(&self.get((halvings, k), thickest), delta);
            }
            // With the upper half of a part all of it is done.
            while k % 2 == 0 {
                if halvings == first {
                    return;
                }
                (halvings, k) = (halvings - 1, k / 2);
            }
            k -= 1;
        }
    }

    /// The `k`-th of `2^halvings` slices from the top, for wave numbers up to `thickest` over its thickness.
    fn get(&self, (halvings, k): (u32, usize), thickest: f64) -> Cow<'_, Propagator> {
        let make = || {
            let width = (1.0 - f64::from(halvings)).exp2();
            let bottom = (k + 1) as f64 * width - 1.0;
            Propagator::new(self.precision, thickest, |z| self.coefficients.at(bottom - width * z))
        };
        let Some(level) = self.levels.get(halvings as usize).filter(|_| k < KEPT_OF_EACH) else {
            return Cow::Owned(make());
        };
        let count = KEPT_OF_EACH.min(1 << halvings);
        let slices = level.get_or_init(|| std::iter::repeat_with(OnceLock::new).take(count).collect());
        Cow::Borrowed(slices[k].get_or_init(make))
    }
}

/// How often a ratio of thicknesses can be halved, to 1 or just above.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // of numbers below 1e308
fn halvings_to(ratio: f64) -> u32 {
    ratio.log2() as u32
}
