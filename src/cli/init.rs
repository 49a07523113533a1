//! `slipzone init`: a commented scene that runs, to start from.

use super::args::Init;
use super::input::is_dash;
use super::output::{self, Target};
use super::{Failure, Outcome, plugins, print};
use crate::api::{Family, Parameter, PluginInfo, Values};
use crate::scene::KEYS;
use crate::scene::example::knows_thickness;
use std::fmt::{self, Write};
use toml::{Table, Value};

pub(super) fn run(arguments: &Init) -> Result<Outcome, Failure> {
    let punch = plugins::named(Family::Punch, &arguments.punch)?;
    let grading = plugins::named(Family::Grading, &arguments.grading)?;
    let text =
        scene(punch, grading).map_err(|why| Failure::System(format!("{} with {}: {why}", punch.name, grading.name)))?;
    let file = &arguments.file;
    if is_dash(file) {
        print::result(&text)?;
        return Ok(Outcome::Done);
    }
    output::absent(file)?;
    output::create(&Target::new(file)?, &text)?;
    let shown = file.display();
    print::result(&format!("wrote {shown}; next: slipzone solve {shown}"))?;
    Ok(Outcome::Done)
}

/// Values for the keys of a scene: defaults, and what makes a moderate contact of every plugin's example. What plugins
/// hold is in their own examples.
const EXAMPLES: &str = r#"
format = 1

[layer]
thickness = 5.0
poisson = 0.3
plane = "strain"
moduli = "shear"
base = { type = "rigid" }
datum = 10.0

[friction]
type = "goodman"
coefficient = 0.3
strain = "history"

[load]
force = 0.5
half_width = 0.5
indentation = 0.01
path = { force = [0.1, 0.2, 0.5] }
until = { force = 0.5, points = 60 }

[solver]
tolerance = 1e-8
flexibility = { type = "closed-form" }
kernel = { type = "split" }
quadrature = { type = "de-sinc" }
model = "full"
forbid = ["half-plane"]

[output]
points = 201
x = [-0.9, 0.0, 0.5]
strain = false
quantities = ["load", "edge"]

[units]
length = "mm"
stress = "MPa"
"#;

/// Keys that a first scene leaves out.
const LEFT_OUT: [&str; 7] = ["datum", "flexibility", "kernel", "quadrature", "model", "forbid", "quantities"];

const HEAD: &str = "\
# One contact problem. Any consistent units do: with lengths in mm and moduli in MPa, forces are in N per mm.
# A line such as `# key = value` shows a key that is left out; `slipzone plugins NAME` says more of a `type`.
";

/// The text of a scene of that punch on a layer of that grading.
fn scene(punch: &PluginInfo, grading: &PluginInfo) -> Result<String, toml::de::Error> {
    let mut examples: Table = toml::from_str(EXAMPLES)?;
    examples.insert("title".into(), format!("{} punch, {} layer", punch.name, grading.name).into());
    let own_thickness = knows_thickness(grading);
    let mut text = String::from(HEAD);
    // Writing to a string does not fail.
    let _ = keys(&mut text, KEYS, &examples, &[]);
    for section in KEYS {
        let of = |examples: &Table| examples.get(section.name).and_then(Value::as_table).cloned().unwrap_or_default();
        let left_out: &[&str] = if own_thickness { &["thickness"] } else { &[] };
        let _ = match section.values {
            Values::Table(inner) => head(&mut text, section.name, section.summary)
                .and_then(|()| keys(&mut text, inner, &of(&examples), left_out)),
            Values::Choice(kinds) => {
                let table = of(&examples);
                let kind = kinds.iter().find(|kind| table.get("type").and_then(Value::as_str) == Some(kind.name));
                let names: Vec<_> = kinds.iter().map(|kind| kind.name).collect();
                kind.map_or(Ok(()), |kind| {
                    head(&mut text, section.name, section.summary)?;
                    choice(&mut text, kind.name, kind.summary, &names)?;
                    keys(&mut text, kind.parameters, &table, &[])
                })
            }
            Values::Plugin(_) => plugin(&mut text, section, punch, section.name),
            _ => Ok(()),
        };
        let grading_key = |key: &&Parameter| key.values == Values::Plugin(Family::Grading);
        if let Values::Table(inner) = section.values
            && let Some(key) = inner.iter().find(grading_key)
        {
            let _ = plugin(&mut text, key, grading, Family::Grading.place());
        }
    }
    Ok(text)
}

