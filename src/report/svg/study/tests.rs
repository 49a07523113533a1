//! The structure of the figures, on records made by hand.

use super::*;
use crate::report::svg::texts;
use crate::study::Cell;
use serde_json::json;
use slipzone_api::NoFiles;

/// Three gradings, four coefficients of friction, two kinds of punch.
const AXES: &str = r#"
[[axes]]
field = "layer.grading.base"
label = "mu1/mu3"
values = [8.0, 1.0, 0.125]
names = ["1/8", "1", "8"]
[[axes]]
field = "friction.coefficient"
values = [0.4, 0.1, 0.2, 0.3]
"#;
const PLOT: &str = "[[plots]]\nfile = 'a.svg'\n";

fn study(axes: &str, plot: &str) -> Study {
    let scene = "format = 1\ntitle = 'A study'\nscene = { format = 1, layer = { thickness = 5.0, poisson = 0.3, \
         grading = { type = 'exponential', surface = 2.0, base = 8.0 } }, punch = { type = 'flat', half_width = 1.0 }, \
         friction = { type = 'goodman', coefficient = 0.3 }, load = { force = 1.0 }, \
         units = { length = 'mm', stress = 'MPa' } }\n";
    let text = format!("{scene}{axes}{PLOT}{plot}");
    Study::parse("study.toml", &text, &NoFiles).unwrap_or_else(|error| panic!("{error}"))
}

/// A record with numbers that are easy to tell apart.
fn record(study: &Study, index: u64) -> Value {
    let n = index as f64;
    let x: Vec<f64> = (-10..=10).map(|i| f64::from(i) / 10.0).collect();
    let pressure: Vec<Option<f64>> = x.iter().map(|x| (x.abs() < 1.0).then(|| (1.0 - x * x).sqrt().recip())).collect();
    let shear: Vec<Option<f64>> = x.iter().zip(&pressure).map(|(x, p)| p.map(|p| 0.3 * x * p)).collect();
    json!({
        "index": index, "status": "converged", "stick": { "ratio": 0.05 + 0.9 * n / study.rows() as f64 },
        "load": { "force": 1.0 + n, "half_width": 1.0 }, "pressure": { "mean": 1.6 },
        "profile": { "x": x, "pressure": pressure, "shear": shear },
    })
}

fn records(study: &Study) -> Vec<Value> {
    (0..study.rows()).map(|index| record(study, index)).collect()
}

fn figure(study: &Study, records: impl IntoIterator<Item = Value>) -> String {
    let figure = study_svg(study, &study.plots[0], records).unwrap_or_else(|error| panic!("{error}"));
    let svg = figure.svg;
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    svg
}

/// How many points each curve has: each path that is as wide as curves are.
fn lengths(svg: &str) -> Vec<usize> {
    let document = roxmltree::Document::parse(svg).expect("well-formed XML");
    let is_curve = |n: &roxmltree::Node| n.has_tag_name("path") && n.attribute("stroke-width") == Some("2.2");
    let points = |n: roxmltree::Node| n.attribute("d").map_or(0, |d| d.matches('L').count() + 1);
    document.descendants().filter(is_curve).map(points).collect()
}

fn curves(svg: &str) -> usize {
    lengths(svg).len()
}

const CURVES: &str = "x = 'friction.coefficient'\ny = 'stick.ratio'\n";

#[test]
fn each_member_of_the_family_has_a_curve_and_a_name() {
    let study = study(AXES, CURVES);
    let svg = figure(&study, records(&study));
    assert_eq!(curves(&svg), 3);
    let found = texts(&svg);
    for name in ["A study", "µ₁/µ₃ = 1/8", "µ₁/µ₃ = 1", "µ₁/µ₃ = 8", "stick zone a/b", "coefficient of friction η"]
    {
        assert_eq!(found.iter().filter(|text| *text == name).count(), 1, "{name} in {found:?}");
    }
}

#[test]
fn the_order_of_the_results_does_not_matter() {
    let study = study(AXES, CURVES);
    let (forth, back) = (records(&study), records(&study).into_iter().rev());
    assert_eq!(figure(&study, forth), figure(&study, back));
}

