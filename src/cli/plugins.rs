//! `slipzone plugins`: what is there.

use super::{Failure, Outcome, print};
use slipzone::api::{Family, PluginInfo};
use slipzone::scene::nearest;
use std::fmt::{self, Write};

pub(super) fn run(name: Option<&str>, json: bool) -> Result<Outcome, Failure> {
    let mut chosen = slipzone::api::plugins();
    if let Some(name) = name {
        let mut known: Vec<_> = chosen.iter().map(|info| info.name).collect();
        known.dedup();
        // A name may stand in two families.
        chosen.retain(|info| info.name == name);
        if chosen.is_empty() {
            return Err(unknown("plugin", name, &known));
        }
    }
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = match (json, name) {
        (true, _) => write!(text, "{:#}", serde_json::json!({ "format": 1, "plugins": chosen })),
        (false, None) => list(&mut text, &chosen),
        (false, Some(_)) => chosen.into_iter().try_for_each(|info| describe(&mut text, info)),
    };
    print::result(&text)?;
    Ok(Outcome::Done)
}

/// The plugin of a family with that name.
pub(super) fn named(family: Family, name: &str) -> Result<&'static PluginInfo, Failure> {
    let own = slipzone::api::plugins().into_iter().filter(|info| info.family == family);
    let known: Vec<_> = own.map(|info| info.name).collect();
    slipzone::api::find(family, name).ok_or_else(|| unknown(family.name(), name, &known))
}

fn unknown(what: &str, name: &str, known: &[&str]) -> Failure {
    let hint = match nearest(name, known) {
        Some(near) => format!("did you mean `{near}`?"),
        None => format!("known are {}", known.join(", ")),
    };
    Failure::Usage(format!("unknown {what} `{name}`"), Some(hint))
}

/// All plugins by family.
fn list(text: &mut String, plugins: &[&PluginInfo]) -> fmt::Result {
    let width = plugins.iter().map(|info| info.name.len()).max().unwrap_or(0);
    for family in Family::ALL {
        writeln!(text, "{} ({})", family.name(), family.place())?;
        for info in plugins.iter().filter(|info| info.family == family) {
            writeln!(text, "  {:width$}  {}", info.name, info.summary)?;
        }
    }
    Ok(())
}

/// One plugin at length.
fn describe(text: &mut String, info: &PluginInfo) -> fmt::Result {
    if !text.is_empty() {
        writeln!(text)?;
    }
    writeln!(text, "{} ({}, in {})", info.name, info.family.name(), info.family.place())?;
    writeln!(text, "  {}\n\nkeys", info.summary)?;
    if info.parameters.is_empty() {
        writeln!(text, "  none")?;
    }
    for key in info.parameters {
        let samples: Vec<_> = key.samples.iter().map(f64::to_string).collect();
        let samples = if samples.is_empty() { String::new() } else { format!("; such as {}", samples.join(", ")) };
        let required = match (key.required, key.in_place_of) {
            (true, _) => String::new(),
            (false, None) => " (optional)".into(),
            (false, Some(other)) => format!(" (in place of `{other}`)"),
        };
        writeln!(text, "  {}: {}{required}{samples}", key.name, key.summary)?;
    }
    writeln!(text, "\nexample\n  [{}]", info.family.place())?;
    info.example.lines().try_for_each(|line| writeln!(text, "  {line}"))?;
    writeln!(text, "\nsource\n  {}", info.source)
}
