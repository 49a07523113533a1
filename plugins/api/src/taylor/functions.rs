//! Functions of a series.

use super::{Taylor, product};
use spec_math::cephes64::erf;
use std::f64::consts::{FRAC_2_SQRT_PI, LN_10};

impl Taylor {
    /// The absolute value right of the point.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.leading() < 0.0 { -self } else { self }
    }

    /// The smaller one right of the point.
    #[must_use]
    pub fn min(self, other: Self) -> Self {
        -(-self).max(-other)
    }

    /// The larger one right of the point.
    #[must_use]
    pub fn max(self, other: Self) -> Self {
        let terms = self.0.len().min(other.0.len());
        let leading = (self.clone() - other.clone()).leading();
        // What is no number must not get lost.
        let mut larger = if leading > 0.0 || self.value().is_nan() { self } else { other };
        larger.0.truncate(terms);
        larger
    }

    /// The power of a fixed exponent. From a zero on, so many terms as there are whole powers of `t` before the first
    /// broken one.
    #[must_use]
    pub fn powf(self, exponent: f64) -> Self {
        let terms = self.0.len();
        if exponent == 0.0 {
            return Self::constant(1.0, terms);
        }
        let zeros = self.order();
        if zeros == 0 {
            return self.power(exponent);
        }
        let order = zeros as f64 * exponent;
        if exponent < 0.0 {
            return Self(Vec::new());
        }
        if order >= terms as f64 {
            return Self(vec![0.0; terms]);
        }
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // between 0 and the number of terms
        let first = order.ceil() as usize;
        let mut power = vec![0.0; first];
        if order.fract() == 0.0 {
            power.extend(self.without(zeros).power(exponent).0);
            power.truncate(terms);
        }
        Self(power)
    }

    /// The same where the value is not zero: `u f' = p f u'`.
    fn power(self, exponent: f64) -> Self {
        let u = self.0;
        let mut power: Vec<f64> = Vec::with_capacity(u.len());
        for k in 0..u.len() {
            if k == 0 {
                power.push(u[0].powf(exponent));
                continue;
            }
            let sum: f64 = (1..=k).map(|j| (exponent * j as f64 - (k - j) as f64) * u[j] * power[k - j]).sum();
            power.push(sum / (k as f64 * u[0]));
        }
        Self(power)
    }

    /// The power of a series.
    #[must_use]
    pub fn pow(self, exponent: Self) -> Self {
        if exponent.0.iter().skip(1).all(|c| *c == 0.0) {
            let mut power = self.powf(exponent.value());
            power.0.truncate(exponent.0.len());
            return power;
        }
        (exponent * self.ln()).exp()
    }

    /// The square root.
    #[must_use]
    pub fn sqrt(self) -> Self {
        self.powf(0.5)
    }

    /// The cube root, also of negative numbers.
    #[must_use]
    pub fn cbrt(self) -> Self {
        if self.leading() < 0.0 {
            return -(-self).cbrt();
        }
        // A third is not a float: zeros in threes are whole powers all the same.
        let zeros = self.order();
        if zeros == 0 || !zeros.is_multiple_of(3) || zeros == self.0.len() {
            return self.powf(1.0 / 3.0);
        }
        let terms = self.0.len();
        let root = self.without(zeros).power(1.0 / 3.0);
        Self(std::iter::repeat_n(0.0, zeros / 3).chain(root.0).take(terms).collect())
    }

    /// The exponential function: `f' = f u'`.
    #[must_use]
    pub fn exp(self) -> Self {
        let slope = self.derivative().0;
        let mut power: Vec<f64> = self.0.iter().take(1).map(|value| value.exp()).collect();
        for k in 0..slope.len() {
            power.push(product(&power, &slope, k) / (k + 1) as f64);
        }
        Self(power)
    }

    /// The natural logarithm.
    #[must_use]
    pub fn ln(self) -> Self {
        self.through(f64::ln, |u| Self::constant(1.0, u.0.len()) / u)
    }

    /// The common logarithm.
    #[must_use]
    pub fn log10(self) -> Self {
        let value = self.value().log10();
        (self.ln() * LN_10.recip()).with_value(value)
    }

    /// The sine.
    #[must_use]
    pub fn sin(self) -> Self {
        let pair = (self.value().sin(), self.value().cos());
        self.rotation(pair, -1.0).0
    }

    /// The cosine.
    #[must_use]
    pub fn cos(self) -> Self {
        let pair = (self.value().sin(), self.value().cos());
        self.rotation(pair, -1.0).1
    }

    /// The hyperbolic sine.
    #[must_use]
    pub fn sinh(self) -> Self {
        let pair = (self.value().sinh(), self.value().cosh());
        self.rotation(pair, 1.0).0
    }

    /// The hyperbolic cosine.
    #[must_use]
    pub fn cosh(self) -> Self {
        let pair = (self.value().sinh(), self.value().cosh());
        self.rotation(pair, 1.0).1
    }

    /// The solution of `f' = g u'`, `g' = sign f u'`.
    fn rotation(self, (f, g): (f64, f64), sign: f64) -> (Self, Self) {
        let slope = self.derivative().0;
        let first = |value: f64| self.0.iter().take(1).map(|_| value).collect::<Vec<f64>>();
        let (mut f, mut g) = (first(f), first(g));
        for k in 0..slope.len() {
            let next = (product(&g, &slope, k), sign * product(&f, &slope, k));
            f.push(next.0 / (k + 1) as f64);
            g.push(next.1 / (k + 1) as f64);
        }
        (Self(f), Self(g))
    }

    /// The tangent: `f' = (1 + f^2) u'`.
    #[must_use]
    pub fn tan(self) -> Self {
        let value = self.value().tan();
        self.riccati(value, 1.0 + value * value, 1.0)
    }

    /// The hyperbolic tangent: `f' = (1 - f^2) u'`.
    #[must_use]
    pub fn tanh(self) -> Self {
        let secant = self.value().cosh().recip();
        let value = self.value().tanh();
        self.riccati(value, secant * secant, -1.0)
    }

    /// The solution of `f' = g u'`, `g = 1 + sign f^2`, of which both values are known.
    fn riccati(self, value: f64, slope: f64, sign: f64) -> Self {
        let by = self.derivative().0;
        let mut f: Vec<f64> = self.0.iter().take(1).map(|_| value).collect();
        let mut g = vec![slope];
        for k in 0..by.len() {
            f.push(product(&g, &by, k) / (k + 1) as f64);
            g.push(sign * product(&f, &f, k + 1));
        }
        Self(f)
    }

    /// The arc sine.
    #[must_use]
    pub fn asin(self) -> Self {
        self.through(f64::asin, |u| ((-u.clone() + 1.0) * (u + 1.0)).powf(-0.5))
    }

    /// The arc cosine.
    #[must_use]
    pub fn acos(self) -> Self {
        let value = self.value().acos();
        (-self.asin()).with_value(value)
    }

    /// The arc tangent.
    #[must_use]
    pub fn atan(self) -> Self {
        self.through(f64::atan, |u| (u.clone() * u + 1.0).powf(-1.0))
    }

    /// The inverse hyperbolic sine.
    #[must_use]
    pub fn asinh(self) -> Self {
        self.through(f64::asinh, |u| (u.clone() * u + 1.0).powf(-0.5))
    }

    /// The inverse hyperbolic cosine.
    #[must_use]
    pub fn acosh(self) -> Self {
        self.through(f64::acosh, |u| ((u.clone() + -1.0) * (u + 1.0)).powf(-0.5))
    }

    /// The inverse hyperbolic tangent.
    #[must_use]
    pub fn atanh(self) -> Self {
        self.through(f64::atanh, |u| ((-u.clone() + 1.0) * (u + 1.0)).powf(-1.0))
    }

    /// The error function.
    #[must_use]
    pub fn erf(self) -> Self {
        self.through(erf, |u| (-(u.clone() * u)).exp() * FRAC_2_SQRT_PI)
    }

    /// A function by its value and the series of its derivative; without that, the value is all there is.
    fn through(self, function: impl Fn(f64) -> f64, derivative: impl Fn(Self) -> Self) -> Self {
        if self.0.is_empty() {
            return self;
        }
        let slope = self.derivative();
        let value = function(self.value());
        Self::integral(value, &(derivative(self) * slope))
    }
}
