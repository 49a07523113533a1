//! A tip that grows like a power of the distance from its middle.

use serde::{Deserialize, Serialize};
use slipzone_api::{Flaw, NotAllowed, Positive, PunchProfile, PunchShape, Refusal};

/// `g(x) = coefficient |x|^exponent`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Power {
    /// Height at `|x| = 1`, in length^(1 - exponent).
    pub coefficient: Positive,
    /// From 1, a wedge, to 64, nearly flat.
    pub exponent: Exponent,
}

/// The power of `|x|`, from 1 to 64: below 1 the shape is not convex, far above it cannot be told from a flat punch.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "f64", into = "f64")]
pub struct Exponent(f64);

impl Exponent {
    /// Checks the range.
    pub fn new(value: f64) -> Result<Self, NotAllowed> {
        let expected = "a number from 1 (below, the punch is not convex) to 64";
        if (1.0..=64.0).contains(&value) { Ok(Self(value)) } else { Err(NotAllowed { expected, found: value }) }
    }

    /// The plain number.
    pub const fn get(self) -> f64 {
        self.0
    }
}

impl TryFrom<f64> for Exponent {
    type Error = NotAllowed;
    fn try_from(value: f64) -> Result<Self, NotAllowed> {
        Self::new(value)
    }
}

impl From<Exponent> for f64 {
    fn from(value: Exponent) -> f64 {
        value.0
    }
}

slipzone_api::register!(Punch, "power", "height growing like a power of |x|: from a wedge to nearly flat",
    also: ["power-law", "monomial"],
    example: "type = \"power\"\ncoefficient = 0.05\nexponent = 3.0",
    parameters: [
        ("coefficient", "height at |x| = 1 (length^(1 - exponent))", true, [0.01, 0.1, 1.0], Positive),
        ("exponent", "power of |x|, from 1 to 64", true, [1.0, 1.5, 2.0, 4.0, 10.0], Between(1.0, 64.0)),
    ],
    source: "half-plane: P = m coefficient b^m B((m + 1)/2, 1/2)/A0, from P = (1/A0) int x g'(x)/sqrt(b^2 - x^2) dx");

#[typetag::serde(name = "power")]
impl PunchProfile for Power {
    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
        Ok(Box::new(Tip { coefficient: self.coefficient.get(), exponent: self.exponent.get() }))
    }
}

#[derive(Debug)]
struct Tip {
    coefficient: f64,
    exponent: f64,
}

impl PunchShape for Tip {
    fn height(&self, x: f64) -> f64 {
        self.coefficient * x.abs().powf(self.exponent)
    }

    fn slope(&self, x: f64) -> f64 {
        if x == 0.0 {
            return 0.0;
        }
        self.exponent * self.coefficient * x.abs().powf(self.exponent - 1.0).copysign(x)
    }

    /// Where the height equals the distance from the middle. Near a wedge that means nothing, and any length does.
    fn natural_length(&self) -> f64 {
        let length = self.coefficient.powf(-1.0 / (self.exponent - 1.0));
        if (1e-50..=1e50).contains(&length) { length } else { 1.0 }
    }

    fn flaw(&self, _half_width: f64) -> Option<Flaw> {
        None
    }

    fn kinks(&self) -> &[f64] {
        let is_even = self.exponent % 2.0 == 0.0;
        if is_even { &[] } else { &[0.0] }
    }

    fn corners(&self) -> &[f64] {
        let is_wedge = self.exponent <= 1.0;
        if is_wedge { &[0.0] } else { &[] }
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
#[allow(clippy::float_cmp)] // where equality is asserted, it is exact by construction
mod tests {
    use super::*;

    fn power(coefficient: f64, exponent: f64) -> Box<dyn PunchShape> {
        let coefficient = Positive::new(coefficient).unwrap();
        Power { coefficient, exponent: Exponent::new(exponent).unwrap() }.shape().unwrap()
    }

    #[test]
    fn special_cases() {
        let parabola = power(0.05, 2.0);
        assert_eq!((parabola.height(3.0), parabola.slope(-3.0)), (0.05 * 9.0, -0.05 * 6.0));
        assert_eq!((parabola.kinks(), parabola.corners()), (&[][..], &[][..]));
        let wedge = power(0.1, 1.0);
        assert_eq!((wedge.height(-3.0), wedge.slope(-3.0), wedge.slope(0.0)), (0.1 * 3.0, -0.1, 0.0));
        assert_eq!((wedge.kinks(), wedge.corners()), (&[0.0][..], &[0.0][..]));
        assert_eq!((power(0.1, 1.5).kinks(), power(0.1, 1.5).corners()), (&[0.0][..], &[][..]));
        assert_eq!(power(0.1, 1.0).natural_length(), 1.0);
        assert_eq!(power(1e-3, 1.001).natural_length(), 1.0, "1e3000 is no length");
    }

    #[test]
    fn exponents_have_a_range() {
        for bad in [0.99, 64.5, -2.0, f64::NAN, f64::INFINITY] {
            assert!(Exponent::new(bad).is_err(), "{bad}");
        }
    }
}
