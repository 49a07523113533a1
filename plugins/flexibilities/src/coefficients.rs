//! The elastic constants over a stretch of depth.

use slipzone_api::Material;

/// Most coefficients of a polynomial.
pub(crate) const MOST: usize = 16;

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

/// Places of some among those of one point.
pub(crate) const SOFTNESS: usize = 0;
pub(crate) const CONTRACTION: usize = 2;
pub(crate) const CROSS: usize = 3;

impl Coefficients {
    /// Those of one point: softness, stiffness, contraction, cross, the modulus in units of `unit`.
    pub(crate) fn of(material: Material, unit: f64) -> [f64; 4] {
        let Material { shear, elastic } = material;
        let mu = shear / unit;
        [1.0 / mu, 8.0 * mu / (1.0 + elastic.kappa), elastic.lambda(), elastic.beta() / mu]
    }

    /// Softness, stiffness, contraction, cross at one point.
    pub(crate) fn at(&self, x: f64) -> [f64; 4] {
        [&self.softness, &self.stiffness, &self.contraction, &self.cross].map(|polynomial| polynomial.at(x))
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
}
