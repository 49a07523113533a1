//! Two materials with a blurred interface between them: what both plugins for it share.

use crate::homogeneous::Constant;
use crate::{cuts, thickness};
use serde::{Deserialize, Serialize};
use slipzone_api::taylor::Taylor;
use slipzone_api::{Finite, ModulusLaw, Positive, Refusal, Setting};
use std::fmt::Debug;
use std::marker::PhantomData;

/// `mu(y) = above S(z) + below S(-z)`, `z = (y - centre)/width`, with a step `S` that falls from 1 to 0.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Transition {
    /// Modulus far above the interface.
    pub above: Positive,
    /// Modulus far below it.
    pub below: Positive,
    /// Depth of the interface.
    pub centre: Finite,
    /// Half-width of the interface.
    pub width: Positive,
}

/// A smooth step from 1 far on the left to 0 far on the right, with `S(z) + S(-z) = 1`.
pub(crate) trait Step: Debug + Send + Sync + 'static {
    /// `S(z)`, to full relative precision.
    fn value(z: f64) -> f64;

    /// The series of `S(z)` and of `S(-z)`, from the second coefficient on to relative precision too.
    fn series(z: Taylor) -> (Taylor, Taylor);
}

impl Transition {
    /// The law over a layer.
    pub(crate) fn law<S: Step>(&self, setting: &Setting, what: &str) -> Result<Box<dyn ModulusLaw>, Refusal> {
        let thickness = thickness::of(setting, what)?;
        let (above, below, width) = (self.above.get(), self.below.get(), self.width.get());
        if self.above == self.below {
            return Ok(Box::new(Constant(above)));
        }
        let (top, rate) = (-self.centre.get() / width, thickness / width);
        let details = cuts(std::iter::once((self.centre.get() / thickness, 1.0 / rate)));
        Ok(Box::new(Law::<S> { above, below, top, rate, details, step: PhantomData }))
    }
}

/// `z = top + rate depth`.
#[derive(Debug)]
struct Law<S> {
    above: f64,
    below: f64,
    top: f64,
    rate: f64,
    details: Vec<f64>,
    step: PhantomData<S>,
}

impl<S: Step> ModulusLaw for Law<S> {
    fn modulus(&self, depth: f64) -> f64 {
        let z = self.top + self.rate * depth;
        self.above * S::value(z) + self.below * S::value(-z)
    }

    fn surface_series(&self, terms: usize) -> Vec<f64> {
        let (above, below) = S::series(Taylor::line(self.top, self.rate, terms));
        let series = (above * self.above + below * self.below) * self.surface_modulus().recip();
        series.with_value(1.0).into_finite()
    }

    fn details(&self) -> &[f64] {
        &self.details
    }
}

/// Checks that both plugins pass: the step itself at known places is their own test.
#[cfg(test)]
pub(crate) fn check<S: Step>() {
    use slipzone_api::Positive;
    let positive = |value| Positive::new(value).unwrap();
    let law = |above: f64, below: f64, centre: f64, width: f64| {
        let centre = Finite::new(centre).unwrap();
        let transition = Transition { above: positive(above), below: positive(below), centre, width: positive(width) };
        transition.law::<S>(&Setting::thick(positive(3.0)), "this").unwrap()
    };
    let far = law(1.0, 8.0, 1.5, 0.01);
    assert!((far.modulus(0.0) - 1.0).abs() < 1e-15 && (far.modulus(1.0) - 8.0).abs() < 1e-15);
    assert!((law(1.0, 8.0, 1.5, 0.7).modulus(0.5) - 4.5).abs() < 1e-14, "the mean in the middle");
    let soft = law(1e-9, 1e9, 1.5, 0.1);
    assert!(soft.modulus(0.0) >= 1e-9 && soft.modulus(0.0) < 1e-2, "no cancellation: {}", soft.modulus(0.0));
    assert_eq!(law(2.0, 2.0, 1.0, 1.0).exponent(), Some(0.0));
    assert!(law(1.0, 8.0, -1e4, 1.0).surface_series(8).iter().all(|c| c.is_finite()));
    assert_eq!(law(1.0, 8.0, 1e4, 1.0).surface_series(8).len(), 8, "far away nothing overflows");

    // The series adds up to the law near the surface.
    for (centre, width) in [(0.0, 1.0), (0.7, 1.2), (-0.5, 0.8), (2.5, 1.5)] {
        let law = law(5.0, 2.0, centre, width);
        let series = law.surface_series(30);
        for depth in [0.01, 0.03, 0.1] {
            let sum = series.iter().rev().fold(0.0, |sum, c| sum * depth + c);
            let exact = law.modulus(depth) / law.surface_modulus();
            // tanh has poles at pi/2 width: 0.4 layers off at least, 30 terms leave 0.25^30.
            assert!((sum - exact).abs() < 1e-14, "{centre} {width} {depth}: {sum} {exact}");
        }
    }
}
