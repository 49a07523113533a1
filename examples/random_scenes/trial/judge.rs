//! The same scene solved by other methods.

use super::{Case, Dice, agree, set};
use slipzone::api::{Family, plugins};
use slipzone::engine::{Solution, Status};
use toml::{Table, Value};

/// Finest tolerance that the other methods are asked for: theirs is the same double precision.
const FINEST: f64 = 1e-11;

/// Share of the scenes in which any methods are taken, among them the published ones: they cost a hundred times as much
/// and know fewer digits.
const PUBLISHED: f64 = 0.05;
/// Most work of the scenes in which these are taken.
const CHEAPEST: u64 = 100_000;
/// Most work of scenes that are all solved again.
const DEAREST: u64 = 1_000_000;

/// Whether other methods come to the same numbers: another quadrature, and where they serve another kernel strategy and
/// another flexibility, too; never a cheaper model.
pub(super) fn agrees(case: &Case, dice: &mut Dice) -> Result<bool, String> {
    let used = &case.found.plan;
    if used.work > DEAREST && !dice.chance(0.02) {
        return Ok(false);
    }
    let families = [
        (Family::Quadrature, "quadrature", &used.quadrature),
        (Family::Kernel, "kernel", &used.kernel),
        (Family::Flexibility, "flexibility", &used.flexibility),
    ];
    let others: Vec<Vec<&str>> = families
        .iter()
        .map(|(family, _, used)| {
            let others = plugins().into_iter().filter(|info| info.family == *family && info.name != **used);
            others.map(|info| info.name).collect()
        })
        .collect();
    // The more differs the better; but the published methods serve little.
    let mut tried: Vec<Vec<(&str, &str)>> = Vec::new();
    let pick = |dice: &mut Dice, index: usize| (families[index].1, *dice.one_of(&others[index]));
    if used.work < CHEAPEST && dice.chance(PUBLISHED) {
        tried.push((0..3).map(|index| pick(dice, index)).collect());
    }
    tried.push(vec![("quadrature", "graded-panels"), pick(dice, 2)]);
    tried.push(vec![("quadrature", if used.quadrature == "graded-panels" { "de-sinc" } else { "graded-panels" })]);
    let mut judged = false;
    for methods in tried {
        let Some(other) = case.other(|table| by(table, case, &methods)) else { continue };
        let judges = matches!(other.status, Status::Converged | Status::NotConverged) && is_sure(&other);
        if other.status == Status::AssumptionViolated {
            return Err(format!("converged, but by {methods:?}: {:?}", other.reason));
        }
        if judges {
            agree(&case.found, &other, |_| 1.0).map_err(|how| format!("by {methods:?}: {how}"))?;
            judged = true;
        }
    }
    Ok(judged)
}

/// Whether it knows its numbers to a few digits.
fn is_sure(other: &Solution) -> bool {
    other.error.estimate.is_some_and(|error| error < 1e-2)
}

fn by(table: &mut Table, case: &Case, methods: &[(&str, &str)]) {
    let tolerance = (0.1 * case.found.scene.solver.tolerance.get()).max(FINEST);
    table.remove("solver");
    set(table, &["solver", "tolerance"], tolerance);
    set(table, &["solver", "model"], "full");
    for (family, name) in methods {
        let mut method = Table::new();
        method.insert("type".into(), (*name).into());
        if *name == "truncated" || *name == "gauss-chebyshev" {
            // Slow to converge: a pinned one is judged by its own twin.
            set(table, &["solver", "tolerance"], tolerance.max(1e-6));
        }
        set(table, &["solver", family], Value::Table(method));
    }
}
