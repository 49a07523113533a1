//! A layer far thinner than its contact is wide, in closed form: each point of the surface sinks by its own pressure
//! alone.
//!
//! The flexibility of long waves is `Fvv(0)`, so that `p = (delta - g)/Fvv(0)` but for stretches of a thickness or so
//! at the edges. Seen from further away those only shift the edge: by Wiener and Hopf's factors of `phi(s) =
//! Fvv(s)/Fvv(0)` the pressure runs out not at `b` but at `B = b + lambda`, `lambda = -(1/pi) int_0^inf ln phi(s)/s^2
//! ds`. With `delta = g(B)` what is left out is of the second order in `h/b` under shapes that change little over a
//! thickness, and told from the changes of the slope under others (docs/planner.md).

use crate::engine::accuracy::quantity::{Numbers, Quantity};
use crate::engine::numerics::root;
use crate::engine::problem::{LoadInLayerUnits, Problem};
use crate::engine::stand_in;
use bilby::QuadratureRule;
use slipzone_api::{LayerResponse, Refusal};
use std::f64::consts::{LN_2, PI};
use std::ops::RangeInclusive;

/// Nodes in each panel of the integrals, and fewer, to see what they are good to.
const NODES: [usize; 2] = [16, 12];
/// Panels of wave numbers end at 1, 2, 4, ... this; from there on the flexibility is smooth in its inverse.
const LAST: f64 = 32.0;
/// Wave numbers at which the flexibility is evaluated.
pub(crate) const EVALUATIONS: usize = LONG.len() + 7 * (NODES[0] + NODES[1]);
/// Wave numbers from which the flexibility of long waves is extrapolated.
const LONG: [f64; 4] = [0.16, 0.08, 0.04, 0.02];
/// Nodes over the shape, and over each of its parts, to see what they are good to.
const SHAPE: [usize; 2] = [64, 12];
/// Error over `(m + 1)^2 (lambda^2 + |phi''(0)|/2 + 0.1) (h/b)^2`, `m = b g'/g`; measured in docs/planner.md.
const SECOND_ORDER: f64 = 0.8;
/// Powers of two over [`Thin::spread`] at which changes of the slope are looked at: what is narrower does not show,
/// what is farther is not felt.
const CHANGES: RangeInclusive<i32> = -40..=4;
/// [`Thin::spread`] over `(phi''(0)/2)^(1/2)`: of bonded layers the pressure falls a little more slowly than that.
const SPREAD: f64 = 1.2;
/// Length that an edge feels beside `lambda`, and more by so much of what [`Thin::spread`] is above one; measured in
/// docs/planner.md.
const EDGE: (f64, f64) = (0.1, 0.5);
/// Parts of the contact at whose ends the pressure is looked at, beside the details of the shape.
const PARTS: u32 = 64;
/// Half-widths over the thickness below which nothing is claimed.
const NARROWEST: f64 = 4.0;

/// What of a layer matters under a wide contact, in units of its thickness and of `A0`.
struct Thin {
    /// `Fvv(0)/A0`.
    compliance: f64,
    /// `lambda`.
    shift: f64,
    /// `phi''(0)/2`.
    bend: f64,
    /// Errors of the first two, the first relative.
    errors: (f64, f64),
}

/// Why no contact can be told in closed form, of those on a path to a load or of one alone.
pub(crate) fn obstacle(problem: &Problem, has_path: bool) -> Option<&'static str> {
    let is_smooth = problem.fixed_half_width().is_none() && !problem.is_kinked();
    if !is_smooth {
        Some("takes a punch without corners, flats or kinks")
    } else if problem.friction.is_some() {
        Some("has no shear: leave `stick` and `profile` out of `output.quantities`, or the friction")
    } else if problem.wishes.profile {
        Some("has no tractions near the edge: leave `profile` out of `output.quantities`")
    } else if !problem.is_on_rigid_base() {
        Some("takes a layer on a rigid base")
    } else if has_path {
        Some("has no loading curve")
    } else {
        None
    }
}

/// Whether a contact may be so wide that its error is below what is allowed, as far as is seen without the layer.
pub(crate) fn may_serve(problem: &Problem, allowed: f64) -> bool {
    // No error is smaller: (m + 1)^2 > 4 for convex shapes.
    let needed = NARROWEST.max((SECOND_ORDER * 4.0 * 0.1 / allowed).sqrt());
    let b = needed.min(problem.reach());
    match problem.load {
        LoadInLayerUnits::HalfWidth(half_width) => half_width >= needed,
        // A layer is stiffer than a half-plane: its contact is narrower.
        LoadInLayerUnits::Force(force) => force >= 0.5 * PI * b * problem.slope(b) / problem.elastic.a0(),
        LoadInLayerUnits::Indentation(depth) => depth >= problem.height(b) - problem.height(0.0),
    }
}

