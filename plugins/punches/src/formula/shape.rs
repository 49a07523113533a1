//! The shape that a formula gives, looked over before it is used.

use super::Gives;
use slipzone_api::{Fault, Flaw, PunchShape, details, double_exponential, examine, short};
use slipzone_formula::Formula;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// The most places at which integrals are to be split.
const MOST_KINKS: usize = 64;

/// Powers of two among which the scale of a shape is sought: 1e-51 to 1e51.
const SCALES: std::ops::RangeInclusive<i32> = -170..=170;

/// A slope at which a punch is no longer thought of as blunt.
const STEEP: f64 = 0.5;

/// Difference between both sides that is no rounding.
const ASYMMETRIC: f64 = 1e-9;

/// Points at which both sides are compared.
const COMPARED: u32 = 64;

/// Loss of digits, relative, from which a height is not taken as it is written.
const LOST: f64 = 1e-11;
/// How often the natural length is halved to look for that.
const HALVED: i32 = 40;

/// How far out, in natural lengths, the tip is looked over before there is any load.
const TIP: f64 = 1e-3;

/// A formula as a shape.
#[derive(Clone, Debug)]
pub(super) struct Graph {
    formula: Formula,
    gives: Gives,
    /// The formula's value in the middle, which heights are measured from.
    tip: f64,
    natural_length: f64,
    /// Where the formula is singular, or may be.
    kinks: Vec<f64>,
    corners: Vec<f64>,
    /// Up to which kink the height is exactly 0.
    face: f64,
    /// The length over which details were looked for last, and these.
    details: Arc<Mutex<(f64, Vec<f64>)>>,
    /// Fixed places, ascending as far as they were needed, and the heights there by the slope.
    heights: Arc<Mutex<Vec<(f64, f64)>>>,
    /// The length up to which the height as written has lost digits, known when first asked for.
    lossy: OnceLock<f64>,
}

impl Graph {
    /// Looks the formula over.
    ///
    /// # Errors
    /// Whatever is wrong with it at and around the tip, hence under any load.
    pub(super) fn new(formula: Formula, gives: Gives) -> Result<Self, Fault> {
        let tip = if gives == Gives::Height { formula.at(0.0).value } else { 0.0 };
        let mut graph = Self {
            formula,
            gives,
            tip,
            natural_length: 1.0,
            kinks: Vec::new(),
            corners: Vec::new(),
            face: 0.0,
            details: Arc::default(),
            heights: Arc::default(),
            lossy: OnceLock::new(),
        };
        if !tip.is_finite() {
            return Err(Fault::new(&[], "the formula has no finite value at x = 0")
                .found(format!("height(0) = {tip}"))
                .expected("a height that is finite where the punch touches first"));
        }
        graph.natural_length = graph.scale().ok_or_else(|| {
            Fault::new(&[], "the formula gives no punch")
                .found("a slope that is nowhere finite and above 0")
                .expected("a height that grows with x")
        })?;
        let narrow = graph.formula.narrow_places(4.0 * graph.natural_length);
        graph.kinks = graph.formula.singular_points(graph.natural_length, MOST_KINKS, &narrow);
        graph.corners = graph.kinks.iter().copied().filter(|&kink| graph.jumps(kink)).collect();
        graph.face = graph.level();
        if let Some((x, right, left)) = graph.asymmetry(2.0 * graph.natural_length, &[]) {
            return Err(graph.asymmetric(x, right, left));
        }
        if let Some(flaw) = graph.flaw_among(TIP * graph.natural_length, &graph.kinks) {
            return Err(Fault::new(&[], format!("{} from its tip on", flaw.what))
                .found(format!(
                    "height({0}) = {1}, slope({0}) = {2}",
                    short(flaw.x),
                    short(graph.height(flaw.x)),
                    short(graph.slope(flaw.x))
                ))
                .expected("a height that rises from x = 0, the steeper the further out"));
        }
        Ok(graph)
    }

    /// The slope as written, at `x >= 0`, by the derivative where the height is written.
    fn steepness(&self, x: f64) -> f64 {
        let at = self.formula.at(x);
        if self.gives == Gives::Height { at.slope } else { at.value }
    }

