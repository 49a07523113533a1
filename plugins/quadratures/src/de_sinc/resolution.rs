//! How many nodes, how far out, and how much finer the kernel is summed.

use super::fine::Fine;
use super::grid::Grid;
use slipzone_api::{Edge, NEAREST_POLE, Shelf};
use std::f64::consts::{FRAC_PI_2, PI, SQRT_2};
use std::sync::Arc;

/// A resolution: `n` steps up to `u_max`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Resolution {
    pub(super) n: usize,
    pub(super) u_max: f64,
}

/// Steps of level 0.
const FIRST_STEPS: usize = 6;

/// Steps over half the interval at a level: 6, 8, 11, 16, 22, 32, 45, 64, ..., powers of `sqrt 2` rounded down.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // at most 2^62
pub(super) fn ladder(level: u32) -> usize {
    FIRST_STEPS.max(grown(1, level.saturating_add(5)).floor() as usize)
}

/// `n 2^(level/2)`, rounded.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // at most 2^62
pub(super) fn finer(n: usize, level: u32) -> usize {
    grown(n, level).round() as usize
}

/// `n 2^(level/2)`, exact where that is whole; the growth ends far above all that is built.
fn grown(n: usize, level: u32) -> f64 {
    let odd = if level.is_multiple_of(2) { 1.0 } else { SQRT_2 };
    n.saturating_mul(1 << (level / 2).min(30)) as f64 * odd
}

/// `ln(1/eps)` beyond which only rounding is left.
const MOST_DIGITS: f64 = 36.0;

/// Where a grid of `n` steps ends in `u`: where what is taken for granted beyond weighs as much as what the steps miss.
///
/// Beyond its end densities and strains go on, so that as much as the last gap is missed, or less. Measured on flat
/// punches (sharp), cylinders (smooth) and stick zones (continued) on layers from a half to twenty half-widths thick:
/// at a sharp edge 11, 16 and 22 steps miss 2e-8, 5e-11 and 4e-14 of the numbers at the best ends, 2.0, 2.4 and 2.6, at
/// a smooth one 3e-7, 1e-9 and 1e-12 at 2.1, 2.4 and 2.6. A stick zone is known best with ends 0.1 to 0.2 before these;
/// where the slip zone is narrower than the last gap its shear is missed by the root of the gap.
pub(super) fn reach(n: usize, edge: Edge) -> f64 {
    match edge {
        Edge::Sharp => (1.7 + 0.7 * (n as f64 / 6.0).ln()).clamp(1.5, 3.4),
        Edge::Smooth => (1.9 + 0.6 * (n as f64 / 6.0).ln()).clamp(1.7, 3.4),
        Edge::Continued => (2.05 + 0.56 * (n as f64 / 8.0).ln()).clamp(1.7, 3.6),
    }
}

impl Resolution {
    /// How many times finer than the nodes the kernel is summed, an odd number. `thinness` is the half-width
    /// over the kernel's length.
    ///
    /// The density inherits the kernel's length `l`: it is singular about `i l` across from its ends, as far off
    /// the axis of `u` as [`across_the_end`] says. Its `n` steps give `2 pi d/step` digits (natural ones), and the
    /// kernel's sum owes as many, whose pole seen from the middle stands `asin((2/pi) atan(y0/c))` off the axis.
    pub(super) fn oversampling(self, thinness: f64) -> usize {
        let step = self.u_max / self.n as f64;
        let owed = (2.0 * PI * across_the_end(1.0 / thinness) / step).min(MOST_DIGITS);
        let wanted = owed / self.digits(thinness);
        let room = MOST_ENTRIES / (self.n * self.n);
        let fit = FACTORS.iter().find(|factor| **factor as f64 >= wanted).unwrap_or(&FACTORS[FACTORS.len() - 1]);
        FACTORS.iter().rev().find(|factor| *factor <= fit && **factor <= room).copied().unwrap_or(1)
    }

    /// Digits, natural ones, of a kernel's sum over the nodes themselves; so many times as many on a finer grid.
    fn digits(self, thinness: f64) -> f64 {
        let pole = ((NEAREST_POLE / thinness).atan() / FRAC_PI_2).asin();
        2.0 * PI * pole * self.n as f64 / self.u_max
    }

    /// What a kernel's sum misses because a finer grid has no room.
    ///
    /// A flat punch on a layer of a thousandth of its half-width, at 128, 181 and 256 steps: about 2e-8, 4e-6 and 1e-4.
    /// The errors told there were 2e-6, 1e-4 and 2.5e-3, where the first is that of the coarser steps before.
    pub(super) fn lost_for_room(self, thinness: f64) -> f64 {
        let factor = self.oversampling(thinness);
        let next = FACTORS.iter().find(|next| **next > factor);
        if next.is_some_and(|next| next * self.n * self.n <= MOST_ENTRIES) {
            return 0.0;
        }
        (-self.digits(thinness) * factor as f64).exp()
    }
}

/// Most distances of all rows of a fine grid. A finer one would be asked for by more than 512 steps over a thin layer
/// only; too coarse a one shows against its refined twin.
const MOST_ENTRIES: usize = 1 << 22;

/// `Im u` at `x = c (1 + i gap)`, and 15 % off that: measured 0.6, 0.45, 0.3, 0.24, 0.2 at gaps of 1, 0.3, 0.1,
/// 0.03, 0.01.
fn across_the_end(gap: f64) -> f64 {
    // w = atanh(1 + i gap)
    let re = 0.25 * (4.0 / (gap * gap)).ln_1p() / FRAC_PI_2;
    let im = 0.5 * ((0.5 * gap).atan() + FRAC_PI_2) / FRAC_PI_2;
    0.85 * (2.0 * im / (re.hypot(1.0 + im) + re.hypot(1.0 - im))).asin()
}

/// Odd, in steps of about `sqrt 2`, so that few grids serve all.
const FACTORS: [usize; 16] = [1, 3, 5, 7, 9, 13, 19, 27, 39, 55, 77, 109, 155, 219, 309, 437];

/// Numbers kept of each kind, 16 MB.
const KEPT: usize = 1 << 21;

static GRIDS: Shelf<(usize, u64, bool, Edge), Grid> = Shelf::new(KEPT, Grid::numbers);
static FINE_GRIDS: Shelf<(usize, u64, bool, Edge, usize), Fine> = Shelf::new(KEPT, Fine::numbers);

/// The grid of a resolution.
pub(super) fn grid(resolution: Resolution, odd: bool, edge: Edge) -> Arc<Grid> {
    let Resolution { n, u_max } = resolution;
    GRIDS.get((n, u_max.to_bits(), odd, edge), || Grid::new(n, u_max, odd, edge))
}

/// The grid on which kernels are summed.
pub(super) fn fine_grid(resolution: Resolution, grid: &Grid, factor: usize) -> Arc<Fine> {
    let Resolution { n, u_max } = resolution;
    FINE_GRIDS.get((n, u_max.to_bits(), grid.odd, grid.edge, factor), || Fine::new(grid, factor))
}
