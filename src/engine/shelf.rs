//! Tables that depend on a count alone, made once per process.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// Largest count that is kept.
const LARGEST: usize = 512;
/// Most tables kept.
const MOST: usize = 64;

/// A bounded store of shared tables, one for each count.
pub(super) struct Shelf<T> {
    tables: OnceLock<Mutex<HashMap<usize, Arc<T>>>>,
}

impl<T> Shelf<T> {
    pub(super) const fn new() -> Self {
        Self { tables: OnceLock::new() }
    }

    /// The table of a count, made if it is not there. Two threads that ask at once may both make it.
    pub(super) fn get(&self, count: usize, make: impl FnOnce(usize) -> T) -> Arc<T> {
        if count > LARGEST {
            return Arc::new(make(count));
        }
        let tables = self.tables.get_or_init(Mutex::default);
        // A table is inserted whole or not at all: one left by a thread that panicked is sound.
        let held = || tables.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(table) = held().get(&count) {
            return Arc::clone(table);
        }
        let table = Arc::new(make(count));
        let mut held = held();
        if held.len() >= MOST {
            held.clear();
        }
        held.insert(count, Arc::clone(&table));
        table
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_shared_and_bounded() {
        let shelf: Shelf<usize> = Shelf::new();
        let first = shelf.get(1, |count| count);
        assert!(Arc::ptr_eq(&first, &shelf.get(1, |_| unreachable!("it is on the shelf"))));
        for count in 2..=MOST + 1 {
            shelf.get(count, |count| count);
        }
        assert_eq!(*shelf.get(1, |_| 7), 7, "the others took its room");
        assert_eq!([3, 4].map(|made| *shelf.get(LARGEST + 1, |_| made)), [3, 4], "too large to keep");
    }
}
