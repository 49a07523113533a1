//! Random scenes over the whole scene language, and what must hold of each (docs/random-scenes.md).
//!
//! `cargo run --release --example random_scenes -- 100000 --seed 1` is the documented run; `--only 4711` shows one
//! scene of it, `--shrink` makes those that fail as small as they get.

mod trial;

use rayon::prelude::*;
use std::collections::BTreeMap;
use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;
use trial::{Trial, Tried, draw, shrunk};

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let after = |name: &str| -> Option<u64> {
        let index = arguments.iter().position(|argument| argument == name)?;
        arguments.get(index + 1)?.parse().ok()
    };
    let has = |name: &str| arguments.iter().any(|argument| argument == name);
    let count: u64 = arguments.first().and_then(|text| text.parse().ok()).unwrap_or(1000);
    let (seed, from) = (after("--seed").unwrap_or(1), after("--from").unwrap_or(0));
    if let Some(index) = after("--only") {
        return show(seed, index, has("--shrink"));
    }
    println!("{count} scenes from {from}, seed {seed}");
    // Those that panic are told below.
    std::panic::set_hook(Box::new(|_| {}));
    let done = AtomicU64::new(0);
    let all: Vec<(u64, Tried, f64)> = (from..from + count)
        .into_par_iter()
        .map(|index| {
            let trial = draw(seed, index);
            if has("--trace") {
                eprintln!("start {index}");
            }
            let start = Instant::now();
            let tried = trial.run();
            let seconds = start.elapsed().as_secs_f64();
            if has("--trace") {
                eprintln!("end {index} {seconds:.3} {:.4} {} {:.3?}", tried.work, tried.status, tried.seconds);
            }
            if let Some((check, how)) = &tried.failure {
                eprintln!("FAILED scene {index}: {check}: {how}");
            }
            let finished = done.fetch_add(1, Ordering::Relaxed) + 1;
            if finished.is_multiple_of(10_000) {
                eprintln!("{finished} done");
            }
            (index, tried, seconds)
        })
        .collect();
    report(seed, &all, has("--shrink"), has("--reasons"))
}

fn show(seed: u64, index: u64, small: bool) -> ExitCode {
    let trial = draw(seed, index);
    println!("{}", trial.text());
    let tried = trial.run();
    println!("{tried:#?}");
    if small && tried.failure.is_some() {
        tell(&shrunk(&trial));
    }
    if tried.failure.is_none() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn tell(trial: &Trial) {
    println!("--- as small as it gets: {:?}\n{}", trial.run().failure, trial.text());
}

/// Counts by name.
fn counted<'a>(names: impl Iterator<Item = &'a str>) -> BTreeMap<&'a str, usize> {
    names.fold(BTreeMap::new(), |mut counts, name| {
        *counts.entry(name).or_insert(0) += 1;
        counts
    })
}

fn report(seed: u64, all: &[(u64, Tried, f64)], small: bool, reasons: bool) -> ExitCode {
    println!("\nscenes that ended");
    for (status, count) in counted(all.iter().map(|(_, tried, _)| tried.status)) {
        println!("  {status:<20} {count:>7}");
    }
    println!("\nchecks               made and held   did not apply   failed");
    let held = counted(all.iter().flat_map(|(_, tried, _)| tried.held.iter().copied()));
    let skipped = counted(all.iter().flat_map(|(_, tried, _)| tried.skipped.iter().copied()));
    let failed = counted(all.iter().filter_map(|(_, tried, _)| tried.failure.as_ref().map(|(check, _)| *check)));
    let mut names: Vec<&str> = held.keys().chain(failed.keys()).chain(skipped.keys()).copied().collect();
    names.sort_unstable();
    names.dedup();
    for name in names {
        let of = |counts: &BTreeMap<&str, usize>| counts.get(name).copied().unwrap_or(0);
        println!("  {name:<28} {:>7} {:>15} {:>8}", of(&held), of(&skipped), of(&failed));
    }
    let largest = all.iter().max_by(|one, other| one.1.work.total_cmp(&other.1.work));
    if let Some((index, tried, _)) = largest {
        println!("\nlargest share of the budget of work: {:.3} in scene {index}", tried.work);
    }
    if reasons {
        let short = |tried: &Tried| {
            format!(
                "{}: {}",
                tried.status,
                tried.reason.chars().filter(|c| !c.is_ascii_digit()).take(90).collect::<String>()
            )
        };
        let texts: Vec<String> =
            all.iter().filter(|(_, tried, _)| !tried.reason.is_empty()).map(|(_, tried, _)| short(tried)).collect();
        let mut counts: Vec<_> = counted(texts.iter().map(String::as_str)).into_iter().collect();
        counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        counts.iter().take(40).for_each(|(reason, count)| println!("  {count:>6} {reason}"));
    }
    let mut slow: Vec<_> = all.iter().collect();
    slow.sort_by(|one, other| other.2.total_cmp(&one.2));
    println!("\nslowest:");
    for (index, tried, seconds) in slow.iter().take(12) {
        println!(
            "  {seconds:>8.2} s scene {index}: {} {}",
            tried.status,
            tried.reason.chars().take(100).collect::<String>()
        );
    }
    let failures: Vec<_> = all.iter().filter_map(|(index, tried, _)| Some((*index, tried.failure.as_ref()?))).collect();
    for (index, (check, how)) in &failures {
        println!("\nFAILED scene {index}: {check}: {how}");
        if small {
            tell(&shrunk(&draw(seed, *index)));
        }
    }
    if failures.is_empty() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
