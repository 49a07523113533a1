//! The elastic constants of a stretch of depth, and what they make of a state at its top.

use nalgebra::Matrix4;
use slipzone_api::Material;

/// Most coefficients of a polynomial.
pub(crate) const MOST: usize = 16;

/// Most orders of a propagator's series.
const ORDERS: usize = 64;

/// Terms of a propagator below this, times the fourth power of the wave number in units of the slice, are left out: no
/// entry is smaller than that power, and each keeps its relative precision.
const NEGLIGIBLE: f64 = f64::EPSILON / 32.0;

/// A polynomial, constant first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polynomial {
    terms: [f64; MOST],
    count: usize,
}

impl Polynomial {
    pub(crate) fn constant(value: f64) -> Self {
        let mut terms = [0.0; MOST];
        terms[0] = value;
        Self { terms, count: 1 }
    }

    /// From as many coefficients as there are, at most [`MOST`].
    pub(crate) fn new(coefficients: &[f64]) -> Self {
        let mut terms = [0.0; MOST];
        terms[..coefficients.len()].copy_from_slice(coefficients);
        Self { terms, count: coefficients.len().max(1) }
    }

    pub(crate) fn coefficients(&self) -> &[f64] {
        &self.terms[..self.count]
    }

    pub(crate) fn at(&self, x: f64) -> f64 {
        self.coefficients().iter().rev().fold(0.0, |sum, c| sum * x + c)
    }

    /// `t -> self(start + width t)`, powers that do not matter on `[0, 1]` dropped.
    fn window(&self, start: f64, width: f64) -> Self {
        let mut window = *self;
        let count = self.count;
        let terms = &mut window.terms[..count];
        for low in 0..count.saturating_sub(1) {
            for k in (low..count - 1).rev() {
                terms[k] += start * terms[k + 1];
            }
        }
        let mut power = 1.0;
        for term in terms.iter_mut() {
            *term *= power;
            power *= width;
        }
        let least = 0.25 * f64::EPSILON * terms[0].abs();
        window.count = 1 + terms.iter().rposition(|term| term.abs() > least).unwrap_or(0);
        window
    }
}

/// The coefficients of the equations of plane elasticity, in units of a shear modulus that grows like `exp(gamma y)`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Coefficients {
    /// `1/mu`.
    pub(crate) softness: Polynomial,
    /// `8 mu/(1 + kappa)`: twice the plane modulus.
    pub(crate) stiffness: Polynomial,
    /// `lambda = (3 - kappa)/(1 + kappa)`.
    pub(crate) contraction: Polynomial,
    /// `beta/mu`.
    pub(crate) cross: Polynomial,
    /// Growth of the unit of stress over a unit of depth.
    pub(crate) gamma: f64,
}

impl Coefficients {
    /// Those of one point: softness, stiffness, contraction, cross, the modulus in units of `unit`.
    pub(crate) fn of(material: Material, unit: f64) -> [f64; 4] {
        let Material { shear, elastic } = material;
        let mu = shear / unit;
        [1.0 / mu, 8.0 * mu / (1.0 + elastic.kappa), elastic.lambda(), elastic.beta() / mu]
    }

    /// Those of a material whose modulus is the unit of stress, which grows by `exp(gamma)`.
    pub(crate) fn exponential(material: Material, gamma: f64) -> Self {
        let [softness, stiffness, contraction, cross] = Self::of(material, material.shear).map(Polynomial::constant);
        Self { softness, stiffness, contraction, cross, gamma }
    }

    /// Over a part of the stretch.
    pub(crate) fn window(&self, start: f64, width: f64) -> Self {
        Self {
            softness: self.softness.window(start, width),
            stiffness: self.stiffness.window(start, width),
            contraction: self.contraction.window(start, width),
            cross: self.cross.window(start, width),
            gamma: self.gamma * width,
        }
    }

    /// The state `(u, v, sigma_xy, sigma_yy)` at `y = 1` for each unit state at `y = 0`, at wave number `s`: the series in
    /// `y` of
    ///
    /// ```text
    /// u' = s v + sigma_xy/mu                                 sigma_xy' = 8 mu s^2/(1 + kappa) u + lambda s sigma_yy - gamma sigma_xy
    /// v' = -lambda s u + (beta/mu) sigma_yy                  sigma_yy' = -s sigma_xy - gamma sigma_yy
    /// ```
    pub(crate) fn propagator(&self, s: f64) -> Matrix4<f64> {
        let mut orders = Orders::default();
        for i in 0..4 {
            orders.0[i][0][i] = 1.0;
        }
        let mut sum: [Row; 4] = std::array::from_fn(|i| orders.0[i][0]);
        let longest = [&self.softness, &self.stiffness, &self.contraction, &self.cross].map(|p| p.count);
        let longest = longest.into_iter().fold(5, usize::max);
        let negligible = NEGLIGIBLE * s.min(1.0).powi(4);
        let mut small = 0;
        for k in 0..ORDERS - 1 {
            let [u, v, shear, normal] = &orders.0;
            let (sheared, crossed) = (convolve(&self.softness, shear, k), convolve(&self.cross, normal, k));
            let (stretched, squeezed) = (convolve(&self.stiffness, u, k), convolve(&self.contraction, u, k));
            let pushed = convolve(&self.contraction, normal, k);
            let step = ((k + 1) as f64).recip();
            let gamma = self.gamma;
            let next: [Row; 4] = [
                std::array::from_fn(|i| (s * v[k][i] + sheared[i]) * step),
                std::array::from_fn(|i| (crossed[i] - s * squeezed[i]) * step),
                std::array::from_fn(|i| (s * (s * stretched[i] + pushed[i]) - gamma * shear[k][i]) * step),
                std::array::from_fn(|i| -(s * shear[k][i] + gamma * normal[k][i]) * step),
            ];
            let mut largest = 0.0_f64;
            for (row, (sum, next)) in orders.0.iter_mut().zip(sum.iter_mut().zip(&next)) {
                for i in 0..4 {
                    sum[i] += next[i];
                    largest = largest.max(next[i].abs());
                }
                row[k + 1] = *next;
            }
            small = if largest <= negligible { small + 1 } else { 0 };
            if small >= 2 && k >= longest {
                break;
            }
        }
        Matrix4::from_fn(|i, j| sum[i][j])
    }
}

/// One component of the state for each unit state at the top.
type Row = [f64; 4];

/// The components of the state, order by order.
struct Orders([[Row; ORDERS]; 4]);

impl Default for Orders {
    fn default() -> Self {
        Self([[[0.0; 4]; ORDERS]; 4])
    }
}

/// The `k`-th order of a product.
#[inline]
fn convolve(polynomial: &Polynomial, orders: &[Row; ORDERS], k: usize) -> Row {
    let count = polynomial.count.min(k + 1);
    let mut sum = [0.0; 4];
    for (c, row) in polynomial.terms[..count].iter().zip(orders[k + 1 - count..=k].iter().rev()) {
        for i in 0..4 {
            sum[i] += c * row[i];
        }
    }
    sum
}
