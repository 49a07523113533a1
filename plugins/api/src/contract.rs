//! What the numbers that a run-time half tells of itself must be, in a few comparisons: before every solve, and by the
//! testkit.

use crate::{Edge, KernelTable, LayerResponse, ModulusLaw, Parity, PunchShape, Refusal, Rule, SurfaceFlexibility};

/// Kinks that integrals can be split at.
const MOST_KINKS: usize = 64;
/// What rounding leaves where two things that a law tells are one.
const AGREEMENT: f64 = 1e-9;

/// The lengths and places that a shape tells: lengths are positive and finite, kinks ascend from 0 and are not too
/// many, and corners are kinks.
///
/// # Errors
/// The first that is not, and what it is.
pub fn shape(shape: &dyn PunchShape) -> Result<(), String> {
    length("natural_length", shape.natural_length())?;
    told("fixed_half_width", shape.fixed_half_width())?;
    told("reach", shape.reach())?;
    let face = shape.face();
    ensure((0.0..f64::INFINITY).contains(&face), || format!("face() = {face}"))?;
    if let Some(noise) = shape.noise() {
        ensure((0.0..f64::INFINITY).contains(&noise), || format!("noise() = {noise}"))?;
    }
    kinks(shape)
}

/// What a method of that name tells is a length: positive and finite.
///
/// # Errors
/// What it is instead.
pub fn length(name: &str, length: f64) -> Result<(), String> {
    ensure(length > 0.0 && length < f64::INFINITY, || format!("{name}() = {length}"))
}

fn kinks(shape: &dyn PunchShape) -> Result<(), String> {
    let (kinks, corners) = (shape.kinks(), shape.corners());
    ensure(kinks.len() <= MOST_KINKS, || format!("{} kinks, which are more than {MOST_KINKS}", kinks.len()))?;
    let from_zero = kinks.iter().all(|x| *x >= 0.0 && x.is_finite());
    ensure(from_zero && kinks.windows(2).all(|w| w[0] < w[1]), || format!("kinks {kinks:?} do not ascend from 0"))?;
    ensure(corners.is_sorted(), || format!("corners {corners:?} do not ascend"))?;
    match corners.iter().find(|corner| !kinks.contains(corner)) {
        Some(corner) => Err(format!("the corner {corner} is not among the kinks {kinks:?}")),
        None => Ok(()),
    }
}

/// The depths and parts that a law and its sublayers tell, before anything is taken from them: breakpoints ascend
/// within (0, 1), details and probes within [0, 1], a power is above 0, and the sublayers fill the layer.
///
/// # Errors
/// The first that does not, and what it is.
pub fn parts(law: &dyn ModulusLaw) -> Result<(), String> {
    let (breaks, details) = (law.breakpoints(), law.details());
    let inside = breaks.iter().all(|depth| *depth > 0.0 && *depth < 1.0);
    ensure(inside && breaks.windows(2).all(|w| w[0] < w[1]), || {
        format!("breakpoints {breaks:?} do not ascend within (0, 1)")
    })?;
    ensure(details.iter().all(|depth| (0.0..=1.0).contains(depth)), || {
        format!("details {details:?} do not lie within [0, 1]")
    })?;
    ensure(details.is_sorted(), || format!("details {details:?} do not ascend"))?;
    let probes = law.probes();
    ensure(probes.is_sorted() && probes.iter().all(|depth| (0.0..=1.0).contains(depth)), || {
        format!("probes {probes:?} do not ascend within [0, 1]")
    })?;
    told("broken_power", law.broken_power())?;
    let sublayers = law.sublayers();
    let whole: f64 = sublayers.iter().map(|sublayer| sublayer.thickness).sum();
    let fills = sublayers.iter().all(|sublayer| sublayer.thickness > 0.0) && (whole - 1.0).abs() <= AGREEMENT;
    ensure(sublayers.is_empty() || fills, || format!("sublayers are {whole} of the whole thick"))?;
    sublayers.iter().enumerate().try_for_each(|(index, sublayer)| {
        parts(&*sublayer.law).map_err(|fault| format!("sublayer {}: {fault}", index + 1))
    })
}

/// What a law and its sublayers tell beside their values agrees with these: the modulus at the surface, and the
/// exponent.
///
/// # Errors
/// The first that does not, and what it is.
pub fn values(law: &dyn ModulusLaw) -> Result<(), String> {
    let surface = law.surface_modulus();
    let at_zero = law.modulus(0.0);
    // No number is no agreement, in each of these.
    ensure(surface > 0.0 && surface < f64::INFINITY && (at_zero / surface - 1.0).abs() <= AGREEMENT, || {
        format!("surface_modulus() = {surface}, but modulus(0) = {at_zero}")
    })?;
    if let Some(exponent) = law.exponent() {
        for depth in [0.5, 1.0] {
            let error = (law.modulus(depth) / surface).ln() - exponent * depth;
            ensure(exponent.is_finite() && error.abs() <= AGREEMENT * (1.0 + exponent.abs()), || {
                format!("exponent() = {exponent}, but modulus({depth}) is off by {error:e} in its logarithm")
            })?;
            ensure(law.poisson(depth) == law.poisson(0.0), || {
                format!("exponent() is there, but poisson({depth}) is not that of the surface")
            })?;
        }
    }
    law.sublayers().iter().enumerate().try_for_each(|(index, sublayer)| {
        values(&*sublayer.law).map_err(|fault| format!("sublayer {}: {fault}", index + 1))
    })
}