    /// The largest power of two at which the slope is still below half of its largest, and below [`STEEP`]. Any length
    /// does for a wedge. `None` for what rises nowhere.
    fn scale(&self) -> Option<f64> {
        let scales = || SCALES.map(|power| 2_f64.powi(power)).map(|x| (x, self.steepness(x)));
        let rising = scales().filter(|(_, slope)| slope.is_finite() && *slope > 0.0);
        let steepest = rising.map(|(_, slope)| slope).fold(0.0, f64::max);
        if steepest <= 0.0 {
            // A flaw, if not on this grid of lengths; it is told in its own words.
            let is_finite = self.steepness(1.0).is_finite();
            return (is_finite && self.steepness(1.0) != 0.0).then_some(1.0);
        }
        let limit = STEEP.min(0.5 * steepest);
        let mut scales = scales().skip_while(|(_, slope)| !slope.is_finite());
        let (first, slope) = scales.next()?;
        if slope >= limit {
            return Some(if self.steepness(1.0).is_finite() { 1.0 } else { first });
        }
        Some(scales.take_while(|(_, slope)| *slope < limit).last().map_or(first, |(x, _)| x))
    }

    /// The last of the kinks up to which the formula is level, as under `max(0, abs(x) - 1)^2`.
    fn level(&self) -> f64 {
        let mut face = 0.0;
        for &kink in self.kinks.iter().filter(|kink| **kink > 0.0) {
            let middle = face + 0.5 * (kink - face);
            // Where two branches meet in between two numbers, the other one is higher there, by rounding.
            let rounding = 4.0 * f64::EPSILON * (self.tip.abs() + kink * self.steepness(kink * (1.0 + 1e-9)).abs());
            // No number is not level.
            let is_at_tip = |x: f64| self.written(x).abs() <= rounding;
            let is_level = self.steepness(middle) == 0.0 && is_at_tip(middle) && is_at_tip(kink);
            if !is_level {
                break;
            }
            face = kink;
        }
        face
    }

    /// Whether the slope has different limits on both sides: the difference stays as both sides close in.
    fn jumps(&self, kink: f64) -> bool {
        let length = if kink > 0.0 { kink } else { self.natural_length };
        let difference = |distance: f64| {
            let (from, to) = (kink - distance * length, kink + distance * length);
            // Left of the middle the shape is mirrored, whatever the formula says.
            let left = if from < 0.0 { -self.steepness(-from) } else { self.steepness(from) };
            self.steepness(to) - left
        };
        let steepest = self.steepness(self.natural_length).abs();
        // Nothing is lost beside 0.
        let (least, distances) = if kink == 0.0 {
            (1e-12, [1e-60, 1e-80, 1e-100, 1e-120])
        } else {
            (1e-9, [1e-6, 4.64e-8, 2.154e-9, 1e-10])
        };
        leave_a_jump(least * steepest, distances.map(difference))
    }

    /// The first flaw up to a half-width, looked for at places of its own and at those given.
    fn flaw_among(&self, half_width: f64, places: &[f64]) -> Option<Flaw> {
        // Terms that cancel round by their sizes: heights by that of the tip as written, slopes by that where the
        // contact ends.
        let steepest = Some(self.steepness(half_width).abs()).filter(|slope| slope.is_finite()).unwrap_or(0.0);
        let known = if self.gives == Gives::Height { (self.tip.abs(), steepest) } else { (0.0, 0.0) };
        let found = examine::first_flaw_beside(known, &Written(self), half_width, places);
        let nearest = found.as_ref().map_or(half_width, |flaw| flaw.x);
        let uneven = self.asymmetry(half_width, places).filter(|(x, ..)| *x < nearest);
        let uneven = uneven.map(|(x, ..)| Flaw::new("the punch is not symmetric", x));
        uneven.or(found)
    }

    /// The first point up to `x` at which the formula as written differs from its mirror image, and both values.
    fn asymmetry(&self, x: f64, also: &[f64]) -> Option<(f64, f64, f64)> {
        let sign = if self.gives == Gives::Height { 1.0 } else { -1.0 };
        let mut compared: Vec<f64> = (1..=COMPARED).map(|i| f64::from(i) / f64::from(COMPARED) * x).collect();
        // Nearer to the tip both sides may be of rounding.
        let nearest = compared[0];
        compared.extend(also.iter().filter(|place| (nearest..=x).contains(*place)));
        compared.sort_unstable_by(f64::total_cmp);
        compared.into_iter().find_map(|x| {
            let (right, left) = (self.formula.at(x).value, self.formula.at(-x).value);
            let allowed = ASYMMETRIC * right.abs().max(left.abs());
            // Written so that a left side without a value counts; a right side without one is no matter of symmetry.
            // Infinite on both sides is symmetric too.
            let alike = right.to_bits() == (sign * left).to_bits();
            let is_symmetric = right.is_nan() || alike || (right - sign * left).abs() <= allowed;
            (!is_symmetric).then_some((x, right, left))
        })
    }

