//! What the program reads, writes and returns when its input is fine.

use crate::run::{GOOD, feed, files, folder, program, run, told};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Stdio;

fn json(bytes: &[u8]) -> Value {
    serde_json::from_slice(bytes).expect("JSON and nothing else")
}

/// The exit code belongs to the status, whatever the engine makes of the scene.
fn assert_matches_status(code: Option<i32>, result: &Value) {
    let expected = i32::from(result["status"] != "converged");
    assert_eq!(code, Some(expected), "status {}", result["status"]);
}

#[test]
fn json_on_standard_output_comes_alone() {
    let folder = folder();
    let output = run(folder.path(), ["solve", "good.toml", "--json", "-"]);
    let result = json(&output.stdout);
    assert_eq!(result["format"], 1);
    assert_eq!(result["scene"]["title"], "a good scene");
    assert_matches_status(output.status.code(), &result);
    assert_eq!(files(folder.path()), [PathBuf::from("good.toml")], "`-` is no file");
}

#[test]
fn files_are_written_and_the_report_printed() {
    let folder = folder();
    let output = run(folder.path(), ["solve", "good.toml", "--json", "out.json", "--csv", "out.csv"]);
    let result = json(&fs::read(folder.path().join("out.json")).unwrap());
    assert_matches_status(output.status.code(), &result);
    assert!(!output.stdout.is_empty());
    let csv = fs::read_to_string(folder.path().join("out.csv")).unwrap();
    assert!(csv.starts_with("x,pressure,shear"), "{csv}");
    let names = ["good.toml", "out.csv", "out.json"].map(PathBuf::from);
    assert_eq!(files(folder.path()), names, "no temporary file stays");
}

#[test]
fn standard_input_is_a_scene_too() {
    let folder = folder();
    let from_file = run(folder.path(), ["solve", "good.toml", "--json", "-"]);
    let from_stdin = feed(folder.path(), &["solve", "-", "--json", "-"], GOOD.as_bytes());
    assert_eq!(from_stdin, from_file);
}

#[test]
fn a_refused_scene_still_has_a_result() {
    let folder = folder();
    // A base modulus at no depth: a scene, but not one that has an answer.
    let scene = GOOD.replace("thickness = 5.0", "base = { type = \"infinite\" }");
    let output = feed(folder.path(), &["solve", "-", "--json", "out.json"], scene.as_bytes());
    assert_eq!(output.status.code(), Some(1), "{}", told(&output));
    let result = json(&fs::read(folder.path().join("out.json")).unwrap());
    assert_eq!(result["status"], "refused");
    assert!(result["reason"].is_string());
}

/// The curve has files of its own; the profile stays that of the last load.
#[test]
fn a_loading_curve_is_written() {
    let folder = folder();
    let scene = GOOD.replace("force = 1.0", "path = { force = [0.25, 0.5, 1.0] }");
    fs::write(folder.path().join("path.toml"), scene).unwrap();
    let outputs = ["--csv", "profile.csv", "--curve-csv", "curve.csv"];
    let output = run(folder.path(), ["solve", "path.toml"].iter().chain(&outputs));
    assert_eq!(output.status.code(), Some(0), "{}", told(&output));
    run(folder.path(), ["solve", "good.toml", "--csv", "alone.csv"]);
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(read("profile.csv"), read("alone.csv"));
    let curve = read("curve.csv");
    insta::assert_snapshot!("curve_csv_heading", curve.lines().next().unwrap());
    let forces: Vec<&str> = curve.lines().skip(1).map(|row| row.split(',').next().unwrap()).collect();
    assert_eq!(forces, ["0.25", "0.5", "1.0"]);
    let page = String::from_utf8(output.stdout).unwrap();
    assert!(page.contains("path         3 loads, the last of them above: P 0.25 to 1, b 1 to 1, delta "), "{page}");
    let checked = told(&run(folder.path(), ["check", "path.toml"]));
    assert!(checked.ends_with("P = 1, on a path of 3 from 0.25\n"), "{checked}");
}

/// A half-plane that stiffens with depth is its own base: what `solve` counts depths from, `explain` says.
#[test]
fn explain_says_that_a_stiffening_half_plane_has_depths() {
    let folder = folder();
    let output = feed(folder.path(), &["explain", "-"], include_bytes!("../../examples/layer_infinite.toml"));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("stiffens: the indentation is counted from far below"), "{text}");
    let softening = GOOD
        .replace("thickness = 5.0", "base = { type = \"infinite\" }")
        .replace("surface = 1.0, base = 8.0", "surface = 1.0, gradient = -0.1");
    let output = feed(folder.path(), &["explain", "-"], softening.as_bytes());
    assert!(told(&output).contains("for ever and softens: it bears no load"), "{}", told(&output));
    let named = softening + "[units]\nlength = \"um\"\nstress = \"GPa\"\n";
    let named = told(&feed(folder.path(), &["explain", "-"], named.as_bytes()));
    for unit in ["gamma    = -0.1  (1/um)", "A0       = 0.7  (1/GPa)", "b        = 1  (um)"] {
        assert!(named.contains(unit), "{unit} in {named}");
    }
}

