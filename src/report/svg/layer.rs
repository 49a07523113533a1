//! A layer before anything is solved: elastic constants over depth, and how its surface answers.

mod landmarks;

use super::FigureError;
use super::head::titled;
use super::legend::Entry;
use super::panel::{Curve, Panel};
use super::scale::Scale;
use super::sheet::Sheet;
use crate::engine::{DepthProfile, FlexibilityProfile};
use crate::report::labels::Labels;
use crate::report::scene_line::{GREEK, layer_parts};
use crate::scene::Scene;
use landmarks::{Landmarks, Strip};
use slipzone_api::{Base, Moduli};

const MODULUS: Entry = Entry::line("modulus", "#1f4e8c", 2.4, "none");
const POISSON: Entry = Entry::line("Poisson's ratio", "#b5401c", 2.4, "none");
const NORMAL: Entry = Entry::line("s Fᵥᵥ/A₀", "#1f4e8c", 2.4, "none");
const SHEAR: Entry = Entry::line("s Fᵤᵤ/A₀", "#b5401c", 2.4, "8 4");
const COUPLING: Entry = Entry::line("−s Fᵤᵥ/A₀", "#3d7a3d", 2.4, "2 3");
/// On a logarithmic axis, which has no place for its sign.
const COUPLING_SIZE: Entry = Entry::line("|s Fᵤᵥ|/A₀", "#3d7a3d", 2.4, "2 3");

/// Height of the panels, px, and that of Poisson's ratio under the modulus.
const HEIGHT: f64 = 480.0;
const LOWER: f64 = 208.0;
/// Ratio of the largest number to the smallest above which an axis is logarithmic.
const WIDE: f64 = 30.0;
/// Interfaces up to which each is drawn: the rows of a table are no interfaces to look at.
const MOST_INTERFACES: usize = 24;
/// Width of the base, over the layer's thickness.
const BASE: f64 = 0.12;
/// Differences of Poisson's ratio that are rounding.
const SAME: f64 = 1e-9;

/// A scene's layer as an SVG figure (UTF-8): modulus, and Poisson's ratio where it varies, over depth from the surface
/// on; beside it the scaled flexibilities of its surface over the wave number, with the limits of short waves. The
/// panel of what is not there (a solid that is the same at every depth, a flexibility that was refused) is left out.
/// The same layer always gives the same text.
pub fn layer_svg(
    scene: &Scene,
    depths: Option<&DepthProfile>,
    flexibility: Option<&FlexibilityProfile>,
) -> Result<String, FigureError> {
    let depths = depths.and_then(|depths| constants(scene, depths));
    let panels: Vec<Panel> = depths.into_iter().chain(flexibility.map(|of_waves| answer(scene, of_waves))).collect();
    if panels.is_empty() {
        return Err(FigureError::NoLayer);
    }
    Ok(Sheet {
        title: titled(scene.title.as_deref(), "Layer"),
        notes: layer_parts(scene, None, &GREEK),
        alarm: Vec::new(),
        abreast: panels.len(),
        panels,
        legend: Vec::new(),
    }
    .draw())
}

