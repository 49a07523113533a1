//! A growing contact as a stack of flat punches.
//!
//! While the load on a convex punch grows, the rate of change inside a contact of half-width `b'` is what a flat punch
//! of that half-width does (docs/theory.md section 4). So, with `P(b')` the force that the punch bears at each
//! half-width, `p(x; b) = int_|x|^b p_flat(x; b') dP(b')` and `q(x; b) = eta p(x; b) - int_b*^b (eta p_flat -
//! q_flat)(x; b') dP(b')`, `b*` being the half-width at which the stick zone ended at `x`.

mod force;
mod nodes;
mod size;

use super::family::{Family, Slice};
use crate::engine::numerics::root;
use crate::engine::numerics::ways::{self, Ways};
use crate::engine::problem::Problem;
use force::{Made, Piece};
use nodes::{Beyond, nodes_beyond};
use size::Climbed;
use slipzone_api::double_exponential::Node;
use slipzone_api::{Refusal, Station};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// Times that the first piece may be cut.
const MOST_CUTS: usize = 12;
/// And where the force is a sum of powers; what each cut is to leave of what was missed.
const MOST_AT_SINGULAR: usize = 30;
const GAINED: f64 = 0.95;
/// Points closer to the middle than that, over the half-width, are taken to be there: `cosh` has an end.
const CLOSEST: f64 = 1e-290;

/// Error of the integrals over the slope of the shape, over that wanted of the force.
const LOST: f64 = 1e-2;
/// Growth of their nodes until it is met.
const MORE_NODES: f64 = 1.2;
/// Most of these nodes.
const MOST_NODES: usize = 96;
/// So many times as many tell what the middle feels: every flat punch at once, under narrow ones as under wide ones.
///
/// Measured under `|x|^3.3` and `|x|^2.5` on three plies: with one the pressure there was off by up to 35 times its
/// estimate, as resolutions do not differ in what they miss; with two, all seven tolerances from 1e-4 to 1e-10 were
/// within a tenth of theirs.
const MORE_IN_MIDDLE: usize = 2;
/// What rounding leaves of them.
const ROUNDING: f64 = 1e-14;
/// The longest piece that does not begin in the middle, in the logarithm of the distance from the kink before that
/// where it begins, or from the middle.
const LONGEST_PIECE: f64 = 2.5;
/// Parts of a contact that are nearer to its middle than that, over its half-width, do not count in an integral over all
/// of it: a kink at a distance of 1e-300 makes hundreds of them.
const SMALLEST_PART: f64 = 1e-18;
/// As many slices as most points have.
const USUAL_SLICES: usize = 128;
/// Places at which a pressure is looked at, denser at the edge.
const PULLING: u8 = 24;
/// Half-widths at which the force is looked at.
const RISING: usize = 32;
/// Half-width over the depth of a datum below which a punch hardly feels it.
const DATUM: f64 = 0.5;
/// Parts of a piece from which the way to its end is measured.
const MEASURED_FROM: [f64; 2] = [0.05, 0.5];

/// The force under one punch over all half-widths of a family, and what is stacked with it.
pub(crate) struct Stack {
    pieces: Vec<Piece>,
    /// Ends of the pieces: those of the contact, where the shape is not analytic within it, and as many between as keep
    /// pieces short.
    breaks: Vec<f64>,
    /// Of unit length, for integrals over the shape.
    grid: Arc<Vec<Node>>,
    /// The same for what the middle feels of a piece that begins there.
    grid_of_middle: Arc<Vec<Node>>,
    /// Up to which part of such a piece a tip presses in one place.
    tip: f64,
    /// For integrals over the half-width: of the shear, and of a pressure, beside which there may be a kink.
    ways: Ways,
    crowded_ways: Ways,
    /// What the integrals lose of the shape's height, or the series of its force, relative.
    lost: f64,
    /// The same of a pressure exactly at a kink.
    lost_at_kinks: f64,
    climbed: Climbed,
    /// Whether the layer is stiff above what is soft, where that was asked.
    bends: Option<bool>,
    room: Room,
}

