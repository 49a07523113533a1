//! Where the integral over wave numbers is cut, and how many terms of the series stand for the rest.

use super::column::Column;
use super::exponential_integral;
use crate::piece::LARGEST_LOG;
use arrayvec::ArrayVec;
use num_complex::Complex64;
use slipzone_api::{LayerResponse, Refusal, SurfaceFlexibility};

/// The cut `S` and the number of terms of `s F` used beyond it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Cut {
    pub(super) cutoff: f64,
    /// Where it would be for the depth alone, whatever the series asks for.
    pub(super) nearest: f64,
    pub(super) terms: usize,
}

/// Most terms of the series that are asked for.
pub(super) const MOST_TERMS: usize = 40;

/// Furthest cut, over the depth, for a series that ends before it is small.
const FURTHEST: f64 = 1e4;

/// Step by which the cut moves out until the series suffices.
const STEP: f64 = 1.1;

/// Part of the error that the estimates of either remainder may take.
const SHARE: f64 = 0.2;

/// Wave numbers at which the remainder is looked at.
pub(super) const CHECKS: usize = 2;

/// The base's remainder falls like `exp(-2 s d)` times powers: its integral is half of it over the depth, and a little
/// more. This times it over the depth is three times as much.
const SAFETY: f64 = 1.5;

/// Part of the error that the transforms of the series may take: too little to be counted.
const TRANSFORMED: f64 = 1e-3;

/// Decay of the base's remainder from one check to the other.
const E_SQUARED: f64 = 7.4;

impl Cut {
    /// The nearest cut at which both remainders should be below their shares of `aim`: the base's,
    /// `(2 S d)^2 exp(-2 S d)` as in a homogeneous layer, and the first terms of the series left out.
    ///
    /// Also returns whether it is the base that decides: more terms would not bring it nearer.
    pub(super) fn choose(tail: &[SurfaceFlexibility], depth: f64, aim: f64) -> (Self, bool) {
        let mut phase: f64 = 4.0;
        for _ in 0..8 {
            phase = (1.0 / (SHARE * aim * depth)).ln().max(1.0) + 2.0 * (1.0 + phase).ln();
        }
        let nearest = 0.5 * phase.max(4.0) / depth;
        let mut cut = Self { cutoff: nearest, nearest, terms: 0 };
        loop {
            let (terms, left) = shortest(tail, cut.cutoff, SHARE * aim);
            cut.terms = terms;
            if left <= SHARE * aim {
                return (cut, cut.cutoff <= nearest);
            }
            if tail.is_empty() || cut.cutoff * STEP > FURTHEST.max(nearest * depth) / depth {
                return (cut, false);
            }
            cut.cutoff *= STEP;
        }
    }

    /// Bound on `int_S^inf |W - series| ds`: the terms that are known but not used, and by two values of what all of
    /// them leave: at `S`, and one `e^2` of the base's decay further out, where what falls algebraically is left and
    /// the base's part shows even if it changes its sign at `S`. The cut's own flexibility is handed back.
    pub(super) fn rest(
        self,
        columns: &[Column],
        response: &dyn LayerResponse,
        depth: f64,
    ) -> Result<(Vec<f64>, SurfaceFlexibility), Refusal> {
        let s = [self.cutoff, self.cutoff + 1.0 / depth];
        let mut f = [SurfaceFlexibility::default(); CHECKS];
        response.surface_into(&s, &mut f)?;
        let bound = |column: &Column| {
            let (used, best) = (column.used(self.terms).len(), column.best(self.cutoff));
            let best = best.max(used);
            let [at, far]: [f64; CHECKS] = std::array::from_fn(|i| column.rest(best, s[i], &f[i]).abs());
            let mut power = self.cutoff.powi(-i32::try_from(used).unwrap_or(i32::MAX));
            let left_out: f64 = (used..best)
                .map(|k| {
                    let size = column.series[k].abs() * power / k.max(1) as f64;
                    power /= self.cutoff;
                    size
                })
                .sum();
            // int_S^inf (S/s)^(k+1) ds = S/k. A lone 1/s oscillates: pi/2 of the same under a sine, and under a cosine
            // its logarithm, at the smallest distance.
            let algebraic = match column.vanishing(best) {
                0 if column.component.is_odd() => 2.0 * self.cutoff,
                0 => LARGEST_LOG * self.cutoff,
                terms => self.cutoff / terms as f64 * (s[1] / s[0]).powf(terms as f64 + 1.0).min(4.0),
            };
            left_out + SAFETY * at.max(E_SQUARED * far) / depth + far * algebraic
        };
        Ok((columns.iter().map(bound).collect(), f[0]))
    }
}

