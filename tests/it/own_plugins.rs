//! Plugins of others that break their contracts: what comes of them is refused, or says so.

use crate::sketch::Sketch;
use serde::{Deserialize, Serialize};
use slipzone::api::{
    Component, Densities, Edge, Elastic, Flexibility, Grading, KernelRequest, KernelStrategy, KernelTable, LayerModel,
    LayerResponse, ModulusLaw, NoFiles, Parts, PartsMut, PunchProfile, PunchShape, Quadrature, Refusal, Rule, Setting,
    Span, Station, SurfaceFlexibility,
};
use slipzone::engine::{FlexibilityProfile, Solution, Status, solve};
use slipzone::scene::Model;
use slipzone::study::{RecordStatus, Study};
use slipzone_flexibilities::Compliance;
use slipzone_kernels::{Octaves, Split, Truncated};
use slipzone_quadratures::{GaussChebyshev, GradedPanels};
use std::ops::ControlFlow;
use std::sync::Arc;

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

/// `split`, whose tables tell something else of themselves.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct OwnKernel {
    length: Option<f64>,
    nearest: Option<f64>,
    power: Option<f64>,
    error: Option<f64>,
    /// Whether it gives no numbers.
    is_void: bool,
    /// Whether it knows no bound.
    is_silent: bool,
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
        if self.told.is_void {
            out.fill(distances, |_| Parts { smooth: f64::NAN, ..Parts::default() });
        } else {
            self.table.parts_into(component, distances, out);
        }
    }

    fn length(&self) -> f64 {
        self.told.length.unwrap_or(self.table.length())
    }

    fn nearest(&self) -> Option<f64> {
        self.told.nearest
    }

    fn power(&self) -> Option<f64> {
        self.told.power
    }

    fn error(&self) -> Option<f64> {
        if self.told.is_silent { None } else { self.told.error.or(self.table.error()) }
    }

    fn flexibility_evaluations(&self) -> usize {
        self.table.flexibility_evaluations()
    }
}

/// With a distance of 0 down to which kernels vary, or none, `graded-panels` cut pieces without end; a bound that was
/// no number was none.
#[test]
fn tables_that_tell_what_cannot_be_are_refused() {
    let solved = |kernel: OwnKernel| {
        let mut scene = Sketch::flat(5.0, 2.0, 0.3).scene();
        scene.solver.kernel = Some(Box::new(kernel));
        scene.solver.quadrature = Some(Box::new(GradedPanels::default()));
        solve(&scene)
    };
    told(&solved(OwnKernel::default()), Status::Converged, "");
    // One that was no finer agreed with itself, and was believed whatever its error.
    told(
        &solved(OwnKernel { is_silent: true, ..OwnKernel::default() }),
        Status::Refused,
        "own-kernel: this plugin breaks its contract: error() = None, but refined(2) takes",
    );
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let (told_wrong, honest) = (Some(wrong), OwnKernel::default());
        let kernels = [
            ("length", OwnKernel { length: told_wrong, ..honest.clone() }),
            ("nearest", OwnKernel { nearest: told_wrong, ..honest.clone() }),
            ("power", OwnKernel { power: told_wrong, ..honest }),
        ];
        for (name, kernel) in kernels {
            let words = format!("own-kernel: this plugin breaks its contract: {name}() = {wrong}");
            told(&solved(kernel), Status::Refused, &words);
        }
    }
    for error in [f64::NAN, -1.0] {
        let kernel = OwnKernel { error: Some(error), ..OwnKernel::default() };
        told(
            &solved(kernel),
            Status::Refused,
            &format!("own-kernel: this plugin breaks its contract: error() = Some({error:?})"),
        );
    }
}

/// `compliance`, of a layer that it says is of another depth, or with `uv` times a factor: by one that is no number
/// only of the waves between 3 and 3.3.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct OwnFlexibility(Option<f64>, f64);

