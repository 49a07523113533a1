//! Broken scenes: each is refused with exit code 2 or 3 and a message that helps, and no result that was
//! there before is touched.
//!
//! A case of text is a file in `tests/data/bad`, with the message beside it in `tests/it/snapshots`.

use crate::run::{GOOD, feed, files, folder, program, run, told};
use std::fs::{self, File};
use std::path::Path;

const OUTPUTS: [&str; 3] = ["old.json", "old.csv", "old.svg"];
const OLD: &[u8] = b"a result of yesterday\r\n\0";

/// Solves a scene towards files that exist already; gives what the program tells.
fn solve(folder: &Path, scene: &str, input: Option<&[u8]>) -> std::process::Output {
    for name in OUTPUTS {
        fs::write(folder.join(name), OLD).unwrap();
    }
    let before = files(folder);
    let arguments = ["solve", scene, "--json", "old.json", "--csv", "old.csv", "--svg", "old.svg"];
    let arguments = &arguments[..if cfg!(feature = "plot") { 8 } else { 6 }];
    let output = match input {
        Some(input) => feed(folder, arguments, input),
        None => run(folder, arguments),
    };
    for name in OUTPUTS {
        assert!(fs::read(folder.join(name)).unwrap() == OLD, "{name} was touched");
    }
    assert_eq!(files(folder), before, "files were left behind");
    assert!(output.stdout.is_empty(), "no result goes to standard output");
    output
}

#[test]
fn every_broken_scene_says_what_is_wrong_and_where() {
    insta::glob!("../data/bad", "*.toml", |path| {
        let folder = tempfile::tempdir().unwrap();
        let name = path.file_name().unwrap().to_str().unwrap();
        fs::copy(path, folder.path().join(name)).unwrap();
        let output = solve(folder.path(), name, None);
        assert_eq!(output.status.code(), Some(2), "{name}");
        insta::assert_snapshot!("bad", told(&output));
    });
}

#[test]
fn there_are_enough_broken_scenes() {
    let cases = files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/bad")).len();
    assert!(cases >= 100, "{cases} broken scenes: were files lost?");
}

#[test]
fn check_and_explain_refuse_as_solve_does() {
    let folder = folder();
    fs::write(folder.path().join("bad.toml"), GOOD.replace("0.3", "-1")).unwrap();
    let solved = run(folder.path(), ["solve", "bad.toml"]);
    assert_eq!(solved.status.code(), Some(2));
    for command in ["check", "explain"] {
        assert_eq!(run(folder.path(), [command, "bad.toml"]), solved, "{command}");
    }
}

/// Files that cannot be kept as text.
#[test]
fn files_that_are_no_text() {
    let cases: [(&str, Vec<u8>); 7] = [
        ("utf_8_mark_within", [GOOD.as_bytes(), b"\xef\xbb\xbf", GOOD.as_bytes()].concat()),
        ("empty", vec![]),
        ("binary", b"\x7fELF\x02\x01\x01\x00\xff\xfe".to_vec()),
        ("latin_1", b"format = 1\ntitle = \"\xb5m\"\n".to_vec()),
        ("nul", GOOD.replace("5.0", "5\0.0").into_bytes()),
        ("utf_16", [0xff, 0xfe].into_iter().chain(GOOD.bytes().flat_map(|byte| [byte, 0])).collect()),
        ("cut_character", b"title = \"\xe2\x82".to_vec()),
    ];
    for (name, bytes) in cases {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("scene.toml"), &bytes).unwrap();
        let from_file = solve(folder.path(), "scene.toml", None);
        assert_eq!(from_file.status.code(), Some(2), "{name}");
        insta::assert_snapshot!(format!("file_{name}"), told(&from_file));

        let from_stdin = solve(folder.path(), "-", Some(&bytes));
        assert_eq!(told(&from_stdin), told(&from_file).replace("scene.toml", "<stdin>"), "{name}");
    }
}

/// Some editors write it; places in the text are counted without.
#[test]
fn a_byte_order_mark_of_utf_8_is_left_out() {
    let read = slipzone::scene::text("scene.toml", [b"\xef\xbb\xbf", GOOD.as_bytes()].concat());
    assert_eq!(read.expect("text"), GOOD);
}

