//! The scene: what is to be solved, checked.
//!
//! [`text()`] makes text of a file's bytes, [`parse`] a [`Scene`] of the text, [`parse_with`] one of a text that names
//! files. All say what is wrong in a [`SceneError`] that knows the line; none opens a file. Start with [`parse`].
//! [`schema()`] describes a scene for editors, [`KEYS`] for forms and templates.

mod asked;
pub(crate) mod check;
mod complaint;
pub(crate) mod decode;
pub(crate) mod document;
mod error;
pub(crate) mod example;
mod keys;
mod load_keys;
mod load_path;
mod meant;
mod model;
mod schema;
mod syntax;
mod table;
mod tables;
mod tagged;
mod template;
mod text;

pub use asked::Asked;
pub(crate) use check::printable;
pub(crate) use error::Kind;
pub use error::SceneError;
pub use keys::KEYS;
pub(crate) use load_path::to_fifteen_digits;
pub use load_path::{LoadKind, LoadPath, PathError};
pub use model::Model;
pub use schema::schema;
pub(crate) use template::{Replacement, Template, overlap, plain};
pub use text::{LARGEST, text, text_of, too_large};

use document::Document;
use serde::{Deserialize, Serialize};
use slipzone_api::{
    Base, Files, Flexibility, Friction, Grading, KernelStrategy, LayerModel, Moduli, ModulusLaw, NoFiles, Plane,
    Poisson, Positive, PunchProfile, Quadrature, Refusal, Setting, Solid,
};

/// The scene that a text describes, every check passed; `name` is what errors call the text.
///
/// Plugins that the scene names are linked, no more: a combination that the engine cannot solve is a
/// scene all the same.
///
/// # Errors
/// The first thing that is wrong, with its line.
///
/// ```
/// let error = slipzone::scene::parse("demo.toml", "format = 1\n[layer]\nthickness = -5.0\n").unwrap_err();
/// assert_eq!((error.line, error.column), (3, 13));
/// assert_eq!(error.expected.as_deref(), Some("a finite number above 0"));
/// ```
pub fn parse(name: &str, text: &str) -> Result<Scene, SceneError> {
    parse_with(name, text, &NoFiles)
}

/// As [`parse`], for scenes that name files: those come from `files`, once, and are kept with the scene.
///
/// # Errors
/// The first thing that is wrong, with its line in the scene or in the file.
///
/// ```
/// struct Memory;
/// impl slipzone::api::Files for Memory {
///     fn read(&self, name: &str) -> Result<Vec<u8>, String> {
///         match name {
///             "profile.csv" => Ok(b"x, height\n0, 0\n1, 0.1\n2, 0.4\n3, 0.9\n4, 1.6\n".to_vec()),
///             _ => Err("there is no such file".into()),
///         }
///     }
/// }
/// let text = r#"
///     format = 1
///     layer = { thickness = 5.0, poisson = 0.3, grading = { type = "homogeneous", modulus = 1.0 } }
///     punch = { type = "table", file = "profile.csv" }
///     load = { half_width = 1.0 }
/// "#;
/// assert!(slipzone::scene::parse_with("demo.toml", text, &Memory).is_ok());
/// let error = slipzone::scene::parse("demo.toml", text).unwrap_err();
/// assert_eq!((error.line, error.column), (4, 38));
/// ```
pub fn parse_with(name: &str, text: &str, files: &dyn Files) -> Result<Scene, SceneError> {
    crate::link_plugins();
    if text.len() > LARGEST {
        return Err(too_large("scene", name));
    }
    checked(&Document::parse(name, text)?, files, &Known::default())
}

/// The scene that a document describes, every check passed.
fn checked(document: &Document, files: &dyn Files, known: &Known) -> Result<Scene, SceneError> {
    let mut scene = decoded(document)?;
    match known.grading {
        Some(known) => scene.layer.grading = known.layer.grading.clone(),
        None => scene.layer.grading.read(files).map_err(|fault| document.fault(&["layer", "grading"], fault))?,
    }
    match known.punch {
        Some(known) => scene.punch = known.punch.clone(),
        None => scene.punch.read(files).map_err(|fault| document.fault(&["punch"], fault))?,
    }
    if scene.layer.base != Base::Infinite {
        scene.layer.thickness = scene.layer.thickness.or(scene.layer.grading.thickness());
    }
    check::all(document, &scene)?;
    Ok(scene)
}

/// Scenes whose plugins, as a document describes them, have read their files already.
#[derive(Default)]
struct Known<'a> {
    grading: Option<&'a Scene>,
    punch: Option<&'a Scene>,
}

