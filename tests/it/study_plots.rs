//! Descriptions of figures that do not fit their study: refused when it is read, with the line.

use slipzone::api::NoFiles;
use slipzone::scene::SceneError;
use slipzone::study::Study;

const SCENE: &str = r#"format = 1
scene = { format = 1, layer = { thickness = 5.0, poisson = 0.3, grading = { type = "exponential", surface = 1.0, base = 8.0 } }, punch = { type = "flat", half_width = 1.0 }, friction = { type = "goodman", coefficient = 0.3 }, load = { force = 1.0 } }
[[axes]]
field = "layer.grading.base"
label = "mu1/mu3"
values = [8.0, 1.0]
names = ["1/8", "1"]
[[axes]]
field = "friction.coefficient"
label = "eta"
linear = { from = 0.1, to = 0.7, count = 13 }
[[plots]]
"#;
/// Where a description begins.
const FIRST: usize = 13;

fn read(plot: &str) -> Result<Study, SceneError> {
    Study::parse("study.toml", &format!("{SCENE}{plot}"), &NoFiles)
}

const FILE: &str = "file = \"a.svg\"\n";
const CURVES: &str = "file = \"a.svg\"\nx = \"eta\"\ny = \"stick.ratio\"\n";

#[test]
fn a_figure_that_fits_is_read() {
    for plot in [
        CURVES,
        "file = \"a.svg\"\nx = \"friction.coefficient\"\ny = [\"stick.ratio\", \"edge.ratio\"]\npanels = \"mu1/mu3\"\n",
        "file = \"a.svg\"\nkind = \"tractions\"\nonly = { eta = [0.1, 0.4] }\n",
    ] {
        read(plot).unwrap_or_else(|error| panic!("{error}"));
    }
}

#[test]
fn a_figure_that_does_not_fit_is_refused_with_its_line() {
    let with = |more: &str| format!("{CURVES}{more}");
    for (plot, line, message) in [
        (format!("{FILE}x = \"eta\"\ny = \"stick.rato\"\n"), 2, "no such axis and no such number of the result"),
        (format!("{FILE}x = \"thickness\"\ny = \"stick.ratio\"\n"), 1, "no such axis and no such number"),
        (format!("{FILE}x = \"mu1/mu3\"\ny = \"stick.ratio\"\n"), 1, "the values of `mu1/mu3` are not numbers"),
        (format!("{FILE}y = \"stick.ratio\"\n"), 0, "missing key `x`"),
        (format!("{FILE}x = \"eta\"\n"), 0, "missing key `y`"),
        (with("z = \"edge.ratio\"\n"), 3, "only a map has a `z`"),
        (with("family = [\"mu1/mu3\", \"h/b\"]\n"), 3, "no such axis"),
        (with("family = \"eta\"\n"), 3, "an axis is shown in two ways"),
        (with("panels = \"nu\"\n"), 3, "no such axis"),
        (with("family = []\n"), 0, "several scenes for each place of the figure"),
        (with("only = { nu = 0.3 }\n"), 3, "no such axis"),
        (with("only = { eta = 0.32 }\n"), 3, "no value of `eta`"),
        (with("only = { \"mu1/mu3\" = [] }\n"), 3, "nothing to show"),
        (with("y_scale = \"log\"\nlines = [{ y = -1.0, label = \"a\" }]\n"), 4, "a line that cannot be drawn"),
        (with("points = [{ label = \"a\", x = [0.1, 0.2], y = [0.1] }]\n"), 3, "as many `y` as `x` are needed"),
        (
            with("x_scale = \"log\"\npoints = [{ label = \"a\", x = [1e-200, 1e200], y = [0.1, 0.2] }]\n"),
            4,
            "points that cannot be drawn",
        ),
        (
            format!("{FILE}x = \"eta\"\ny = [\"stick.ratio\", \"edge.ratio\"]\ny_label = \"a\"\n"),
            3,
            "several ordinates",
        ),
        (
            format!(
                "{FILE}x = \"eta\"\ny = [\"stick.ratio\", \"edge.ratio\"]\npoints = [{{ label = \"a\", x = [0.1], y = [0.1] }}]\n"
            ),
            3,
            "several ordinates",
        ),
        (format!("{FILE}kind = \"tractions\"\nonly = {{ eta = 0.1 }}\ny_label = \"a\"\n"), 3, "several ordinates"),
        (CURVES.replace("a.svg", "b/a.svg"), 0, "not the name of a figure"),
        (CURVES.replace("a.svg", "results.csv"), 0, "not the name of a figure"),
        (format!("{FILE}kind = \"tractions\"\n"), 1, "too many curves to be told apart"),
        (format!("{FILE}kind = \"tractions\"\ny = \"strain\"\nonly = {{ eta = 0.1 }}\n"), 2, "not a traction"),
        (format!("{FILE}kind = \"tractions\"\nx = \"eta\"\n"), 2, "tractions are drawn over x/b"),
        (format!("{FILE}kind = \"map\"\nx = \"eta\"\ny = \"h/b\"\nz = \"stick.ratio\"\n"), 3, "no such axis"),
        (format!("{FILE}kind = \"map\"\nx = \"eta\"\ny = \"eta\"\nz = \"stick.ratio\"\n"), 3, "a map needs two axes"),
        (format!("{FILE}kind = \"map\"\nx = \"eta\"\ny = \"eta\"\n"), 0, "missing key `z`"),
        (
            format!("{CURVES}[[plots]]\nfile = \"A.svg\"\nx = \"eta\"\ny = \"edge.ratio\"\n"),
            4,
            "two figures with one name",
        ),
    ] {
        let error = read(&plot).expect_err(&plot);
        assert!(error.message.contains(message), "{error}\nexpected: {message}\n{plot}");
        // Of what is missing the table that misses it is shown, by its first line or its heading.
        let allowed = if line == 0 { FIRST - 1..=FIRST + 1 } else { FIRST + line..=FIRST + line };
        assert!(allowed.contains(&error.line), "{error}");
        assert!(error.found.is_some() && error.expected.is_some(), "{error}");
    }
}

