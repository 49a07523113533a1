//! Surface flexibilities `s F/A0`.

use crate::engine::response;
use crate::scene::example::least;
use crate::scene::parse;
use crate::verify::Case;
use crate::verify::check::{Within, worst};
use crate::verify::contact::{A0, BETA, has, members};
use crate::verify::layers::{BASES, WAVES, compliance, distance, promised, respond};
use crate::verify::references::{cases as entries, list};
use serde_json::{Value, json};
use slipzone_api::reference::homogeneous_layer::bonded;
use slipzone_api::{Elastic, Family, Plane, SurfaceFlexibility};

/// Waves that a method is to give, at least.
const ENOUGH: usize = 20;
/// 40 to 100 digits by Taylor steps.
const TABLE: &str = include_str!("../../../tests/data/flexibilities.json");

pub(super) fn cases() -> Vec<Case> {
    let mut all = Vec::new();
    for info in members(Family::Flexibility) {
        let table = least(info, None);
        all.push(Case::new(format!("closed forms by {}", info.name), move |sheet| {
            for nu in [-0.99, 0.0, 0.3, 0.45, 0.5] {
                let layer = format!("thickness = 2.0\npoisson = {nu:?}\n{PLAIN}");
                // A method may refuse a layer or a wave; what it gives must be right.
                let Ok(response) = respond(&layer, &table) else { continue };
                let elastic = Elastic::of(Plane::Strain, nu);
                let found = |w| response.surface(w).ok().map(|found| distance(found, bonded(elastic, w)));
                let errors: Vec<f64> = WAVES.into_iter().filter_map(found).collect();
                if errors.is_empty() {
                    continue; // the published route; that it gives anything is checked against compliance
                }
                let name =
                    format!("{}: homogeneous bonded layer, nu = {nu}, worst of {} waves", info.name, errors.len());
                let within = Within::new(1e-12, "slices and exponentials are good to some hundred roundings");
                sheet.error(&name, worst(errors), within, "Johnson (1985) sec. 5.8, (kappa sinh 2w - 2w)/D");
            }
            Ok(())
        }));
        all.push(against_compliance(info.name, least(info, None)));
    }
    all.extend([sliding(), long_waves(), own_substrate(), against_datum()]);
    all.extend(SERIES.map(|(name, layer)| series(name, layer)));
    all.extend(entries("flexibilities.json", TABLE, tabulated));
    all
}

const PLAIN: &str = "grading = { type = \"homogeneous\", modulus = 1.0 }";

/// Each method against the one that serves every layer.
fn against_compliance(method: &'static str, table: String) -> Case {
    Case::new(format!("{method} against compliance"), move |sheet| {
        let mut compared = 0;
        for (base, line) in BASES {
            for ratio in [0.125, 1.5, 8.0, 1e4] {
                let layer = format!(
                    "{line}thickness = 2.0\npoisson = 0.3\n\
                     grading = {{ type = \"exponential\", surface = 1.0, base = {:?} }}",
                    1.0 / ratio
                );
                let Ok(one) = respond(&layer, &table) else { continue };
                let other = compliance(&layer)?;
                let mut errors = Vec::new();
                for s in WAVES {
                    // The published route overflows for short waves, and says so.
                    let Ok(one) = one.surface(s) else { continue };
                    errors.push(distance(one, other.surface(s).map_err(|refusal| refusal.to_string())?));
                }
                compared += errors.len();
                let name =
                    format!("{method} against compliance: {base}, mu1/mu3 = {ratio}, worst of {} waves", errors.len());
                sheet.error(&name, worst(errors), promised(method), "another method");
            }
        }
        sheet.compared(&format!("{method} against compliance: waves"), compared, ENOUGH);
        Ok(())
    })
}