    fn asymmetric(&self, x: f64, right: f64, left: f64) -> Fault {
        let key = self.gives.key();
        let (rule, hint) = match self.gives {
            Gives::Height => {
                ("the same height on both sides", "write `abs(x)` for `x` where the sign matters, as in abs(x)^3")
            }
            Gives::Slope => {
                ("opposite slopes on both sides", "write `x*abs(x)` for `x^2`: a slope changes its sign with x")
            }
        };
        // With all digits where a few do not tell them apart.
        let [mut told, mut other] = [right, left].map(short);
        if told == other && right.to_bits() != left.to_bits() {
            [told, other] = [right, left].map(|value| value.to_string());
        }
        Fault::new(&[], format!("the punch is not symmetric at x = {}", short(x)))
            .found(format!("{key}({0}) = {told}, but {key}(-{0}) = {other}", short(x)))
            .expected(rule)
            .hint(hint)
    }

    /// The height as written, from the tip.
    fn written(&self, x: f64) -> f64 {
        self.formula.at(x).value - self.tip
    }

    /// Up to where the height as written has lost digits: of `R - sqrt(R^2 - x^2)` few are left where `x` is far
    /// smaller than `R`, and all of the slope.
    fn lossy(&self) -> f64 {
        *self.lossy.get_or_init(|| {
            let is_lossy = |halved: i32| {
                let x = self.natural_length * 0.5_f64.powi(halved);
                let (height, by_parts) = (self.rise(0.0, x), self.rise(0.0, 0.4 * x) + self.rise(0.4 * x, x));
                let lost = (self.written(x) - height).abs();
                // Where the integral is no better, nothing is to be gained.
                lost > LOST * height.abs() && (height - by_parts).abs() < 0.1 * lost
            };
            if !is_lossy(HALVED) {
                return 0.0;
            }
            // The nearer to the tip the more is lost.
            let (mut lossy, mut exact) = (HALVED, -1);
            while lossy - exact > 1 {
                let between = i32::midpoint(lossy, exact);
                *(if is_lossy(between) { &mut lossy } else { &mut exact }) = between;
            }
            // What is between this one and the next may lose as much.
            self.natural_length * 0.5_f64.powi(lossy - 1)
        })
    }

    /// The height by the slope, at `x > 0`: from the last of fixed places before it, up to which it is known.
    fn integral(&self, x: f64) -> f64 {
        /// The first of them, over the natural length, and each over the one before.
        const FIRST: f64 = 1.0 / 256.0;
        const RATIO: f64 = 1.0625;
        let first = FIRST * self.natural_length;
        if !(x >= first && x < f64::INFINITY) {
            return self.rise(0.0, x);
        }
        let mut known = self.heights.lock().unwrap_or_else(PoisonError::into_inner);
        let mut last = known.last().copied().unwrap_or_else(|| (first, self.rise(0.0, first)));
        if known.is_empty() {
            known.push(last);
        }
        while RATIO * last.0 <= x {
            let next = RATIO * last.0;
            last = (next, last.1 + self.rise(last.0, next));
            known.push(last);
        }
        let (place, height) = known[known.partition_point(|(place, _)| *place <= x) - 1];
        drop(known);
        if x > place { height + self.rise(place, x) } else { height }
    }

    /// By how much it rises between two places.
    fn rise(&self, from: f64, to: f64) -> f64 {
        let (mut sum, mut start) = (0.0, from);
        for end in self.kinks.iter().copied().filter(|&kink| kink > from && kink < to).chain([to]) {
            sum += self.panel(start, end, 0);
            start = end;
        }
        sum
    }

