//! Ten scenes: four punches on layers from thick to thin, soft below and stiff below.

use super::march::{End, Punch, march};
use super::surface::Surface;
use crate::sketch::Sketch;
use slipzone::api::reference::rounded_flat::RoundedFlat;
use slipzone::api::reference::wedge::Wedge;
use slipzone::scene::Scene;
use std::f64::consts::PI;

/// Where tractions are compared.
pub(super) const POINTS: [f64; 3] = [0.25, 0.5, 0.75];

/// Half-width of the rounded punch's face: a whole number of cells, and none of the points.
pub(super) const FACE: f64 = 0.375;

/// The punches; all lengths in units of the half-width at the end.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape {
    /// Radius 1.
    Cylinder,
    /// Slope 1: everything is linear.
    Wedge,
    /// `x^4`.
    Quartic,
    /// Flat up to 3/8, then of radius 1.
    Rounded,
}

impl Shape {
    pub(super) fn punch(self) -> Punch {
        let (face, half_plane): (f64, fn(f64, f64) -> f64) = match self {
            Self::Cylinder => (0.0, |x, b| ((b - x) * (b + x)).sqrt()),
            Self::Wedge => (0.0, |x, b| Wedge { slope: 1.0, half_width: b, compliance: 1.0 }.pressure(x)),
            Self::Quartic => (0.0, |x, b| 2.0 * (b * b + 2.0 * x * x) * ((b - x) * (b + x)).sqrt()),
            Self::Rounded => {
                (FACE, |x, b| RoundedFlat { flat: FACE, radius: 1.0, half_width: b, compliance: 1.0 }.pressure(x))
            }
        };
        let tip = if matches!(self, Self::Wedge) { 2.0 / PI } else { 0.0 };
        Punch { face, tip, half_plane }
    }

    /// As a scene writes it.
    fn text(self) -> &'static str {
        match self {
            Self::Cylinder => "type = \"cylinder\"\nradius = 1.0",
            Self::Wedge => "type = \"wedge\"\nslope = 1.0",
            Self::Quartic => "type = \"power\"\ncoefficient = 1.0\nexponent = 4.0",
            Self::Rounded => "type = \"rounded-flat\"\nhalf_width = 0.375\nradius = 1.0",
        }
    }
}

/// A punch on a layer.
#[derive(Clone, Copy, Debug)]
pub(super) struct Case {
    pub(super) shape: Shape,
    /// Thickness; `None` for a half-plane.
    pub(super) h: Option<f64>,
    /// `mu1/mu3`.
    pub(super) ratio: f64,
    pub(super) nu: f64,
    pub(super) eta: f64,
}

impl Case {
    pub(super) const fn half_plane(shape: Shape, nu: f64, eta: f64) -> Self {
        Self { shape, h: None, ratio: 1.0, nu, eta }
    }

    const fn layer(shape: Shape, h: f64, ratio: f64, nu: f64, eta: f64) -> Self {
        Self { shape, h: Some(h), ratio, nu, eta }
    }

    /// The scene under a flat punch of the same half-width.
    pub(super) fn flat(&self) -> Sketch {
        Sketch { h: self.h, ..Sketch::flat(1.0, self.ratio, self.nu) }.rubbing(self.eta)
    }

    /// The scene under a cylinder, whichever its punch.
    pub(super) fn sketch(&self) -> Sketch {
        self.flat().cylinder()
    }

    /// Its loading history, on so many cells in so many steps.
    pub(super) fn march(&self, cells: usize, steps: usize) -> End {
        march(&Surface::new(&self.sketch()), &self.shape.punch(), self.eta, cells, steps)
    }

    /// The scene for the program itself, with more lines to it.
    pub(super) fn scene(&self, more: &str) -> Scene {
        slipzone::link_plugins();
        let text = self.sketch().with(more).text().replace(Shape::Cylinder.text(), self.shape.text());
        slipzone::scene::parse("marching.toml", &text).unwrap_or_else(|e| panic!("{e}\n{text}"))
    }
}

/// The second is the layer of `cylinder_shear.json`.
pub(super) const TEN: [Case; 10] = [
    Case::half_plane(Shape::Cylinder, 0.3, 0.3),
    Case::layer(Shape::Cylinder, 5.0, 8.0, 0.3, 0.3),
    Case::layer(Shape::Cylinder, 10.0, 0.125, 0.2, 0.25),
    Case::layer(Shape::Cylinder, 1.0, 1.0, 0.3, 0.1),
    Case::layer(Shape::Cylinder, 2.0, 4.0, 0.4, 0.15),
    Case::layer(Shape::Wedge, 5.0, 8.0, 0.3, 0.3),
    Case::layer(Shape::Wedge, 2.0, 0.125, 0.2, 0.2),
    Case::layer(Shape::Quartic, 3.0, 0.25, 0.25, 0.2),
    Case::layer(Shape::Quartic, 1.0, 8.0, 0.3, 0.15),
    Case::layer(Shape::Rounded, 4.0, 2.0, 0.3, 0.25),
];
