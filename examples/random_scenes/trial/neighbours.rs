//! Scenes whose answers follow from that of another.

use super::{Case, Dice, ROUNDING, agree, formulas, sense, set, units as other_units, write_all};
use slipzone::engine::{Solution, Status};
use slipzone::scene::KEYS;
use toml::{Table, Value};

/// Other units, no powers of two: all numbers by their dimensions.
pub(super) fn units(case: &Case, dice: &mut Dice) -> Result<bool, String> {
    let factors = [dice.log(1e-3, 1e3), dice.log(1e-3, 1e3)];
    let Some(table) = other_units::scaled(&case.table, KEYS, factors) else { return Ok(false) };
    let Some(other) = case.other(|changed| *changed = table) else { return Ok(false) };
    let [length, stress] = factors;
    if other.status != Status::Converged {
        // At the brink of what can be told, rounding decides.
        return brink(&case.found, &other, "in other units");
    }
    let factor = |path: &str| match path {
        "load.force" => length * stress,
        "load.half_width" | "load.indentation" | "stick.half_width" => length,
        "edge.stress_intensity" => stress * length.sqrt(),
        "stick.strain_rate" => length.recip(),
        _ if path.starts_with("pressure") => stress,
        _ => 1.0,
    };
    agree(&case.found, &other, factor).map(|()| true)
}

/// Whether a neighbour that is not converged misses its tolerance by little.
fn brink(found: &Solution, other: &Solution, what: &str) -> Result<bool, String> {
    let tolerance = found.scene.solver.tolerance.get();
    let is_near = other.error.estimate.is_some_and(|error| error < 30.0 * tolerance);
    let is_cut_off = other.reason.as_deref().is_some_and(|reason| reason.contains("than its budget"));
    if other.status == Status::NotConverged && is_near || is_cut_off {
        return Ok(false);
    }
    Err(format!("converged, but {what}: {:?}, {:?}", other.status, other.reason))
}

/// The pressure is even, the shear odd; a formula in `-x` is the same shape.
pub(super) fn mirror(case: &Case, _dice: &mut Dice) -> Result<bool, String> {
    const AT: [f64; 10] = [-0.999, -0.9, -0.5, -0.1, -1e-3, 1e-3, 0.1, 0.5, 0.9, 0.999];
    let Some(found) = case.found(|table| write_all(table, &AT)) else { return Ok(false) };
    let shear = found.profile.shear.clone().unwrap_or_default();
    for (values, sign, name) in [(&found.profile.pressure, 1.0, "p"), (&shear, -1.0, "q")] {
        for (index, value) in values.iter().enumerate() {
            let mirrored = values[AT.len() - 1 - index];
            let (Some(one), Some(other)) = (value, mirrored) else {
                if value.is_none() && mirrored.is_none() {
                    continue;
                }
                return Err(format!("{name} is known on one side of x = {} alone", AT[index]));
            };
            if (one - sign * other).abs() > 1e-12 * one.abs() {
                return Err(format!("{name}({}) = {one:e}, {name}({}) = {other:e}", AT[index], -AT[index]));
            }
        }
    }
    let punch = case.table.get("punch").and_then(Value::as_table);
    let Some((key, text)) = punch.and_then(|punch| {
        let key = ["height", "slope"].into_iter().find(|key| punch.get(*key).is_some_and(Value::is_str))?;
        Some((key, punch.get(key)?.as_str()?.to_owned()))
    }) else {
        return Ok(true);
    };
    let sign = if key == "slope" { "-" } else { "" };
    let mirrored = format!("{sign}({})", formulas::replaced(&text, "x", "(-x)"));
    let Some(other) = case.other(|table| set(table, &["punch", key], mirrored)) else {
        return Err(format!("`{text}` is a punch, but not in -x"));
    };
    if other.status != Status::Converged {
        return brink(&case.found, &other, "mirrored");
    }
    agree(&case.found, &other, |_| 1.0).map(|()| true)
}