/// The lengths and the power that a layer's response tells of it are above 0 and finite, and what it tells of long
/// waves is a number.
///
/// # Errors
/// The first that is not, and what it is.
pub fn response(response: &dyn LayerResponse) -> Result<(), String> {
    told("depth", response.depth())?;
    told("thickness", response.thickness())?;
    told("extent", response.extent())?;
    let pole = response.pole();
    ensure((0.0..f64::INFINITY).contains(&pole), || format!("pole() = {pole}"))?;
    told("broken_power", response.broken_power())
}

/// Flexibilities are numbers, each at its wave number: the largest of some errors passes over what is none.
///
/// # Errors
/// The first that is none.
pub fn numbers(wave_numbers: &[f64], flexibilities: &[SurfaceFlexibility]) -> Result<(), Refusal> {
    let is_number = |f: &SurfaceFlexibility| f.vv.is_finite() && f.uu.is_finite() && f.uv.is_finite();
    match wave_numbers.iter().zip(flexibilities).find(|(_, f)| !is_number(f)) {
        None => Ok(()),
        Some((s, f)) => Err(Refusal::WaveNumber {
            method: "flexibility",
            wave_number: *s,
            why: format!("it gives {f:?}"),
            remedy: "take another flexibility, or check the layer's constants",
        }),
    }
}

/// The lengths and the power that a kernel table tells are above 0 and finite, and its bound is none that proves
/// nothing.
///
/// # Errors
/// The first that is not, and what it is.
pub fn table(table: &dyn KernelTable) -> Result<(), String> {
    length("length", table.length())?;
    told("nearest", table.nearest())?;
    told("power", table.power())?;
    ensure(table.error().is_none_or(|error| error >= 0.0), || format!("error() = {:?}", table.error()))?;
    ensure(table.edge_error() >= 0.0, || format!("edge_error() = {:?}", table.edge_error()))
}

/// A length, or a power, where one is told.
fn told(name: &str, told: Option<f64>) -> Result<(), String> {
    told.map_or(Ok(()), |told| length(name, told))
}

/// A rule on a symmetric span has as many equations as its unknowns want, and what goes with them has their number.
///
/// # Errors
/// The first that does not, and what it is.
pub fn rule(rule: &dyn Rule, parity: Parity, edge: Edge) -> Result<(), String> {
    let excess = match (parity, edge) {
        (Parity::Even, Edge::Sharp) => -1,
        (Parity::Odd, Edge::Continued) => 1,
        _ => 0,
    };
    let (unknowns, points, condition) = (rule.unknowns(), rule.collocation().len(), rule.edge_condition());
    ensure(unknowns > 0, || "no unknowns".into())?;
    ensure(condition.is_none_or(|row| row.len() == unknowns), || "edge_condition() is no row of the unknowns".into())?;
    let equations = points + usize::from(condition.is_some());
    ensure(unknowns.checked_add_signed(excess) == Some(equations), || {
        format!("{equations} equations for {unknowns} unknowns, not {excess} more")
    })?;
    let Some(scale) = rule.row_scale() else { return Ok(()) };
    ensure(scale.len() == points, || "row_scale() has not one factor for each point".into())?;
    ensure(scale.iter().all(|factor| factor.is_finite() && *factor != 0.0), || {
        "row_scale() has factors that are 0 or no number".into()
    })
}

/// A fault unless something holds.
pub(crate) fn ensure(holds: bool, fault: impl FnOnce() -> String) -> Result<(), String> {
    if holds { Ok(()) } else { Err(fault()) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lengths as told, and kinks.
    #[derive(Debug)]
    struct Told {
        natural_length: f64,
        fixed_half_width: Option<f64>,
        kinks: &'static [f64],
    }

    impl PunchShape for Told {
        fn height(&self, _x: f64) -> f64 {
            0.0
        }
        fn slope(&self, _x: f64) -> f64 {
            0.0
        }
        fn natural_length(&self) -> f64 {
            self.natural_length
        }
        fn fixed_half_width(&self) -> Option<f64> {
            self.fixed_half_width
        }
        fn kinks(&self) -> &[f64] {
            self.kinks
        }
    }

    #[test]
    fn lengths_and_kinks_are_numbers_that_can_be_walked_along() {
        let told = |natural_length, fixed_half_width, kinks| shape(&Told { natural_length, fixed_half_width, kinks });
        assert_eq!(told(1.0, None, &[0.0, 0.5, 2.0]), Ok(()));
        for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(told(bad, None, &[]).unwrap_err().contains("natural_length()"), "{bad}");
            assert!(told(1.0, Some(bad), &[]).unwrap_err().contains("fixed_half_width()"), "{bad}");
        }
        for bad in [&[0.7, 0.3][..], &[0.5, 0.5], &[f64::NAN], &[-0.5], &[f64::INFINITY]] {
            assert!(told(1.0, None, bad).unwrap_err().contains("do not ascend from 0"), "{bad:?}");
        }
    }
}
