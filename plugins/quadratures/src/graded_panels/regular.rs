//! The kernel parts `smooth`, `sign` and `log` integrated against a density.

use super::layout::Layout;
use super::legendre::{Factor, Gauss, NEAR};
use super::pieces::{Piece, Pieces};
use slipzone_api::{Component, KernelTable, Parts, PartsVec};
use std::f64::consts::PI;

/// Longest piece in `x` over the length on which the kernel parts vary (distance of their poles).
///
/// Measured on flat punches, kernels with poles at that distance, lengths from 2 to 0.01 half-widths, against
/// pieces of 0.2 with more points: unknowns off by 1e-13 of the largest (1e-12 at 0.01, rounding); with pieces
/// of 2 by 2e-9 at 6 nodes.
pub(super) const PIECE: f64 = 1.0;

/// Pieces and room for one target's kernel values; kept from call to call.
#[derive(Default)]
pub(super) struct Regular {
    cuts: Vec<usize>,
    pieces: Option<Pieces>,
    distances: Vec<f64>,
    parts: PartsVec,
    /// Weight of the piecewise polynomial at each Gauss point, for one target.
    pub(super) summand: Vec<f64>,
    product: Vec<f64>,
    moments: Vec<f64>,
}

/// Most pieces of a panel. A kernel that varies over less is not resolved, which differences between resolutions tell.
const MOST_CUTS: usize = 1 << 14;

/// Into how many pieces each panel is cut where the kernel's length is `1/thinness` of the half-width.
fn cuts(layout: &Layout, thinness: f64) -> impl Iterator<Item = usize> {
    layout.mesh.breaks.windows(2).map(move |panel| {
        // |dx| = c sin(theta) dtheta is largest at the upper end.
        let longest = thinness * panel[1].sin() * (panel[1] - panel[0]);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // positive, and saturates
        let cuts = (longest / PIECE).ceil() as usize;
        cuts.clamp(1, MOST_CUTS)
    })
}

/// Gauss points at which a kernel of `1/thinness` of the half-width is summed for one target.
pub(super) fn points(layout: &Layout, thinness: f64) -> usize {
    layout.gauss.z.len() * cuts(layout, thinness).sum::<usize>()
}

impl Regular {
    /// Cuts the panels so that no piece is longer than the kernel's `length` allows, and hands out the pieces.
    pub(super) fn prepare(&mut self, layout: &Layout, half_width: f64, length: f64) -> &Pieces {
        let cuts: Vec<usize> = cuts(layout, half_width / length).collect();
        if self.pieces.is_none() || cuts != self.cuts {
            let pieces = Pieces::new(&layout.mesh, &layout.gauss, layout.basis, &cuts);
            let points = pieces.angle.len();
            self.distances.resize(2 * points, 0.0);
            self.parts.resize(2 * points);
            self.summand.resize(points, 0.0);
            self.product.resize(layout.gauss.z.len(), 0.0);
            self.pieces = Some(pieces);
            self.cuts = cuts;
        }
        self.pieces.as_ref().expect("just made")
    }

    /// `row[j]` = [`Self::summand`] times what the `j`-th unknown contributes.
    pub(super) fn gather_into(&self, layout: &Layout, row: &mut [f64]) {
        let pieces = self.pieces.as_ref().expect("prepared");
        pieces.gather_into(&self.summand, &layout.mesh, layout.basis, row);
    }

