//! The testkit is checked by breaking plugins: every fault it claims to find is committed here once.

use super::check_plugin;
use crate::{Family, Flaw, Grading, ModulusLaw, PunchProfile, PunchShape, Refusal, Sublayer, find, plugins, register};
use serde::{Deserialize, Serialize};

fn verdict(family: Family, name: &str) -> Result<(), String> {
    check_plugin(find(family, name).expect("registered below"))
}

#[track_caller]
fn caught(family: Family, name: &str, fault: &str) {
    let found = verdict(family, name).expect_err("this plugin is broken");
    assert!(found.contains(fault), "`{name}`: expected a fault about `{fault}`, got `{found}`");
}

/// `g = curvature x^2/2`, with a slope that may be wrong.
#[derive(Debug)]
struct Parabola {
    curvature: f64,
    slope_error: f64,
    tilt: f64,
}

impl PunchShape for Parabola {
    fn height(&self, x: f64) -> f64 {
        0.5 * self.curvature * x * x + self.tilt * x
    }
    fn slope(&self, x: f64) -> f64 {
        self.curvature * x * (1.0 + self.slope_error) + self.tilt
    }
    fn natural_length(&self) -> f64 {
        1.0
    }
    fn flaw(&self, _half_width: f64) -> Option<Flaw> {
        None
    }
}

