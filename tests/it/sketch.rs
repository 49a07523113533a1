//! Scenes in one line, for the tests.

use slipzone::engine::{Solution, solve};
use slipzone::scene::Scene;

/// A flat punch of half-width 1 or a cylinder of radius 1 on a layer with surface modulus 1.
#[derive(Clone, Debug)]
pub(crate) struct Sketch {
    /// Thickness; `None` for an infinite solid.
    pub(crate) h: Option<f64>,
    /// `mu1/mu3`.
    pub(crate) ratio: f64,
    pub(crate) nu: f64,
    pub(crate) flat: bool,
    pub(crate) eta: Option<f64>,
    /// Lines of `[layer]` in place of those that thickness, ratio and Poisson's ratio make.
    pub(crate) layer: Option<String>,
    /// `key = value` of the load.
    pub(crate) load: String,
    /// Further lines: `[solver]`, `[output]`.
    pub(crate) rest: String,
}

impl Sketch {
    pub(crate) fn flat(h: f64, ratio: f64, nu: f64) -> Self {
        Self {
            h: Some(h),
            ratio,
            nu,
            flat: true,
            eta: None,
            layer: None,
            load: "force = 1.0".into(),
            rest: String::new(),
        }
    }

    pub(crate) fn half_plane(nu: f64) -> Self {
        Self { h: None, ..Self::flat(1.0, 1.0, nu) }
    }

    /// A flat punch on the layer that these lines describe.
    pub(crate) fn on(layer: impl Into<String>) -> Self {
        Self { layer: Some(layer.into()), ..Self::half_plane(0.3) }
    }

    pub(crate) fn cylinder(self) -> Self {
        Self { flat: false, load: "half_width = 1.0".into(), ..self }
    }

    /// The flat punch as wide as the contact.
    pub(crate) fn flat_again(self) -> Self {
        Self { flat: true, load: "force = 1.0".into(), ..self }
    }

    pub(crate) fn rubbing(self, eta: f64) -> Self {
        Self { eta: Some(eta), ..self }
    }

    pub(crate) fn loaded(self, load: &str) -> Self {
        Self { load: load.into(), ..self }
    }

    pub(crate) fn with(self, rest: &str) -> Self {
        Self { rest: format!("{}\n{rest}", self.rest), ..self }
    }

    pub(crate) fn text(&self) -> String {
        let layer = match self.h {
            Some(h) => format!("thickness = {h:?}"),
            None => "base = { type = \"infinite\" }".into(),
        };
        let grading = if (self.ratio - 1.0).abs() < f64::EPSILON {
            "type = \"homogeneous\", modulus = 1.0".into()
        } else {
            format!("type = \"exponential\", surface = 1.0, base = {:?}", 1.0 / self.ratio)
        };
        let own = || format!("{layer}\npoisson = {:?}\ngrading = {{ {grading} }}", self.nu);
        let layer = self.layer.clone().unwrap_or_else(own);
        let punch = if self.flat { "type = \"flat\"\nhalf_width = 1.0" } else { "type = \"cylinder\"\nradius = 1.0" };
        let friction =
            self.eta.map_or(String::new(), |eta| format!("[friction]\ntype = \"goodman\"\ncoefficient = {eta:?}\n"));
        format!("format = 1\n[layer]\n{layer}\n[punch]\n{punch}\n{friction}[load]\n{}\n{}", self.load, self.rest)
    }

    pub(crate) fn scene(&self) -> Scene {
        slipzone::link_plugins();
        let text = self.text();
        slipzone::scene::parse("sketch.toml", &text).unwrap_or_else(|e| panic!("{e}\n{text}"))
    }

    pub(crate) fn solve(&self) -> Solution {
        solve(&self.scene())
    }
}

/// The numbers of a solution that are not given by the scene, by their path.
pub(crate) fn numbers(solution: &Solution) -> Vec<(&'static str, f64)> {
    ["load.force", "load.indentation", "pressure.centre", "edge.ratio", "stick.ratio", "stick.one_minus_ratio"]
        .into_iter()
        .filter_map(|path| Some((path, solution.number(path)?)))
        .collect()
}

/// The largest difference of the pressures over that there or its mean, and what was claimed for the first.
pub(crate) fn pressure_apart(found: &Solution, exact: &Solution) -> [f64; 2] {
    let mean = exact.pressure.mean.expect("a force");
    let pairs =
        found.profile.pressure.iter().zip(&exact.profile.pressure).filter_map(|(p, truth)| Some(((*p)?, (*truth)?)));
    let apart = pairs.map(|(p, truth)| (p - truth).abs() / truth.max(mean)).fold(0.0, f64::max);
    [apart, found.error.each["profile.pressure"]]
}

/// The largest difference of the shears over the largest of them, and what was claimed for the first.
pub(crate) fn shear_apart(found: &Solution, exact: &Solution) -> [f64; 2] {
    let shear = |solution: &Solution| solution.profile.shear.clone().expect("friction");
    let (found_shear, exact_shear) = (shear(found), shear(exact));
    let pairs = found_shear.iter().zip(&exact_shear).filter_map(|(q, truth)| Some(((*q)?, (*truth)?)));
    let [apart, largest] = pairs
        .fold([0.0_f64; 2], |[apart, largest], (q, truth)| [apart.max((q - truth).abs()), largest.max(truth.abs())]);
    [apart / largest, found.error.each["profile.shear"]]
}