#[test]
fn numbers_have_their_units_and_panels_their_names() {
    let plot = "x = 'friction.coefficient'\ny = ['load.force', 'stick.ratio']\npanels = 'mu1/mu3'\nfamily = []\n\
                note = 'nu = 0.3'\n";
    let study = study(AXES, plot);
    let svg = figure(&study, records(&study));
    assert_eq!(curves(&svg), 6, "two numbers in three panels each");
    let found = texts(&svg);
    for (name, count) in [("force per length P (N/mm)", 3), ("stick zone a/b", 3), ("µ₁/µ₃ = 8", 2), ("ν = 0.3", 1)]
    {
        assert_eq!(found.iter().filter(|text| *text == name).count(), count, "{name} in {found:?}");
    }
}

#[test]
fn what_did_not_converge_is_a_gap_and_is_counted() {
    let study = study(AXES, CURVES);
    let mut all = records(&study);
    assert!(!texts(&figure(&study, all.clone())).iter().any(|text| text.contains("without a converged result")));
    // By the coefficient the scenes 1, 2, 3, 0 follow each other: one line is left of two.
    all[2]["status"] = json!("assumption-violated");
    let svg = figure(&study, all);
    assert_eq!(lengths(&svg), [2, 4, 4], "a line of two beyond the gap, beside a point and a cross");
    assert_eq!(crosses(&svg), 2, "one for the scene, one for the legend");
    assert!(texts(&svg).contains(&VIOLATED.to_owned()), "{:?}", texts(&svg));
    assert!(texts(&svg).contains(&"1 of 12 scenes without a converged result".to_owned()), "{:?}", texts(&svg));
    let failed = records(&study).into_iter().map(|mut record| {
        record["status"] = json!("not-converged");
        record
    });
    assert!(matches!(study_svg(&study, &study.plots[0], failed), Err(FigureError::NothingToShow(_))));
}

/// The legend's word for a cross.
const VIOLATED: &str = "assumption violated, as computed";

fn crosses(svg: &str) -> usize {
    let document = roxmltree::Document::parse(svg).expect("well-formed XML");
    document.descendants().filter(|n| n.has_tag_name("path") && n.attribute("stroke-width") == Some("1.7")).count()
}

/// They have numbers, as computed. Without them a figure of pressures ended where the punch lifts off, and nobody saw
/// how far it was off.
#[test]
fn what_contradicts_an_assumption_is_marked_and_not_left_out() {
    let study = study(AXES, CURVES);
    let with = |status: &str, ratio: Option<f64>| {
        let mut all = records(&study);
        all[2]["status"] = json!(status);
        if let Some(ratio) = ratio {
            all[2]["stick"]["ratio"] = json!(ratio);
        }
        study_svg(&study, &study.plots[0], all).unwrap()
    };
    // Nothing computed, nothing shown; nor any word of it in a figure that has none.
    for status in ["converged", "not-converged", "refused", "invalid"] {
        let figure = with(status, None);
        assert!(crosses(&figure.svg) == 0 && !texts(&figure.svg).contains(&VIOLATED.to_owned()), "{status}");
    }
    // A number far from all others would make a line of them.
    let far = with("assumption-violated", Some(1e6));
    assert_eq!(crosses(&far.svg), 0);
    assert!(far.left_out.is_some_and(|told| told.starts_with("1 point is not shown")));
    let axis = |figure: &StudyFigure| ticks(&figure.svg, "end");
    assert_eq!(axis(&with("not-converged", None)), axis(&with("assumption-violated", Some(-1e6))));
    // Where all are, there is a figure all the same.
    let all = records(&study).into_iter().map(|mut record| {
        record["status"] = json!("assumption-violated");
        record
    });
    let svg = figure(&study, all);
    assert_eq!((curves(&svg), crosses(&svg)), (0, 13));
}

