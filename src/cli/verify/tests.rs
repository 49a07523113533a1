use super::*;
use crate::engine::Program;
use crate::verify::Tally;

/// A report of two checks, the second off by 0.1.
fn one_failed() -> Report {
    let check = |name: &str, computed: f64| Check {
        group: "made up",
        name: name.into(),
        computed: Value::Number(computed),
        expected: Value::Number(1.0),
        measure: Measure::Relative,
        error: Some(computed - 1.0),
        tolerance: 1e-9,
        reason: "for a test".into(),
        source: "nowhere".into(),
        passed: computed <= 1.0,
        note: None,
    };
    Report {
        format: 1,
        program: Program { name: "slipzone", version: "0" },
        passed: false,
        groups: vec![Tally { name: "made up", about: "for a test", passed: 1, failed: 1 }],
        checks: vec![check("right", 1.0), check("wrong", 1.1)],
    }
}

fn written(report: &Report, all: bool) -> String {
    let mut text = String::new();
    page(&mut text, report, all).expect("a string takes it");
    text
}

#[test]
fn a_failed_check_is_told_in_full_and_ends_the_run_badly() {
    let report = one_failed();
    assert_eq!(outcome(&report), Outcome::Failed);
    let text = written(&report, false);
    assert!(text.starts_with("FAIL [made up] wrong\n     computed 1.1, expected 1\n"), "{text}");
    assert!(text.contains("relative error 1.0e-1, allowed 1.0e-9: for a test"), "{text}");
    assert!(!text.contains("right") && text.ends_with("\nFAILED: 1 of 2 checks.\n"), "{text}");
    assert!(written(&report, true).starts_with("ok   [made up] right\n"));
}

#[test]
fn what_gave_no_number_says_why() {
    let mut report = one_failed();
    let check = &mut report.checks[1];
    (check.computed, check.expected, check.error) = (Value::Missing, Value::Missing, None);
    check.note = Some("it was refused".into());
    assert!(written(&report, false).starts_with("FAIL [made up] wrong\n     it was refused\n"));
}

#[test]
fn a_report_without_failures_ends_well() {
    let mut report = one_failed();
    report.passed = true;
    report.checks.pop();
    report.groups[0].failed = 0;
    assert_eq!(outcome(&report), Outcome::Done);
    assert!(written(&report, false).ends_with("\nAll 1 checks passed.\n"));
}

#[test]
fn groups_are_run_in_the_order_of_the_report() {
    let names = |asked: &[&str]| {
        let asked: Vec<String> = asked.iter().map(|name| (*name).to_owned()).collect();
        named("group", &asked, GROUPS, |group| group.name)
            .expect("known")
            .iter()
            .map(|group| group.name)
            .collect::<Vec<_>>()
    };
    assert_eq!(names(&["paper", "friction"]), ["friction", "paper"]);
    assert_eq!(names(&[]).len(), GROUPS.len());
}
