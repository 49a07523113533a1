//! What a doubtful user runs: the program against closed forms, limits, identities, its own independent methods and
//! tables of other programs.
//!
//! [`run`] works through [`GROUPS`] on all cores; each [`Check`] says what was computed, what was expected, by how much
//! they differ, by how much they may and why. Nothing here is random, and the order is always the same.
//!
//! Scenes that check the solver name their methods, so that no plan replaces what is checked; the tables of other
//! programs are solved as a user would, by the methods that the solver chooses. `docs/verify.md` has the list of
//! groups.
//!
//! ```
//! use slipzone::verify;
//!
//! let half_plane: Vec<_> = verify::GROUPS.iter().filter(|group| group.name == "half-plane").collect();
//! let report = verify::run(&half_plane, &|_| ());
//! assert!(report.passed, "{:#?}", report.failures().collect::<Vec<_>>());
//! ```

mod check;
mod contact;
mod groups;
pub(crate) mod layers;
mod references;

pub use check::{Check, Measure, Value};

use crate::caught::caught;
use crate::engine::Program;
use check::Sheet;
use rayon::prelude::*;
use serde::Serialize;

/// Checks of one kind.
#[derive(Debug)]
pub struct Group {
    /// Its name, unique.
    pub name: &'static str,
    /// What is checked against what, in one line.
    pub about: &'static str,
    cases: fn() -> Vec<Case>,
}

/// All groups, in the order of the report.
pub const GROUPS: &[Group] = groups::ALL;

/// A piece of work that ends in one check or several.
struct Case {
    name: String,
    run: Box<Work>,
}

/// Writes down checks; an error says why there is no number.
type Work = dyn Fn(&mut Sheet) -> Result<(), String> + Send + Sync;

impl Case {
    /// An error of `run` is a check that failed without a number.
    fn new(name: impl Into<String>, run: impl Fn(&mut Sheet) -> Result<(), String> + Send + Sync + 'static) -> Self {
        Self { name: name.into(), run: Box::new(run) }
    }

    /// The checks of the case; a panic is one that failed, whatever the others say.
    fn checks(&self, group: &'static str) -> Vec<Check> {
        let mut sheet = Sheet::new(group);
        if let Err(why) = caught(|| (self.run)(&mut sheet)).flatten() {
            sheet.no_number(&self.name, why);
        }
        sheet.into_checks()
    }
}

/// What came of the checks. The keys of its JSON are stable: added to, never renamed.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// Version of this format; 1.
    pub format: u32,
    /// What was checked.
    pub program: Program,
    /// Whether every check passed, and there was one.
    pub passed: bool,
    /// How many checks passed and failed, by group.
    pub groups: Vec<Tally>,
    /// All of them, in the order of the groups.
    pub checks: Vec<Check>,
}

/// A group in numbers.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// The group's name.
    pub name: &'static str,
    /// What is checked against what.
    pub about: &'static str,
    /// Checks that passed.
    pub passed: usize,
    /// Checks that failed.
    pub failed: usize,
}

impl Report {
    /// The verdict on checks of these groups; a group without any has failed to check anything.
    fn new(groups: &[&Group], checks: Vec<Check>) -> Self {
        let tally = |group: &&Group| {
            let own = || checks.iter().filter(|check| check.group == group.name);
            let passed = own().filter(|check| check.passed).count();
            Tally { name: group.name, about: group.about, passed, failed: own().count() - passed }
        };
        let groups: Vec<_> = groups.iter().map(tally).collect();
        let passed = !groups.is_empty() && groups.iter().all(|group| group.failed == 0 && group.passed > 0);
        let program = Program { name: env!("CARGO_PKG_NAME"), version: env!("CARGO_PKG_VERSION") };
        Self { format: 1, program, passed, groups, checks }
    }

    /// The checks that failed.
    pub fn failures(&self) -> impl Iterator<Item = &Check> {
        self.checks.iter().filter(|check| !check.passed)
    }
}

/// Runs all checks of some groups on all cores; tells of each case when it is done, from whichever thread, and how many
/// cases there are. One may hold several checks.
pub fn run(groups: &[&Group], tell: &(dyn Fn(usize) + Sync)) -> Report {
    crate::link_plugins();
    let cases: Vec<(&'static str, Case)> =
        groups.iter().flat_map(|group| (group.cases)().into_iter().map(|case| (group.name, case))).collect();
    let checks: Vec<Vec<Check>> = cases
        .par_iter()
        .with_max_len(1)
        .map(|(group, case)| {
            let checks = case.checks(group);
            tell(cases.len());
            checks
        })
        .collect();
    Report::new(groups, checks.into_iter().flatten().collect())
}

#[cfg(test)]
mod tests;