/// Modulus over depth, and Poisson's ratio below it where it varies.
fn constants(scene: &Scene, profile: &DepthProfile) -> Option<Panel> {
    let labels = Labels::new(&scene.units);
    let (bottom, layer) = (*profile.depth.last()?, &scene.layer);
    let mut x = Scale::up_to(bottom, "depth y", &labels.length)?;
    let base = match layer.base {
        Base::Rigid => Some("rigid base"),
        Base::Frictionless => Some("rigid, no friction"),
        Base::HalfPlane { .. } => Some("half-plane"),
        Base::Infinite => None,
    };
    let name = match layer.moduli {
        Moduli::Shear => "shear modulus µ",
        Moduli::Young => "Young's modulus E",
    };
    let substrate = profile.substrate;
    let depth = |y: f64| y / x.unit;
    let end = depth(bottom);
    x.most = if base.is_some() { end * (1.0 + BASE) } else { end };
    let over_depth = |values: &[f64], unit: f64, below: Option<f64>| -> Vec<(f64, f64)> {
        let inside = profile.depth.iter().zip(values).map(|(y, value)| (y / x.unit, value / unit));
        let below = below.into_iter().flat_map(|value| [end, x.most].map(|y| (y, value / unit)));
        inside.chain(below).collect()
    };
    let within =
        |(least, most): (f64, f64), other: Option<f64>| other.map_or((least, most), |v| (least.min(v), most.max(v)));
    let interfaces = profile.interfaces.iter().filter(|_| profile.interfaces.len() <= MOST_INTERFACES);
    let interfaces: Vec<f64> = interfaces.map(|y| depth(*y)).collect();
    let panel = |y: Scale, entry: Entry, points: Vec<(f64, f64)>| {
        // Where the line of a half-plane's modulus does not cross it.
        let line = points.last().filter(|point| point.0 > end);
        let at_top = line.is_some_and(|point| y.place(point.1) < 0.5);
        let base = base.map(|name| Strip { from: end, name, at_top });
        let ground = Box::new(Landmarks { interfaces: interfaces.clone(), limits: Vec::new(), base });
        let curves = vec![curve(&entry, points, &y)];
        Panel { ground, height: HEIGHT, legend: Some(Vec::new()), ..Panel::new(x.clone(), y, curves) }
    };
    let (least, most) = within(profile.modulus_range(), substrate.map(|base| base.0));
    let y = if most > WIDE * least {
        Some(Scale::logarithmic(least / 1.5, most * 1.5, name, &labels.stress))
    } else {
        Scale::up_to(most, name, &labels.stress)
    };
    let modulus = y.map(|y| {
        let points = over_depth(&profile.modulus, y.unit, substrate.map(|base| base.0));
        panel(y, MODULUS, points)
    });
    let (least, most) = within(profile.poisson_range(), substrate.map(|base| base.1));
    let y = Scale::around(least, most, "Poisson's ratio ν", 3.0).filter(|_| most - least > SAME);
    let poisson = y.map(|y| panel(y, POISSON, over_depth(&profile.poisson, 1.0, substrate.map(|base| base.1))));
    match (modulus, poisson) {
        (Some(mut upper), Some(lower)) => {
            upper.x.label = String::new();
            let lower = Some(Box::new(Panel { height: LOWER, ..lower }));
            Some(Panel { height: HEIGHT - LOWER, lower, legend: None, ..upper })
        }
        (modulus, poisson) => modulus.or(poisson),
    }
}

/// Flexibilities over the wave number.
fn answer(scene: &Scene, profile: &FlexibilityProfile) -> Panel {
    let is_graded = scene.layer.law().is_ok_and(|law| law.exponent() != Some(0.0));
    let name = match (scene.layer.length(), scene.layer.base) {
        (Ok(Some(_)), Base::Infinite) if is_graded => "wave number s / |γ|",
        (Ok(Some(_)), Base::Infinite) => "wave number × depth of the datum",
        (Ok(Some(_)), _) => "wave number × thickness, s h",
        _ => "wave number s",
    };
    let waves = &profile.wave_numbers;
    let (longest, shortest) = (waves.first().copied().unwrap_or(0.1), waves.last().copied().unwrap_or(10.0));
    let over_waves = |entry: fn(&slipzone_api::SurfaceFlexibility) -> f64| -> Vec<(f64, f64)> {
        waves.iter().copied().zip(profile.flexibilities.iter().map(entry)).collect()
    };
    let (normal, shear, coupling) = (over_waves(|f| f.vv), over_waves(|f| f.uu), over_waves(|f| -f.uv));
    let all = || [&normal, &shear, &coupling].into_iter().flatten().map(|point| point.1);
    let (least, most) = (all().fold(0.0, f64::min), all().fold(1.0, f64::max));
    let called = "scaled flexibility of the surface";
    // A layer that is much softer than its surface gives way by orders of magnitude more.
    let is_wide = most > WIDE;
    let y = if is_wide {
        let least = normal.iter().chain(&shear).map(|point| point.1).fold(profile.beta.max(SMALLEST * most), f64::min);
        Some(Scale::logarithmic(least.max(SMALLEST * most) / 1.5, most * 1.5, called, ""))
    } else {
        Scale::around(least, most, called, 6.0)
    };
    let y = y.expect("a range that holds 0 and 1");
    let (coupling, entry) = if is_wide {
        (coupling.into_iter().map(|(s, value)| (s, value.abs())).collect(), COUPLING_SIZE)
    } else {
        (coupling, COUPLING)
    };
    // One name for both where two would cover one another.
    let apart = (y.place(1.0) - y.place(profile.beta)).abs() > 0.04;
    let names = if apart { ["1", "β"] } else { ["1, β", ""] };
    let limits = [(1.0, names[0].to_owned()), (profile.beta, names[1].to_owned())];
    let limits = limits.into_iter().filter(|limit| y.holds(limit.0)).collect();
    let ground = Box::new(Landmarks { interfaces: Vec::new(), limits, base: None });
    let curves = [(&NORMAL, normal), (&SHEAR, shear), (&entry, coupling)];
    let curves = curves.map(|(entry, points)| curve(entry, points, &y)).into();
    let legend = Some(vec![NORMAL, SHEAR, entry]);
    Panel { ground, height: HEIGHT, legend, ..Panel::new(Scale::logarithmic(longest, shortest, name, ""), y, curves) }
}

