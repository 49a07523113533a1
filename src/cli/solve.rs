//! `slipzone solve`: one scene, one result.

use super::args::Solve;
use super::input::{self, is_dash};
use super::output::{self, Target};
use super::{Failure, Outcome, print};
use crate::engine::{self, Solution, Status};
use crate::report;
#[cfg(feature = "plot")]
use crate::report::FigureError;
use crate::scene::Scene;

/// A way of writing a solution to a file; `None` when there is nothing to write.
type Writer = fn(&Solution) -> Option<String>;

pub(super) fn run(arguments: &Solve) -> Result<Outcome, Failure> {
    let outputs = [
        ("--json", &arguments.json, (|solution| Some(report::json(solution))) as Writer),
        (CSV, &arguments.csv, |solution| Some(report::csv(solution))),
        #[cfg(feature = "plot")]
        (SVG, &arguments.svg, |solution| figure(report::svg(solution))),
        (CURVE_CSV, &arguments.curve_csv, |solution| Some(report::curve_csv(solution))),
        #[cfg(feature = "plot")]
        (CURVE_SVG, &arguments.curve_svg, |solution| figure(report::curve_svg(solution))),
    ];
    let to_stdout = arguments.json.as_deref().is_some_and(is_dash);
    let files: Vec<_> = outputs
        .into_iter()
        .filter_map(|(option, path, writer)| Some((option, path.as_deref()?, writer)))
        .filter(|(option, path, _)| !(*option == "--json" && is_dash(path)))
        .collect();
    for (option, path, _) in &files {
        output::named(option, path, "only `--json -` prints; a file called `-` is `./-`")?;
    }
    let named: Vec<_> = files.iter().map(|(option, path, _)| (*option, *path)).collect();
    output::distinct(&arguments.scene, &named)?;

    let (scene, read) = input::scene(&arguments.scene)?;
    output::spared("scene", &read, &named, "give the result a name of its own")?;
    files.iter().try_for_each(|(option, ..)| possible(option, &scene))?;
    let targets = files.iter().map(|(_, path, writer)| Ok((Target::new(path)?, *writer)));
    let targets = targets.collect::<Result<Vec<_>, Failure>>()?;

    let solution = engine::solve_caught(&scene);
    let texts = targets.into_iter().filter_map(|(target, writer)| Some((target, writer(&solution)?)));
    output::write(&texts.collect::<Vec<_>>())?;
    if solution.status != Status::Converged {
        print::note(solution.reason.as_deref().unwrap_or("the result did not converge"));
    }
    if let Some(note) = solution.path.as_ref().and_then(|curve| curve.note.as_deref()) {
        print::note(&format!("the loading curve: {note}"));
    }
    print::result(&if to_stdout { report::json(&solution) } else { report::text(&solution) })?;
    let of_curve = solution.path.as_ref().map(|curve| curve.status);
    let converged = [Some(solution.status), of_curve].into_iter().flatten().all(|status| status == Status::Converged);
    Ok(if converged { Outcome::Done } else { Outcome::Failed })
}

/// Options that ask for the tractions.
const CSV: &str = "--csv";
const SVG: &str = "--svg";
/// Options that ask for a loading curve.
const CURVE_CSV: &str = "--curve-csv";
const CURVE_SVG: &str = "--curve-svg";

/// Refuses a file for which the scene leaves nothing to write, before anything is solved.
fn possible(option: &str, scene: &Scene) -> Result<(), Failure> {
    let needed: &[&str] = match option {
        CURVE_CSV | CURVE_SVG if scene.path.is_none() => return Err(no_curve(option, scene)),
        CSV => &["profile"],
        // The axes of the figure are in half-widths and mean pressures.
        SVG => &["profile", "load.half_width", "pressure.mean"],
        _ => &[],
    };
    let missing: Vec<_> =
        needed.iter().filter(|path| !scene.output.asks(path)).map(|path| format!("`{path}`")).collect();
    if !missing.is_empty() {
        let missing = missing.join(", ");
        let message = format!("{option} needs {missing}, which the scene does not ask for");
        let hint = format!("in [output] of the scene, add {missing} to `quantities`, or leave that key out");
        return Err(Failure::Usage(message, Some(hint)));
    }
    let (through, hint) = match &scene.output.x {
        _ if option != SVG => return Ok(()),
        Some(x) if x.iter().all(|point| point.total_cmp(&x[0]).is_eq()) => {
            ("one point", "list more points in `x`, or write `points = 201` in its place")
        }
        // Pressures there are unbounded, or nothing.
        None if scene.output.points == 2 => ("the contact's two ends", "write `points = 201`, or leave it out"),
        _ => return Ok(()),
    };
    let message = format!("--svg draws no curve through {through}, and the scene asks for no more");
    Err(Failure::Usage(message, Some(format!("in [output] of the scene, {hint}"))))
}

/// A curve is asked for that the scene does not have.
fn no_curve(option: &str, scene: &Scene) -> Failure {
    let (key, value) = (scene.load.kind().key(), scene.load.value().get());
    let hint =
        format!("in [load] of the scene, write `until = {{ {key} = {value:?}, points = 60 }}` in place of `{key}`");
    Failure::Usage(format!("{option} needs a scene that asks for a loading curve"), Some(hint))
}

#[cfg(feature = "plot")]
pub(super) fn figure(drawn: Result<String, FigureError>) -> Option<String> {
    let told = |error| match error {
        // The reason is told with the status.
        FigureError::Refused(_) => print::note("no figure was drawn: the scene was refused"),
        other => print::note(&format!("no figure was drawn: {other}")),
    };
    drawn.map_err(told).ok()
}
