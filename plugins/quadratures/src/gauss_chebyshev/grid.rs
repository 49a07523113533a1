//! Chebyshev nodes at `t > 0`, their weights, and interpolation through them.

use std::f64::consts::PI;

/// Which Chebyshev polynomial has its zeros at the nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// `T_n`, for densities `F/sqrt(1 - t^2)`.
    First,
    /// `U_n`, for densities `F sqrt(1 - t^2)`.
    Second,
}

/// The positive half of `n` nodes (`n` even).
///
/// Nodes and the points half way between them lie at whole multiples of half a step, so that one table
/// of sines serves every difference of two cosines.
pub(super) struct Grid {
    kind: Kind,
    /// Angles of the nodes, ascending.
    pub(super) angle: Vec<f64>,
    /// `sin(k step/4)` up to the angle `pi/2`.
    quarter_sines: Vec<f64>,
    /// Nodes, `cos(angle)`, descending.
    pub(super) t: Vec<f64>,
    /// Gauss weights of the density's edge factor: `int F w dt = sum weight (F(t) + F(-t))`.
    pub(super) weight: Vec<f64>,
}

impl Grid {
    pub(super) fn new(kind: Kind, n: usize) -> Self {
        let step = step(kind, n);
        let angle: Vec<f64> = (1..=n / 2)
            .map(|j| match kind {
                Kind::First => (j as f64 - 0.5) * step,
                Kind::Second => j as f64 * step,
            })
            .collect();
        let t = angle.iter().map(|a| a.cos()).collect();
        let weight = angle
            .iter()
            .map(|a| match kind {
                Kind::First => step,
                Kind::Second => step * a.sin().powi(2),
            })
            .collect();
        let right_angle = (2.0 * PI / step).round();
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // 2 n or 2 (n + 1)
        let quarter_sines = (0..=right_angle as usize).map(|k| (0.5 * PI * k as f64 / right_angle).sin()).collect();
        Self { kind, angle, quarter_sines, t, weight }
    }

    /// `cos(alpha) - cos(theta)` and `cos(alpha) + cos(theta)` for the `i`-th staggered angle (the middle
    /// one last) and the `j`-th node, both without cancellation.
    pub(super) fn minus_and_plus(&self, i: usize, j: usize) -> (f64, f64) {
        // Angles in half steps: nodes at odd and staggered points at even multiples, or the reverse.
        let (node, staggered) = match self.kind {
            Kind::First => (2 * j + 1, 2 * i + 2),
            Kind::Second => (2 * j + 2, 2 * i + 1),
        };
        let (sum, difference) = (node + staggered, node.abs_diff(staggered));
        let sine = |k: usize| self.quarter_sines[k];
        let cosine = |k: usize| self.quarter_sines[self.quarter_sines.len() - 1 - k];
        // cos a - cos b = -2 sin((a + b)/2) sin((a - b)/2), cos a + cos b = 2 cos((a + b)/2) cos((a - b)/2)
        let minus = if staggered > node { -2.0 } else { 2.0 } * sine(sum) * sine(difference);
        (minus, 2.0 * cosine(sum) * cosine(difference))
    }

    fn n(&self) -> usize {
        2 * self.t.len()
    }

    /// Angles half way between the nodes, those of `t > 0`, ascending.
    pub(super) fn staggered_angles(&self) -> Vec<f64> {
        let step = step(self.kind, self.n());
        match self.kind {
            Kind::First => (1..self.n() / 2).map(|m| m as f64 * step).collect(),
            Kind::Second => (1..=self.n() / 2).map(|i| (i as f64 - 0.5) * step).collect(),
        }
    }

    /// Weights of a function without edge factor, `int g dt = sum weight (g(t) + g(-t))`: Fejer's second
    /// rule (nodes of the second kind).
    pub(super) fn plain_weights(&self) -> Vec<f64> {
        debug_assert_eq!(self.kind, Kind::Second);
        let step = step(self.kind, self.n());
        let weight = |a: &f64| {
            let sum: f64 = (1..=self.n() / 2).map(|m| ((2 * m - 1) as f64 * a).sin() / (2 * m - 1) as f64).sum();
            4.0 / PI * step * a.sin() * sum
        };
        self.angle.iter().map(weight).collect()
    }

    /// `F(t)` from its values at the positive nodes and its mirror factor (barycentric).
    #[expect(clippy::float_cmp, reason = "only an exact hit divides by zero")]
    pub(super) fn interpolate(&self, values: &[f64], mirror: f64, t: f64) -> f64 {
        let (mut above, mut below) = (0.0, 0.0);
        let mut sign = 1.0;
        for ((value, node), angle) in values.iter().zip(&self.t).zip(&self.angle) {
            if t == *node {
                return *value;
            }
            if t == -*node {
                return mirror * value;
            }
            let weight = sign * if self.kind == Kind::First { angle.sin() } else { angle.sin().powi(2) };
            // n is even, so the mirrored node has the opposite weight.
            let (here, there) = (weight / (t - node), -weight / (t + node));
            above += value * (here + mirror * there);
            below += here + there;
            sign = -sign;
        }
        above / below
    }

    /// Chebyshev coefficients `a_k` of `F w sqrt(1 - t^2) = sum a_k T_k`, `w` being the edge factor.
    pub(super) fn series(&self, values: &[f64], mirror: f64) -> Vec<f64> {
        let n = self.n();
        let scale = 2.0 * step(self.kind, n) / PI;
        // Sum over both halves of the nodes: twice the positive half where the parities agree, else 0.
        let project = |k: usize, wave: &dyn Fn(f64) -> f64| -> f64 {
            let even = if k.is_multiple_of(2) { 1.0 } else { -1.0 };
            if even * mirror < 0.0 {
                return 0.0;
            }
            2.0 * scale * values.iter().zip(&self.angle).map(|(v, a)| v * wave(*a)).sum::<f64>()
        };
        match self.kind {
            Kind::First => {
                (0..n).map(|k| project(k, &|a| (k as f64 * a).cos()) * if k == 0 { 0.5 } else { 1.0 }).collect()
            }
            Kind::Second => {
                // F = sum b_l U_l, and U_l sin^2 = (T_l - T_{l+2})/2.
                let b: Vec<f64> = (0..n).map(|l| project(l, &|a| a.sin() * ((l + 1) as f64 * a).sin())).collect();
                (0..n + 2)
                    .map(|k| 0.5 * (b.get(k).copied().unwrap_or(0.0) - if k < 2 { 0.0 } else { b[k - 2] }))
                    .collect()
            }
        }
    }
}

/// Angle between neighbouring nodes.
fn step(kind: Kind, n: usize) -> f64 {
    match kind {
        Kind::First => PI / n as f64,
        Kind::Second => PI / (n + 1) as f64,
    }
}

/// `sum_k a_k cos(k alpha)/k` and `sum_k a_k sin(k alpha)/k` over `k >= 1` (Clenshaw).
pub(super) fn over_order(series: &[f64], alpha: f64) -> (f64, f64) {
    let twice = 2.0 * alpha.cos();
    let (mut older, mut newer) = (0.0, 0.0);
    for (k, a) in series.iter().enumerate().skip(1).rev() {
        (older, newer) = (newer, twice * newer - older + a / k as f64);
    }
    (0.5 * twice * newer - older, newer * alpha.sin())
}
