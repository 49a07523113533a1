//! Every scene in `examples/`: it solves, it draws, and those with a reference agree with it.

use serde_json::Value;
use slipzone::api::Files;
#[cfg(feature = "plot")]
use slipzone::engine::{DepthProfile, FlexibilityProfile, response};
use slipzone::engine::{Status, solve, solve_all};
use slipzone::scene::{Scene, parse_with};

/// The folder of the examples.
struct Folder;

impl Files for Folder {
    fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        std::fs::read(format!("{}/examples/{name}", env!("CARGO_MANIFEST_DIR"))).map_err(|error| error.to_string())
    }
}

fn scenes() -> Vec<(String, Scene)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
    let mut scenes: Vec<_> = std::fs::read_dir(folder)
        .expect("the examples")
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .map(|path| {
            let name = path.file_name().expect("a file").to_string_lossy().into_owned();
            let text = std::fs::read_to_string(&path).expect("readable text");
            let scene = parse_with(&name, &text, &Folder).unwrap_or_else(|e| panic!("{e}"));
            (name, scene)
        })
        .collect();
    scenes.sort_by(|one, other| one.0.cmp(&other.0));
    assert!(
        scenes.len() >= 34,
        "Table 1, figures 2 and 6, one of each punch, grading and base: {} scenes",
        scenes.len()
    );
    scenes
}

/// As those that read JSON into a tree of it have them.
#[test]
fn every_example_is_read_back_with_sorted_keys() {
    for (name, scene) in scenes() {
        let mut value = serde_json::to_value(&scene).expect("a scene is plain data");
        value.sort_all_objects();
        let again: Scene = serde_json::from_value(value.clone()).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(serde_json::to_value(&again).expect("plain data"), value, "{name}");
    }
}

#[test]
fn every_example_converges_and_draws() {
    for (name, scene) in scenes() {
        let solution = solve(&scene);
        assert_eq!(solution.status, Status::Converged, "{name}: {:?}", solution.reason);
        #[cfg(feature = "plot")]
        assert!(slipzone::report::svg(&solution).unwrap_or_else(|e| panic!("{name}: {e}")).contains("</svg>"));
        let Some(curve) = &solution.path else { continue };
        assert_eq!(curve.status, Status::Converged, "{name}: {:?}", curve.note);
        #[cfg(feature = "plot")]
        assert!(slipzone::report::curve_svg(&solution).unwrap_or_else(|e| panic!("{name}: {e}")).contains("</svg>"));
    }
}

/// The figures of the documents, drawn again.
#[cfg(feature = "plot")]
#[test]
fn the_figures_of_the_documents_are_what_the_program_draws() {
    let mut compared = 0;
    for (name, scene) in scenes() {
        let stem = name.trim_end_matches(".toml");
        let drawn = |file: String, draw: &dyn Fn() -> String| {
            let path = format!("{}/docs/figures/{file}.svg", env!("CARGO_MANIFEST_DIR"));
            let Ok(committed) = std::fs::read_to_string(path) else { return 0 };
            crate::figures::assert_same(&file, &committed, &draw());
            1
        };
        let solution = solve(&scene);
        let tractions = || slipzone::report::svg(&solution).expect("a figure");
        let curve = || slipzone::report::curve_svg(&solution).expect("a figure");
        compared += drawn(format!("punch_{stem}"), &tractions);
        let layer = || {
            let depths = DepthProfile::new(&scene.layer).expect("a law");
            let flexibility = FlexibilityProfile::new(&*response(&scene).expect("a response")).expect("numbers");
            slipzone::report::layer_svg(&scene, depths.as_ref(), Some(&flexibility)).expect("a figure")
        };
        if stem.starts_with("layer_") {
            compared += drawn(stem.into(), &layer);
        }
        if stem == "flat" {
            compared += drawn(stem.into(), &tractions);
        }
        if solution.path.is_some() {
            compared += drawn(stem.into(), &curve);
        }
    }
    assert_eq!(compared, 24, "nine punches, the flat one again in the README, a loading curve, thirteen layers");
}

/// Line by line, in that order; between `...` whatever there is.
#[cfg(feature = "cli")]
#[test]
fn the_readme_shows_what_the_program_prints() {
    let readme = include_str!("../../README.md");
    let (_, shown) = readme.split_once("```text\n").expect("an output");
    let (shown, _) = shown.split_once("```").expect("its end");
    let output = crate::run::run(env!("CARGO_MANIFEST_DIR").as_ref(), ["solve", "examples/flat.toml"]);
    let printed = String::from_utf8(output.stdout).expect("the program writes UTF-8");
    let mut printed = printed.lines().map(str::trim_end);
    for line in shown.lines().filter(|line| !line.ends_with("...")) {
        assert!(printed.any(|printed| printed == line), "not printed, or not there: {line}");
    }
}

