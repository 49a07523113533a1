//! A scene in the layer's own units: lengths in the thickness, stresses in the surface modulus.

mod details;

use crate::engine::accuracy::quantity::{Quantity, Wishes};
use crate::engine::foreign::broken;
use crate::scene::{Load, Scene};
use slipzone_api::{
    Base, Elastic, Flaw, Friction, FrozenStrain, LayerModel, Poisson, PunchShape, Refusal, contract, of_height, short,
};
use std::sync::Arc;

/// A place this near to a corner, relative, is on it: rounding of the units of length.
const CORNER: f64 = 8.0 * f64::EPSILON;
/// A place this near beyond a kink, relative, is told from the kink by so few digits that a slope which goes with that
/// distance feels it.
const CLOSE: f64 = 1e-3;

/// What is above a depth so much softer bends as it does on a soft base. Under wedges and rounded ones on two
/// sublayers, loads led past the first contact where the lower was softer by 33 and more, and now and then by 10.
const SOFT: f64 = 1.0 / 9.0;
/// Parts of a stretch at whose ends it is looked at.
const DEPTHS: u32 = 16;

/// What the engine solves.
pub(crate) struct Problem {
    /// The elastic layer.
    pub(crate) layer: Arc<LayerModel>,
    /// Its constants.
    pub(crate) elastic: Elastic,
    /// The punch, in the scene's units; see [`Self::height`], [`Self::slope`].
    shape: Box<dyn PunchShape>,
    /// The scene's length of one layer unit.
    pub(crate) length: f64,
    /// The scene's stress of one layer unit.
    pub(crate) stress: f64,
    /// The load in layer units.
    pub(crate) load: LoadInLayerUnits,
    /// Coulomb's coefficient; `None` when frictionless.
    pub(crate) friction: Option<f64>,
    /// Whether the strain in the stick zone is taken to be `C|x|`, whatever the contact's history.
    pub(crate) is_linear: bool,
    /// Whether a smooth shape has details that a grid over the whole contact does not resolve, and is stacked as one
    /// with kinks is; `None` where that was not asked yet.
    pub(crate) is_detailed: Option<bool>,
    /// Whether the contact is taken to end before the first kink of the shape, which then is smooth all over it.
    pub(crate) ends_before_kinks: bool,
    /// What is asked for.
    pub(crate) wishes: Wishes,
}

/// The load: force in `mu1 h`, lengths in `h`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum LoadInLayerUnits {
    Force(f64),
    HalfWidth(f64),
    Indentation(f64),
}

impl LoadInLayerUnits {
    /// Scales a load by the scene's length and stress of one layer unit.
    pub(crate) fn new(load: Load, length: f64, stress: f64) -> Self {
        match load {
            Load::Force(force) => Self::Force(force.get() / stress / length),
            Load::HalfWidth(b) => Self::HalfWidth(b.get() / length),
            Load::Indentation(depth) => Self::Indentation(depth.get() / length),
        }
    }

    /// How large it is.
    pub(crate) fn value(self) -> f64 {
        match self {
            Self::Force(value) | Self::HalfWidth(value) | Self::Indentation(value) => value,
        }
    }
}

/// Coulomb's coefficient.
fn coefficient(friction: Friction) -> f64 {
    let Friction::Goodman { coefficient, .. } = friction;
    coefficient.get()
}

