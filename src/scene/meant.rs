//! What a key that is not known here is elsewhere: a symbol of formulas, a usual name, a key of another section.

use super::keys::KEYS;
use slipzone_api::{Parameter, Values};

/// What a key means that another file, another place or a formula calls so; `known` are those of its table.
pub(super) fn meant(path: &[&str], key: &str, known: &[&str]) -> Option<String> {
    const OF_STUDIES: [&str; 4] = ["scene", "axes", "plots", "find"];
    const OF_SCENES: [&str; 4] = ["layer", "punch", "load", "friction"];
    /// Symbols and usual names, and the keys that they stand for.
    const SYMBOLS: [(&[&str], &str); 17] = [
        (&["h"], "thickness"),
        (&["nu"], "poisson"),
        (&["P", "F", "load"], "force"),
        (&["b", "a"], "half_width"),
        (&["delta", "depth"], "indentation"),
        (&["eta", "mu", "f"], "coefficient"),
        (&["R"], "radius"),
        (&["gamma"], "gradient"),
        (&["tol"], "tolerance"),
        (&["mu1", "mu0"], "surface"),
        (&["mu3", "muh"], "base"),
        (&["mu", "G", "shear"], "modulus"),
        (&["start", "begin", "min"], "from"),
        (&["stop", "end", "max"], "to"),
        (&["steps", "num", "n", "points"], "count"),
        (&["range", "linspace"], "linear"),
        (&["logspace", "geomspace"], "log"),
    ];
    if path.is_empty() && key == "grading" && known.contains(&"layer") {
        return Some("a grading belongs to the layer: [layer.grading]".into());
    }
    if path.is_empty() && OF_STUDIES.contains(&key) && known.contains(&"layer") {
        return Some("this is a study: slipzone sweep FILE".into());
    }
    if path.is_empty() && OF_SCENES.contains(&key) && known.contains(&"scene") {
        return Some("this is a scene: slipzone solve FILE".into());
    }
    if matches!(key, "young" | "E") && path.last() == Some(&"grading") {
        return Some("Young's moduli are said once: `moduli = \"young\"` in [layer]".into());
    }
    if matches!(key, "young" | "E" | "G" | "mu" | "modulus") && known.contains(&"moduli") {
        return Some("moduli stand in [layer.grading]; they are Young's where [layer] has `moduli = \"young\"`".into());
    }
    match SYMBOLS.into_iter().find(|(symbols, name)| symbols.contains(&key) && known.contains(name)) {
        Some((_, name)) => Some(format!("write `{name}`")),
        None => elsewhere(path, key),
    }
}

/// The section of a scene that has a key which stands in another one: its own heading may be missing. A plugin's keys
/// go with its type.
fn elsewhere(path: &[&str], key: &str) -> Option<String> {
    let ([here] | ["scene", here]) = path else { return None };
    let is_of_plugin = |section: &Parameter| section.name == *here && matches!(section.values, Values::Plugin(_));
    if KEYS.iter().any(is_of_plugin) {
        return None;
    }
    let mut others = KEYS.iter().filter(|section| section.name != *here);
    let has_it =
        |section: &&Parameter| matches!(section.values, Values::Table(keys) if keys.iter().any(|own| own.name == key));
    others.find(has_it).map(|section| format!("`{key}` is a key of [{}]", section.name))
}
