//! The scene: what is to be solved, checked.

use serde::{Deserialize, Serialize};
use slipzone_api::{
    Base, Flexibility, Friction, Grading, KernelStrategy, Plane, Poisson, Positive, PunchProfile, Quadrature,
};

/// A contact problem, each number of it checked. Lengths, stresses and forces per length in any
/// consistent units.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Version of the file format; 1.
    pub format: u32,
    /// One line that names the scene in reports and figures.
    #[serde(default)]
    pub title: Option<String>,
    /// The elastic solid.
    pub layer: Layer,
    /// The rigid punch.
    pub punch: Box<dyn PunchProfile>,
    /// Friction; frictionless when absent.
    #[serde(default)]
    pub friction: Option<Friction>,
    /// How hard it is pressed.
    pub load: Load,
    /// How it is solved.
    #[serde(default)]
    pub solver: Solver,
    /// What is written.
    #[serde(default)]
    pub output: Output,
    /// Labels of the units.
    #[serde(default)]
    pub units: Units,
}

/// The elastic solid.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Layer {
    /// Thickness `h`; absent on an infinite solid.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thickness: Option<Positive>,
    /// Poisson's ratio.
    pub poisson: Poisson,
    /// Plane strain or plane stress.
    #[serde(default)]
    pub plane: Plane,
    /// What the layer stands on.
    #[serde(default)]
    pub base: Base,
    /// Shear modulus over depth.
    pub grading: Box<dyn Grading>,
}

/// The load: exactly one of three.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Load {
    /// Force per unit length out of plane.
    Force(Positive),
    /// Half-width of the contact, for a punch whose contact grows.
    HalfWidth(Positive),
    /// Depth by which the punch sinks in.
    Indentation(Positive),
}

/// How the scene is solved; what is absent, the solver chooses.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Solver {
    /// Relative error wanted of each number reported.
    #[serde(default = "default_tolerance")]
    pub tolerance: Positive,
    /// How the flexibility is got.
    #[serde(default)]
    pub flexibility: Option<Box<dyn Flexibility>>,
    /// How the kernels are got from it.
    #[serde(default)]
    pub kernel: Option<Box<dyn KernelStrategy>>,
    /// How the integral equations are discretised.
    #[serde(default)]
    pub quadrature: Option<Box<dyn Quadrature>>,
}

/// What the published scheme reaches on graded layers at moderate cost.
fn default_tolerance() -> Positive {
    Positive::new(1e-4).expect("a positive constant")
}

impl Default for Solver {
    fn default() -> Self {
        Self { tolerance: default_tolerance(), flexibility: None, kernel: None, quadrature: None }
    }
}

/// What is written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// Number of samples of p and q, equally spaced over the contact, both ends included.
    #[serde(default = "default_points")]
    pub points: usize,
    /// The samples themselves in units of the half-width, in place of `points`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub x: Option<Vec<f64>>,
}

fn default_points() -> usize {
    201
}

impl Default for Output {
    fn default() -> Self {
        Self { points: default_points(), x: None }
    }
}

/// Labels of the units; they change no number.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Units {
    /// For example `mm`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<String>,
    /// For example `MPa`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stress: Option<String>,
}
/// tmp
pub fn parse(_n: &str, t: &str) -> Result<Scene, toml::de::Error> { toml::from_str(t) }
