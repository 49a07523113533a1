//! Scenes in one line, for the checks.

use crate::engine::{Solution, Status, solve};
use crate::plan::serves_any_contact;
use crate::scene::{Scene, parse};
use slipzone_api::{Family, PluginInfo, plugins};
use std::fmt::Write;

/// `A0 mu = (kappa + 1)/4 = 1 - nu` at `nu = 0.3`, plane strain: written out, not computed by what is checked.
pub(super) const A0: f64 = 0.7;
/// `beta = (kappa - 1)/(kappa + 1) = (1 - 2 nu)/(2 - 2 nu)` at that ratio.
pub(super) const BETA: f64 = 2.0 / 7.0;

/// A homogeneous half-plane of modulus 1.
pub(super) const HALF_PLANE: &str =
    "poisson = 0.3\nbase = { type = \"infinite\" }\ngrading = { type = \"homogeneous\", modulus = 1.0 }";

/// A layer bonded to a rigid base, modulus 1 at the surface and `1/ratio` at the base.
pub(super) fn layer(h: f64, ratio: f64, nu: f64) -> String {
    let grading = if (ratio - 1.0).abs() < f64::EPSILON {
        "{ type = \"homogeneous\", modulus = 1.0 }".into()
    } else {
        format!("{{ type = \"exponential\", surface = 1.0, base = {:?} }}", 1.0 / ratio)
    };
    format!("thickness = {h:?}\npoisson = {nu:?}\ngrading = {grading}")
}

/// A punch on a layer, and how it is solved.
#[derive(Clone, Debug)]
pub(super) struct Contact {
    layer: String,
    punch: String,
    friction: String,
    load: String,
    tolerance: f64,
    /// `[solver]`'s keys by family: what the scene leaves to the plan is absent.
    methods: Vec<(&'static str, String)>,
    output: String,
}

impl Contact {
    /// A flat punch of half-width 1 under a unit force; `layer` has the lines of `[layer]`.
    ///
    /// By the methods that serve every layer and edge, whatever the planner would choose.
    pub(super) fn flat(layer: impl Into<String>) -> Self {
        let contact = Self {
            layer: layer.into(),
            punch: "type = \"flat\"\nhalf_width = 1.0".into(),
            friction: String::new(),
            load: "force = 1.0".into(),
            tolerance: 1e-10,
            methods: Vec::new(),
            output: String::new(),
        };
        contact
            .by(Family::Flexibility, "{ type = \"compliance\" }")
            .by(Family::Kernel, "{ type = \"split\" }")
            .by(Family::Quadrature, "{ type = \"de-sinc\" }")
    }

    /// Another punch, at a half-width of 1.
    pub(super) fn under(self, punch: impl Into<String>) -> Self {
        Self { punch: punch.into(), load: "half_width = 1.0".into(), ..self }
    }

    /// A cylinder of radius 1, at a half-width of 1.
    pub(super) fn cylinder(self) -> Self {
        self.under("type = \"cylinder\"\nradius = 1.0")
    }

    /// Goodman friction.
    pub(super) fn rubbing(self, eta: f64) -> Self {
        Self { friction: format!("[friction]\ntype = \"goodman\"\ncoefficient = {eta:?}\n"), ..self }
    }

    /// Goodman friction, the strain in the stick zone taken to be `C|x|`.
    pub(super) fn rubbing_linear(self, eta: f64) -> Self {
        let friction = format!("[friction]\ntype = \"goodman\"\ncoefficient = {eta:?}\nstrain = \"linear\"\n");
        Self { friction, ..self }
    }

    /// Another load, as `key = value`.
    pub(super) fn loaded(self, load: impl Into<String>) -> Self {
        Self { load: load.into(), ..self }
    }

    /// The solver's own tolerance; two digits finer than the default unless it is set.
    pub(super) fn to(self, tolerance: f64) -> Self {
        Self { tolerance, ..self }
    }

    /// A method by its table.
    pub(super) fn by(mut self, family: Family, table: &str) -> Self {
        let key = family.place().trim_start_matches("solver.");
        self.methods.retain(|(other, _)| *other != key);
        self.methods.push((key, table.to_owned()));
        self
    }

    /// By whatever methods the solver chooses.
    pub(super) fn by_plan(self) -> Self {
        Self { methods: Vec::new(), ..self }
    }

    /// Tractions at these abscissae, in half-widths.
    pub(super) fn at(self, x: &[f64]) -> Self {
        Self { output: format!("[output]\nx = {x:?}\n"), ..self }
    }

    /// Tractions at these abscissae, and the strain left there.
    pub(super) fn strained_at(self, x: &[f64]) -> Self {
        Self { output: format!("[output]\nx = {x:?}\nstrain = true\n"), ..self }
    }

    pub(super) fn scene(&self) -> Result<Scene, String> {
        let Self { layer, punch, friction, load, tolerance, methods, output } = self;
        let mut text = format!(
            "format = 1\n[layer]\n{layer}\n[punch]\n{punch}\n{friction}[load]\n{load}\n{output}[solver]\n\
             tolerance = {tolerance:e}\n"
        );
        for (key, table) in methods {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{key} = {table}");
        }
        parse("check", &text).map_err(|error| format!("the scene is refused: {error}"))
    }

    /// The solution, whatever its status.
    pub(super) fn attempt(&self) -> Result<Solution, String> {
        Ok(solve(&self.scene()?))
    }

    /// The solution, which is to be converged.
    pub(super) fn solve(&self) -> Result<Solution, String> {
        let solution = self.attempt()?;
        match solution.status {
            Status::Converged => Ok(solution),
            status => Err(format!("{status:?}: {}", solution.reason.unwrap_or_default())),
        }
    }
}

/// The members of a family that serve any contact; others have checks of their own.
pub(super) fn members(family: Family) -> impl Iterator<Item = &'static PluginInfo> {
    plugins().into_iter().filter(move |info| info.family == family && serves_any_contact(info.name))
}

/// Whether a plugin is linked: some are optional.
pub(super) fn has(family: Family, name: &str) -> bool {
    slipzone_api::find(family, name).is_some()
}

/// The numbers of a solution that are compared, by their path.
pub(super) fn numbers(solution: &Solution) -> Vec<(&'static str, f64)> {
    const COMPARED: [&str; 7] = [
        "load.force",
        "load.half_width",
        "load.indentation",
        "pressure.centre",
        "edge.ratio",
        "stick.ratio",
        "stick.one_minus_ratio",
    ];
    let known = COMPARED.into_iter().filter_map(|path| Some((path, solution.number(path)?)));
    // A smooth edge has the factor 0, which has no relative error.
    known.filter(|(path, value)| *path != "edge.ratio" || *value != 0.0).collect()
}

/// One of them.
pub(super) fn number(solution: &Solution, path: &str) -> Result<f64, String> {
    let found = numbers(solution).into_iter().find(|(name, _)| *name == path);
    found.map(|(_, value)| value).ok_or_else(|| format!("there is no {path}"))
}

/// What a solution claims of the error of a number; 0 of a number that the load gives.
pub(super) fn claimed(solution: &Solution, path: &str) -> f64 {
    solution.error.each.get(path).copied().unwrap_or(0.0)
}