#[test]
fn tractions_that_contradict_an_assumption_are_thin_and_crossed() {
    let study = study(AXES, "kind = 'tractions'\nonly = { 'friction.coefficient' = 0.3 }\n");
    let mut all = records(&study);
    let whole = figure(&study, all.clone());
    assert_eq!((curves(&whole), crosses(&whole)), (6, 0));
    // The second of three, by its pressure.
    all[7]["status"] = json!("assumption-violated");
    let svg = figure(&study, all);
    assert_eq!(curves(&svg), 4, "two of each are as wide as before");
    assert!(crosses(&svg) > 10 && texts(&svg).contains(&VIOLATED.to_owned()), "{:?}", texts(&svg));
}

/// Neither 0 nor what is below has a place on an axis of equal factors: it is counted, curve by curve.
#[test]
fn what_a_log_axis_has_no_place_for_is_counted() {
    let study = study(AXES, &format!("{CURVES}y_scale = 'log'\n"));
    let of = |records: Vec<Value>| study_svg(&study, &study.plots[0], records).unwrap();
    assert_eq!(of(records(&study)).left_out, None);
    let mut all = records(&study);
    for (index, ratio) in [(0, 0.0), (1, -0.5), (9, 0.0)] {
        all[index]["stick"]["ratio"] = json!(ratio);
    }
    // Without a number it would not be there on any axis.
    all[10]["stick"]["ratio"] = Value::Null;
    let figure = of(all.clone());
    let told = "3 points have no place on a log axis, being 0 or less (2 of µ₁/µ₃ = 1/8, 1 of µ₁/µ₃ = 8)";
    assert_eq!(figure.left_out.as_deref(), Some(told));
    let shown = texts(&figure.svg).join(" ");
    assert!(shown.contains(told), "{shown}");
    for record in &mut all {
        record["stick"]["ratio"] = json!(0.0);
    }
    let error = study_svg(&study, &study.plots[0], all).unwrap_err();
    assert!(error.to_string().contains("12 points have no place on a log axis"), "{error}");

    let from_zero = AXES.replace("values = [0.4, 0.1, 0.2, 0.3]", "linear = { from = 0.1, to = 0.4, count = 4 }");
    let x = "x = 'stick.ratio'\ny = 'load.force'\nx_scale = 'log'\n";
    let study = super::tests::study(&from_zero, x);
    let mut all = records(&study);
    all[4]["stick"]["ratio"] = json!(0.0);
    let told = study_svg(&study, &study.plots[0], all).unwrap().left_out.unwrap();
    assert!(told.starts_with("1 point has no place"), "{told}");
}

#[test]
fn a_number_over_another_follows_the_last_axis() {
    let study = study(AXES, "x = 'load.force'\ny = 'stick.ratio'\n");
    assert_eq!(curves(&figure(&study, records(&study))), 3);
}

#[test]
fn some_of_the_scenes_may_be_asked_for() {
    let study =
        study(AXES, &format!("{CURVES}only = {{ 'mu1/mu3' = ['1/8', '8'], 'friction.coefficient' = [0.1, 0.3] }}\n"));
    let mut all = records(&study);
    // Not shown, not counted.
    all[4]["status"] = json!("not-converged");
    let svg = figure(&study, all);
    assert_eq!(curves(&svg), 2);
    assert!(!texts(&svg).iter().any(|text| text.contains("converge")));
}

#[test]
fn lines_and_points_from_elsewhere_are_in_the_legend() {
    let plot =
        "lines = [{ y = 0.74, label = 'half-plane' }]\npoints = [{ label = 'printed', x = [0.15], y = [0.5] }]\n";
    let study = study(AXES, &format!("{CURVES}{plot}"));
    let found = texts(&figure(&study, records(&study)));
    for name in ["half-plane", "printed"] {
        assert!(found.iter().any(|text| text == name), "{name} in {found:?}");
    }
}