#[test]
fn files_that_cannot_be_read() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("folder.toml")).unwrap();
    for (name, scene) in
        [("directory", "folder.toml"), ("missing", "nowhere.toml"), ("missing_folder", "no/where.toml")]
    {
        let output = solve(folder.path(), scene, None);
        assert_eq!(output.status.code(), Some(3), "{name}");
        insta::assert_snapshot!(format!("file_{name}"), told(&output));
    }
}

#[test]
fn a_huge_file_is_refused_unread() {
    let folder = tempfile::tempdir().unwrap();
    let file = File::create(folder.path().join("huge.toml")).unwrap();
    file.set_len(100 * 1024 * 1024).unwrap();
    let output = solve(folder.path(), "huge.toml", None);
    assert_eq!(output.status.code(), Some(2));
    insta::assert_snapshot!("file_huge", told(&output));

    // One byte too many on standard input; a limit of text, not of luck.
    let mut text = GOOD.as_bytes().to_vec();
    text.resize(16 * 1024 * 1024, b'\n');
    assert_eq!(feed(folder.path(), &["check", "-"], &text).status.code(), Some(0), "16 MB are fine");
    text.push(b'\n');
    assert_eq!(feed(folder.path(), &["check", "-"], &text).status.code(), Some(2), "one byte more is not");
}

/// The stack must hold whatever a file nests.
#[test]
fn deep_nesting_is_an_error_and_no_crash() {
    const DEEP: usize = 100_000;
    let cases = [
        ("arrays", format!("format = 1\nx = {}", "[".repeat(DEEP))),
        ("closed_arrays", format!("format = 1\nx = {}{}", "[".repeat(DEEP), "]".repeat(DEEP))),
        ("tables", format!("format = 1\nx = {}1{}", "{ a = ".repeat(DEEP), "}".repeat(DEEP))),
        ("dotted_key", format!("format = 1\nx{} = 1", ".a".repeat(DEEP))),
        ("dotted_section", format!("format = 1\n[x{}]\ny = 1", ".a".repeat(DEEP))),
    ];
    for (name, text) in cases {
        let folder = tempfile::tempdir().unwrap();
        let output = solve(folder.path(), "-", Some(text.as_bytes()));
        assert_eq!(output.status.code(), Some(2), "{name}: {}", told(&output));
        insta::assert_snapshot!(format!("deep_{name}"), told(&output));
    }
}

/// What fits the parser's limit must fit everything behind it.
#[test]
fn nesting_within_the_limit_reaches_the_decoder() {
    let folder = tempfile::tempdir().unwrap();
    for depth in 1..100 {
        let text = format!("{GOOD}\n[output]\nx = {}{}\n", "[".repeat(depth), "]".repeat(depth));
        assert_eq!(feed(folder.path(), &["check", "-"], text.as_bytes()).status.code(), Some(2), "{depth}");
    }
}

#[test]
fn a_long_line_is_shown_in_part() {
    let folder = tempfile::tempdir().unwrap();
    let text = format!("{GOOD}\n[output]\nx = [{}7.0{}]\n", "0.5, ".repeat(50_000), ", 0.5".repeat(50_000));
    let output = solve(folder.path(), "-", Some(text.as_bytes()));
    assert!(output.stderr.len() < 2_000, "{} bytes of message", output.stderr.len());
    insta::assert_snapshot!("long_line", told(&output));
}

/// More loads than a path may have: too many for a file among the broken scenes.
#[test]
fn a_path_of_too_many_loads() {
    let folder = tempfile::tempdir().unwrap();
    let loads: Vec<String> = (1..=100_001).map(|load| load.to_string()).collect();
    let path = |loads: &[String]| GOOD.replace("force = 1.0", &format!("path = {{ force = [{}] }}", loads.join(", ")));
    let output = solve(folder.path(), "-", Some(path(&loads).as_bytes()));
    assert_eq!(output.status.code(), Some(2));
    insta::assert_snapshot!("path_too_many", told(&output));
    let check = feed(folder.path(), &["check", "-"], path(&loads[1..]).as_bytes());
    assert_eq!(check.status.code(), Some(0), "one less is fine: {}", told(&check));
}