/// Keys that hold no section of their own.
fn keys(text: &mut String, keys: &[Parameter], examples: &Table, left_out: &[&str]) -> fmt::Result {
    for key in keys.iter().filter(|key| key.values != Values::Plugin(Family::Grading)) {
        let is_section = matches!(key.values, Values::Table(_) | Values::Choice(_) | Values::Plugin(_));
        let example = examples.get(key.name);
        if is_section && (example.is_none_or(Value::is_table) && std::ptr::eq(keys, KEYS)) {
            continue;
        }
        let is_left_out = key.in_place_of.is_some() || LEFT_OUT.contains(&key.name) || left_out.contains(&key.name);
        entry(text, key, example, is_left_out)?;
    }
    Ok(())
}

/// The section of a plugin, filled with its own example.
fn plugin(text: &mut String, key: &Parameter, info: &PluginInfo, place: &str) -> fmt::Result {
    let example: Table = toml::from_str(info.example).unwrap_or_default();
    let others = crate::api::plugins().into_iter().filter(|other| other.family == info.family);
    head(text, place, key.summary)?;
    choice(text, info.name, info.summary, &others.map(|other| other.name).collect::<Vec<_>>())?;
    info.parameters.iter().try_for_each(|key| entry(text, key, example.get(key.name), false))
}

/// The line that opens a section.
fn head(text: &mut String, name: &str, summary: &str) -> fmt::Result {
    writeln!(text)?;
    line(text, &format!("[{name}]"), summary)
}

/// The line that says which of several it is.
fn choice(text: &mut String, name: &str, summary: &str, all: &[&str]) -> fmt::Result {
    let others: Vec<_> = all.iter().filter(|other| **other != name).copied().collect();
    let others = if others.is_empty() { String::new() } else { format!("; others: {}", others.join(", ")) };
    line(text, &format!("type = {name:?}"), &format!("{summary}{others}"))
}

/// A key with its value, or what might be one in a comment.
fn entry(text: &mut String, key: &Parameter, example: Option<&Value>, is_left_out: bool) -> fmt::Result {
    let mark = if is_left_out || example.is_none() { "# " } else { "" };
    let value = example.map_or_else(|| stand_in(key), |example| written(example, key.name.len() + 3));
    let other = key.in_place_of.map_or(String::new(), |other| format!("; in place of `{other}`"));
    let others = match key.values {
        Values::Choice(kinds) => format!(": {}", kinds.iter().map(|kind| kind.name).collect::<Vec<_>>().join(", ")),
        _ => String::new(),
    };
    line(text, &format!("{mark}{} = {value}", key.name), &format!("{}{others}{other}", key.summary))
}

/// A value as people write it: a list too long for a line, behind so many columns, has one line for each entry.
fn written(value: &Value, columns: usize) -> String {
    match value {
        Value::Float(number) if *number != 0.0 && number.abs() < 1e-4 => format!("{number:e}"),
        Value::Array(entries) if columns + value.to_string().len() > WIDTH.1 => {
            let entries: Vec<_> = entries.iter().map(Value::to_string).collect();
            format!("[\n  {},\n]", entries.join(",\n  "))
        }
        _ => value.to_string(),
    }
}

/// A value for a key of which no example is known.
fn stand_in(key: &Parameter) -> String {
    match (key.values, key.samples.first()) {
        (Values::Whole(..) | Values::Even(..), Some(sample)) => sample.to_string(),
        (_, Some(sample)) => format!("{sample:?}"),
        (Values::Whole(least, _) | Values::Even(least, _), None) => least.to_string(),
        (Values::Flag, None) => "false".into(),
        (Values::OneOf(words), None) => format!("{:?}", words.first().unwrap_or(&"...")),
        (Values::List(..), None) => "[...]".into(),
        (Values::ByName(_) | Values::Table(_) | Values::Choice(_) | Values::Plugin(_), None) => "{ ... }".into(),
        (_, None) => "\"...\"".into(),
    }
}

/// Columns of the comments, and of the whole.
const WIDTH: (usize, usize) = (34, 118);

/// A line with its comment behind it, or above where that would be too wide.
fn line(text: &mut String, code: &str, comment: &str) -> fmt::Result {
    let behind = format!("{code:<width$} # {comment}", width = WIDTH.0);
    if behind.chars().count() <= WIDTH.1 && !code.contains('\n') {
        return writeln!(text, "{behind}");
    }
    let mut above = String::from("#");
    for word in comment.split(' ') {
        if above.chars().count() + 1 + word.chars().count() > WIDTH.1 {
            writeln!(text, "{above}")?;
            above = "#".into();
        }
        write!(above, " {word}")?;
    }
    writeln!(text, "{above}\n{code}")
}
