//! The elastic layer as the flexibility plugins see it.

use crate::{Base, Elastic, Moduli, ModulusLaw, Plane, Poisson, Stretch, contract};

/// How a scene's numbers are to be read: what does not vary with depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// Plane strain or plane stress.
    pub plane: Plane,
    /// Poisson's ratio wherever the law names none.
    pub poisson: Poisson,
    /// What the law's moduli are.
    pub moduli: Moduli,
}

impl Solid {
    /// Poisson's ratio of a law at a depth of its own.
    pub fn poisson_at(&self, law: &dyn ModulusLaw, depth: f64) -> f64 {
        law.poisson(depth).unwrap_or(self.poisson.get())
    }
}

/// Elastic constants at one depth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Shear modulus, in units of that at the surface.
    pub shear: f64,
    /// The constants that have no unit.
    pub elastic: Elastic,
}

/// An elastic layer in its own units (see the crate's page).
#[derive(Debug)]
pub struct LayerModel {
    /// Modulus over depth, and Poisson's ratio where it varies.
    pub law: Box<dyn ModulusLaw>,
    /// How its numbers are to be read.
    pub solid: Solid,
    /// What it stands on; a half-plane's modulus in the user's unit of stress.
    pub base: Base,
    /// Depth at which a vertical displacement is called 0, in units of the thickness; `None`: at the base, or nowhere.
    pub datum: Option<f64>,
    /// Elastic constants at the surface.
    pub elastic: Elastic,
    /// Shear modulus at the surface, in the user's unit of stress.
    pub surface_shear: f64,
}

impl LayerModel {
    /// A layer of that law on that base.
    pub fn new(law: Box<dyn ModulusLaw>, solid: Solid, base: Base) -> Self {
        let nu = solid.poisson_at(&*law, 0.0);
        let surface_shear = solid.moduli.shear(law.surface_modulus(), nu);
        Self { law, solid, base, datum: None, elastic: Elastic::of(solid.plane, nu), surface_shear }
    }

    /// The constants that a law, the layer's own or one of its sublayers', gives at a depth of its own.
    pub fn material(&self, law: &dyn ModulusLaw, depth: f64) -> Material {
        let (Solid { plane, moduli, .. }, nu) = (self.solid, self.solid.poisson_at(law, depth));
        Material { shear: moduli.shear(law.modulus(depth), nu) / self.surface_shear, elastic: Elastic::of(plane, nu) }
    }

    /// The law's exponent, where one exponential describes the whole layer.
    pub fn exponent(&self) -> Option<f64> {
        if self.law.sublayers().is_empty() { self.law.exponent() } else { None }
    }

    /// The constants of an elastic half-plane as the base; `None` on other bases.
    pub fn substrate(&self) -> Option<Material> {
        let Base::HalfPlane { shear, poisson } = self.base else { return None };
        Some(Material { shear: shear.get() / self.surface_shear, elastic: Elastic::new(self.solid.plane, poisson) })
    }

    /// Whether a load's depth has a meaning of its own: what lies far below does not give way. On an elastic half-plane
    /// it is fixed up to a constant only, until a [`Self::datum`] is named.
    pub fn is_grounded(&self) -> bool {
        self.base.is_grounded(|| self.exponent())
    }

    /// Why the law gives no elastic solid, if it does not.
    pub fn flaw(&self) -> Option<LawFlaw> {
        // Stretches are taken only from breakpoints that are some.
        let parts = contract::parts(&*self.law).err().map(LawFlaw::Contract);
        parts
            .or_else(|| self.law.stretches().iter().find_map(flaw))
            .or_else(|| contract::values(&*self.law).err().map(LawFlaw::Contract))
    }
}

/// Why a law gives no elastic solid; at the first depth found, in units of the thickness.
#[derive(Clone, Debug, PartialEq)]
pub enum LawFlaw {
    /// It tells of itself what it is not, in words.
    Contract(String),
    /// A modulus that is not finite and positive.
    Modulus {
        /// The modulus, as the law has it.
        modulus: f64,
        /// Where it is that.
        depth: f64,
    },
    /// A Poisson's ratio out of range.
    Poisson {
        /// The ratio.
        ratio: f64,
        /// Where it is that.
        depth: f64,
    },
}

/// Depths at which each stretch of a law is looked at.
const LOOKS: u32 = 64;

