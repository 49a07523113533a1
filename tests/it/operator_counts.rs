//! The work that the standard scenes and some more take, counted: no change makes it grow unnoticed.

use crate::standard;
use slipzone::engine::solve;
use slipzone::scene::{Scene, parse};
use std::fmt::Write;

/// Counts of a scene, in the order of the file's columns.
const NAMES: [&str; 5] = ["wave_numbers", "kernels_read", "unknowns", "systems", "multiplications"];
/// Set to accept the counts as they are.
const ACCEPT: &str = "SLIPZONE_ACCEPT_COUNTS";
/// Vector units of other machines round differently, so that an estimate may ask for one resolution more or less; on
/// one machine the counts are the same each time.
const ROOM: f64 = 1.02;

/// A flat punch under which friction allows three stick zones, and one under which the only one bears more than
/// friction allows.
fn of_several_zones() -> [(&'static str, Scene); 2] {
    [
        ("thin-several-zones", "thickness = 0.2\npoisson = 0.49", "surface = 1.0, base = 8.0", 0.3),
        ("violated", "thickness = 0.5\npoisson = 0.3", "surface = 8.0, base = 1.0", 0.1),
    ]
    .map(|(name, layer, moduli, friction)| {
        let text = format!(
            "format = 1\n[layer]\n{layer}\ngrading = {{ type = \"exponential\", {moduli} }}\n\
             [punch]\ntype = \"flat\"\nhalf_width = 1.0\n\
             [friction]\ntype = \"goodman\"\ncoefficient = {friction}\n[load]\nforce = 2.0\n"
        );
        (name, parse(name, &text).unwrap_or_else(|error| panic!("{error}")))
    })
}

/// A punch whose kink the contact outgrows by little: that it does is told once.
fn beyond_a_kink() -> (&'static str, Scene) {
    let text = "format = 1\n[layer]\nthickness = 50.0\npoisson = 0.0\n\
                grading = { type = \"exponential\", surface = 1.0, base = 0.04 }\n\
                [punch]\ntype = \"formula\"\nheight = \"0.05*max(x^2, 2*x^2 - 3.5)\"\n\
                [load]\nforce = 0.55\n[solver]\ntolerance = 1e-5\n";
    ("beyond-a-kink", parse("beyond-a-kink", text).unwrap_or_else(|error| panic!("{error}")))
}

fn counted() -> Vec<(&'static str, [u64; 5])> {
    let count = |(name, scene)| {
        let plan = solve(&scene).plan;
        let [wave_numbers, unknowns, systems] =
            [plan.flexibility_evaluations, plan.unknowns, plan.factorisations].map(|count| count as u64);
        (name, [wave_numbers, plan.kernel_evaluations, unknowns, systems, plan.operations])
    };
    standard::scenes().into_iter().chain(of_several_zones()).chain([beyond_a_kink()]).map(count).collect()
}

/// Lines of the file that say something else than `counted`.
fn grown(recorded: &str, counted: &[(&str, [u64; 5])]) -> Vec<String> {
    let mut all = Vec::new();
    for (name, counts) in counted {
        let Some(line) = recorded.lines().find(|line| line.split(',').next() == Some(*name)) else {
            all.push(format!("{name}: no counts are recorded"));
            continue;
        };
        let before: Vec<u64> = line.split(',').skip(1).map(|count| count.parse().expect("a count")).collect();
        for ((what, before), now) in NAMES.iter().zip(before).zip(counts) {
            if *now as f64 > ROOM * before as f64 {
                all.push(format!("{name}: {what} grew from {before} to {now}"));
            }
        }
    }
    all
}

#[test]
fn the_work_of_no_scene_grows() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/operator_counts.csv");
    let counted = counted();
    if std::env::var_os(ACCEPT).is_some_and(|accept| accept == "1") {
        let mut text = format!("scene,{}\n", NAMES.join(","));
        for (name, counts) in &counted {
            writeln!(text, "{name},{}", counts.map(|count| count.to_string()).join(",")).unwrap();
        }
        std::fs::write(path, text).unwrap();
    }
    let recorded = std::fs::read_to_string(path).unwrap();
    let grown = grown(&recorded, &counted);
    assert!(
        grown.is_empty(),
        "{}\nIf more work is wanted, say why in the commit and record it:\n  {ACCEPT}=1 cargo test --test it operator_counts",
        grown.join("\n")
    );
}

#[test]
fn what_grew_is_named() {
    let recorded = "scene,a\nflat,46,100,33,4,1000\n";
    assert_eq!(grown(recorded, &[("flat", [46, 100, 33, 4, 1000])]), [""; 0]);
    assert_eq!(grown(recorded, &[("flat", [40, 101, 33, 5, 1000])]), ["flat: systems grew from 4 to 5"]);
    assert_eq!(grown(recorded, &[("other", [1; 5])]), ["other: no counts are recorded"]);
}
