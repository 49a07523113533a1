//! The minors of the bonded solutions, instead of the solutions themselves.
//!
//! The 2x2 minors of two states `(u, v, sigma_xy, sigma_yy)` that vanish at the base obey linear equations of their
//! own. With `D = [sigma_xy, sigma_yy]` the flexibilities are `vv = W/D`, `uu = X/D`, `uv = Z/D`. Let `E` be `D` times
//! `vv uu - uv^2`; then the Riccati equation of `surface_tail` becomes, over the distance from the base, with stresses
//! in units of the local modulus and `eta = 1 - beta`,
//!
//! ```text
//! D' = gamma D + 2 s X,    X' = 2 s (eta D - Z),    Z' = s (lambda X - W),
//! W' = 2 s (lambda Z + beta eta D + E),             E' = -gamma E + 2 s eta (W + beta X),
//! ```
//!
//! from `(D, X, Z, W, E) = (1, 0, 0, 0, 0)`. The eigenvalues are sums of two of the depth exponents
//! `-gamma/2 +- (a +- i b)` (CC13 eq. 20), beside `gamma`: `2a`, `-2a`, `0`, `2ib`, `-2ib`. With
//!
//! ```text
//! epsilon = gamma/(2a),    delta = 1 - epsilon^2,    p = 1 + lambda epsilon^2 = delta a^2/s^2,    b^2 = lambda s^2 epsilon^2
//! ```
//!
//! the eigenvector of `2a` is, but for a factor,
//!
//! ```text
//! D = (1 + epsilon)^2,    X = (s/a) p (1 + epsilon),    Z = delta (lambda (1 + 2 epsilon) - 1)/2,
//! W = (s/a) p (1 - lambda epsilon),                     E = eta (1 - epsilon) (3 + epsilon - lambda (1 + 3 epsilon))/2.
//! ```
//!
//! That of `-2a` follows by `epsilon -> -epsilon`, `a -> -a`. The form `X W - Z^2 - D E` is invariant, so that the left
//! eigenvectors are the right ones of the opposite eigenvalue: the start contains the two as `E(-epsilon)` and
//! `E(epsilon)` over `4 p (p + lambda epsilon^2 delta)`. What they leave of the start belongs to the other three, among
//! which the propagator is `1 + M sin(2b)/(2b) + M^2 (1 - cos(2b))/(2b)^2`, `M` being the matrix of the equations: it
//! does not mind `b = 0`, nor `b^2 < 0` (`lambda < 0`, real exponents).
//!
//! All of it times `exp(-2a)` gives [`Minors::thick`]; at `gamma = 0` it is the homogeneous layer of the theory's
//! section 2. Nothing is divided by `gamma`, `b` or `kappa - 1`, and what tends to zero with `s` does so by a factor.

mod exponents;

use exponents::{Exponents, sine_and_cosine};
use slipzone_api::{Elastic, SurfaceFlexibility};

/// Largest `max(s, |gamma|/2)` of a layer that is summed as a power series. Below, the closed form cancels: like
/// `1/s^3` in the worst case (`vv` of an incompressible layer), at 0.6 by a factor of 20.
const THIN: f64 = 0.6;

/// Terms of that series: its eigenvalues are at most `2a = 1.9`, and `1.9^24/24! = 8e-18`.
const TERMS: u8 = 23;

/// The minors at the surface of `mu1 exp(gamma y)` on a rigid base.
#[derive(Debug)]
pub(crate) struct Minors {
    gamma: f64,
    lambda: f64,
    beta: f64,
    /// `1 - beta = (1 + lambda)/2`.
    eta: f64,
}

impl Minors {
    pub(crate) fn new(elastic: Elastic, gamma: f64) -> Self {
        Self { gamma, lambda: elastic.lambda(), beta: elastic.beta(), eta: 2.0 / (1.0 + elastic.kappa) }
    }

    pub(super) fn surface(&self, s: f64) -> SurfaceFlexibility {
        if s.max(0.5 * self.gamma.abs()) < THIN { self.thin(s) } else { self.thick(s) }
    }

    /// The minors by their Taylor series over the distance from the base.
    pub(super) fn thin(&self, s: f64) -> SurfaceFlexibility {
        let Self { gamma, lambda, beta, eta } = *self;
        let mut term = [1.0, 0.0, 0.0, 0.0, 0.0];
        let mut sum = term;
        for k in 1..=TERMS {
            let [d, x, z, w, e] = term;
            let step = f64::from(k).recip();
            let (s, gamma) = (s * step, gamma * step);
            term = [
                gamma * d + 2.0 * s * x,
                2.0 * s * (eta * d - z),
                s * (lambda * x - w),
                2.0 * s * (lambda * z + beta * eta * d + e),
                2.0 * s * eta * (w + beta * x) - gamma * e,
            ];
            sum = std::array::from_fn(|i| sum[i] + term[i]);
        }
        let [d, x, z, w, _] = sum;
        SurfaceFlexibility { vv: w / d, uu: x / d, uv: z / d }
    }

