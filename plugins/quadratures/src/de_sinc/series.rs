//! Sums of sinc functions over a grid that is its own mirror image.

use std::f64::consts::PI;

/// `sum_j y_j sinc(t - j)` over all whole `j`, `y_-j = y_j` (or `-y_j` when `odd`), at `t >= 0`.
///
/// `signed[j] = (-1)^j y_j` for `j >= 0`; beyond its end all are zero, and so is the sum.
#[expect(clippy::float_cmp, reason = "only an exact hit divides by zero")]
pub(super) fn at_nodes(signed: &[f64], odd: bool, t: f64) -> f64 {
    if t >= signed.len() as f64 - 1.0 {
        return 0.0;
    }
    let nearest = t.round();
    let sign = alternating(whole(nearest));
    if t == nearest {
        return sign * signed[whole(nearest)];
    }
    // 1/(t - j) + 1/(t + j) = 2 t/(t^2 - j^2), with minus 2 j/(t^2 - j^2); the middle node counts once.
    let (middle, others) = signed.split_first().expect("t < signed.len() - 1");
    let sum = if odd {
        folded(others, t, 1.0, |y, j| y * j)
    } else {
        t * folded(others, t, 1.0, |y, _| y) + 0.5 * middle / t
    };
    sign * (PI * (t - nearest)).sin() * 2.0 / PI * sum
}

/// As [`at_nodes`] for values at `j + 1/2`.
#[expect(clippy::float_cmp, reason = "only an exact hit divides by zero")]
pub(super) fn at_halves(signed: &[f64], odd: bool, t: f64) -> f64 {
    if t >= signed.len() as f64 - 0.5 {
        return 0.0;
    }
    let below = t.floor();
    let nearest = below + 0.5;
    let sign = alternating(whole(below));
    if t == nearest {
        return sign * signed[whole(below)];
    }
    // sin(pi (t - h)) = -(-1)^j cos(pi t) at h = j + 1/2; its mirror image has the opposite sign.
    let sum = if odd { t * folded(signed, t, 0.5, |y, _| y) } else { folded(signed, t, 0.5, |y, h| y * h) };
    sign * (PI * (t - nearest)).sin() * 2.0 / PI * sum
}

/// `sum_j term(y_j, h_j)/(t^2 - h_j^2)`, `h_j = j + offset`, in four independent sums.
fn folded(signed: &[f64], t: f64, offset: f64, term: impl Fn(f64, f64) -> f64) -> f64 {
    let mut sums = [0.0; 4];
    let mut h = [offset, offset + 1.0, offset + 2.0, offset + 3.0];
    let (chunks, rest) = signed.as_chunks::<4>();
    for y in chunks {
        for lane in 0..4 {
            sums[lane] += term(y[lane], h[lane]) / ((t - h[lane]) * (t + h[lane]));
            h[lane] += 4.0;
        }
    }
    for (y, h) in rest.iter().zip(h) {
        sums[0] += term(*y, h) / ((t - h) * (t + h));
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3])
}

#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // between 0 and the number of nodes
fn whole(m: f64) -> usize {
    m as usize
}

/// `(-1)^j`.
pub(super) fn alternating(j: usize) -> f64 {
    if j.is_multiple_of(2) { 1.0 } else { -1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gaussians are their own interpolants to `exp(-(pi/2)^2 s^2)` and less: 1e-17 at width `s = 4`.
    #[test]
    fn gaussians_come_back() {
        let even = |t: f64| (-(t / 4.0).powi(2)).exp();
        let odd = |t: f64| t * even(t);
        for (g, is_odd) in [(&even as &dyn Fn(f64) -> f64, false), (&odd, true)] {
            let nodes: Vec<f64> = (0..30).map(|j| alternating(j) * g(j as f64)).collect();
            let halves: Vec<f64> = (0..30).map(|j| alternating(j) * g(j as f64 + 0.5)).collect();
            for t in [0.0, 1e-300, 1e-9, 0.3, 0.5, 3.0, 3.0 + 1e-12, 4.5, 7.49, 7.5 - 1e-13, 12.9] {
                for (how, got) in [("nodes", at_nodes(&nodes, is_odd, t)), ("halves", at_halves(&halves, is_odd, t))] {
                    assert!((got - g(t)).abs() < 5e-15, "{how}, odd: {is_odd}, t = {t}: {got} for {}", g(t));
                }
            }
            assert!(at_nodes(&nodes, is_odd, f64::INFINITY).abs() < 1e-300, "nothing beyond the grid");
            assert!(at_halves(&halves, is_odd, f64::INFINITY).abs() < 1e-300, "nothing beyond the grid");
        }
    }
}
