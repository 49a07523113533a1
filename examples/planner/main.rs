//! Measures what a model in place of a solid costs and saves, on random scenes (docs/planner.md).
//!
//! `cargo run --release --example planner -- bounds 5000` forces each model on each scene and compares the true errors
//! with the bounds; `-- saved 5000` lets the planner choose, compares with the full model and counts the work saved.

mod scenes;

use rayon::prelude::*;
use scenes::{ALL_BUT_DEPTH, Dice, differences, scene};
use slipzone::engine::{Solution, Status, solve};
use slipzone::scene::{Asked, Model, Scene};
use std::collections::BTreeMap;
use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    slipzone::link_plugins();
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let number =
        |index: usize, default: u64| arguments.get(index).and_then(|text| text.parse().ok()).unwrap_or(default);
    let (count, seed) = (number(1, 200), number(2, 1));
    println!("{count} scenes, seed {seed}");
    let holds = match arguments.first().map(String::as_str) {
        Some("bounds") => bounds(count, seed),
        Some("saved") | None => saved(count, seed),
        Some(_) => {
            println!("usage: planner [bounds|saved] [COUNT] [SEED]");
            false
        }
    };
    if holds { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn dice(seed: u64, index: u64) -> Dice {
    Dice(seed.wrapping_mul(1_000_003).wrapping_add(index))
}

fn parsed(text: &str) -> Scene {
    slipzone::scene::parse("planner.toml", text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// Models that stand for layers thicker than their contacts are wide, whatever the scene.
const THICK: [Model; 3] = [Model::HalfPlane, Model::CorrectedHalfPlane, Model::Homogeneous];

/// Every model forced on every scene: its true errors over the bounds that it states. Whether all are below 1.
fn bounds(count: u64, seed: u64) -> bool {
    let one = |index: u64| {
        let text = scene(&mut dice(seed, index));
        let mut found = Vec::new();
        for model in THICK {
            let output = if model == Model::HalfPlane { ALL_BUT_DEPTH } else { "points = 2" };
            let with = |model: Model| {
                let name = model.name();
                solve(&parsed(&format!("{text}[solver]\ntolerance = 1e-6\nmodel = \"{name}\"\n[output]\n{output}\n")))
            };
            let forced = with(model);
            if forced.status == Status::Refused || forced.plan.model != model {
                continue;
            }
            let full = with(Model::Full);
            if full.status != Status::Converged {
                continue;
            }
            for (path, error, stated) in differences(&forced, &full) {
                // Numerical errors are no matter of the bound.
                if stated < 1.0 && error > 1e-5 {
                    found.push((model, path, error / stated, text.clone()));
                }
            }
        }
        found
    };
    let all: Vec<_> = (0..count).into_par_iter().flat_map_iter(one).collect();
    for model in THICK {
        for path in Asked::NAMES {
            let of = all.iter().filter(|one| one.0 == model && one.1 == path);
            let Some(worst) = of.clone().max_by(|one, other| one.2.total_cmp(&other.2)) else { continue };
            let (name, scenes) = (model.name(), of.count());
            println!("{name:20} {path:22} {scenes:5} scenes, true error at most {:.3} of the bound", worst.2);
            if std::env::var_os("WORST").is_some() {
                println!("{}", worst.3);
            }
        }
    }
    all.iter().all(|one| one.2 < 1.0)
}

/// Solves of which the fastest counts.
const REPEATS: usize = 3;

/// The planner's answers against the full model's, and the work of both.
fn saved(count: u64, seed: u64) -> bool {
    let one = |index: u64| {
        let mut dice = dice(seed, index);
        let text = scene(&mut dice);
        let tolerance = dice.log(1e-6, 3e-2);
        let output = dice.one_of(&[ALL_BUT_DEPTH, ALL_BUT_DEPTH, "points = 2"]);
        let with = |tolerance: f64, solver: &str| {
            let text = format!("{text}[solver]\ntolerance = {tolerance:e}\n{solver}[output]\n{output}\n");
            let scene = parsed(&text);
            let timed = || {
                let started = Instant::now();
                (solve(&scene), started.elapsed().as_secs_f64())
            };
            // The shortest of a few: others use the machine, too.
            (0..REPEATS).map(|_| timed()).min_by(|one, other| one.1.total_cmp(&other.1)).expect("a few")
        };
        let (planned, time) = with(tolerance, "");
        let (full, time_full) = with(tolerance, "model = \"full\"\n");
        let exact = solve(&parsed(&format!(
            "{text}[solver]\ntolerance = {:e}\nmodel = \"full\"\n[output]\n{output}\n",
            (0.01 * tolerance).max(1e-8)
        )));
        let ill = |one: &Solution| one.status != Status::Converged;
        let off = differences(&planned, &exact);
        let is_within = ill(&exact) || (!ill(&planned) && off.iter().all(|one| one.1 <= 1.01 * tolerance));
        // Of the layer itself the estimate may be exceeded, but no more than three times: the planner did nothing.
        let is_full = planned.plan.model == Model::Full && !ill(&planned);
        let holds = is_within || is_full && off.iter().all(|one| one.1 <= 3.0 * one.2);
        if !is_within {
            let model = planned.plan.model.name();
            println!("{text}tolerance {tolerance:e}, {model}: {:?} {:?} {off:?}", planned.status, planned.reason);
        }
        (planned.plan.model, planned.plan, full.plan, time / time_full, holds, !ill(&exact))
    };
    // One after the other: times are compared.
    let all: Vec<_> = (0..count).map(one).collect();
    for model in Model::ALL {
        let of: Vec<_> = all.iter().filter(|one| one.0 == model).collect();
        println!("{}: {} scenes", model.name(), of.len());
        if model == Model::Full || of.is_empty() {
            continue;
        }
        let share = |part: usize, whole: usize| if whole == 0 { 1.0 } else { part as f64 / whole as f64 };
        histogram(
            "wave numbers left",
            of.iter().map(|one| share(one.1.flexibility_evaluations, one.2.flexibility_evaluations)),
        );
        histogram("systems left", of.iter().map(|one| share(one.1.factorisations, one.2.factorisations)));
        histogram("time left", of.iter().map(|one| one.3));
    }
    println!("not judged, as the full model did not converge: {}", all.iter().filter(|one| !one.5).count());
    all.iter().all(|one| one.4)
}

/// Shares of the full model's work, in bins.
fn histogram(name: &str, shares: impl Iterator<Item = f64>) {
    const BINS: [f64; 7] = [0.0, 0.1, 0.25, 0.5, 0.75, 0.95, 1.05];
    let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
    for share in shares {
        *counts.entry(BINS.iter().position(|bin| share <= *bin).unwrap_or(BINS.len())).or_default() += 1;
    }
    print!("  {name:18}");
    for (index, bin) in BINS.iter().enumerate() {
        print!(" <={bin}: {:4}", counts.get(&index).copied().unwrap_or_default());
    }
    println!(" more: {}", counts.get(&BINS.len()).copied().unwrap_or_default());
}
