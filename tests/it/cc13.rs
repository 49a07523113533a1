//! The studies of `examples/cc13/`: the paper's figures and table, and what its text claims of them.

use serde_json::{Value, json};
use slipzone::api::Files;
use slipzone::api::reference::cylinder::Cylinder;
use slipzone::api::reference::goodman_shear::Goodman;
use slipzone::api::reference::{flat_punch, partial_slip};
use slipzone::study::{Study, sweep};
use std::ops::ControlFlow;
use std::sync::OnceLock;

/// The folder of the studies.
struct Folder;

impl Files for Folder {
    fn read(&self, name: &str) -> Result<Vec<u8>, String> {
        std::fs::read(format!("{}/examples/cc13/{name}", env!("CARGO_MANIFEST_DIR"))).map_err(|error| error.to_string())
    }
}

fn study(name: &str) -> Study {
    let file = format!("{name}.toml");
    let text = String::from_utf8(Folder.read(&file).unwrap_or_else(|e| panic!("{file}: {e}"))).expect("text");
    Study::parse(&file, &text, &Folder).unwrap_or_else(|error| panic!("{error}"))
}

/// The lines of a study's results.
fn solved(study: &Study) -> Vec<Value> {
    let mut records = Vec::new();
    sweep(study, &|_| false, |record| {
        records.push(serde_json::to_value(&record).expect("JSON"));
        ControlFlow::Continue(())
    });
    records.sort_by_key(|record| record["index"].as_u64());
    records
}

/// A study's name, the study and its results.
type Solved = (String, Study, Vec<Value>);

/// All studies, each solved once.
fn all() -> &'static [Solved] {
    static ALL: OnceLock<Vec<Solved>> = OnceLock::new();
    ALL.get_or_init(|| {
        let names = (2..=12).map(|figure| format!("figure{figure}"));
        let names = names.chain(["table1", "map", "fretting"].map(Into::into));
        names
            .map(|name| {
                let study = study(&name);
                let records = solved(&study);
                (name, study, records)
            })
            .collect()
    })
}

/// The results of a study where some of its axes have these values, in the order of the scenes.
fn results(name: &str, wanted: &[(&str, Value)]) -> Vec<&'static Value> {
    let (_, _, records) = all().iter().find(|solved| solved.0 == name).expect("a study");
    let is_wanted = |record: &&Value| wanted.iter().all(|(axis, value)| record["axes"][axis] == *value);
    let found: Vec<&Value> = records.iter().filter(is_wanted).collect();
    assert!(!found.is_empty(), "{name} has no scene with {wanted:?}");
    found
}

fn number(record: &Value, path: &str) -> f64 {
    let value = record.pointer(&format!("/{}", path.replace('.', "/"))).and_then(Value::as_f64);
    value.unwrap_or_else(|| panic!("no {path} in {record}"))
}

/// A number of those scenes, all of which converged.
fn column(name: &str, wanted: &[(&str, Value)], path: &str) -> Vec<f64> {
    let one = |record: &&Value| {
        assert_eq!(record["status"], "converged", "{name}: {record}");
        number(record, path)
    };
    results(name, wanted).iter().map(one).collect()
}

/// `mu1/mu3`, from the layer that stiffens downwards to the one that softens.
const RATIOS: [&str; 3] = ["1/8", "1", "8"];
/// The tolerance that the studies ask for; their numbers are that good.
const TOLERANCE: f64 = 1e-6;
/// `(kappa - 1)/(kappa + 1)` at `nu = 0.3`.
const BETA: f64 = 0.8 / 2.8;

/// Whether numbers fall by more than what they may be wrong by.
fn falls(numbers: &[f64]) -> bool {
    numbers.windows(2).all(|pair| pair[1] < pair[0] - 4.0 * TOLERANCE * pair[0].abs())
}

fn rises(numbers: &[f64]) -> bool {
    falls(&numbers.iter().rev().copied().collect::<Vec<_>>())
}

/// Whether each number is above the other's.
fn all_above(one: &[f64], other: &[f64]) -> bool {
    one.len() == other.len() && one.iter().zip(other).all(|(one, other)| one > other)
}

fn assert_close(got: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((got / expected - 1.0).abs() <= tolerance, "{what}: {got}, expected {expected}");
}

/// What the page says is what the program finds.
fn assert_said(sentence: &str) {
    let page = include_str!("../../docs/cc13.md").split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(page.contains(sentence), "docs/cc13.md does not say: {sentence}");
}

