//! The friction curve sampled, and what it is in between.
//!
//! Under a layer it is told beside that of a half-plane: as long as it rises with that, not too unevenly, no root hides
//! between a few samples, and the quotient of both is a polynomial.

use super::FrictionCurve;
use crate::engine::friction::half_plane_shear::HalfPlaneShear;
use crate::engine::friction::stick_zone::StickZone;
use crate::engine::numerics::root::{self, Near};
use arrayvec::ArrayVec;
use slipzone_api::{Component, Refusal, Station};

/// Where the curve follows its asymptotes, seen from a contact that is narrow beside the layer: the
/// corrections fall like `exp(2 lambda)` below and `lambda exp(-lambda)` above.
const ASYMPTOTIC_BELOW: f64 = -4.0;
const ASYMPTOTIC_ABOVE: f64 = 5.0;
/// A slope that differs from that of the asymptote by less than this, relative, is on it.
const ON_ASYMPTOTE: f64 = 0.03;
/// Step of the scan where the layer is thinner than the contact is wide.
const STEP_ON_THIN: f64 = 1.0;
/// Step where it is thicker. Half of it, where the curve's slope over the half-plane's changes from step to step by
/// more than that factor, or changes sign.
///
/// Of 5,400 random contacts on layers whose kernels are longer than the contact is wide, steps of 3 kept that in 4,300;
/// of these none had a slope of another sign in steps a twelfth as long.
const STEP: f64 = 3.0;
const UNEVEN: f64 = 3.0;
/// Step of the scan's continuation where the asymptote is late.
const STEP_BEYOND: f64 = 2.0;
/// Most samples from which a place in between is told.
const NEIGHBOURS: usize = 4;
/// Position tolerance of a root that is told so, and the step that tells the slope there.
const EXPECTED: f64 = 1e-5;
const BESIDE: f64 = 1e-3;

/// The friction coefficient that belongs to one stick zone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub(super) lambda: f64,
    pub(super) friction: f64,
    /// On a half-plane, over `beta`.
    on_half_plane: f64,
}

impl Sample {
    /// How fast the friction coefficient rises on the way to another stick zone, over the half-plane's.
    fn rise_to(&self, other: &Self) -> f64 {
        (other.friction - self.friction) / (other.on_half_plane - self.on_half_plane)
    }
}

/// The curve sampled, ascending. It depends on neither load nor friction.
#[derive(Clone, Debug, Default)]
pub(crate) struct Samples {
    pub(super) points: Vec<Sample>,
    /// Whether it rises beside the half-plane's all along, and not too unevenly.
    is_even: bool,
    /// Whether the curve is known to follow its asymptote beyond the first sample and the last.
    pub(super) low: bool,
    pub(super) high: bool,
}

impl Samples {
    /// Whether all roots for a friction coefficient are known to be between the first sample and the last.
    pub(super) fn enclose(&self, eta: f64) -> bool {
        let size = |sample: Option<&Sample>| sample.map_or(f64::NAN, |sample| sample.friction.abs());
        self.is_even && size(self.points.first()) < eta && eta < size(self.points.last())
    }
}

/// The root of `eta(lambda) = target` to be expected between a sample and the next, at which the differences have two
/// signs.
pub(super) fn expected(samples: &[Sample], first: usize, target: f64) -> Near {
    let (from, to) = (&samples[first], &samples[first + 1]);
    let start = (first + 1).saturating_sub(NEIGHBOURS / 2).min(samples.len().saturating_sub(NEIGHBOURS));
    let neighbours = &samples[start..samples.len().min(start + NEIGHBOURS)];
    // Over the half-plane's curve `g` it is a polynomial in `g/sqrt(1 + g^2)`.
    let place = |g: f64| g / (1.0 + g * g).sqrt();
    let known: ArrayVec<(f64, f64), NEIGHBOURS> =
        neighbours.iter().map(|one| (place(one.on_half_plane), one.friction / one.on_half_plane)).collect();
    let excess = |lambda: f64| {
        let g = on_half_plane(lambda);
        polynomial(&known, place(g)) * g - target
    };
    let straight = (to.friction - from.friction) / (to.lambda - from.lambda);
    let at = root::between((from.lambda, to.lambda), EXPECTED, excess)
        .unwrap_or(from.lambda + (target - from.friction) / straight);
    Near { at, slope: (excess(at + BESIDE) - excess(at - BESIDE)) / (2.0 * BESIDE), doubt: f64::INFINITY }
}