#[test]
fn tractions_have_a_curve_for_each_scene() {
    let study = study(AXES, "kind = 'tractions'\nonly = { 'friction.coefficient' = 0.3 }\n");
    let svg = figure(&study, records(&study));
    assert_eq!(curves(&svg), 6, "three of the pressure, three of the shear");
    let found = texts(&svg);
    assert!(found.contains(&"η = 0.3".to_owned()), "{found:?}");
    assert!(found.contains(&"pressure p / mean pressure".to_owned()), "{found:?}");
    let pressure = "kind = 'tractions'\ny = 'pressure'\nonly = { 'friction.coefficient' = 0.3 }\n";
    for (over, label) in [("modulus", "pressure p / surface modulus µ₁"), ("one", "pressure p (MPa)")] {
        let study = self::study(AXES, &format!("{pressure}over = '{over}'\n"));
        let svg = figure(&study, records(&study));
        assert!(texts(&svg).contains(&label.to_owned()) && curves(&svg) == 3, "{label} in {:?}", texts(&svg));
    }
    // The results of a sweep that kept no profiles.
    let bare = records(&study).into_iter().map(|mut record| {
        record.as_object_mut().expect("a table").remove("profile");
        record
    });
    assert!(matches!(study_svg(&study, &study.plots[0], bare), Err(FigureError::NothingToShow(_))));
}

/// What a question found is the modulus that tractions are divided by.
#[test]
fn tractions_over_the_modulus_found() {
    let plot = "kind = 'tractions'\ny = 'pressure'\nover = 'modulus'\n[find]\nfield = 'layer.grading.surface'\nfrom = 1.0\n\
                to = 50.0\nquantity = 'load.indentation'\ntarget = 0.05\n";
    let question = study("", plot);
    let drawn = |found: f64| {
        let mut record = record(&question, 0);
        record["found"] = json!({ "value": found });
        figure(&question, [record])
    };
    let written =
        study("[[axes]]\nfield = 'layer.grading.surface'\nvalues = [40.0]\n", &plot[..plot.find("[find]").unwrap()]);
    let told = ticks(&figure(&written, records(&written)), "end");
    assert!(told.len() > 1);
    assert_eq!(ticks(&drawn(40.0), "end"), told);
    assert_ne!(ticks(&drawn(2.0), "end"), told);
}

/// Samples of one half stand for those of the other.
#[test]
fn tractions_have_the_samples_of_both_halves() {
    let study = study("", "kind = 'tractions'\ny = 'pressure'\n");
    let mut record = record(&study, 0);
    record["profile"] = json!({ "x": [-1.0, -0.9, 0.1, 0.2, 0.3], "pressure": [null, 2.0, 1.0, 1.1, 1.2], "shear": [null, -0.2, 0.1, 0.1, 0.2] });
    // Four that are bounded, and the way to the edge.
    assert_eq!(lengths(&figure(&study, [record])), [4 + 9]);
}

#[test]
fn names_of_numbers_are_whole() {
    let axes = "[[axes]]\nfield = 'punch.half_width'\nvalues = [1.0, 2.0]\n[[axes]]\nfield = 'layer.thickness'\nvalues = [3.0, 5.0]\n\
                names = ['2 in', '5 in']\n[[axes]]\nfield = 'friction.coefficient'\nvalues = [0.1, 0.2]\n";
    let study = study(axes, "x = 'friction.coefficient'\ny = 'stick.ratio'\n");
    let found = texts(&figure(&study, records(&study)));
    assert!(found.contains(&"half-width of the punch = 1 mm, 2 in".to_owned()), "{found:?}");
}

const GRID: &str = "[[axes]]\nfield = 'layer.thickness'\nlabel = 'h/b'\nlog = { from = 1.0, to = 100.0, count = 7 }\n\
                    [[axes]]\nfield = 'layer.grading.base'\nvalues = [0.5, 1.0, 4.0, 5.0]\n";
const MAP: &str = "kind = 'map'\nx = 'h/b'\ny = 'layer.grading.base'\nz = 'stick.ratio'\nx_scale = 'log'\n";

/// Cells that are crossed out, and lines of the crosses.
fn missing(svg: &str) -> (usize, usize) {
    let document = roxmltree::Document::parse(svg).expect("well-formed XML");
    let with = |tag: &str, key: &str, value: &str| {
        document.descendants().filter(|n| n.has_tag_name(tag) && n.attribute(key) == Some(value)).count()
    };
    (with("rect", "fill", super::map::MISSING), with("line", "stroke", "#8c8c8c"))
}