/// Decided where the layer is known, not where methods are chosen.
#[test]
fn explain_tells_the_model_that_solves() {
    let folder = folder();
    let thin = GOOD
        .replace("type = \"flat\"\nhalf_width = 1.0", "type = \"cylinder\"\nradius = 1e5")
        .replace("[friction]\ntype = \"goodman\"\ncoefficient = 0.3\n", "")
        .replace("force = 1.0", "half_width = 1e4")
        + "[solver]\ntolerance = 1e-2\n[output]\nquantities = [\"load\"]\n";
    let output = feed(folder.path(), &["explain", "-"], thin.as_bytes());
    assert!(told(&output).contains("no kernel and no system is needed"), "{}", told(&output));
}

#[cfg(feature = "plot")]
#[test]
fn a_loading_curve_is_drawn() {
    let folder = folder();
    let scene = GOOD.replace("force = 1.0", "until = { force = 1.0, points = 5 }");
    let output = feed(folder.path(), &["solve", "-", "--curve-svg", "curve.svg"], scene.as_bytes());
    assert_eq!(output.status.code(), Some(0), "{}", told(&output));
    let figure = fs::read_to_string(folder.path().join("curve.svg")).unwrap();
    assert!(figure.contains("indentation δ") && figure.contains("stick zone a"), "{figure}");
}

/// The result is written, and its exit code tells that some point of the curve is not what was asked for.
#[test]
fn a_curve_that_did_not_converge_is_told() {
    let folder = folder();
    let scene = GOOD.replace("force = 1.0", "path = { force = [0.5, 1.0] }\n[solver]\ntolerance = 1e-14");
    let output = feed(folder.path(), &["solve", "-", "--json", "out.json"], scene.as_bytes());
    assert_eq!(output.status.code(), Some(1), "{}", told(&output));
    assert!(told(&output).contains("slipzone: the loading curve: 2 of 2 loads not converged"), "{}", told(&output));
    let result = json(&fs::read(folder.path().join("out.json")).unwrap());
    assert_eq!(result["path"]["status"], "not-converged");
}

#[test]
fn a_curve_must_be_asked_for() {
    let folder = folder();
    let output = run(folder.path(), ["solve", "good.toml", "--json", "out.json", "--curve-csv", "curve.csv"]);
    insta::assert_snapshot!("curve_not_asked_for", told(&output));
    assert_eq!(files(folder.path()), [PathBuf::from("good.toml")], "nothing was written");
}

/// No figure can be drawn of a refusal: that is said, and all else is written.
#[cfg(feature = "plot")]
#[test]
fn a_figure_that_cannot_be_drawn_is_no_failure() {
    let folder = folder();
    let scene = GOOD.replace("thickness = 5.0", "base = { type = \"infinite\" }");
    let output = feed(folder.path(), &["solve", "-", "--svg", "out.svg", "--csv", "out.csv"], scene.as_bytes());
    assert_eq!(output.status.code(), Some(1), "{}", told(&output));
    assert!(told(&output).contains("no figure was drawn"));
    assert!(!folder.path().join("out.svg").exists());
    assert!(folder.path().join("out.csv").exists());
}

#[test]
fn check_says_ok() {
    insta::assert_snapshot!(told(&run(folder().path(), ["check", "good.toml"])));
}

/// What `explain` prints is itself a scene: comments around the scene as it was understood.
#[test]
fn explain_prints_a_scene() {
    let folder = folder();
    let output = run(folder.path(), ["explain", "good.toml"]);
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    for constant in ["kappa    = 1.8", "gamma h  = 2.079", "h/b      = 5"] {
        assert!(text.contains(constant), "{constant} is missing in\n{text}");
    }
    let again = feed(folder.path(), &["explain", "-"], text.as_bytes());
    assert_eq!(again, output, "explaining the explanation adds nothing");
}

