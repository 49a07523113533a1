//! How long scenes take to solve inside of a process, each time from nothing: no table or matrix is kept between
//! solves.
//!
//! `cargo run --release --example time_scenes -- 200 SCENE.toml ...` prints a JSON line for each scene: its file, the
//! shortest and the median time of 200 solves in seconds, and the numbers found. The scenes take turns, so that what
//! else the machine does falls on all of them. Without arguments it solves `examples/flat.toml` three times.

use serde_json::json;
use slipzone::engine::{Solution, solve};
use slipzone::scene::{Scene, parse};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let rounds: usize = arguments.next().map_or(Ok(3), |rounds| rounds.parse())?;
    let mut files: Vec<String> = arguments.collect();
    if files.is_empty() {
        files.push(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/flat.toml").into());
    }
    let scenes: Vec<Scene> = files.iter().map(|file| read(file)).collect::<Result<_, _>>()?;
    let mut times = vec![Vec::new(); scenes.len()];
    for _ in 0..rounds.max(1) {
        for (scene, times) in scenes.iter().zip(&mut times) {
            let start = Instant::now();
            let solution = solve(scene);
            times.push((start.elapsed().as_secs_f64(), solution));
        }
    }
    for (file, mut times) in files.iter().zip(times) {
        times.sort_by(|one, other| one.0.total_cmp(&other.0));
        println!("{}", line(file, times[0].0, times[times.len() / 2].0, &times[0].1));
    }
    Ok(())
}

fn read(file: &str) -> Result<Scene, Box<dyn Error>> {
    let text = std::fs::read_to_string(file).map_err(|error| format!("{file}: {error}"))?;
    Ok(parse(file, &text)?)
}

fn line(file: &str, shortest: f64, median: f64, solution: &Solution) -> serde_json::Value {
    json!({
        "file": file, "shortest": shortest, "median": median,
        "status": solution.status, "reason": solution.reason,
        "load": solution.load, "pressure": solution.pressure, "edge": solution.edge, "stick": solution.stick,
        "error": solution.error.estimate, "unknowns": solution.plan.unknowns,
    })
}
