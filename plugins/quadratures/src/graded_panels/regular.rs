//! The kernel parts `smooth`, `sign` and `log` integrated against a density.

use super::layout::Layout;
use super::legendre::{Factor, Gauss, NEAR};
use super::mesh::Mesh;
use super::shares::Weighted;
use slipzone_api::elementary::sin_pi;
use slipzone_api::{Component, KernelTable, Parts, PartsVec, root};
use std::f64::consts::PI;

/// Longest piece in `x` that a target may be near to or in, over the length on which the kernel parts vary (distance of
/// their poles).
///
/// Measured on flat punches, kernels with poles at that distance, lengths from 2 to 0.01 half-widths, against
/// pieces of 0.2 with more points: unknowns off by 1e-13 of the largest (1e-12 at 0.01, rounding); with pieces
/// of 2 by 2e-9 at 6 nodes.
pub(super) const PIECE: f64 = 1.0;
/// Longest piece over its distance to the target: the kernel as a whole is analytic but beside the origin. Where its
/// parts are analytic there, too, a piece is to be so far away that the whole is summed.
const AWAY: f64 = 2.0 / (NEAR - 1.0);
/// The same where they are singular: `2.2^(-2 q)` is left by `q` Gauss points.
const GRADED: f64 = 6.0;

/// Longest piece next to the target that is summed in the power of the distance with which kernels begin there, over
/// the target's distance to the contact's end in `u`: as short where a root in which both are polynomials is unknown,
/// or high.
const NEXT: f64 = 1e-5;
/// What may be left of a density on a longer one, which varies on that share of the distance to the contact's end, or
/// over nodes of a panel.
const LEFT: f64 = 1e-14;
const VARIES: f64 = 0.1;

/// What cuts round to, relative: a piece that was cut to be as long as it may be is not cut again.
const ROUNDING: f64 = 1e-9;

/// A stretch of a panel in `u`, as seen from a target or from its mirror image, and where it lies.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Where it begins, as seen from the nearer of the two places at which the distance vanishes.
    lower: f64,
    half_length: f64,
    is_image: bool,
    /// Whether it is the whole panel.
    is_whole: bool,
    sum: Sum,
}

/// How a kernel is summed over a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sum {
    /// As a power of the distance to the piece's end at the pole.
    Next,
    /// As it is: the origin is far enough.
    Far,
    /// Part by part, what is singular in product with the polynomials.
    Near,
}

/// Gauss points over `[0, 1]` in a root of the distance in which it and its power are polynomials, or nearly so; twice
/// their weights.
#[derive(Default)]
struct Powers {
    power: f64,
    /// Over which share of the length on which a density varies they may be spread; 0 if it is no polynomial of theirs.
    reach: f64,
    offsets: Vec<f64>,
    weights: Vec<f64>,
}

impl Powers {
    fn set(&mut self, power: f64, gauss: &Gauss) {
        /// A power of the root is a polynomial if it is as near to a whole number as that; as good as one if it is that
        /// large.
        const WHOLE: f64 = 1e-3;
        const SMOOTH: f64 = 4.0;
        const LARGEST: u32 = 20;
        if self.power.to_bits() == power.to_bits() && self.offsets.len() == gauss.z.len() {
            return;
        }
        let least = power.recip();
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // positive, and saturates
        let first = (least - WHOLE).floor() as u32 + 1;
        let whole = root::whole(power, first..=LARGEST, WHOLE).map(f64::from);
        let root = whole.unwrap_or_else(|| (SMOOTH * least).ceil());
        let zeta = || gauss.z.iter().map(|z| 0.5 * (1.0 + z));
        self.power = power;
        // Of a geometric series in the distance that is what `2 q` powers of the root leave.
        self.reach = whole.map_or(0.0, |root| LEFT.powf(0.5 * root / gauss.z.len() as f64));
        self.offsets = zeta().map(|zeta| zeta.powf(root)).collect();
        let weight = |(zeta, w): (f64, &f64)| w * root * zeta.powf(root - 1.0);
        self.weights = zeta().zip(&gauss.w).map(weight).collect();
    }
}

/// Pieces, their points and room for one target's kernel values; kept from call to call.
#[derive(Default)]
pub(super) struct Regular {
    pieces: Vec<Piece>,
    /// Where each panel's pieces end.
    ends: Vec<usize>,
    /// For each point of each piece: how far it is from the pole in `u`, and the distance.
    offsets: Vec<f64>,
    distances: Vec<f64>,
    /// Sine of the angle at each point of what is no whole panel.
    sines: Vec<f64>,
    /// Of the kernel, or of its parts.
    values: Vec<f64>,
    parts: PartsVec,
    /// What the density is multiplied with at the points of a piece, at those of a whole panel, and at all others of
    /// it.
    of_piece: Vec<f64>,
    summand: Vec<f64>,
    cut: Weighted,
    product: Vec<f64>,
    moments: Vec<f64>,
    of_panel: Vec<f64>,
    powers: Powers,
}

