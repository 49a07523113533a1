//! What editors, shells and newcomers get: `slipzone schema`, `completions` and `init`.

use crate::run::{GOOD, feed, files, folder, run, told};
use boon::{Compiler, SchemaIndex, Schemas};
use serde_json::{Map, Value, json};
use slipzone::api::{Family, Parameter, Values, plugins};
use slipzone::scene::{self, KEYS};
use std::fs;
use std::path::{Path, PathBuf};

/// The schema that the program prints, ready to judge.
struct Judge {
    schemas: Schemas,
    index: SchemaIndex,
}

impl Judge {
    fn new() -> Self {
        let printed = run(folder().path(), ["schema"]);
        assert_eq!(printed.status.code(), Some(0));
        let schema: Value = serde_json::from_slice(&printed.stdout).expect("JSON");
        assert_eq!(schema, scene::schema());
        let (mut compiler, mut schemas) = (Compiler::new(), Schemas::new());
        compiler.add_resource("scene.schema.json", schema).expect("a schema");
        let index = compiler.compile("scene.schema.json", &mut schemas).expect("a schema of draft 7");
        Self { schemas, index }
    }

    /// What is wrong with a scene; a text that is not TOML is no scene.
    fn judge(&self, text: &str) -> Result<(), String> {
        let table: toml::Table = toml::from_str(text).map_err(|error| error.to_string())?;
        let scene = in_json(&toml::Value::Table(table));
        self.schemas.validate(&scene, self.index).map_err(|error| error.to_string())
    }
}

/// A scene as editors hand it to a schema. JSON has no NaN and no infinity: they become `null`.
fn in_json(value: &toml::Value) -> Value {
    match value {
        toml::Value::Table(table) => {
            table.iter().map(|(key, value)| (key.clone(), in_json(value))).collect::<Map<_, _>>().into()
        }
        toml::Value::Array(array) => array.iter().map(in_json).collect(),
        toml::Value::String(text) => json!(text),
        toml::Value::Integer(integer) => json!(integer),
        toml::Value::Float(float) => json!(float),
        toml::Value::Boolean(flag) => json!(flag),
        toml::Value::Datetime(date) => json!(date.to_string()),
    }
}

/// The TOML files of a folder of this repository, sorted.
fn scenes(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let mut scenes: Vec<_> = paths.filter(|path| path.extension().is_some_and(|end| end == "toml")).collect();
    scenes.sort();
    scenes
}

#[test]
fn every_example_validates() {
    let judge = Judge::new();
    let examples = scenes("examples");
    assert!(examples.len() >= 30, "{} examples", examples.len());
    for path in examples {
        let verdict = judge.judge(&fs::read_to_string(&path).unwrap());
        assert!(verdict.is_ok(), "{}: {verdict:?}", path.display());
    }
}

/// Of the scenes that the reader refuses, those that a schema cannot: the list is complete, so that a schema that grows
/// wider, or narrower, fails.
#[test]
fn a_broken_scene_is_rejected_unless_it_takes_more_than_a_schema_to_tell() {
    let judge = Judge::new();
    let passing: Vec<String> = scenes("tests/data/bad")
        .into_iter()
        // What is not UTF-8 is not TOML.
        .filter(|path| fs::read_to_string(path).is_ok_and(|text| judge.judge(&text).is_ok()))
        .map(|path| path.file_stem().unwrap().to_string_lossy().into_owned())
        .collect();
    insta::assert_snapshot!("broken_scenes_that_fit_the_schema", passing.join("\n"));
}

/// The reader's own lists of keys are those that are described: a key that is new in one of the two must be in both.
#[test]
fn the_described_keys_are_the_known_ones() {
    let inner = |name: &str| match KEYS.iter().find(|key| key.name == name).unwrap().values {
        Values::Table(keys) => keys,
        _ => panic!("{name} is no table of keys"),
    };
    let sections = [("layer", inner("layer")), ("solver", inner("solver")), ("output", inner("output"))];
    let others = [("load", inner("load")), ("units", inner("units"))];
    for (name, keys) in sections.into_iter().chain(others) {
        assert_eq!(known_keys(name), names(keys), "[{name}]");
    }
    let error = scene::parse("scene", &format!("no_such_key = 1\n{GOOD}")).unwrap_err();
    assert_eq!(quoted(&error.expected.unwrap()), names(KEYS), "at the top");
}

