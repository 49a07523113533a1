//! Gradings that can imitate another: the same flexibility, the same numbers.

use crate::scene::example::knows_thickness;
use crate::verify::Case;
use crate::verify::check::Within;
use crate::verify::contact::{Contact, has, members, number, numbers};
use crate::verify::layers::{BASES, PROMISED, apart, compliance};
use slipzone_api::{Family, PluginInfo};

const PLAIN: &str = "{ type = \"homogeneous\", modulus = 1.0 }";
const STEEP: &str = "{ type = \"exponential\", surface = 1.0, base = 5.0 }";

/// Name, two gradings of a layer of thickness 3.
const PAIRS: [(&str, &str, &str); 14] = [
    (
        "exponential of gradient ln(5)/3",
        "{ type = \"exponential\", surface = 1.0, gradient = 0.53647930414470013 }",
        STEEP,
    ),
    (
        "formula as an exponential",
        "{ type = \"formula\", modulus = \"m*exp(y/h*log(5))\", parameters = { m = 1.0 } }",
        STEEP,
    ),
    ("formula as a constant", "{ type = \"formula\", modulus = \"1 + 0*y\" }", PLAIN),
    (
        "power law of exponent 1 as a line",
        "{ type = \"power-law\", surface = 1.0, length = 1.0, exponent = 1.0 }",
        "{ type = \"linear\", surface = 1.0, base = 4.0 }",
    ),
    (
        "formula as a power law",
        "{ type = \"formula\", modulus = \"(1 + y/2)^2.5\" }",
        "{ type = \"power-law\", surface = 1.0, length = 2.0, exponent = 2.5 }",
    ),
    (
        "formula as a sigmoid",
        "{ type = \"formula\", modulus = \"2.5 + 1.5*tanh((y - 1)/0.5)\" }",
        "{ type = \"sigmoid\", above = 1.0, below = 4.0, centre = 1.0, width = 0.5 }",
    ),
    (
        "formula as a mixture",
        "{ type = \"formula\", modulus = \"1 + 3*(y/h)^2\", poisson = \"0.3 - 0.1*(y/h)^2\" }",
        "{ type = \"volume-fraction\", surface = { modulus = 1.0, poisson = 0.3 }, \
         base = { modulus = 4.0, poisson = 0.2 }, exponent = 2.0, rule = \"mixture\" }",
    ),
    (
        "linear mixture as a line",
        "{ type = \"volume-fraction\", surface = { modulus = 1.0, poisson = 0.3 }, \
         base = { modulus = 4.0, poisson = 0.3 }, exponent = 1.0, rule = \"mixture\" }",
        "{ type = \"linear\", surface = 1.0, base = 4.0 }",
    ),
    (
        "Mori-Tanaka's mixture of one material",
        "{ type = \"volume-fraction\", surface = { modulus = 1.0, poisson = 0.3 }, \
         base = { modulus = 1.0, poisson = 0.3 }, exponent = 2.5, rule = \"mori-tanaka\" }",
        PLAIN,
    ),
    (
        "interface between equal materials",
        "{ type = \"error-function\", above = 1.0, below = 1.0, centre = 1.0, width = 0.2 }",
        PLAIN,
    ),
    (
        "stack of three equal sublayers",
        "{ type = \"stack\", layers = [\
         { thickness = 0.3, poisson = 0.3, grading = { type = \"homogeneous\", modulus = 1.0 } }, \
         { thickness = 0.7, poisson = 0.3, grading = { type = \"homogeneous\", modulus = 1.0 } }, \
         { thickness = 2.0, grading = { type = \"homogeneous\", modulus = 1.0 } }] }",
        PLAIN,
    ),
    // 5^(1/3)
    (
        "stack of pieces of an exponential",
        "{ type = \"stack\", layers = [\
         { thickness = 1.0, grading = { type = \"exponential\", surface = 1.0, base = 1.7099759466766968 } }, \
         { thickness = 2.0, grading = { type = \"exponential\", surface = 1.7099759466766968, base = 5.0 } }] }",
        STEEP,
    ),
    (
        "stack of pieces of a line",
        "{ type = \"stack\", layers = [\
         { thickness = 0.5, grading = { type = \"linear\", surface = 1.0, base = 1.5 } }, \
         { thickness = 2.5, grading = { type = \"stack\", layers = [\
         { thickness = 1.5, grading = { type = \"linear\", surface = 1.5, base = 3.0 } }, \
         { thickness = 1.0, grading = { type = \"linear\", surface = 3.0, base = 4.0 } }] } }] }",
        "{ type = \"linear\", surface = 1.0, base = 4.0 }",
    ),
    // What is interpolated is the logarithm.
    (
        "table of an exponential",
        "{ type = \"table\", points = [[0.0, 1.0], [1.0, 1.7099759466766968], [1.5, 2.2360679774997898], \
         [2.0, 2.9240177382128661], [3.0, 5.0]] }",
        STEEP,
    ),
];

fn lines(base: &str, grading: &str) -> String {
    format!("{base}thickness = 3.0\npoisson = 0.3\ngrading = {grading}")
}

pub(super) fn cases() -> Vec<Case> {
    let mut all: Vec<Case> = PAIRS.map(|(name, one, other)| pair(name, one, other)).into();
    all.extend(members(Family::Grading).map(series));
    all.extend([
        young(),
        interfaces("sigmoid", 1.0),
        interfaces("error-function", 2.0 / std::f64::consts::PI.sqrt()),
        sublayers(),
    ]);
    all
}