#[typetag::serde(name = "own-flexibility")]
impl Flexibility for OwnFlexibility {
    fn respond(&self, layer: &Arc<LayerModel>) -> Result<Box<dyn LayerResponse>, Refusal> {
        Ok(Box::new(OwnResponse { told: *self, response: Compliance {}.respond(layer)? }))
    }
}

struct OwnResponse {
    told: OwnFlexibility,
    response: Box<dyn LayerResponse>,
}

impl LayerResponse for OwnResponse {
    fn surface(&self, s: f64) -> Result<SurfaceFlexibility, Refusal> {
        let surface = self.response.surface(s)?;
        let factor = if self.told.1.is_nan() && !(3.0..3.3).contains(&s) { 1.0 } else { self.told.1 };
        let [vv, uu] = [surface.vv, surface.uu].map(|entry| if factor.is_nan() { factor } else { entry });
        Ok(SurfaceFlexibility { vv, uu, uv: factor * surface.uv })
    }

    fn elastic(&self) -> Elastic {
        self.response.elastic()
    }

    fn tail(&self, terms: usize) -> Vec<SurfaceFlexibility> {
        self.response.tail(terms)
    }

    fn depth(&self) -> Option<f64> {
        self.told.0
    }
}

/// They panicked in the kernels, or had no end; a base that nothing felt made a half-plane of the layer.
#[test]
fn depths_that_cannot_be_are_refused() {
    let mut scene = Sketch::flat(5.0, 2.0, 0.3).scene();
    let mut solved = |depth| {
        scene.solver.flexibility = Some(Box::new(OwnFlexibility(depth, 1.0)));
        (solve(&scene), slipzone::engine::response(&scene).err().map(|refusal| refusal.to_string()))
    };
    told(&solved(Some(1.0)).0, Status::Converged, "");
    for depth in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let words = format!("own-flexibility: this plugin breaks its contract: depth() = {depth}");
        let (solution, response) = solved(Some(depth));
        told(&solution, Status::Refused, &words);
        assert!(response.is_some_and(|why| why.contains(&words)));
    }
    told(&solved(None).0, Status::Refused, "depth() = None of a layer whose base is felt");
}

/// `octaves` passed over it, as the larger of an error and no number is the error, and found a depth that was half as
/// large again; the picture of the flexibility wrote `NaN`.
#[test]
fn a_flexibility_that_is_no_number_at_some_waves_is_refused_by_name() {
    let holed = || Box::new(OwnFlexibility(Some(1.0), f64::NAN));
    for kernel in
        [None, Some(Box::new(Octaves::default()) as Box<dyn KernelStrategy>), Some(Box::new(Truncated::default()))]
    {
        let mut scene = Sketch::flat(2.0, 1.0, 0.3).scene();
        scene.solver.flexibility = Some(holed());
        scene.solver.kernel.clone_from(&kernel);
        told(&solve(&scene), Status::Refused, "own-flexibility: this plugin breaks its contract: surface(3.");
        let response = slipzone::engine::response(&scene).expect("a response");
        let why = FlexibilityProfile::new(&*response).unwrap_err().to_string();
        assert!(why.contains("flexibility fails at wave number s = 3."), "{kernel:?}: {why}");
    }
}

/// The indentation was left out without a word, and as a load it was "no half-width".
#[test]
fn a_flexibility_that_knows_no_datum_says_so() {
    let layer = "thickness = 2.0\npoisson = 0.3\ndatum = 3.0\ngrading = { type = \"homogeneous\", modulus = 1.0 }\n\
        base = { type = \"half-plane\", shear = 2.0, poisson = 0.3 }";
    let words =
        "an indentation against a datum by flexibility `own-flexibility` is not implemented yet; take `flexibility";
    let solved = |load: &str| {
        let mut scene = Sketch::on(layer).cylinder().loaded(load).scene();
        scene.solver.flexibility = Some(Box::new(OwnFlexibility(Some(1.0), 1.0)));
        (solve(&scene), slipzone::engine::refusal(&scene).map(|refusal| refusal.to_string()))
    };
    let (solution, known) = solved("half_width = 1.0");
    told(&solution, Status::NotConverged, &format!("the indentation is not known: {words}"));
    assert!(solution.load.force.is_some() && known.is_none());
    let path = solved("until = { half_width = 1.0, points = 2 }").0.path.expect("a loading curve");
    assert_eq!(path.status, Status::NotConverged);
    assert!(path.note.is_some_and(|note| note.contains(words)));
    let (solution, known) = solved("indentation = 0.1");
    told(&solution, Status::Refused, words);
    assert_eq!(known, solution.reason);
}

