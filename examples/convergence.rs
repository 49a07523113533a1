//! Error against work for every quadrature and kernel strategy, as Markdown tables: the ones in `docs/methods.md`.
//!
//! A flat punch with friction on layers that soften towards the base (`mu1/mu3 = 8`), from thick to thin, each method's
//! resolution pinned by the scene. Errors are relative differences from another quadrature: `de-sinc` and
//! `gauss-chebyshev` are held against `graded-panels` at the tolerance 1e-13, `graded-panels` against `de-sinc` with
//! 160 steps. `cargo run --release --example convergence` takes `h/b = 5`, and other thicknesses after `--`; the page
//! has `20 5 1 0.2 0.05`.

use slipzone::engine::{Solution, Status, solve};
use slipzone::scene::parse;

/// Thickness over half-width, unless others are given.
const THICKNESSES: [f64; 1] = [5.0];
/// A kernel that is good to more digits than any pinned quadrature here.
const SPLIT: &str = "tolerance = 1e-11\n";
const PANELS: &str = "tolerance = 1e-13\nquadrature = { type = \"graded-panels\" }";
const STEPS: &str = "tolerance = 1e-13\nquadrature = { type = \"de-sinc\", n = 160 }";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let given = std::env::args().skip(1).map(|h| h.parse()).collect::<Result<Vec<f64>, _>>()?;
    for h in if given.is_empty() { THICKNESSES.to_vec() } else { given } {
        let (panels, steps) = (solved(h, PANELS)?, solved(h, STEPS)?);
        println!("\n### h/b = {h}\n\nThe two references differ by {}.", differences(&panels, &steps).join(", "));
        let de_sinc = [8, 11, 16, 22, 32, 45, 64, 90];
        table(h, &panels, "de-sinc", de_sinc.map(|n| (format!("n = {n}"), pinned("de-sinc", &format!("n = {n}")))))?;
        let graded = [(6, 3), (8, 4), (10, 5), (12, 6), (15, 7)];
        let graded = graded.map(|(nodes, panels)| {
            let keys = format!("nodes = {nodes}, panels = {panels}");
            (format!("{nodes} x {panels}"), pinned("graded-panels", &keys))
        });
        table(h, &steps, "graded-panels", graded)?;
        let chebyshev = [16, 32, 64, 128, 256];
        let chebyshev = chebyshev.map(|n| (format!("n = {n}"), pinned("gauss-chebyshev", &format!("n = {n}"))));
        table(h, &panels, "gauss-chebyshev", chebyshev)?;
        let cutoffs = [20, 40, 80, 160, 320];
        let cutoffs = cutoffs.map(|cutoff| {
            let kernel = format!("tolerance = 1e-11\nkernel = {{ type = \"truncated\", cutoff = {cutoff}.0 }}\n");
            (format!("cutoff = {cutoff}"), format!("{kernel}quadrature = {{ type = \"de-sinc\", n = 90 }}"))
        });
        table(h, &panels, "truncated", cutoffs)?;
        let tolerances = [1e-4, 1e-6, 1e-8, 1e-10, 1e-12].map(|tolerance| {
            let solver = format!("tolerance = {tolerance:e}\nquadrature = {{ type = \"de-sinc\", n = 90 }}");
            (format!("{tolerance:e}"), solver)
        });
        table(h, &panels, "split", tolerances)?;
    }
    Ok(())
}

/// A quadrature's resolution, written into a scene.
fn pinned(quadrature: &str, keys: &str) -> String {
    format!("{SPLIT}quadrature = {{ type = \"{quadrature}\", {keys} }}")
}

/// One method's table: what was pinned, the work, and the errors.
fn table<const N: usize>(
    h: f64,
    reference: &Solution,
    method: &str,
    rows: [(String, String); N],
) -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "\n| `{method}` | unknowns | wave numbers | edge ratio | p(0) | indentation | a/b |\n|---|---|---|---|---|---|---|"
    );
    for (label, solver) in rows {
        let solution = solved(h, &solver)?;
        let errors = if solution.status == Status::Refused {
            vec![solution.reason.clone().unwrap_or_default()]
        } else {
            differences(&solution, reference)
        };
        let plan = &solution.plan;
        println!("| {label} | {} | {} | {} |", plan.unknowns, plan.flexibility_evaluations, errors.join(" | "));
    }
    Ok(())
}

fn solved(h: f64, solver: &str) -> Result<Solution, Box<dyn std::error::Error>> {
    let text = format!(
        "format = 1\n\
         layer = {{ thickness = {h:?}, poisson = 0.3, grading = {{ type = \"exponential\", surface = 1.0, base = 0.125 }} }}\n\
         punch = {{ type = \"flat\", half_width = 1.0 }}\nfriction = {{ type = \"goodman\", coefficient = 0.3 }}\n\
         load = {{ force = 1.0 }}\n[solver]\n{solver}\n"
    );
    Ok(solve(&parse("convergence", &text)?))
}

/// Relative differences of the numbers tabulated; a dash where there is none to compare.
fn differences(one: &Solution, other: &Solution) -> Vec<String> {
    let numbers = |solution: &Solution| {
        let stick = solution.stick.as_ref().and_then(|stick| stick.ratio);
        [solution.edge.ratio, solution.pressure.centre, solution.load.indentation, stick]
    };
    let pairs = numbers(one).into_iter().zip(numbers(other));
    let difference = |(a, b): (Option<f64>, Option<f64>)| Some((a? / b? - 1.0).abs());
    pairs.map(|pair| difference(pair).map_or("-".into(), |error| format!("{error:.0e}"))).collect()
}
