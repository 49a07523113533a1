//! A layer far thinner than its contact is wide, in closed form: each point of the surface yields by what presses on it.
//!
//! The flexibility of long waves is `Fvv(0)`, so that `p = (delta - g)/Fvv(0)` but for stretches of a thickness or so at the
//! edges. Seen from further away those only shift the edge: by Wiener and Hopf's factors of `phi(s) = Fvv(s)/Fvv(0)` the
//! pressure runs out not at `b` but at `B = b + lambda`, `lambda = -(1/pi) int_0^inf ln phi(s)/s^2 ds`. With `delta = g(B)`
//! what is left out is of the second order in `h/b` (docs/planner.md).

use super::problem::{LoadInLayerUnits, Problem};
use super::quantity::{Numbers, Quantity};
use super::root;
use super::stand_in;
use bilby::QuadratureRule;
use slipzone_api::{LayerResponse, Refusal};
use std::f64::consts::PI;

/// Nodes in each panel of the integrals, and fewer, to see what they are good to.
const NODES: [usize; 2] = [16, 12];
/// Panels of wave numbers end at 1, 2, 4, ... this; from there on the flexibility is smooth in its inverse.
const LAST: f64 = 32.0;
/// Wave numbers at which the flexibility is evaluated.
pub(super) const EVALUATIONS: usize = LONG.len() + 7 * (NODES[0] + NODES[1]);
/// Wave numbers from which the flexibility of long waves is extrapolated.
const LONG: [f64; 4] = [0.16, 0.08, 0.04, 0.02];
/// Nodes over the shape.
const SHAPE: [usize; 2] = [64, 48];
/// Error over `(m + 1)^2 (lambda^2 + |phi''(0)|/2 + 0.1) (h/b)^2`, `m = b g'/g`; measured in docs/planner.md.
const SECOND_ORDER: f64 = 0.8;
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
pub(super) fn obstacle(problem: &Problem, has_path: bool) -> Option<&'static str> {
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
pub(super) fn may_serve(problem: &Problem, allowed: f64) -> bool {
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

/// The numbers of the contact and bounds on their relative errors, in layer units, of a contact that [`obstacle`] lets pass; refuses
/// what cannot be told.
pub(super) fn told(problem: &Problem, response: &dyn LayerResponse) -> Result<(Numbers, Numbers), Refusal> {
    const NOTHING: &str =
        "the model `thin` tells nothing of a contact narrower than four thicknesses, or of one that may break up";
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
    let [fine, coarse] = SHAPE.map(rule);
    let force = |wide: f64, rule: &QuadratureRule<f64>| 2.0 * stiffness * raised(problem, wide, rule);
    let wide = match problem.load {
        LoadInLayerUnits::HalfWidth(b) => b + layer.shift,
        LoadInLayerUnits::Force(target) => root(problem, |wide| force(wide, &fine) / target)?,
        LoadInLayerUnits::Indentation(depth) => root(problem, |wide| problem.height(wide) / depth)?,
    };
    let b = wide - layer.shift;
    if !(b >= NARROWEST && wide > 0.5 * b && wide <= problem.reach()) {
        return None;
    }
    let p = force(wide, &fine);
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
    let numerical = layer.errors.0 + power * layer.errors.1 / b + (force(wide, &coarse) / p - 1.0).abs();
    let error = second + numerical + problem.layer.law.smoothing_error(b);
    let mut errors = Numbers::default();
    let given: Vec<Quantity> = problem.given().collect();
    for (quantity, value) in numbers.iter() {
        if !value.is_finite() || !error.is_finite() {
            return None;
        }
        if problem.wishes.judges(quantity) {
            errors.set(quantity, if given.contains(&quantity) { 0.0 } else { error });
        }
    }
    Some((numbers, errors))
}

/// `int_0^B (g(B) - g(x)) dx = int_0^B x g'(x) dx`, over the fourth root of `x`: smooth for any power of it.
fn raised(problem: &Problem, wide: f64, rule: &QuadratureRule<f64>) -> f64 {
    rule.integrate(0.0, 1.0, |t| {
        let x = wide * t.powi(4);
        x * problem.slope(x) * 4.0 * wide * t.powi(3)
    })
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
