//! One contact by every method.

use super::{Cell, Ended};
use crate::caught::caught;
use crate::chart::method::{table, with_middle};
use crate::chart::{Errors, Measured, Method};
use crate::engine::{BUDGET, Solution, Status, first_not_finite, solve_within};
use crate::scene::parse;
use slipzone_api::Family;

/// What is asked of the program's own choice; the other methods stand at the middle of what makes sense for their knob.
const TOLERANCE: f64 = 1e-8;
/// Solvers that judge: at a tolerance beyond that, by unrelated quadratures.
const JUDGES: [(&str, &str); 2] = [
    ("de-sinc", "tolerance = 1e-10\nkernel = { type = \"split\" }\nquadrature = { type = \"de-sinc\" }\n"),
    ("graded-panels", "tolerance = 1e-10\nkernel = { type = \"split\" }\nquadrature = { type = \"graded-panels\" }\n"),
];
/// Numbers are wanted, tractions are not.
const NUMBERS: &str = "[output]\nquantities = [\"load\", \"edge\", \"stick\"]\n";
/// A number of which a judge claims no less an error than this is not judged.
const CREDIBLE: f64 = 1e-4;

/// Work that a cell may take: a twentieth of what a scene may, half a second or so. Beyond it a method is refused, with
/// that reason.
const ENOUGH: u64 = BUDGET / 20;

/// A way to solve: its name, its quadrature, its lines of `[solver]`.
struct Way {
    name: String,
    quadrature: Option<&'static str>,
    solver: String,
}

/// What the program chooses; each quadrature with each kernel strategy; the published route.
fn ways() -> Vec<Way> {
    let way = |method: Method| {
        let lines = method.quadrature.zip(method.kernel).map(|(quadrature, kernel)| {
            let (quadrature, kernel) =
                (with_middle(Family::Quadrature, quadrature), table(Family::Kernel, kernel, None));
            format!("quadrature = {quadrature}\nkernel = {kernel}\n")
        });
        let solver = format!("tolerance = {TOLERANCE:e}\n{}", lines.unwrap_or_default());
        Way { name: method.name(), quadrature: method.quadrature, solver }
    };
    let published = Way {
        name: "the published route".into(),
        quadrature: Some("gauss-chebyshev"),
        solver: format!(
            "tolerance = {TOLERANCE:e}\nflexibility = {{ type = \"transfer-matrix\" }}\nkernel = {}\nquadrature = {}\n",
            with_middle(Family::Kernel, "truncated"),
            with_middle(Family::Quadrature, "gauss-chebyshev")
        ),
    };
    Method::all().into_iter().map(way).chain([published]).collect()
}

pub(super) fn names() -> Vec<(String, bool)> {
    ways().into_iter().map(|way| (way.name, way.quadrature.is_none())).collect()
}

/// A cell for each way.
pub(super) fn cells(scene: &str) -> Vec<Cell> {
    let judges = JUDGES.map(|(_, solver)| attempt(scene, solver).ok());
    let cell = |way: Way| {
        let solution = match attempt(scene, &way.solver) {
            Ok(solution) => solution,
            Err(cell) => return *cell,
        };
        // What the program chooses is by the first judge's quadrature.
        let index = usize::from(way.quadrature.is_none_or(|quadrature| quadrature == JUDGES[0].0));
        let ended = if solution.status == Status::Converged { Ended::Converged } else { Ended::Flagged };
        let reason = solution.reason.clone();
        let (claimed, digits, wrong) = match &judges[index] {
            Some(judge) => {
                let (errors, claimed) = (Errors::between(&solution, judge), Errors::claimed(&solution));
                let doubt = Errors::claimed(judge);
                let judged = |measured: &Measured| doubt.of(*measured).is_some_and(|doubt| doubt <= CREDIBLE);
                let off = |measured: Measured| {
                    let claims = claimed.of(measured).unwrap_or(0.0) + doubt.of(measured).unwrap_or(0.0);
                    errors.of(measured).is_some_and(|error| error > 3.0 * claims + 1e-14)
                };
                let judged = Measured::ALL.into_iter().filter(judged);
                let is_wrong = judged.clone().any(off);
                let worst = judged.filter_map(|measured| errors.of(measured)).reduce(f64::max);
                let digits = worst.map(|error| -error.clamp(1e-16, 1.0).log10());
                (claimed.worst(), digits, ended == Ended::Converged && is_wrong)
            }
            None => (Errors::claimed(&solution).worst(), None, false),
        };
        Cell { ended, wrong, digits, claimed, reason }
    };
    ways().into_iter().map(cell).collect()
}

fn attempt(scene: &str, solver: &str) -> Result<Solution, Box<Cell>> {
    let lost = |ended, reason: String| Box::new(Cell::lost(ended, reason));
    let scene = parse("atlas", &format!("{scene}{NUMBERS}[solver]\n{solver}"))
        .map_err(|error| lost(Ended::Refused, error.to_string()))?;
    let solution = caught(|| solve_within(&scene, ENOUGH)).map_err(|why| lost(Ended::Panicked, why))?;
    if let Some(what) = first_not_finite(&solution) {
        return Err(lost(Ended::NotFinite, what));
    }
    if solution.status == Status::Refused {
        return Err(lost(Ended::Refused, solution.reason.unwrap_or_default()));
    }
    Ok(solution)
}