/// Fewest terms whose remainder beyond `cutoff` is below `enough`, or the number that leaves least; and what they
/// leave: twice the largest of the next terms, integrated. Single coefficients may vanish, and of a law that begins
/// with `y^n` all but each `n`-th do: so as many terms are looked at as vanish before the first, and two more.
fn shortest(tail: &[SurfaceFlexibility], cutoff: f64, enough: f64) -> (usize, f64) {
    let mut power = 1.0;
    // Terms of the integral of the series.
    let sizes: ArrayVec<f64, MOST_TERMS> = (1..)
        .zip(tail)
        .take(MOST_TERMS)
        .map(|(k, c)| {
            let size = c.vv.abs().max(c.uu.abs()).max(c.uv.abs()) * power / f64::from((k - 1).max(1));
            power /= cutoff;
            size
        })
        .collect();
    let gap = sizes.iter().position(|size| *size > 0.0).unwrap_or(0) + 2;
    let mut best = (sizes.len(), f64::INFINITY);
    for (terms, next) in sizes.windows(gap).enumerate() {
        let left = 2.0 * next.iter().fold(0.0_f64, |most, size| most.max(*size));
        if left <= enough {
            return (terms, left);
        }
        if left < best.1 {
            best = (terms, left);
        }
    }
    // A series that has ended says nothing of the next term but what its last ones were.
    if sizes.len() < 2 { (sizes.len(), sizes.last().map_or(f64::INFINITY, |last| last / cutoff)) } else { best }
}

/// `sum_k c_k int_S^inf exp(ist) s^-k ds` for each kernel.
#[derive(Clone, Debug)]
pub(super) struct Beyond {
    pub(super) cutoff: f64,
    /// `c_k S^(1-k)`, per kernel.
    pub(super) scaled: Vec<Vec<f64>>,
}

impl Beyond {
    pub(super) fn new(cut: Cut, columns: &[Column]) -> Self {
        let scaled = |column: &Column| {
            let mut power = 1.0;
            let term = |c: &f64| {
                let term = c * power;
                power /= cut.cutoff;
                term
            };
            column.used(cut.terms).iter().map(term).collect()
        };
        Self { cutoff: cut.cutoff, scaled: columns.iter().map(scaled).collect() }
    }

    /// Longest series.
    pub(super) fn terms(&self) -> usize {
        self.scaled.iter().map(Vec::len).max().unwrap_or(0)
    }

    /// Sum of the terms' sizes, which their rounding is proportional to.
    pub(super) fn size(&self, column: usize) -> f64 {
        self.scaled[column].iter().map(|term| term.abs()).sum()
    }

    /// How many digits of the transforms matter.
    pub(super) fn digits(&self, columns: &[Column]) -> f64 {
        let digits = |(i, column): (usize, &Column)| (self.size(i) / (TRANSFORMED * column.aim)).log10();
        columns.iter().enumerate().map(digits).fold(0.0, f64::max)
    }

    /// Adds the transforms at `t > 0` to so many digits to `out`; `scratch` holds [`Self::terms`] numbers.
    pub(super) fn add(&self, (t, digits): (f64, f64), scratch: &mut [Complex64], out: &mut [Complex64]) {
        exponential_integral::sequence(self.cutoff * t, digits, scratch);
        for (out, scaled) in out.iter_mut().zip(&self.scaled) {
            *out += scaled.iter().zip(scratch.iter()).map(|(c, e)| e * c).sum::<Complex64>();
        }
    }
}
