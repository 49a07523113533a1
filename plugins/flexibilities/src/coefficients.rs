//! The elastic constants over a stretch of depth, and how a column of it rises over what is below.

use slipzone_api::Material;

/// Most coefficients of a polynomial.
pub(crate) const MOST: usize = 16;

/// Most orders of a series in the depth.
const ORDERS: usize = 44;

/// Terms of a series below this, times the fourth power of the wave number in units of the slice, are left out: no
/// compliance is smaller than that power, and each keeps its relative precision.
const NEGLIGIBLE: f64 = f64::EPSILON / 32.0;

/// A polynomial, constant first.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Polynomial {
    terms: [f64; MOST],
    count: usize,
}

impl Polynomial {
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
    pub(crate) fn window(&self, start: f64, width: f64) -> Self {
        let mut window = *self;
        let terms = &mut window.terms[..self.count];
        for low in 0..self.count.saturating_sub(1) {
            for k in (low..self.count - 1).rev() {
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

/// The coefficients of the equations of plane elasticity, polynomials in the depth.
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
}

/// A compliance `d = C t` for each of some wave numbers: rows `u`, `v`, columns `sigma_xy`, `sigma_yy`.
pub(crate) type Compliances<const L: usize> = [[[f64; L]; 2]; 2];

/// Two states `(u, v, sigma_xy, sigma_yy)` for each of some wave numbers: components, states.
type States<const L: usize> = [[[f64; L]; 2]; 4];

impl Coefficients {
    /// Those of one point: softness, stiffness, contraction, cross, the modulus in units of `unit`.
    pub(crate) fn of(material: Material, unit: f64) -> [f64; 4] {
        let Material { shear, elastic } = material;
        let mu = shear / unit;
        [1.0 / mu, 8.0 * mu / (1.0 + elastic.kappa), elastic.lambda(), elastic.beta() / mu]
    }

    /// Over a part of the stretch.
    pub(crate) fn window(&self, start: f64, width: f64) -> Self {
        Self {
            softness: self.softness.window(start, width),
            stiffness: self.stiffness.window(start, width),
            contraction: self.contraction.window(start, width),
            cross: self.cross.window(start, width),
        }
    }

    /// What two states at the bottom of a slice of thickness 1 are at its top, at wave numbers `s`: the series in the
    /// distance from the bottom, in which the coefficients are polynomials here, of
    ///
    /// ```text
    /// u' = s v + sigma_xy/mu                       sigma_xy' = 8 mu s^2/(1 + kappa) u + lambda s sigma_yy
    /// v' = -lambda s u + (beta/mu) sigma_yy        sigma_yy' = -s sigma_xy
    /// ```
    ///
    /// with the depth as variable, which falls.
    #[inline(always)]
    pub(crate) fn rise<const L: usize>(&self, s: &[f64; L], bottom: States<L>) -> States<L> {
        let mut orders = [[[[0.0; L]; 2]; 4]; MOST];
        orders[0] = bottom;
        let mut sum = bottom;
        let polynomials = [&self.softness, &self.stiffness, &self.contraction, &self.cross];
        let longest = polynomials.iter().map(|polynomial| polynomial.count).fold(5, usize::max);
        let negligible = NEGLIGIBLE * s.iter().fold(1.0_f64, |least, s| least.min(*s)).powi(4);
        let mut small = 0;
        for k in 0..ORDERS {
            let step = -((k + 1) as f64).recip();
            let last = &orders[k % MOST];
            let mut next = [[[0.0; L]; 2]; 4];
            let [mut sheared, mut stretched] = [[[0.0; L]; 2]; 2];
            convolve(&self.softness, &orders, 2, k, &mut sheared);
            convolve(&self.stiffness, &orders, 0, k, &mut stretched);
            let [mut crossed, mut squeezed, mut pushed] = [[[0.0; L]; 2]; 3];
            convolve(&self.cross, &orders, 3, k, &mut crossed);
            convolve(&self.contraction, &orders, 0, k, &mut squeezed);
            convolve(&self.contraction, &orders, 3, k, &mut pushed);
            let mut largest = 0.0_f64;
            for j in 0..2 {
                for i in 0..L {
                    next[0][j][i] = (s[i] * last[1][j][i] + sheared[j][i]) * step;
                    next[1][j][i] = (crossed[j][i] - s[i] * squeezed[j][i]) * step;
                    next[2][j][i] = s[i] * (s[i] * stretched[j][i] + pushed[j][i]) * step;
                    next[3][j][i] = -s[i] * last[2][j][i] * step;
                }
            }
            for (sum, next) in sum.iter_mut().flatten().flatten().zip(next.iter().flatten().flatten()) {
                *sum += next;
                largest = largest.max(next.abs());
            }
            orders[(k + 1) % MOST] = next;
            small = if largest <= negligible { small + 1 } else { 0 };
            if small >= 2 && k >= longest {
                break;
            }
        }
        sum
    }
}

/// Adds the `k`-th order, the last of those kept, of the product of a polynomial with a component of the states.
#[inline(always)]
fn convolve<const L: usize>(
    polynomial: &Polynomial,
    orders: &[States<L>; MOST],
    component: usize,
    k: usize,
    sum: &mut [[f64; L]; 2],
) {
    let count = polynomial.count.min(k + 1);
    for (back, c) in polynomial.terms[..count].iter().enumerate() {
        let states = &orders[(k - back) % MOST][component];
        for j in 0..2 {
            for i in 0..L {
                sum[j][i] += c * states[j][i];
            }
        }
    }
}

/// `d t^-1` of two states: the compliance that both obey.
#[inline(always)]
pub(crate) fn compliance<const L: usize>(states: &States<L>) -> Compliances<L> {
    let [u, v, shear, normal] = states;
    let mut compliance = [[[0.0; L]; 2]; 2];
    for i in 0..L {
        let determinant = (shear[0][i] * normal[1][i] - shear[1][i] * normal[0][i]).recip();
        for (row, d) in compliance.iter_mut().zip([u, v]) {
            row[0][i] = (d[0][i] * normal[1][i] - d[1][i] * normal[0][i]) * determinant;
            row[1][i] = (d[1][i] * shear[0][i] - d[0][i] * shear[1][i]) * determinant;
        }
    }
    compliance
}
