//! Numbers that carry their derivative along.

use std::f64::consts::LN_10;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value and its derivative by the variable, both exact but for rounding.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Dual {
    /// The value.
    pub value: f64,
    /// Its derivative.
    pub slope: f64,
}

impl Dual {
    /// A number that does not vary.
    pub(crate) const fn constant(value: f64) -> Self {
        Self { value, slope: 0.0 }
    }

    /// The variable itself.
    pub(crate) const fn variable(value: f64) -> Self {
        Self { value, slope: 1.0 }
    }

    /// The chain rule: a value, and the derivative by this number. What does not vary has no slope even where the
    /// function has a vertical one.
    fn through(self, value: f64, derivative: f64) -> Self {
        let slope = if self.slope == 0.0 && !derivative.is_nan() { 0.0 } else { derivative * self.slope };
        Self { value, slope }
    }

    /// The slope at zero is the mean of both sides.
    pub(crate) fn abs(self) -> Self {
        let sign = if self.value == 0.0 { 0.0 } else { self.value.signum() };
        self.through(self.value.abs(), sign)
    }

    /// The smaller one; where both are equal, with the mean of their slopes.
    pub(crate) fn min(self, other: Self) -> Self {
        -(-self).max(-other)
    }

    /// The larger one; where both are equal, with the mean of their slopes.
    pub(crate) fn max(self, other: Self) -> Self {
        if self.value > other.value {
            self
        } else if self.value < other.value {
            other
        } else {
            // Also for what is no number, which must not get lost.
            Self { value: 0.5 * (self.value + other.value), slope: 0.5 * (self.slope + other.slope) }
        }
    }

    pub(crate) fn power(self, exponent: Self) -> Self {
        let value = self.value.powf(exponent.value);
        let by_base = if exponent.value == 0.0 { 0.0 } else { exponent.value * self.value.powf(exponent.value - 1.0) };
        let mut result = self.through(value, by_base);
        if exponent.slope != 0.0 {
            result.slope += value * self.value.ln() * exponent.slope;
        }
        result
    }

    pub(crate) fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.through(root, 0.5 / root)
    }

    pub(crate) fn cbrt(self) -> Self {
        let root = self.value.cbrt();
        self.through(root, 1.0 / (3.0 * root * root))
    }

    pub(crate) fn exp(self) -> Self {
        let value = self.value.exp();
        self.through(value, value)
    }

    pub(crate) fn ln(self) -> Self {
        self.through(self.value.ln(), self.value.recip())
    }

    pub(crate) fn log10(self) -> Self {
        self.through(self.value.log10(), (self.value * LN_10).recip())
    }

    pub(crate) fn sin(self) -> Self {
        self.through(self.value.sin(), self.value.cos())
    }

    pub(crate) fn cos(self) -> Self {
        self.through(self.value.cos(), -self.value.sin())
    }

    pub(crate) fn tan(self) -> Self {
        let value = self.value.tan();
        self.through(value, 1.0 + value * value)
    }

    pub(crate) fn asin(self) -> Self {
        self.through(self.value.asin(), ((1.0 - self.value) * (1.0 + self.value)).sqrt().recip())
    }

    pub(crate) fn acos(self) -> Self {
        self.through(self.value.acos(), -((1.0 - self.value) * (1.0 + self.value)).sqrt().recip())
    }

    pub(crate) fn atan(self) -> Self {
        self.through(self.value.atan(), (1.0 + self.value * self.value).recip())
    }

    pub(crate) fn sinh(self) -> Self {
        self.through(self.value.sinh(), self.value.cosh())
    }

    pub(crate) fn cosh(self) -> Self {
        self.through(self.value.cosh(), self.value.sinh())
    }

    pub(crate) fn tanh(self) -> Self {
        let secant = self.value.cosh().recip();
        self.through(self.value.tanh(), secant * secant)
    }

    pub(crate) fn asinh(self) -> Self {
        self.through(self.value.asinh(), self.value.hypot(1.0).recip())
    }

    pub(crate) fn acosh(self) -> Self {
        self.through(self.value.acosh(), ((self.value - 1.0) * (self.value + 1.0)).sqrt().recip())
    }

    pub(crate) fn atanh(self) -> Self {
        self.through(self.value.atanh(), ((1.0 - self.value) * (1.0 + self.value)).recip())
    }
}

impl Neg for Dual {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, slope: -self.slope }
    }
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { value: self.value + other.value, slope: self.slope + other.slope }
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self { value: self.value - other.value, slope: self.slope - other.slope }
    }
}

impl Mul for Dual {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self { value: self.value * other.value, slope: self.slope * other.value + self.value * other.slope }
    }
}

impl Div for Dual {
    type Output = Self;
    /// By what is too large for a number: zero, and so is its slope.
    fn div(self, other: Self) -> Self {
        if other.value.is_infinite() && self.value.is_finite() {
            return Self::constant(0.0);
        }
        let value = self.value / other.value;
        Self { value, slope: (self.slope - value * other.slope) / other.value }
    }
}