/// Small moduli were written out, with a hundred zeros.
#[test]
fn explain_writes_small_numbers_as_powers_of_ten() {
    let folder = folder();
    let scene = GOOD
        .replace(
            "type = \"exponential\", surface = 1.0, base = 8.0",
            "type = 'table', points = [[0, 1e-90], [1, 2e-90], [2, 3.5e-90], [5, 8e-90]]",
        )
        .replace("force = 1.0", "force = 1e-95")
        .replace("a good scene", "0.0000000001 = 1e-10");
    let output = feed(folder.path(), &["explain", "-"], scene.as_bytes());
    assert_eq!(output.status.code(), Some(0), "{}", told(&output));
    let text = String::from_utf8(output.stdout.clone()).unwrap();
    for line in
        ["points = [[0.0, 1e-90], [1.0, 2e-90],", "force = 1e-95", "title = \"0.0000000001 = 1e-10\"", "e-90  (stress)"]
    {
        assert!(text.contains(line), "{line} is missing in\n{text}");
    }
    assert!(text.lines().all(|line| line.len() < 200), "{text}");
    let again = feed(folder.path(), &["explain", "-"], text.as_bytes());
    assert_eq!(again, output, "explaining the explanation adds nothing");
}

/// What is said of the layer, for each kind of base. Numbers in it are rounded.
#[test]
fn explain_says_what_the_layer_is() {
    let folder = folder();
    let layers = [
        "thickness = 5.0",
        "thickness = 5.0\nmoduli = 'young'\ndatum = 9.0\nbase = { type = 'half-plane', shear = 3.0, poisson = 0.2 }",
        "thickness = 5.0\nbase = { type = 'frictionless' }",
        "base = { type = 'infinite' }",
    ];
    let said = layers.map(|layer| {
        let output = feed(folder.path(), &["explain", "-"], GOOD.replace("thickness = 5.0", layer).as_bytes());
        assert_eq!(output.status.code(), Some(0), "{}", told(&output));
        let text = String::from_utf8(output.stdout).unwrap();
        let from = text.find("# The layer.").expect("a part about the layer");
        let said = text[from..].split("\n\n").next().expect("lines up to an empty one");
        // Whether a base is built yet is not what this is about.
        let lines = said.lines().filter(|line| !line.contains("felt below"));
        format!("{layer}\n{}", lines.collect::<Vec<_>>().join("\n"))
    });
    insta::assert_snapshot!(said.join("\n\n"));
}

#[test]
fn explain_names_the_degree_of_a_curve_where_it_is_low() {
    let folder = folder();
    let rows = [
        "[0.0, 1.0], [2.0, 1.5], [3.0, 1.7], [5.0, 2.0]",
        "[0.0, 1.0], [1.0, 1.5], [2.0, 2.2], [3.0, 3.1], [5.0, 5.5]",
    ];
    let notes = rows.map(|rows| {
        let scene = format!(
            "format = 1\nlayer = {{ thickness = 5.0, poisson = 0.3, grading = {{ type = 'table', points = [{rows}] }} }}\n\
             punch = {{ type = 'flat', half_width = 1.0 }}\nload = {{ force = 1.0 }}"
        );
        let output = feed(folder.path(), &["explain", "-"], scene.as_bytes());
        assert_eq!(output.status.code(), Some(0), "{}", told(&output));
        let text = String::from_utf8(output.stdout).unwrap();
        text.lines().filter(|line| line.starts_with("# note ")).map(str::to_owned).collect::<Vec<_>>()
    });
    assert!(notes[0].len() == 1 && notes[0][0].contains("degree 3, not 4: 4 rows"), "{notes:?}");
    assert!(notes[1].is_empty(), "{notes:?}");
}

#[cfg(feature = "plot")]
#[test]
fn explain_draws_the_layer() {
    let folder = folder();
    let output = run(folder.path(), ["explain", "good.toml", "--svg", "layer.svg"]);
    assert_eq!(output.status.code(), Some(0), "{}", told(&output));
    assert_eq!(output.stdout, run(folder.path(), ["explain", "good.toml"]).stdout, "the figure comes beside the text");
    let svg = fs::read_to_string(folder.path().join("layer.svg")).unwrap();
    let document = roxmltree::Document::parse(&svg).expect("well-formed XML");
    let texts: Vec<_> = document.descendants().filter(|n| n.has_tag_name("text")).filter_map(|n| n.text()).collect();
    for panel in ["shear modulus µ", "scaled flexibility of the surface"] {
        assert!(texts.iter().any(|text| text.starts_with(panel)), "{panel} in {texts:?}");
    }
    assert_eq!(files(folder.path()), ["good.toml", "layer.svg"].map(PathBuf::from), "no temporary file stays");
}