/// The table of edge factors, row by row.
#[cfg(feature = "cli")]
#[test]
fn the_readme_tells_edge_factors_as_the_program_prints_them() {
    let rows =
        include_str!("../../README.md").lines().map(|line| line.split('|').map(str::trim).collect::<Vec<&str>>());
    let mut compared = 0;
    for row in rows {
        let ["", thickness, ratio, _, value, error, independent, ""] = row[..] else { continue };
        if independent.parse::<f64>().is_err() {
            continue;
        }
        let scene = format!("examples/table1_h{thickness}_ratio{}.toml", ratio.replace('/', "_"));
        let output = crate::run::run(env!("CARGO_MANIFEST_DIR").as_ref(), ["solve", &scene]);
        let printed = String::from_utf8(output.stdout).expect("the program writes UTF-8");
        let line = printed.lines().find(|line| line.starts_with("edge ratio")).expect("an edge ratio");
        let told: Vec<&str> = line.split_whitespace().rev().take(2).collect();
        assert_eq!([value, error], [told[1], told[0]], "{scene}");
        compared += 1;
    }
    assert_eq!(compared, 9, "rows");
}

#[test]
fn the_messages_in_the_documents_are_what_the_program_says() {
    let document = include_str!("../../docs/punches.md");
    let said = |message: &str| assert!(document.contains(message), "docs/punches.md does not say: {message}");
    let scene = |layer: &str, punch: &str, load: &str| {
        let text = format!(
            "format = 1\nlayer = {{ {layer} }}\npunch = {{ {punch} }}\n\
             friction = {{ type = \"goodman\", coefficient = 0.1 }}\nload = {{ half_width = {load} }}\n"
        );
        parse_with("scene.toml", &text, &Folder)
    };
    let layer = r#"thickness = 5.0, poisson = 0.3, grading = { type = "exponential", surface = 1.0, base = 8.0 }"#;
    let thin = r#"thickness = 0.5, poisson = 0.4, grading = { type = "homogeneous", modulus = 1.0 }"#;
    let formula = |height: &str, parameter: &str| {
        format!(r#"type = "formula", height = "{height}", parameters = {{ {parameter} }}"#)
    };
    for (layer, punch, load) in [
        (layer, formula("R*(1 - cos(x/R))", "R = 0.5"), "1.2"),
        (thin, r#"type = "cylinder", radius = 10.0"#.into(), "1.0"),
    ] {
        let solution = solve(&scene(layer, &punch, load).unwrap_or_else(|e| panic!("{e}")));
        assert_eq!(solution.status, Status::AssumptionViolated);
        said(&solution.reason.expect("a reason"));
    }
    for (punch, load) in [
        (formula("0.05*x^2 - k*x", "k = 0.01"), "1.0"),
        (r#"type = "table", file = "profile.csv", height_unit = 1e-3"#.into(), "2.5"),
    ] {
        let error = scene(layer, &punch, load).expect_err("not a punch, or not so wide");
        // The message, and what is shown under the line.
        for line in error.to_string().lines().filter(|line| line.starts_with("error") || line.contains("   = ")) {
            said(line.trim());
        }
    }
}

#[test]
fn table_1_is_reproduced_to_the_independent_digits() {
    let cases: Value = serde_json::from_str(include_str!("../data/layer_cases.json")).expect("valid JSON");
    let mut compared = 0;
    for (name, scene) in scenes() {
        let Some(rest) = name.strip_prefix("table1_h") else { continue };
        let (h, ratio) = rest.trim_end_matches(".toml").split_once("_ratio").expect("table1_hH_ratioR.toml");
        let number = |text: &str| text.split('_').map(|n| n.parse::<f64>().expect("a number")).reduce(|a, b| a / b);
        let (h, ratio) = (number(h), number(ratio));
        let case = cases["cases"]
            .as_array()
            .expect("a list")
            .iter()
            .find(|case| {
                (case["h_over_b"].as_f64(), case["mu1_over_mu3"].as_f64(), case["nu"].as_f64()) == (h, ratio, Some(0.3))
            })
            .unwrap_or_else(|| panic!("{name}: no such case in layer_cases.json"));
        let solution = solve(&scene);
        let got = solution.edge.ratio.expect("a number");
        let error = (got / case["flat"]["edge"].as_f64().expect("a number") - 1.0).abs();
        assert!(error < 1e-8, "{name}: edge ratio {got}, error {error:.1e} above the default tolerance");
        compared += 1;
    }
    assert_eq!(compared, 9);
}

#[test]
fn a_batch_gives_the_same_bits_as_one_scene_after_another() {
    let scenes: Vec<Scene> = scenes().into_iter().map(|(_, scene)| scene).collect();
    for (scene, together) in scenes.iter().zip(solve_all(&scenes)) {
        assert_eq!(format!("{:?}", solve(scene)), format!("{together:?}"));
    }
}
