//! `slipzone chart`, from the command line: the files, and what stands in them.

use crate::run::{files, folder, run, told};
use std::collections::BTreeSet;
use std::fs;

fn lines(text: &str) -> Vec<csv::StringRecord> {
    csv::Reader::from_reader(text.as_bytes()).records().map(|record| record.unwrap()).collect()
}

#[test]
fn a_scene_is_charted_by_every_method() {
    let folder = folder();
    let out = run(folder.path(), ["chart", "easy", "--quick", "--out", "."]);
    assert!(out.status.success(), "{}", told(&out));
    let table = fs::read_to_string(folder.path().join("runs.csv")).unwrap();
    let runs = lines(&table);
    let methods: BTreeSet<&str> = runs.iter().map(|run| &run[1]).collect();
    assert_eq!(methods.len(), 7, "{methods:?}");
    for run in &runs {
        assert!(!run.iter().any(|cell| cell.contains("NaN") || cell == "inf"), "{run:?}");
        // The error of a number that a finished run reports is known.
        assert!(run[5] != *"converged" || !run[16].is_empty(), "{run:?}");
    }
    // By unrelated discretisations, the program's own choice keeps what it is asked for.
    for run in runs.iter().filter(|run| run[1] == *"slipzone's choice") {
        let number = |column: usize| run[column].parse::<f64>().unwrap();
        assert!(number(16) <= number(4) && number(18) <= number(4), "{run:?}");
    }
    let figure = fs::read_to_string(folder.path().join("easy.svg")).unwrap();
    for words in ["edge stress intensity", "Pareto frontier", "tolerance asked for", "graded-panels, truncated"] {
        assert!(figure.contains(words), "{words}");
    }
    let page = fs::read_to_string(folder.path().join("index.html")).unwrap();
    assert!(page.contains("\"judges\":[\"de-sinc\",\"graded-panels\"]"), "the data");
    assert!(!page.contains("/*DATA*/"));
    // From disk, without a network: the only address is the name of SVG.
    let addresses = page.match_indices("http").filter(|(at, _)| !page[*at..].starts_with("http://www.w3.org/2000/svg"));
    assert_eq!(addresses.count(), 0);
}

/// Before minutes of work, not after them.
#[test]
fn a_chart_that_cannot_be_written_is_not_begun() {
    for (kind, taken) in [(&["chart", "easy"][..], "easy.svg"), (&["chart", "--atlas"][..], "cells.csv")] {
        let folder = folder();
        fs::create_dir(folder.path().join(taken)).unwrap();
        let out = run(folder.path(), kind.iter().chain(&["--out", "."]));
        assert_eq!(out.status.code(), Some(3), "{}", told(&out));
        assert!(told(&out).contains(taken), "{}", told(&out));
        assert_eq!(files(folder.path()).len(), 2, "nothing beside what was there");
    }
}

#[test]
fn the_atlas_has_a_reason_for_each_black_cell() {
    let folder = folder();
    let out = run(folder.path(), ["chart", "--atlas", "wave-gradient", "units", "--quick", "--out", "."]);
    assert!(out.status.success(), "{}", told(&out));
    let table = fs::read_to_string(folder.path().join("cells.csv")).unwrap();
    let cells = lines(&table);
    // Two by two places by three flexibilities, and by eight ways to solve a contact.
    assert_eq!(cells.len(), 4 * 3 + 4 * 8);
    for cell in &cells {
        let has_number = matches!(&cell[6], "converged" | "flagged");
        assert!(has_number || !cell[10].is_empty(), "{cell:?}");
    }
    assert!(cells.iter().any(|cell| cell[1] == *"transfer-matrix" && cell[6] == *"refused"));
    for name in ["wave-gradient.svg", "units.svg", "index.html"] {
        assert!(folder.path().join(name).exists(), "{name}");
    }
}

#[test]
fn names_are_listed_and_unknown_ones_refused() {
    let folder = folder();
    let out = run(folder.path(), ["chart", "--list"]);
    assert_eq!(String::from_utf8(out.stdout).unwrap().lines().count(), slipzone::chart::ALL.len());
    let out = run(folder.path(), ["chart", "--atlas", "thikness-ratio"]);
    assert_eq!(out.status.code(), Some(2));
    assert!(told(&out).contains("did you mean `thickness-ratio`?"), "{}", told(&out));
    assert_eq!(files(folder.path()).len(), 1, "no folder is made");
}