/// A message must not steer the terminal it is shown on, its own colours aside.
#[test]
fn no_control_character_reaches_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    for (wrong, escape) in [
        (GOOD.replace("\"flat\"", "\"\u{1b}]0;evil\u{7}\""), "\u{1b}]0"),
        (GOOD.replace("\"flat\"", "\"\\u001b[35m\""), "\u{1b}[35m"),
        (GOOD.replace("half_width", "\"\\u001b[35m\""), "\u{1b}[35m"),
        (GOOD.replace("[friction]", "[\"\\u001b[35m\"]"), "\u{1b}[35m"),
    ] {
        std::fs::write(folder.path().join("scene.toml"), wrong).unwrap();
        let mut command = program(folder.path());
        let output =
            command.env_remove("NO_COLOR").env("CLICOLOR_FORCE", "1").args(["check", "scene.toml"]).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        let told = told(&output);
        assert!(told.contains("\u{1b}[1m"), "colours were asked for: {told:?}");
        assert!(!told.contains(escape) && !told.contains('\u{7}'), "{told:?}");
    }
}

/// A scene whose punch is the table in `profile.csv`.
fn with_table(load: &str) -> String {
    let scene = GOOD.replace("type = \"flat\"\nhalf_width = 1.0", "type = \"table\"\nfile = \"profile.csv\"");
    let scene = scene.replace("force = 1.0", load);
    let (before, after) = scene.split_once("[friction]").expect("a scene with friction");
    let (_, after) = after.split_once("[load]").expect("a scene with a load");
    format!("{before}[load]{after}")
}

/// Tables in files: the message shows the line of the file, and where the scene names it.
#[test]
fn broken_tables_say_what_is_wrong_and_where() {
    let rows = "x, height\n0, 0\n1, 0.05\n2, 0.2\n3, 0.45\n4, 0.8\n";
    let cases: [(&str, Vec<u8>); 12] = [
        ("nan", rows.replace("0.2", "nan").into()),
        ("unsorted", rows.replace("2, ", "0.5, ").into()),
        ("repeated", rows.replace("2, ", "1, ").into()),
        ("two_rows", "0, 0\n1, 0.05\n".into()),
        ("words", rows.replace("0.45", "0.45 mm").into()),
        ("decimal_commas", rows.replace(", ", "; ").replace("0.2", "0,2").into()),
        ("three_columns", rows.replace("0.2", "0.2, 7").into()),
        ("long_line", rows.replace("0.2", &"0.2, ".repeat(10_000)).into()),
        ("empty", Vec::new()),
        ("latin_1", b"0, 0\n1, 0.05 \xb5m\n".to_vec()),
        ("utf_16", b"\xff\xfe0\0".to_vec()),
        ("control", rows.replace("0.2", "\u{1b}[31m").into()),
    ];
    for (name, bytes) in cases {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("scene.toml"), with_table("force = 1.0")).unwrap();
        fs::write(folder.path().join("profile.csv"), bytes).unwrap();
        let output = solve(folder.path(), "scene.toml", None);
        assert_eq!(output.status.code(), Some(2), "{name}: {}", told(&output));
        insta::assert_snapshot!(format!("table_{name}"), told(&output));
    }
}