/// A solid that is the same everywhere has a flexibility, if a dull one; one without laws has nothing to draw.
#[cfg(feature = "plot")]
#[test]
fn explain_draws_what_there_is() {
    let folder = folder();
    let endless = GOOD.replace("thickness = 5.0", "base = { type = \"infinite\" }");
    let output = feed(folder.path(), &["explain", "-", "--svg", "layer.svg"], endless.as_bytes());
    assert_eq!(output.status.code(), Some(0));
    assert!(told(&output).contains("no figure was drawn"), "a base modulus at no depth");
    assert!(!folder.path().join("layer.svg").exists());
    let homogeneous =
        endless.replace("type = \"exponential\", surface = 1.0, base = 8.0", "type = \"homogeneous\", modulus = 1.0");
    let output = feed(folder.path(), &["explain", "-", "--svg", "layer.svg"], homogeneous.as_bytes());
    let svg = fs::read_to_string(folder.path().join("layer.svg")).unwrap_or_else(|_| panic!("{}", told(&output)));
    assert!(svg.contains("wave number s<"), "{svg}");
    assert!(!svg.contains("depth"), "{svg}");
    let against_datum = homogeneous.replace("poisson = 0.3", "poisson = 0.3\ndatum = 10.0");
    let output = feed(folder.path(), &["explain", "-", "--svg", "layer.svg"], against_datum.as_bytes());
    let svg = fs::read_to_string(folder.path().join("layer.svg")).unwrap_or_else(|_| panic!("{}", told(&output)));
    assert!(svg.contains("wave number × depth of the datum"), "{svg}");
}

#[cfg(feature = "plot")]
#[test]
fn a_figure_of_the_layer_spares_the_scene() {
    let folder = folder();
    for file in ["good.toml", "-", "."] {
        let output = run(folder.path(), ["explain", "good.toml", "--svg", file]);
        assert_eq!(output.status.code(), Some(if file == "." { 3 } else { 2 }), "{}", told(&output));
        assert!(output.stdout.is_empty());
    }
    assert_eq!(fs::read_to_string(folder.path().join("good.toml")).unwrap(), GOOD);
}

#[test]
fn plugins_are_listed_and_described() {
    let folder = folder();
    let list = run(folder.path(), ["plugins"]);
    assert_eq!(list.status.code(), Some(0));
    let list = String::from_utf8(list.stdout).unwrap();
    let all = json(&run(folder.path(), ["plugins", "--json"]).stdout);
    let all = all["plugins"].as_array().unwrap();
    assert!(all.len() >= 8, "{} plugins", all.len());
    for info in all {
        let name = info["name"].as_str().unwrap();
        assert!(list.contains(&format!("  {name} ")), "{name} is not listed");
        let one = run(folder.path(), ["plugins", name]);
        assert_eq!(one.status.code(), Some(0));
        let one = String::from_utf8(one.stdout).unwrap();
        for part in [&info["summary"], &info["source"]] {
            assert!(one.contains(part.as_str().unwrap()), "{name}: {part} is missing");
        }
        let one = json(&run(folder.path(), ["plugins", name, "--json"]).stdout);
        assert!(one["plugins"].as_array().unwrap().contains(info), "{name}");
    }
}

/// What a scene names by `type` is found, whether or not a plugin brings it.
#[test]
fn what_is_built_in_is_listed_and_described() {
    let folder = folder();
    let told = |name: &str| told(&run(folder.path(), ["plugins", name]));
    insta::assert_snapshot!(told("goodman") + "\n" + &told("half-plane") + "\n" + &told("rigid"));
    let one = json(&run(folder.path(), ["plugins", "goodman", "--json"]).stdout);
    assert_eq!(one["plugins"], Value::Array(Vec::new()));
    assert_eq!((&one["built_in"][0]["place"], &one["built_in"][0]["name"]), (&"friction".into(), &"goodman".into()));
    // Each example completes a scene.
    for (name, place) in [("goodman", "friction"), ("half-plane", "layer.base"), ("frictionless", "layer.base")] {
        let told = told(name);
        let example =
            told.split("example\n").nth(1).and_then(|rest| rest.split("\nsource").next()).expect("an example");
        let scene = GOOD.replace("[friction]\ntype = \"goodman\"\ncoefficient = 0.3\n", "") + example;
        let check = feed(folder.path(), &["check", "-"], scene.as_bytes());
        assert!(told.contains(place) && check.status.code() == Some(0), "{name}: {}", crate::run::told(&check));
    }
}

/// The name of a family lists it, whether plugins or built in.
#[test]
fn a_family_is_listed_by_its_name() {
    let folder = folder();
    let all = String::from_utf8(run(folder.path(), ["plugins"]).stdout).unwrap();
    let mut parts = String::new();
    for family in ["grading", "punch", "flexibility", "kernel", "quadrature", "base", "friction"] {
        let output = run(folder.path(), ["plugins", family]);
        assert_eq!(output.status.code(), Some(0), "{family}");
        let own = String::from_utf8(output.stdout).unwrap();
        assert!(own.starts_with(&format!("{family} (")), "{own}");
        let column =
            |line: &str| line.trim_start().find("  ").map(|at| line.len() - line.trim_start()[at..].trim_start().len());
        let mut columns = own.lines().skip(1).map(column);
        let first = columns.next();
        assert!(columns.all(|column| Some(column) == first), "one below the other: {own}");
        parts += &own;
    }
    let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(words(&parts), words(&all), "all families, each once");
}