/// Another punch of the name `two-of-one-name`.
macro_rules! punch_of_that_name {
    ($punch:ident) => {
        #[derive(Clone, Copy, Debug, Serialize, Deserialize)]
        struct $punch {}

        #[typetag::serde(name = "two-of-one-name")]
        impl PunchProfile for $punch {
            fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
                Ok(Box::new(OwnPunch::Honest))
            }
        }
    };
}
punch_of_that_name!(OnePunch);
punch_of_that_name!(OtherPunch);

#[test]
fn two_plugins_of_one_name_are_said_to_be_two() {
    let text = "format = 1\nlayer = { thickness = 1.0, poisson = 0.3, grading = { type = \"homogeneous\", modulus = 1.0 } }\n\
                load = { force = 1.0 }\n[punch]\ntype = \"two-of-one-name\"\n";
    let error = slipzone::scene::parse("two", text).unwrap_err().to_string();
    for words in [
        "two plugins go by the name `two-of-one-name` in this program",
        "  expected: one plugin for each name",
        "two:5:",
    ] {
        assert!(error.contains(words), "{words}: {error}");
    }
}

/// A cylinder that has two radii too many: with one its height panics, which the scene's check looks at, with the other
/// its slope.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Fragile {
    radius: f64,
}

#[typetag::serde(name = "fragile-punch")]
impl PunchProfile for Fragile {
    fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
        Ok(Box::new(*self))
    }
}

impl PunchShape for Fragile {
    fn height(&self, x: f64) -> f64 {
        assert!(!(2.9..3.1).contains(&self.radius), "three is too many");
        x * x / (2.0 * self.radius)
    }

    fn slope(&self, x: f64) -> f64 {
        assert!(!(3.9..4.1).contains(&self.radius), "four is too many");
        x / self.radius
    }

    fn natural_length(&self) -> f64 {
        self.radius
    }
}

/// The scenes of a study are those of a night.
#[test]
fn a_plugin_that_panics_costs_a_study_no_other_scene() {
    let study = "format = 1\n[scene]\nformat = 1\npunch = { type = \"fragile-punch\", radius = 1.0 }\nload = { half_width = 0.5 }\n\
                 layer = { thickness = 1.0, poisson = 0.3, grading = { type = \"homogeneous\", modulus = 1.0 } }\n\
                 [[axes]]\nfield = \"punch.radius\"\nvalues = [1.0, 2.0, 3.0, 4.0, 5.0]\n";
    let study = Study::parse("study", study, &NoFiles).expect("a study");
    let mut records = Vec::new();
    slipzone::study::sweep(&study, &|_| false, |record| {
        records.push(record);
        ControlFlow::Continue(())
    });
    records.sort_by_key(|record| record.index);
    let forces: Vec<_> = records.iter().map(|record| record.number("load.force")).collect();
    let [Some(one), Some(two), None, None, Some(five)] = forces[..] else { panic!("{records:?}") };
    for (radius, force) in [(2.0, two), (5.0, five)] {
        assert!((radius * force / one - 1.0).abs() < 1e-7, "{forces:?}");
    }
    for (record, number) in records[2..].iter().zip(["three", "four"]) {
        assert_eq!(record.status, RecordStatus::Solved(Status::Refused));
        let reason = record.reason.as_deref().unwrap_or_default();
        assert!(reason.contains(&format!("panicked ({number} is too many)")), "{reason}");
    }
}

