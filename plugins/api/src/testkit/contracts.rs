//! What every grading and every punch promises, tried out at a few points.

use crate::contract::{self, ensure};
use crate::{Grading, ModulusLaw, NoFiles, Poisson, Positive, PunchProfile, PunchShape, Setting, Sublayer};

/// The law describes an elastic solid, and what it says beside its values agrees with them.
pub(super) fn grading(mut config: Box<dyn Grading>) -> Result<(), String> {
    config.read(&NoFiles).map_err(|e| format!("not readable: {e}"))?;
    let thickness = Positive::new(3.0).expect("a positive constant");
    let thickness = config.thickness().unwrap_or(thickness);
    let law = config.law(&Setting::thick(thickness)).or_else(|_| config.law(&Setting::default()));
    let law = law.map_err(|e| format!("no law: {e}"))?;
    solid(&*law)
}

/// What a law says of each of its constants, of its breakpoints and of its sublayers.
pub(super) fn solid(law: &dyn ModulusLaw) -> Result<(), String> {
    modulus(law)?;
    poisson(law)?;
    contract::parts(law)?;
    sublayers(law)
}

/// The modulus is finite and positive, and its exponent and its slope at the surface are what the law says.
fn modulus(law: &dyn ModulusLaw) -> Result<(), String> {
    let surface = law.surface_modulus();
    for depth in depths() {
        let mu = law.modulus(depth);
        ensure(mu > 0.0 && mu < f64::INFINITY, || format!("modulus({depth}) = {mu}"))?;
        if let Some(exponent) = law.exponent() {
            // exp and ln each round once; the exponent's own rounding counts with its size.
            let error = (mu / surface).ln() - exponent * depth;
            ensure(error.abs() < 4.0 * f64::EPSILON * (1.0 + exponent.abs()), || {
                format!("exponent() = {exponent}, but modulus({depth}) is off by {error:e} in its logarithm")
            })?;
        }
    }
    let at_zero = law.modulus(0.0);
    ensure((at_zero / surface - 1.0).abs() < 4.0 * f64::EPSILON, || {
        format!("surface_modulus() = {surface}, but modulus(0) = {at_zero}")
    })?;
    let series = law.surface_series(6);
    ensure(series.first().is_none_or(|first| (first - 1.0).abs() < 4.0 * f64::EPSILON), || {
        format!("surface_series() begins with {}", series[0])
    })?;
    slope("surface_series", "modulus", &law.surface_series(2), |depth| law.modulus(depth) / surface)?;
    match law.broken_power() {
        None => higher("surface_series", "modulus", &series, (|depth| law.modulus(depth) / surface, smooth_to(law))),
        Some(power) => ensure(power.fract() != 0.0, || format!("broken_power() = {power}, which is a whole number")),
    }
}

/// Poisson's ratio is in range, at all depths or nowhere but in sublayers, and its slope is what the law says.
fn poisson(law: &dyn ModulusLaw) -> Result<(), String> {
    for depth in depths() {
        let Some(nu) = law.poisson(depth) else { continue };
        ensure(Poisson::new(nu).is_ok(), || format!("poisson({depth}) = {nu}"))?;
        let is_constant = law.poisson(0.0) == Some(nu);
        ensure(law.exponent().is_none() || is_constant, || {
            format!("exponent() is there, but poisson({depth}) = {nu} is not that of the surface")
        })?;
    }
    let Some(surface) = law.poisson(0.0) else { return Ok(()) };
    let series = law.poisson_series(2);
    ensure(series.first().is_none_or(|first| (first - surface).abs() < 4.0 * f64::EPSILON), || {
        format!("poisson_series() begins with {}, but poisson(0) = {surface}", series[0])
    })?;
    let ratio = |depth| law.poisson(depth).unwrap_or(f64::NAN);
    slope("poisson_series", "poisson", &series, ratio)?;
    match law.broken_power() {
        None => higher("poisson_series", "poisson", &law.poisson_series(6), (ratio, smooth_to(law))),
        Some(_) => Ok(()),
    }
}

/// The depth down to which a law says that it is smooth.
fn smooth_to(law: &dyn ModulusLaw) -> f64 {
    let first = law.breakpoints().iter().chain(law.details()).copied().filter(|depth| *depth > 0.0);
    first.fold(1.0, f64::min)
}

fn depths() -> impl Iterator<Item = f64> {
    (0..=20).map(|i| f64::from(i) / 20.0)
}

/// The second coefficient of a series is the slope of its function.
fn slope(series: &str, name: &str, coefficients: &[f64], value: impl Fn(f64) -> f64) -> Result<(), String> {
    let &[_, gradient] = coefficients else { return Ok(()) };
    // One-sided differences of second order: rounding leaves 1e-11, the third derivative 1e-10 of itself.
    let d = 1e-5;
    let slope = (4.0 * value(d) - 3.0 * value(0.0) - value(2.0 * d)) / (2.0 * d);
    ensure((slope - gradient).abs() < 1e-4 * (1.0 + gradient.abs()), || {
        format!("{series}() has the slope {gradient}, but {name}() gives {slope}")
    })
}

