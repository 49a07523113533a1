//! `slipzone sweep`: all scenes of a study.

use super::args::Sweep;
use super::input::{self, is_dash};
use super::journal::Journal;
use super::output::{self, Target};
use super::{Failure, Outcome, interrupt, print, progress};
use crate::report::{self, StudyTable};
use crate::study::{Study, sweep};
use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

/// Names in the folder of the results.
const TABLE: &str = "results.csv";
const LINES: &str = "results.jsonl";
const JOURNAL: &str = "journal.jsonl";

/// Scenes that failed and are named on the terminal.
const NAMED: usize = 10;

pub(super) fn run(arguments: &Sweep) -> Result<Outcome, Failure> {
    if let Some(out) = &arguments.out {
        output::named("--out", out, "a folder called `-` is `./-`")?;
    }
    let (mut study, mut read) = input::study(&arguments.study)?;
    read.push(arguments.study.clone());
    let folder = arguments.out.clone().unwrap_or_else(|| default_folder(&arguments.study));
    output::make_folder(&folder)?;
    let mut names = vec![TABLE, LINES, JOURNAL];
    names.extend(study.plots.iter().filter(|_| cfg!(feature = "plot")).map(|plot| plot.file.as_str()));
    let written: Vec<_> = names.iter().map(|name| folder.join(name)).collect();
    let outputs: Vec<_> = names.into_iter().zip(written.iter().map(PathBuf::as_path)).collect();
    output::spared("study", &read, &outputs, "name another folder with --out")?;
    output::apart(&outputs)?;
    let table = Target::new(&folder.join(TABLE))?;
    let lines = Target::new(&folder.join(LINES))?;
    #[cfg(feature = "plot")]
    let figures =
        study.plots.iter().map(|plot| Target::new(&folder.join(&plot.file))).collect::<Result<Vec<_>, _>>()?;
    if study.scene.path.is_some() {
        print::note(
            "the scenes of a study are solved under their last load only: the loads on the way are those of `slipzone solve`",
        );
    }
    let mut journal = Journal::open(&folder.join(JOURNAL), &mut study, arguments.fresh)?;
    if arguments.fresh {
        discard(written.iter().filter(|path| !path.ends_with(JOURNAL)))?;
    }
    solve(&study, &mut journal, &folder)?;
    write_results(&study, &journal, &table, &lines)?;
    #[cfg_attr(not(feature = "plot"), allow(unused_mut))]
    let mut results = vec![TABLE, LINES];
    #[cfg(feature = "plot")]
    results.extend(draw(&study, &journal, &folder, figures)?);
    let failed = journal.tally().failed;
    print::result(&summary(&study, &folder, &results, failed))?;
    Ok(if failed == 0 { Outcome::Done } else { Outcome::Failed })
}

/// Removes results that belong to no journal any more; links and devices stay.
fn discard<'a>(mut results: impl Iterator<Item = &'a PathBuf>) -> Result<(), Failure> {
    results.try_for_each(|path| match fs::symlink_metadata(path) {
        Ok(found) if found.is_file() => {
            fs::remove_file(path).map_err(|error| Failure::System(format!("cannot remove {}: {error}", path.display())))
        }
        _ => Ok(()),
    })
}

/// Beside where it is called from, named after the study.
fn default_folder(study: &Path) -> PathBuf {
    let stem = if is_dash(study) { None } else { study.file_stem() };
    let mut name = stem.unwrap_or("study".as_ref()).to_os_string();
    name.push(".results");
    name.into()
}