#[test]
fn a_map_marks_each_scene_and_crosses_out_what_is_missing() {
    let study = study(GRID, MAP);
    let svg = figure(&study, records(&study));
    assert_eq!((missing(&svg), svg.matches("<circle").count()), ((0, 0), 28));
    let found = texts(&svg);
    for name in ["stick zone a/b", "h/b", "modulus at the base (MPa)"] {
        assert!(found.iter().any(|text| text == name), "{name} in {found:?}");
    }
    for level in ["0.2", "0.4", "0.6", "0.8"] {
        assert_eq!(found.iter().filter(|text| *text == level).count(), 2, "{level} beside the bar and on its line");
    }
    let mut some = records(&study);
    some[3]["status"] = json!("invalid");
    some.remove(9);
    let svg = figure(&study, some);
    assert_eq!((missing(&svg), svg.matches("<circle").count()), ((2, 4), 26), "one failed, one not there");
    assert!(texts(&svg).contains(&"1 of 27 scenes without a converged result".to_owned()));
}

/// Of two scenes in one cell one would not be seen.
#[test]
fn a_map_has_each_value_once() {
    let study = study(&GRID.replace("[0.5, 1.0, 4.0, 5.0]", "[0.5, 1.0, 4.0, 1.0]"), MAP);
    let drawn = study_svg(&study, &study.plots[0], records(&study));
    assert!(matches!(drawn, Err(FigureError::Plot(why)) if why.contains("each value once")));
}

/// A plateau at the largest value has no line around it: where it begins is where numbers round to its height.
#[test]
fn a_plateau_of_a_map_has_no_line() {
    let study = study(GRID, MAP);
    let flat = records(&study).into_iter().enumerate().map(|(index, mut record)| {
        if index % 4 > 1 {
            record["stick"]["ratio"] = json!(1.0);
        }
        record
    });
    let found = texts(&figure(&study, flat.collect::<Vec<_>>()));
    let count = |level: &str| found.iter().filter(|text| *text == level).count();
    assert_eq!((count("1.0"), count("0.8")), (1, 2), "beside the bar alone, and on a line as well: {found:?}");
}

/// On three rows a line of equal value runs through one colour from frame to frame: those of the cells would change by
/// a step, and far more, where it leaves one for the next.
#[test]
fn lines_of_a_map_with_few_rows_match_its_colours() {
    let axes = "[[axes]]\nfield = 'layer.thickness'\nvalues = [1.0, 2.0, 4.0]\n\
                [[axes]]\nfield = 'load.force'\nvalues = [1.0, 2.0, 3.0]\n";
    let study = study(axes, "kind = 'map'\nx = 'load.force'\ny = 'layer.thickness'\nz = 'stick.ratio'\n");
    let svg = figure(&study, records(&study));
    let document = roxmltree::Document::parse(&svg).expect("well-formed XML");
    let number = |n: &roxmltree::Node, key: &str| n.attribute(key).and_then(|x| x.parse().ok()).unwrap_or(0.0);
    // The last one drawn is on top; of a colour the green is enough, which only grows with the number.
    let patches: Vec<([f64; 4], u8)> = document
        .descendants()
        .filter(|n| n.has_tag_name("rect") && n.attribute("fill-opacity").is_none())
        .filter_map(|n| {
            let green = u8::from_str_radix(n.attribute("fill")?.get(3..5)?, 16).ok()?;
            Some((["x", "y", "width", "height"].map(|key| number(&n, key)), green))
        })
        .collect();
    let green = |x: f64, y: f64| {
        let holds = |at: &[f64; 4]| (at[0]..at[0] + at[2]).contains(&x) && (at[1]..at[1] + at[3]).contains(&y);
        patches.iter().rev().find(|(at, _)| holds(at)).map(|(_, green)| *green)
    };
    let is_line = |n: &roxmltree::Node| n.has_tag_name("path") && n.attribute("stroke") == Some("#ffffff");
    let lines: Vec<Vec<u8>> = document
        .descendants()
        .filter(is_line)
        .filter_map(|n| n.attribute("d"))
        .map(|line| {
            let points = line.split(['M', 'L']).filter_map(|point| point.trim().split_once(' '));
            points.filter_map(|(x, y)| green(x.parse().ok()?, y.parse().ok()?)).collect()
        })
        .collect();
    assert!(lines.len() > 3 && lines.iter().all(|line| line.len() > 10), "{lines:?}");
    for line in lines {
        let spread = line.iter().max().unwrap() - line.iter().min().unwrap();
        // A patch of 8 px on a map of some 400 for 200 shades of green, either way.
        assert!(spread <= 16, "{line:?}");
    }
}

