//! The elastic constants over a stretch of depth, and how a column of it rises over what is below.

use slipzone_api::Material;

/// Most coefficients of a polynomial.
pub(crate) const MOST: usize = 16;

/// Most orders of a series in the depth.
const ORDERS: usize = 44;

/// Terms of a series in the depth below this, times the fourth power of the wave number in units of the slice, are left out:
/// no compliance and no entry of a propagator is smaller than that power, and each keeps its relative precision.
pub(crate) const NEGLIGIBLE: f64 = f64::EPSILON / 32.0;

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
        let least = 0.5 * f64::EPSILON * terms[0].abs();
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

    /// Those of a material in units of its own modulus.
    pub(crate) fn constant(material: Material) -> Self {
        let [softness, stiffness, contraction, cross] =
            Self::of(material, material.shear).map(|value| Polynomial::new(&[value]));
        Self { softness, stiffness, contraction, cross }
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
        // Filled with what is at hand: of zeros a processor makes much ado.
        let mut orders = [bottom; ORDERS];
        let mut sum = bottom;
        let polynomials = [&self.softness, &self.stiffness, &self.contraction, &self.cross];
        let longest = polynomials.iter().map(|polynomial| polynomial.count).fold(5, usize::max);
        let negligible = NEGLIGIBLE * s.iter().fold(1.0_f64, |least, s| least.min(*s)).powi(4);
        // The same Poisson's ratio everywhere: a number in place of two polynomials.
        let is_uniform = self.contraction.count == 1;
        let beta = self.cross.terms[0] / self.softness.terms[0];
        let mut small = 0;
        for k in 1..ORDERS {
            let (known, unknown) = orders.split_at_mut(k);
            let ([last, ..], [next, ..]) = (&known[k - 1..], unknown) else { break };
            let [sheared, mut crossed] = convolve(&self.softness, known, [2, 3]);
            let [stretched] = convolve(&self.stiffness, known, [0]);
            let [mut squeezed, mut pushed] = [last[0], last[3]];
            if is_uniform {
                let lambda = self.contraction.terms[0];
                for j in 0..2 {
                    for i in 0..L {
                        crossed[j][i] *= beta;
                        squeezed[j][i] *= lambda;
                        pushed[j][i] *= lambda;
                    }
                }
            } else {
                [crossed] = convolve(&self.cross, known, [3]);
                [squeezed, pushed] = convolve(&self.contraction, known, [0, 3]);
            }
            let step = -(k as f64).recip();
            for j in 0..2 {
                for i in 0..L {
                    next[0][j][i] = (s[i] * last[1][j][i] + sheared[j][i]) * step;
                    next[1][j][i] = (crossed[j][i] - s[i] * squeezed[j][i]) * step;
                    next[2][j][i] = s[i] * (s[i] * stretched[j][i] + pushed[j][i]) * step;
                    next[3][j][i] = -s[i] * last[2][j][i] * step;
                }
            }
            let mut largest = [0.0_f64; L];
            for (sum, next) in sum.iter_mut().flatten().zip(next.iter().flatten()) {
                for i in 0..L {
                    sum[i] += next[i];
                    largest[i] = largest[i].max(next[i].abs());
                }
            }
            small = if largest.iter().all(|largest| *largest <= negligible) { small + 1 } else { 0 };
            if small >= 2 && k > longest {
                break;
            }
        }
        sum
    }
}

/// The next order of the products of a polynomial with some components of the states, all orders before known.
#[inline(always)]
fn convolve<const L: usize, const C: usize>(
    polynomial: &Polynomial,
    known: &[States<L>],
    components: [usize; C],
) -> [[[f64; L]; 2]; C] {
    let mut sums = [[[0.0; L]; 2]; C];
    for (c, order) in polynomial.coefficients().iter().zip(known.iter().rev()) {
        for (sum, component) in sums.iter_mut().zip(components) {
            let states = &order[component];
            for j in 0..2 {
                for i in 0..L {
                    sum[j][i] += c * states[j][i];
                }
            }
        }
    }
    sums
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
