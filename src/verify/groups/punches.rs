//! Punches that can imitate another, on a graded layer.

use crate::verify::Case;
use crate::verify::check::{Within, off, worst};
use crate::verify::contact::{Contact, has, layer, members, number, numbers};
use slipzone_api::Family;

const CYLINDER: &str = "type = \"cylinder\"\nradius = 4.0";

/// Name, two punches.
const PAIRS: [(&str, &str, &str); 9] = [
    ("power 2 as a cylinder", "type = \"power\"\ncoefficient = 0.125\nexponent = 2.0", CYLINDER),
    ("power 1 as a wedge", "type = \"power\"\ncoefficient = 0.05\nexponent = 1.0", "type = \"wedge\"\nslope = 0.05"),
    ("polynomial as a cylinder", "type = \"polynomial\"\ncoefficients = [0.125]", CYLINDER),
    (
        "polynomial as power 4",
        "type = \"polynomial\"\ncoefficients = [0.0, 0.05]",
        "type = \"power\"\ncoefficient = 0.05\nexponent = 4.0",
    ),
    ("rounded wedge, round all over, as a cylinder", "type = \"rounded-wedge\"\nslope = 0.5\nradius = 4.0", CYLINDER),
    ("formula as a cylinder", "type = \"formula\"\nheight = \"x^2/(2*R)\"\nparameters = { R = 4.0 }", CYLINDER),
    (
        "formula of a slope as a polynomial",
        "type = \"formula\"\nslope = \"0.1*x + 0.08*x^3\"",
        "type = \"polynomial\"\ncoefficients = [0.05, 0.02]",
    ),
    ("formula as a wedge", "type = \"formula\"\nheight = \"0.05*abs(x)\"", "type = \"wedge\"\nslope = 0.05"),
    (
        "table as a cylinder",
        "type = \"table\"\npoints = [[0.0, 0.0], [0.4, 0.02], [0.8, 0.08], [1.2, 0.18], [1.6, 0.32], [2.0, 0.5]]",
        CYLINDER,
    ),
];

pub(super) fn cases() -> Vec<Case> {
    let mut all: Vec<Case> = PAIRS.map(|(name, one, other)| pair(name, one, other)).into();
    all.extend(members(Family::Punch).map(|info| slope(info.name, info.example)));
    all
}

/// The slope, which contacts are solved with, is that of the height, which indentations are counted from.
fn slope(name: &'static str, example: &'static str) -> Case {
    Case::new(format!("slope of a {name} punch"), move |sheet| {
        let scene = Contact::flat(layer(2.0, 1.0, 0.3)).under(example).loaded("force = 1.0").scene()?;
        let shape = scene.punch.shape().map_err(|refusal| refusal.to_string())?;
        let unit = shape.natural_length().min(shape.reach().unwrap_or(f64::INFINITY));
        let mut errors = Vec::new();
        let mut largest = f64::MIN_POSITIVE;
        // Away from the kinks that the examples have: at 1/2 and 1, if any.
        for x in [0.11, 0.31, 0.67, 0.87].map(|x| x * unit) {
            let central = |step: f64| (shape.height(x + step) - shape.height(x - step)) / (2.0 * step);
            let step = 0.01 * x;
            errors.push((4.0 * central(0.5 * step) - central(step)) / 3.0 - shape.slope(x));
            largest = largest.max(shape.slope(x).abs());
        }
        let name = format!("{name}: slope against differences of the height, worst of 4 points over the largest");
        let within = Within::new(1e-9, "steps of 1 %: their fourth power, 1e-8, over 480, times a fifth derivative");
        sheet.error(&name, worst(errors) / largest, within, "differences");
        Ok(())
    })
}

fn pair(name: &'static str, one: &'static str, other: &'static str) -> Case {
    Case::new(name, move |sheet| {
        if one.contains("formula") && !has(Family::Punch, "formula") {
            return Ok(());
        }
        let x = [0.1, 0.5, 0.9];
        let solve = |punch: &str| Contact::flat(layer(2.0, 8.0, 0.3)).under(punch).rubbing(0.3).at(&x).to(1e-8).solve();
        let (one, other) = (solve(one)?, solve(other)?);
        // A table is given by decimal fractions of its heights and smoothed.
        let within = || Within::new(2e-8, "the solver's own tolerance, 1e-8, of both");
        for (path, expected) in numbers(&other) {
            if path == "load.half_width" {
                continue;
            }
            sheet.relative(&format!("{name}: {path}"), number(&one, path)?, expected, within(), "the punch imitated");
        }
        for (what, one, other) in [
            ("pressure", Some(&one.profile.pressure), Some(&other.profile.pressure)),
            ("shear", one.profile.shear.as_ref(), other.profile.shear.as_ref()),
        ] {
            let (one, other) = (one.ok_or("a traction is missing")?, other.ok_or("a traction is missing")?);
            let other: Vec<f64> = other.iter().map(|traction| traction.unwrap_or(f64::NAN)).collect();
            let name = format!("{name}: {what}, worst of 3 points over the largest");
            sheet.error(&name, off(one, &other), within(), "the punch imitated");
        }
        Ok(())
    })
}
