//! The surface flexibility of every grading on every base, asked for roughly, against values of
//! `tests/data/flexibilities.py`, which shares no code with the plugins. As good as can be it is checked by `verify`.

use serde_json::{Value, json};
use slipzone::api::{Flexibility, SurfaceFlexibility};
use slipzone::scene::{Scene, parse};
use slipzone_flexibilities::Compliance;
use std::sync::Arc;

/// What the method is asked for where less will do.
const ROUGH: f64 = 1e-12;

/// The scene of a case: its layer under any punch.
fn scene(case: &Value) -> Result<Scene, String> {
    let keys = ["thickness", "poisson", "plane", "moduli", "base", "grading"];
    let given = keys.into_iter().filter(|key| !case[*key].is_null());
    let layer: Value = given.map(|key| (key.to_owned(), case[key].clone())).collect::<serde_json::Map<_, _>>().into();
    let scene = json!({
        "format": 1, "layer": layer,
        "punch": { "type": "flat", "half_width": 1.0 }, "load": { "force": 1.0 },
    });
    let text = toml::to_string(&scene).expect("tables and numbers");
    parse("case", &text).map_err(|error| error.to_string())
}

/// Largest difference: `vv` and `uu` relative to themselves, `uv`, which passes through zero, to their mean.
fn distance(found: SurfaceFlexibility, expected: SurfaceFlexibility) -> f64 {
    let SurfaceFlexibility { vv, uu, uv } = expected;
    let each = [found.vv / vv - 1.0, found.uu / uu - 1.0, (found.uv - uv) / (vv * uu).sqrt()];
    // NaN is worst.
    each.into_iter().fold(0.0, |worst, error| if error.abs() <= worst { worst } else { error.abs() })
}

/// The largest difference over the wave numbers of a case, and where it is.
fn worst(case: &Value) -> Result<(f64, f64), String> {
    let layer = Arc::new(scene(case)?.layer.model().map_err(|refusal| refusal.to_string())?);
    let full = Compliance {}.respond(&layer).map_err(|refusal| refusal.to_string())?;
    let response = full.roughly(ROUGH).unwrap_or(&*full);
    let column = |key: &str| -> Vec<f64> {
        case[key].as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number")).collect()
    };
    let [waves, vv, uu, uv] = ["s", "vv", "uu", "uv"].map(column);
    assert!([&vv, &uu, &uv].iter().all(|column| column.len() == waves.len()), "columns of one length");
    let mut worst = (0.0, 0.0);
    for (i, s) in waves.into_iter().enumerate() {
        let found = response.surface(s).map_err(|refusal| refusal.to_string())?;
        let difference = distance(found, SurfaceFlexibility { vv: vv[i], uu: uu[i], uv: uv[i] });
        if difference.is_nan() || difference > worst.0 {
            worst = (difference, s);
        }
    }
    Ok(worst)
}

#[test]
fn asked_for_less_it_keeps_what_was_asked_for() {
    let file: Value = serde_json::from_str(include_str!("../data/flexibilities.json")).expect("valid JSON");
    let mut failed = Vec::new();
    for case in file["cases"].as_array().expect("a list") {
        let about = case["about"].as_str().expect("a text");
        let (difference, s) = worst(case).unwrap_or_else(|why| panic!("{about}: {why}"));
        println!("{difference:8.1e} at s = {s:<6} {about}");
        if difference.is_nan() || difference > ROUGH {
            failed.push(format!("{about}: {difference:.1e} at s = {s}"));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