/// `2 sinh^2 w/(2w + sinh 2w)`, whatever Poisson's ratio.
fn sliding() -> Case {
    Case::new("layer that slides on its base", |sheet| {
        for nu in [-0.99, 0.0, 0.3, 0.5] {
            let layer = format!("thickness = 2.0\npoisson = {nu:?}\nbase = {{ type = \"frictionless\" }}\n{PLAIN}");
            let response = compliance(&layer)?;
            let mut errors = Vec::new();
            for w in WAVES {
                // In decaying exponentials.
                let once = -(-2.0 * w).exp_m1();
                let exact = once * once / (once * (1.0 + (-2.0 * w).exp()) + 4.0 * w * (-2.0 * w).exp());
                errors.push(response.surface(w).map_err(|refusal| refusal.to_string())?.vv / exact - 1.0);
            }
            let within = Within::new(1e-13, "slices are good to a few roundings");
            let name = format!("frictionless base, nu = {nu}: s Fvv/A0, worst of 15 waves");
            sheet.error(&name, worst(errors), within, "2 sinh^2 w/(2w + sinh 2w), docs/theory.md section 7");
        }
        Ok(())
    })
}

/// `Fvv(0) = int (kappa - 1)/((kappa + 1) mu) dy`, `Fuu(0) = int dy/mu` on a bonded layer.
fn long_waves() -> Case {
    Case::new("long waves", |sheet| {
        // name, grading, (1/h) int mu1/mu dy
        let laws = [
            ("homogeneous", "{ type = \"homogeneous\", modulus = 2.0 }", 1.0),
            ("exponential to 8", "{ type = \"exponential\", surface = 1.0, base = 8.0 }", 7.0 / 8.0 / 8.0_f64.ln()),
            ("exponential to 1/8", "{ type = \"exponential\", surface = 1.0, base = 0.125 }", 7.0 / 8.0_f64.ln()),
            ("linear to 5", "{ type = \"linear\", surface = 1.0, base = 5.0 }", 5.0_f64.ln() / 4.0),
            // int_0^3 (1 + y/2)^-2 dy/3 = 2 (1 - 1/2.5)/3
            ("power law", "{ type = \"power-law\", surface = 1.0, length = 2.0, exponent = 2.0 }", 0.4),
            (
                "stack",
                "{ type = \"stack\", layers = [{ thickness = 1.0, grading = { type = \"homogeneous\", modulus = 1.0 } }, \
                 { thickness = 2.0, grading = { type = \"homogeneous\", modulus = 4.0 } }] }",
                0.5,
            ),
        ];
        for (name, grading, softness) in laws {
            let response = compliance(&format!("thickness = 3.0\npoisson = 0.3\ngrading = {grading}"))?;
            let s = 1e-6;
            let found = response.surface(s).map_err(|refusal| refusal.to_string())?;
            let source = "integral of the compliance over the depth, docs/theory.md section 2";
            let within = || Within::new(1e-10, "s^2 = 1e-12 is left out, times factors of order ten");
            let name = |what: &str| format!("{name} layer: {what}(0)");
            sheet.relative(&name("Fvv"), found.vv / s, BETA * softness / A0, within(), source);
            sheet.relative(&name("Fuu"), found.uu / s, softness / A0, within(), source);
        }
        Ok(())
    })
}

/// A substrate of the layer's own material.
fn own_substrate() -> Case {
    Case::new("substrate of the layer's material", |sheet| {
        for nu in [0.0, 0.3, 0.5] {
            let layer = format!(
                "thickness = 0.7\npoisson = {nu:?}\nbase = {{ type = \"half-plane\", shear = 2.0, poisson = {nu:?} }}\n\
                 grading = {{ type = \"homogeneous\", modulus = 2.0 }}"
            );
            let response = compliance(&layer)?;
            let half_plane = SurfaceFlexibility { vv: 1.0, uu: 1.0, uv: -(1.0 - 2.0 * nu) / (2.0 - 2.0 * nu) };
            let mut errors = Vec::new();
            for s in WAVES {
                errors.push(distance(response.surface(s).map_err(|refusal| refusal.to_string())?, half_plane));
            }
            let name = format!("substrate of the layer's own material, nu = {nu}: worst of 15 waves");
            let within = Within::new(1e-13, "rounding of the slices");
            sheet.error(&name, worst(errors), within, "it is a half-plane: 1, 1, -beta");
        }
        Ok(())
    })
}

