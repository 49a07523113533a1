//! Legendre polynomials on `[-1, 1]` and their integrals against a pole, a step and a logarithm.

/// Beyond this distance from the middle of a panel (in half-lengths) the Gauss sum is as good as a product rule.
///
/// A pole at 2.5 leaves `4.8^-(2 q - m)` with `q` Gauss points against a density of degree `m`: below 1e-20 for
/// the `q` of [`super::layout::gauss_points`].
pub(super) const NEAR: f64 = 2.5;

/// Smallest distance to an end of `[-1, 1]` at which `Q_n` is evaluated. Only integrals that are continuous
/// there are asked for at an end itself; they are then off by about this much times its logarithm.
const CLOSEST: f64 = 1e-20;

/// A Gauss-Legendre rule that can also integrate what a polynomial is multiplied with.
pub(super) struct Gauss {
    /// Nodes, ascending.
    pub(super) z: Vec<f64>,
    /// Weights.
    pub(super) w: Vec<f64>,
    /// `projector[n * q + k] = (2n + 1)/2 w_k P_n(z_k)`: values at the nodes to Legendre coefficients.
    projector: Vec<f64>,
}

/// What a polynomial is integrated against, `at` being anywhere on the real line.
#[derive(Clone, Copy, Debug)]
pub(super) enum Factor {
    /// `1/(z - at)`, as a principal value.
    Pole,
    /// `sign(z - at)`.
    Step,
    /// `log|z - at|`.
    Log,
}

impl Gauss {
    /// `points` nodes.
    pub(super) fn new(points: usize) -> Self {
        let q = points;
        let rule = bilby::GaussLegendre::new(q).expect("nodes").rule().clone();
        let (z, w) = (rule.nodes, rule.weights);
        let mut projector = vec![0.0; q * q];
        let mut p = vec![0.0; q];
        for k in 0..q {
            p_into(z[k], &mut p);
            for n in 0..q {
                projector[n * q + k] = (n as f64 + 0.5) * w[k] * p[n];
            }
        }
        Self { z, w, projector }
    }

    /// `out[k]` = weights with which `int f(z) factor(z - at) dz = sum out[k] f(z_k)`, exact for polynomials
    /// of degree below the number of nodes. `moments` is scratch.
    pub(super) fn product_weights_into(&self, factor: Factor, at: f64, moments: &mut Vec<f64>, out: &mut [f64]) {
        let q = self.z.len();
        moments.resize(q + 2, 0.0);
        factor.moments_into(at, moments);
        out.fill(0.0);
        for (row, moment) in self.projector.chunks(q).zip(moments.iter()) {
            for (out, entry) in out.iter_mut().zip(row) {
                *out += moment * entry;
            }
        }
    }
}

impl Factor {
    /// `moments[n] = int P_n(z) factor(z - at) dz` over `[-1, 1]` for all but the last two entries, which are
    /// overwritten (the recurrences run ahead).
    fn moments_into(self, at: f64, moments: &mut [f64]) {
        let count = moments.len() - 2;
        match self {
            // Neumann: int P_n(z)/(at - z) dz = 2 Q_n(at).
            Self::Pole => {
                q_into(at, moments);
                for moment in moments.iter_mut() {
                    *moment *= -2.0;
                }
            }
            // d/dat int P_n log|at - z| dz = 2 Q_n(at), and (2n + 1) Q_n = Q_{n+1}' - Q_{n-1}'.
            Self::Log => {
                q_into(at, moments);
                integrate(moments, count, 2.0);
                let term = |d: f64| if d == 0.0 { 0.0 } else { d * d.abs().ln() };
                moments[0] = term(1.0 + at) + term(1.0 - at) - 2.0;
            }
            // Above `at` less below it, from the same relation between the P_n, which vanish beyond the ends.
            Self::Step => {
                if at.abs() < 1.0 {
                    p_into(at, moments);
                    integrate(moments, count, -2.0);
                } else {
                    moments.fill(0.0);
                }
                moments[0] = -2.0 * at.clamp(-1.0, 1.0);
            }
        }
    }
}

/// Turns `values[n] = f_n` into `scale (f_{n+1} - f_{n-1})/(2n + 1)` for `1 <= n <= count`.
fn integrate(values: &mut [f64], count: usize, scale: f64) {
    let mut before = values[0];
    for n in 1..=count {
        let here = values[n];
        values[n] = scale * (values[n + 1] - before) / (2 * n + 1) as f64;
        before = here;
    }
}

/// `out[n] = P_n(x)`.
fn p_into(x: f64, out: &mut [f64]) {
    out[0] = 1.0;
    out[1] = x;
    forward(x, out);
}

/// Three-term recurrence from the first two entries.
fn forward(x: f64, out: &mut [f64]) {
    for k in 1..out.len() - 1 {
        out[k + 1] = ((2 * k + 1) as f64 * x * out[k] - k as f64 * out[k - 1]) / (k + 1) as f64;
    }
}