/// Room for points within a contact.
#[derive(Default)]
struct Room {
    at: Vec<Station>,
    weights: Vec<f64>,
    values: Vec<f64>,
}

impl Stack {
    /// The stack of a punch over the members of a family up to a widest; `digits` is the error wanted, relative. Nodes
    /// of the integrals are added until they are enough for the slope of the shape, which is as steep as the force over
    /// the half-width.
    pub(crate) fn new(
        problem: &Problem,
        family: &mut Family,
        widest: f64,
        (digits, mut nodes): (f64, usize),
    ) -> Result<Self, Refusal> {
        let mut stack = Self::empty(problem, widest, digits, nodes);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // at most MOST_NODES
        while stack.lost > (LOST * digits).max(ROUNDING) && nodes < MOST_NODES {
            nodes = (MORE_NODES * nodes as f64).ceil() as usize;
            stack = Self::empty(problem, widest, digits, nodes);
        }
        let (mut cuts, mut missed_before) = (0, f64::INFINITY);
        while stack.pieces.len() + 1 < stack.breaks.len() {
            let i = stack.pieces.len();
            let (from, to) = (stack.breaks[i], stack.breaks[i + 1]);
            let Made { piece, missed, at_kink } = stack.piece(problem, family, (from, to), digits);
            // Of a sum of powers the lower outgrows the other, if slowly; noise stays.
            let is_worth_it = if piece.is_singular_at_tip() {
                cuts < MOST_AT_SINGULAR && missed < GAINED * missed_before
            } else {
                cuts < MOST_CUTS
            };
            if from == 0.0 && is_worth_it && missed > digits.max(ROUNDING) {
                // A formula loses digits towards its tip. The nearer to it, the less it matters.
                stack.breaks.insert(1, to * (-LONGEST_PIECE).exp());
                (cuts, missed_before) = (cuts + 1, missed);
                continue;
            }
            stack.pieces.push(piece);
            stack.lost = stack.lost.max(missed);
            stack.lost_at_kinks = stack.lost_at_kinks.max(at_kink);
            family.within_budget()?;
        }
        Ok(stack)
    }

    /// One without its force.
    fn empty(problem: &Problem, widest: f64, digits: f64, nodes: usize) -> Self {
        let face = problem.face().min(widest);
        let mut breaks = vec![face];
        let (mut kink, mut from) = (0.0, face);
        for next in problem.kinks().filter(|kink| *kink > face && *kink < widest).chain([widest]) {
            // A force known to so many digits at the end of a piece is known to fewer at its beginning, where the
            // middle feels it; and beyond a kink it remembers the one before as long as that is near.
            let (beyond, ratio) = (from - kink, (next - kink) / (from - kink));
            let parts = if from > 0.0 { (ratio.ln() / LONGEST_PIECE).ceil().max(1.0) } else { 1.0 };
            let ends = (1..).map(f64::from).take_while(|part| *part < parts);
            breaks.extend(ends.map(|part| kink + beyond * ratio.powf(part / parts)));
            breaks.push(next);
            (kink, from) = (from, next);
        }
        if problem.is_detailed == Some(true) || problem.is_kinked_beside_details(widest) {
            problem.cut(&mut breaks, digits);
        }
        let mut stack = Self {
            pieces: Vec::new(),
            breaks,
            grid: ways::grid(nodes),
            grid_of_middle: ways::grid(MORE_IN_MIDDLE * nodes),
            tip: nodes::tip(problem),
            ways: Ways::gathered(nodes),
            crowded_ways: Ways::crowded(nodes),
            lost: 0.0,
            lost_at_kinks: 0.0,
            climbed: None,
            bends: None,
            room: Room::default(),
        };
        stack.lost = stack.measured(problem, 2 * nodes);
        stack
    }

