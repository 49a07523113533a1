//! `slipzone plugins`: what is there.

use super::{Failure, Outcome, print};
use slipzone::api::{Family, PluginInfo};
use slipzone::scene::nearest;

pub(super) fn run(name: Option<&str>, json: bool) -> Result<Outcome, Failure> {
    let mut chosen = slipzone::api::plugins();
    if let Some(name) = name {
        let mut known: Vec<_> = chosen.iter().map(|info| info.name).collect();
        known.dedup();
        // A name may stand in two families.
        chosen.retain(|info| info.name == name);
        if chosen.is_empty() {
            let hint = match nearest(name, &known) {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("known are {}", known.join(", ")),
            };
            return Err(Failure::Usage(format!("unknown plugin `{name}`"), Some(hint)));
        }
    }
    let text = match (json, name) {
        (true, _) => serde_json::to_string_pretty(&serde_json::json!({ "format": 1, "plugins": chosen }))
            .map_err(|error| Failure::System(error.to_string()))?,
        (false, None) => list(&chosen),
        (false, Some(_)) => chosen.into_iter().map(describe).collect::<Vec<_>>().join("\n"),
    };
    print::result(&text)?;
    Ok(Outcome::Done)
}

/// All plugins by family.
fn list(plugins: &[&PluginInfo]) -> String {
    let width = plugins.iter().map(|info| info.name.len()).max().unwrap_or(0);
    let mut text = String::new();
    for family in Family::ALL {
        text += &format!("{} ({})\n", family.name(), place(family));
        for info in plugins.iter().filter(|info| info.family == family) {
            text += &format!("  {:width$}  {}\n", info.name, info.summary);
        }
    }
    text
}

/// One plugin at length.
fn describe(info: &PluginInfo) -> String {
    let mut text = format!("{} ({}, in {})\n  {}\n", info.name, info.family.name(), place(info.family), info.summary);
    text += "\nkeys\n";
    if info.parameters.is_empty() {
        text += "  none\n";
    }
    for key in info.parameters {
        let samples: Vec<_> = key.samples.iter().map(f64::to_string).collect();
        let required = if key.required { "" } else { " (optional)" };
        text += &format!("  {}: {}{required}; such as {}\n", key.name, key.summary, samples.join(", "));
    }
    text += &format!("\nexample\n  [{}]\n", place(info.family));
    for line in info.example.lines() {
        text += &format!("  {line}\n");
    }
    text + &format!("\nsource\n  {}\n", info.source)
}

/// Where a scene names a plugin of a family.
fn place(family: Family) -> &'static str {
    match family {
        Family::Grading => "layer.grading",
        Family::Punch => "punch",
        Family::Flexibility => "solver.flexibility",
        Family::Kernel => "solver.kernel",
        Family::Quadrature => "solver.quadrature",
    }
}