/// `1 - exp(-s d) (1 + 2 s d/(kappa + 1))`, wherever the solid is cut.
fn against_datum() -> Case {
    Case::new("against a datum", |sheet| {
        for (datum, h) in [(0.3, 1.0), (1.0, 0.2), (5.0, 1.0), (5.0, 80.0)] {
            let base = "base = { type = \"half-plane\", shear = 1.0, poisson = 0.3 }";
            let layer = format!("thickness = {h:?}\npoisson = 0.3\n{base}\ndatum = {datum:?}\n{PLAIN}");
            let response = compliance(&layer)?.against_datum().ok_or("the datum is not known")?;
            let mut errors = Vec::new();
            for phase in [1e-4, 0.01, 0.1, 0.3, 1.0, 3.0, 8.0, 20.0, 30.0, 100.0_f64] {
                let found = response.surface(phase * h / datum).map_err(|refusal| refusal.to_string())?.vv;
                let exact = -(-phase).exp_m1() - (-phase).exp() * phase / (2.0 * A0);
                // The difference of two depths leaves a rounding over the phase.
                errors.push((found / exact - 1.0) / (1.0 + 1.0 / phase));
            }
            let name = format!("datum {datum}, cut at {h}: s Fvv/A0, worst of 10 waves");
            let within = Within::new(1e-13, "rounding, over the phase where it is small");
            sheet.error(
                &name,
                worst(errors),
                within,
                "1 - exp(-s d) (1 + 2 s d/(kappa + 1)), docs/theory.md section 7",
            );
        }
        Ok(())
    })
}

/// Layers whose series in `1/s` is compared with the flexibility itself; what the base adds at `s h = 36` is 1e-31.
const SERIES: [(&str, &str); 8] = [
    (
        "exponential to 8",
        "thickness = 1.0\npoisson = 0.3\ngrading = { type = \"exponential\", surface = 1.0, base = 8.0 }",
    ),
    (
        "exponential to 1/8",
        "thickness = 1.0\npoisson = 0.1\ngrading = { type = \"exponential\", surface = 1.0, base = 0.125 }",
    ),
    ("linear", "thickness = 1.0\npoisson = 0.3\ngrading = { type = \"linear\", surface = 1.0, base = 3.0 }"),
    (
        "power law",
        "thickness = 1.0\npoisson = 0.45\ngrading = { type = \"power-law\", surface = 1.0, length = 0.5, exponent = 1.7 }",
    ),
    (
        "sigmoid",
        "thickness = 1.0\npoisson = 0.3\ngrading = { type = \"sigmoid\", above = 1.0, below = 4.0, centre = 0.4, width = 0.5 }",
    ),
    (
        "mixture of two Poisson's ratios",
        "thickness = 1.0\npoisson = 0.3\ngrading = { type = \"volume-fraction\", surface = { modulus = 1.0, poisson = 0.35 }, \
         base = { modulus = 3.0, poisson = 0.2 }, exponent = 1.0, rule = \"mori-tanaka\" }",
    ),
    (
        "mixture of two Poisson's ratios in plane stress",
        "thickness = 1.0\npoisson = 0.3\nplane = \"stress\"\ngrading = { type = \"volume-fraction\", \
         surface = { modulus = 1.0, poisson = 0.45 }, base = { modulus = 3.0, poisson = -0.3 }, exponent = 1.0, \
         rule = \"mixture\" }",
    ),
    (
        "mixture of two Poisson's ratios and Young's moduli in plane stress",
        "thickness = 1.0\npoisson = 0.3\nplane = \"stress\"\nmoduli = \"young\"\ngrading = { type = \"volume-fraction\", \
         surface = { modulus = 1.0, poisson = 0.45 }, base = { modulus = 3.0, poisson = 0.1 }, exponent = 1.0, \
         rule = \"mori-tanaka\" }",
    ),
];