    /// The largest difference of an integral over the slope from that with more nodes, over the height.
    fn measured(&self, problem: &Problem, nodes: usize) -> f64 {
        let fine = ways::grid(nodes);
        // The rise over the rest of a piece, from so far beyond its beginning.
        let height = |grid: &[Node], (from, to): (f64, f64), start: f64| {
            let length = (to - from) - start;
            let slope = |at: &Node| problem.slope_beyond(from, start + length * at.from_lower);
            length * grid.iter().map(|at| at.weight * slope(at)).sum::<f64>()
        };
        let mut before = 0.0;
        let mut most = 0.0_f64;
        for ends in self.breaks.windows(2) {
            let (from, to) = (ends[0], ends[1]);
            let rise = height(&fine, (from, to), 0.0);
            let over = before + rise;
            before = over;
            if over == 0.0 {
                continue;
            }
            let mut differs = |found: f64, told: f64| most = most.max(((found - told) / over).abs());
            differs(height(&self.grid, (from, to), 0.0), rise);
            for part in MEASURED_FROM {
                let x = from + part * (to - from);
                let start = x - from;
                let told = height(&fine, (from, to), start);
                for ways in [&self.ways, &self.crowded_ways] {
                    let mut sum = 0.0;
                    let slope = |at: &Beyond| problem.slope_beyond(from, start + at.from_lower);
                    nodes_beyond(ways, (x, from), (x, to), |at| sum += at.weight * slope(&at));
                    differs(sum, told);
                }
            }
        }
        most
    }

    /// What the integrals lose of the shape's height, or the series of its force, beside those of the contact of that
    /// half-width.
    pub(crate) fn lost(&self, problem: &Problem, b: f64) -> f64 {
        self.lost.max(self.piece_at(b).missed_at(problem, b))
    }

    /// Whether the contact of that half-width is within it, and its force told as well as those of the widest, or to so
    /// many digits.
    pub(crate) fn tells(&self, problem: &Problem, b: f64, digits: f64) -> bool {
        self.reaches(b) && self.lost(problem, b) <= self.lost.max(digits).max(ROUNDING)
    }

    /// Whether it reaches to a half-width.
    pub(crate) fn reaches(&self, b: f64) -> bool {
        self.breaks.last().is_some_and(|widest| b <= *widest)
    }

    /// What they lose of a pressure exactly at a kink.
    pub(crate) fn lost_at_kinks(&self) -> f64 {
        self.lost_at_kinks
    }

    /// `2 int_0^b f(x) h(x) dx`, with `f` of a family member, as wide as the last of some ends and by so much wider
    /// than the one before it, and `h` of the shape.
    fn over_contact(
        &mut self,
        (ends, last): (&[f64], f64),
        member: &mut dyn FnMut(&[Station], &mut [f64]),
        of_shape: impl Fn(Place) -> f64,
    ) -> f64 {
        let Room { at, weights, values } = &mut self.room;
        at.clear();
        weights.clear();
        // Of a convex shape the middle adds no more to the integral than it takes of the contact.
        let middle = ends.partition_point(|end| *end < SMALLEST_PART * ends[ends.len() - 1]);
        let ends = &ends[middle.saturating_sub(1)..];
        let parts = ends.len() - 1;
        at.reserve(parts * self.grid.len());
        weights.reserve(parts * self.grid.len());
        let (b, before) = (ends[parts], ends[parts - 1]);
        for (i, ends) in ends.windows(2).enumerate() {
            let (lower, upper) = (ends[0], ends[1]);
            if i + 1 == parts {
                for node in self.grid.iter() {
                    let from_lower = last * node.from_lower;
                    let x = lower + from_lower;
                    at.push(Station { x, gap: last * node.to_upper });
                    weights.push(last * node.weight * of_shape(Place { x, lower, from_lower, kink: None }));
                }
                continue;
            }
            // Up to a kink, which may be close to the edge, by the angle from there: in `x = b cos(angle)` the edge is
            // no singularity.
            let gaps = [lower, upper].map(|end| (before - end) + last);
            let [far, near] = gaps.map(|gap| 2.0 * (gap / (2.0 * b)).sqrt().asin());
            let length = far - near;
            for node in self.grid.iter() {
                let angle = near + length * node.from_lower;
                let from_lower = 2.0 * b * (0.5 * (angle + far)).sin() * (0.5 * length * node.to_upper).sin();
                let (x, gap) = (lower + from_lower, 2.0 * b * (0.5 * angle).sin().powi(2));
                at.push(Station { x, gap });
                let shape = of_shape(Place { x, lower, from_lower, kink: Some(upper) });
                weights.push(length * node.weight * b * angle.sin() * shape);
            }
        }
        values.resize(at.len(), 0.0);
        member(at, values);
        2.0 * weights.iter().zip(values.iter()).map(|(weight, value)| weight * value).sum::<f64>()
    }

