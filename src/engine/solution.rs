//! The result of a scene (docs: `docs/formats.md`). Lengths, stresses and forces in the scene's units.

pub(crate) mod finite;
pub(crate) mod loading_curve;

#[cfg(feature = "plot")]
use crate::engine::friction::stick_zone::StickZone;
use crate::plan::Plan;
use crate::scene::{Load, LoadKind, Scene, Units};
use loading_curve::Curve;
use serde::{Deserialize, Serialize};
use slipzone_api::{Base, Friction, FrozenStrain, exactly};
use std::borrow::Cow;
use std::collections::BTreeMap;

/// How a solve ended.
// The order matters: a loading curve takes the largest status of its loads, the gravest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// Every number is within the error stated.
    Converged,
    /// The best numbers found; their error estimate exceeds the tolerance.
    NotConverged,
    /// The numbers solve the equations, but a condition that the model rests on fails.
    AssumptionViolated,
    /// No numbers: the method or the combination is out of reach.
    Refused,
}

impl Status {
    /// The status and the reason of the same, of which something that was asked for is missing.
    fn lacking(self, reason: Option<String>, why: &str) -> (Self, String) {
        let status = if self == Self::Converged { Self::NotConverged } else { self };
        (status, reason.map_or_else(|| why.to_owned(), |reason| format!("{reason}; {why}")))
    }
}

/// A solved scene. The keys of its JSON are stable: added to, never renamed.
#[derive(Clone, Debug, Serialize)]
pub struct Solution {
    /// Version of the result format; 1.
    pub format: u32,
    /// What solved it.
    pub program: Program,
    /// The scene as solved, defaults filled in.
    pub scene: Scene,
    /// Labels of the units.
    pub units: Units,
    /// How it ended.
    pub status: Status,
    /// What failed, where, and what to do; `None` when converged.
    pub reason: Option<String>,
    /// Force, contact size, indentation.
    pub load: LoadReport,
    /// Pressure at a few points.
    pub pressure: PressureReport,
    /// Stress intensity at the contact's edge.
    pub edge: EdgeReport,
    /// The stick zone; `None` without friction.
    pub stick: Option<StickReport>,
    /// How sure the numbers are.
    pub error: ErrorReport,
    /// How they were got.
    pub plan: Plan,
    /// Tractions along the contact.
    pub profile: Profile,
    /// The contact on the way to its last load, where the scene asks for it and the last load is solved.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<Curve>,
    /// What the model takes for granted.
    pub assumptions: Vec<Cow<'static, str>>,
}

/// Name and version of the program.
#[derive(Clone, Debug, Serialize)]
pub struct Program {
    /// `slipzone`.
    pub name: &'static str,
    /// Its version.
    pub version: &'static str,
}

/// Load and what it does.
#[derive(Clone, Debug, Default, Serialize)]
pub struct LoadReport {
    /// Normal force per unit length.
    pub force: Option<f64>,
    /// Half-width of the contact.
    pub half_width: Option<f64>,
    /// Depth of the punch; `None` on a half-plane without a datum, where it is undefined.
    pub indentation: Option<f64>,
}

/// Pressure at a few points.
#[derive(Clone, Debug, Default, Serialize)]
pub struct PressureReport {
    /// At `x = 0`.
    pub centre: Option<f64>,
    /// Force over contact width.
    pub mean: Option<f64>,
    /// The largest; `None` where it is unbounded.
    pub peak: Option<f64>,
}

/// The edge of the contact.
#[derive(Clone, Debug, Default, Serialize)]
pub struct EdgeReport {
    /// `lim sqrt(2 (b - x)) p(x)`; 0 at a smooth edge.
    pub stress_intensity: Option<f64>,
    /// `stress_intensity sqrt(b)/P`, the `F_I/F_0` of CC13 Table 1.
    pub ratio: Option<f64>,
}

/// Direction in which the surface slides beside the stick zone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Slip {
    /// Towards the middle: `q = +eta p` for `x > a`.
    Inward,
    /// Away from the middle: `q = -eta p` for `x > a`.
    Outward,
}

/// The stick zone.
#[derive(Clone, Debug, Serialize)]
pub struct StickReport {
    /// `a`.
    pub half_width: Option<f64>,
    /// `a/b`.
    pub ratio: Option<f64>,
    /// `1 - a/b`, without cancellation.
    pub one_minus_ratio: Option<f64>,
    /// Direction of slip.
    pub slip: Option<Slip>,
    /// `C`, where the strain in the stick zone is taken to be `C|x|`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strain_rate: Option<f64>,
}

/// Error estimates, relative.
#[derive(Clone, Debug, Default, Serialize)]
pub struct ErrorReport {
    /// The largest of `each`; `None` when refused.
    pub estimate: Option<f64>,
    /// One estimate for each number reported, by its path, such as `edge.ratio`.
    pub each: BTreeMap<&'static str, f64>,
    /// How they were got, in words.
    pub how: String,
}

/// Tractions along the contact, equally spaced unless the scene lists its own points.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Profile {
    /// Abscissae.
    pub x: Vec<f64>,
    /// Pressure; `None` where it is unbounded.
    pub pressure: Vec<Option<f64>>,
    /// Shear traction on the surface along +x; absent without friction.
    pub shear: Option<Vec<Option<f64>>>,
    /// Strain `du/dx` left on the surface in the stick zone, where the scene asks for it; `None` outside of that zone.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub strain: Option<Vec<Option<f64>>>,
}