#[test]
fn all_scenes_have_numbers_but_three_and_slip_inwards() {
    for (name, _, records) in all() {
        for record in records {
            let axes = &record["axes"];
            let eta = axes["eta"].as_f64().unwrap_or(1.0);
            let shrinks = name == "figure8" && axes["punch"] != "flat punch" && axes["mu1/mu3"] == "8" && eta < 0.11;
            let status = if shrinks { "assumption-violated" } else { "converged" };
            assert_eq!(record["status"], status, "{name}: {record}");
            if shrinks {
                assert!(record["reason"].as_str().expect("a reason").contains("the stick zone shrinks"), "{record}");
            } else {
                assert_eq!(record["stick"]["slip"], "inward", "{name}: {record}");
            }
        }
    }
}

#[test]
fn table_1_is_off_by_what_the_page_says() {
    /// [CC13] Table 1, rows by ratio, columns by thickness.
    const PRINTED: [[f64; 3]; 3] = [[0.2930, 0.2801, 0.2536], [0.3178, 0.3161, 0.3098], [0.3450, 0.3699, 0.4075]];
    let cases: Value = serde_json::from_str(include_str!("../data/layer_cases.json")).expect("valid JSON");
    let cases = cases["cases"].as_array().expect("a list");
    for ((ratio, value), printed) in RATIOS.into_iter().zip([0.125, 1.0, 8.0]).zip(PRINTED) {
        let mut line = vec![format!("| {ratio} |")];
        for (h, printed) in [20, 10, 5].into_iter().zip(printed) {
            let wanted = [("mu1/mu3", json!(ratio)), ("h/b", json!(f64::from(h)))];
            let got = column("table1", &wanted, "edge.ratio")[0];
            let is_it = |case: &&Value| {
                let key = |key: &str| case[key].as_f64();
                (key("h_over_b"), key("mu1_over_mu3"), key("nu")) == (Some(f64::from(h)), Some(value), Some(0.3))
            };
            let independent = &cases.iter().find(is_it).expect("a case")["flat"]["edge"];
            assert_close(got, independent.as_f64().expect("a number"), TOLERANCE, "Table 1");
            let off = 100.0 * (printed / got - 1.0);
            line.push(format!("{printed:.4} | {got:.5} | {off:+.2} % |"));
        }
        assert_said(&line.join(" ").replace('-', "\u{2212}"));
    }
}

#[test]
fn figure_2_is_the_closed_form() {
    let record = results("figure2", &[])[0];
    let goodman = Goodman { eta: 0.2374, beta: BETA };
    assert_close(number(record, "stick.ratio"), goodman.stick().ratio, TOLERANCE, "a/b");
    let profile = |key: &str| record["profile"][key].as_array().expect("a column");
    for ((x, p), q) in profile("x").iter().zip(profile("pressure")).zip(profile("shear")) {
        let (x, Some(p), Some(q)) = (x.as_f64().expect("a number"), p.as_f64(), q.as_f64()) else { continue };
        assert_close(p, flat_punch::pressure(2.0, 1.0, 1.0 - x.abs()), TOLERANCE, "p");
        // The shear is as good as the pressure that limits it.
        assert!((q - goodman.flat(2.0, 1.0, x)).abs() <= 10.0 * TOLERANCE * p, "q at {x}: {q}");
    }
    assert_said("a/b = 0.5530");
}

#[test]
fn figure_3_is_the_closed_form_beside_the_coupled_solutions() {
    for record in results("figure3", &[]) {
        let eta = number(record, "axes.eta");
        assert_close(number(record, "stick.ratio"), partial_slip::stick(eta, BETA).ratio, TOLERANCE, "a/b");
    }
    // The marks are the rows of the reference.
    let text = include_str!("../data/coupled_half_plane.csv");
    let rows = text.lines().filter_map(|line| line.strip_prefix("0.3,"));
    let rows: Vec<Vec<f64>> = rows.map(|row| row.split(',').map(|n| n.parse().expect("a number")).collect()).collect();
    let (_, study, _) = all().iter().find(|solved| solved.0 == "figure3").expect("a study");
    let points = &study.plots[0].points[0];
    assert_eq!(points.x, rows.iter().map(|row| row[1]).collect::<Vec<_>>());
    assert_eq!(points.y, rows.iter().map(|row| row[0]).collect::<Vec<_>>());
    // More sticks in Goodman's approximation; it takes less friction for the same zone.
    for row in rows {
        let (ratio, eta) = (row[0], row[1]);
        let goodman = partial_slip::stick(eta, BETA).ratio;
        let friction = partial_slip::friction(partial_slip::Stick::from_ratio(ratio), BETA);
        assert!(goodman > ratio && friction < eta);
        let (more, less) = (100.0 * (goodman / ratio - 1.0), 100.0 * (1.0 - friction / eta));
        assert_said(&format!(
            "| {ratio} | {eta:.4} | {goodman:.4} | {more:+.1} % | {friction:.4} | \u{2212}{less:.1} % |"
        ));
    }
}