    /// The force at a half-width so far beyond `from`, an end of a piece, by reciprocity with the tilted flat punch.
    /// Just beyond a kink it goes with a root of that distance, which a half-width alone does not tell.
    fn force_by_tilt(&mut self, problem: &Problem, family: &mut Family, (from, beyond): (f64, f64)) -> f64 {
        let b = from + beyond;
        if from > 0.0 {
            let tilt = &mut |at: &[Station], out: &mut [f64]| family.tilt_into(b, at, out);
            let mut ends = self.pressure_ends(from);
            ends.push(b);
            let slope = |place: Place| match place.kink {
                Some(kink) => problem.slope_before(kink, place.x),
                None => problem.slope_beyond(place.lower, place.from_lower),
            };
            return self.over_contact((&ends, beyond), tilt, slope) / problem.elastic.a0();
        }
        self.force_and_mean_slope(problem, family, b).0
    }

    /// The same at a half-width within which the shape is analytic, and the mean of the slope there: the nodes of every
    /// contact are the same parts of it.
    fn force_and_mean_slope(&mut self, problem: &Problem, family: &mut Family, b: f64) -> (f64, f64) {
        family.tilt_over(b, &self.grid, &mut self.room.values);
        let (mut force, mut mean) = (0.0, 0.0);
        for (node, tilt) in self.grid.iter().zip(&self.room.values) {
            let share = node.weight * problem.slope(b * node.from_lower);
            force += share * tilt;
            mean += share;
        }
        (2.0 * b * force / problem.elastic.a0(), mean)
    }

    /// Where the shape is not analytic, up to the widest contact.
    pub(crate) fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// The force at a half-width.
    pub(crate) fn force(&self, problem: &Problem, b: f64) -> f64 {
        self.piece_at(b).force(problem, b)
    }

    fn piece_at(&self, b: f64) -> &Piece {
        let last = self.pieces.last().expect("one piece at least");
        self.pieces.iter().find(|piece| b <= piece.to).unwrap_or(last)
    }

    /// Whether no contact up to a half-width pulls anywhere, as far as a few places tell, because the force grows all
    /// the way and no slice pulls.
    pub(crate) fn presses(&self, problem: &Problem, family: &mut Family, b: f64) -> bool {
        let face = self.breaks[0];
        let forces = (1..=RISING).map(|i| self.force(problem, face + (b - face) * i as f64 / RISING as f64));
        forces.is_sorted() && family.presses()
    }

    /// Depth of the punch at a half-width, by reciprocity: `P D + int p_flat g dx`.
    ///
    /// Against a datum that fails: the datum, too, moves by how the pressure is distributed. There each increment of
    /// the force sinks the flat punch that it presses on, `int D dP`: true always, with a digit or two fewer.
    pub(crate) fn depth(&mut self, problem: &Problem, family: &mut Family, b: f64) -> f64 {
        let a0 = problem.elastic.a0();
        if !problem.layer.is_grounded() {
            let face = self.breaks[0];
            // Narrow punches and wide ones feel the datum otherwise: from there on in proportion.
            let turn = problem.layer.datum.map_or(b, |datum| DATUM * datum).max(face).min(b);
            let parts = [(face, turn), (turn, b)].map(|part| self.slices(problem, &self.ways, 0.0, part));
            let slices = parts.iter().flatten();
            return slices.map(|slice| slice.force * a0 * family.depth(slice.half_width)).sum();
        }
        let ends = self.pressure_ends(b);
        let last = b - ends[ends.len() - 2];
        let pressure = &mut |at: &[Station], out: &mut [f64]| family.pressure_into(b, at, out);
        let lifted = self.over_contact((&ends, last), pressure, |place| problem.height(place.x));
        self.force(problem, b) * a0 * family.depth(b) + lifted
    }