/// `gauss-chebyshev`, but for one thing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
enum OwnQuadrature {
    /// Never finer.
    Same,
    /// Whose rules have no factor at the edge; refined so often.
    Edgeless(u32),
    /// An equation more than there is room for.
    Crowded,
}

#[typetag::serde(name = "own-quadrature")]
impl Quadrature for OwnQuadrature {
    fn rule(&self, span: &Span) -> Result<Box<dyn Rule>, Refusal> {
        let edge = if *self == Self::Crowded { Edge::Smooth } else { span.edge };
        let span = Span { edge, ..*span };
        match self {
            Self::Edgeless(level) => Ok(Box::new(Edgeless(GaussChebyshev::default().refined(*level).rule(&span)?))),
            Self::Same | Self::Crowded => GaussChebyshev::default().rule(&span),
        }
    }

    fn refined(&self, level: u32) -> Box<dyn Quadrature> {
        Box::new(if matches!(self, Self::Edgeless(_)) { Self::Edgeless(level) } else { *self })
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

/// A rule, but for the factor at the edge, which is no number.
struct Edgeless(Box<dyn Rule>);

impl Rule for Edgeless {
    fn unknowns(&self) -> usize {
        self.0.unknowns()
    }
    fn collocation(&self) -> &[Station] {
        self.0.collocation()
    }
    fn half_width(&self) -> f64 {
        self.0.half_width()
    }
    fn stretch(&mut self, half_width: f64) {
        self.0.stretch(half_width);
    }
    fn edge_condition(&self) -> Option<&[f64]> {
        self.0.edge_condition()
    }
    fn operator_into(&mut self, kernel: Option<(&dyn KernelTable, Component)>, rows: &mut [f64]) {
        self.0.operator_into(kernel, rows);
    }
    fn applied_into(
        &mut self,
        kernel: (&dyn KernelTable, Component),
        rows: &[f64],
        densities: &Densities,
        out: &mut [[f64; 2]],
    ) {
        self.0.applied_into(kernel, rows, densities, out);
    }
    fn resultant_into(&self, row: &mut [f64]) {
        self.0.resultant_into(row);
    }
    fn values_into(&self, unknowns: &[f64], at: &[Station], out: &mut [f64]) {
        self.0.values_into(unknowns, at, out);
    }
    fn edge_factor(&self, _unknowns: &[f64]) -> f64 {
        f64::NAN
    }
    fn sample_potential(&mut self, unknowns: &[f64], kernel: (&dyn KernelTable, Component), samples: &mut Vec<f64>) {
        self.0.sample_potential(unknowns, kernel, samples);
    }
    fn potential_into(
        &mut self,
        samples: &[f64],
        kernel: (&dyn KernelTable, Component),
        targets: &[Station],
        out: &mut [f64],
    ) {
        self.0.potential_into(samples, kernel, targets, out);
    }
}

/// Who gave what is no number was not told: the kernel was too rough, or the scene's numbers too large.
#[test]
fn who_gives_no_number_is_named() {
    let broken =
        |plugin: &str, fault: &str| format!("{plugin}: this plugin breaks its contract: {fault}; tell its author");
    let scene = || Sketch::flat(5.0, 2.0, 0.3).rubbing(0.1).scene();
    let mut flexible = scene();
    flexible.solver.flexibility = Some(Box::new(OwnFlexibility(Some(1.0), f64::NAN)));
    told(&solve(&flexible), Status::Refused, &broken("own-flexibility", "surface(3.1622776601683777) gives NaN"));
    let mut tabulated = scene();
    tabulated.solver.kernel = Some(Box::new(OwnKernel { is_void: true, ..OwnKernel::default() }));
    told(
        &solve(&tabulated),
        Status::Refused,
        "own-kernel: this plugin breaks its contract: parts(Depth, 0.004) gives NaN",
    );
    let mut edgeless = scene();
    edgeless.solver.quadrature = Some(Box::new(OwnQuadrature::Edgeless(0)));
    told(&solve(&edgeless), Status::Refused, &broken("own-quadrature", "edge_factor gives NaN"));
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
