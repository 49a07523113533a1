//! An interface blurred like a logistic curve.

use crate::transition::{Step, Transition};
use serde::{Deserialize, Serialize};
use slipzone_api::taylor::{Arithmetic, Taylor};
use slipzone_api::{Grading, ModulusLaw, Refusal, Setting};

/// `mu(y) = (above + below)/2 + (below - above)/2 tanh((y - centre)/width)`.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Sigmoid(pub Transition);

slipzone_api::register!(Grading, "sigmoid", "two materials, their interface blurred like a hyperbolic tangent",
    also: ["tanh", "logistic"],
    example: "type = \"sigmoid\"\nabove = 1.0\nbelow = 4.0\ncentre = 1.0\nwidth = 0.5",
    parameters: [
        ("above", "modulus far above the interface (stress)", true, [0.5, 1.0, 100.0], Positive),
        ("below", "modulus far below it (stress)", true, [0.25, 1.0, 4.0], Positive),
        ("centre", "depth of the interface (length)", true, [0.0, 1.0, 2.0], Number),
        ("width", "distance from `centre` at which the modulus is tanh(1) = 76 % of the way from its middle value to `below` (length)", true, [0.2, 0.5, 2.0], Positive),
    ],
    source: "DLMF 4.28.4");

#[typetag::serde(name = "sigmoid")]
impl Grading for Sigmoid {
    fn law(&self, setting: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        self.0.law::<Logistic>(setting, "a sigmoid grading")
    }
}

/// `(1 - tanh z)/2 = 1/(1 + exp(2z))`.
#[derive(Debug)]
struct Logistic;

/// The smaller and the larger of both shares, of `e = exp(-2|z|)`.
fn shares<N: Arithmetic>(e: N) -> (N, N) {
    let larger = (e.clone() * 0.0 + 1.0) / (e.clone() + 1.0);
    (e * larger.clone(), larger)
}

impl Step for Logistic {
    fn value(z: f64) -> f64 {
        let (smaller, larger) = shares((-2.0 * z.abs()).exp());
        if z > 0.0 { smaller } else { larger }
    }

    fn series(z: Taylor) -> (Taylor, Taylor) {
        let is_right = z.coefficients().first().is_some_and(|z| *z > 0.0);
        let (smaller, larger) = shares((z * if is_right { -2.0 } else { 2.0 }).exp());
        if is_right { (smaller, larger) } else { (larger, smaller) }
    }
}

/// See [`crate::link`].
pub(crate) fn link() {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_as_tanh_does() {
        crate::transition::check::<Logistic>();
        for z in [-3.0_f64, -0.4, 0.0, 0.9, 2.0] {
            assert!((Logistic::value(z) - 0.5 * (1.0 - z.tanh())).abs() < 2e-16, "{z}");
        }
    }
}
