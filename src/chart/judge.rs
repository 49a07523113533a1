//! What runs are judged by: two solutions by unrelated discretisations.

use super::{Charted, Errors, Method};
use crate::engine::{Solution, solve};

/// Where tractions are compared: Chebyshev's points, which crowd where tractions are steep, and the middle.
const POINTS: usize = 33;

/// A solution finer than anything charted, and the quadrature that it is by.
#[derive(Clone, Debug)]
pub struct Judge {
    /// Its quadrature.
    pub quadrature: &'static str,
    /// What it found.
    pub solution: Solution,
}

/// Both: double-exponential sinc functions of the whole contact, and polynomials on panels that shrink towards its
/// ends. The first takes the flexibility that serves every layer and lets the kernel's series begin where it chooses,
/// the second has it begin elsewhere, where it can. Coarser ones follow for contacts that grow: they are many contacts
/// in one, and the first would exceed the budget of work.
const JUDGES: [(&str, &[&str]); 2] = [
    (
        "de-sinc",
        &[
            "quadrature = { type = \"de-sinc\", n = 192 }\nkernel = { type = \"split\" }\nflexibility = { type = \"compliance\" }\n",
            "quadrature = { type = \"de-sinc\", n = 96 }\nkernel = { type = \"split\" }\nflexibility = { type = \"compliance\" }\n",
        ],
    ),
    (
        "graded-panels",
        &[
            "quadrature = { type = \"graded-panels\", nodes = 16, panels = 24 }\nkernel = { type = \"split\", cutoff = 40.0 }\n",
            "quadrature = { type = \"graded-panels\", nodes = 16, panels = 24 }\nkernel = { type = \"split\" }\n",
            "quadrature = { type = \"graded-panels\", nodes = 12, panels = 6 }\nkernel = { type = \"split\" }\n",
        ],
    ),
];

/// Lines of a scene that ask for the tractions to be compared.
pub(super) fn output() -> String {
    let step = std::f64::consts::PI / (POINTS + 1) as f64;
    let x: Vec<f64> = (1..=POINTS).rev().map(|i| (i as f64 * step).cos()).collect();
    // In the middle the cosine is a rounding error off 0.
    let x: Vec<String> = x.iter().map(|x| format!("{:.15}", if x.abs() < 1e-15 { 0.0 } else { *x })).collect();
    format!("[output]\nx = [{}]\n", x.join(", "))
}

/// The judges of a scene: the first attempt of each that tells six digits.
pub(super) fn pair(scene: &Charted) -> [Judge; 2] {
    JUDGES.map(|(quadrature, attempts)| {
        let attempt = |lines: &&str| {
            let scene = scene.parsed(&format!("[solver]\ntolerance = 1e-12\n{lines}{}", output()));
            solve(&scene.expect("a scene of the list, by methods of the program"))
        };
        let mut solutions = attempts.iter().map(attempt);
        let first = solutions.next().expect("at least one");
        let is_fine = |solution: &Solution| solution.error.estimate.is_some_and(|error| error < 1e-6);
        let solution = if is_fine(&first) { first } else { solutions.find(is_fine).unwrap_or(first) };
        Judge { quadrature, solution }
    })
}

/// How far they are apart.
pub(super) fn apart([one, other]: &[Judge; 2]) -> Errors {
    Errors::between(&one.solution, &other.solution)
}

/// The one that does not judge its own kind: what the program chooses by itself is by the first's quadrature, mostly.
pub(super) fn of<'j>(method: &Method, [one, other]: &'j [Judge; 2]) -> &'j Judge {
    match method.quadrature {
        Some(quadrature) if quadrature != one.quadrature => one,
        _ => other,
    }
}
