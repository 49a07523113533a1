//! What a layer is and how its surface answers, sampled: for those who look at it before solving anything.

use crate::engine::foreign;
use crate::plan;
use crate::scene::{Layer, Scene};
use slipzone_api::{Base, LayerModel, LayerResponse, Refusal, Stretch, SurfaceFlexibility, contract};
use std::sync::Arc;

/// How the surface of a scene's layer answers, by the flexibility that would solve it; wave numbers in units of
/// `1/`[`length`](crate::scene::Layer::length).
///
/// # Errors
/// The method's refusal, or the grading's.
pub fn response(scene: &Scene) -> Result<Box<dyn LayerResponse>, Refusal> {
    foreign::response(&*plan::choose(scene).methods.flexibility, &Arc::new(scene.layer.model()?))
}

/// Scaled flexibilities of a surface over wave numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct FlexibilityProfile {
    /// Wave numbers `s`, ascending, in units of `1/`[`length`](crate::scene::Layer::length).
    pub wave_numbers: Vec<f64>,
    /// `s F/A0` at each of them.
    pub flexibilities: Vec<SurfaceFlexibility>,
    /// `beta` of the surface: `-s Fuv/A0` tends to it.
    pub beta: f64,
}

impl FlexibilityProfile {
    /// From waves that see the base alone to waves that do not see it.
    pub fn new(response: &dyn LayerResponse) -> Result<Self, Refusal> {
        /// Wave numbers: smooth curves, some milliseconds of work.
        const SAMPLES: u32 = 160;
        /// The shortest, at the least, and where what is below a break is felt by `exp(-2 s d)`; the shortest at the
        /// most.
        const LEAST: f64 = 60.0;
        const FADED: f64 = 20.0;
        const MOST: f64 = 1e6;
        let first_break = response.depth().filter(|_| response.breaks());
        let shortest = first_break.map_or(LEAST, |depth| (FADED / depth).clamp(LEAST, MOST));
        let longest = 0.01_f64;
        let wave_numbers: Vec<f64> =
            (0..=SAMPLES).map(|i| longest * (shortest / longest).powf(f64::from(i) / f64::from(SAMPLES))).collect();
        let mut flexibilities = vec![SurfaceFlexibility::default(); wave_numbers.len()];
        response.surface_into(&wave_numbers, &mut flexibilities)?;
        contract::numbers(&wave_numbers, &flexibilities)?;
        Ok(Self { wave_numbers, flexibilities, beta: response.elastic().beta() })
    }
}

/// Elastic constants over depth, in the scene's units.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DepthProfile {
    /// Depths, ascending; the same one twice where a modulus may jump.
    pub depth: Vec<f64>,
    /// What the scene calls a modulus, at each of them.
    pub modulus: Vec<f64>,
    /// Poisson's ratio at each of them.
    pub poisson: Vec<f64>,
    /// Depths within the layer at which the law has a kink or a jump, or a sublayer ends; ascending.
    pub interfaces: Vec<f64>,
    /// Number of sublayers of a stack, and of the stacks in it; 1 of any other law.
    pub sublayers: usize,
    /// Modulus and Poisson's ratio of the half-plane below, where there is one.
    pub substrate: Option<(f64, f64)>,
}

impl DepthProfile {
    /// `None` for a homogeneous solid without a base, which has no depth to draw; the exponential one is shown over a
    /// few of its lengths.
    pub fn new(layer: &Layer) -> Result<Option<Self>, Refusal> {
        /// Lengths over which an infinite solid is shown.
        const SHOWN: f64 = 2.0;
        let Some(length) = layer.length()? else { return Ok(None) };
        let end = if layer.base == Base::Infinite { SHOWN } else { 1.0 };
        Ok(Some(Self::of(&layer.model()?, length, end)))
    }

    /// Down to the depth `end`, in units of `length`.
    fn of(model: &LayerModel, length: f64, end: f64) -> Self {
        /// Samples of the whole, and most of them in one stretch.
        const SAMPLES: usize = 1024;
        const MOST: usize = 256;
        let mut stretches = model.law.stretches();
        if let Some(last) = stretches.last_mut() {
            last.to *= end;
        }
        let sublayers = stretches.iter().filter(|stretch| stretch.from == 0.0).count();
        let mut profile = Self { sublayers, substrate: substrate(model), ..Self::default() };
        let count = (SAMPLES / stretches.len()).clamp(2, MOST);
        for (index, stretch) in stretches.iter().enumerate() {
            if index > 0 && !stretch.is_continued {
                profile.interfaces.push(length * stretch.in_whole(stretch.from));
            }
            profile.sample(stretch, model, length, end, count);
        }
        profile
    }