/// A place from which the pieces are seen: where the distance vanishes.
#[derive(Clone, Copy)]
struct View<'a> {
    mesh: &'a Mesh,
    /// In `u`.
    pole: f64,
    /// Where it vanishes, too, as the pole sees that: in `u`, nowhere if that is no real number, and as an angle.
    other: f64,
    other_angle: f64,
    /// What is nearest beside the real line, if anything is: how far along it, and across.
    beside: Option<(f64, f64)>,
}

impl<'a> View<'a> {
    /// From a target.
    fn direct(target: f64, mesh: &'a Mesh) -> Self {
        let view =
            Self { mesh, pole: target, other: -2.0 * target, other_angle: -2.0 * mesh.angle(target), beside: None };
        // At the contact's end all of them are where the pole is.
        if mesh.root == 1 || target <= 0.0 {
            return view;
        }
        let (across, along) = (PI / f64::from(mesh.root)).sin_cos();
        Self { other: f64::NEG_INFINITY, beside: Some(((along - 1.0) * target, across * target)), ..view }
    }

    /// From its mirror image.
    fn mirrored(target: f64, mesh: &'a Mesh) -> Self {
        let angle = mesh.angle(target);
        let pole = mesh.place_of(PI - angle);
        let other = if mesh.root == 1 { 2.0 * angle } else { mesh.place_of(PI + angle) - pole };
        Self { mesh, pole, other, other_angle: 2.0 * angle, beside: None }
    }

    /// The angle at a place, as the pole sees both.
    fn angle_to(&self, offset: f64) -> f64 {
        offset * self.mesh.rise(self.pole + offset, self.pole)
    }

    /// Whether a stretch is so far from what lies beside the real line that a Gauss sum does not see it.
    fn is_clear(&self, lower: f64, upper: f64) -> bool {
        let is_far =
            |(along, across): (f64, f64)| (along - 0.5 * (lower + upper)).hypot(across) >= 0.5 * NEAR * (upper - lower);
        self.beside.is_none_or(is_far)
    }
}

/// Points per target of a kernel of `1/thinness` of the half-width, about.
pub(super) fn points(layout: &Layout, thinness: f64) -> usize {
    let towards = |share: f64, ratio: f64| 2.0 * share.ln() / (1.0 + ratio).ln();
    let to_next = if layout.mesh.root == 1 { 0.0 } else { towards(NEXT.recip(), GRADED) };
    let cuts = towards(thinness.max(1.0), AWAY) + to_next;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // positive, and saturates
    let cuts = cuts.ceil() as usize;
    layout.gauss.z.len() * (2 * layout.mesh.panels() + 2 * cuts)
}

