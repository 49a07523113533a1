//! How deep a flat punch sinks into a half-plane, in closed form.

use std::f64::consts::PI;

/// The depth of a flat punch of unit force over `A0`, up to a constant, or counted from the depth of a datum.
///
/// A force at the distance `x` lowers the surface by `(A0/pi) (ln(r/|x|) - (1 - beta) d^2/r^2)` more than the depth `d`
/// below it, `r^2 = x^2 + d^2` (Flamant; K. L. Johnson, *Contact Mechanics*, section 2.2). Of all forces `1/(pi
/// sqrt(b^2 - x^2))` that is
///
/// ```text
/// (1/pi) [ln((d + sqrt(d^2 + b^2))/b) - (1 - beta) d/sqrt(d^2 + b^2)],
/// ```
///
/// which varies over the distance to the datum. On a layer the difference from it varies as the layer makes it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HalfPlaneDepth {
    datum: Option<f64>,
    beta: f64,
}

impl HalfPlaneDepth {
    pub(crate) fn new(datum: Option<f64>, beta: f64) -> Self {
        Self { datum, beta }
    }

    /// Under a punch of that half-width.
    pub(crate) fn at(&self, b: f64) -> f64 {
        let Some(d) = self.datum else { return -b.ln() / PI };
        let r = d.hypot(b);
        // ln((d + r)/b) without cancellation.
        ((d / b).asinh() - (1.0 - self.beta) * d / r) / PI
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By Gauss and Chebyshev, in which the forces are the weight.
    #[test]
    fn it_is_the_sum_of_all_forces() {
        let (b, nu): (f64, f64) = (0.7, 0.3);
        let beta = (1.0 - 2.0 * nu) / (2.0 - 2.0 * nu);
        for d in [0.3_f64, 1.0, 20.0] {
            let count = 4000;
            let of_force = |i: usize| {
                let x = b * (PI * (i as f64 + 0.5) / count as f64).cos();
                let r = d.hypot(x);
                // `ln(1/|x|)` has the mean `ln(2/b)`.
                r.ln() - d * d / (r * r) / (2.0 - 2.0 * nu)
            };
            let sum = (0..count).map(of_force).sum::<f64>() / count as f64 + (2.0 / b).ln();
            let told = HalfPlaneDepth::new(Some(d), beta).at(b);
            assert!((told - sum / PI).abs() < 1e-12, "{told} for {} at {d}", sum / PI);
        }
    }

    #[test]
    fn a_datum_far_below_is_a_constant() {
        let [with, without] = [Some(1e6), None].map(|datum| HalfPlaneDepth::new(datum, 0.2));
        let apart = [1.0, 2.0].map(|b| with.at(b) - without.at(b));
        assert!(
            (apart[0] - apart[1]).abs() < 1e-11 && (apart[0] - (2e6_f64.ln() - 0.8) / PI).abs() < 1e-11,
            "{apart:?}"
        );
    }
}