/// The numbers of the contact and bounds on their relative errors, in layer units, of a contact that [`obstacle`] lets
/// pass; refuses what cannot be told.
pub(crate) fn told(problem: &Problem, response: &dyn LayerResponse) -> Result<(Numbers, Numbers), Refusal> {
    const NOTHING: &str = "the model `thin` tells nothing of a contact narrower than four thicknesses, of one that reaches a kink of the \
                           punch, or of one that may break up";
    let whole = |b: f64| problem.flaw(b).is_none();
    let found = solve(problem, response);
    let told = found.filter(|(numbers, _)| numbers.get(Quantity::HalfWidth).is_some_and(whole));
    told.ok_or(Refusal::OutOfReach { method: "model", why: NOTHING.into(), remedy: stand_in::REMEDY })
}

/// The same; `None` where they cannot be told.
fn solve(problem: &Problem, response: &dyn LayerResponse) -> Option<(Numbers, Numbers)> {
    let layer = Thin::of(response)?;
    let a0 = problem.elastic.a0();
    let stiffness = (a0 * layer.compliance).recip();
    let height = |x: f64| problem.height(x) - problem.height(0.0);
    let [whole, of_parts] = SHAPE.map(rule);
    let force = |wide: f64| 2.0 * stiffness * raised(problem, wide, &problem.details(wide), &whole);
    let wide = match problem.load {
        LoadInLayerUnits::HalfWidth(b) => b + layer.shift,
        LoadInLayerUnits::Force(target) => root(problem, |wide| force(wide) / target)?,
        LoadInLayerUnits::Indentation(depth) => root(problem, |wide| problem.height(wide) / depth)?,
    };
    let b = wide - layer.shift;
    if !(b >= NARROWEST && wide > 0.5 * b && wide.max(b) <= problem.reach()) {
        return None;
    }
    let p = force(wide);
    let parts = problem.parts(wide, PARTS);
    let in_parts = 2.0 * stiffness * raised(problem, wide, &parts, &of_parts);
    let centre = stiffness * height(wide);
    let mut numbers = Numbers::default();
    for (quantity, value) in [
        (Quantity::Force, p),
        (Quantity::HalfWidth, b),
        (Quantity::Indentation, problem.height(wide)),
        (Quantity::Centre, centre),
        (Quantity::Mean, p / (2.0 * b)),
        (Quantity::Peak, centre),
        (Quantity::StressIntensity, 0.0),
        (Quantity::EdgeRatio, 0.0),
    ] {
        numbers.set(quantity, value);
    }
    let power = 1.0 + b * problem.slope(b) / height(b);
    let second = SECOND_ORDER * power * power * (layer.shift.powi(2) + layer.bend.abs() + 0.1) / (b * b);
    let numerical = layer.errors.0 + power * layer.errors.1 / b + (in_parts / p - 1.0).abs();
    let rise = height(wide);
    let at_edge = layer.at_edge(problem, b) / rise;
    let beside = |x: f64| layer.beside(problem, x, b.max(wide)) / rise;
    // Away from the middle it may be the peak where it is more than what the pressure falls by up to there.
    let beyond = parts.iter().map(|&x| beside(x) - height(x) / rise);
    let in_middle = beside(0.0);
    let at_peak = beyond.fold(in_middle, f64::max);
    let mut errors = Numbers::default();
    let given: Vec<Quantity> = problem.given().collect();
    for (quantity, value) in numbers.iter() {
        let of_shape = match quantity {
            Quantity::Centre => at_edge + in_middle,
            Quantity::Peak => at_edge + at_peak,
            // All of the pressure moves with the depth, over all of the contact.
            _ => at_edge * 2.0 * b * centre / p,
        };
        let error = second.max(of_shape) + numerical;
        if !value.is_finite() || !error.is_finite() {
            return None;
        }
        if problem.wishes.judges(quantity) {
            errors.set(quantity, if given.contains(&quantity) { 0.0 } else { error });
        }
    }
    Some((numbers, errors))
}

/// `int_0^B (g(B) - g(x)) dx = int_0^B x g'(x) dx`, cut at places that ascend; up to the first over the fourth root of
/// `x`: smooth for any power of it.
fn raised(problem: &Problem, wide: f64, cuts: &[f64], rule: &QuadratureRule<f64>) -> f64 {
    let mut from = 0.0;
    let piece = |&to: &f64| {
        let width = to - from;
        let integral = rule.integrate(0.0, 1.0, |t| {
            let (share, weight) = if from > 0.0 { (t, 1.0) } else { (t.powi(4), 4.0 * t.powi(3)) };
            let x = from + width * share;
            x * problem.slope(x) * weight * width
        });
        from = to;
        integral
    };
    cuts.iter().chain([&wide]).map(piece).sum()
}

