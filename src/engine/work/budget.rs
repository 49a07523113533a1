//! The bound of the work that a scene may take: counted, so that it is the same on every machine.

use crate::engine::work::elimination;
use slipzone_api::Refusal;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// Work that a scene may take, in multiplications: those of eliminations and of blended flat punches as they are, four
/// in sums over a grid finer than the unknowns as one, a kernel read off its table as 10, a wave number as 10,000. Some
/// ten seconds at the most. A loading curve may take twice as much again: its flat punches, and then its loads one by
/// one where those do not tell it.
pub const BUDGET: u64 = 20_000_000_000;
/// So many multiplications in sums over a finer grid count as one: they run side by side.
const SUMMED: u64 = 4;
/// What one reading of a kernel counts as. Roughly: 15 to 40 instructions, to one or two of a multiplication.
const READING: u64 = 10;
/// What the flexibility at one wave number counts as: 1e3 instructions in closed form, 1e4 to 1e5 by panels.
const WAVE_NUMBER: u64 = 10_000;
/// Refinement may take the budget over this; the rest is for telling of the resolution found last.
const TOLD: u64 = 2;

/// The work on one layer so far, and how far it may go.
#[derive(Debug)]
pub(crate) struct Meter {
    /// Distances at which kernels were read.
    read: AtomicU64,
    wave_numbers: AtomicU64,
    multiplied: AtomicU64,
    limit: AtomicU64,
    /// The limit once refinement has ended.
    end: AtomicU64,
    budget: AtomicU64,
    /// Whether something was refused: nothing is begun after that, however small.
    is_used_up: AtomicBool,
}

impl Default for Meter {
    /// Without a limit until [`Self::begin`].
    fn default() -> Self {
        let [read, wave_numbers, multiplied] = [0; 3].map(AtomicU64::new);
        let [limit, end, budget] = [u64::MAX; 3].map(AtomicU64::new);
        Self { read, wave_numbers, multiplied, limit, end, budget, is_used_up: AtomicBool::new(false) }
    }
}

impl Meter {
    pub(crate) fn count_readings(&self, count: usize) {
        self.read.fetch_add(count as u64, Ordering::Relaxed);
    }

    pub(crate) fn count_wave_numbers(&self, count: usize) {
        self.wave_numbers.fetch_add(count as u64, Ordering::Relaxed);
    }

    pub(crate) fn count_multiplications(&self, count: usize) {
        self.multiplied.fetch_add(count as u64, Ordering::Relaxed);
    }

    /// Distances at which kernels were read.
    pub(crate) fn readings(&self) -> u64 {
        self.read.load(Ordering::Relaxed)
    }

    /// All work, as multiplications.
    pub(crate) fn spent(&self) -> u64 {
        let [read, wave_numbers, multiplied] =
            [&self.read, &self.wave_numbers, &self.multiplied].map(|count| count.load(Ordering::Relaxed));
        multiplied.saturating_add(READING.saturating_mul(read)).saturating_add(WAVE_NUMBER.saturating_mul(wave_numbers))
    }

    /// A budget from here on.
    pub(crate) fn begin(&self, budget: u64) {
        let spent = self.spent();
        self.limit.store(spent.saturating_add(budget / TOLD), Ordering::Relaxed);
        self.end.store(spent.saturating_add(budget), Ordering::Relaxed);
        self.budget.store(budget, Ordering::Relaxed);
        self.is_used_up.store(false, Ordering::Relaxed);
    }

    /// Refinement has ended: what is left is for telling what was found.
    pub(crate) fn conclude(&self) {
        let end = self.end.load(Ordering::Relaxed);
        if self.limit.swap(end, Ordering::Relaxed) != end {
            self.is_used_up.store(false, Ordering::Relaxed);
        }
    }

    /// Refinement begins again, in what is left for it.
    pub(crate) fn resume(&self) {
        let [end, budget] = [&self.end, &self.budget].map(|number| number.load(Ordering::Relaxed));
        self.limit.store(end - budget / TOLD, Ordering::Relaxed);
    }

    /// Takes note of a system of so many equations and right-hand sides that is to be filled in, with so many
    /// multiplications `beside` the kernel's readings, and solved; refuses it where it would exceed the budget.
    pub(crate) fn system(&self, (n, right): (usize, usize), beside: u64) -> Result<(), Refusal> {
        let work = elimination(n, right) + beside / SUMMED;
        self.room_for(work)?;
        self.multiplied.fetch_add(work, Ordering::Relaxed);
        Ok(())
    }

    /// Refuses to go on where the budget is used up.
    pub(crate) fn within(&self) -> Result<(), Refusal> {
        self.room_for(0)
    }

    fn room_for(&self, work: u64) -> Result<(), Refusal> {
        let is_enough = self.spent().saturating_add(work) <= self.limit.load(Ordering::Relaxed);
        if is_enough && !self.is_used_up.load(Ordering::Relaxed) {
            return Ok(());
        }
        self.is_used_up.store(true, Ordering::Relaxed);
        Err(Refusal::Limit {
            why: format!(
                "this scene asks for more work than its budget, {:.0e} multiplications",
                self.budget.load(Ordering::Relaxed)
            ),
            remedy: "take a larger `tolerance`, fewer `quantities`, or fewer points",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_budget_ends_refinement_and_leaves_room_to_tell() {
        let meter = Meter::default();
        assert!(meter.system((100_000, 1), 0).is_ok(), "nothing is bounded before it begins");
        meter.begin(BUDGET);
        #[allow(clippy::cast_possible_truncation)] // of 64 bits
        meter.count_multiplications(BUDGET as usize / 2 + 1);
        let refusal = meter.within().unwrap_err().to_string();
        assert!(refusal.contains("budget, 2e10 multiplications"), "{refusal}");
        assert!(refusal.starts_with("this scene asks"), "no name of a part of the program before it: {refusal}");
        meter.conclude();
        assert!(meter.within().is_ok());
        #[allow(clippy::cast_possible_truncation)]
        meter.count_readings((BUDGET / READING) as usize / 2);
        assert!(meter.within().is_err());
        meter.conclude();
        assert!(meter.within().is_err(), "there is no more to conclude");
        meter.begin(BUDGET);
        assert!(meter.within().is_ok(), "another scene on the same layer has its own");
        assert!(meter.system((1, 1), SUMMED * BUDGET).is_err(), "what fills it in counts");
        meter.begin(BUDGET);
        let before = meter.spent();
        assert!(meter.system((1_000_000, 1), 0).is_err());
        assert_eq!(meter.spent(), before, "what is refused is not done");
        assert!(meter.system((1, 1), 0).is_err(), "nor is what comes after it");
    }
}