/// A layer cut into equal parts is the same layer.
pub(super) fn merged(case: &Case, dice: &mut Dice) -> Result<bool, String> {
    let layer = case.table.get("layer").and_then(Value::as_table);
    let parts = dice.whole(2, 4);
    let cut = layer.and_then(|layer| {
        let grading = layer.get("grading")?.as_table()?;
        let thickness = case.scene.layer.thickness?.get();
        let poisson = case.scene.layer.poisson.get();
        (sense::kind(layer.get("base")).as_deref() != Some("infinite")).then_some(())?;
        cut_up(grading, thickness, poisson, parts)
    });
    let Some(pieces) = cut else { return Ok(false) };
    let mut stack = Table::new();
    stack.insert("type".into(), "stack".into());
    stack.insert("layers".into(), pieces.into());
    let other = case.other(|table| {
        if let Some(Value::Table(layer)) = table.get_mut("layer") {
            layer.remove("thickness");
            layer.insert("grading".into(), stack.into());
        }
        if let Some(Value::Table(solver)) = table.get_mut("solver") {
            // What serves one grading may not serve a stack, or claims less of it.
            solver.remove("flexibility");
            solver.remove("model");
        }
    });
    let Some(other) = other else { return Ok(false) };
    if other.status != Status::Converged {
        return brink(&case.found, &other, "cut into sublayers");
    }
    agree(&case.found, &other, |_| 1.0).map(|()| true)
}

/// The sublayers that a grading consists of; `None` where that is not known.
fn cut_up(grading: &Table, thickness: f64, poisson: f64, parts: u64) -> Option<Vec<Value>> {
    let number = |key: &str| grading.get(key).and_then(Value::as_float);
    let kind = grading.get("type")?.as_str()?;
    let h = thickness / parts as f64;
    let share = |k: u64| k as f64 / parts as f64;
    let one = |k: u64| -> Option<Value> {
        let mut own = grading.clone();
        let mut put = |key: &str, value: f64| own.insert(key.into(), value.into());
        match kind {
            "homogeneous" => {}
            "exponential" => {
                let (surface, rate) = match (number("base"), number("gradient")) {
                    (Some(base), _) => (number("surface")?, (base / number("surface")?).ln()),
                    (None, gradient) => (number("surface")?, gradient? * thickness),
                };
                put("surface", surface * (rate * share(k)).exp());
                own.remove("gradient");
                own.insert("base".into(), (surface * (rate * share(k + 1)).exp()).into());
            }
            "linear" => {
                let (surface, base) = (number("surface")?, number("base")?);
                put("surface", surface * (1.0 - share(k)) + base * share(k));
                put("base", surface * (1.0 - share(k + 1)) + base * share(k + 1));
            }
            "power-law" => {
                let (surface, length, exponent) = (number("surface")?, number("length")?, number("exponent")?);
                put("surface", surface * (exponent * (share(k) * thickness / length).ln_1p()).exp());
                put("length", length + share(k) * thickness);
            }
            "sigmoid" | "error-function" => {
                put("centre", number("centre")? - share(k) * thickness);
            }
            "formula" => {
                for key in ["modulus", "poisson"] {
                    if let Some(text) = grading.get(key).and_then(Value::as_str) {
                        let text = formulas::replaced(text, "h", &format!("{thickness:?}"));
                        let text = formulas::replaced(&text, "y", &format!("(y + {:?})", share(k) * thickness));
                        own.insert(key.into(), text.into());
                    }
                }
            }
            _ => return None,
        }
        let mut piece = Table::new();
        piece.insert("thickness".into(), h.into());
        piece.insert("poisson".into(), poisson.into());
        piece.insert("grading".into(), own.into());
        Some(piece.into())
    };
    (0..parts).map(one).collect()
}