/// A punch plugin around [`Parabola`], faulty as its attributes and its registration make it.
macro_rules! punch {
    ($name:ident, $tag:literal, $(#[$attribute:meta])* { $($(#[$field:meta])* $key:ident),* }, $shape:expr) => {
        #[derive(Clone, Debug, Serialize, Deserialize)]
        $(#[$attribute])*
        struct $name { $($(#[$field])* $key: f64),* }

        #[typetag::serde(name = $tag)]
        impl PunchProfile for $name {
            fn shape(&self) -> Result<Box<dyn PunchShape>, Refusal> {
                let make: fn(&Self) -> Parabola = $shape;
                Ok(Box::new(make(self)))
            }
        }
    };
}

fn good(curvature: f64) -> Parabola {
    Parabola { curvature, slope_error: 0.0, tilt: 0.0 }
}

punch!(
    Fine,
    "fine",
    #[serde(deny_unknown_fields)]
    {
        curvature
    },
    |p| good(p.curvature)
);
register!(Punch, "fine", "conforms", example: "type = \"fine\"\ncurvature = 2.0",
    parameters: [("curvature", "1/radius", true, [1.0, 2.5])], source: "none");

#[test]
fn a_conforming_plugin_passes() {
    assert_eq!(verdict(Family::Punch, "fine"), Ok(()));
}

punch!(Lax, "lax", { curvature }, |p| good(p.curvature));
register!(Punch, "lax", "takes any key", example: "type = \"lax\"\ncurvature = 2.0",
    parameters: [("curvature", "1/radius", true, [1.0])], source: "none");

#[test]
fn unknown_keys_must_be_refused() {
    caught(Family::Punch, "lax", "unknown key passes");
}

punch!(
    Renamed,
    "tag-in-use",
    #[serde(deny_unknown_fields)]
    {
        curvature
    },
    |p| good(p.curvature)
);
register!(Punch, "renamed", "its tag is another", example: "type = \"renamed\"\ncurvature = 2.0",
    parameters: [("curvature", "1/radius", true, [1.0])], source: "none");
register!(Punch, "borrowed", "its example is another", example: "type = \"tag-in-use\"\ncurvature = 2.0",
    parameters: [("curvature", "1/radius", true, [1.0])], source: "none");

#[test]
fn tag_and_name_must_agree() {
    caught(Family::Punch, "renamed", "its example fails: unknown variant `renamed`");
    caught(Family::Punch, "borrowed", "its example is a `tag-in-use`");
}

register!(Punch, "twin", "one", example: "", parameters: [], source: "none");
register!(Punch, "twin", "two", example: "", parameters: [], source: "none");

#[test]
fn names_must_be_unique() {
    caught(Family::Punch, "twin", "2 plugins of this family have this name");
}

punch!(Secret, "secret", #[serde(deny_unknown_fields)] { curvature, #[serde(default)] hidden },
    |p| good(p.curvature + p.hidden));
register!(Punch, "secret", "keeps a key to itself", example: "type = \"secret\"\ncurvature = 2.0",
    parameters: [("curvature", "1/radius", true, [1.0])], source: "none");

#[test]
fn keys_must_be_documented_even_those_with_defaults() {
    caught(Family::Punch, "secret", "key `hidden` is not documented");
}

punch!(
    Promising,
    "promising",
    #[serde(deny_unknown_fields)]
    {
        curvature
    },
    |p| good(p.curvature)
);
register!(Punch, "promising", "documents a key that it has not", example: "type = \"promising\"\ncurvature = 2.0",
    parameters: [("curvature", "1/radius", true, [1.0]), ("width", "not there", false, [1.0])], source: "none");

punch!(
    Vague,
    "vague",
    #[serde(deny_unknown_fields)]
    {
        curvature
    },
    |p| good(p.curvature)
);
register!(Punch, "vague", "documents a key that nobody can try", example: "type = \"vague\"\ncurvature = 2.0",
    parameters: [("curvature", "1/radius", true, [1.0]), ("width", "not there", false, [])], source: "none");

#[test]
fn documented_keys_must_exist() {
    caught(Family::Punch, "promising", "sample width = 1 fails: unknown field `width`");
    caught(Family::Punch, "vague", "key `width` has neither a sample nor a place");
}

punch!(
    Relaxed,
    "relaxed",
    #[serde(deny_unknown_fields)]
    {
        #[serde(default)]
        curvature
    },
    |p| good(p.curvature)
);
register!(Punch, "relaxed", "calls a key required that is not", example: "type = \"relaxed\"\ncurvature = 2.0",
    parameters: [("curvature", "1/radius", true, [1.0])], source: "none");

punch!(
    Strict,
    "strict",
    #[serde(deny_unknown_fields)]
    {
        curvature
    },
    |p| good(p.curvature)
);
register!(Punch, "strict", "calls a key optional that is not", example: "type = \"strict\"\ncurvature = 2.0",
    parameters: [("curvature", "1/radius", false, [1.0])], source: "none");

#[test]
fn required_means_required() {
    caught(Family::Punch, "relaxed", "key `curvature` is not required after all");
    caught(Family::Punch, "strict", "key `curvature` is required after all");
}

punch!(
    Forgetful,
    "forgetful",
    #[serde(deny_unknown_fields)]
    {
        #[serde(default, skip_serializing)]
        curvature
    },
    |p| good(p.curvature)
);
register!(Punch, "forgetful", "does not write its key", example: "type = \"forgetful\"\ncurvature = 2.0",
    parameters: [("curvature", "1/radius", false, [1.0])], source: "none");

#[test]
fn a_config_must_survive_writing_and_reading() {
    caught(Family::Punch, "forgetful", "writing and reading back");
}

punch!(
    Steep,
    "steep",
    #[serde(deny_unknown_fields)]
    {
        curvature
    },
    |p| Parabola { slope_error: 1e-5, ..good(p.curvature) }
);
register!(Punch, "steep", "slope off by 1e-5", example: "type = \"steep\"\ncurvature = 2.0",
    parameters: [("curvature", "1/radius", true, [1.0])], source: "none");

punch!(
    Tilted,
    "tilted",
    #[serde(deny_unknown_fields)]
    {
        curvature
    },
    |p| Parabola { tilt: 1e-3, ..good(p.curvature) }
);
register!(Punch, "tilted", "stands askew", example: "type = \"tilted\"\ncurvature = 2.0",
    parameters: [("curvature", "1/radius", true, [1.0])], source: "none");

punch!(
    Hollow,
    "hollow",
    #[serde(deny_unknown_fields)]
    {
        curvature
    },
    |p| good(-p.curvature)
);
register!(Punch, "hollow", "calls itself convex", example: "type = \"hollow\"\ncurvature = 2.0",
    parameters: [("curvature", "1/radius", true, [1.0])], source: "none");

#[test]
fn a_punch_must_keep_its_contract() {
    caught(Family::Punch, "steep", "but height() rises by");
    caught(Family::Punch, "tilted", "but height(-");
    caught(Family::Punch, "hollow", "the slope falls");
}

/// A parabola that answers the other questions as its fields say.
#[derive(Clone, Debug, Default)]
struct Claims {
    face: f64,
    reach: Option<f64>,
    noise: Option<f64>,
    kinks: Vec<f64>,
    corners: Vec<f64>,
    flaw_at: Option<f64>,
    /// Slope in the middle alone.
    level: f64,
    /// No height beyond.
    ends_at: Option<f64>,
}

impl PunchShape for Claims {
    fn height(&self, x: f64) -> f64 {
        if self.ends_at.is_some_and(|end| x.abs() > end) { f64::NAN } else { 0.5 * x * x }
    }
    fn slope(&self, x: f64) -> f64 {
        if x == 0.0 { self.level } else { x }
    }
    fn natural_length(&self) -> f64 {
        1.0
    }
    fn face(&self) -> f64 {
        self.face
    }
    fn reach(&self) -> Option<f64> {
        self.reach
    }
    fn flaw(&self, _half_width: f64) -> Option<Flaw> {
        self.flaw_at.map(|x| Flaw::new("so it says", x))
    }
    fn kinks(&self) -> &[f64] {
        &self.kinks
    }
    fn corners(&self) -> &[f64] {
        &self.corners
    }
    fn noise(&self) -> Option<f64> {
        self.noise
    }
}

#[test]
fn what_a_shape_claims_must_hold_together() {
    type Change = fn(&mut Claims);
    let fine =
        Claims { reach: Some(1.0), noise: Some(0.0), kinks: vec![0.0, 2.0], corners: vec![2.0], ..Claims::default() };
    assert_eq!(super::contracts::shape(&fine), Ok(()));
    let ready = |change: fn(&mut Claims)| {
        let mut claims = fine.clone();
        change(&mut claims);
        super::contracts::shape(&claims)
    };
    let cases: [(Change, &str); 13] = [
        (|c| c.face = -1.0, "face() = -1"),
        (|c| c.face = f64::NAN, "face() = NaN"),
        (|c| c.face = 0.5, "but height(0.5) = 0.125"),
        (|c| c.reach = Some(0.0), "reach() = 0"),
        (|c| c.reach = Some(0.9), "reach() = 0.9, but natural_length() = 1"),
        (|c| c.noise = Some(-1e-9), "noise() = -0.000000001"),
        (|c| c.kinks = vec![2.0, 0.0], "do not ascend from 0"),
        (|c| c.kinks = vec![-1.0, 2.0], "do not ascend from 0"),
        (|c| c.kinks = (0..65).map(f64::from).collect(), "65 kinks"),
        (|c| c.corners = vec![1.0], "the corner 1 is not among the kinks"),
        (|c| c.flaw_at = Some(1.5), "flaw(1) lies at 1.5"),
        (|c| c.level = 0.1, "slope(0) = 0.1"),
        (|c| c.ends_at = Some(0.72), "height NaN"),
    ];
    for (change, words) in cases {
        let found = ready(change).expect_err(words);
        assert!(found.contains(words), "{words}: {found}");
    }
    let twice: fn(&mut Claims) = |c| c.corners = vec![2.0, 0.0];
    assert!(ready(twice).unwrap_err().contains("corners [2.0, 0.0] do not ascend"));
}

/// `mu = 1 + growth depth`, with something wrong about it.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
enum Fault {
    None,
    Exponent,
    Gradient,
    Surface,
    Curvature,
    NoNumber,
    Power,
    WholePower,
    Breaks,
    Details,
    Probes,
    Incompressible,
    Ratio,
    RatioSeries,
    Exponential,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Ramp {
    growth: f64,
    fault: Fault,
}

#[typetag::serde(name = "ramp")]
impl Grading for Ramp {
    fn law(&self, _setting: &crate::Setting) -> Result<Box<dyn ModulusLaw>, Refusal> {
        Ok(Box::new(self.clone()))
    }
}

impl ModulusLaw for Ramp {
    fn modulus(&self, depth: f64) -> f64 {
        1.0 + self.growth * depth
    }
    fn surface_modulus(&self) -> f64 {
        if matches!(self.fault, Fault::Surface) { 1.1 } else { 1.0 }
    }
    fn exponent(&self) -> Option<f64> {
        match self.fault {
            Fault::Exponent => Some(self.growth),
            Fault::Exponential => Some(0.0),
            _ => None,
        }
    }
    fn poisson(&self, depth: f64) -> Option<f64> {
        match self.fault {
            Fault::Incompressible => Some(0.3 + 0.3 * depth),
            Fault::Ratio | Fault::RatioSeries | Fault::Exponential => Some(0.3 + 0.1 * depth),
            _ => None,
        }
    }
    fn poisson_series(&self, terms: usize) -> Vec<f64> {
        let first = if matches!(self.fault, Fault::Ratio) { 0.31 } else { 0.3 };
        let slope = if matches!(self.fault, Fault::RatioSeries) { 0.2 } else { 0.1 };
        [first, slope].into_iter().take(terms).collect()
    }
    fn surface_series(&self, terms: usize) -> Vec<f64> {
        let slope = if matches!(self.fault, Fault::Gradient) { 1.01 * self.growth } else { self.growth };
        let curvature = match self.fault {
            Fault::Curvature => 1e-3,
            Fault::NoNumber => f64::NAN,
            _ => 0.0,
        };
        [1.0, slope, curvature].into_iter().chain(std::iter::repeat(0.0)).take(terms).collect()
    }
    fn broken_power(&self) -> Option<f64> {
        match self.fault {
            Fault::Power => Some(f64::NAN),
            Fault::WholePower => Some(2.0),
            _ => None,
        }
    }
    fn details(&self) -> &[f64] {
        if matches!(self.fault, Fault::Details) { &[0.5, 0.2] } else { &[] }
    }
    fn probes(&self) -> &[f64] {
        if matches!(self.fault, Fault::Probes) { &[0.5, f64::NAN] } else { &[] }
    }
    fn breakpoints(&self) -> &[f64] {
        if matches!(self.fault, Fault::Breaks) { &[0.5, 0.2] } else { &[] }
    }
}

#[test]
fn a_grading_must_keep_its_contract() {
    let verdict = |growth, fault| super::contracts::grading(Box::new(Ramp { growth, fault }));
    assert_eq!(verdict(0.7, Fault::None), Ok(()));
    for (growth, fault, words) in [
        (-2.0, Fault::None, "modulus(0.5) = 0"),
        (0.7, Fault::Exponent, "exponent() = 0.7"),
        (0.7, Fault::Gradient, "surface_series()"),
        (0.7, Fault::Surface, "surface_modulus() = 1.1"),
        (0.01, Fault::Curvature, "surface_series(6) gives 1.000050025 at depth 0.005, but modulus() is 1.00005"),
        (0.7, Fault::NoNumber, "surface_series(6) is [1.0, 0.7, NaN"),
        (0.7, Fault::Power, "broken_power() = NaN"),
        (0.7, Fault::WholePower, "broken_power() = 2, which is a whole number"),
        (0.7, Fault::Breaks, "breakpoints [0.5, 0.2] do not ascend"),
        (0.7, Fault::Details, "details [0.5, 0.2] do not ascend"),
        (0.7, Fault::Probes, "probes [0.5, NaN] do not ascend"),
        (0.7, Fault::Incompressible, "poisson(0.7) = 0.51"),
        (0.7, Fault::Ratio, "poisson_series() begins with 0.31"),
        (0.7, Fault::RatioSeries, "poisson_series() has the slope 0.2"),
        (0.0, Fault::Exponential, "is not that of the surface"),
    ] {
        let found = verdict(growth, fault).expect_err("this law is broken");
        assert!(found.contains(words), "{fault:?}: {found}");
    }
}

/// A parabola, unsure by so much.
#[derive(Debug)]
struct Doubtful(f64);

impl PunchShape for Doubtful {
    fn height(&self, x: f64) -> f64 {
        0.5 * x * x
    }
    fn slope(&self, x: f64) -> f64 {
        x
    }
    fn natural_length(&self) -> f64 {
        1.0
    }
    fn doubt(&self, _half_width: f64) -> Option<f64> {
        Some(self.0)
    }
}

#[test]
fn a_doubt_is_a_number() {
    assert_eq!(super::contracts::shape(&Doubtful(0.1)), Ok(()));
    for doubt in [-0.1, f64::NAN, f64::INFINITY] {
        let found = super::contracts::shape(&Doubtful(doubt)).expect_err("no doubt");
        assert!(found.contains("doubt(1) = "), "{found}");
    }
}

/// Two ramps on top of each other, with one law said to be both.
#[derive(Debug)]
struct Pile {
    whole: Ramp,
    sublayers: Vec<Sublayer>,
}

impl ModulusLaw for Pile {
    fn modulus(&self, depth: f64) -> f64 {
        self.whole.modulus(depth)
    }
    fn sublayers(&self) -> &[Sublayer] {
        &self.sublayers
    }
}

#[test]
fn sublayers_must_be_the_whole() {
    let level = |fault| Ramp { growth: 0.0, fault };
    let verdict = |whole, thicknesses: [f64; 2], fault| {
        let sublayer = |thickness| Sublayer { thickness, law: Box::new(level(fault)) };
        super::contracts::solid(&Pile { whole, sublayers: thicknesses.map(sublayer).into() })
    };
    assert_eq!(verdict(level(Fault::None), [0.25, 0.75], Fault::None), Ok(()));
    for (verdict, words) in [
        (verdict(level(Fault::None), [0.25, 0.7], Fault::None), "0.95 of the whole"),
        (verdict(level(Fault::None), [0.5, 0.5], Fault::Breaks), "sublayer 1: breakpoints"),
        (verdict(level(Fault::None), [0.5, 0.5], Fault::RatioSeries), "sublayer 1: poisson_series()"),
        (verdict(Ramp { growth: 0.5, fault: Fault::None }, [0.5, 0.5], Fault::None), "but the whole"),
    ] {
        let found = verdict.expect_err("this stack is broken");
        assert!(found.contains(words), "{words}: {found}");
    }
}

#[test]
#[should_panic(expected = "registers no plugin")]
fn an_empty_crate_is_noticed() {
    super::check_crate("no-such-crate");
}

#[test]
#[should_panic(expected = "punch `borrowed`: its example is")]
fn one_broken_plugin_breaks_its_crate() {
    super::check_crate("slipzone-api"); // this file's own; `borrowed` is the first of them by name
}

#[test]
fn listings_are_sorted() {
    assert!(plugins().is_sorted_by_key(|info| (info.family, info.name)));
}