impl Problem {
    /// Scales the scene; refuses what no method here can solve.
    pub(crate) fn new(scene: &Scene) -> Result<Self, Refusal> {
        let shape = scene.punch.shape()?;
        contract::shape(&*shape).map_err(|fault| broken(scene.punch.typetag_name(), &fault))?;
        let layer = &scene.layer;
        let model = Arc::new(layer.model()?);
        let stress = model.surface_shear;
        let nu = model.solid.poisson_at(&*model.law, 0.0);
        if !(stress > 0.0 && stress < f64::INFINITY && Poisson::new(nu).is_ok()) {
            return Err(broken(layer.grading.typetag_name(), "no elastic solid at the surface"));
        }
        // An infinite homogeneous solid has no length of its own.
        let length = layer.length()?.unwrap_or_else(|| shape.natural_length());
        let load = LoadInLayerUnits::new(scene.load, length, stress);
        let needed = scene.friction_needed();
        let friction = needed.map(coefficient);
        let is_linear = matches!(needed, Some(Friction::Goodman { strain: FrozenStrain::Linear, .. }));
        if is_linear && (shape.fixed_half_width().is_some() || shape.face() > 0.0 || !shape.kinks().is_empty()) {
            return Err(Refusal::NotBuilt {
                what: "a strain C|x| in the stick zone under a punch that has corners, a face or kinks".into(),
                remedy:
                    "leave out `strain = \"linear\"`: it is there to be compared with, under punches that touch in \
                         one point and are smooth elsewhere"
                        .into(),
            });
        }
        let wishes = Wishes::of(scene);
        // Friction remembers how the contact grew: its stack of flat punches is there anyway.
        let touches_smoothly = shape.face() == 0.0 && shape.kinks().first().is_some_and(|kink| *kink > 0.0);
        let ends_before_kinks = friction.is_none() && touches_smoothly;
        Ok(Self {
            elastic: model.elastic,
            layer: model,
            shape,
            length,
            stress,
            load,
            friction,
            is_linear,
            is_detailed: None,
            ends_before_kinks,
            wishes,
        })
    }

    /// The same layer and friction under another shape, with a unit force.
    pub(crate) fn under(&self, shape: Box<dyn PunchShape>) -> Self {
        Self {
            layer: Arc::clone(&self.layer),
            elastic: self.elastic,
            shape,
            length: self.length,
            stress: self.stress,
            load: LoadInLayerUnits::Force(1.0),
            friction: self.friction,
            is_linear: false,
            is_detailed: None,
            ends_before_kinks: false,
            wishes: self.wishes.of_member(self.wants_depth()),
        }
    }

    /// The same without friction, as far as a flat face of unit force goes.
    pub(crate) fn dry(&self, shape: Box<dyn PunchShape>) -> Self {
        Self { friction: None, ..self.under(shape) }
    }

    /// Whether the contact is solved as a stack of flat punches: where it grows, and remembers how it grew or must not
    /// be taken for smooth.
    pub(crate) fn is_stacked(&self) -> bool {
        self.fixed_half_width().is_none() && (self.friction.is_some() && !self.is_linear || self.is_kinked())
    }

    /// Whether the shape is not analytic all over the contact, or must not be taken for that.
    pub(crate) fn is_kinked(&self) -> bool {
        let has_kinks = self.shape.face() > 0.0 || !self.shape.kinks().is_empty();
        self.is_detailed == Some(true) || has_kinks && !self.ends_before_kinks
    }

    /// Half-width of the face that touches before there is any load, in layer units.
    pub(crate) fn face(&self) -> f64 {
        self.shape.face() / self.length
    }

    /// How wide a contact may be looked for: up to where the shape ends, or is taken to be smooth; in layer units.
    pub(crate) fn reach(&self) -> f64 {
        let kink = self.kinks().next().filter(|_| self.ends_before_kinks);
        let end = self.shape.reach().map_or(f64::INFINITY, |reach| reach / self.length);
        kink.map_or(end, |kink| kink.min(end))
    }

    /// That the heights scatter, under a contact of that half-width by more than a share of the height at its edge, in
    /// words.
    pub(crate) fn scatter(&self, half_width: Option<f64>, share: f64) -> Option<String> {
        let noise = self.shape.noise()?;
        let part = half_width.map(|b| noise / self.shape.height(b * self.length)).filter(|part| *part > share);
        let by = part.map_or(String::new(), |part| format!(", {} at the contact's edge,", of_height("", part)));
        Some(format!("the punch's heights scatter by {noise:.1e} (root mean square){by} around the fitted shape"))
    }

    /// That the shape under a contact of that half-width is unsure by more than a share of its height at the edge, in
    /// words.
    pub(crate) fn unsure(&self, half_width: f64, share: f64) -> Option<String> {
        let doubt = self.shape.doubt(half_width * self.length).filter(|doubt| *doubt > share)?;
        Some(format!(
            "the shape fitted to the punch's heights is uncertain under the contact, by {} at the contact's edge: give more heights \
             there, or leave out those far beyond",
            of_height("up to ", doubt)
        ))
    }