#[test]
fn figure_4_is_the_closed_form() {
    let record = results("figure4", &[])[0];
    let goodman = Goodman { eta: 0.23738, beta: BETA };
    // A0 = (kappa + 1)/(4 mu) = (1 - nu)/mu.
    let hertz = Cylinder { radius: 10.0, half_width: 1.0, compliance: 0.7 };
    assert_close(number(record, "stick.ratio"), goodman.stick().ratio, TOLERANCE, "a/b");
    assert_close(number(record, "load.force"), hertz.force(), TOLERANCE, "P");
    let profile = |key: &str| record["profile"][key].as_array().expect("a column");
    for ((x, p), q) in profile("x").iter().zip(profile("pressure")).zip(profile("shear")).step_by(10) {
        let [x, p, q] = [x, p, q].map(|n| n.as_f64().expect("bounded"));
        assert!((p - hertz.pressure(x)).abs() <= TOLERANCE * hertz.peak_pressure(), "p at {x}: {p}");
        let rate = |b: f64| Cylinder { half_width: b, ..hertz }.force_rate();
        let exact = goodman.grown(rate, &[], 1.0, x);
        assert!((q - exact).abs() <= 10.0 * TOLERANCE * hertz.peak_pressure(), "q at {x}: {q}, {exact}");
    }
}

#[test]
fn figure_5_sticks_more_than_a_homogeneous_half_plane() {
    let graded = column("figure5", &[], "stick.ratio")[0];
    let homogeneous = partial_slip::stick(0.35, BETA).ratio;
    assert!(graded > homogeneous);
    assert_said(&format!("a/b = {graded:.4}"));
    assert_said(&format!("{homogeneous:.4}"));
}

#[test]
fn figure_6_stiffer_below_is_more_uniform_and_sticks_more() {
    let over = |path: &str| RATIOS.map(|ratio| column("figure6", &[("mu1/mu3", json!(ratio))], path)[0]);
    assert!(falls(&over("pressure.centre")), "in mean pressures, which are 1: more uniform");
    assert!(rises(&over("edge.ratio")));
    assert!(falls(&over("stick.ratio")));
    let [stiff, plain, _] = over("edge.ratio");
    assert_said(&format!("by {:.0} % at 1/8", 100.0 * (1.0 - stiff / plain)));
    for (centre, ratio) in over("pressure.centre").into_iter().zip(over("stick.ratio")) {
        assert_said(&format!("| {centre:.3} | {ratio:.4} |"));
    }
}

#[test]
fn figure_7_stiffer_below_bears_more_at_the_same_width() {
    let over = |path: &str| RATIOS.map(|ratio| column("figure7", &[("mu1/mu3", json!(ratio))], path)[0]);
    assert!(falls(&over("load.force")) && falls(&over("pressure.centre")) && falls(&over("stick.ratio")));
    for (force, peak) in over("load.force").into_iter().zip(over("pressure.peak")) {
        assert_said(&format!("| {force:.4} | {peak:.4} |"));
    }
}

#[test]
fn figure_8_more_friction_sticks_more_and_so_does_a_stiffer_base() {
    let flat = RATIOS
        .map(|ratio| column("figure8", &[("mu1/mu3", json!(ratio)), ("punch", json!("flat punch"))], "stick.ratio"));
    for (ratio, zones) in RATIOS.into_iter().zip(&flat) {
        assert!(rises(&zones[..24]), "{ratio}: {zones:?}");
        // Beyond, 1 - a/b tells them apart.
        let rest =
            column("figure8", &[("mu1/mu3", json!(ratio)), ("punch", json!("flat punch"))], "stick.one_minus_ratio");
        assert!(falls(&rest[8..]), "{rest:?}");
        assert_said(&format!("{:.1e}", rest.last().expect("a number")));
        // The profile does not matter, where the history goes one way.
        for record in results("figure8", &[("mu1/mu3", json!(ratio)), ("punch", json!("cylinder, R/b = 10"))]) {
            if record["status"] == "converged" {
                let eta = &record["axes"]["eta"];
                let wanted = [("mu1/mu3", json!(ratio)), ("punch", json!("flat punch")), ("eta", eta.clone())];
                let same = column("figure8", &wanted, "stick.ratio")[0];
                assert_close(number(record, "stick.ratio"), same, 2.0 * TOLERANCE, "flat and cylinder");
            }
        }
    }
    let [stiff, plain, soft] = &flat;
    assert!(all_above(stiff, plain) && all_above(plain, soft));
}