/// Two plugins may share a name: that of a family before it says which is meant.
#[test]
fn a_name_after_its_family_is_the_one_of_both() {
    let folder = folder();
    let told = |names: &[&str]| told(&run(folder.path(), ["plugins"].iter().chain(names)));
    let (both, one, other) = (told(&["table"]), told(&["grading", "table"]), told(&["punch", "table"]));
    let after = |text: &str| text.split_once("stdout -----\n").expect("a description").1.to_owned();
    assert_eq!(after(&both), after(&one) + "\n" + &after(&other));
    assert!(told(&["punch", "tabel"]).contains("unknown punch `tabel`"), "{}", told(&["punch", "tabel"]));
    for words in [&["Hertz"][..], &["punch", "hertz"]] {
        assert!(told(words).contains("it is called `cylinder` here"), "{}", told(words));
    }
    assert!(!told(&["grading", "hertz"]).contains("it is called"), "{}", told(&["grading", "hertz"]));
    assert!(told(&["punch", "exponential"]).starts_with("exit code: 2"), "a grading, and no punch");
}

/// A file that cannot be is no success: it is refused before anything is solved, with what to write in the scene.
#[test]
fn files_that_the_scene_leaves_nothing_to_write_in() {
    let folder = folder();
    let cases = [
        ("svg_of_one_point", "--svg", "x = [0.3]"),
        ("svg_of_one_point_twice", "--svg", "x = [0.3, 0.3]"),
        ("svg_of_two_ends", "--svg", "points = 2"),
        ("svg_of_numbers", "--svg", "quantities = [\"edge\"]"),
        ("svg_of_profile", "--svg", "quantities = [\"profile\", \"load\"]"),
        ("csv_of_numbers", "--csv", "quantities = [\"edge\", \"load\"]"),
    ];
    for (name, option, output) in cases.into_iter().filter(|case| cfg!(feature = "plot") || case.1 != "--svg") {
        fs::write(folder.path().join("scene.toml"), format!("{GOOD}\n[output]\n{output}\n")).unwrap();
        let before = files(folder.path());
        let solved = run(folder.path(), ["solve", "scene.toml", option, "out"]);
        assert_eq!(files(folder.path()), before, "{name}");
        insta::assert_snapshot!(format!("nothing_in_{name}"), told(&solved));
    }
    let fine: &[_] = if cfg!(feature = "plot") { &["--svg", "--csv"] } else { &["--csv"] };
    for output in ["x = [0.3, 0.2]", "quantities = [\"profile\", \"load\", \"pressure\"]"] {
        fs::write(folder.path().join("scene.toml"), format!("{GOOD}\n[output]\n{output}\n")).unwrap();
        for option in fine {
            let solved = run(folder.path(), ["solve", "scene.toml", option, "out"]);
            assert!(solved.status.code() == Some(0) && solved.stderr.is_empty(), "{}", told(&solved));
            fs::remove_file(folder.path().join("out")).expect("it was written");
        }
    }
}

#[test]
fn explain_fills_in_every_default() {
    let output = run(folder().path(), ["explain", "good.toml"]);
    let told = told(&output);
    for default in
        ["plane = \"strain\"", "moduli = \"shear\"", "strain = \"history\"", "tolerance = 1e-8", "points = 201"]
    {
        assert!(told.contains(default), "{default}: {told}");
    }
}

/// The set of names: a plugin that is lost, or new, is noticed.
#[test]
fn the_plugins_by_name() {
    insta::assert_snapshot!(told(&run(folder().path(), ["plugins"])));
}

#[test]
fn a_described_plugin() {
    insta::assert_snapshot!(told(&run(folder().path(), ["plugins", "cylinder"])));
}

#[test]
fn an_unknown_plugin_gets_the_nearest_name() {
    let output = run(folder().path(), ["plugins", "cylindre"]);
    assert_eq!(output.status.code(), Some(2));
    insta::assert_snapshot!(told(&output));
}