/// The polynomial through a few points (Lagrange).
fn polynomial(points: &[(f64, f64)], x: f64) -> f64 {
    let share = |i: usize| {
        let others = points[..i].iter().chain(&points[i + 1..]);
        others.map(|(other, _)| (x - other) / (points[i].0 - other)).product::<f64>()
    };
    points.iter().enumerate().map(|(i, (_, y))| share(i) * y).sum()
}

/// The friction coefficient of a stick zone on a half-plane, over `beta`.
fn on_half_plane(lambda: f64) -> f64 {
    HalfPlaneShear::new(StickZone::from_log(lambda, 1.0)).friction(1.0)
}

impl FrictionCurve<'_> {
    /// Samples the curve: up to where it follows its asymptotes on most layers, and where it does not rise evenly on
    /// all.
    pub(crate) fn sample(&mut self) -> Result<Samples, Refusal> {
        let thin = (2.0 * self.normal.half_width / self.layer.length()).max(1.0).ln();
        let top = (ASYMPTOTIC_ABOVE + thin).min(Self::WIDEST);
        let bottom = (ASYMPTOTIC_BELOW - thin).max(Self::NARROWEST_SAMPLED).min(top - 1.0);
        let mut samples = Samples::default();
        let points = &mut samples.points;
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // at most a few dozen
        let count = ((top - bottom) / if thin > 0.0 { STEP_ON_THIN } else { STEP }).ceil() as usize;
        for k in 0..=count {
            points.push(self.sample_at(bottom + (top - bottom) * k as f64 / count as f64)?);
        }
        if thin == 0.0 {
            samples.is_even = rises_evenly(points, (self.strained(), self.beta));
            if samples.is_even {
                return Ok(samples);
            }
            for i in (1..points.len()).rev() {
                let between = self.sample_at(0.5 * (points[i - 1].lambda + points[i].lambda))?;
                points.insert(i, between);
            }
        }
        self.continued(samples)
    }

    /// The same and samples beyond, up to where the curve is seen to follow its asymptotes.
    pub(super) fn continued(&mut self, mut samples: Samples) -> Result<Samples, Refusal> {
        let points = &mut samples.points;
        while !samples.high {
            let [.., before, last] = points[..] else { unreachable!("two samples at least") };
            let expected = self.beta * (last.on_half_plane - before.on_half_plane);
            samples.high = is_close(last.friction - before.friction, expected);
            if samples.high || last.lambda >= Self::WIDEST {
                break;
            }
            points.push(self.sample_at((last.lambda + STEP_BEYOND).min(Self::WIDEST))?);
        }
        let strained = self.strained();
        while !samples.low {
            let [first, next, ..] = points[..] else { unreachable!("two samples at least") };
            let expected = (next.on_half_plane.recip() - first.on_half_plane.recip()) / strained;
            samples.low = is_close(next.friction.recip() - first.friction.recip(), expected);
            if samples.low || first.lambda <= Self::NARROWEST_SAMPLED {
                break;
            }
            points.insert(0, self.sample_at((first.lambda - STEP_BEYOND).max(Self::NARROWEST_SAMPLED))?);
        }
        Ok(samples)
    }

    /// The friction coefficient of one stick zone, beside the half-plane's.
    pub(super) fn sample_at(&mut self, lambda: f64) -> Result<Sample, Refusal> {
        Ok(Sample { lambda, friction: self.at(lambda)?, on_half_plane: on_half_plane(lambda) })
    }

    /// The strain that the pressure causes in the middle, `beta' p(0) = beta p(0) - (1/pi) int p k_uv`, over `p(0)`:
    /// where the stick zone is narrow, `d(1/eta)/d lambda = -2/(pi beta')`.
    pub(super) fn strained(&mut self) -> f64 {
        let middle = Station { x: 0.0, gap: self.normal.half_width };
        let mut coupled = [0.0];
        self.normal.potential_into(self.layer, Component::Coupling, self.shear.coupling(), &[middle], &mut coupled);
        self.beta - coupled[0] / self.normal.at(middle)
    }
}

/// Whether the curve's slope over the half-plane's changes slowly from sample to sample, and to what it is before the
/// first and beyond the last.
fn rises_evenly(points: &[Sample], (before, beyond): (f64, f64)) -> bool {
    let within = points.windows(2).map(|pair| pair[0].rise_to(&pair[1]));
    let rises: Vec<f64> = [before].into_iter().chain(within).chain([beyond]).collect();
    rises.windows(2).all(|pair| (1.0 / UNEVEN..UNEVEN).contains(&(pair[1] / pair[0])))
}