impl Regular {
    /// Cuts the panels, as seen from the angle `target`: into pieces that are no longer than the kernel allows where
    /// they are near.
    fn cut(&mut self, target: f64, views: &[View; 2], layout: &Layout, half_width: f64, table: &dyn KernelTable) {
        let (finest, ratio) = match table.nearest() {
            Some(nearest) => (nearest, GRADED),
            None => (PIECE * table.length(), AWAY),
        };
        let power = table.power();
        // At the contact's end nothing but the end itself is near.
        let far = if target > 0.0 { target } else { layout.mesh.breaks[1] };
        self.pieces.clear();
        self.ends.clear();
        let mut stack = Vec::new();
        for ends in layout.mesh.breaks.windows(2) {
            let allowed = self.powers.reach * (VARIES * far).min(0.5 * (ends[1] - ends[0]) / layout.mesh.degree as f64);
            let next = allowed.max(NEXT * far);
            for (view, is_image) in views.iter().zip([false, true]) {
                // Rounding alone keeps nothing apart from the pole.
                let seen = |u: f64| if (u - view.pole).abs() < 1e-15 * view.pole { 0.0 } else { u - view.pole };
                stack.push((seen(ends[0]), seen(ends[1]), true));
                while let Some((lower, upper, is_whole)) = stack.pop() {
                    let length = upper - lower;
                    // |dx| = c sin(theta) dtheta is largest at the upper end.
                    let end = view.pole + upper;
                    let rise = layout.mesh.angle(end).sin() * layout.mesh.slope(end);
                    let is_short = half_width * rise * length <= finest;
                    let apart = |pole: f64| (lower - pole).max(pole - upper);
                    let sum = if length <= (1.0 + ROUNDING) * ratio * apart(0.0).min(apart(view.other)) {
                        Some(Sum::Far)
                    } else if power.is_some() {
                        (is_short && length <= next && lower * upper == 0.0).then_some(Sum::Next)
                    } else {
                        (is_short && view.is_clear(lower, upper)).then_some(Sum::Near)
                    };
                    if let Some(sum) = sum {
                        let is_whole = is_whole && sum != Sum::Next;
                        self.pieces.push(Piece { lower, half_length: 0.5 * length, is_image, is_whole, sum });
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

    /// The points of the pieces: their offsets from the pole that sees them, and their distances from the angle
    /// `target`.
    fn place(&mut self, target: f64, views: &[View; 2], layout: &Layout, half_width: f64) {
        let q = layout.gauss.z.len();
        let points = q * self.pieces.len();
        self.offsets.resize(points, 0.0);
        self.distances.resize(points, 0.0);
        self.sines.resize(points, 0.0);
        let angle = layout.mesh.angle(target);
        let ((sin, cos), half_sine) = (angle.sin_cos(), (0.5 * angle).sin());
        let mut places = self
            .offsets
            .chunks_exact_mut(q)
            .zip(self.distances.chunks_exact_mut(q))
            .zip(self.sines.chunks_exact_mut(q));
        let mut first = 0;
        for (end, half_angles) in self.ends.iter().zip(layout.pieces.half_angles.chunks_exact(q)) {
            for (piece, ((offsets, distances), sines)) in self.pieces[first..*end].iter().zip(&mut places) {
                let view = &views[usize::from(piece.is_image)];
                if piece.sum == Sum::Next {
                    // From the end at the pole.
                    let length = if piece.lower == 0.0 { 2.0 * piece.half_length } else { piece.lower };
                    offsets.iter_mut().zip(&self.powers.offsets).for_each(|(offset, share)| *offset = length * share);
                } else {
                    // 1 + z keeps the digits of what is next to the pole.
                    let at = |z: &f64| piece.lower + piece.half_length * (1.0 + z);
                    offsets.iter_mut().zip(&layout.gauss.z).for_each(|(offset, z)| *offset = at(z));
                }
                if piece.is_whole {
                    // cos(target) -+ cos(theta) as differences of squares.
                    for ([sine, cosine], distance) in half_angles.iter().zip(distances) {
                        let other = if piece.is_image { cosine } else { sine };
                        *distance = 2.0 * half_width * (other - half_sine) * (other + half_sine);
                    }
                    continue;
                }
                distances.iter_mut().zip(&*offsets).for_each(|(out, offset)| *out = view.angle_to(*offset));
                let cos = if piece.is_image { -cos } else { cos };
                for (distance, sine) in distances.iter_mut().zip(sines) {
                    // As products of sines of half the angle between and of that from the target; no cosine is
                    // negative.
                    let half = sin_pi((0.5 / PI) * *distance);
                    let other = (1.0 - half * half).max(0.0).sqrt();
                    *sine = (sin * (1.0 - 2.0 * half * half) + cos * 2.0 * half * other).max(0.0);
                    let share = sin * other + cos * half;
                    *distance = 2.0 * half_width * half * if piece.is_image { -share } else { share };
                }
            }
            first = *end;
        }
    }

    /// `row[j]` = what the `j`-th unknown contributes to `(c/pi) int_0^(pi/2) F measure (k(x - r) + mirror k(x + r))
    /// dtheta` at the angle `target`.
    pub(super) fn row_into(
        &mut self,
        target: f64,
        layout: &Layout,
        half_width: f64,
        (table, component): (&dyn KernelTable, Component),
        row: &mut [f64],
    ) {
        if let Some(power) = table.power() {
            self.powers.set(power, &layout.gauss);
        }
        let views = [View::direct(target, &layout.mesh), View::mirrored(target, &layout.mesh)];
        self.cut(target, &views, layout, half_width, table);
        self.place(target, &views, layout, half_width);
        let q = layout.gauss.z.len();
        let points = self.distances.len();
        // Of a kernel that begins with a power all pieces are next to the origin or far from it: its parts tell nothing
        // more.
        let has_parts = table.power().is_none();
        if has_parts {
            self.parts.resize(points);
            table.parts_into(component, &self.distances, self.parts.first(points));
        } else {
            self.values.resize(points, 0.0);
            table.values_into(component, &self.distances, &mut self.values);
        }

        self.of_piece.resize(q, 0.0);
        self.summand.resize(q, 0.0);
        self.product.resize(q, 0.0);
        self.of_panel.resize(layout.mesh.degree + 1, 0.0);
        row.fill(0.0);
        let mut first = 0;
        for panel in 0..self.ends.len() {
            self.of_panel.fill(0.0);
            self.summand.fill(0.0);
            self.cut.clear();
            for p in first..self.ends[panel] {
                let piece = self.pieces[p];
                let view = views[usize::from(piece.is_image)];
                self.weigh(p, view, layout, half_width, has_parts);
                if piece.is_whole {
                    self.summand.iter_mut().zip(&self.of_piece).for_each(|(sum, weight)| *sum += weight);
                    continue;
                }
                let points = self.offsets[p * q..].iter().zip(&self.sines[p * q..]);
                for (weight, (offset, sine)) in self.of_piece.iter().zip(points) {
                    let u = view.pole + offset;
                    let rise = layout.basis.measure_at(&layout.mesh, u, *sine) * layout.mesh.slope(u);
                    let place = (u - layout.mesh.breaks[panel]) / layout.mesh.half_length(panel) - 1.0;
                    self.cut.push(place.clamp(-1.0, 1.0), weight * piece.half_length * rise);
                }
            }
            layout.pieces.add_panel_into(panel, &self.summand, &mut self.of_panel);
            layout.shares.add_into(&mut self.cut, &mut self.of_panel);
            layout.basis.add_into(panel * layout.mesh.degree, &self.of_panel, row);
            first = self.ends[panel];
        }
        for entry in row {
            *entry *= half_width / PI;
        }
    }

    /// Writes what the density is multiplied with at the points of one of the pieces, in half-lengths of it.
    fn weigh(&mut self, p: usize, view: View, layout: &Layout, half_width: f64, has_parts: bool) {
        let (piece, gauss) = (self.pieces[p], &layout.gauss);
        let q = gauss.z.len();
        let here = p * q..(p + 1) * q;
        let factor = if piece.is_image { layout.basis.parity.mirror() } else { 1.0 };
        let out = &mut self.of_piece;
        match piece.sum {
            Sum::Near => {
                let share = Share { piece, gauss, offsets: &self.offsets[here.clone()], view, half_width };
                let mut scratch = Scratch { product: &mut self.product, moments: &mut self.moments };
                out.fill(0.0);
                share.add(factor, &self.parts.range(here.clone()), &self.distances[here], &mut scratch, out);
            }
            Sum::Far if has_parts => {
                let parts = self.parts.range(here.clone()).zip(&self.distances[here]);
                multiply(&gauss.w, factor, parts.map(|(parts, t)| parts.value(*t)), out);
            }
            Sum::Far => multiply(&gauss.w, factor, self.values[here].iter().copied(), out),
            Sum::Next => multiply(&self.powers.weights, factor, self.values[here].iter().copied(), out),
        }
    }
}

/// Writes weights times a factor and values.
fn multiply(weights: &[f64], factor: f64, values: impl Iterator<Item = f64>, out: &mut [f64]) {
    for ((out, weight), value) in out.iter_mut().zip(weights).zip(values) {
        *out = factor * weight * value;
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
    view: View<'a>,
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
        // x - r has the sign of theta - target; x + r never changes its own.
        let crosses = !self.piece.is_image && local[0].abs() < 1.0;
        let jumps = crosses && parts.clone().any(|parts| parts.sign != 0.0);
        let has_log = parts.clone().any(|parts| parts.log != 0.0);
        for (((out, w), parts), (t, offset)) in
            out.iter_mut().zip(&self.gauss.w).zip(parts.clone()).zip(distances.iter().zip(self.offsets))
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
        let View { mesh, pole, .. } = self.view;
        let angle = self.view.angle_to(offset);
        let of_pole = |((from, at), angle): ((f64, f64), f64)| {
            let half = 0.5 * angle;
            if at.abs() >= NEAR {
                return half.sin().abs().ln();
            }
            let rise = 0.5 * self.piece.half_length * mesh.rise(pole + offset, pole + from);
            if half == 0.0 { rise.ln() } else { (rise * half.sin() / half).ln() }
        };
        let angles = [angle, angle - self.view.other_angle];
        (2.0 * self.half_width).ln() + poles.into_iter().zip(local).zip(angles).map(of_pole).sum::<f64>()
    }
}