#[test]
fn wrong_arguments_are_bad_input() {
    let folder = folder();
    let cases: [&[&str]; 8] = [
        &[],
        &["slove", "good.toml"],
        &["solve"],
        &["solve", "good.toml", "--jsn", "x"],
        &["solve", "good.toml", "--json"],
        &["solve", "good.toml", "--csv", "-"],
        &["solve", "good.toml", "--curve-csv", "-"],
        &["check", "good.toml", "good.toml"],
    ];
    for arguments in cases {
        let output = run(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(output.stdout.is_empty() && !output.stderr.is_empty(), "{arguments:?}");
    }
    for arguments in [["--help"], ["--version"]] {
        let output = run(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert!(!output.stdout.is_empty() && output.stderr.is_empty(), "{arguments:?}");
    }
}

/// Results that would overwrite one another, or the scene, under whatever name.
#[test]
fn outputs_must_be_distinct() {
    let folder = folder();
    fs::create_dir(folder.path().join("sub")).unwrap();
    fs::write(folder.path().join("out.json"), "old").unwrap();
    let absolute = folder.path().join("good.toml");
    let absolute = absolute.to_str().unwrap();
    let cases: [&[&str]; 6] = [
        &["--json", "same", "--csv", "same"],
        &["--curve-csv", "same", "--csv", "same"],
        &["--json", "out.json", "--csv", "sub/../out.json"],
        &["--json", "good.toml"],
        &["--csv", "./sub/../good.toml"],
        &["--json", absolute],
    ];
    for outputs in cases {
        let output = run(folder.path(), ["solve", "good.toml"].iter().chain(outputs));
        assert_eq!(output.status.code(), Some(2), "{outputs:?}: {}", told(&output));
    }
    assert_eq!(fs::read_to_string(folder.path().join("good.toml")).unwrap(), GOOD);
    assert_eq!(fs::read_to_string(folder.path().join("out.json")).unwrap(), "old");
    insta::assert_snapshot!(
        "outputs_same",
        told(&run(folder.path(), ["solve", "good.toml", "--json", "a", "--csv", "a"]))
    );
    insta::assert_snapshot!("outputs_scene", told(&run(folder.path(), ["solve", "good.toml", "--csv", "good.toml"])));
}

/// Measured data are not given away for a result, under whatever name.
#[test]
fn no_result_takes_the_place_of_the_data() {
    const PROFILE: &str = "x, height\n0, 0\n1, 0.1\n2, 0.4\n3, 0.9\n4, 1.6\n";
    let folder = folder();
    let scene = GOOD.replace("type = \"flat\"\nhalf_width = 1.0", "type = \"table\"\nfile = \"profile.csv\"");
    fs::create_dir(folder.path().join("sub")).unwrap();
    fs::write(folder.path().join("table.toml"), scene.replace("force = 1.0", "half_width = 1.0")).unwrap();
    fs::write(folder.path().join("profile.csv"), PROFILE).unwrap();
    let cases: [&[&str]; 6] = [
        &["solve", "table.toml", "--csv", "profile.csv"],
        &["solve", "table.toml", "--json", "sub/../profile.csv"],
        &["solve", "table.toml", "--curve-csv", "profile.csv"],
        &["solve", "table.toml", "--svg", "profile.csv"],
        &["solve", "table.toml", "--curve-svg", "profile.csv"],
        &["explain", "table.toml", "--svg", "profile.csv"],
    ];
    for arguments in &cases[..if cfg!(feature = "plot") { 6 } else { 3 }] {
        let output = run(folder.path(), *arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", told(&output));
        assert!(told(&output).contains("would overwrite profile.csv, which the scene reads"), "{}", told(&output));
        assert_eq!(fs::read_to_string(folder.path().join("profile.csv")).unwrap(), PROFILE, "{arguments:?}");
    }
    let spared = run(folder.path(), ["solve", "table.toml", "--csv", "result.csv"]);
    assert_eq!(spared.status.code(), Some(0), "{}", told(&spared));
}

#[test]
fn an_output_that_cannot_be_written_leaves_the_others_alone() {
    let folder = folder();
    fs::create_dir(folder.path().join("taken")).unwrap();
    fs::write(folder.path().join("out.json"), "old").unwrap();
    let before = files(folder.path());
    for (name, csv) in [
        ("directory", "taken"),
        ("directory_to_come", "results/"),
        ("missing", "nowhere/out.csv"),
        ("file_as_folder", "good.toml/out.csv"),
    ] {
        let output = run(folder.path(), ["solve", "good.toml", "--json", "out.json", "--csv", csv]);
        assert_eq!(output.status.code(), Some(3), "{name}");
        assert_eq!(fs::read_to_string(folder.path().join("out.json")).unwrap(), "old", "{name}");
        assert_eq!(files(folder.path()), before, "{name}");
        if name != "file_as_folder" {
            insta::assert_snapshot!(format!("output_{name}"), told(&output));
        }
    }
}

#[cfg(unix)]
mod unix {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    fn mode(path: &Path) -> u32 {
        fs::metadata(path).unwrap().permissions().mode() & 0o777
    }

    #[test]
    fn results_have_the_permissions_of_any_new_file() {
        let folder = folder();
        let out = folder.path().join("out.json");
        run(folder.path(), ["solve", "good.toml", "--json", "out.json"]);
        assert_eq!(mode(&out), mode(&folder.path().join("good.toml")), "not private like a temporary file");
        fs::set_permissions(&out, fs::Permissions::from_mode(0o660)).unwrap();
        run(folder.path(), ["solve", "good.toml", "--json", "out.json"]);
        assert_eq!(mode(&out), 0o660, "a replaced file keeps its permissions");
    }

    #[test]
    fn a_link_stays_a_link() {
        let folder = folder();
        fs::write(folder.path().join("real.json"), "old").unwrap();
        symlink("real.json", folder.path().join("link.json")).unwrap();
        symlink("good.toml", folder.path().join("scene.json")).unwrap();
        run(folder.path(), ["solve", "good.toml", "--json", "link.json"]);
        assert!(folder.path().join("link.json").is_symlink());
        json(&fs::read(folder.path().join("real.json")).unwrap());
        let output = run(folder.path(), ["solve", "good.toml", "--json", "scene.json"]);
        assert_eq!(output.status.code(), Some(2), "a link to the scene is the scene");
        // What it leads to is yet to come.
        symlink("new.json", folder.path().join("to_new.json")).unwrap();
        let output = run(folder.path(), ["solve", "good.toml", "--json", "to_new.json", "--csv", "new.json"]);
        assert_eq!(output.status.code(), Some(2), "two names of one file");
        run(folder.path(), ["solve", "good.toml", "--json", "to_new.json"]);
        assert!(folder.path().join("to_new.json").is_symlink());
        json(&fs::read(folder.path().join("new.json")).unwrap());
        symlink("ring.json", folder.path().join("ring.json")).unwrap();
        let output = run(folder.path(), ["solve", "good.toml", "--json", "ring.json"]);
        assert!(output.status.code().is_some_and(|code| code > 1), "{}", told(&output));
    }

    /// A device must be written to, never replaced by a file.
    #[test]
    fn devices_stay_devices() {
        let folder = folder();
        let output = run(folder.path(), ["solve", "good.toml", "--json", "/dev/null", "--csv", "/dev/null"]);
        assert!(matches!(output.status.code(), Some(0 | 1)), "{}", told(&output));
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }

    /// Standard output by its name is a pipe here, beside a file that is replaced.
    #[test]
    fn a_pipe_takes_a_result() {
        let folder = folder();
        let output = run(folder.path(), ["solve", "good.toml", "--csv", "/dev/stdout", "--json", "out.json"]);
        let told = String::from_utf8(output.stdout).unwrap();
        assert!(told.contains("x,pressure,shear\n-1.0,"), "{told}");
        assert!(folder.path().join("out.json").exists());
    }

    #[test]
    fn a_reader_that_goes_away_is_no_failure() {
        let folder = folder();
        let mut child =
            program(folder.path()).args(["plugins"]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", told(&output));
        assert!(output.stderr.is_empty(), "{}", told(&output));
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_full_disk_is_a_failure() {
        let folder = folder();
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = program(folder.path()).args(["plugins"]).stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(3), "{}", told(&output));
        let output = run(folder.path(), ["solve", "good.toml", "--json", "out.json", "--csv", "/dev/full"]);
        assert_eq!(output.status.code(), Some(3), "{}", told(&output));
        assert!(!folder.path().join("out.json").exists(), "all or nothing");
    }

    #[test]
    fn an_interrupt_has_its_exit_code() {
        use std::io::{Read, Write};
        let folder = folder();
        let mut child =
            program(folder.path()).args(["check", "-"]).stdin(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // Once it has taken more than a pipe holds, it is reading and will go on to wait for the rest.
        let mut scene = child.stdin.take().unwrap();
        scene.write_all(&vec![b'#'; 1 << 20]).unwrap();
        kill("-TERM", &child);
        let status = child.wait().unwrap();
        drop(scene);
        let mut told = String::new();
        child.stderr.take().unwrap().read_to_string(&mut told).unwrap();
        assert_eq!(status.code(), Some(130), "{told}");
    }

    /// Tests that run in the background ignore SIGINT, and so do the programs that they start.
    fn kill(signal: &str, child: &std::process::Child) {
        // That of the shell: not every machine has another.
        let killed =
            std::process::Command::new("sh").args(["-c", &format!("kill {signal} {}", child.id())]).status().unwrap();
        assert!(killed.success());
    }

    /// As `nohup` and shells without job control start programs.
    #[cfg(target_os = "linux")]
    #[test]
    fn signals_that_were_ignored_are_ignored() {
        use std::io::Write;
        let script = format!("trap '' HUP INT; exec '{}' check -", env!("CARGO_BIN_EXE_slipzone"));
        let mut command = std::process::Command::new("sh");
        let mut child = command.args(["-c", &script]).stdin(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut scene = child.stdin.take().unwrap();
        // More than a pipe holds: it is reading.
        scene.write_all(&vec![b'#'; 1 << 20]).unwrap();
        kill("-HUP", &child);
        kill("-INT", &child);
        scene.write_all(&vec![b'#'; 1 << 20]).expect("it goes on reading");
        drop(scene);
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{}", told(&output));
    }

    /// A pipe that nobody reads keeps the program waiting when all files but that are ready.
    #[test]
    fn an_interrupt_leaves_no_temporary_file() {
        let folder = folder();
        assert!(std::process::Command::new("mkfifo").arg(folder.path().join("pipe")).status().unwrap().success());
        let before = files(folder.path());
        let mut child = program(folder.path())
            .args(["solve", "good.toml", "--csv", "out.csv", "--json", "pipe"])
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let is_written = |name: &std::path::PathBuf| {
            let length = fs::metadata(folder.path().join(name)).map_or(0, |found| found.len());
            name.to_string_lossy().starts_with(".slipzone-") && length > 0
        };
        while !files(folder.path()).iter().any(is_written) && child.try_wait().unwrap().is_none() {
            std::thread::yield_now();
        }
        kill("-TERM", &child);
        assert_eq!(child.wait().unwrap().code(), Some(130));
        assert_eq!(files(folder.path()), before);
    }

    /// A run that is killed outright cannot clear up after itself: the next one does, a day later.
    #[test]
    fn what_a_killed_run_left_is_removed() {
        let folder = folder();
        let make = |name: &str, hours: u64| {
            let file = fs::File::create(folder.path().join(name)).unwrap();
            file.set_modified(std::time::SystemTime::now() - std::time::Duration::from_hours(hours)).unwrap();
        };
        make(".slipzone-aB3dE6", 25);
        // Of a run that may be alive, and what is no temporary file of the program.
        let kept = [(".slipzone-fG8hI0", 23), (".slipzone-notes.txt", 25), (".slipzone-", 25), ("slipzone-aB3dE6", 25)];
        for (name, hours) in kept {
            make(name, hours);
        }
        let output = run(folder.path(), ["solve", "good.toml", "--json", "out.json"]);
        assert_eq!(output.status.code(), Some(0), "{}", told(&output));
        let left = files(folder.path());
        assert!(!left.contains(&".slipzone-aB3dE6".into()), "{left:?}");
        assert!(kept.iter().all(|(name, _)| left.contains(&name.into())), "{left:?}");
    }

    /// `>>` and `>`: what is there stays, and the report goes on behind the result.
    #[cfg(target_os = "linux")]
    #[test]
    fn standard_output_by_its_name_is_not_replaced() {
        let folder = folder();
        let log = folder.path().join("log");
        symlink("/dev/stdout", folder.path().join("link")).unwrap();
        for (append, name) in [true, false].into_iter().flat_map(|append| [(append, "/dev/stdout"), (append, "link")]) {
            fs::write(&log, "what was there\n").unwrap();
            let out = fs::OpenOptions::new().append(append).write(true).truncate(!append).open(&log).unwrap();
            let solved = program(folder.path()).args(["solve", "good.toml", "--csv", name]).stdout(out).status();
            assert_eq!(solved.unwrap().code(), Some(0));
            let text = fs::read_to_string(&log).unwrap();
            let before = if append { "what was there\n" } else { "" };
            assert!(text.starts_with(&format!("{before}x,pressure,shear\n-1.0,")), "{text}");
            assert!(text.contains("stick"), "the report: {text}");
        }
    }

    #[test]
    fn a_file_protected_from_writing_is_left_alone() {
        let folder = folder();
        let out = folder.path().join("out.json");
        fs::write(&out, "kept").unwrap();
        fs::set_permissions(&out, fs::Permissions::from_mode(0o444)).unwrap();
        let output = run(folder.path(), ["solve", "good.toml", "--json", "out.json"]);
        assert_eq!(output.status.code(), Some(3), "{}", told(&output));
        assert!(told(&output).contains("cannot write out.json: it is write-protected"), "{}", told(&output));
        assert_eq!(fs::read_to_string(&out).unwrap(), "kept");
    }

    /// Even the superuser writes no file there; the name of the temporary one would only puzzle.
    #[cfg(target_os = "linux")]
    #[test]
    fn a_folder_that_takes_no_file_is_told_by_the_name_asked_for() {
        let output = run(folder().path(), ["solve", "good.toml", "--json", "/proc/out.json"]);
        assert_eq!(output.status.code(), Some(3), "{}", told(&output));
        let told = told(&output);
        assert!(told.contains("cannot write /proc/out.json: ") && !told.contains(".slipzone-"), "{told}");
    }
}
