//! Scenes that are fine, read by the library.

// A number in a file and the number in memory are the same bits, or something is wrong.
#![allow(clippy::float_cmp)]

use slipzone::api::{Friction, Positive};
use slipzone::engine::{Solver, Status, refusal, solve};
use slipzone::scene::{Load, LoadKind, Model, Scene, parse};

const GOOD: &str = "format = 1
[layer]
thickness = 5.0
poisson = 0.3
grading = { surface = 1.0, base = 8.0, type = \"exponential\" }
[punch]
half_width = 1.0
type = \"flat\"
[load]
force = 1.0
";

#[test]
fn poissons_ratio_up_to_its_limits() {
    for poisson in ["-0.99", "-0.9999999", "0", "0.0", "1e-300", "0.4999", "0.5"] {
        let scene = parse("p", &GOOD.replace("poisson = 0.3", &format!("poisson = {poisson}"))).unwrap();
        assert_eq!(scene.layer.poisson.get(), poisson.parse::<f64>().unwrap());
    }
    for poisson in ["-1", "0.5001", "0.5000000000000001", "inf"] {
        let error = parse("p", &GOOD.replace("poisson = 0.3", &format!("poisson = {poisson}"))).unwrap_err();
        assert_eq!((error.line, error.column), (4, 11), "{error}");
    }
}

/// Bases that the engine may yet decline are scenes all the same.
#[test]
fn every_base_is_a_scene() {
    for base in ["rigid", "frictionless", "half-plane\", shear = 2.0, poisson = \"0.2"] {
        let base = format!("thickness = 5.0\nbase = {{ type = \"{base}\" }}").replace("\"0.2\"", "0.2");
        parse("b", &GOOD.replace("thickness = 5.0", &base)).unwrap_or_else(|error| panic!("{error}"));
    }
    let infinite =
        GOOD.replace("thickness = 5.0", "base = { type = \"infinite\" }").replace("base = 8.0", "gradient = -0.1");
    parse("b", &infinite).unwrap_or_else(|error| panic!("{error}"));
}

/// Every number is written so that it reads back exactly, and defaults stay what they were.
#[test]
fn written_scenes_read_back_the_same() {
    let full = format!(
        "title = \"quotes \\\" and µ\"\n{GOOD}
[friction]
type = \"goodman\"
coefficient = 0.1
[solver]
tolerance = 1e-13
flexibility = {{ type = \"compliance\" }}
kernel = {{ type = \"truncated\", cutoff = 33.333333333333336 }}
quadrature = {{ type = \"gauss-chebyshev\", n = 40 }}
[output]
x = [-1, -0.1, 0.30000000000000004, 1.0]
[units]
length = \"µm\"
"
    );
    let mut texts = vec![full];
    for load in [
        "path = { force = [1, 0.30000000000000004e1] }",
        "path = { indentation = [5e-9] }",
        "until = { force = 0.1 }",
        "until = { points = 7, indentation = 123456789012345680 }",
    ] {
        texts.push(GOOD.replace("force = 1.0", load));
    }
    // The shortest decimals of numbers near both ends of the range, and some with all digits in use.
    for number in ["1.0000000000000002e-100", "9.999999999999999e99", "0.1", "5e-9", "123456789012345680"] {
        let text = GOOD.replace("force = 1.0", &format!("force = {number}"));
        let scene = parse("n", &text).unwrap_or_else(|error| panic!("{error}"));
        assert!(matches!(scene.load, Load::Force(force) if force.get() == number.parse::<f64>().unwrap()), "{number}");
        texts.push(text);
    }
    for text in texts {
        let scene = parse("first", &text).unwrap_or_else(|error| panic!("{error}"));
        let written = toml::to_string(&scene).unwrap();
        let again = parse("again", &written).unwrap_or_else(|error| panic!("{error}\n{written}"));
        assert_eq!(format!("{scene:?}"), format!("{again:?}"), "{written}");
        assert_eq!(toml::to_string(&again).unwrap(), written);
    }
}

/// Where `type` stands in a table is the writer's choice; the error's place does not depend on it.
#[test]
fn errors_keep_their_place_when_type_comes_last() {
    let error = parse("t", &GOOD.replace("half_width = 1.0", "half_width = -1.0")).unwrap_err();
    assert_eq!((error.line, error.column), (7, 14), "{error}");
    let error = parse("t", &GOOD.replace("surface = 1.0", "surface = \"soft\"")).unwrap_err();
    assert_eq!((error.line, error.column), (5, 23), "{error}");
}

/// What a path stands for: its loads in order, the last of them the scene's.
#[test]
fn loads_of_a_path() {
    let loads = |text: &str| {
        let scene = parse("p", &GOOD.replace("force = 1.0", text)).unwrap_or_else(|error| panic!("{error}"));
        let path = scene.path.expect("a path");
        assert_eq!(path.last(), scene.load, "{text}");
        assert_eq!((path.kind(), path.points()), (scene.load.kind(), path.loads().len()), "{text}");
        (scene.load.kind(), path.loads().map(|load| load.value().get()).collect::<Vec<_>>())
    };
    assert_eq!(loads("path = { force = [0.2, 1, 2.5] }"), (LoadKind::Force, vec![0.2, 1.0, 2.5]));
    assert_eq!(loads("[load.path]\nindentation = [0.1]"), (LoadKind::Indentation, vec![0.1]));
    assert_eq!(loads("until = { indentation = 1.0, points = 4 }").1, [0.25, 0.5, 0.75, 1.0]);
    let (kind, equal) = loads("until.force = 6.0");
    assert_eq!((kind, equal.len(), equal[0], equal[59]), (LoadKind::Force, 60, 0.1, 6.0), "60 steps unless it says");
    assert_eq!(parse("p", GOOD).unwrap().path, None);
}

/// A half-width is a load of a cylinder though not of a flat punch.
#[test]
fn loads_of_a_cylinder() {
    let cylinder = GOOD.replace("half_width = 1.0\ntype = \"flat\"", "type = \"cylinder\"\nradius = 10.0");
    for load in ["force", "half_width", "indentation"] {
        parse("l", &cylinder.replace("force", load)).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// Any slip of the keyboard is a scene or an error with a place in the text, never a panic.
#[test]
fn one_wrong_character_anywhere() {
    let text = format!("{GOOD}[output]\nx = [-1, 0.5]\n[friction]\ntype = \"goodman\"\ncoefficient = 0.1\n");
    let path = text.replace("force = 1.0", "path = { force = [0.5, 1.0] }");
    let until = text.replace("force = 1.0", "until = { force = 1.0, points = 60 }");
    for text in [text, path, until] {
        one_wrong_character(&text);
    }
}

fn one_wrong_character(text: &str) {
    parse("good", text).unwrap();
    let lines = text.lines().count();
    for at in 0..text.len() {
        let slips = ["", "0", "-", "e", ".", "=", "[", "]", "{", "}", "\"", "'", "\\", "\n", "\r", "#", ",", "µ", "\0"];
        for slip in slips {
            for kept in [at, at + 1] {
                let wrong = format!("{}{slip}{}", &text[..at], &text[kept..]);
                let Err(error) = parse("wrong", &wrong) else { continue };
                assert!((1..=lines + 1).contains(&error.line), "{error}");
                assert!(error.found.is_some() && !error.message.is_empty(), "{error}");
                assert!(wrong.get(error.span.clone()).is_some(), "{error}");
                assert!(error.excerpt.get(error.marked.clone()).is_some(), "{error}");
            }
        }
    }
}

/// The same for whole lines left out, doubled or swapped.
#[test]
fn one_wrong_line_anywhere() {
    let lines: Vec<_> = GOOD.lines().collect();
    for at in 0..lines.len() {
        for other in 0..lines.len() {
            let mut wrong = lines.clone();
            wrong.swap(at, other);
            let swapped = wrong.join("\n");
            wrong.remove(other);
            for text in [swapped, wrong.join("\n"), [GOOD, lines[at], "\n", lines[other]].concat()] {
                if let Err(error) = parse("wrong", &text) {
                    assert!(error.found.is_some() && error.expected.is_some(), "{error}");
                }
            }
        }
    }
}

fn positive(value: f64) -> Positive {
    Positive::new(value).unwrap()
}

/// What no text describes, a program may put into a scene: it is refused, whoever is asked, and the reports are
/// written.
#[test]
fn a_scene_that_was_changed_in_code_is_looked_at() {
    type Change = fn(&mut Scene);
    let cases: [(&str, Change); 13] = [
        ("`format`", |scene| scene.format = 7),
        ("`solver.tolerance`", |scene| scene.solver.tolerance = positive(1e300)),
        ("`solver.tolerance`", |scene| scene.solver.tolerance = positive(1e-15)),
        ("`solver.forbid`", |scene| scene.solver.forbid = vec![Model::Full]),
        ("`output.points`", |scene| scene.output.points = 0),
        ("`output.x`", |scene| scene.output.x = Some(vec![0.5, f64::NAN])),
        ("`output.x`", |scene| scene.output.x = Some(vec![2.0])),
        ("`output.x`", |scene| scene.output.x = Some(vec![])),
        ("`layer`", |scene| scene.layer.thickness = Some(positive(1e300))),
        ("`layer.thickness`", |scene| scene.layer.thickness = None),
        ("`friction.coefficient`", |scene| scene.friction = Some(Friction::goodman(positive(1e9)))),
        ("`load`", |scene| scene.load = Load::Force(positive(1e300))),
        ("`load`", |scene| scene.load = Load::Indentation(positive(1e-300))),
    ];
    let good = parse("good", GOOD).unwrap();
    assert_eq!(good.check(), Ok(()));
    for (key, change) in cases {
        let mut scene = good.clone();
        change(&mut scene);
        let solution = solve(&scene);
        assert_eq!(solution.status, Status::Refused, "{key}");
        let reason = solution.reason.clone().unwrap();
        assert!(reason.starts_with(key) && reason.ends_with("`Scene::check` tells what is allowed"), "{key}: {reason}");
        assert!(refusal(&scene).is_some() || key == "`load`", "{key}");
        assert!(scene.check().is_err(), "{key}");
        assert!(slipzone::report::json(&solution).contains("refused"), "{key}");
        assert_eq!(slipzone::report::csv(&solution).lines().count(), 1, "{key}");
    }
}

/// So is a load that another is followed by.
#[test]
fn a_load_beyond_all_numbers_is_refused() {
    let cylinder = GOOD.replace("half_width = 1.0\ntype = \"flat\"", "radius = 1.0\ntype = \"cylinder\"");
    // The model `thin` tells no tractions.
    let cylinder = cylinder + "[output]\nquantities = [\"load\"]\n";
    let mut solver = Solver::new(&parse("good", &cylinder).unwrap()).unwrap();
    let first = solver.solve();
    for model in [None, Some(Model::Thin)] {
        let mut scene = parse("good", &cylinder).unwrap();
        scene.solver.model = model;
        let mut solver = Solver::new(&scene).unwrap();
        for load in [Load::HalfWidth, Load::Force, Load::Indentation] {
            solver.press(load(Positive::new(1e300).unwrap()));
            let refused = solver.solve();
            assert_eq!(refused.status, Status::Refused);
            assert!(refused.reason.unwrap().starts_with("`load` "));
        }
    }
    solver.press(Load::HalfWidth(Positive::new(1e300).unwrap()));
    assert_eq!(solver.solve().status, Status::Refused);
    solver.press(Load::Force(Positive::new(1.0).unwrap()));
    assert_eq!(solver.solve().load.half_width, first.load.half_width);
}

/// Every example of a check that needs the whole scene is told of one in memory, too.
#[test]
fn a_scene_in_memory_is_checked_as_one_in_a_file() {
    let mut scene = parse("good", GOOD).unwrap();
    scene.title = Some("two\nlines".into());
    assert_eq!(scene.check().unwrap_err().message, "`title` holds a control character");
    let mut scene = parse("good", GOOD).unwrap();
    scene.load = Load::HalfWidth(Positive::new(1.0).unwrap());
    assert_eq!(scene.check().unwrap_err().message, "a half-width as load on a punch whose contact is fixed");
}