    /// One panel of it, cut in two until two grids agree; at its ends the slope may have a singularity that can be
    /// integrated.
    fn panel(&self, from: f64, to: f64, depth: u32) -> f64 {
        const DEPTH: u32 = 10;
        let by = |nodes: usize| -> f64 {
            let nodes = double_exponential::nodes(to - from, nodes);
            nodes.iter().map(|node| node.weight * self.steepness(from + node.from_lower)).sum()
        };
        if !(to - from > 0.0 && to < f64::INFINITY) {
            return f64::NAN;
        }
        let (coarse, fine) = (by(24), by(48));
        // The finer grid's error is about the square of the coarser one's. Close to its tip a slope may be of rounding,
        // which no cut mends.
        let rounding = 1e-15 * (to - from) * self.steepness(self.natural_length).abs();
        let differ = (coarse - fine).abs() > rounding.max(1e-11 * fine.abs());
        let middle = from + 0.5 * (to - from);
        // Between neighbours among the numbers nothing is to be cut.
        if !differ || depth == DEPTH || middle <= from || middle >= to {
            return fine;
        }
        self.panel(from, middle, depth + 1) + self.panel(middle, to, depth + 1)
    }
}

impl PunchShape for Graph {
    fn height(&self, x: f64) -> f64 {
        match self.gives {
            _ if x == 0.0 => 0.0,
            Gives::Height if x.abs() > self.lossy() => self.written(x.abs()),
            Gives::Height | Gives::Slope => self.integral(x.abs()),
        }
    }

    fn slope(&self, x: f64) -> f64 {
        if x == 0.0 {
            return 0.0;
        }
        let outward = self.steepness(x.abs());
        let outward = if outward.is_nan() && self.kinks.contains(&x.abs()) {
            // |x - 1|/(x - 1) has no value at 1, but one on each side.
            let near = 1e-12 * x.abs();
            0.5 * (self.steepness(x.abs() - near) + self.steepness(x.abs() + near))
        } else {
            outward
        };
        if x < 0.0 { -outward } else { outward }
    }

    fn natural_length(&self) -> f64 {
        self.natural_length
    }

    fn flaw(&self, half_width: f64) -> Option<Flaw> {
        // A dent may be narrower than the steps of a first look.
        let mut places = self.kinks.clone();
        places.extend(details::looked_at(&self.details(half_width)));
        self.flaw_among(half_width, &places)
    }

    fn face(&self) -> f64 {
        self.face
    }

    fn details(&self, half_width: f64) -> Vec<f64> {
        // Contacts hardly wider than the last one share theirs.
        let length = half_width.log2().ceil().exp2();
        let mut known = self.details.lock().unwrap_or_else(PoisonError::into_inner);
        if known.0.to_bits() != length.to_bits() {
            let places = self.formula.narrow_places(length).into_iter();
            let cuts = details::beside(places.map(|(x, width)| (x / length, width / length)), 1.0, 1.0);
            *known = (length, cuts.into_iter().map(|cut| cut * length).collect());
        }
        known.1.iter().copied().take_while(|x| *x < half_width).collect()
    }

    fn kinks(&self) -> &[f64] {
        &self.kinks
    }

    fn corners(&self) -> &[f64] {
        &self.corners
    }
}

/// Whether differences of slopes, each as much nearer to a place as the one before, leave a jump there: the limit of a jump and one power of
/// the distance, by any three of them (Aitken). Of `|x|^1.0000001` it leaves nothing, and of `|x| + |x|^1.05` the jump.
fn leave_a_jump(least: f64, beside: [f64; 4]) -> bool {
    let limit = |places: &[f64]| {
        let (before, last) = (places[1] - places[0], places[2] - places[1]);
        // Nothing but rounding shrinks.
        if last.abs() <= 1e-12 * places[2].abs() { places[2] } else { places[2] - last * last / (last - before) }
    };
    let (far, near) = (limit(&beside[..3]), limit(&beside[1..]));
    // What is left of a power is of rounding; two powers, or logarithms, leave what three nearer ones do not confirm.
    near.abs() > least && near.abs() > 1e-3 * beside[3].abs() && (near / far - 1.0).abs() < 1e-3
}

/// A punch as it is written, to be looked over without an integral at each point: where the slope is given, the height
/// has the right sign as long as that has not begun to fall.
#[derive(Debug)]
struct Written<'g>(&'g Graph);

impl PunchShape for Written<'_> {
    fn height(&self, x: f64) -> f64 {
        match self.0.gives {
            Gives::Height => self.0.written(x.abs()),
            Gives::Slope => x * self.0.slope(x),
        }
    }

    fn slope(&self, x: f64) -> f64 {
        self.0.slope(x)
    }

    fn natural_length(&self) -> f64 {
        self.0.natural_length
    }
}
