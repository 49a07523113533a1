//! Brings the parts of a drawn scene together: what no key by itself can know. A part that this knows nothing of stays
//! as it was drawn.

use super::dice::Dice;
use super::formulas::Examples;
use super::units;
use slipzone::api::{PunchProfile, PunchShape};
use toml::{Table, Value};

/// Makes a scene that can most often be solved.
pub(crate) fn make(dice: &mut Dice, scene: &mut Table) {
    let mut layer = take(scene, "layer");
    let base = kind(layer.get("base")).unwrap_or_else(|| "rigid".into());
    let thickness = match dice.roll() {
        roll if roll < 0.03 => dice.log(0.05, 1.0),
        roll if roll < 0.85 => dice.log(1.0, 30.0),
        _ => dice.log(1.0, 1e5),
    };
    settle_layer(dice, &mut layer, &base, thickness);

    let mut punch = take(scene, "punch");
    if kind(Some(&Value::Table(punch.clone()))).as_deref() == Some("table") && punch.contains_key("points") {
        punch.insert("points".into(), heights(dice));
    }
    let shape = shape(&punch);
    let is_sharp = shape.as_ref().is_some_and(|shape| shape.fixed_half_width().is_some());
    let has_depth = matches!(base.as_str(), "rigid" | "frictionless") || layer.contains_key("datum");
    if let Some(Value::Table(load)) = scene.get_mut("load") {
        settle_load(dice, load, shape.as_deref(), is_sharp, has_depth);
    }
    if let Some(Value::Table(friction)) = scene.get_mut("friction") {
        // A tip that is smooth and no face: what a strain C|x| is for.
        let is_smooth = shape
            .as_ref()
            .is_some_and(|shape| shape.fixed_half_width().is_none() && shape.face() == 0.0 && shape.kinks().is_empty());
        friction.insert("coefficient".into(), dice.log(0.02, 1.5).into());
        if !is_smooth {
            friction.remove("strain");
        }
    }
    if let Some(Value::Table(solver)) = scene.get_mut("solver") {
        settle_solver(dice, solver);
    }
    if let Some(Value::Table(output)) = scene.get_mut("output")
        && output.contains_key("quantities")
    {
        output.remove("strain");
    }
    scene.insert("layer".into(), layer.into());
    scene.insert("punch".into(), punch.into());
}

fn take(scene: &mut Table, key: &str) -> Table {
    match scene.remove(key) {
        Some(Value::Table(table)) => table,
        _ => Table::new(),
    }
}

/// The `type` of a table.
pub(crate) fn kind(table: Option<&Value>) -> Option<String> {
    table?.get("type")?.as_str().map(str::to_owned)
}

/// The shape of a punch by itself.
fn shape(punch: &Table) -> Option<Box<dyn PunchShape>> {
    let mut profile: Box<dyn PunchProfile> = Value::Table(punch.clone()).try_into().ok()?;
    profile.read(&Examples).ok()?;
    profile.shape().ok()
}

fn settle_layer(dice: &mut Dice, layer: &mut Table, base: &str, thickness: f64) {
    let mut grading = take(layer, "grading");
    if base == "infinite" {
        layer.remove("thickness");
        grading = if dice.chance(0.3) {
            table([("type", "homogeneous".into()), ("modulus", 1.0.into())])
        } else {
            let gradient = dice.log(1e-3, 1.0) * if dice.chance(0.5) { 1.0 } else { -1.0 };
            table([("type", "exponential".into()), ("surface", 1.0.into()), ("gradient", gradient.into())])
        };
    } else {
        let own = settle_grading(dice, &mut grading, thickness);
        if own {
            layer.remove("thickness");
        } else {
            layer.insert("thickness".into(), thickness.into());
        }
    }
    let grounded = matches!(base, "rigid" | "frictionless")
        || base == "infinite"
            && grading.get("gradient").and_then(Value::as_float).is_some_and(|gradient| gradient > 0.0);
    if grounded {
        layer.remove("datum");
    }
    layer.insert("grading".into(), grading.into());
}