    /// Fills [`Self::summand`] for `(c/pi) int_0^(pi/2) F measure (k(x - r) + mirror k(x + r)) dtheta` at the
    /// angle `target`; [`Self::prepare`] comes first.
    pub(super) fn sum_at(
        &mut self,
        target: f64,
        layout: &Layout,
        half_width: f64,
        (table, component): (&dyn KernelTable, Component),
    ) {
        let pieces = self.pieces.as_ref().expect("prepared");
        let points = pieces.angle.len();
        let (sin, cos) = (0.5 * target).sin_cos();
        let (direct, image) = self.distances.split_at_mut(points);
        for ((direct, image), half) in direct.iter_mut().zip(image).zip(&pieces.half) {
            // Sines and cosines of (angle -+ target)/2; their products are half of cos(target) -+ cos(angle).
            let (sine, cosine) = (half.0 * cos, half.1 * sin);
            *direct = 2.0 * half_width * (sine - cosine) * (sine + cosine);
            let (cosine, sine) = (half.1 * cos, half.0 * sin);
            *image = 2.0 * half_width * (cosine + sine) * (cosine - sine);
        }
        table.parts_into(component, &self.distances, self.parts.first(2 * points));

        let q = layout.gauss.z.len();
        let mut scratch = Scratch { product: &mut self.product, moments: &mut self.moments };
        for (p, piece) in pieces.list.iter().enumerate() {
            let direct = p * q..(p + 1) * q;
            let image = points + direct.start..points + direct.end;
            let out = &mut self.summand[direct.clone()];
            out.fill(0.0);
            let angles = &pieces.angle[direct.clone()];
            for (points, factor, poles, crosses) in [
                (direct.clone(), 1.0, [target, -target], true),
                (image, layout.basis.mirror(), [PI - target, PI + target], false),
            ] {
                let share = Share { piece, gauss: &layout.gauss, angles, poles, crosses, half_width };
                share.add(factor, &self.parts.range(points.clone()), &self.distances[points], &mut scratch, out);
            }
            for (out, measure) in out.iter_mut().zip(&pieces.measure[direct]) {
                *out *= half_width * piece.half_length * measure / PI;
            }
        }
    }
}

/// Room for product weights.
struct Scratch<'a> {
    product: &'a mut [f64],
    moments: &'a mut Vec<f64>,
}

/// One piece as seen from a target or from its mirror image.
///
/// Either distance is `2 c` times the product of `|sin((theta - pole)/2)|` over two poles: `+-target` for
/// `x - r`, `pi -+ target` for `x + r`.
struct Share<'a> {
    piece: &'a Piece,
    gauss: &'a Gauss,
    angles: &'a [f64],
    poles: [f64; 2],
    /// Whether the distance changes its sign at the first pole: `x - r` does, `x + r` never, not even where
    /// rounding puts the pole of the middle inside a piece.
    crosses: bool,
    half_width: f64,
}

impl Share<'_> {
    /// Adds `factor` times the weights over the piece's half-length.
    fn add(
        &self,
        factor: f64,
        parts: &(impl Iterator<Item = Parts> + Clone),
        distances: &[f64],
        scratch: &mut Scratch,
        out: &mut [f64],
    ) {
        let local = self.poles.map(|pole| self.piece.local(pole));
        let plain = self.gauss.w.iter();
        if local.iter().all(|at| at.abs() >= NEAR) {
            for (((out, w), parts), t) in out.iter_mut().zip(plain).zip(parts.clone()).zip(distances) {
                *out += factor * w * parts.value(*t);
            }
            return;
        }
        // x - r has the sign of theta - target.
        let jumps = self.crosses && local[0].abs() < 1.0 && parts.clone().any(|parts| parts.sign != 0.0);
        let has_log = parts.clone().any(|parts| parts.log != 0.0);
        for (k, (((out, w), parts), t)) in out.iter_mut().zip(plain).zip(parts.clone()).zip(distances).enumerate() {
            let sign = if jumps { 0.0 } else { parts.sign * t.signum() };
            let log = if has_log { parts.log * self.log_rest(self.angles[k], local) } else { 0.0 };
            *out += factor * w * (parts.smooth + sign + log);
        }
        if jumps {
            self.gauss.product_weights_into(Factor::Step, local[0], scratch.moments, scratch.product);
            for ((out, weight), parts) in out.iter_mut().zip(scratch.product.iter()).zip(parts.clone()) {
                *out += factor * weight * parts.sign;
            }
        }
        for at in local.into_iter().filter(|at| has_log && at.abs() < NEAR) {
            self.gauss.product_weights_into(Factor::Log, at, scratch.moments, scratch.product);
            for ((out, weight), parts) in out.iter_mut().zip(scratch.product.iter()).zip(parts.clone()) {
                *out += factor * weight * parts.log;
            }
        }
    }

    /// Logarithm of the distance less `log|z - at|` of each near pole.
    fn log_rest(&self, angle: f64, local: [f64; 2]) -> f64 {
        let of_pole = |(pole, at): (&f64, f64)| {
            let half = 0.5 * (angle - pole);
            if at.abs() >= NEAR {
                half.sin().abs().ln()
            } else if half == 0.0 {
                (0.5 * self.piece.half_length).ln()
            } else {
                (0.5 * self.piece.half_length * half.sin() / half).ln()
            }
        };
        (2.0 * self.half_width).ln() + self.poles.iter().zip(local).map(of_pole).sum::<f64>()
    }
}