impl Profile {
    /// Whether each of its numbers is finite.
    pub(super) fn is_finite(&self) -> bool {
        // All of them, there is hardly ever one to stop at: `0 x` is 0 where `x` is finite, and NaN elsewhere.
        let rest = |sum: f64, x: f64| sum + 0.0 * x;
        let columns = [Some(&self.pressure), self.shear.as_ref(), self.strain.as_ref()].into_iter().flatten();
        let of_column = |sum: f64, column: &Vec<Option<f64>>| column.iter().map(|x| x.unwrap_or(0.0)).fold(sum, rest);
        let of_places = self.x.iter().copied().fold(0.0, rest);
        columns.fold(of_places, of_column) == 0.0
    }
}

impl StickReport {
    /// `1 - a/b` where that tells the zone's width better than `a/b`, which is nearly 1 there.
    #[cfg(feature = "plot")]
    pub(crate) fn rest_that_tells(&self) -> Option<f64> {
        self.one_minus_ratio.filter(|rest| *rest < StickZone::NEAR)
    }
}

impl LoadReport {
    /// What the scene says of it.
    pub(super) fn given(load: Load) -> Self {
        let of = |kind| (load.kind() == kind).then_some(load.value().get());
        let [force, half_width, indentation] = [LoadKind::Force, LoadKind::HalfWidth, LoadKind::Indentation].map(of);
        Self { force, half_width, indentation }
    }
}

impl Solution {
    /// A number by its path in the result, one of [`Asked::NUMBERS`](crate::scene::Asked::NUMBERS) such as
    /// `stick.ratio`; `None` where it does not exist or was not asked for.
    pub fn number(&self, path: &str) -> Option<f64> {
        let stick = self.stick.as_ref();
        match path {
            "load.force" => self.load.force,
            "load.half_width" => self.load.half_width,
            "load.indentation" => self.load.indentation,
            "pressure.centre" => self.pressure.centre,
            "pressure.mean" => self.pressure.mean,
            "pressure.peak" => self.pressure.peak,
            "edge.stress_intensity" => self.edge.stress_intensity,
            "edge.ratio" => self.edge.ratio,
            "stick.half_width" => stick?.half_width,
            "stick.ratio" => stick?.ratio,
            "stick.one_minus_ratio" => stick?.one_minus_ratio,
            "stick.strain_rate" => stick?.strain_rate,
            _ => None,
        }
    }

    /// The same, of which something that was asked for is missing.
    pub(crate) fn lacking(self, why: &str) -> Self {
        let (status, reason) = self.status.lacking(self.reason, why);
        Self { status, reason: Some(reason), ..self }
    }

    /// A solution without numbers: everything that the scene alone tells, and the reason. Of the samples that the scene
    /// lists those that are no numbers are left out: no report could hold them.
    pub(crate) fn refused(scene: &Scene, plan: Plan, reason: String) -> Self {
        let mut scene = scene.clone();
        if let Some(x) = &mut scene.output.x {
            x.retain(|x| x.is_finite());
        }
        Self {
            format: 1,
            program: Program { name: env!("CARGO_PKG_NAME"), version: env!("CARGO_PKG_VERSION") },
            units: scene.units.clone(),
            status: Status::Refused,
            reason: Some(reason),
            load: LoadReport::default(),
            pressure: PressureReport::default(),
            edge: EdgeReport::default(),
            stick: None,
            error: ErrorReport::default(),
            plan,
            profile: Profile::default(),
            path: None,
            assumptions: assumptions(&scene),
            scene,
        }
    }
}

/// What the numbers rest on.
fn assumptions(scene: &Scene) -> Vec<Cow<'static, str>> {
    let base = match scene.layer.base {
        Base::Rigid => "bonded to a rigid base",
        Base::Frictionless => "resting on a rigid base without friction",
        Base::HalfPlane { .. } => "bonded to an elastic half-plane",
        Base::Infinite => "no base: the solid goes on for ever",
    };
    let depths = match scene.layer.datum {
        Some(datum) => {
            format!("indentation counted from depth {} below the middle of the contact", exactly(datum.get())).into()
        }
        None if scene.layer.has_depths() => Cow::Borrowed(""),
        None => "the indentation is undefined on an elastic half-plane: no `layer.datum` is named".into(),
    };
    let friction = match scene.friction {
        Some(Friction::Goodman { .. }) if scene.friction_needed().is_none() => {
            "Goodman: q does not change p; the shear is not asked for"
        }
        Some(Friction::Goodman { strain: FrozenStrain::Linear, .. }) => {
            "Goodman: q does not change p; one stick zone, slip in one direction on either side; strain C|x| in the stick \
             zone (CC13 eq. 63), whatever the history"
        }
        Some(Friction::Goodman { strain: FrozenStrain::History, .. }) => {
            "Goodman: q does not change p; one stick zone, slip in one direction on either side; force grown from zero"
        }
        None => "no friction",
    };
    let common = "linear elasticity, small strains, rigid punch, symmetric normal load";
    let parts = [scene.layer.plane.words().into(), base.into(), depths, friction.into(), common.into()];
    parts.into_iter().filter(|part| !part.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use crate::report::samples;
    use crate::scene::Asked;

    /// Each path leads to its own number: to what the JSON of the result has there.
    #[test]
    fn numbers_are_found_by_their_paths() {
        let mut solution = samples::flat_with_friction();
        if let Some(stick) = &mut solution.stick {
            stick.strain_rate = Some(0.25);
        }
        let json = serde_json::to_value(&solution).unwrap();
        for path in Asked::NUMBERS {
            let pointer = format!("/{}", path.replace('.', "/"));
            assert_eq!(solution.number(path), json.pointer(&pointer).unwrap().as_f64(), "{path}");
        }
        assert_eq!(solution.number("edge.radius"), None);
    }
}