/// The keys that the reader names when it finds an unknown one in a section.
fn known_keys(section: &str) -> Vec<String> {
    let head = format!("[{section}]\n");
    let scene = if GOOD.contains(&head) { GOOD.to_owned() } else { format!("{GOOD}{head}") };
    let scene = scene.replace(&head, &format!("{head}no_such_key = 1\n"));
    let error = scene::parse("scene", &scene).unwrap_err();
    quoted(&error.expected.unwrap_or_else(|| panic!("[{section}]: {}", error.message)))
}

fn names(keys: &[Parameter]) -> Vec<String> {
    let mut names: Vec<_> = keys.iter().map(|key| key.name.to_owned()).collect();
    names.sort();
    names
}

fn quoted(text: &str) -> Vec<String> {
    let mut names: Vec<_> = text.split('`').skip(1).step_by(2).map(str::to_owned).collect();
    names.sort();
    names
}

/// A new plugin is in the schema by itself, with its description.
#[test]
fn every_plugin_is_in_the_schema() {
    let schema = scene::schema();
    for info in plugins() {
        let family = schema["definitions"][info.family.name()]["oneOf"].as_array().unwrap();
        let own = family.iter().find(|kind| kind["properties"]["type"]["const"] == info.name);
        let own = own.unwrap_or_else(|| panic!("{} is not there", info.name));
        assert_eq!(own["description"], info.summary);
        assert_eq!(own["additionalProperties"], false, "{}", info.name);
        for key in info.parameters {
            assert!(own["properties"][key.name]["description"].is_string(), "{}: {}", info.name, key.name);
            assert_ne!(key.values, Values::Unstated, "{}: `{}` does not say what it may hold", info.name, key.name);
        }
    }
}

/// Every punch on every grading: the scene is within the schema, and solving it converges.
#[test]
fn a_new_scene_runs() {
    let (folder, judge) = (folder(), Judge::new());
    let of = |family: Family| plugins().into_iter().filter(move |info| info.family == family);
    // Each punch once and each grading once; all pairs only differ in what other tests solve.
    let pairs = of(Family::Punch).map(|punch| (punch.name, "exponential"));
    let pairs = pairs.chain(of(Family::Grading).map(|grading| ("flat", grading.name)));
    for (punch, grading) in pairs {
        let written = run(folder.path(), ["init", "-", "--punch", punch, "--grading", grading]);
        assert_eq!(written.status.code(), Some(0), "{punch} on {grading}");
        let text = String::from_utf8(written.stdout).unwrap();
        assert!(text.contains(&format!("type = {punch:?}")) && text.contains(&format!("type = {grading:?}")));
        assert_eq!(judge.judge(&text), Ok(()), "{punch} on {grading}");
        let solved = feed(folder.path(), &["solve", "-"], text.as_bytes());
        assert_eq!(solved.status.code(), Some(0), "{punch} on {grading}: {}", told(&solved));
    }
}

/// Every key is explained in the scene that `init` writes, and what stands there in a comment is a value of it: put in
/// place of what it excludes, it is still a scene.
#[test]
fn every_key_is_in_a_new_scene() {
    let printed = run(folder().path(), ["init", "-", "--punch", "cylinder", "--grading", "homogeneous"]);
    let text = String::from_utf8(printed.stdout).unwrap();
    assert!(scene::parse("scene.toml", &text).is_ok());
    let mut tried = 0;
    for section in KEYS {
        let Values::Table(keys) = section.values else {
            assert!(text.contains(section.name), "{}", section.name);
            continue;
        };
        let start = text.find(&format!("[{}]", section.name)).unwrap_or_else(|| panic!("no [{}]", section.name));
        for key in keys.iter().filter(|key| key.values != Values::Plugin(Family::Grading)) {
            let plain = text[start..].find(&format!("\n{} = ", key.name));
            let Some(at) = text[start..].find(&format!("\n# {} = ", key.name)) else {
                assert!(plain.is_some(), "{}.{} is missing", section.name, key.name);
                continue;
            };
            let mut lively = text.clone();
            lively.replace_range(start + at + 1..start + at + 3, "");
            if let Some(other) = key.in_place_of {
                let at = start + lively[start..].find(&format!("\n{other} = ")).expect("what it stands for");
                lively.insert_str(at + 1, "# ");
            }
            // The base is rigid: a datum is then one too many.
            if key.name == "datum" {
                lively = lively.replace("{ type = \"rigid\" }", "{ type = \"infinite\" }");
                lively = lively.replace("\nthickness", "\n# thickness");
            }
            let scene = scene::parse("scene.toml", &lively);
            assert!(scene.is_ok(), "{}.{}: {:?}", section.name, key.name, scene.err());
            tried += 1;
        }
    }
    assert!(tried >= 9, "only {tried} keys in comments");
}

