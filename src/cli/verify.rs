//! `slipzone verify`: is this program right?

use super::args::Verify;
use super::named::named;
use super::{Failure, Outcome, print, progress};
use crate::api::exactly;
use crate::verify::{self, Check, GROUPS, Measure, Report, Value};
use std::fmt::{self, Write};

pub(super) fn run(arguments: &Verify) -> Result<Outcome, Failure> {
    let groups = named("group of checks", &arguments.groups, GROUPS, |group| group.name)?;
    let bar = progress::bar(1, "cases");
    let report = verify::run(&groups, &|all| {
        bar.set_length(all as u64);
        bar.inc(1);
    });
    bar.finish_and_clear();
    let mut text = String::new();
    // Writing to a string does not fail.
    let _ = if arguments.json {
        let json = serde_json::to_string_pretty(&report);
        text = json.map_err(|error| Failure::System(format!("cannot write the report: {error}")))?;
        Ok(())
    } else {
        page(&mut text, &report, arguments.all)
    };
    print::result(&text)?;
    Ok(outcome(&report))
}

/// How the run ends.
fn outcome(report: &Report) -> Outcome {
    if report.passed { Outcome::Done } else { Outcome::Failed }
}

/// Every check or the failed ones, then the groups in numbers, then the verdict.
fn page(text: &mut String, report: &Report, all: bool) -> fmt::Result {
    for check in report.checks.iter().filter(|check| all || !check.passed) {
        row(text, check)?;
    }
    let width = report.groups.iter().map(|group| group.name.len()).max().unwrap_or(0);
    writeln!(text, "{:width$}  passed  failed  what", "group")?;
    for group in &report.groups {
        writeln!(text, "{:width$}  {:6}  {:6}  {}", group.name, group.passed, group.failed, group.about)?;
    }
    let (count, failed) = (report.checks.len(), report.failures().count());
    match (report.passed, failed) {
        (true, _) => writeln!(text, "\nAll {count} checks passed."),
        (false, 0) => writeln!(text, "\nFAILED: a group checked nothing."),
        (false, _) => writeln!(text, "\nFAILED: {failed} of {count} checks."),
    }
}

/// A check in full.
fn row(text: &mut String, check: &Check) -> fmt::Result {
    let verdict = if check.passed { "ok  " } else { "FAIL" };
    writeln!(text, "{verdict} [{}] {}", check.group, check.name)?;
    if let Some(note) = &check.note {
        return writeln!(text, "     {note}\n");
    }
    let measure = match check.measure {
        Measure::Relative => "relative error",
        Measure::Absolute => "error",
        Measure::AtMost => "too large by",
        Measure::Same => "differs",
    };
    let error = check.error.map_or("not a number".into(), |error| format!("{error:.1e}"));
    let expected = if check.measure == Measure::AtMost { "at most" } else { "expected" };
    writeln!(text, "     computed {}, {expected} {}", value(&check.computed), value(&check.expected))?;
    writeln!(text, "     {measure} {error}, allowed {:.1e}: {}", check.tolerance, check.reason)?;
    writeln!(text, "     expected value from: {}\n", check.source)
}

fn value(value: &Value) -> String {
    match value {
        Value::Number(number) => exactly(*number),
        Value::Word(word) => word.clone(),
        Value::Missing => "nothing".into(),
    }
}

#[cfg(test)]
mod tests;
