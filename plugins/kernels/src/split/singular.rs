//! The factors of `sign(t)` and `log|t|`, made local.

use super::column::{Column, MODERATE};
use std::f64::consts::FRAC_PI_2;

/// The singular part of a kernel, `P(t) (i pi/2 - log t)` for `t > 0` with `P = sum_k c_k (it)^(k-1)/(k-1)!`.
///
/// That is what `int_S^inf c_k exp(ist) s^-k ds` leaves at `t = 0` whatever `S` is. `P` grows like `exp(|gamma| t)`,
/// and the smooth part would have to undo it; but only `t = 0` is singular. So `P` is replaced by
/// `exp(-(t/t0)^2) [P exp((t/t0)^2)]_N`, the bracket being the Taylor polynomial of degree `N`: equal to `P` up to
/// `t^N`, of its own order, and gone beyond a few `t0`. On short reaches `1/t0 = 0`.
#[derive(Clone, Debug)]
pub(super) struct Singular {
    odd: bool,
    /// Real part of the bracket: coefficients of `1`, `t^2`, ...
    re: Vec<f64>,
    /// Imaginary part: coefficients of `t`, `t^3`, ...
    im: Vec<f64>,
    /// `1/t0^2`.
    narrowness: f64,
}

/// How much larger than the kernel's order of magnitude jump and logarithm may be on short reaches.
const TAME: f64 = 20.0;
/// Widest window, over the thickness: the smooth part then varies no faster than the layer makes it. Not over the depth
/// that the surface feels: of a jump that goes on below a skin, a window as narrow as the skin would leave the smooth
/// part a step that no node sees.
const WIDEST: f64 = 0.8;
/// The window narrows by this factor until the parts are small enough.
const NARROWER: f64 = 0.85;
/// Beyond this many `t0` a polynomial of degree [`DEGREE`] times the window is below 1e-16 of its largest value.
const GONE: f64 = 8.0;
/// Degree of the bracket at coarse accuracy; each digit adds one.
const DEGREE: usize = 12;
/// Most often narrowed: a thousandth of the depth is enough for `|gamma| h = 1e3`.
const MOST_STEPS: u32 = 45;

impl Singular {
    /// The parts of `column` on `|t| <= reach`.
    pub(super) fn new(column: &Column, thickness: f64, reach: f64) -> Self {
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // at most 16
        let digits = (-column.aim.log10()).clamp(0.0, 16.0) as usize;
        let taylor: Vec<f64> = signed_taylor(column, &column.series, DEGREE + digits).collect();
        // A skin whose modulus has no slope at the surface has a curvature there.
        let size = taylor[0].abs().max(taylor[1].abs().sqrt()).max(1.0);
        let allowed = MODERATE * size;
        let open = Self::windowed(column, &taylor, 0.0);
        // What does not grow needs no window, unless the kernel is to end as it does far away.
        let is_constant = taylor[1..].iter().all(|c| *c == 0.0);
        if (reach <= thickness || is_constant && reach <= 1.0) && open.stays_below(allowed, reach) {
            return open;
        }
        let mut t0 = WIDEST * thickness;
        let mut singular = Self::windowed(column, &taylor, 1.0 / (t0 * t0));
        for _ in 0..MOST_STEPS {
            if singular.stays_below(allowed, reach.min(GONE * t0)) {
                break;
            }
            t0 *= NARROWER;
            singular = Self::windowed(column, &taylor, 1.0 / (t0 * t0));
        }
        singular
    }

    /// Whether the parts of the first `terms` of a series, as they are, do not outgrow the kernel on `[0, reach]` by
    /// more than what a smooth rest undoes without loss.
    pub(super) fn is_tame(column: &Column, terms: usize, reach: f64) -> bool {
        let taylor: Vec<f64> = signed_taylor(column, column.used(terms), terms).collect();
        Self::windowed(column, &taylor, 0.0).stays_below(TAME * taylor[0].abs().max(1.0), reach)
    }

    fn windowed(column: &Column, taylor: &[f64], narrowness: f64) -> Self {
        let bracket: Vec<f64> = (0..taylor.len())
            .map(|j| {
                let (mut sum, mut gauss) = (0.0, 1.0);
                for m in 0..=j / 2 {
                    sum += taylor[j - 2 * m] * gauss;
                    gauss *= narrowness / (m + 1) as f64;
                }
                sum
            })
            .collect();
        Self {
            odd: column.component.is_odd(),
            re: bracket.iter().copied().step_by(2).collect(),
            im: bracket.iter().copied().skip(1).step_by(2).collect(),
            narrowness,
        }
    }

    /// The factors of `sign(t)` and of `log|t|` at `t >= 0`.
    pub(super) fn at(&self, t: f64) -> (f64, f64) {
        let t2 = t * t;
        let window = (-self.narrowness * t2).exp();
        let horner = |coefficients: &[f64]| coefficients.iter().rev().fold(0.0, |sum, c| sum * t2 + c) * window;
        let (re, im) = (horner(&self.re), t * horner(&self.im));
        // The imaginary part of P (i pi/2 - log t) in the sine transforms, the real one in the others.
        if self.odd { (FRAC_PI_2 * re, -im) } else { (-FRAC_PI_2 * im, -re) }
    }

    /// Whether both do on a grid over `[0, reach]`, the logarithm's with the logarithm where that is larger than one.
    fn stays_below(&self, allowed: f64, reach: f64) -> bool {
        (0..=64).all(|i| {
            let t = reach * f64::from(i) / 64.0;
            let (sign, log) = self.at(t);
            sign.abs() / FRAC_PI_2 <= allowed && log.abs() * t.max(1.0).ln().max(1.0) <= allowed
        })
    }

    /// Where the parts have gone.
    pub(super) fn gone(&self) -> f64 {
        GONE * self.width()
    }

    /// `t0`; infinite without a window.
    pub(super) fn width(&self) -> f64 {
        self.narrowness.sqrt().recip()
    }
}

/// `P = sum_j i^j p_j t^j`, `p_j = c_(j+1)/j!`, up to `degree`, with the sign of `i^j` put in: the even terms
/// are its real part, the odd ones its imaginary part. The pole's jump is among them.
pub(super) fn signed_taylor(column: &Column, series: &[f64], degree: usize) -> impl Iterator<Item = f64> {
    let mut factorial = 1.0;
    (0..=degree).map(move |j| {
        let p = series.get(j).map_or(0.0, |c| c / factorial) + if j == 0 { column.pole } else { 0.0 };
        factorial *= (j + 1) as f64;
        if j % 4 < 2 { p } else { -p }
    })
}
