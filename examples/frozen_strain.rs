//! The stick zone of a cylinder by its history, and with the strain `C|x|` that Chen and Chen (2013, eq. 63) take for
//! it: the table of `docs/theory.md`.
//!
//! `cargo run --release --example frozen_strain`

use slipzone::engine::{Solution, solve};
use slipzone::scene;

fn main() {
    slipzone::link_plugins();
    println!("| mu1/mu3 | h/b | a/b by history | a/b linear | off by | u'/x at a/2 | u'/x at a | C |");
    println!("|---|---|---|---|---|---|---|---|");
    for (name, base) in [("1/8", 8.0), ("1", 1.0), ("8", 0.125)] {
        for thickness in [20.0, 10.0, 5.0, 2.0] {
            let grown = cylinder(thickness, base, "history", &[0.0]);
            let taken = cylinder(thickness, base, "linear", &[0.0]);
            let (a, a_taken) = (ratio(&grown), ratio(&taken));
            let at = cylinder(thickness, base, "history", &[0.5 * a, a * (1.0 - 1e-9)]);
            let strain = at.profile.strain.as_ref().expect("asked for");
            let rate = |i: usize| strain[i].expect("inside the stick zone") / at.profile.x[i];
            let c = taken.stick.as_ref().and_then(|stick| stick.strain_rate).unwrap_or(f64::NAN);
            println!(
                "| {name} | {thickness} | {a:.6} | {a_taken:.6} | {:+.1} % | {:.6} | {:.6} | {c:.6} |",
                100.0 * (a_taken / a - 1.0),
                rate(0),
                rate(1),
            );
        }
    }
}

/// A cylinder of radius 10 on a contact of half-width 1, `eta` = 0.3.
fn cylinder(thickness: f64, base: f64, strain: &str, x: &[f64]) -> Solution {
    let text = format!(
        "format = 1\n\
         layer = {{ thickness = {thickness}, poisson = 0.3, grading = {{ type = \"exponential\", surface = 1.0, base = {base} }} }}\n\
         punch = {{ type = \"cylinder\", radius = 10.0 }}\n\
         friction = {{ type = \"goodman\", coefficient = 0.3, strain = \"{strain}\" }}\n\
         load = {{ half_width = 1.0 }}\n\
         [solver]\ntolerance = 1e-6\n\
         [output]\nx = {x:?}\nstrain = true\n"
    );
    solve(&scene::parse("cylinder.toml", &text).expect("a scene"))
}

fn ratio(solution: &Solution) -> f64 {
    solution.stick.as_ref().and_then(|stick| stick.ratio).expect("a stick zone")
}