    /// What is to be said of how the shape under a half-width was made of what the scene gives.
    pub(crate) fn remarks_on_shape(&self, half_width: f64) -> Vec<String> {
        self.shape.remarks(half_width * self.length)
    }

    /// Where the shape is not analytic, in layer units.
    pub(crate) fn kinks(&self) -> impl Iterator<Item = f64> {
        self.shape.kinks().iter().map(|kink| kink / self.length)
    }

    /// Where the pressure is unbounded inside the contact, in layer units.
    pub(crate) fn corners(&self) -> impl Iterator<Item = f64> {
        self.shape.corners().iter().map(|corner| corner / self.length)
    }

    /// Whether a place is one of these, but for what rounding makes of it.
    pub(crate) fn is_corner(&self, x: f64) -> bool {
        self.corners().any(|corner| (x - corner).abs() <= CORNER * corner)
    }

    /// [`Self::flaw`] of the contact where the load gives its half-width.
    pub(crate) fn flaw_under_load(&self) -> Option<Flaw> {
        match self.load {
            LoadInLayerUnits::HalfWidth(half_width) => self.flaw(half_width),
            LoadInLayerUnits::Force(_) | LoadInLayerUnits::Indentation(_) => None,
        }
    }

    /// Takes another load.
    pub(crate) fn press(&mut self, load: Load) {
        self.load = LoadInLayerUnits::new(load, self.length, self.stress);
    }

    /// Takes another friction coefficient.
    pub(crate) fn rub(&mut self, friction: Friction) {
        self.friction = Some(coefficient(friction));
    }

    /// Whether the layer stands on something, rigid or not.
    pub(crate) fn has_base(&self) -> bool {
        self.layer.base != Base::Infinite
    }

    /// Whether the layer stands on a half-plane, which gives way.
    pub(crate) fn is_on_half_plane(&self) -> bool {
        matches!(self.layer.base, Base::HalfPlane { .. })
    }

    /// Whether the layer stands on something that gives way more than its surface does.
    pub(crate) fn is_on_soft_base(&self) -> bool {
        matches!(self.layer.base, Base::HalfPlane { shear, .. } if shear.get() < self.layer.surface_shear)
    }

    /// Whether the layer gives way far more at some depth than it does somewhere above: what is stiff there bends.
    pub(crate) fn is_softer_below(&self) -> bool {
        let mut stiffest = 0.0_f64;
        let mut is_soft = |law, depth: f64| {
            let shear = self.layer.material(law, depth).shear;
            stiffest = stiffest.max(shear);
            shear < SOFT * stiffest
        };
        self.layer.law.stretches().iter().any(|stretch| {
            let part = (stretch.to - stretch.from) / f64::from(DEPTHS);
            (0..=DEPTHS).any(|i| is_soft(stretch.law, stretch.from + part * f64::from(i)))
        })
    }

    /// Whether the layer stands on something that does not give way at all.
    pub(crate) fn is_on_rigid_base(&self) -> bool {
        matches!(self.layer.base, Base::Rigid | Base::Frictionless)
    }

    /// Whether the depth of the punch is of any use.
    pub(crate) fn wants_depth(&self) -> bool {
        self.wishes.reports(Quantity::Indentation) || self.is_pressed_by_depth()
    }

    /// Whether the load is a depth.
    pub(crate) fn is_pressed_by_depth(&self) -> bool {
        matches!(self.load, LoadInLayerUnits::Indentation(_))
    }

    /// Whether contacts of several sizes may sink as far: a datum above a base that gives way sinks as well, in the end
    /// by more.
    pub(crate) fn may_sink_as_far_again(&self) -> bool {
        self.is_pressed_by_depth()
            && self.fixed_half_width().is_none()
            && self.layer.datum.is_some()
            && self.is_on_half_plane()
    }