    /// The minors by the exponentials, all of them times `8 p (p + lambda epsilon^2 delta) exp(-2a)/eta`.
    pub(super) fn thick(&self, s: f64) -> SurfaceFlexibility {
        let Self { lambda, beta, eta, .. } = *self;
        let Exponents { a, epsilon, up, down, delta, p, slope } = Exponents::new(self.gamma, eta, s);
        let square = epsilon * epsilon;
        let (sine, cosine) = sine_and_cosine(lambda * (s * epsilon).powi(2));
        // sin(2b)/(2b) and (1 - cos(2b))/(2b)^2 with the powers of a, and the fading, that go with them.
        let fade = (-2.0 * a).exp();
        let first = a * fade * sine * cosine;
        let second = a * (a * fade) * (sine * sine / 2.0);
        // 2 E(-epsilon)/(eta up) of the growing and 2 E(epsilon)/(eta down) of the decaying exponential.
        let (grow, decay) = (self.slant(-epsilon, up, down), self.slant(epsilon, down, up) * fade * fade);

        let d = up.powi(3) * grow
            + down.powi(3) * decay
            + delta / eta
                * (fade
                    * (16.0 * eta * eta + delta * (2.0 * eta * (1.0 - 11.0 * lambda) + 8.0 * lambda * lambda * delta))
                    - 16.0 * p * epsilon * lambda * delta * first
                    - 16.0 * delta * (2.0 * square * lambda * (eta - delta * lambda) - eta * eta) * second);
        let x = up * up * grow
            - down * down * decay
            - fade * 2.0 * epsilon * (2.0 * eta * (3.0 * square + 1.0) + 4.0 * delta)
            + 8.0 * delta * (2.0 * square * lambda + eta) * first
            + 16.0 * epsilon * delta * (2.0 * square * lambda - eta) * second;
        let w = up * grow * self.contraction(epsilon, down, up)
            - down * decay * self.contraction(-epsilon, up, down)
            - fade * 2.0 * epsilon * (8.0 * beta * eta + delta * lambda * (3.0 * lambda - 1.0))
            - 8.0 * delta * (eta - 2.0 * square * lambda * beta) * first
            - 16.0 * epsilon * lambda * delta * (eta - 2.0 * beta * square) * second;
        let z = up * grow * (lambda * (1.0 + 2.0 * epsilon) - 1.0) / 2.0
            + down * decay * (lambda * (1.0 - 2.0 * epsilon) - 1.0) / 2.0
            - fade * (4.0 * eta * (3.0 * lambda - 1.0) - delta * (7.0 * lambda * lambda + 1.0))
            - 4.0 * epsilon * p * (3.0 * lambda - 1.0) * first
            + 8.0 * delta * (square * lambda * (3.0 * lambda - 1.0) + 2.0 * eta * eta) * second;
        SurfaceFlexibility { vv: p * slope * w / d, uu: p * slope * x / d, uv: delta * z / d }
    }

    /// The eigenvector of `2a` alone: what is left of a layer whose base is out of sight, `gamma >= 0` or `s > 0`.
    pub(crate) fn infinite(&self, s: f64) -> SurfaceFlexibility {
        let Self { lambda, .. } = *self;
        if s == 0.0 {
            return SurfaceFlexibility::default();
        }
        let Exponents { epsilon, up, down, delta, p, slope, .. } = Exponents::new(self.gamma, self.eta, s);
        let coupling = delta * (lambda * (1.0 + 2.0 * epsilon) - 1.0) / (2.0 * up * up);
        let common = p * slope / up;
        SurfaceFlexibility { vv: common * self.contraction(epsilon, down, up) / up, uu: common, uv: coupling }
    }

    /// `3 + x - lambda (1 + 3 x)`, given `1 - x` and `1 + x` as well: two positive terms.
    fn slant(&self, x: f64, one_minus: f64, one_plus: f64) -> f64 {
        let weight = 1.0 + 3.0 * x;
        if weight >= 0.0 { 2.0 * (one_minus + self.beta * weight) } else { 4.0 * one_plus - 2.0 * self.eta * weight }
    }

    /// `1 - lambda x`, likewise.
    fn contraction(&self, x: f64, one_minus: f64, one_plus: f64) -> f64 {
        if self.lambda * x <= 0.0 {
            1.0 - self.lambda * x
        } else if self.lambda > 0.0 {
            2.0 * self.beta + self.lambda * one_minus
        } else {
            2.0 * self.eta - self.lambda * one_plus
        }
    }
}
