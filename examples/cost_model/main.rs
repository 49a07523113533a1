//! What solving costs, counted and timed, against what makes it cost more, with fitted exponents, and where one way
//! of doing it overtakes another: the tables of `docs/scale.md`.
//!
//! `cargo run --release --example cost_model -- NAME...` with any of `unknowns`, `tolerance`, `thickness`, `sublayers`,
//! `scenes`, `models`; without a name it prints the shortest of them, `unknowns`.
//!
//! Work is counted and the same on every machine. Times are the shortest of a few and stand as ratios to the first row.

mod crossovers;
mod scale;
mod scenes;

use slipzone::engine::{Plan, Status, solve};
use slipzone::scene::Scene;
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Times are the shortest of so many, or of as many as fit in so long.
const ROUNDS: u32 = 40;
const LONGEST: Duration = Duration::from_millis(1500);

fn main() -> Result<(), String> {
    slipzone::link_plugins();
    let names: Vec<String> = std::env::args().skip(1).collect();
    for name in if names.is_empty() { vec!["unknowns".to_owned()] } else { names } {
        match name.as_str() {
            "unknowns" => unknowns(),
            "tolerance" => tolerance(),
            "thickness" => thickness(),
            "sublayers" => sublayers(),
            "scenes" => scale::scenes(),
            "models" => crossovers::models(),
            other => return Err(format!("`{other}` is none of the names; see the head of the file")),
        }
    }
    Ok(())
}

/// A quadrature's resolution, all else at its default.
fn unknowns() {
    for friction in [false, true] {
        let rows = [23, 32, 45, 64, 90, 128, 181, 256].map(|n| {
            let solver = format!("quadrature = {{ type = \"de-sinc\", n = {n} }}");
            (f64::from(n), scenes::graded(5.0, "flat", friction, &solver))
        });
        table(&format!("`n` of de-sinc, flat{}", with(friction)), "n", &rows, |n| n >= 32.0);
    }
}

/// Digits asked for.
fn tolerance() {
    let scene = |punch, friction, digits: f64| {
        let solver = format!("tolerance = {:e}", 10.0_f64.powf(-digits));
        (digits, scenes::graded(5.0, punch, friction, &solver))
    };
    for (punch, friction) in [("flat", false), ("flat", true), ("cylinder", false), ("cylinder", true)] {
        let rows = [2.0, 4.0, 6.0, 8.0, 10.0].map(|digits| scene(punch, friction, digits));
        table(&format!("Digits, {punch}{}", with(friction)), "digits", &rows, |digits| digits >= 4.0);
    }
}

/// Half-widths over the thickness.
fn thickness() {
    for friction in [false, true] {
        let rows = [0.05, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0]
            .map(|b: f64| (b, scenes::graded(b.recip(), "flat", friction, "")));
        table(&format!("`b/h`, flat{}", with(friction)), "b/h", &rows, |b| b >= 1.0);
    }
}

/// Sublayers of a stack: all of one thickness, and with a first one that keeps its own.
fn sublayers() {
    for first in [None, Some(0.5)] {
        let rows = [2, 4, 8, 16, 32, 64, 128, 256, 512].map(|n| (f64::from(n), scenes::stack(n, first)));
        let of = first.map_or_else(|| "equal".to_owned(), |first| format!("the first {first} b thick"));
        table(&format!("Sublayers, {of}, flat without friction"), "sublayers", &rows, |n| n >= 8.0);
    }
}

fn with(friction: bool) -> &'static str {
    if friction { " with friction" } else { " without friction" }
}

/// One line for each scene, and the exponents of all columns over those that `fitted` takes.
fn table(title: &str, of: &str, rows: &[(f64, Scene)], fitted: impl Fn(f64) -> bool) {
    println!(
        "\n{title}:\n\n| {of} | unknowns | wave numbers | kernels read | systems | multiplications | time |\n\
         |---|---|---|---|---|---|---|"
    );
    let plans: Vec<Plan> = rows.iter().map(|(_, scene)| plan(scene)).collect();
    let mut solves: Vec<_> = rows.iter().map(|(_, scene)| || drop(black_box(solve(scene)))).collect();
    let times = shortest(&mut solves);
    let mut points: Vec<(f64, [f64; 6])> = Vec::new();
    for (((x, _), plan), time) in rows.iter().zip(&plans).zip(&times) {
        let [unknowns, waves, kernels, systems, operations] = counts(plan);
        points.push((*x, [unknowns, waves, kernels, systems, operations, *time]));
        println!(
            "| {x} | {unknowns} | {waves} | {} | {systems} | {} | {:.2} |",
            thousands(kernels),
            thousands(operations),
            time / times[0]
        );
    }
    points.retain(|(x, _)| fitted(*x));
    let exponent = |column: usize| {
        let points: Vec<_> = points.iter().map(|(x, y)| (*x, y[column])).collect();
        format!("{:.2}", slope(&points))
    };
    println!("| *exponent* | {} |", (0..6).map(exponent).collect::<Vec<_>>().join(" | "));
}

fn counts(plan: &Plan) -> [f64; 5] {
    [
        plan.unknowns as f64,
        plan.flexibility_evaluations as f64,
        plan.kernel_evaluations as f64,
        plan.factorisations as f64,
        plan.operations as f64,
    ]
}

/// The plan of a scene's solution; says so where it did not converge.
fn plan(scene: &Scene) -> Plan {
    let solution = solve(scene);
    if solution.status != Status::Converged {
        println!("| ({:?}: {}) |", solution.status, solution.reason.unwrap_or_default());
    }
    solution.plan
}

/// Shortest time of each run in seconds. They take turns, so that what else the machine does falls on all of them.
fn shortest(runs: &mut [impl FnMut()]) -> Vec<f64> {
    let mut shortest = vec![Duration::MAX; runs.len()];
    let mut spent = vec![Duration::ZERO; runs.len()];
    for _ in 0..ROUNDS {
        for ((run, shortest), spent) in runs.iter_mut().zip(&mut shortest).zip(&mut spent) {
            if *spent < LONGEST {
                let start = Instant::now();
                run();
                let time = start.elapsed();
                *spent += time;
                *shortest = time.min(*shortest);
            }
        }
    }
    shortest.iter().map(Duration::as_secs_f64).collect()
}

/// The exponent of the power law nearest to some points, by logarithms.
fn slope(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / count;
    let (x, y) = (mean(&|p| p.0.ln()), mean(&|p| p.1.ln()));
    mean(&|p| (p.0.ln() - x) * (p.1.ln() - y)) / mean(&|p| (p.0.ln() - x).powi(2))
}

/// A large count in thousands.
fn thousands(count: f64) -> String {
    if count < 1e4 { format!("{count}") } else { format!("{:.3} M", count / 1e6) }
}