fn is_close(rise: f64, expected: f64) -> bool {
    (rise - expected).abs() <= ON_ASYMPTOTE * expected.abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::engine::friction::stick::Shear;
    use crate::engine::prepared_layer::{PreparedLayer, Wanted};
    use crate::engine::pressure::normal::Normal;
    use crate::engine::problem::Problem;
    use crate::plan;
    use crate::scene::parse;
    use slipzone_api::Edge;

    /// What is done with the friction curve of a flat punch on a layer so many half-widths thick.
    fn on_curve<T>(layer: &str, thickness: f64, work: impl FnOnce(&mut FrictionCurve) -> T) -> T {
        let text = format!(
            "format = 1\nlayer = {{ thickness = {thickness:?}, {layer} }}\npunch = {{ type = \"flat\", half_width = 1.0 }}\n\
             friction = {{ type = \"goodman\", coefficient = 0.1 }}\nload = {{ force = 1.0 }}\n"
        );
        let chosen = plan::choose(&parse("curve.toml", &text).expect("a good scene"));
        let problem = Problem::new(&chosen.scene).expect("a flat punch");
        let mut layer = PreparedLayer::new(&problem, &chosen.methods).expect("a layer");
        let half_width = problem.fixed_half_width().expect("corners");
        let wanted = Wanted { frictional: true, deep: false, accuracy: 1e-8, level: 0 };
        layer.tabulate(half_width, wanted).expect("kernels");
        let quadrature = chosen.methods.quadrature.refined(2);
        let mut normal = Normal::new(quadrature.as_ref(), Edge::Sharp).expect("a rule");
        normal.press_sharp(&layer, &problem, half_width).expect("a pressure");
        let mut shear = Shear::new(quadrature).expect("a rule");
        shear.under(&layer, &mut normal);
        let beta = problem.elastic.beta();
        work(&mut FrictionCurve { layer: &layer, normal: &mut normal, shear: &mut shear, beta, tolerance: 1e-6 })
    }

    const STIFF_BASE: &str = "poisson = 0.3, grading = { type = \"exponential\", surface = 1.0, base = 8.0 }";

    #[test]
    fn four_samples_tell_the_curve_of_a_thick_layer() {
        let soft_base = "poisson = 0.2, grading = { type = \"exponential\", surface = 1.0, base = 0.1 }";
        for (layer, thickness) in [(STIFF_BASE, 5.0), (STIFF_BASE, 20.0), (soft_base, 10.0)] {
            on_curve(layer, thickness, |curve| {
                let samples = curve.sample().expect("samples");
                assert_eq!(samples.points.len(), 4, "{layer}, {thickness} thick");
                for i in 0..3 {
                    let (from, to) = (samples.points[i].lambda, samples.points[i + 1].lambda);
                    for part in [0.1, 0.35, 0.5, 0.8] {
                        let lambda = from + part * (to - from);
                        let expected = expected(&samples.points, i, curve.at(lambda).expect("a shear"));
                        let apart = (expected.at - lambda).abs();
                        // A straight line is off by up to a half.
                        assert!(apart < 0.1, "{apart} at {lambda}: {layer}, {thickness} thick");
                    }
                }
            });
        }
    }

    #[test]
    fn a_curve_that_does_not_rise_evenly_is_sampled_up_to_its_asymptotes() {
        // The slip turns: narrow zones slip outwards, wide ones inwards.
        let turning = "poisson = 0.45, grading = { type = \"homogeneous\", modulus = 1.0 }";
        let [few, many] = [STIFF_BASE, turning].map(|layer| {
            on_curve(layer, 4.0, |curve| {
                let mut samples = curve.sample().expect("samples");
                let (first, last) = (samples.points[0].friction, samples.points[samples.points.len() - 1].friction);
                let within = samples.enclose(0.5 * (first + last));
                samples = curve.continued(samples).expect("samples");
                let ends = (samples.low || samples.points[0].lambda <= FrictionCurve::NARROWEST_SAMPLED, samples.high);
                assert_eq!(ends, (true, true), "{layer}");
                (within, samples.points.len())
            })
        });
        assert!(few.0 && !many.0, "{few:?}, {many:?}");
        assert!(many.1 >= 7, "{many:?}");
    }
}