/// `out[n] = Q_n(x)`, within `[-1, 1]` the mean of both sides of the cut.
///
/// Outside, `Q_n` is the recurrence's falling solution: run backwards (Miller's algorithm) and scaled by
/// `Q_0 = log((x + 1)/(x - 1))/2`, unless `x` is so close to the cut that forwards loses less than a digit.
fn q_into(x: f64, out: &mut [f64]) {
    let (above, below) = ((1.0 + x).abs().max(CLOSEST), (1.0 - x).abs().max(CLOSEST));
    let zeroth = 0.5 * (above / below).ln();
    let outside = (x.abs() - 1.0).max(0.0);
    // log of rho = |x| + sqrt(x^2 - 1): P_n grows and Q_n falls like rho^n.
    let rate = (outside + (outside * (2.0 + outside)).sqrt()).ln_1p();
    if 2.0 * rate * out.len() as f64 <= 2.0 {
        out[0] = zeroth;
        out[1] = x * zeroth - 1.0;
        forward(x, out);
        return;
    }
    // The start is forgotten like rho^-2 per step: 40 = -log(4e-18).
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // positive, below 40 times the length
    let ahead = (20.0 / rate).ceil() as usize;
    let (mut after, mut here) = (0.0, f64::MIN_POSITIVE.sqrt());
    for k in (1..out.len() + ahead).rev() {
        // (k + 1) Q_{k+1} = (2k + 1) x Q_k - k Q_{k-1}
        let before = ((2 * k + 1) as f64 * x * here - (k + 1) as f64 * after) / k as f64;
        (after, here) = (here, before);
        if k - 1 < out.len() {
            out[k - 1] = here;
        }
    }
    let scale = zeroth / out[0];
    for value in out.iter_mut() {
        *value *= scale;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against `int z^d factor(z - at) dz` in closed form by recurrence over `d`.
    #[test]
    fn product_rules_integrate_powers_exactly() {
        let gauss = Gauss::new(18);
        let mut weights = vec![0.0; 18];
        let mut moments = Vec::new();
        // Inside, near an end on both sides, at an end (log and step only), near and far outside.
        for at in [0.0_f64, 0.37, -0.93, 1.0 - 1e-9, 1.0 + 1e-9, 1.0 + 1e-4, -1.003, -1.02, 1.3, 2.4, 3.0] {
            let pole_of_one = ((1.0 - at) / (1.0 + at)).abs().ln();
            // int z^d/(z - at) = at int z^(d-1)/(z - at) + int z^(d-1).
            let mut pole = pole_of_one;
            for d in 0..17_i32 {
                let plain = |d: i32| if d % 2 == 0 { 2.0 / f64::from(d + 1) } else { 0.0 };
                if d > 0 {
                    pole = at * pole + plain(d - 1);
                }
                // Parts: int z^d log|z - at| = [z^(d+1) log|z - at|]/(d+1) - int z^(d+1)/(z - at)/(d+1).
                let ends = (1.0 - at).abs().ln() - (-1.0_f64).powi(d + 1) * (1.0 + at).abs().ln();
                let log = (ends - at * pole - plain(d)) / f64::from(d + 1);
                let inside = at.clamp(-1.0, 1.0);
                let step = (1.0 + (-1.0_f64).powi(d + 1) - 2.0 * inside.powi(d + 1)) / f64::from(d + 1);
                for (factor, exact) in [(Factor::Pole, pole), (Factor::Log, log), (Factor::Step, step)] {
                    gauss.product_weights_into(factor, at, &mut moments, &mut weights);
                    let got: f64 = weights.iter().zip(&gauss.z).map(|(w, z)| w * z.powi(d)).sum();
                    // The recurrence over d multiplies its own rounding by at each step.
                    let tolerance = 2e-14 * pole_of_one.abs().max(1.0) * at.abs().max(1.0).powi(d + 1);
                    assert!((got - exact).abs() < tolerance, "{factor:?} z^{d} at {at}: {got} for {exact}");
                }
            }
        }
    }

    #[test]
    fn gauss_nodes_integrate_twice_their_number() {
        for q in [4, 7, 18, 64] {
            let gauss = Gauss::new(q);
            let degree = i32::try_from(2 * q - 2).expect("small");
            let got: f64 = gauss.w.iter().zip(&gauss.z).map(|(w, z)| w * z.powi(degree)).sum();
            assert!((got - 2.0 / f64::from(degree + 1)).abs() < 1e-14, "{q} nodes: {got}");
            assert!(gauss.z.is_sorted(), "{q} nodes ascend");
        }
    }

    /// Neumann's integral by many Gauss points: the falling solution must not pick up the growing one.
    #[test]
    fn functions_of_the_second_kind_fall() {
        let many = Gauss::new(96);
        for x in [1.2_f64, -1.5, 2.4] {
            let mut q = [0.0; 24];
            q_into(x, &mut q);
            let mut exact = [0.0; 24];
            for (z, w) in many.z.iter().zip(&many.w) {
                let mut p = [0.0; 24];
                p_into(*z, &mut p);
                exact.iter_mut().zip(p).for_each(|(sum, p)| *sum += 0.5 * w * p / (x - z));
            }
            for (n, (q, exact)) in q.iter().zip(exact).enumerate() {
                assert!((q - exact).abs() < 1e-14, "Q_{n}({x}) = {q:e}, not {exact:e}");
            }
        }
    }
}