/// The width at which a growing function is 1.
fn root(problem: &Problem, f: impl Fn(f64) -> f64) -> Option<f64> {
    const MOST: usize = 400;
    let reach = problem.reach();
    let mut upper = 1.0_f64.min(reach);
    for _ in 0..MOST {
        if f(upper) >= 1.0 || upper >= reach {
            break;
        }
        upper = (2.0 * upper).min(reach);
    }
    let mut lower = 0.5 * upper;
    for _ in 0..MOST {
        if f(lower) <= 1.0 {
            break;
        }
        lower *= 0.5;
    }
    root::between((lower.ln(), upper.ln()), 1e-14, |log| f(log.exp()).ln()).map(f64::exp)
}

impl Thin {
    fn of(response: &dyn LayerResponse) -> Option<Self> {
        let scaled = |s: f64| response.surface(s).map(|f| f.vv).ok().filter(|vv| *vv > 0.0);
        // Fvv(s)/A0 is even and analytic at 0: Richardson's extrapolation in s^2.
        let mut long = [0.0; LONG.len()];
        for (value, s) in long.iter_mut().zip(LONG) {
            *value = scaled(s)? / s;
        }
        let bend = (long[0] - long[1]) / (LONG[0].powi(2) - LONG[1].powi(2));
        let mut before = 0.0;
        for order in 1..long.len() {
            before = long[long.len() - 1];
            for i in (order..long.len()).rev() {
                let ratio = (LONG[i - order] / LONG[i]).powi(2);
                long[i] += (long[i] - long[i - 1]) / (ratio - 1.0);
            }
        }
        let compliance = long[long.len() - 1];
        let [shift, coarse] = NODES.map(|nodes| shift(&scaled, compliance, nodes));
        let (shift, coarse) = (shift?, coarse?);
        let relative = (before / compliance - 1.0).abs().max(1e-12);
        Some(Self { compliance, shift, bend: bend / compliance, errors: (relative, (shift - coarse).abs() + relative) })
    }

    /// How far away the pressure feels the shape: farther where the layer hardly yields but by flowing out, or has a
    /// stiff skin.
    fn spread(&self) -> f64 {
        (SPREAD * self.bend.abs().sqrt()).max(1.0)
    }

    /// What is left out of `p Fvv(0)` beside `x`, in a contact that ends at `end`: `int |m'| (g'(x + t) - g'(x - t))
    /// dt`, the transform of `m` being `(1/phi - 1)/s^2`.
    ///
    /// `|m'|` is `Fvv(0)/(pi A0 t)` near by, for a surface yields to narrow loads as a half-plane does. Farther away it
    /// falls like an exponential: where a layer only flows out, half of that.
    fn beside(&self, problem: &Problem, x: f64, end: f64) -> f64 {
        let spread = self.spread();
        let felt = |power: i32| {
            let t = f64::from(power).exp2() * spread;
            let slope = |x: f64| problem.slope(x.clamp(-end, end));
            let weight = self.compliance / PI + 0.5 * t * self.bend.abs().min(1.0);
            weight * (-t / spread).exp() * (slope(x + t) - slope(x - t))
        };
        LN_2 * CHANGES.map(felt).sum::<f64>()
    }

    /// What is left out of the depth for the changes of the slope near the edge.
    fn at_edge(&self, problem: &Problem, b: f64) -> f64 {
        let (spread, slope) = (self.spread(), problem.slope(b));
        let change = |power: i32| {
            let t = f64::from(power).exp2() * spread;
            (-t / spread).exp() * (slope - problem.slope((b - t).max(-b))).abs()
        };
        let beyond = problem.height(b + self.shift) - problem.height(b) - self.shift * slope;
        let felt = self.shift.abs() + EDGE.0 + EDGE.1 * (spread - 1.0);
        felt * CHANGES.map(change).fold(0.0, f64::max) + beyond.abs()
    }
}

/// `lambda`, from `s Fvv/A0`.
fn shift(scaled: &impl Fn(f64) -> Option<f64>, compliance: f64, nodes: usize) -> Option<f64> {
    let rule = rule(nodes);
    // What is refused is NaN, and the sum with it.
    let log = |s: f64, divided: f64| scaled(s).map_or(f64::NAN, |vv| (vv / divided).ln());
    let (mut sum, mut from, mut to) = (0.0, 0.0, 1.0);
    while to <= LAST {
        sum += rule.integrate(from, to, |s| log(s, s * compliance) / (s * s));
        (from, to) = (to, 2.0 * to);
    }
    // Beyond, the logarithm of `1/(s compliance)` in closed form, and the rest over `1/s`.
    sum += rule.integrate(0.0, 1.0, |u| log(from / u, 1.0)) / from;
    sum -= ((from * compliance).ln() + 1.0) / from;
    sum.is_finite().then_some(-sum / PI)
}

fn rule(nodes: usize) -> QuadratureRule<f64> {
    bilby::GaussLegendre::new(nodes).expect("nodes").rule().clone()
}
