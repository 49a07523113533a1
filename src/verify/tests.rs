//! The verdict: what passes, what fails, and that neither is decided by the solver.

use super::check::{Measure, Sheet, Value, Within};
use super::*;
use std::sync::atomic::{AtomicUsize, Ordering};

fn group(cases: fn() -> Vec<Case>) -> Group {
    Group { name: "made up", about: "for a test", cases }
}

fn report(cases: fn() -> Vec<Case>) -> Report {
    run(&[&group(cases)], &|_| ())
}

fn near(sheet: &mut Sheet, computed: f64) {
    sheet.relative("near", computed, 2.0, Within::new(1e-3, "made up"), "made up");
}

#[test]
fn a_number_within_its_tolerance_passes_and_another_fails() {
    let report = report(|| {
        vec![Case::new("two", |sheet| {
            near(sheet, 2.001);
            near(sheet, 2.01);
            Ok(())
        })]
    });
    assert!(!report.passed);
    assert_eq!(report.groups, [Tally { name: "made up", about: "for a test", passed: 1, failed: 1 }]);
    let failed: Vec<_> = report.failures().collect();
    assert_eq!(failed.len(), 1);
    assert_eq!((failed[0].computed.clone(), failed[0].measure), (Value::Number(2.01), Measure::Relative));
}

#[test]
fn what_gives_no_number_fails() {
    let report = report(|| {
        vec![
            Case::new("refused", |_| Err("it was refused".into())),
            Case::new("NaN", |sheet| {
                near(sheet, f64::NAN);
                sheet.at_most("bounded", f64::NAN, 1.0, Within::new(1.0, "made up"), "made up");
                sheet.error("infinite", f64::INFINITY, Within::new(f64::INFINITY, "made up"), "made up");
                Ok(())
            }),
        ]
    });
    assert_eq!((report.checks.len(), report.failures().count()), (4, 4));
    assert_eq!(report.checks[0].note.as_deref(), Some("it was refused"));
    let json = serde_json::to_string(&report).expect("JSON");
    assert!(!json.contains("NaN") && json.contains("\"computed\":null"), "{json}");
}

#[test]
fn a_panic_is_a_check_that_failed() {
    let report = report(|| {
        vec![Case::new("broken", |sheet| {
            near(sheet, 2.0);
            panic!("on purpose, in a test")
        })]
    });
    assert!(!report.passed);
    assert!(report.failures().any(|check| check.note.as_ref().is_some_and(|note| note.contains("panicked"))));
}

#[test]
fn nothing_checked_is_nothing_verified() {
    assert!(!report(Vec::new).passed);
    assert!(!run(&[], &|_| ()).passed);
}

#[test]
fn words_are_compared_as_words() {
    let report = report(|| {
        vec![Case::new("words", |sheet| {
            sheet.same("one", "refused", "refused", "made up", "made up");
            sheet.same("other", "taken", "refused", "made up", "made up");
            Ok(())
        })]
    });
    assert_eq!(report.checks.iter().map(|check| check.passed).collect::<Vec<_>>(), [true, false]);
}

#[test]
fn all_cases_are_told_of() {
    let counted = AtomicUsize::new(0);
    let two = group(|| {
        let case = || {
            Case::new("one", |sheet| {
                near(sheet, 2.0);
                Ok(())
            })
        };
        vec![case(), case()]
    });
    run(&[&two], &|all| {
        assert_eq!(all, 2);
        counted.fetch_add(1, Ordering::Relaxed);
    });
    assert_eq!(counted.into_inner(), 2);
}
