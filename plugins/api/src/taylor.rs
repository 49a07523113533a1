//! Taylor series cut off after some terms: exact derivatives of any order, from the rules of calculus alone.
//!
//! A series stands for a function to the right of a point, as the depth below a surface is. It knows so many of its
//! coefficients and no more: each rule gives as many as the operands determine. Where a function has none, as `sqrt(x)`
//! has beyond its value 0 at 0, the series ends.
//!
//! The recurrences are those of the differential equations that the functions solve (A. Griewank, A. Walther,
//! *Evaluating Derivatives*, 2nd ed., SIAM 2008, ch. 13). Time: quadratic in the number of terms.

mod functions;
#[cfg(test)]
mod tests;

use std::ops::{Add, Div, Mul, Neg, Sub};

/// `c0 + c1 t + c2 t^2 + ...`, as far as it is known; `t >= 0` is the distance from the point.
#[derive(Clone, Debug, PartialEq)]
pub struct Taylor(Vec<f64>);

/// What has the four operations, with its own kind and with plain numbers: a formula written for it serves for values
/// and for series.
pub trait Arithmetic:
    Clone
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Mul<f64, Output = Self>
{
}
impl Arithmetic for f64 {}
impl Arithmetic for Taylor {}

impl Taylor {
    /// A number that does not vary, to so many terms.
    pub fn constant(value: f64, terms: usize) -> Self {
        Self::line(value, 0.0, terms)
    }

    /// `value + slope t`, to so many terms.
    pub fn line(value: f64, slope: f64, terms: usize) -> Self {
        Self((0..terms).map(|k| [value, slope].get(k).copied().unwrap_or(0.0)).collect())
    }

    /// The series of these coefficients, no more being known.
    pub fn new(coefficients: Vec<f64>) -> Self {
        Self(coefficients)
    }

    /// The known coefficients, that of `t^0` first.
    pub fn coefficients(&self) -> &[f64] {
        &self.0
    }

    /// The known coefficients up to the first that is not finite.
    pub fn into_finite(mut self) -> Vec<f64> {
        let finite = self.0.iter().take_while(|c| c.is_finite()).count();
        self.0.truncate(finite);
        self.0
    }

    /// With the value replaced by one that is known better.
    #[must_use]
    pub fn with_value(mut self, value: f64) -> Self {
        if let Some(first) = self.0.first_mut() {
            *first = value;
        }
        self
    }

    /// The same function over a distance counted in units of `unit`.
    #[must_use]
    pub fn rescaled(mut self, unit: f64) -> Self {
        let mut scale = 1.0;
        for c in &mut self.0 {
            *c *= scale;
            scale *= unit;
        }
        self
    }

    /// The value at the point; not a number where not even that is known.
    fn value(&self) -> f64 {
        self.0.first().copied().unwrap_or(f64::NAN)
    }

    /// The number of zeros in front.
    fn order(&self) -> usize {
        self.0.iter().take_while(|c| **c == 0.0).count()
    }

    /// `t^zeros` taken out, which the caller knows to be there.
    fn without(&self, zeros: usize) -> Self {
        Self(self.0[zeros.min(self.0.len())..].to_vec())
    }

    /// The first nonzero coefficient: its sign is that of the function right of the point; 0 for zero.
    fn leading(&self) -> f64 {
        self.0.get(self.order()).copied().unwrap_or(0.0)
    }

    /// The function of a value and of the series of its derivative.
    fn integral(value: f64, derivative: &Self) -> Self {
        let rest = derivative.0.iter().enumerate().map(|(k, c)| c / (k + 1) as f64);
        Self(std::iter::once(value).chain(rest).collect())
    }

    fn derivative(&self) -> Self {
        Self(self.0.iter().enumerate().skip(1).map(|(k, c)| c * k as f64).collect())
    }

    fn zip(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(self.0.iter().zip(&other.0).map(|(a, b)| f(*a, *b)).collect())
    }

    fn map(mut self, f: impl Fn(f64) -> f64) -> Self {
        for c in &mut self.0 {
            *c = f(*c);
        }
        self
    }
}

/// The coefficient of `t^k` in a product of which both factors are known so far.
fn product(a: &[f64], b: &[f64], k: usize) -> f64 {
    a[..=k].iter().zip(b[..=k].iter().rev()).map(|(a, b)| a * b).sum()
}

impl Neg for Taylor {
    type Output = Self;
    fn neg(self) -> Self {
        self.map(|c| -c)
    }
}

impl Add for Taylor {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.zip(&other, |a, b| a + b)
    }
}

impl Sub for Taylor {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.zip(&other, |a, b| a - b)
    }
}

impl Mul for Taylor {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let terms = self.0.len().min(other.0.len());
        Self((0..terms).map(|k| product(&self.0, &other.0, k)).collect())
    }
}

impl Div for Taylor {
    type Output = Self;
    /// Zeros that both have in front cancel; a pole has no series. What is divided by too large a number is zero, as
    /// far as that has a series: a logarithm of zero has none.
    fn div(self, other: Self) -> Self {
        if other.value().is_infinite() && self.value().is_finite() {
            return Self(vec![0.0; self.0.len().min(other.0.len())]);
        }
        let zeros = other.order();
        if zeros > 0 && self.order() < zeros {
            return Self(Vec::new());
        }
        let (above, below) = (self.without(zeros).0, other.without(zeros).0);
        let mut quotient: Vec<f64> = Vec::with_capacity(above.len());
        for k in 0..above.len().min(below.len()) {
            let known: f64 = quotient.iter().zip(below[1..=k].iter().rev()).map(|(q, b)| q * b).sum();
            quotient.push((above[k] - known) / below[0]);
        }
        Self(quotient)
    }
}

impl Add<f64> for Taylor {
    type Output = Self;
    fn add(self, number: f64) -> Self {
        let value = self.value() + number;
        self.with_value(value)
    }
}

impl Mul<f64> for Taylor {
    type Output = Self;
    fn mul(self, number: f64) -> Self {
        self.map(|c| c * number)
    }
}