    fn sample(&mut self, stretch: &Stretch, model: &LayerModel, length: f64, end: f64, count: usize) {
        /// Distance from a jump at which the value is that of this side, of the stretch's own length.
        const BESIDE: f64 = 1e-9;
        let span = stretch.to - stretch.from;
        // The ends of a law belong to it; those of a stretch within it may belong to the next.
        let inside = |depth: f64| [0.0, 1.0, end].contains(&depth);
        for i in 0..=count {
            // Denser at the ends, where laws such as roots of the depth are steep.
            let part = 0.5 - 0.5 * (std::f64::consts::PI * i as f64 / count as f64).cos();
            let depth = if i == count { stretch.to } else { stretch.from + span * part };
            let looked = if inside(depth) {
                depth
            } else {
                depth.clamp(stretch.from + BESIDE * span, stretch.to - BESIDE * span)
            };
            self.depth.push(length * stretch.in_whole(depth));
            self.modulus.push(stretch.law.modulus(looked));
            self.poisson.push(model.solid.poisson_at(stretch.law, looked));
        }
    }

    /// Number of parts without kinks or jumps.
    pub fn stretches(&self) -> usize {
        self.interfaces.len() + 1
    }

    /// Least and largest modulus.
    pub fn modulus_range(&self) -> (f64, f64) {
        range(&self.modulus)
    }

    /// Least and largest Poisson's ratio.
    pub fn poisson_range(&self) -> (f64, f64) {
        range(&self.poisson)
    }
}

/// The half-plane below, in the kind of modulus that the scene speaks of.
fn substrate(model: &LayerModel) -> Option<(f64, f64)> {
    let Base::HalfPlane { shear, poisson } = model.base else { return None };
    Some((model.solid.moduli.of_shear(shear.get(), poisson.get()), poisson.get()))
}

fn range(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), value| (least.min(*value), most.max(*value)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use slipzone_api::{Moduli, ModulusLaw, Plane, Poisson, Positive, Solid, Sublayer};

    /// Steps from 1 to 2 half way down, by a jump of its own.
    #[derive(Debug)]
    struct Step;

    impl ModulusLaw for Step {
        fn modulus(&self, depth: f64) -> f64 {
            if depth < 0.5 { 1.0 } else { 2.0 }
        }

        fn poisson(&self, depth: f64) -> Option<f64> {
            Some(0.2 + 0.1 * depth)
        }

        fn breakpoints(&self) -> &[f64] {
            &[0.5]
        }
    }

    /// Two sublayers of that law.
    #[derive(Debug)]
    struct Twice(Vec<Sublayer>);

    impl ModulusLaw for Twice {
        fn modulus(&self, _: f64) -> f64 {
            unreachable!("a stack is asked sublayer by sublayer")
        }

        fn surface_modulus(&self) -> f64 {
            1.0
        }

        fn sublayers(&self) -> &[Sublayer] {
            &self.0
        }
    }

    fn profile(law: Box<dyn ModulusLaw>) -> DepthProfile {
        let solid = Solid { plane: Plane::Strain, poisson: Poisson::new(0.3).unwrap(), moduli: Moduli::Young };
        let base = Base::HalfPlane { shear: Positive::new(3.0).unwrap(), poisson: Poisson::new(0.25).unwrap() };
        DepthProfile::of(&LayerModel::new(law, solid, base), 8.0, 1.0)
    }

    #[test]
    fn jumps_are_kept_sharp() {
        let found = profile(Box::new(Step));
        assert_eq!((found.interfaces.as_slice(), found.sublayers, found.stretches()), (&[4.0][..], 1, 2));
        let points = found.depth.iter().zip(&found.modulus);
        let at_jump: Vec<_> = points.filter(|(y, _)| (**y - 4.0).abs() < 1e-12).map(|(_, modulus)| *modulus).collect();
        assert_eq!(at_jump, [1.0, 2.0]);
        assert_eq!((found.depth.first(), found.depth.last()), (Some(&0.0), Some(&8.0)));
        assert!(found.depth.is_sorted());
        assert_eq!(found.modulus_range(), (1.0, 2.0));
        assert_eq!(found.poisson_range(), (0.2, 0.2 + 0.1));
        assert_eq!(found.substrate, Some((7.5, 0.25)), "Young's modulus 2 mu (1 + nu)");
    }

    #[test]
    fn sublayers_are_shown_each_over_its_own_depth() {
        let part = |thickness| Sublayer { thickness, law: Box::new(Step) };
        let found = profile(Box::new(Twice(vec![part(0.25), part(0.75)])));
        assert_eq!((found.interfaces.as_slice(), found.sublayers), (&[1.0, 2.0, 5.0][..], 2));
        assert!(found.depth.is_sorted());
    }
}
