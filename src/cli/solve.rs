//! `slipzone solve`: one scene, one result.

use super::args::Solve;
use super::input::{self, is_dash};
use super::output::{self, Target};
use super::{Failure, Outcome, print};
use slipzone::engine::{self, Solution, Status};
use slipzone::report;
#[cfg(feature = "plot")]
use slipzone::report::FigureError;

/// A way of writing a solution to a file; `None` when there is nothing to write.
type Writer = fn(&Solution) -> Option<String>;

pub(super) fn run(arguments: &Solve) -> Result<Outcome, Failure> {
    let outputs = [
        ("--json", &arguments.json, (|solution| Some(report::json(solution))) as Writer),
        ("--csv", &arguments.csv, |solution| Some(report::csv(solution))),
        #[cfg(feature = "plot")]
        ("--svg", &arguments.svg, figure),
    ];
    let to_stdout = arguments.json.as_deref().is_some_and(is_dash);
    let files: Vec<_> = outputs
        .into_iter()
        .filter_map(|(option, path, writer)| Some((option, path.as_deref()?, writer)))
        .filter(|(option, path, _)| !(*option == "--json" && is_dash(path)))
        .collect();
    for (option, path, _) in &files {
        if is_dash(path) {
            let hint = "only `--json -` prints; a file called `-` is `./-`";
            return Err(Failure::Usage(format!("{option} needs the name of a file"), Some(hint.into())));
        }
    }
    output::distinct(&arguments.scene, &files.iter().map(|(option, path, _)| (*option, *path)).collect::<Vec<_>>())?;

    let scene = input::scene(&arguments.scene)?;
    let targets = files.iter().map(|(_, path, writer)| Ok((Target::new(path)?, *writer)));
    let targets = targets.collect::<Result<Vec<_>, Failure>>()?;

    let solution = engine::solve(&scene);
    let texts = targets.into_iter().filter_map(|(target, writer)| Some((target, writer(&solution)?)));
    output::write(&texts.collect::<Vec<_>>())?;
    if solution.status != Status::Converged {
        print::note(solution.reason.as_deref().unwrap_or("the result did not converge"));
    }
    print::result(&if to_stdout { report::json(&solution) } else { report::text(&solution) })?;
    Ok(if solution.status == Status::Converged { Outcome::Done } else { Outcome::NotConverged })
}

#[cfg(feature = "plot")]
fn figure(solution: &Solution) -> Option<String> {
    let told = |error| match error {
        // The reason is told with the status.
        FigureError::Refused(_) => print::note("no figure was drawn: the scene was refused"),
        other => print::note(&format!("no figure was drawn: {other}")),
    };
    report::svg(solution).map_err(told).ok()
}