#[test]
fn figure_9_the_strain_tends_to_a_constant_that_grows_with_the_ratio() {
    let linear = |ratio: &str, path: &str| {
        column("figure9", &[("mu1/mu3", json!(ratio)), ("strain", json!("strain C|x|"))], path)
    };
    let strains = RATIOS.map(|ratio| linear(ratio, "stick.strain_rate"));
    for strain in &strains {
        assert!(rises(strain) && strain.iter().all(|c| *c < 0.0), "{strain:?}");
        let [.., before, last] = strain[..] else { panic!("too few") };
        // The last step of 0.05 in eta changes it by less than half a percent; the first by a factor of up to 1.6.
        assert!((before / last - 1.0).abs() < 5e-3);
        assert_said(&format!("{last:.5}").replace('-', "\u{2212}"));
    }
    let [stiff, plain, soft] = &strains;
    assert!(all_above(stiff, plain) && all_above(plain, soft), "they are negative");
    // What it makes of the stick zone: too small at eta = 0.3, by what theory.md says.
    for (ratio, off) in RATIOS.into_iter().zip([-1.8, -6.4, -23.6]) {
        let at = |strain: &str| {
            let wanted = [("mu1/mu3", json!(ratio)), ("strain", json!(strain))];
            let all = results("figure9", &wanted);
            let record = all.iter().find(|r| (number(r, "axes.eta") - 0.3).abs() < 1e-9).expect("eta = 0.3");
            number(record, "stick.ratio")
        };
        let found = 100.0 * (at("strain C|x|") / at("strain by history") - 1.0);
        assert!((found - off).abs() < 0.05, "{found}");
    }
}

fn over_thickness(ratio: &str, path: &str) -> Vec<f64> {
    column("figure10", &[("mu1/mu3", json!(ratio)), ("punch", json!("flat punch"))], path)
}

#[test]
fn figure_10_thick_layers_tend_to_the_half_plane_slowly() {
    let half_plane = partial_slip::stick(0.3, BETA).ratio;
    let (_, study, _) = all().iter().find(|solved| solved.0 == "figure10").expect("a study");
    assert_close(study.plots[0].lines[0].y, half_plane, TOLERANCE, "the line");
    assert_said(&format!("a/b = {half_plane:.4}."));
    let [stiff, plain, soft] = RATIOS.map(|ratio| over_thickness(ratio, "stick.ratio"));
    assert!(falls(&stiff) && falls(&plain) && plain[24] > half_plane);
    // Not so where the layer softens: the zone is smallest at h = 10 b, and comes from below.
    let least = soft.iter().copied().fold(1.0, f64::min);
    assert!((least - soft[12]).abs() < 1e-12 && falls(&soft[..13]) && rises(&soft[13..]) && soft[24] < half_plane);
    for (ratio, zones) in RATIOS.into_iter().zip([&stiff, &plain, &soft]) {
        let off = |i: usize| format!("{:+.1} %", 100.0 * (zones[i] / half_plane - 1.0)).replace('-', "\u{2212}");
        assert_said(&format!("| {ratio} | {:.4} ({}) | {:.4} ({}) |", zones[12], off(12), zones[24], off(24)));
    }
    // The edge forgets the base sooner than the stick zone does.
    let edge = over_thickness("1", "edge.ratio");
    let off = (1.0 - edge[12] * std::f64::consts::PI, plain[12] / half_plane - 1.0);
    let far = |path: &str| column("table1", &[("mu1/mu3", json!("1")), ("h/b", json!(20.0))], path)[0];
    let (at_edge, of_stick) = (1.0 - far("edge.ratio") * std::f64::consts::PI, far("stick.ratio") / half_plane - 1.0);
    assert_said(&format!("{:.1} % at the edge and {:.0} % of the stick zone. A", 100.0 * at_edge, 100.0 * of_stick));
    assert!(off.0 < 0.01 && off.1 > 0.1, "{off:?}");
    assert_said(&format!("{:.1} % at the edge and {:.0} % of the stick zone", 100.0 * off.0, 100.0 * off.1));
}