#[test]
fn a_new_scene_as_it_is_written() {
    let folder = folder();
    let output = run(folder.path(), ["init"]);
    insta::assert_snapshot!("init", told(&output));
    insta::assert_snapshot!("init_scene", fs::read_to_string(folder.path().join("scene.toml")).unwrap());
    assert_eq!(files(folder.path()), [Path::new("good.toml"), Path::new("scene.toml")], "nothing else is left");
}

#[test]
fn what_is_there_is_not_overwritten() {
    let folder = folder();
    let output = run(folder.path(), ["init", "good.toml"]);
    assert_eq!(output.status.code(), Some(2));
    insta::assert_snapshot!("init_exists", told(&output));
    assert_eq!(fs::read_to_string(folder.path().join("good.toml")).unwrap(), GOOD);
    // Not through a link that leads nowhere, either.
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("nowhere.toml", folder.path().join("link.toml")).unwrap();
        assert_eq!(run(folder.path(), ["init", "link.toml"]).status.code(), Some(2));
        assert!(!folder.path().join("nowhere.toml").exists());
        assert_eq!(run(folder.path(), ["init", "/dev/full"]).status.code(), Some(2));
    }
}

#[test]
fn scenes_that_cannot_be_written() {
    let folder = folder();
    fs::create_dir(folder.path().join("sub")).unwrap();
    for (name, file, code) in [("folder", "sub", 3), ("no_folder", "none/scene.toml", 3), ("slash", "new/", 3)] {
        let output = run(folder.path(), ["init", file]);
        assert_eq!(output.status.code(), Some(code), "{file}");
        insta::assert_snapshot!(format!("init_{name}"), told(&output));
    }
    let output = run(folder.path(), ["init", "--punch", "cylindre"]);
    assert_eq!(output.status.code(), Some(2));
    insta::assert_snapshot!("init_unknown_punch", told(&output));
    // A name of the other family.
    let output = run(folder.path(), ["init", "--grading", "wedge"]);
    assert_eq!(output.status.code(), Some(2));
    insta::assert_snapshot!("init_unknown_grading", told(&output));
    assert_eq!(files(folder.path()), [Path::new("good.toml"), Path::new("sub")]);
}

#[test]
fn shells_complete_every_command() {
    let commands = ["init", "solve", "check", "explain", "plugins", "schema", "completions"];
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = run(folder().path(), ["completions", shell]);
        assert_eq!(output.status.code(), Some(0), "{shell}");
        let script = String::from_utf8(output.stdout).unwrap();
        for word in commands.into_iter().chain(["curve-csv", "grading"]) {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    assert_eq!(run(folder().path(), ["completions", "csh"]).status.code(), Some(2));
}

/// The help of every command has examples and its exit codes.
#[test]
fn help_has_examples_and_exit_codes() {
    for command in ["init", "solve", "check", "explain", "plugins", "schema", "completions"] {
        let output = run(folder().path(), [command, "--help"]);
        assert_eq!(output.status.code(), Some(0), "{command}");
        let help = String::from_utf8(output.stdout).unwrap();
        assert!(help.contains(&format!("\n  slipzone {command}")) && help.contains("Exit codes:"), "{help}");
        assert!(help.lines().all(|line| line.chars().count() <= 110), "{help}");
    }
}