/// The recursion of the series knows nothing of the layer's base, the flexibility nothing of the series.
fn series(name: &'static str, layer: &'static str) -> Case {
    Case::new(format!("series of {name}"), move |sheet| {
        let response = compliance(layer)?;
        let terms = response.tail(14);
        let beta = response.elastic().beta();
        let mut errors = Vec::new();
        let mut left_out = 0.0_f64;
        for s in [36.0, 50.0, 80.0_f64] {
            let found = response.surface(s).map_err(|refusal| refusal.to_string())?;
            // From the last term inwards.
            let sum = terms.iter().rev().fold(SurfaceFlexibility::default(), |sum, term| SurfaceFlexibility {
                vv: (sum.vv + term.vv) / s,
                uu: (sum.uu + term.uu) / s,
                uv: (sum.uv + term.uv) / s,
            });
            let series = SurfaceFlexibility { vv: 1.0 + sum.vv, uu: 1.0 + sum.uu, uv: sum.uv - beta };
            errors.push(distance(series, found));
            let last = terms.last().copied().unwrap_or_default();
            left_out = left_out.max(worst([last.vv, last.uu, last.uv]) / s.powi(14));
        }
        let tolerance = 1e-11 + 2.0 * left_out;
        let name = format!("{name}: 14 terms of the series in 1/s, worst of 3 waves");
        let within =
            Within::new(tolerance, "1e-11 that the flexibility promises, and twice the last term of the series");
        sheet.error(&name, worst(errors), within, "the flexibility itself");
        Ok(())
    })
}

/// An entry of the table, by every method that accepts its layer.
fn tabulated(case: Value, _: usize) -> Case {
    let about = case["about"].as_str().unwrap_or("an entry without a name").to_owned();
    Case::new(format!("table: {about}"), move |sheet| {
        if case["grading"]["type"] == "formula" && !has(Family::Grading, "formula") {
            return Ok(());
        }
        let keys = ["thickness", "poisson", "plane", "moduli", "base", "grading"];
        let given = keys.into_iter().filter(|key| !case[*key].is_null());
        let layer: Value =
            given.map(|key| (key.to_owned(), case[key].clone())).collect::<serde_json::Map<_, _>>().into();
        let [waves, vv, uu, uv] = ["s", "vv", "uu", "uv"].map(|key| list(&case, key));
        let (waves, vv, uu, uv) = (waves?, vv?, uu?, uv?);
        for info in members(Family::Flexibility) {
            let method: Value =
                toml::from_str(&format!("flexibility = {}", least(info, None))).map_err(|error| error.to_string())?;
            let scene = json!({
                "format": 1, "layer": layer, "solver": method,
                "punch": { "type": "flat", "half_width": 1.0 }, "load": { "force": 1.0 },
            });
            let text = toml::to_string(&scene).map_err(|error| error.to_string())?;
            let scene = parse("check", &text).map_err(|error| error.to_string())?;
            let within = promised(info.name);
            let response = match response(&scene) {
                Ok(response) => response,
                Err(_) if info.name != "compliance" => continue,
                Err(why) => return Err(why.to_string()),
            };
            let mut errors = Vec::new();
            for (i, s) in waves.iter().enumerate() {
                let (Some(vv), Some(uu), Some(uv)) = (vv.get(i), uu.get(i), uv.get(i)) else {
                    return Err("columns of unequal length".into());
                };
                let expected = SurfaceFlexibility { vv: *vv, uu: *uu, uv: *uv };
                match response.surface(*s) {
                    Ok(found) => errors.push(distance(found, expected)),
                    Err(_) if info.name != "compliance" => {}
                    Err(why) => return Err(why.to_string()),
                }
            }
            if errors.is_empty() {
                continue;
            }
            let name = format!("{about}, by {}: worst of {} waves", info.name, errors.len());
            sheet.error(&name, worst(errors), within, "tests/data/flexibilities.json, 100-digit Taylor steps");
        }
        Ok(())
    })
}