/// A series tells its function next to the surface as well as its terms let it, far before it is smooth no more.
fn higher(
    series: &str,
    name: &str,
    coefficients: &[f64],
    (value, smooth_to): (impl Fn(f64) -> f64, f64),
) -> Result<(), String> {
    /// Each term but the first is below this at the depth that is looked at, which is no deeper than that.
    const SMALL: f64 = 0.01;
    const DEEPEST: f64 = 0.005;
    /// What is left of so many terms is below that power of this, or below the last two of them.
    const LEFT: f64 = 0.05;
    let count = coefficients.len();
    ensure(coefficients.iter().all(|coefficient| coefficient.is_finite()), || {
        format!("{series}({count}) is {coefficients:?}")
    })?;
    if count < 3 {
        return Ok(());
    }
    let within = |(k, coefficient): (usize, &f64)| (SMALL / coefficient.abs()).powf((k as f64).recip());
    let depth = coefficients.iter().enumerate().skip(1).map(within).fold(DEEPEST.min(0.1 * smooth_to), f64::min);
    let told = coefficients.iter().rev().fold(0.0, |rest, coefficient| coefficient + depth * rest);
    let term = |k: usize| (coefficients[k] * depth.powf(k as f64)).abs();
    let left = LEFT.powf(count as f64) + term(count - 1) + term(count - 2);
    ensure((told - value(depth)).abs() <= left, || {
        format!("{series}({count}) gives {told} at depth {depth}, but {name}() is {}", value(depth))
    })
}

/// The sublayers keep the contract themselves, and are what the whole says at its own depths.
fn sublayers(law: &dyn ModulusLaw) -> Result<(), String> {
    let mut top = 0.0;
    for (index, Sublayer { thickness, law: own }) in (1..).zip(law.sublayers()) {
        solid(&**own).map_err(|fault| format!("sublayer {index}: {fault}"))?;
        for depth in [0.1, 0.5, 0.9] {
            let of_whole = (law.modulus(top + depth * thickness), law.poisson(top + depth * thickness));
            let (modulus, poisson) = (own.modulus(depth), own.poisson(depth));
            let same_ratio = match (of_whole.1, poisson) {
                (Some(a), Some(b)) => (a - b).abs() < 1e-9,
                (a, b) => a.is_none() && b.is_none(),
            };
            ensure((of_whole.0 / modulus - 1.0).abs() < 1e-9 && same_ratio, || {
                format!(
                    "sublayer {index} has {modulus}, {poisson:?} at depth {depth}, but the whole {of_whole:?} there"
                )
            })?;
        }
        top += thickness;
    }
    Ok(())
}

/// The height is even and zero at the tip, and its derivative is the slope.
pub(super) fn punch(mut config: Box<dyn PunchProfile>) -> Result<(), String> {
    config.read(&NoFiles).map_err(|e| format!("not readable: {e}"))?;
    shape(&*config.shape().map_err(|e| format!("no shape: {e}"))?)
}

pub(super) fn shape(shape: &dyn PunchShape) -> Result<(), String> {
    contract::shape(shape)?;
    let half_width = shape.fixed_half_width().unwrap_or_else(|| shape.natural_length());
    let face = shape.face();
    ensure(shape.height(face) == 0.0, || format!("face() = {face}, but height({face}) = {}", shape.height(face)))?;
    if let Some(doubt) = shape.doubt(half_width) {
        ensure((0.0..f64::INFINITY).contains(&doubt), || format!("doubt({half_width}) = {doubt}"))?;
    }
    if let Some(reach) = shape.reach() {
        ensure(half_width <= reach, || format!("reach() = {reach}, but natural_length() = {half_width}"))?;
    }
    let tip = shape.height(0.0);
    ensure(tip == 0.0, || format!("height(0) = {tip}"))?;
    along(shape, half_width)?;
    let level = shape.slope(0.0);
    ensure(level == 0.0, || format!("slope(0) = {level}"))
}

/// What holds at every point of a contact.
fn along(shape: &dyn PunchShape, half_width: f64) -> Result<(), String> {
    let points = (1..20).map(|i| f64::from(i) / 20.0 * half_width);
    let steepest = points.clone().map(|x| shape.slope(x).abs()).fold(0.0, f64::max);
    let flaw = shape.flaw(half_width);
    let is_sound = flaw.is_none();
    if let Some(flaw) = flaw {
        ensure(flaw.x >= 0.0 && flaw.x <= half_width, || format!("flaw({half_width}) lies at {}", flaw.x))?;
    }
    let mut before = f64::NEG_INFINITY;
    for x in points {
        let (height, slope) = (shape.height(x), shape.slope(x));
        ensure(height.is_finite() && slope.is_finite(), || format!("height {height}, slope {slope} at {x}"))?;
        let (mirrored, turned) = (shape.height(-x), shape.slope(-x));
        let rounding = 4.0 * f64::EPSILON;
        ensure((mirrored - height).abs() <= rounding * height.abs(), || {
            format!("height({x}) = {height}, but height(-{x}) = {mirrored}")
        })?;
        ensure((turned + slope).abs() <= rounding * slope.abs(), || {
            format!("slope({x}) = {slope}, but slope(-{x}) = {turned}")
        })?;
        // Central differences: the third derivative counts with (step/x)^2 <= 4e-8, rounding with 1e-11.
        let step = 1e-5 * half_width;
        if !shape.kinks().iter().any(|kink| (kink - x).abs() <= step) {
            let difference = (shape.height(x + step) - shape.height(x - step)) / (2.0 * step);
            ensure((difference - slope).abs() <= 1e-6 * steepest, || {
                format!("slope({x}) = {slope}, but height() rises by {difference}")
            })?;
        }
        // Slopes of fitted shapes round.
        ensure(slope >= before - 1e-12 * steepest || !is_sound, || {
            format!("flaw({half_width}) is none, but the slope falls before {x}")
        })?;
        before = slope;
    }
    Ok(())
}