/// Told before anything is solved, and where the key of the figure is.
#[test]
fn a_figure_of_what_is_not_asked_for_is_refused() {
    let read = |plot: &str, axis: &str| {
        let asks = "load = { force = 1.0 }, output = { quantities = [\"edge\", \"load\"] } }";
        let study = SCENE.replace("load = { force = 1.0 } }", asks).replace("[[plots]]", &format!("{axis}[[plots]]"));
        Study::parse("study.toml", &(study + plot), &NoFiles)
    };
    for (plot, line, number) in [
        (format!("{FILE}x = \"eta\"\ny = [\"edge.ratio\", \"stick.ratio\"]\n"), 2, "stick.ratio"),
        (format!("{FILE}x = \"pressure.mean\"\ny = \"edge.ratio\"\n"), 1, "pressure.mean"),
        (format!("{FILE}kind = \"tractions\"\nonly = {{ eta = 0.1 }}\n"), 1, "profile"),
    ] {
        let error = read(&plot, "").expect_err(&plot);
        assert!(error.message.contains(&format!("`{number}`, which the scene does not ask for")), "{error}");
        assert_eq!(error.line, FIRST + line, "{error}");
        let axis =
            "[[axes]]\nfield = \"output.quantities\"\nvalues = [[\"edge\"], [\"load\"]]\nnames = [\"e\", \"l\"]\n";
        if let Err(error) = read(&plot, axis) {
            assert!(!error.message.contains("does not ask for"), "{error}");
        }
    }
    read("file = \"a.svg\"\nx = \"eta\"\ny = [\"edge.ratio\", \"error.estimate\"]\n", "").expect("asked for");
}

#[test]
fn a_misspelt_name_is_recognised() {
    let error = read(&format!("{FILE}x = \"eta\"\ny = \"stick.rato\"\n")).expect_err("no such number");
    assert_eq!(error.hint.as_deref(), Some("did you mean `stick.ratio`?"));
    // The page shows it.
    let page = include_str!("../../docs/study-plots.md");
    for line in error.to_string().lines().filter(|line| line.starts_with("error") || line.contains("   = ")) {
        assert!(page.contains(line.trim()), "docs/study-plots.md does not say: {line}");
    }
}

/// The numbers that figures know are those of a result: each path leads to a number, or to one that may be missing.
#[test]
fn every_number_of_a_result_can_be_shown() {
    let study = read("file = \"a.svg\"\nx = \"eta\"\ny = \"stick.ratio\"\n").expect("a study");
    let mut records = Vec::new();
    slipzone::study::sweep(&study, &|row| row > 0, |record| {
        records.push(serde_json::to_value(&record).expect("JSON"));
        std::ops::ControlFlow::Continue(())
    });
    let record = &records[0];
    let mut known = 0;
    for section in ["load", "pressure", "edge", "stick"] {
        for (key, value) in record[section].as_object().expect("a table") {
            // The direction of slip is no number.
            if value.is_string() {
                continue;
            }
            let plot = format!("file = \"a.svg\"\nx = \"eta\"\ny = \"{section}.{key}\"\n");
            read(&plot).unwrap_or_else(|error| panic!("{error}"));
            known += 1;
        }
    }
    assert_eq!(known, 11, "all but the strain rate, which this scene has not, and the estimate");
}
