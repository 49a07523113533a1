//! Many different scenes on one thread and on two, against plain arithmetic in as many tasks.
//!
//! Prints how well a batch uses a second core, in terms of what the machine gives to anything at all at that moment,
//! and checks that every solution has the same bits on one thread, on two, and alone. Run it on a machine that is
//! otherwise idle: `cargo run --release --example batch -- 10000`; without a number it takes 200 scenes.

use rayon::prelude::*;
use slipzone::engine::{Solution, Status, solve, solve_all};
use slipzone::scene::{Scene, parse};
use std::hint::black_box;
use std::time::{Duration, Instant};

/// Runs of each kind, taken in turns; the shortest counts.
const ROUNDS: usize = 3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let count = std::env::args().nth(1).map_or(Ok(200), |count| count.parse())?;
    let scenes = (0..count).map(|i| scene(i, count)).collect::<Result<Vec<_>, _>>()?;
    let alone: Vec<String> = scenes.iter().map(|scene| bits(&solve(scene))).collect();
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let two = rayon::ThreadPoolBuilder::new().num_threads(2).build()?;

    // Arithmetic that takes about as long per task.
    let turns = per_task(&scenes);
    let arithmetic = || (0..count).into_par_iter().map(|_| spin(turns)).sum::<f64>();

    let mut shortest = [Duration::MAX; 4];
    for _ in 0..ROUNDS {
        let (of_one, solved_by_one) = timed(|| one.install(|| solve_all(&scenes)));
        let (of_two, solved_by_two) = timed(|| two.install(|| solve_all(&scenes)));
        let (plain_of_one, _) = timed(|| one.install(arithmetic));
        let (plain_of_two, _) = timed(|| two.install(arithmetic));
        for (least, time) in shortest.iter_mut().zip([of_one, of_two, plain_of_one, plain_of_two]) {
            *least = time.min(*least);
        }
        for solved in [solved_by_one, solved_by_two] {
            assert!(solved.iter().map(bits).eq(alone.iter().cloned()), "the same bits however they were solved");
            let failed = solved.iter().find(|solution| solution.status != Status::Converged);
            assert!(failed.is_none(), "{:?}", failed.map(|solution| &solution.reason));
        }
    }
    let [of_one, of_two, plain_of_one, plain_of_two] = shortest.map(|time| time.as_secs_f64());
    let (gain, plain) = (of_one / of_two, plain_of_one / plain_of_two);
    println!(
        "{count} scenes, {:.0} a second on one thread, bits equal on one, on two and alone",
        count as f64 / of_one
    );
    println!("two threads: {gain:.2} times as fast; plain arithmetic {plain:.2} times; ratio {:.2}", gain / plain);
    Ok(())
}

/// Scene `i`: layers thick and thin, stiffening and softening, every fourth contact with friction.
fn scene(i: usize, count: usize) -> Result<Scene, Box<dyn std::error::Error>> {
    let share = i as f64 / count as f64;
    // Fractions of multiples of irrational numbers: no two scenes alike, no order in them.
    let other = (i as f64 * std::f64::consts::SQRT_2).fract();
    let (thickness, base) = (2.0 + 8.0 * other, 8.0_f64.powf(2.0 * share - 1.0));
    let friction = if i.is_multiple_of(4) { "friction = { type = \"goodman\", coefficient = 0.3 }" } else { "" };
    let text = format!(
        "format = 1\n{friction}\n\
         layer = {{ thickness = {thickness:?}, poisson = 0.3, grading = {{ type = \"exponential\", surface = 1.0, base = {base:?} }} }}\n\
         punch = {{ type = \"flat\", half_width = 1.0 }}\nload = {{ force = 1.0 }}\noutput = {{ points = 3 }}\n"
    );
    Ok(parse("batch", &text)?)
}

/// Every number of a solution, so that different bits are different texts.
fn bits(solution: &Solution) -> String {
    format!("{:?} {:?} {:?} {:?} {:?}", solution.load, solution.pressure, solution.edge, solution.stick, solution.error)
}

/// Turns of [`spin`] that take as long as a scene on average, give or take what the machine does meanwhile.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // a positive count
fn per_task(scenes: &[Scene]) -> usize {
    let sample = &scenes[..scenes.len().min(100)];
    let (solving, _) = timed(|| sample.iter().map(solve).collect::<Vec<_>>());
    let (spinning, _) = timed(|| black_box(spin(1_000_000)));
    (1e6 * solving.as_secs_f64() / sample.len() as f64 / spinning.as_secs_f64()) as usize
}

/// Arithmetic that touches no memory.
fn spin(turns: usize) -> f64 {
    (0..turns).fold(black_box(0.5), |x: f64, _| 3.7 * x * (1.0 - x))
}

fn timed<T>(run: impl FnOnce() -> T) -> (Duration, T) {
    let start = Instant::now();
    let result = run();
    (start.elapsed(), result)
}