fn table<const N: usize>(entries: [(&str, Value); N]) -> Table {
    entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

/// Stretches a grading to a thickness; whether it has one of its own.
fn settle_grading(dice: &mut Dice, grading: &mut Table, thickness: f64) -> bool {
    if let Some(Value::Array(layers)) = grading.get_mut("layers") {
        let shares: Vec<f64> = layers.iter().map(|_| dice.log(0.1, 1.0)).collect();
        let total: f64 = shares.iter().sum();
        for (piece, share) in layers.iter_mut().zip(shares) {
            let Value::Table(piece) = piece else { continue };
            let part = thickness * share / total;
            let own = match piece.get_mut("grading") {
                Some(Value::Table(grading)) => {
                    let own = settle_grading(dice, grading, part);
                    own.then(|| thickness_of(grading)).flatten()
                }
                _ => None,
            };
            piece.insert("thickness".into(), own.unwrap_or(part).into());
        }
        return true;
    }
    match kind(Some(&Value::Table(grading.clone()))).as_deref() {
        Some("table") => {
            let columns = dice.whole(2, 3);
            let rows = dice.whole(4, 9);
            let end = dice.log(0.2, 5.0).ln();
            let row = |dice: &mut Dice, i: u64| {
                let y = i as f64 / (rows - 1) as f64;
                let mut row = vec![thickness * y, (end * y + dice.between(-0.05, 0.05)).exp()];
                if columns == 3 {
                    row.push(0.3 - 0.1 * y);
                }
                Value::from(row)
            };
            let points: Vec<Value> = (0..rows).map(|i| row(dice, i)).collect();
            *grading = table([("type", "table".into()), ("points", points.into())]);
        }
        // Other exponents are known to be refused, slowly.
        Some("volume-fraction") => {
            grading.insert("exponent".into(), (*dice.one_of(&[1.0, 1.0, 2.0, 2.0, 3.0])).into());
        }
        // What is drawn near samples belongs to a layer of about 2.
        Some(name) if name != "formula" => {
            let info = slipzone::api::find(slipzone::api::Family::Grading, name);
            if let Some(scaled) = info.and_then(|info| units::scaled(grading, info.parameters, [0.5 * thickness, 1.0]))
            {
                *grading = scaled;
            }
        }
        _ => {}
    }
    false
}

/// The sum of a stack's sublayers.
pub(crate) fn thickness_of(grading: &Table) -> Option<f64> {
    let layers = grading.get("layers")?.as_array()?;
    layers.iter().map(|piece| piece.get("thickness")?.as_float()).sum()
}

/// Heights of a convex shape at points that begin in the middle.
fn heights(dice: &mut Dice) -> Value {
    let (exponent, scale, count) = (dice.between(1.5, 4.0), dice.log(0.05, 1.0), dice.whole(4, 14));
    let row = |i: u64| {
        let x = 4.0 * i as f64 / (count - 1) as f64;
        Value::from(vec![x, scale * x.powf(exponent)])
    };
    (0..count).map(row).collect::<Vec<_>>().into()
}

/// A load that the punch can bear: a contact about as wide as 1.
fn settle_load(dice: &mut Dice, load: &mut Table, shape: Option<&dyn PunchShape>, is_sharp: bool, has_depth: bool) {
    let width = shape.map_or(1.0, |shape| {
        let room = shape.reach().unwrap_or(f64::INFINITY);
        (shape.face() * dice.between(1.01, 2.0)).max(dice.log(0.2, 2.0)).min(0.9 * room)
    });
    let depth = shape.map_or(0.1, |shape| shape.height(width).abs().max(1e-3)) * dice.log(0.7, 1.5);
    let steep = shape.map_or(1.0, |shape| width * shape.slope(width).abs().max(1e-3));
    let force = if is_sharp { dice.log(0.01, 100.0) } else { steep * dice.log(0.5, 3.0) };
    let mut allowed = vec![("force", force)];
    if !is_sharp {
        allowed.extend([("half_width", width), ("half_width", width)]);
    }
    if has_depth {
        allowed.push(("indentation", depth));
    }
    let (key, most) = *dice.one_of(&allowed);
    let by_curve = dice.chance(0.25);
    if let Some(Value::Table(until)) = load.get_mut("until").filter(|_| by_curve) {
        *until = table([(key, most.into()), ("points", 5.into())]);
    } else if load.contains_key("path") && by_curve {
        let face = shape.map_or(0.0, PunchShape::face);
        let least = if key == "half_width" { face } else { 0.0 };
        let steps = dice.whole(1, 5);
        let loads: Vec<f64> = (1..=steps).map(|i| least + (most - least) * i as f64 / steps as f64).collect();
        load.insert("path".into(), table([(key, loads.into())]).into());
    } else {
        *load = table([(key, most.into())]);
    }
}

/// Methods now and then, and a tolerance that they may meet.
fn settle_solver(dice: &mut Dice, solver: &mut Table) {
    let kept = if dice.chance(0.3) {
        (*dice.one_of(&["flexibility", "kernel", "quadrature", "model", "forbid"])).to_owned()
    } else {
        String::new()
    };
    solver.retain(|key, _| key == kept);
    if let Some(Value::Table(method)) = solver.get_mut(&kept)
        && dice.chance(0.5)
    {
        method.retain(|key, _| key == "type");
    }
    let finest = if dice.chance(0.2) { 1e-10 } else { 1e-6 };
    solver.insert("tolerance".into(), dice.log(finest, 1e-2).into());
}
