//! Plugins of others that break their contracts: what comes of them is refused, or says so.

use crate::sketch::Sketch;
use serde::{Deserialize, Serialize};
use slipzone::api::{
    Component, Edge, Grading, KernelRequest, KernelStrategy, KernelTable, LayerResponse, ModulusLaw, PartsMut,
    PunchProfile, PunchShape, Quadrature, Refusal, Rule, Setting, Span,
};
use slipzone::engine::{Solution, Status, solve};
use slipzone::scene::Model;
use slipzone_kernels::Split;
use slipzone_quadratures::GaussChebyshev;

/// A cylinder of radius 1, but for one thing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum OwnPunch {
    Honest,
    Wavy,
    Steep,
    Long(f64),
    Kinked,
}

#[typetag::serde(name = "own-punch")]
impl PunchProfile for OwnPunch {
    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
        Ok(Box::new(*self))
    }
}

impl PunchShape for OwnPunch {
    fn height(&self, x: f64) -> f64 {
        let wave = if *self == Self::Wavy { 0.02 * (1.0 - (20.0 * x).cos()) } else { 0.0 };
        0.5 * x * x + wave
    }

    fn slope(&self, x: f64) -> f64 {
        match self {
            Self::Wavy => x + 0.4 * (20.0 * x).sin(),
            Self::Steep => 1.3 * x,
            Self::Honest | Self::Long(_) | Self::Kinked => x,
        }
    }

    fn natural_length(&self) -> f64 {
        if let Self::Long(length) = self { *length } else { 1.0 }
    }

    fn kinks(&self) -> &[f64] {
        if *self == Self::Kinked { &[0.5, 0.5] } else { &[] }
    }
}

/// The answer to a cylinder's scene under another punch.
fn pressed(punch: OwnPunch) -> Solution {
    let mut scene = Sketch::flat(5.0, 2.0, 0.3).cylinder().loaded("force = 1.0").scene();
    scene.punch = Box::new(punch);
    solve(&scene)
}

/// What is said against it.
#[track_caller]
fn told(solution: &Solution, status: Status, words: &str) {
    let reason = solution.reason.clone().unwrap_or_default();
    assert!(solution.status == status && reason.contains(words), "{:?}: {reason}", solution.status);
}

#[test]
fn a_shape_that_promises_nothing_is_looked_over() {
    told(&pressed(OwnPunch::Honest), Status::Converged, "");
    told(&pressed(OwnPunch::Wavy), Status::AssumptionViolated, "the punch is not convex at x = 0.0848");
    told(&pressed(OwnPunch::Steep), Status::AssumptionViolated, "the punch's slope is not that of its height");
}

/// The search for the contact size has nowhere to start from: it went on for ever.
#[test]
fn lengths_that_are_none_are_refused() {
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let words = format!("own-punch: this plugin breaks its contract: natural_length() = {length}");
        told(&pressed(OwnPunch::Long(length)), Status::Refused, &words);
    }
    told(&pressed(OwnPunch::Kinked), Status::Refused, "kinks [0.5, 0.5] do not ascend from 0");
    for length in [f64::MIN_POSITIVE, f64::MAX] {
        told(&pressed(OwnPunch::Long(length)), Status::Converged, "");
    }
}

/// `split`, whose tables tell another length or error.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct OwnKernel {
    length: Option<f64>,
    error: Option<f64>,
}

#[typetag::serde(name = "own-kernel")]
impl KernelStrategy for OwnKernel {
    fn tabulate(&self, response: &dyn LayerResponse, request: &KernelRequest) -> Result<Box<dyn KernelTable>, Refusal> {
        let table = Split::default().tabulate(response, request)?;
        Ok(Box::new(OwnTable { told: self.clone(), table }))
    }

    fn refined(&self, _level: u32) -> Box<dyn KernelStrategy> {
        Box::new(self.clone())
    }

    fn is_pinned(&self) -> bool {
        false
    }
}

struct OwnTable {
    told: OwnKernel,
    table: Box<dyn KernelTable>,
}

impl KernelTable for OwnTable {
    fn parts_into(&self, component: Component, distances: &[f64], out: PartsMut) {
        self.table.parts_into(component, distances, out);
    }

    fn length(&self) -> f64 {
        self.told.length.unwrap_or(self.table.length())
    }

    fn error(&self) -> Option<f64> {
        self.told.error
    }

    fn flexibility_evaluations(&self) -> usize {
        self.table.flexibility_evaluations()
    }
}

#[test]
fn tables_of_no_length_are_refused_and_bounds_that_are_none_prove_nothing() {
    let solved = |length, error| {
        let mut scene = Sketch::flat(5.0, 2.0, 0.3).scene();
        scene.solver.kernel = Some(Box::new(OwnKernel { length, error }));
        solve(&scene)
    };
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        told(
            &solved(Some(length), None),
            Status::Refused,
            &format!("own-kernel: this plugin breaks its contract: length() = {length}"),
        );
    }
    let unproven = solved(None, None);
    told(&unproven, Status::Converged, "");
    for error in [f64::NAN, -1.0] {
        assert_eq!(solved(None, Some(error)).error.estimate, unproven.error.estimate, "{error}");
    }
}

/// `gauss-chebyshev`, but for one thing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum OwnQuadrature {
    /// Never finer.
    Same,
    /// An equation more than there is room for.
    Crowded,
}

#[typetag::serde(name = "own-quadrature")]
impl Quadrature for OwnQuadrature {
    fn rule(&self, span: &Span) -> Result<Box<dyn Rule>, Refusal> {
        let edge = if *self == Self::Crowded { Edge::Smooth } else { span.edge };
        GaussChebyshev::default().rule(&Span { edge, ..*span })
    }

    fn refined(&self, _level: u32) -> Box<dyn Quadrature> {
        Box::new(*self)
    }

    fn is_pinned(&self) -> bool {
        true
    }
}

#[test]
fn rules_of_the_wrong_size_are_refused() {
    let solved = |quadrature| {
        let mut scene = Sketch::flat(5.0, 2.0, 0.3).scene();
        scene.solver.quadrature = Some(Box::new(quadrature));
        solve(&scene)
    };
    told(
        &solved(OwnQuadrature::Same),
        Status::Refused,
        "own-quadrature: this plugin breaks its contract: refined(1) has",
    );
    told(&solved(OwnQuadrature::Crowded), Status::Refused, "not -1 more");
}

/// A modulus that is no number at the surface alone.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct OwnGrading;

#[typetag::serde(name = "own-grading")]
impl Grading for OwnGrading {
    fn law(&self, _setting: &Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        Ok(Box::new(*self))
    }
}

impl ModulusLaw for OwnGrading {
    fn modulus(&self, depth: f64) -> f64 {
        1.0 + depth
    }

    fn surface_modulus(&self) -> f64 {
        f64::NAN
    }
}

/// In code, where no scene was checked: looked for a stand-in of that material, it panicked.
#[test]
fn a_surface_without_a_modulus_is_refused() {
    let mut scene = Sketch::flat(5.0, 2.0, 0.3).scene();
    scene.layer.grading = Box::new(OwnGrading);
    for model in [None, Some(Model::Homogeneous), Some(Model::HalfPlane)] {
        scene.solver.model = model;
        told(&solve(&scene), Status::Refused, "own-grading: this plugin breaks its contract");
    }
}
