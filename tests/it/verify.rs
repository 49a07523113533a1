//! `slipzone verify` and the library behind it: all passes, and the report is what its documentation says.

use serde_json::Value;
use slipzone::verify::{GROUPS, Report, run};
use std::collections::BTreeSet;
use std::sync::LazyLock;

/// All groups, run once for the tests of this file.
static REPORT: LazyLock<Report> = LazyLock::new(|| run(&GROUPS.iter().collect::<Vec<_>>(), &|_| ()));

#[test]
fn every_check_passes() {
    assert!(REPORT.passed, "{:#?}", REPORT.failures().collect::<Vec<_>>());
    for group in &REPORT.groups {
        assert!(group.passed > 0, "{} checks nothing", group.name);
    }
}

#[test]
fn names_are_unique_and_nothing_is_left_unsaid() {
    let mut names = BTreeSet::new();
    for check in &REPORT.checks {
        assert!(names.insert(&check.name), "two checks are called {}", check.name);
        assert!(!check.reason.is_empty() && !check.source.is_empty(), "{check:?}");
        assert!(check.tolerance.is_finite() && check.tolerance >= 0.0, "{check:?}");
    }
    let groups: BTreeSet<_> = GROUPS.iter().map(|group| group.name).collect();
    assert_eq!(groups.len(), GROUPS.len());
}

/// A plugin of the methods' families takes part without being named anywhere.
#[test]
fn every_method_takes_part() {
    use slipzone::api::{Family, plugins};
    for info in plugins() {
        let is_method = matches!(info.family, Family::Flexibility | Family::Kernel | Family::Quadrature);
        let named = |name: &str| name.contains(info.name);
        assert!(!is_method || REPORT.checks.iter().any(|check| named(&check.name)), "{} is not checked", info.name);
    }
}

#[test]
fn the_same_numbers_in_the_same_order_again() {
    let some: Vec<_> = GROUPS.iter().filter(|group| ["half-plane", "asymptotes"].contains(&group.name)).collect();
    let again = run(&some, &|_| ());
    let before: Vec<_> =
        REPORT.checks.iter().filter(|check| some.iter().any(|group| group.name == check.group)).collect();
    assert_eq!(again.checks.iter().collect::<Vec<_>>(), before);
}

#[cfg(feature = "cli")]
mod on_the_command_line {
    use super::*;
    use crate::run::{folder, run, told};

    #[test]
    fn the_json_has_its_stable_keys() {
        let output = run(folder().path(), ["verify", "--json", "asymptotes"]);
        assert_eq!(output.status.code(), Some(0), "{}", told(&output));
        assert!(output.stderr.is_empty(), "progress is for terminals: {}", told(&output));
        let report: Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let keys = |value: &Value| value.as_object().expect("a table").keys().cloned().collect::<BTreeSet<_>>();
        let expected = |keys: &[&str]| keys.iter().map(|key| (*key).to_owned()).collect::<BTreeSet<_>>();
        assert_eq!(keys(&report), expected(&["format", "program", "passed", "groups", "checks"]));
        assert_eq!((&report["format"], &report["passed"]), (&1.into(), &true.into()));
        assert_eq!(report["program"]["name"], "slipzone");
        assert_eq!(keys(&report["groups"][0]), expected(&["name", "about", "passed", "failed"]));
        let of_a_check =
            ["group", "name", "computed", "expected", "measure", "error", "tolerance", "reason", "source", "passed"];
        for check in report["checks"].as_array().expect("a list") {
            assert_eq!(keys(check), expected(&of_a_check));
        }
    }

    #[test]
    fn the_page_has_a_line_for_each_group_and_a_verdict() {
        let output = run(folder().path(), ["verify", "asymptotes", "gradings"]);
        let page = String::from_utf8(output.stdout).expect("UTF-8");
        let lines: Vec<_> = page.lines().collect();
        assert_eq!(output.status.code(), Some(0), "{page}");
        assert_eq!(lines.len(), 5, "{page}");
        // In the order of the report, whatever that of the arguments.
        assert!(lines[1].starts_with("gradings") && lines[2].starts_with("asymptotes"), "{page}");
        assert!(lines[4].starts_with("All ") && lines[4].ends_with(" checks passed."), "{page}");
        let output = run(folder().path(), ["verify", "asymptotes", "--all"]);
        let page = String::from_utf8(output.stdout).expect("UTF-8");
        assert!(page.starts_with("ok   [asymptotes] "), "{page}");
        assert!(page.contains("expected value from: 4 exp(-pi beta/(2 eta)), Spence (1968)"), "{page}");
    }

    #[test]
    fn an_unknown_group_gets_the_nearest_name() {
        let output = run(folder().path(), ["verify", "half-plain"]);
        assert_eq!(output.status.code(), Some(2), "{}", told(&output));
        assert!(told(&output).contains("did you mean `half-plane`?"), "{}", told(&output));
    }
}