/// The scene that a document describes, its files not read yet.
fn decoded(document: &Document) -> Result<Scene, SceneError> {
    decode::format(document)?;
    load_keys::load(document)?;
    check::points(document)?;
    let scene = decode::decode(document)?;
    // What files hold is multiplied by units.
    check::magnitudes(document, &["layer", "punch"])?;
    Ok(scene)
}

/// A contact problem. Lengths, stresses and forces per length in any consistent units.
///
/// Of one that was [parsed](parse) each number is checked; of one that was made or changed in code [`Self::check`] does
/// that. The engine refuses what it could not compute with.
#[derive(Clone, Debug, Deserialize)]
#[serde(from = "table::SceneTable")]
pub struct Scene {
    /// Version of the file format; 1.
    pub format: u32,
    /// One line that names the scene in reports and figures.
    pub title: Option<String>,
    /// The elastic solid.
    pub layer: Layer,
    /// The rigid punch.
    pub punch: Box<dyn PunchProfile>,
    /// Friction; frictionless when absent.
    pub friction: Option<Friction>,
    /// How hard it is pressed; of a path, the last load.
    pub load: Load,
    /// Loads on the way to the last, where a loading curve is asked for.
    pub path: Option<LoadPath>,
    /// How it is solved.
    pub solver: Solver,
    /// What is written.
    pub output: Output,
    /// Labels of the units.
    pub units: Units,
}

impl Scene {
    /// The checks of [`parse`], for a scene that was made or changed in code. It takes about as long as to parse it.
    ///
    /// # Errors
    /// The first thing that is wrong; its line is one of the scene written as TOML.
    ///
    /// ```
    /// let mut scene = slipzone::scene::parse("demo.toml", r#"
    ///     format = 1
    ///     layer = { thickness = 5.0, poisson = 0.3, grading = { type = "homogeneous", modulus = 1.0 } }
    ///     punch = { type = "flat", half_width = 1.0 }
    ///     load = { force = 1.0 }
    /// "#).unwrap();
    /// assert!(scene.check().is_ok());
    /// scene.output.points = 0;
    /// let error = scene.check().unwrap_err();
    /// assert_eq!(error.expected.as_deref(), Some("an integer from 2 to 1000000"));
    /// ```
    pub fn check(&self) -> Result<(), SceneError> {
        const NAME: &str = "scene";
        let text = toml::to_string(self).map_err(|error| SceneError::whole(NAME, error.to_string()))?;
        let document = Document::parse(NAME, &text)?;
        decoded(&document)?;
        // What files hold is known to this one alone.
        check::all(&document, self)
    }

    /// The friction that it has to be solved with: none where nothing is asked for that depends on it.
    pub(crate) fn friction_needed(&self) -> Option<Friction> {
        self.friction.filter(|_| self.output.asks("profile") || self.output.asks_of_stick())
    }
}

/// The elastic solid.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Layer {
    /// Thickness `h`; absent on an infinite solid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub thickness: Option<Positive>,
    /// Poisson's ratio.
    pub poisson: Poisson,
    /// Plane strain or plane stress.
    #[serde(default)]
    pub plane: Plane,
    /// What the grading's moduli are.
    #[serde(default)]
    pub moduli: Moduli,
    /// What the layer stands on.
    #[serde(default, deserialize_with = "tagged::base")]
    pub base: Base,
    /// Depth below the surface at which a vertical displacement is called 0, where the base leaves that open.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub datum: Option<Positive>,
    /// Modulus over depth: the shear modulus, or Young's where [`Self::moduli`] says so.
    pub grading: Box<dyn Grading>,
}

impl Layer {
    /// The grading's law over the layer; over the user's length on an infinite solid.
    pub fn law(&self) -> Result<Box<dyn ModulusLaw>, Refusal> {
        let thickness = self.thickness.filter(|_| self.base != Base::Infinite);
        self.grading.law(&Setting { thickness, moduli: self.moduli })
    }

    /// The length in whose units the layer is computed: its thickness; of an infinite solid that over which the modulus
    /// grows by a factor of `e`, or of a homogeneous one the depth of the datum; `None` where there is none of these.
    pub fn length(&self) -> Result<Option<f64>, Refusal> {
        if self.base != Base::Infinite {
            return Ok(self.thickness.map(Positive::get));
        }
        let gradient = self.law()?.exponent().filter(|gradient| *gradient != 0.0);
        Ok(gradient.map(|gradient| gradient.recip().abs()).or(self.datum.map(Positive::get)))
    }

