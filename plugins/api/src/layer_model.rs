//! The elastic layer as the flexibility plugins see it.

use crate::{Base, Elastic, Flaw, Moduli, ModulusLaw, Plane, Poisson, Stretch, short};

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
        let nu = law.poisson(0.0).unwrap_or(solid.poisson.get());
        let surface_shear = solid.moduli.shear(law.surface_modulus(), nu);
        Self { law, solid, base, datum: None, elastic: Elastic::of(solid.plane, nu), surface_shear }
    }

    /// The constants that a law, the layer's own or one of its sublayers', gives at a depth of its own.
    pub fn material(&self, law: &dyn ModulusLaw, depth: f64) -> Material {
        let Solid { plane, poisson, moduli } = self.solid;
        let nu = law.poisson(depth).unwrap_or(poisson.get());
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

    /// Whether a load's depth has a meaning of its own: what lies far below does not give way. On an elastic half-plane it is
    /// fixed up to a constant only, until a [`Self::datum`] is named.
    pub fn is_grounded(&self) -> bool {
        self.base.is_grounded(|| self.exponent())
    }

    /// The first depth found (in units of the thickness) at which the law gives no elastic solid: a modulus that is not
    /// finite and positive, or a Poisson's ratio out of range.
    pub fn flaw(&self) -> Option<Flaw> {
        self.law.stretches().iter().find_map(flaw)
    }
}

/// Depths at which each stretch of a law is looked at.
const LOOKS: u32 = 64;

/// [`LayerModel::flaw`] of one stretch.
fn flaw(stretch: &Stretch) -> Option<Flaw> {
    let Stretch { law, from, to, .. } = *stretch;
    let within = (1..LOOKS).map(|i| from + (to - from) * f64::from(i) / f64::from(LOOKS));
    // The ends of the whole law belong to it; those of a stretch may belong to the next.
    let surface = Some(0.0).filter(|_| from == 0.0);
    let mut looks = surface.into_iter().chain(within).chain(Some(1.0).filter(|end| to >= *end));
    looks.find_map(|depth| {
        let modulus = law.modulus(depth);
        let what = if modulus > 0.0 && modulus < f64::INFINITY {
            let nu = law.poisson(depth).filter(|nu| Poisson::new(*nu).is_err())?;
            format!("Poisson's ratio is {nu}")
        } else {
            format!("the modulus is {}", short(modulus))
        };
        Some(Flaw { what, x: stretch.in_whole(depth) })
    })
}