/// What of the points has a place on the axis: on a logarithmic one only what is positive.
fn curve(entry: &Entry, points: Vec<(f64, f64)>, y: &Scale) -> Curve {
    let stretches = vec![points.into_iter().filter(|point| !y.is_logarithmic() || point.1 > 0.0).collect()];
    Curve { style: entry.style, stretches, marks: Vec::new() }
}

/// What is left out at the bottom of a logarithmic axis, over its largest number.
const SMALLEST: f64 = 1e-7;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::svg::texts;
    use slipzone_api::SurfaceFlexibility;

    /// A layer on a base, whose constants and flexibilities the tests make by hand.
    fn scene(layer: &str) -> Scene {
        let text = format!(
            "format = 1\nlayer = {{ {layer}, poisson = 0.3, grading = {{ type = 'homogeneous', modulus = 1.0 }} }}\n\
             punch = {{ type = 'flat', half_width = 1.0 }}\nload = {{ force = 1.0 }}\n\
             units = {{ length = 'mm', stress = 'MPa' }}"
        );
        crate::scene::parse("figure", &text).unwrap_or_else(|error| panic!("{error}"))
    }

    const RIGID: &str = "thickness = 2.0";
    const HALF_PLANE: &str = "thickness = 2.0, base = { type = 'half-plane', shear = 5.0, poisson = 0.2 }";

    /// Three sublayers: soft, graded, hard.
    fn coated(hardest: f64) -> DepthProfile {
        let graded = |i: u32| (0.5 + 0.05 * f64::from(i), hardest.powf(f64::from(i) / 20.0), 0.2 + 0.01 * f64::from(i));
        let points = [(0.0, 1.0, 0.2), (0.5, 1.0, 0.2)].into_iter().chain((0..=20).map(graded));
        let points: Vec<_> = points.chain([(1.5, hardest, 0.3), (2.0, hardest, 0.3)]).collect();
        DepthProfile {
            depth: points.iter().map(|point| point.0).collect(),
            modulus: points.iter().map(|point| point.1).collect(),
            poisson: points.iter().map(|point| point.2).collect(),
            interfaces: vec![0.5, 1.5],
            sublayers: 3,
            substrate: None,
        }
    }

    /// Like those of a bonded layer whose base is `softer` times softer than its surface.
    fn bonded(softer: f64) -> FlexibilityProfile {
        let wave_numbers: Vec<f64> = (0..=80).map(|i| 0.01 * 6000.0_f64.powf(f64::from(i) / 80.0)).collect();
        let one = |s: f64| {
            let bulge = softer * s / (1.0 + s * s * s);
            SurfaceFlexibility { vv: s.tanh() + bulge, uu: s.tanh() + bulge / 2.0, uv: -0.3 * (s - 1.0).tanh() }
        };
        FlexibilityProfile { flexibilities: wave_numbers.iter().map(|s| one(*s)).collect(), wave_numbers, beta: 0.3 }
    }

    fn figure(layer: &str, depths: Option<&DepthProfile>, flexibility: Option<&FlexibilityProfile>) -> String {
        let svg = layer_svg(&scene(layer), depths, flexibility).expect("a figure");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
        svg
    }

    /// How often a text stands in a figure.
    fn count(svg: &str, wanted: &str) -> usize {
        texts(svg).iter().filter(|text| *text == wanted).count()
    }

    #[test]
    fn panels_are_named_with_their_units() {
        let svg = figure(RIGID, Some(&coated(4.0)), Some(&bonded(0.0)));
        let names = [
            "shear modulus µ (MPa)",
            "Poisson's ratio ν",
            "depth y (mm)",
            "wave number × thickness, s h",
            "scaled flexibility of the surface",
            "s Fᵥᵥ/A₀",
            "−s Fᵤᵥ/A₀",
            "β",
        ];
        for name in names {
            assert_eq!(count(&svg, name), 1, "{name} in {:?}", texts(&svg));
        }
        assert_eq!(count(&svg, "rigid base"), 2, "under modulus and Poisson's ratio");
        let young = figure("thickness = 2.0, moduli = 'young'", Some(&coated(4.0)), None);
        assert_eq!(count(&young, "Young's modulus E (MPa)"), 1);
        assert_eq!(svg, figure(RIGID, Some(&coated(4.0)), Some(&bonded(0.0))), "the same layer, the same text");
    }

    #[test]
    fn a_constant_poisson_ratio_takes_no_panel() {
        let mut profile = coated(4.0);
        profile.poisson.fill(0.3);
        assert_eq!(count(&figure(RIGID, Some(&profile), None), "Poisson's ratio ν"), 0);
        profile.substrate = Some((5.0, 0.2));
        let svg = figure(HALF_PLANE, Some(&profile), None);
        assert_eq!(
            (count(&svg, "Poisson's ratio ν"), count(&svg, "half-plane")),
            (1, 2),
            "that of the half-plane differs"
        );
    }

    #[test]
    fn wide_ranges_are_logarithmic() {
        let ticks = |svg: &str| ["10", "100", "1000"].map(|tick| count(svg, tick) > 0);
        let linear = figure(RIGID, Some(&coated(29.0)), None);
        let logarithmic = figure(RIGID, Some(&coated(2000.0)), None);
        assert_eq!((ticks(&linear), ticks(&logarithmic)), ([true, false, false], [true; 3]));
        let svg = figure(RIGID, None, Some(&bonded(1e3)));
        assert_eq!((count(&svg, "|s Fᵤᵥ|/A₀"), count(&svg, "−s Fᵤᵥ/A₀")), (1, 0));
    }

    #[test]
    fn many_rows_are_no_interfaces() {
        let mut profile = coated(4.0);
        let dashed = |profile: &DepthProfile| figure(RIGID, Some(profile), None).matches("5 4").count();
        assert_eq!(dashed(&profile), 4, "two interfaces in two panels");
        profile.interfaces = (1..50).map(|i| 0.04 * f64::from(i)).collect();
        assert_eq!(dashed(&profile), 0);
    }

    #[test]
    fn what_is_not_known_is_left_out() {
        assert_eq!(layer_svg(&scene(RIGID), None, None), Err(FigureError::NoLayer));
        assert_eq!(count(&figure("base = { type = 'infinite' }", None, Some(&bonded(0.0))), "wave number s"), 1);
    }

    #[test]
    fn odd_numbers_still_fit_a_figure() {
        for odd in [1e-100, 1e-12, 1e12, 1e100] {
            let (mut depths, mut flexibility) = (coated(4.0), bonded(0.0));
            depths.modulus.iter_mut().for_each(|modulus| *modulus *= odd);
            texts(&figure(RIGID, Some(&depths), Some(&flexibility)));
            depths.modulus[3] = 1.0;
            flexibility.flexibilities[5].uu = odd;
            flexibility.flexibilities[6].uv = -odd;
            texts(&figure(RIGID, Some(&depths), Some(&flexibility)));
        }
    }
}
