//! Solves a scene through the library: parse it, solve it, read the result with its error estimates.
//!
//! The scene is one of Chen and Chen (2013), Table 1: a flat punch on a layer, five half-widths thick,
//! that is eight times as stiff at its base. `edge.ratio` is the table's `F_I/F_0`.
//!
//! Run it with `cargo run --example solve_scene`.

use slipzone::engine::{Status, solve};
use slipzone::scene::parse;

const SCENE: &str = r#"
format = 1

[layer]
thickness = 5.0
poisson = 0.3
grading = { type = "exponential", surface = 1.0, base = 8.0 }

[punch]
type = "flat"
half_width = 1.0

[friction]
type = "goodman"
coefficient = 0.3

[load]
force = 1.0
"#;

/// `edge.ratio` and `stick.ratio` of this scene by an independent program (`tests/data/layer_cases.json`), and half
/// a unit of their last digit.
const REFERENCE: [(&str, f64, f64); 2] =
    [("edge.ratio", 0.252_691_384_723, 0.5e-12), ("stick.ratio", 0.972_627_999_8, 0.5e-10)];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The name is what an error would call the text, line and column after it.
    let scene = parse("solve_scene", SCENE)?;

    // A solve never fails: what went wrong, if anything, is in the solution.
    let solution = solve(&scene);
    if solution.status != Status::Converged {
        return Err(solution.reason.unwrap_or_default().into());
    }
    let stick = solution.stick.ok_or("friction, but no stick zone")?;

    let error_of = |path: &str| solution.error.each[path];
    let line = |what: &str, value: Option<f64>, path: &str| {
        // Each number is there because the solution converged; on a half-plane `indentation` would be `None`.
        println!("{what:24} {:<12.10} +- {:.0e} of it", value.unwrap_or(f64::NAN), error_of(path));
    };
    line("contact half-width b", solution.load.half_width, "load.half_width");
    line("indentation", solution.load.indentation, "load.indentation");
    line("edge factor, F_I/F_0", solution.edge.ratio, "edge.ratio");
    line("stick zone a/b", stick.ratio, "stick.ratio");
    println!("beside it the surface slips {:?}", stick.slip.ok_or("a direction of slip")?);
    println!(
        "{} unknowns, {} flexibility evaluations, {} factorisations",
        solution.plan.unknowns, solution.plan.flexibility_evaluations, solution.plan.factorisations
    );

    for ((path, reference, digits), value) in REFERENCE.into_iter().zip([solution.edge.ratio, stick.ratio]) {
        let error = (value.ok_or("a number of a converged solution")? / reference - 1.0).abs();
        let known = digits / reference;
        assert!(error <= error_of(path) + known, "{path} is off by {error:.1e}, more than estimated");
        assert!(error <= scene.solver.tolerance.get(), "{path} is off by {error:.1e}, more than asked for");
    }
    Ok(())
}