/// A stack's own modulus changes where its sublayers meet, and nowhere else.
fn sublayers() -> Case {
    Case::new("sublayers", |sheet| {
        let layer = "poisson = 0.3\n[layer.grading]\ntype = \"stack\"\nlayers = [\
            { thickness = 0.3, grading = { type = \"homogeneous\", modulus = 1.0 } }, \
            { thickness = 0.7, grading = { type = \"homogeneous\", modulus = 2.0 } }, \
            { thickness = 2.0, grading = { type = \"homogeneous\", modulus = 3.0 } }]";
        let scene = Contact::flat(layer).scene()?;
        let law = scene.layer.law().map_err(|refusal| refusal.to_string())?;
        let within = || Within::new(0.0, "a constant of the scene");
        // Depths are in thicknesses of the stack, which is 3.
        for (depth, expected) in [(0.3 - 1e-9, 1.0), (0.3 + 1e-9, 2.0), (1.0 - 1e-9, 2.0), (1.0 + 1e-9, 3.0)] {
            let name = format!("stack: modulus at depth {depth:.9}");
            sheet.relative(&name, law.modulus(depth / 3.0), expected, within(), "the scene");
        }
        Ok(())
    })
}

fn pair(name: &'static str, one: &'static str, other: &'static str) -> Case {
    Case::new(name, move |sheet| {
        if one.contains("formula") && !has(Family::Grading, "formula") {
            return Ok(());
        }
        for (base, line) in BASES {
            let error = apart(&*compliance(&lines(line, one))?, &*compliance(&lines(line, other))?)?;
            let within = Within::new(PROMISED, "each flexibility promises 1e-11");
            sheet.error(&format!("{name}, {base}: flexibility, worst of 15 waves"), error, within, "the law imitated");
        }
        let solve = |grading| Contact::flat(lines("", grading)).rubbing(0.3).solve();
        let (one, other) = (solve(one)?, solve(other)?);
        for (path, expected) in numbers(&other) {
            let within = Within::new(2e-10, "the solver's own tolerance, 1e-10, of both");
            sheet.relative(&format!("{name}: {path}"), number(&one, path)?, expected, within, "the law imitated");
        }
        Ok(())
    })
}

/// The modulus near the surface is what its Taylor series says, which the kernels' tails are made of.
fn series(info: &'static PluginInfo) -> Case {
    let name = info.name;
    Case::new(format!("series of {name}"), move |sheet| {
        let thickness = if knows_thickness(info) { "" } else { "thickness = 3.0\n" };
        let layer = format!("{thickness}poisson = 0.3\n[layer.grading]\n{}", info.example);
        let scene = Contact::flat(layer).scene()?;
        let law = scene.layer.law().map_err(|refusal| refusal.to_string())?;
        let series = law.surface_series(12);
        if series.len() < 2 {
            // A law that is not smooth at the surface tells nothing.
            return Ok(());
        }
        let depth = 1e-2;
        let sum = series.iter().rev().fold(0.0, |sum, c| sum * depth + c);
        let last = series[series.len() - 1].abs() * 1e-2_f64.powi(11);
        let within = Within::new(1e-13 + 2.0 * last, "rounding, and twice the last of up to 12 terms");
        let name = format!("{name}: modulus at a hundredth of the thickness by its series");
        sheet.relative(&name, law.modulus(depth) / law.modulus(0.0), sum, within, "the law itself");
        Ok(())
    })
}

/// `E = 2 mu (1 + nu)`.
fn young() -> Case {
    Case::new("Young's moduli", |sheet| {
        let young = lines("moduli = \"young\"\n", "{ type = \"exponential\", surface = 2.6, base = 13.0 }");
        let error = apart(&*compliance(&young)?, &*compliance(&lines("", STEEP))?)?;
        let within = Within::new(1e-14, "two roundings of the moduli");
        sheet.error(
            "Young's moduli 2.6 and 13 as shear moduli 1 and 5: flexibility",
            error,
            within,
            "E = 2 mu (1 + nu)",
        );
        let depth = |layer: &str| number(&Contact::flat(layer).solve()?, "load.indentation");
        let expected = depth(&lines("", STEEP))?;
        let within = Within::new(2e-10, "the solver's own tolerance, 1e-10, of both");
        let name = "Young's moduli 2.6 and 13 as shear moduli 1 and 5: indentation";
        sheet.relative(name, depth(&young)?, expected, within, "E = 2 mu (1 + nu)");
        Ok(())
    })
}

/// Within `y << width` a blurred interface is a straight line of slope `slope/width` but for a cube of `y/width`.
fn interfaces(kind: &'static str, slope: f64) -> Case {
    Case::new(format!("wide {kind}"), move |sheet| {
        let mut errors = Vec::new();
        for width in [20.0, 40.0, 80.0] {
            let wide = format!("{{ type = \"{kind}\", above = 1.0, below = 4.0, centre = 1.5, width = {width:?} }}");
            let [top, bottom] = [-1.5, 1.5].map(|y| 2.5 + 1.5 * slope * y / width);
            let line = format!("{{ type = \"linear\", surface = {top:?}, base = {bottom:?} }}");
            errors.push(apart(&*compliance(&lines("", &wide))?, &*compliance(&lines("", &line))?)?);
        }
        let order = (errors[1] / errors[2]).log2();
        let within = Within::new(0.1, "next order: (y/width)^2 below 1e-3, and rounding of the smallest difference");
        sheet.absolute(&format!("wide {kind}: order of its distance to a line"), order, 3.0, within, "odd function");
        let within = Within::new(1e-5, "(1.5/80)^3 times factors of order one");
        sheet.error(&format!("wide {kind}: distance to a line at width 80"), errors[2], within, "its tangent");
        Ok(())
    })
}