/// [`LayerModel::flaw`] of one stretch.
fn flaw(stretch: &Stretch) -> Option<LawFlaw> {
    let Stretch { law, from, to, .. } = *stretch;
    let within = (1..LOOKS).map(|i| from + (to - from) * f64::from(i) / f64::from(LOOKS));
    // The ends of the whole law belong to it; those of a stretch may belong to the next.
    let surface = (from == 0.0).then_some(0.0);
    let mut looks = surface.into_iter().chain(within).chain(Some(1.0).filter(|end| to >= *end));
    looks.find_map(|at| {
        let (modulus, depth) = (law.modulus(at), stretch.in_whole(at));
        if modulus > 0.0 && modulus < f64::INFINITY {
            let ratio = law.poisson(at).filter(|nu| Poisson::new(*nu).is_err())?;
            Some(LawFlaw::Poisson { ratio, depth })
        } else {
            Some(LawFlaw::Modulus { modulus, depth })
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sublayer;

    /// `mu = 8^depth`, and what else it tells.
    #[derive(Debug, Default)]
    struct Told {
        surface: Option<f64>,
        exponent: Option<f64>,
        /// Slope of Poisson's ratio.
        rise: f64,
        breaks: Vec<f64>,
        details: Vec<f64>,
        sublayers: Vec<Sublayer>,
    }

    impl ModulusLaw for Told {
        fn modulus(&self, depth: f64) -> f64 {
            8_f64.powf(depth)
        }
        fn poisson(&self, depth: f64) -> Option<f64> {
            Some(0.2 + self.rise * depth)
        }
        fn surface_modulus(&self) -> f64 {
            self.surface.unwrap_or(1.0)
        }
        fn exponent(&self) -> Option<f64> {
            self.exponent
        }
        fn breakpoints(&self) -> &[f64] {
            &self.breaks
        }
        fn details(&self) -> &[f64] {
            &self.details
        }
        fn sublayers(&self) -> &[Sublayer] {
            &self.sublayers
        }
    }

    fn flaw_of(told: Told) -> Option<LawFlaw> {
        let poisson = Poisson::new(0.3).unwrap();
        let solid = Solid { plane: Plane::Strain, poisson, moduli: Moduli::Shear };
        LayerModel::new(Box::new(told), solid, Base::Rigid).flaw()
    }

    fn stack(parts: &[f64], told: impl Fn() -> Told) -> Told {
        let sublayer = |thickness: &f64| Sublayer { thickness: *thickness, law: Box::new(told()) };
        Told { sublayers: parts.iter().map(sublayer).collect(), ..Told::default() }
    }

    #[test]
    fn a_law_that_tells_what_it_is_not_has_a_flaw() {
        let exponent = Some(8_f64.ln());
        let fine = || Told { exponent, breaks: vec![0.3, 0.5], details: vec![0.0, 0.6], ..Told::default() };
        assert_eq!(flaw_of(fine()), None);
        assert_eq!(flaw_of(stack(&[0.25, 0.75], fine)), None);
        let cases: [(Told, &str); 16] = [
            (Told { surface: Some(2.0), ..fine() }, "surface_modulus() = 2"),
            (Told { surface: Some(f64::NAN), ..fine() }, "surface_modulus() = NaN"),
            (Told { surface: Some(-1.0), ..fine() }, "surface_modulus() = -1"),
            (Told { exponent: Some(0.0), ..fine() }, "exponent() = 0"),
            (Told { exponent: Some(8_f64.ln() * 1.0001), ..fine() }, "is off by"),
            (Told { exponent: Some(f64::NAN), ..fine() }, "exponent() = NaN"),
            (Told { exponent: Some(f64::INFINITY), ..fine() }, "exponent() = inf"),
            (Told { rise: 0.2, ..fine() }, "poisson(0.5)"),
            (Told { breaks: vec![0.5, 0.3], ..fine() }, "do not ascend within (0, 1)"),
            (Told { breaks: vec![0.5, 0.5], ..fine() }, "do not ascend within (0, 1)"),
            (Told { breaks: vec![f64::NAN], ..fine() }, "do not ascend within (0, 1)"),
            (Told { breaks: vec![-1.0], ..fine() }, "do not ascend within (0, 1)"),
            (Told { details: vec![f64::NAN], ..fine() }, "do not lie within [0, 1]"),
            (stack(&[0.25, 0.25], fine), "sublayers are 0.5 of the whole"),
            (stack(&[1.5, -0.5], fine), "sublayers are 1 of the whole"),
            (stack(&[1.0], || Told { breaks: vec![2.0], ..Told::default() }), "sublayer 1: breakpoints [2.0]"),
        ];
        for (told, words) in cases {
            let flaw = flaw_of(told).expect(words);
            assert!(matches!(&flaw, LawFlaw::Contract(what) if what.contains(words)), "{words}: {flaw:?}");
        }
    }
}