    /// Whether an indentation is defined: by what lies far below, or by a datum.
    pub fn has_depths(&self) -> bool {
        self.datum.is_some() || self.is_grounded()
    }

    /// Whether what lies far below does not give way; of a grading that gives no law it counts as giving way.
    pub fn is_grounded(&self) -> bool {
        self.base.is_grounded(|| self.law().map_or(Some(0.0), |law| law.exponent()))
    }

    /// What the flexibilities see of it.
    pub fn model(&self) -> Result<LayerModel, Refusal> {
        let length = self.length()?;
        let thickness = length.and_then(|length| Positive::new(length).ok());
        let law = self.grading.law(&Setting { thickness, moduli: self.moduli })?;
        let solid = Solid { plane: self.plane, poisson: self.poisson, moduli: self.moduli };
        let mut model = LayerModel::new(law, solid, self.base);
        model.datum = self.datum.map(|datum| datum.get() / length.unwrap_or(1.0));
        Ok(model)
    }
}

/// The load: exactly one of three.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    pub flexibility: Option<Box<dyn Flexibility>>,
    /// How the kernels are got from it.
    pub kernel: Option<Box<dyn KernelStrategy>>,
    /// How the integral equations are discretised.
    pub quadrature: Option<Box<dyn Quadrature>>,
    /// What stands for the solid, whatever its error; the cheapest that is near enough when absent.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub model: Option<Model>,
    /// Models that are not to be chosen.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub forbid: Vec<Model>,
}

/// More than any measurement resolves, for a fraction of a millisecond.
fn default_tolerance() -> Positive {
    Positive::new(1e-8).expect("a positive constant")
}

impl Default for Solver {
    fn default() -> Self {
        Self {
            tolerance: default_tolerance(),
            flexibility: None,
            kernel: None,
            quadrature: None,
            model: None,
            forbid: Vec::new(),
        }
    }
}

/// What is written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "OutputTable", into = "OutputTable")]
pub struct Output {
    /// Number of samples of p and q, equally spaced over the contact, both ends included.
    pub points: usize,
    /// The samples themselves in units of the half-width, in place of `points`.
    pub x: Option<Vec<f64>>,
    /// Whether the strain left in the stick zone is written, too.
    pub strain: bool,
    /// What is computed and written; everything when absent.
    pub quantities: Option<Vec<Asked>>,
}

impl Output {
    /// Whether what stands at a path of the result is asked for, such as `edge.ratio` or `profile`.
    pub fn asks(&self, path: &str) -> bool {
        self.quantities.as_ref().is_none_or(|asked| asked.iter().any(|asked| asked.covers(path)))
    }

    /// How close to an edge of the contact the closest sample inside is, in units of the half-width.
    pub(crate) fn nearest(&self) -> f64 {
        let Some(x) = &self.x else { return 2.0 / (self.points - 1) as f64 };
        x.iter().map(|x| 1.0 - x.abs()).filter(|gap| *gap > 0.0).fold(1.0, f64::min)
    }

    /// Whether any number of the stick zone is.
    pub(crate) fn asks_of_stick(&self) -> bool {
        Asked::NAMES.iter().any(|name| name.starts_with("stick") && self.asks(name))
    }
}

impl Default for Output {
    fn default() -> Self {
        Self { points: 201, x: None, strain: false, quantities: None }
    }
}

/// The keys of `[output]`: one of the first two, and the rest.
#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct OutputTable {
    #[serde(skip_serializing_if = "Option::is_none")]
    points: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    x: Option<Vec<f64>>,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    strain: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    quantities: Option<Vec<Asked>>,
}

impl TryFrom<OutputTable> for Output {
    type Error = &'static str;

    fn try_from(OutputTable { points, x, strain, quantities }: OutputTable) -> Result<Self, Self::Error> {
        if points.is_some() && x.is_some() {
            return Err("expected one of `points` and `x`, found both");
        }
        Ok(Self { points: points.unwrap_or(Self::default().points), x, strain, quantities })
    }
}

impl From<Output> for OutputTable {
    fn from(Output { points, x, strain, quantities }: Output) -> Self {
        Self { points: x.is_none().then_some(points), x, strain, quantities }
    }
}

/// Labels of the units; they change no number.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Units {
    /// For example `mm`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub length: Option<String>,
    /// For example `MPa`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stress: Option<String>,
}

impl Units {
    /// The unit of lengths and that of stresses, or these words where they have no label.
    pub fn names(&self) -> [&str; 2] {
        [self.length.as_deref().unwrap_or("length"), self.stress.as_deref().unwrap_or("stress")]
    }
}