#[test]
fn a_large_grid_is_thinned() {
    let axes = GRID.replace("count = 7", "count = 5000");
    let study = study(&axes, MAP);
    let svg = figure(&study, records(&study));
    // Cells, and some forty patches over each of their columns.
    assert!(svg.matches("<rect").count() < (4 + 40) * 162 + 200, "{} rectangles", svg.matches("<rect").count());
}

#[test]
fn results_of_another_study_are_refused() {
    let study = study(AXES, CURVES);
    for record in [json!({ "index": 12 }), json!({ "index": -1 }), json!({}), json!(7)] {
        let refused = study_svg(&study, &study.plots[0], [record.clone()]);
        assert!(matches!(refused, Err(FigureError::NotOfTheStudy(_))), "{record}");
    }
}

/// 300,000 scenes of a random study, of which at most 200,000 are kept: every second by its number's hash.
#[test]
fn of_many_scenes_a_part_is_kept() {
    let axes = "[[axes]]\nrandom = { count = 300000, seed = 1, fields = [\
                { field = 'friction.coefficient', linear = { from = 0.1, to = 0.5 } }, \
                { field = 'layer.thickness', log = { from = 1.0, to = 10.0 } }] }\n";
    let study = study(axes, CURVES);
    let bare =
        |index: u64| json!({ "index": index, "status": "converged", "stick": { "ratio": 0.2 + 1e-6 * index as f64 } });
    let svg = figure(&study, (0..300_000).map(bare));
    assert_eq!(curves(&svg), 0, "values drawn at random are points");
    let marks = svg.matches("<circle").count();
    assert!((1000..=5001).contains(&marks), "{marks} marks");
    assert_eq!(svg, figure(&study, (0..300_000).rev().map(bare)), "in any order");
}

#[test]
fn odd_numbers_still_fit_a_figure() {
    let study = study(AXES, CURVES);
    for odd in [0.0, -1e-300, 1e300, -7.0, 1e-12] {
        let odd = records(&study).into_iter().map(|mut record| {
            record["stick"]["ratio"] = json!(odd);
            record
        });
        texts(&figure(&study, odd));
    }
    let log = self::study(AXES, &format!("{CURVES}y_scale = 'log'\n"));
    let mut all = records(&log);
    all[1]["stick"]["ratio"] = json!(0.0);
    all[2]["stick"]["ratio"] = json!(null);
    texts(&figure(&log, all));
}

/// Ticks of an ordinate end at the frame, those of an abscissa stand under their places.
fn ticks(svg: &str, anchor: &str) -> Vec<(f64, String)> {
    let document = roxmltree::Document::parse(svg).expect("well-formed XML");
    let labels =
        document.descendants().filter(|n| n.has_tag_name("text") && n.attribute("text-anchor") == Some(anchor));
    let at = |n: &roxmltree::Node| n.attribute("x").and_then(|x| x.parse().ok()).expect("a place");
    let number = |text: &&str| text.starts_with(|c: char| c.is_ascii_digit());
    labels.filter_map(|n| Some((at(&n), n.text().filter(number)?.to_owned()))).collect()
}

