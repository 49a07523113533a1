//! Depth exponents, free of cancellation.

/// The quantities named in [`super`].
#[derive(Debug)]
pub(super) struct Exponents {
    pub(super) a: f64,
    pub(super) epsilon: f64,
    /// `1 + epsilon`.
    pub(super) up: f64,
    /// `1 - epsilon`.
    pub(super) down: f64,
    pub(super) delta: f64,
    pub(super) p: f64,
    /// `s/a`.
    pub(super) slope: f64,
}

impl Exponents {
    /// From `a^2 + b^2 = rho`, `a^2 - b^2 = s^2 + gamma^2/4`, without differences of what may be close.
    pub(super) fn new(gamma: f64, eta: f64, s: f64) -> Self {
        // In units in which neither s nor gamma is large.
        let unit = s.max(0.5 * gamma.abs());
        let (s, half) = (s / unit, 0.5 * gamma / unit);
        let difference = (s - half) * (s + half);
        let cross = 8.0 * eta * (s * half).powi(2);
        let rho = (difference * difference + cross).sqrt();
        let a = ((s * s + half * half + rho) / 2.0).sqrt();
        // (a^2 - gamma^2/4)/s^2
        let p = if difference >= 0.0 {
            (difference + rho) / (2.0 * s * s)
        } else {
            4.0 * eta * half * half / (rho - difference)
        };
        let (epsilon, slope) = (half / a, s / a);
        let delta = p * slope * slope;
        let far = 1.0 + epsilon.abs();
        let (up, down) = if epsilon >= 0.0 { (far, delta / far) } else { (delta / far, far) };
        Self { a: a * unit, epsilon, up, down, delta, p, slope }
    }
}

/// `sin(b)/b` and `cos(b)`, given `b^2`, of any sign.
pub(super) fn sine_and_cosine(square: f64) -> (f64, f64) {
    let b = square.abs().sqrt();
    if b == 0.0 {
        (1.0, 1.0)
    } else if square > 0.0 {
        let (sin, cos) = b.sin_cos();
        (sin / b, cos)
    } else {
        (b.sinh() / b, b.cosh())
    }
}
