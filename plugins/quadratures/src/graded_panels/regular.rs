//! The kernel parts `smooth`, `sign` and `log` integrated against a density.

use super::layout::Layout;
use super::legendre::{Factor, Gauss, NEAR};
use slipzone_api::{Component, KernelTable, Parts, PartsVec};
use std::f64::consts::PI;

/// Longest piece in `x` that a target may be near to or in, over the length on which the kernel parts vary (distance of their poles).
///
/// Measured on flat punches, kernels with poles at that distance, lengths from 2 to 0.01 half-widths, against
/// pieces of 0.2 with more points: unknowns off by 1e-13 of the largest (1e-12 at 0.01, rounding); with pieces
/// of 2 by 2e-9 at 6 nodes.
pub(super) const PIECE: f64 = 1.0;
/// Longest piece over its distance to the target: the kernel as a whole is analytic but beside the origin. Where its parts are analytic
/// there, too, a piece is to be so far away that the whole is summed.
const AWAY: f64 = 2.0 / (NEAR - 1.0);
/// The same where they are singular: `2.2^(-2 q)` is left by `q` Gauss points.
const GRADED: f64 = 6.0;

/// What cuts round to, relative: a piece that was cut to be as long as it may be is not cut again.
const ROUNDING: f64 = 1e-9;

/// A stretch of a panel, as seen from a target or from its mirror image, and where it lies.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Where it begins, as seen from the nearer of the two angles at which the distance vanishes.
    lower: f64,
    half_length: f64,
    is_image: bool,
    /// Whether it is the whole panel.
    is_whole: bool,
}

/// Pieces, their points and room for one target's kernel values; kept from call to call.
#[derive(Default)]
pub(super) struct Regular {
    pieces: Vec<Piece>,
    /// Where each panel's pieces end.
    ends: Vec<usize>,
    /// For each point of each piece: the angle as its piece sees it, and the distance.
    offsets: Vec<f64>,
    distances: Vec<f64>,
    parts: PartsVec,
    summand: Vec<f64>,
    product: Vec<f64>,
    moments: Vec<f64>,
    values: Vec<f64>,
    of_panel: Vec<f64>,
}

/// A place from which the pieces are seen: the angles at which the distance vanishes, the second as the first sees it.
#[derive(Clone, Copy)]
struct View {
    pole: f64,
    other: f64,
}

impl View {
    fn new(target: f64, is_image: bool) -> Self {
        if is_image {
            Self { pole: PI - target, other: 2.0 * target }
        } else {
            Self { pole: target, other: -2.0 * target }
        }
    }
}

/// Points per target of a kernel of `1/thinness` of the half-width, about.
pub(super) fn points(layout: &Layout, thinness: f64) -> usize {
    let cuts = 2.0 * thinness.max(1.0).ln() / (1.0 + AWAY).ln();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // positive, and saturates
    let cuts = cuts.ceil() as usize;
    layout.gauss.z.len() * (2 * layout.mesh.panels() + 2 * cuts)
}

impl Regular {
    /// Cuts the panels, as seen from the angle `target`: into pieces that are no longer than the kernel allows where they are near.
    fn cut(&mut self, target: f64, layout: &Layout, half_width: f64, table: &dyn KernelTable) {
        let (finest, ratio) = match table.nearest() {
            Some(nearest) => (nearest, GRADED),
            None => (PIECE * table.length(), AWAY),
        };
        self.pieces.clear();
        self.ends.clear();
        let mut stack = Vec::new();
        for ends in layout.mesh.breaks.windows(2) {
            for is_image in [false, true] {
                let view = View::new(target, is_image);
                stack.push((ends[0] - view.pole, ends[1] - view.pole, true));
                while let Some((lower, upper, is_whole)) = stack.pop() {
                    let length = upper - lower;
                    // |dx| = c sin(theta) dtheta is largest at the upper end.
                    let is_fine = half_width * (view.pole + upper).sin() * length <= finest;
                    let apart = |pole: f64| (lower - pole).max(pole - upper);
                    if is_fine || length <= (1.0 + ROUNDING) * ratio * apart(0.0).min(apart(view.other)) {
                        self.pieces.push(Piece { lower, half_length: 0.5 * length, is_image, is_whole });
                        continue;
                    }
                    // Cut at the pole, or so far from it that the farther part is as long as it may be.
                    let pole = if apart(0.0) <= apart(view.other) { 0.0 } else { view.other };
                    let at = if apart(pole) < 0.0 {
                        pole
                    } else if lower >= pole {
                        (upper + ratio * pole) / (1.0 + ratio)
                    } else {
                        (lower + ratio * pole) / (1.0 + ratio)
                    };
                    stack.extend([(at, upper, false), (lower, at, false)]);
                }
            }
            self.ends.push(self.pieces.len());
        }
    }