/// Solves what is missing in the journal.
fn solve(study: &Study, journal: &mut Journal, folder: &Path) -> Result<(), Failure> {
    let rows = study.rows();
    let before = journal.tally().count();
    if before > 0 && before < rows {
        print::note(&format!("going on: {before} of {rows} scenes are in {} already", folder.display()));
    }
    if before == rows {
        return Ok(());
    }
    let finished = Arc::new(AtomicU64::new(before));
    let seen = Arc::clone(&finished);
    let shown = folder.display().to_string();
    interrupt::say(move || {
        let finished = seen.load(Ordering::Relaxed);
        format!("interrupted: {finished} of {rows} scenes are safe in {shown}; the same command goes on from there")
    });
    let bar = progress::bar(rows, "scenes").with_position(before);
    bar.reset_eta();
    let done = journal.tally().clone();
    let mut failure = None;
    let mut named = 0;
    sweep(study, &|row| done.has(row), |record| {
        if let Err(error) = journal.append(&record) {
            failure = Some(error);
            return ControlFlow::Break(());
        }
        finished.fetch_add(1, Ordering::Relaxed);
        bar.inc(1);
        if !record.is_converged() && named <= NAMED {
            let line = if named < NAMED {
                report::record_line(&record)
            } else {
                "scenes that fail from now on are not named here".into()
            };
            named += 1;
            bar.suspend(|| print::note(&line));
        }
        ControlFlow::Continue(())
    });
    bar.finish_and_clear();
    interrupt::be_silent();
    match failure {
        None => Ok(()),
        Some(Failure::System(why)) => {
            let count = journal.tally().count();
            Err(Failure::System(format!(
                "{why}; {count} of {rows} scenes are safe, the same command goes on from there"
            )))
        }
        Some(other) => Err(other),
    }
}

/// The records in the order of the study, as a table and as JSON lines: both or neither.
fn write_results(study: &Study, journal: &Journal, table: &Target, lines: &Target) -> Result<(), Failure> {
    let columns = StudyTable::new(study);
    let (mut csv, mut jsonl) = (table.begin()?, lines.begin()?);
    csv.write(columns.head().as_bytes())?;
    let mut records = journal.in_order().map_err(of_journal)?;
    while let Some(line) = records.next_line().map_err(of_journal)? {
        let record = serde_json::from_slice(&line).map_err(|error| of_journal(error.into()))?;
        csv.write(columns.row(&record).as_bytes())?;
        jsonl.write(&line)?;
    }
    let (csv, jsonl) = (csv.finished()?, jsonl.finished()?);
    csv.keep()?;
    jsonl.keep()
}

/// The figures that the study asks for, and the names of those that were drawn; one that cannot be drawn is a note.
#[cfg(feature = "plot")]
fn draw<'a>(study: &'a Study, journal: &Journal, folder: &Path, figures: Vec<Target>) -> Result<Vec<&'a str>, Failure> {
    let (mut drawn, mut names) = (Vec::new(), Vec::new());
    for (target, plot) in figures.into_iter().zip(&study.plots) {
        let mut lines = journal.in_order().map_err(of_journal)?;
        let mut failure = None;
        let records = std::iter::from_fn(|| {
            let record = lines.next_line().and_then(|line| Ok(line.map(|l| serde_json::from_slice(&l)).transpose()?));
            record.unwrap_or_else(|error| {
                failure = Some(error);
                None
            })
        });
        let figure = report::study_svg(study, plot, records);
        if let Some(error) = failure {
            return Err(of_journal(error));
        }
        match figure {
            Ok(figure) => {
                if let Some(left_out) = figure.left_out {
                    print::note(&format!("{}: {left_out}", plot.file));
                }
                drawn.push((target, figure.svg));
                names.push(plot.file.as_str());
            }
            Err(error) => {
                print::note(&format!("{} was not drawn: {error}", plot.file));
                // An old one in its place would show other results.
                discard(std::iter::once(&folder.join(&plot.file)))?;
            }
        }
    }
    output::write(&drawn)?;
    Ok(names)
}

#[allow(clippy::needless_pass_by_value)] // as `map_err` wants it
fn of_journal(error: std::io::Error) -> Failure {
    Failure::System(format!("cannot read the journal: {error}"))
}

fn summary(study: &Study, folder: &Path, results: &[&str], failed: u64) -> String {
    let rows = study.rows();
    let title = study.title.as_ref().map_or(String::new(), |title| format!("{title}: "));
    let failures = match failed {
        0 => "all converged".to_owned(),
        1 => "1 without a converged result (its `reason` is in the results)".to_owned(),
        _ => format!("{failed} without a converged result (their `reason` is in the results)"),
    };
    let scenes = if rows == 1 { "scene" } else { "scenes" };
    format!("{title}{rows} {scenes}, {failures}\n{}: {}\n", folder.display(), results.join(", "))
}