#[test]
fn log_axes_have_ticks_that_differ_and_keep_apart() {
    for (from, to) in
        [(0.21, 0.43), (3.1, 3.3), (2.1e-7, 4.1e-7), (1e-90, 1e90), (0.03, 0.9), (0.3, 2e4), (310.0, 420.0)]
    {
        let axes = format!("[[axes]]\nfield = 'load.force'\nlog = {{ from = {from:?}, to = {to:?}, count = 5 }}\n");
        let study = study(&axes, "x = 'load.force'\ny = 'pressure.mean'\nx_scale = 'log'\ny_scale = 'log'\n");
        let all = (0..5).map(|index| {
            let Cell::Number(force) = study.cells(index)[0] else { panic!("a number") };
            json!({ "index": index, "status": "converged", "pressure": { "mean": force } })
        });
        let svg = figure(&study, all);
        let (below, beside) = (ticks(&svg, "middle"), ticks(&svg, "end"));
        let width = |text: &str| 0.5 * 14.0 * text.chars().count() as f64;
        for side in [&below, &beside] {
            assert!((2..=12).contains(&side.len()), "{from} to {to}: {side:?}");
            assert!(side.windows(2).all(|pair| pair[0].1 != pair[1].1), "{from} to {to}: {side:?}");
            // 1000 beside 10⁴ would be two ways of writing.
            let powers = side.iter().filter(|tick| tick.1.contains(|c| "⁰¹²³⁴⁵⁶⁷⁸⁹".contains(c))).count();
            let expected = if from > 1e-3 && to < 9e3 { 0 } else { side.len() };
            assert_eq!(powers, expected, "{from} to {to}: {side:?}");
        }
        let apart =
            |pair: &[(f64, String)]| pair[1].0 - pair[0].0 > f64::midpoint(width(&pair[0].1), width(&pair[1].1));
        assert!(below.windows(2).all(apart), "{from} to {to}: {below:?}");
        let name = svg.split("rotate(-90,").nth(1).and_then(|rest| rest.split(',').next()?.parse::<f64>().ok());
        let longest = beside.iter().map(|(at, text)| at - width(text)).fold(f64::INFINITY, f64::min);
        assert!(name.expect("an upright name") < longest, "{from} to {to}: {name:?} {beside:?}");
    }
}

/// A pressure that friction does not change filled the frame with its errors, between ticks that all read 0.536400686.
#[test]
fn numbers_that_differ_by_their_errors_only_are_a_level_line() {
    let study = study(AXES, "x = 'friction.coefficient'\ny = 'pressure.mean'\n");
    let with = |difference: f64| {
        let all = records(&study).into_iter().enumerate().map(|(n, mut record)| {
            record["pressure"]["mean"] = json!(0.536_400_686 * (1.0 + difference * n as f64));
            record
        });
        ticks(&figure(&study, all), "end")
    };
    for difference in [0.0, 1e-11, 5e-10, 1e-8, 1e-3] {
        let beside = with(difference);
        assert!(beside.windows(2).all(|pair| pair[0].1 != pair[1].1), "{difference:e}: {beside:?}");
    }
    assert_eq!(with(0.0), with(5e-10));
}

#[test]
fn members_that_differ_have_names_that_do() {
    let axes = AXES.replace("[0.4, 0.1, 0.2, 0.3]", "[0.3, 0.300001, 0.30002, 0.1]");
    let study = study(
        &axes,
        "x = 'load.force'\ny = 'stick.ratio'\nfamily = 'friction.coefficient'\nonly = { 'mu1/mu3' = '1' }\n",
    );
    let found = texts(&figure(&study, records(&study)));
    for name in ["η = 0.3", "η = 0.300001", "η = 0.30002", "η = 0.1"] {
        assert_eq!(found.iter().filter(|text| *text == name).count(), 1, "{name} in {found:?}");
    }
}

#[test]
fn long_lines_stay_within_the_figure() {
    let note = "note = 'a note that goes on and on, without an end that would fit into one line of the figure, or into two of them at all'\n";
    let study = study(AXES, &("x = 'friction.coefficient'\ny = 'stick.ratio'\ny_scale = 'log'\n".to_owned() + note));
    let mut all = records(&study);
    for record in &mut all {
        record["stick"]["ratio"] = json!(record["index"].as_f64().unwrap() - 8.5);
    }
    let found = texts(&figure(&study, all));
    assert!(found.iter().any(|text| text.contains("no place")) && found.iter().any(|text| text.contains("a note")));
    assert!(found.iter().all(|text| text.chars().count() <= 80), "{found:?}");
}
