//! A polynomial in even powers of the distance from the middle.

use serde::{Deserialize, Serialize};
use slipzone_api::{Flaw, PunchProfile, PunchShape, Refusal, Values, examine};

/// `g(x) = c2 x^2 + c4 x^4 + c6 x^6 + ...`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Polynomial {
    /// `c2, c4, c6, ...`, in 1/length, 1/length^3, 1/length^5, ...
    pub coefficients: Coefficients,
}

/// From 1 to 16 finite numbers, the first of them that is not 0 above 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Vec<f64>", into = "Vec<f64>")]
pub struct Coefficients(Vec<f64>);

impl TryFrom<Vec<f64>> for Coefficients {
    type Error = String;

    fn try_from(values: Vec<f64>) -> Result<Self, String> {
        if values.is_empty() || values.len() > MOST {
            return Err(format!("expected from 1 to {MOST} `coefficients`, found {}", values.len()));
        }
        if let Some(value) = values.iter().find(|value| !value.is_finite()) {
            return Err(format!("expected finite `coefficients`, found `{value}`"));
        }
        match values.iter().find(|value| **value != 0.0) {
            Some(first) if *first > 0.0 => Ok(Self(values)),
            Some(first) => Err(format!(
                "expected `coefficients` of which the first other than 0 is above 0 (or the punch has no tip), found `{first}`"
            )),
            None => Err("expected `coefficients` that are not all 0, found nothing but 0".into()),
        }
    }
}

impl From<Coefficients> for Vec<f64> {
    fn from(value: Coefficients) -> Self {
        value.0
    }
}

/// The most coefficients that are taken.
const MOST: usize = 16;

slipzone_api::register!(Punch, "polynomial", "even polynomial: c2 x^2 + c4 x^4 + ...",
    example: "type = \"polynomial\"\ncoefficients = [0.05, 0.001]",
    parameters: [("coefficients", "[c2, c4, c6, ...], up to 16 (1/length, 1/length^3, 1/length^5, ...)", true, [], List(&Values::Number, 1, MOST))],
    source: "half-plane: P = (pi/A0) (c2 b^2 + (3/2) c4 b^4 + (15/8) c6 b^6 + ...), from P = (1/A0) int x g'(x)/sqrt(b^2 - x^2) dx");

#[typetag::serde(name = "polynomial")]
impl PunchProfile for Polynomial {
    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
        Ok(Box::new(Sum { coefficients: self.coefficients.0.clone() }))
    }
}

#[derive(Debug)]
struct Sum {
    coefficients: Vec<f64>,
}

impl Sum {
    /// Coefficients with the powers they go with.
    fn terms(&self) -> impl Iterator<Item = (f64, f64)> {
        self.coefficients.iter().zip(1_u32..).map(|(c, k)| (*c, f64::from(2 * k)))
    }
}

impl PunchShape for Sum {
    fn height(&self, x: f64) -> f64 {
        let square = x * x;
        self.coefficients.iter().rev().fold(0.0, |sum, c| sum * square + c) * square
    }

    fn slope(&self, x: f64) -> f64 {
        let square = x * x;
        let mut sum = 0.0;
        for (index, c) in self.coefficients.iter().enumerate().rev() {
            sum = sum * square + 2.0 * (index + 1) as f64 * c;
        }
        sum * x
    }

    /// Where the first of the terms alone makes the height equal to the distance from the middle.
    fn natural_length(&self) -> f64 {
        let lengths = self.terms().filter(|(c, _)| *c != 0.0).map(|(c, power)| c.abs().powf(-1.0 / (power - 1.0)));
        lengths.fold(f64::MAX, f64::min)
    }

    fn flaw(&self, half_width: f64) -> Option<Flaw> {
        if self.coefficients.iter().all(|c| *c >= 0.0) {
            return None;
        }
        examine::first_flaw(self, half_width, &[])
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape(coefficients: &[f64]) -> Box<dyn PunchShape> {
        let coefficients = Coefficients::try_from(coefficients.to_vec()).unwrap();
        Polynomial { coefficients }.shape().unwrap()
    }

    #[test]
    fn height_and_slope_are_those_of_the_terms() {
        let shape = shape(&[0.5, 0.0, 0.25]);
        assert!((shape.height(-2.0) - (0.5 * 4.0 + 0.25 * 64.0)).abs() < 1e-13);
        assert!((shape.slope(-2.0) + (0.5 * 2.0 * 2.0 + 0.25 * 6.0 * 32.0)).abs() < 1e-13);
    }

    #[test]
    fn where_it_stops_being_convex_is_said() {
        // g'' = 2 - 12 x^2 c: zero at 1/sqrt(6) for c = 1.
        let flaw = shape(&[1.0, -1.0]).flaw(0.5).unwrap();
        assert!((flaw.x - 6_f64.sqrt().recip()).abs() < 1e-4, "{flaw:?}");
        assert_eq!(shape(&[1.0, -1.0]).flaw(0.4), None);
        assert_eq!(shape(&[1.0, 1.0]).flaw(1e3), None);
    }

    #[test]
    fn coefficients_must_make_a_tip() {
        for bad in [&[][..], &[0.0], &[-1.0, 2.0], &[0.0, -1.0], &[1.0, f64::NAN], &[1.0; 17]] {
            assert!(Coefficients::try_from(bad.to_vec()).is_err(), "{bad:?}");
        }
        assert!(Coefficients::try_from(vec![0.0, 1.0, -1.0]).is_ok());
    }
}