/// A larger coefficient of friction makes no smaller stick zone.
pub(super) fn stick(case: &Case, dice: &mut Dice) -> Result<bool, String> {
    let Some(here) = case.found.stick.as_ref().and_then(|stick| stick.one_minus_ratio) else { return Ok(false) };
    let Some(eta) = case.table["friction"].get("coefficient").and_then(Value::as_float) else { return Ok(false) };
    let more = eta * dice.between(1.05, 1.5);
    let Some(other) = case.found(|table| set(table, &["friction", "coefficient"], more)) else { return Ok(false) };
    let Some(there) = other.stick.as_ref().and_then(|stick| stick.one_minus_ratio) else { return Ok(false) };
    let error = |solution: &Solution| solution.error.each.get("stick.one_minus_ratio").copied().unwrap_or(0.0);
    let allowed = 3.0 * (error(&case.found) + error(&other)) + ROUNDING;
    let turned = case.found.stick.as_ref().map(|stick| stick.slip) != other.stick.as_ref().map(|stick| stick.slip);
    if there <= here * (1.0 + allowed) || turned {
        return Ok(true);
    }
    Err(format!("1 - a/b is {here:e} at {eta}, {there:e} at {more}"))
}

/// A wider contact takes more force, and sinks in deeper.
pub(super) fn wider(case: &Case, dice: &mut Dice) -> Result<bool, String> {
    let Some(half_width) = case.table["load"].get("half_width").and_then(Value::as_float) else { return Ok(false) };
    let more = half_width * dice.between(1.02, 1.3);
    let Some(other) = case.found(|table| set(table, &["load", "half_width"], more)) else { return Ok(false) };
    for (one, more, what) in [
        (case.found.load.force, other.load.force, "force"),
        (case.found.load.indentation, other.load.indentation, "indentation"),
    ] {
        let (Some(one), Some(more)) = (one, more) else { continue };
        // Against a datum the indentation may fall.
        if more <= one && (what == "force" || case.scene.layer.datum.is_none()) {
            return Err(format!("the {what} is {one:e} at {half_width}, {more:e} at a larger half-width"));
        }
    }
    Ok(true)
}

/// Under a flat punch all tractions grow with the load, and the stick zone stays.
pub(super) fn linear(case: &Case, dice: &mut Dice) -> Result<bool, String> {
    let is_sharp = case.scene.punch.shape().is_ok_and(|shape| shape.fixed_half_width().is_some());
    let load = case.table["load"]
        .as_table()
        .and_then(|load| load.iter().next().map(|(key, value)| (key.clone(), value.as_float())));
    let Some((key, Some(value))) = load.filter(|_| is_sharp) else { return Ok(false) };
    let times = dice.log(0.01, 100.0);
    let Some(other) = case.other(|table| set(table, &["load", &key], times * value)) else { return Ok(false) };
    if other.status != Status::Converged {
        return brink(&case.found, &other, "under another load");
    }
    let factor = |path: &str| match path {
        "load.force" | "load.indentation" | "edge.stress_intensity" => times,
        _ if path.starts_with("pressure") => times,
        _ => 1.0,
    };
    agree(&case.found, &other, factor).map(|()| true)
}

/// A load on a curve is the load by itself.
pub(super) fn curve(case: &Case, dice: &mut Dice) -> Result<bool, String> {
    let (Some(curve), Some(path)) = (&case.found.path, &case.scene.path) else { return Ok(false) };
    #[allow(clippy::cast_possible_truncation)] // an index
    let index = dice.whole(0, curve.points() as u64 - 1) as usize;
    let (load, key) = (path.load(index).value().get(), path.kind().key());
    let mut alone = Table::new();
    alone.insert(key.into(), load.into());
    let Some(other) = case.found(|table| set(table, &["load"], alone)) else { return Ok(false) };
    let at = |column: &Option<Vec<Option<f64>>>| column.as_ref().and_then(|column| column[index]);
    let pairs = [
        (curve.force[index], other.load.force, "force"),
        (curve.half_width[index], other.load.half_width, "half-width"),
        (at(&curve.indentation), other.load.indentation, "indentation"),
        (at(&curve.stick_ratio), other.stick.as_ref().and_then(|stick| stick.ratio), "stick ratio"),
    ];
    let allowed = 3.0 * (curve.error.unwrap_or(0.0) + other.error.estimate.unwrap_or(0.0)) + ROUNDING;
    for (one, other, what) in pairs {
        let (Some(one), Some(other)) = (one, other) else { continue };
        if (one - other).abs() > allowed * other.abs() {
            return Err(format!(
                "{what} at {key} = {load:e}: {one:e} on the curve, {other:e} alone, allowed {allowed:.1e}"
            ));
        }
    }
    Ok(true)
}
