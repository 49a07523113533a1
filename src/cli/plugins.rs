//! `slipzone plugins`: what is there, and what a scene can name beside.

use super::named::unknown;
use super::{Failure, Outcome, print};
use crate::api::{Family, Kind, Parameter, PluginInfo, Values, known_elsewhere};
use crate::scene::KEYS;
use std::fmt::{self, Write};

/// Those of all names; of a family's, all in it.
pub(super) fn run(names: &[String], json: bool) -> Result<Outcome, Failure> {
    let mut chosen = crate::api::plugins();
    let mut built_in = Vec::new();
    gather_built_in(KEYS, "", &mut built_in);
    let is_family = |name: &&str| {
        let is_built_in = built_in.iter().any(|built_in| built_in.family() == *name);
        is_built_in || Family::ALL.into_iter().any(|family| family.name() == *name)
    };
    // A name may stand in two families; that of a family is no plugin's.
    let (families, names): (Vec<&str>, Vec<&str>) = names.iter().map(String::as_str).partition(is_family);
    let is_one_of = |list: &[&str], name: &str| list.is_empty() || list.contains(&name);
    chosen.retain(|info| is_one_of(&families, info.family.name()));
    built_in.retain(|built_in| is_one_of(&families, built_in.family()));
    let mut known: Vec<_> = chosen.iter().map(|info| info.name).collect();
    known.extend(built_in.iter().map(|built_in| built_in.kind.name));
    known.sort_unstable();
    known.dedup();
    if let Some(name) = names.iter().find(|name| !known.contains(name)) {
        let what = if let [family] = families[..] { family } else { "plugin" };
        let meant = Family::ALL.into_iter().filter(|family| is_one_of(&families, family.name()));
        return Err(not_there(what, name, meant, &known));
    }
    chosen.retain(|info| is_one_of(&names, info.name));
    built_in.retain(|built_in| is_one_of(&names, built_in.kind.name));
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = match (json, names.is_empty()) {
        (true, _) => {
            let all = serde_json::json!({ "format": 1, "plugins": chosen, "built_in": built_in });
            write!(text, "{all:#}")
        }
        (false, true) => list(&mut text, &chosen, &built_in),
        (false, false) => (chosen.into_iter().try_for_each(|info| describe(&mut text, info)))
            .and_then(|()| built_in.iter().try_for_each(|built_in| built_in.describe(&mut text))),
    };
    print::result(&text)?;
    Ok(Outcome::Done)
}

/// What a scene names by `type` and the program brings along itself: bases and laws of friction.
#[derive(serde::Serialize)]
struct BuiltIn {
    /// Where the scene names it, such as `layer.base`.
    place: String,
    #[serde(flatten)]
    kind: &'static Kind,
}

/// Those under some keys of a scene.
fn gather_built_in(keys: &'static [Parameter], path: &str, all: &mut Vec<BuiltIn>) {
    for key in keys {
        let place = if path.is_empty() { key.name.to_owned() } else { format!("{path}.{}", key.name) };
        match key.values {
            Values::Table(keys) => gather_built_in(keys, &place, all),
            Values::Choice(kinds) => {
                all.extend(kinds.iter().map(|kind| BuiltIn { place: place.clone(), kind }));
            }
            _ => {}
        }
    }
}

impl BuiltIn {
    /// What it is one of: the last key of its place.
    fn family(&self) -> &str {
        self.place.rsplit('.').next().unwrap_or_default()
    }

    fn describe(&self, text: &mut String) -> fmt::Result {
        let Self { place, kind } = self;
        begin(text, [kind.name, self.family(), place, kind.summary], kind.parameters)?;
        writeln!(text, "\nexample\n  [{place}]\n  type = \"{}\"", kind.name)?;
        for key in kind.parameters.iter().filter(|key| key.required) {
            let sample = if key.values == Values::Positive { 1.0 } else { 0.3 };
            writeln!(text, "  {} = {sample:?}", key.name)?;
        }
        writeln!(text, "\nsource\n  docs/formats.md")
    }
}

/// The plugin of a family with that name.
pub(super) fn named(family: Family, name: &str) -> Result<&'static PluginInfo, Failure> {
    let own = crate::api::plugins().into_iter().filter(|info| info.family == family);
    let known: Vec<_> = own.map(|info| info.name).collect();
    crate::api::find(family, name).ok_or_else(|| not_there(family.name(), name, [family], &known))
}

/// A plugin that is none of these families', which may go by another name.
fn not_there(what: &str, name: &str, families: impl IntoIterator<Item = Family>, known: &[&str]) -> Failure {
    match families.into_iter().find_map(|family| known_elsewhere(family, name)) {
        Some(meant) => Failure::Usage(format!("unknown {what} `{name}`"), Some(format!("it is called `{meant}` here"))),
        None => unknown(what, name, known),
    }
}

/// All plugins by family, and what is built in.
fn list(text: &mut String, plugins: &[&PluginInfo], built_in: &[BuiltIn]) -> fmt::Result {
    let names = plugins.iter().map(|info| info.name).chain(built_in.iter().map(|built_in| built_in.kind.name));
    let width = names.map(str::len).max().unwrap_or(0);
    for family in Family::ALL {
        let mut own = plugins.iter().filter(|info| info.family == family).peekable();
        if own.peek().is_some() {
            writeln!(text, "{} ({})", family.name(), family.place())?;
        }
        for info in own {
            writeln!(text, "  {:width$}  {}", info.name, info.summary)?;
        }
    }
    let mut place = "";
    for built_in in built_in {
        if place != built_in.place {
            place = &built_in.place;
            writeln!(text, "{} ({place})", built_in.family())?;
        }
        writeln!(text, "  {:width$}  {}", built_in.kind.name, built_in.kind.summary)?;
    }
    Ok(())
}

/// One plugin at length.
fn describe(text: &mut String, info: &PluginInfo) -> fmt::Result {
    begin(text, [info.name, info.family.name(), info.family.place(), info.summary], info.parameters)?;
    writeln!(text, "\nexample\n  [{}]", info.family.place())?;
    info.example.lines().try_for_each(|line| writeln!(text, "  {line}"))?;
    writeln!(text, "\nsource\n  {}", info.source)
}

/// What it is and its keys.
fn begin(text: &mut String, [name, family, place, summary]: [&str; 4], keys: &[Parameter]) -> fmt::Result {
    if !text.is_empty() {
        writeln!(text)?;
    }
    writeln!(text, "{name} ({family}, in {place})")?;
    writeln!(text, "  {summary}\n\nkeys")?;
    if keys.is_empty() {
        writeln!(text, "  none")?;
    }
    for key in keys {
        let samples: Vec<_> = key.samples.iter().map(f64::to_string).collect();
        let samples = if samples.is_empty() { String::new() } else { format!("; such as {}", samples.join(", ")) };
        let required = match (key.required, key.in_place_of) {
            (true, _) => String::new(),
            (false, None) => " (optional)".into(),
            (false, Some(other)) => format!(" (in place of `{other}`)"),
        };
        writeln!(text, "  {}: {}{required}{samples}", key.name, key.summary)?;
    }
    Ok(())
}