/// Lines may end as they do anywhere, also as on machines of old; places are counted by them.
#[test]
fn lines_of_tables_end_in_three_ways() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), with_table("half_width = 1.0")).unwrap();
    let rows = "x, height\n0, 0\n1, 0.05\n\n2, 0.2\n3, 0.45\n4, 0.8\n";
    let mut solved = Vec::new();
    for end in ["\n", "\r\n", "\r"] {
        fs::write(folder.path().join("profile.csv"), rows.replace('\n', end)).unwrap();
        solved.push(run(folder.path(), ["solve", "scene.toml", "--json", "-"]));
        assert_eq!(solved.last().unwrap().status.code(), Some(0), "{end:?}: {}", told(solved.last().unwrap()));
        fs::write(folder.path().join("profile.csv"), rows.replace("0.2", "0.2 mm").replace('\n', end)).unwrap();
        let wrong = told(&run(folder.path(), ["solve", "scene.toml"]));
        assert!(wrong.contains("profile.csv:5:4") && wrong.contains("`0.2 mm`"), "{end:?}: {wrong}");
        let bytes = rows.replace('\n', end).into_bytes();
        let bytes: Vec<u8> = bytes.into_iter().map(|byte| if byte == b'8' { 0xb5 } else { byte }).collect();
        fs::write(folder.path().join("profile.csv"), bytes).unwrap();
        let wrong = told(&run(folder.path(), ["solve", "scene.toml"]));
        assert!(wrong.contains("profile.csv:7:6") && wrong.contains("0xB5"), "{end:?}: {wrong}");
    }
    assert!(solved[1..].iter().all(|output| output.stdout == solved[0].stdout));
}

/// A contact that would be wider than the table: the reason says where that ends.
#[test]
fn a_load_too_large_for_the_table() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("profile.csv"), "0 0\n1 0.05\n2 0.2\n3 0.45\n4 0.8\n").unwrap();
    for (grading, load) in
        [("base = 8.0", "force = 1e4"), ("base = 8.0", "indentation = 4.0"), ("base = 1.0", "force = 1e4")]
    {
        let scene = with_table(load).replace("base = 8.0", grading);
        let told = told(&feed(folder.path(), &["solve", "-"], scene.as_bytes()));
        assert!(
            told.starts_with("exit code: 1") && told.contains("known up to x = 4 and no further out"),
            "{load}: {told}"
        );
    }
}

#[test]
fn tables_that_cannot_be_read() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), with_table("force = 1.0")).unwrap();
    fs::create_dir(folder.path().join("profile.csv")).unwrap();
    let output = solve(folder.path(), "scene.toml", None);
    assert_eq!(output.status.code(), Some(2));
    insta::assert_snapshot!("table_directory", told(&output));

    fs::remove_dir(folder.path().join("profile.csv")).unwrap();
    File::create(folder.path().join("profile.csv")).unwrap().set_len(65 * 1024 * 1024).unwrap();
    let output = solve(folder.path(), "scene.toml", None);
    assert_eq!(output.status.code(), Some(2));
    insta::assert_snapshot!("table_huge", told(&output));
}

/// The file is sought beside the scene, wherever the program runs.
#[test]
fn files_are_relative_to_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("sub")).unwrap();
    fs::write(folder.path().join("sub/scene.toml"), with_table("half_width = 1.0")).unwrap();
    fs::write(folder.path().join("sub/profile.csv"), "0 0\n1 0.05\n2 0.2\n3 0.45\n4 0.8\n").unwrap();
    assert_eq!(run(folder.path(), ["check", "sub/scene.toml"]).status.code(), Some(0));
    let from_stdin = |folder: &Path| feed(folder, &["check", "-"], with_table("half_width = 1.0").as_bytes());
    assert_eq!(from_stdin(&folder.path().join("sub")).status.code(), Some(0));
    assert_eq!(from_stdin(folder.path()).status.code(), Some(2));
}

#[test]
fn a_million_rows_are_taken_and_one_more_is_not() {
    use std::fmt::Write;
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("scene.toml"), with_table("half_width = 0.5")).unwrap();
    let mut rows = String::new();
    for i in 0..1_000_000 {
        let x = f64::from(i) * 1e-6;
        writeln!(rows, "{x:.6} {:.9}", 0.05 * x * x).unwrap();
    }
    fs::write(folder.path().join("profile.csv"), &rows).unwrap();
    assert_eq!(run(folder.path(), ["check", "scene.toml"]).status.code(), Some(0));
    rows.push_str("1.0 0.05\n");
    fs::write(folder.path().join("profile.csv"), &rows).unwrap();
    let output = run(folder.path(), ["check", "scene.toml"]);
    assert_eq!(output.status.code(), Some(2));
    insta::assert_snapshot!("table_too_many_rows", told(&output));
}

#[cfg(feature = "formula")]
mod formulas {
    use super::*;

