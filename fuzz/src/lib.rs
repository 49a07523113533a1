//! What the targets in `tests/` do with bytes: nothing may panic, and what is refused has a reason and a place.

use slipzone::scene::SceneError;
use slipzone_api::Files;
use slipzone_api::rows::{Columns, Wrong, of_file};
use std::collections::BTreeMap;

/// A file whose content is the bytes.
struct Bytes<'a>(&'a [u8]);

impl Files for Bytes<'_> {
    fn read(&self, _name: &str) -> Result<Vec<u8>, String> {
        Ok(self.0.to_vec())
    }
}

/// Bytes as a scene file, and a scene that was read is read again from what it is written as.
pub fn scene(bytes: &[u8]) {
    let text = match slipzone::scene::text("fuzz.toml", bytes.to_vec()) {
        Ok(text) => text,
        Err(error) => return told(&error, &String::from_utf8_lossy(bytes)),
    };
    match slipzone::scene::parse_with("fuzz.toml", &text, &Bytes(bytes)) {
        Ok(scene) => drop(slipzone::engine::plan(&scene)),
        Err(error) => told(&error, &text),
    }
}

/// Bytes as a study.
pub fn study(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match slipzone::study::Study::parse("fuzz.toml", &text, &Bytes(b"")) {
        Ok(study) => {
            for row in [0, study.rows() / 2, study.rows().saturating_sub(1)] {
                if row < study.rows() {
                    let _ = (study.cells(row), study.scene(row));
                }
            }
        }
        Err(error) => told(&error, &text),
    }
}

/// Bytes as a formula; one that is understood has a value of some kind everywhere.
pub fn formula(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let parameters: BTreeMap<String, f64> = [("m".to_owned(), 2.0), ("R".to_owned(), 10.0)].into();
    for parameters in [parameters, BTreeMap::new()] {
        match slipzone_formula::Formula::parse("height", &text, "x", &parameters) {
            Ok(formula) => {
                for x in [-1.0, 0.0, 1e-300, 0.5, 1.0, 1e300] {
                    let _ = formula.at(x);
                }
            }
            Err(fault) => assert!(!fault.message.is_empty()),
        }
    }
}

/// Bytes as a table of numbers.
pub fn table(bytes: &[u8]) {
    let columns = Columns { count: 2..=3, number: "two or three", names: "x and height" };
    // Who takes the rows checks their range, and refuses what overflowed: `4e2053` is infinite here.
    let take = |row: &[f64]| -> Result<(), Wrong> {
        assert!((2..=3).contains(&row.len()));
        Ok(())
    };
    let read = of_file("fuzz.csv", &Bytes(bytes), &columns, take);
    if let Err(fault) = read {
        assert!(!fault.message.is_empty());
    }
}

/// What is refused has a reason, and a place in the text.
fn told(error: &SceneError, text: &str) {
    assert!(!error.message.is_empty() && !error.to_string().is_empty());
    assert!(error.line <= text.lines().count() + 1, "line {} of {}", error.line, text.lines().count());
}