    /// `row[j]` = what the `j`-th unknown contributes to `(c/pi) int_0^(pi/2) F measure (k(x - r) + mirror k(x + r)) dtheta` at the
    /// angle `target`.
    pub(super) fn row_into(
        &mut self,
        target: f64,
        layout: &Layout,
        half_width: f64,
        (table, component): (&dyn KernelTable, Component),
        row: &mut [f64],
    ) {
        self.cut(target, layout, half_width, table);
        let q = layout.gauss.z.len();
        let points = q * self.pieces.len();
        self.offsets.resize(points, 0.0);
        self.distances.resize(points, 0.0);
        self.parts.resize(points);
        self.summand.resize(q, 0.0);
        self.product.resize(q, 0.0);
        let (sin, cos) = target.sin_cos();
        let places = self.offsets.chunks_exact_mut(q).zip(self.distances.chunks_exact_mut(q));
        for (piece, (offsets, distances)) in self.pieces.iter().zip(places) {
            for ((offset, distance), z) in offsets.iter_mut().zip(distances).zip(&layout.gauss.z) {
                // 1 + z keeps the digits of what is next to the pole.
                *offset = piece.lower + piece.half_length * (1.0 + z);
                // cos(target) -+ cos(theta) as products of sines of half the offset and of that from the target; no cosine is negative.
                let half = (0.5 * *offset).sin();
                let other = (1.0 - half * half).max(0.0).sqrt();
                let sign = if piece.is_image { -1.0 } else { 1.0 };
                *distance = 2.0 * half_width * half * (sign * sin * other + cos * half);
            }
        }
        table.parts_into(component, &self.distances, self.parts.first(points));

        let width = layout.mesh.degree + 1;
        self.values.resize(width, 0.0);
        self.of_panel.resize(width, 0.0);
        row.fill(0.0);
        let mut first = 0;
        for (panel, end) in self.ends.iter().enumerate() {
            self.of_panel.fill(0.0);
            for p in first..*end {
                let piece = self.pieces[p];
                let here = p * q..(p + 1) * q;
                let view = View::new(target, piece.is_image);
                let factor = if piece.is_image { layout.basis.mirror() } else { 1.0 };
                let share =
                    Share { piece, gauss: &layout.gauss, offsets: &self.offsets[here.clone()], view, half_width };
                let mut scratch = Scratch { product: &mut self.product, moments: &mut self.moments };
                self.summand.fill(0.0);
                share.add(
                    factor,
                    &self.parts.range(here.clone()),
                    &self.distances[here],
                    &mut scratch,
                    &mut self.summand,
                );
                for (k, summand) in self.summand.iter().enumerate() {
                    let angle = view.pole + share.offsets[k];
                    let weight = summand * half_width * piece.half_length * layout.basis.measure(angle) / PI;
                    let values = if piece.is_whole {
                        layout.pieces.basis_at(panel * q + k, width)
                    } else {
                        let offset = (angle - layout.mesh.breaks[panel]) / layout.mesh.half_length(panel);
                        layout.mesh.basis_into(offset.clamp(0.0, 2.0), &mut self.values);
                        &self.values
                    };
                    self.of_panel.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
                }
            }
            layout.basis.add_into(panel * layout.mesh.degree, &self.of_panel, row);
            first = *end;
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
    piece: Piece,
    gauss: &'a Gauss,
    offsets: &'a [f64],
    view: View,
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
        let poles = [0.0, self.view.other];
        let local = poles.map(|pole| (pole - self.piece.lower) / self.piece.half_length - 1.0);
        let plain = self.gauss.w.iter();
        if local.iter().all(|at| at.abs() >= NEAR * (1.0 - ROUNDING)) {
            for (((out, w), parts), t) in out.iter_mut().zip(plain).zip(parts.clone()).zip(distances) {
                *out += factor * w * parts.value(*t);
            }
            return;
        }
        // x - r has the sign of theta - target; x + r never changes its own.
        let crosses = !self.piece.is_image && local[0].abs() < 1.0;
        let jumps = crosses && parts.clone().any(|parts| parts.sign != 0.0);
        let has_log = parts.clone().any(|parts| parts.log != 0.0);
        for (((out, w), parts), (t, offset)) in
            out.iter_mut().zip(plain).zip(parts.clone()).zip(distances.iter().zip(self.offsets))
        {
            let sign = if jumps { 0.0 } else { parts.sign * t.signum() };
            let log = if has_log { parts.log * self.log_rest(*offset, poles, local) } else { 0.0 };
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
    fn log_rest(&self, offset: f64, poles: [f64; 2], local: [f64; 2]) -> f64 {
        let of_pole = |(pole, at): (f64, f64)| {
            let half = 0.5 * (offset - pole);
            if at.abs() >= NEAR {
                half.sin().abs().ln()
            } else if half == 0.0 {
                (0.5 * self.piece.half_length).ln()
            } else {
                (0.5 * self.piece.half_length * half.sin() / half).ln()
            }
        };
        (2.0 * self.half_width).ln() + poles.into_iter().zip(local).map(of_pole).sum::<f64>()
    }
}