    /// The numbers of the result that the scene itself gives.
    pub(crate) fn given(&self) -> impl Iterator<Item = Quantity> {
        let by_load = match self.load {
            LoadInLayerUnits::Force(_) => Quantity::Force,
            LoadInLayerUnits::HalfWidth(_) => Quantity::HalfWidth,
            LoadInLayerUnits::Indentation(_) => Quantity::Indentation,
        };
        let sharp = self.fixed_half_width().is_some();
        let mean = (sharp && by_load == Quantity::Force).then_some(Quantity::Mean);
        // A smooth edge has no stress intensity, whatever the resolution.
        let edge = [Quantity::StressIntensity, Quantity::EdgeRatio].into_iter().filter(move |_| !sharp);
        [by_load].into_iter().chain(sharp.then_some(Quantity::HalfWidth)).chain(mean).chain(edge)
    }

    /// Whether the scene says how wide the contact is.
    pub(crate) fn has_half_width(&self) -> bool {
        matches!(self.load, LoadInLayerUnits::HalfWidth(_)) || self.fixed_half_width().is_some()
    }

    /// Half-width that the punch's corners fix, in layer units.
    pub(crate) fn fixed_half_width(&self) -> Option<f64> {
        self.shape.fixed_half_width().map(|b| b / self.length)
    }

    /// The same in the scene's unit, as the punch gives it.
    pub(crate) fn width_of_corners(&self) -> Option<f64> {
        self.shape.fixed_half_width()
    }

    /// `g(x)` in layer units.
    pub(crate) fn height(&self, x: f64) -> f64 {
        self.shape.height(x * self.length) / self.length
    }

    /// `g'(x)`.
    pub(crate) fn slope(&self, x: f64) -> f64 {
        self.shape.slope(x * self.length)
    }

    /// `g'` at a place before a kink, even where rounding has it there.
    pub(crate) fn slope_before(&self, kink: f64, x: f64) -> f64 {
        self.slope(x.min(kink * (1.0 - CORNER)))
    }

    /// `g'` so far beyond an end of a piece, which may be a kink. Close to it numbers tell that distance by few digits:
    /// there it is what two of them next to each other make of it.
    pub(crate) fn slope_beyond(&self, lower: f64, distance: f64) -> f64 {
        if distance >= CLOSE * lower {
            return self.slope(lower + distance);
        }
        let is_here = |kink: &&f64| (*kink / self.length).to_bits() == lower.to_bits();
        let kink = self.shape.kinks().iter().find(is_here).copied().unwrap_or(lower * self.length);
        let distance = distance * self.length;
        let first = (kink + distance).next_down().max(kink * (1.0 + CORNER));
        let second = first.next_up();
        let [slope, next] = [first, second].map(|x| self.shape.slope(x));
        let more = (next - slope) * ((distance - (first - kink)) / (second - first));
        if more.is_finite() { slope + more } else { slope }
    }

    /// Whether lengths in layer units are not those of the scene to the last digit.
    pub(crate) fn rounds_lengths(&self) -> bool {
        self.length.to_bits().trailing_zeros() < f64::MANTISSA_DIGITS - 1
    }

    /// A length of the punch, in layer units.
    pub(crate) fn natural_length(&self) -> f64 {
        self.shape.natural_length() / self.length
    }

    /// What is wrong with the shape within a half-width, and where that begins, in the scene's unit.
    pub(crate) fn flaw(&self, half_width: f64) -> Option<Flaw> {
        let widest = half_width * self.length;
        let flaw = self.shape.flaw(widest)?;
        // A place that is none is no place to tell.
        let x = if (0.0..=widest).contains(&flaw.x) { flaw.x } else { widest };
        Some(Flaw { x, ..flaw })
    }

    /// Whether the shape ends there: it has no height, or no slope.
    pub(crate) fn ends_at(&self, flaw: &Flaw) -> bool {
        !(self.shape.height(flaw.x).is_finite() && self.shape.slope(flaw.x).is_finite())
    }

    /// What keeps a contact over a flaw from being one interval that grew with the load, in words.
    pub(crate) fn objection(&self, flaw: &Flaw) -> String {
        let so = if self.ends_at(flaw) {
            "no contact is as wide as that"
        } else if flaw.is_contradiction {
            "what is solved takes one from the height and another from the slope, and they do not belong together"
        } else {
            "the contact may break up or tilt, and what is solved is one that is symmetric about x = 0"
        };
        format!("{} at x = {}: {so}", flaw.what, short(flaw.x))
    }
}