#[test]
fn figure_11_a_thinner_layer_is_more_uniform_but_for_a_stretch_on_soft_bases() {
    let over = |ratio: &str, path: &str| column("figure11", &[("mu1/mu3", json!(ratio))], path);
    for ratio in ["1/8", "1"] {
        assert!(rises(&over(ratio, "edge.ratio")) && falls(&over(ratio, "pressure.centre")), "thickness grows");
    }
    // The paper's rows, 20 to 5: contrary, as it says. Thinner still: the same as on the others.
    let soft = over("8", "edge.ratio");
    assert!(falls(&soft[1..]) && soft[0] < soft[1] - 0.05);
    let edge = over_thickness("8", "edge.ratio");
    let most = edge.iter().copied().fold(0.0, f64::max);
    assert!((most - edge[5]).abs() < 1e-12, "between 2.1 and 3.2 b");
    let at = over_thickness("8", "axes.h~1b")[5];
    assert_said(&format!("the ratio is largest, {most:.3}, at h/b = {at:.1} "));
    for ratio in RATIOS {
        let cells: Vec<String> = over(ratio, "edge.ratio").iter().map(|edge| format!("{edge:.4}")).collect();
        assert_said(&format!("| {ratio} | {} |", cells.join(" | ")));
    }
}

#[test]
fn figure_12_a_thinner_layer_bears_more_unless_it_softens_downwards() {
    let over = |ratio: &str| column("figure12", &[("mu1/mu3", json!(ratio))], "load.force");
    assert!(falls(&over("1/8")) && falls(&over("1")), "thickness grows");
    // The paper claims it for all ratios.
    let soft = over("8");
    assert!(rises(&soft[1..]) && soft[0] > soft[1]);
    assert_said(&format!("by {:.0} % from h/b = 20 to 2", 100.0 * (1.0 - soft[1] / soft[4])));
    for ratio in RATIOS {
        let cells: Vec<String> = over(ratio).iter().map(|force| format!("{force:.4}")).collect();
        assert_said(&format!("| {ratio} | {} |", cells.join(" | ")));
    }
}

#[test]
fn a_narrower_contact_is_pressed_harder() {
    let over = |path: &str| column("fretting", &[], path);
    let (width, peak, stick) = (over("load.half_width"), over("pressure.peak"), over("stick.ratio"));
    assert!(falls(&width) && rises(&peak) && rises(&stick));
    assert_said(&format!("narrows the contact by {:.0} %", 100.0 * (1.0 - width[12] / width[6])));
    assert_said(&format!("raises the peak pressure by {:.0} %", 100.0 * (peak[12] / peak[6] - 1.0)));
    for i in [0, 6, 12] {
        let slip = width[i] * over("stick.one_minus_ratio")[i];
        assert_said(&format!("| {:.3} | {:.4} | {:.4} | {slip:.4} |", width[i], peak[i], stick[i]));
    }
}

#[cfg(feature = "plot")]
fn drawn() -> Vec<(String, String)> {
    let figures = all().iter().flat_map(|(name, study, records)| {
        study.plots.iter().map(move |plot| {
            let svg = slipzone::report::study_svg(study, plot, records.iter().cloned());
            (plot.file.clone(), svg.unwrap_or_else(|error| panic!("{name}: {error}")).svg)
        })
    });
    figures.collect()
}

#[cfg(feature = "plot")]
#[test]
fn the_figures_of_the_page_are_what_the_program_draws() {
    let figures = drawn();
    assert_eq!(figures.len(), 14, "figures 2 to 12, one of them twice, a map, and one of fretting");
    for (file, svg) in figures {
        let committed = format!("{}/docs/figures/cc13/{file}", env!("CARGO_MANIFEST_DIR"));
        let committed = std::fs::read_to_string(&committed).unwrap_or_else(|e| panic!("{committed}: {e}"));
        crate::figures::assert_same(&file, &committed, &svg);
        assert_said(&format!("(figures/cc13/{file})"));
    }
}

/// Writes the figures of the document: `SLIPZONE_FIGURES=folder cargo test --test it cc13_to_look_at -- --ignored`.
#[cfg(feature = "plot")]
#[test]
#[ignore = "for the eye"]
fn cc13_to_look_at() {
    let folder = std::path::PathBuf::from(std::env::var("SLIPZONE_FIGURES").expect("a folder"));
    for (file, svg) in drawn() {
        std::fs::write(folder.join(file), svg).expect("a file");
    }
}