    fn with_formula(height: &str, load: &str) -> String {
        let formula = format!("type = \"formula\"\nheight = \"{height}\"");
        with_table(load).replace("type = \"table\"\nfile = \"profile.csv\"", &formula)
    }

    #[test]
    fn long_and_deep_formulas_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in [
            ("long", format!("x^2{}", " + 0.1*x^2".repeat(1000))),
            ("deep", format!("{}x{}", "(".repeat(900), ")".repeat(900))),
            ("deep_functions", "sin(".repeat(400)),
        ] {
            let output = solve(folder.path(), "-", Some(with_formula(&text, "force = 1.0").as_bytes()));
            assert_eq!(output.status.code(), Some(2), "{name}: {}", told(&output));
            insta::assert_snapshot!(format!("formula_{name}"), told(&output));
        }
    }

    /// A circle ends at its radius: no force widens a contact beyond it. That is what is said, not what came of trying.
    #[test]
    fn a_load_that_no_contact_within_the_punch_bears() {
        let folder = tempfile::tempdir().unwrap();
        for (name, height, end) in [
            ("circle", "1 - sqrt(1 - x^2)", "no finite slope at x = 1"),
            ("wave", "1 - cos(x)", "not convex at x = 1.570"),
        ] {
            for load in ["force = 1e6", "indentation = 900.0"] {
                let output = feed(folder.path(), &["solve", "-"], with_formula(height, load).as_bytes());
                let told = told(&output);
                assert_eq!(output.status.code(), Some(1), "{name}, {load}: {told}");
                assert!(told.contains(end), "{name}, {load}: {told}");
            }
        }
        // A pole bears them before it is reached.
        for load in ["force = 1e6", "indentation = 900.0"] {
            let output = feed(folder.path(), &["solve", "-"], with_formula("x^2/(1 - x^2)", load).as_bytes());
            assert_eq!(output.status.code(), Some(0), "{load}: {}", told(&output));
        }
    }

    /// Divisions by zero under the contact, roots of negative numbers there: told, with the place, and no panic.
    #[test]
    fn what_fails_inside_the_contact_is_told() {
        let folder = tempfile::tempdir().unwrap();
        for height in ["x^2/(1 - 4*x^2)", "10 - 10*sqrt(1 - 4*x^2)", "1 - cos(4*x)", "x^2/abs(abs(x) - 0.5)"] {
            for load in ["half_width = 1.0", "force = 5.0"] {
                let output = feed(folder.path(), &["solve", "-"], with_formula(height, load).as_bytes());
                // A force may be borne before the contact gets there.
                let may_converge = load.starts_with("force") && output.status.code() == Some(0);
                let is_told = matches!(output.status.code(), Some(1 | 2));
                assert!(is_told || may_converge, "{height}, {load}: {}", told(&output));
            }
        }
    }
}

#[test]
fn a_series_of_more_terms_than_are_used() {
    let read = |terms: u8| {
        let scene = format!("{GOOD}[solver]\nkernel = {{ type = \"split\", terms = {terms} }}\n");
        slipzone::scene::parse("scene.toml", &scene)
    };
    assert!(read(40).is_ok());
    let error = read(41).unwrap_err();
    assert_eq!((error.line, error.expected.as_deref()), (20, Some("an integer from 1 to 40")), "{error}");
}

/// Who writes the word for it that they know is told the name here; no word is another's name, or means two of a
/// family.
#[test]
fn a_plugin_is_found_by_the_words_for_it_elsewhere() {
    use slipzone::api::{find, known_elsewhere, plugins};
    for info in plugins() {
        for word in info.also {
            assert_eq!(known_elsewhere(info.family, &word.to_uppercase().replace('-', "_")), Some(info.name), "{word}");
            assert!(find(info.family, word).is_none(), "{word} is a name");
        }
    }
    for (known, word, name) in [("flat", "Hertz", "cylinder"), ("exponential", "uniform", "homogeneous")] {
        let scene = GOOD.replacen(&format!("\"{known}\""), &format!("\"{word}\""), 1);
        let error = slipzone::scene::parse("scene.toml", &scene).unwrap_err();
        assert_eq!(error.hint, Some(format!("it is called `{name}` here")), "{error}");
    }
}