    /// What integrals over the force from `from` to `b` are summed of, seen from `x <= from`.
    fn slices(&self, problem: &Problem, ways: &Ways, x: f64, (from, b): (f64, f64)) -> Vec<Slice> {
        let (mut slices, mut distances) = (Vec::with_capacity(USUAL_SLICES), Vec::with_capacity(USUAL_SLICES));
        for piece in &self.pieces {
            let (lower, upper) = (piece.from.max(from), piece.to.min(b));
            if lower >= upper {
                continue;
            }
            let (first, to_piece) = (slices.len(), lower - piece.from);
            self.nodes_of_piece(problem, ways, (x, piece.from), (lower, upper), |at| {
                slices.push(Slice { half_width: at.member, beyond: at.gap, force: at.weight });
                distances.push(to_piece + at.from_lower);
            });
            piece.weigh(problem, &mut slices[first..], &distances[first..]);
        }
        slices
    }

    /// Pressure at points of a contact.
    pub(crate) fn pressure_into(
        &self,
        problem: &Problem,
        family: &mut Family,
        b: f64,
        at: &[Station],
        out: &mut [f64],
    ) {
        for (out, at) in out.iter_mut().zip(at) {
            *out = self.pressure(problem, family, b, at.x);
        }
    }

    /// Pressure at a point of a contact.
    pub(crate) fn pressure(&self, problem: &Problem, family: &mut Family, b: f64, x: f64) -> f64 {
        let x = x.abs();
        if problem.is_corner(x) {
            return f64::INFINITY;
        }
        let x = apart(x, b);
        family.stacked_pressure(&self.slices(problem, &self.crowded_ways, x, (x.max(self.breaks[0]), b)), x)
    }

    /// Whether the pressure of a contact pulls somewhere, as far as a few places tell.
    pub(crate) fn pulls(&self, problem: &Problem, family: &mut Family, b: f64) -> bool {
        let mut places = (0..PULLING).map(|i| b * (FRAC_PI_2 * f64::from(i) / f64::from(PULLING)).sin());
        places.any(|x| self.pressure(problem, family, b, x) < 0.0)
    }

    /// Half-width at which the stick zone ended at a point; that of the face where it was never so narrow.
    fn stuck_since(&self, family: &Family, b: f64, x: f64) -> f64 {
        let face = self.breaks[0];
        let beyond = |half_width: f64| family.zone(half_width).half_width - x;
        if face > 0.0 && beyond(face) >= 0.0 {
            return face;
        }
        // By the logarithm: close to a tip only parts count.
        let least = face.max(x);
        root::between((0.0, (b / least).ln()), f64::EPSILON, |log| beyond(least * log.exp()) / x)
            .map_or(b, |log| (least * log.exp()).min(b))
    }

    /// Where the pressure of a contact is not analytic, its middle and its edge included.
    pub(crate) fn pressure_ends(&self, b: f64) -> Vec<f64> {
        let start = [0.0].into_iter().filter(|_| self.breaks[0] > 0.0);
        start.chain(self.breaks.iter().copied().filter(|x| *x < b)).chain([b]).collect()
    }

    /// What the shear at a point of the stick zone lacks to that of full sliding.
    pub(crate) fn lack(&self, problem: &Problem, family: &mut Family, b: f64, x: f64) -> f64 {
        let x = apart(x.abs(), b);
        let since = self.stuck_since(family, b, x);
        family.stacked_lack(&self.slices(problem, &self.ways, x, (since, b)), x)
    }
}

/// A place of a contact.
struct Place {
    x: f64,
    /// The end of a piece of the shape before it, and how far beyond that it is.
    lower: f64,
    from_lower: f64,
    /// The end of a piece beyond it; `None` where the contact ends there.
    kink: Option<f64>,
}

/// A point in the middle, or far enough from it to be told apart.
fn apart(x: f64, b: f64) -> f64 {
    if x > 0.0 { x.max(CLOSEST * b) } else { 0.0 }
}
