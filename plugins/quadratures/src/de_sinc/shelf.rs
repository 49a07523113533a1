//! Tables that depend on the resolution alone, built once per process.

use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// How much room a table takes.
pub(super) trait Size {
    /// Numbers held, about.
    fn numbers(&self) -> usize;
}

/// A bounded store of shared tables.
pub(super) struct Shelf<K, V> {
    tables: OnceLock<Mutex<HashMap<K, Arc<V>>>>,
}

/// Numbers kept per shelf, 64 MB; one table that is larger is kept alone.
const MOST_NUMBERS: usize = 1 << 23;

impl<K: Eq + Hash, V: Size> Shelf<K, V> {
    pub(super) const fn new() -> Self {
        Self { tables: OnceLock::new() }
    }

    /// The table of a key, built if it is not there. Two threads that ask at once may both build it.
    pub(super) fn get(&self, key: K, build: impl FnOnce() -> V) -> Arc<V> {
        let tables = self.tables.get_or_init(Mutex::default);
        // A table is inserted whole or not at all: one left by a thread that panicked is sound.
        let held = || tables.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(table) = held().get(&key) {
            return Arc::clone(table);
        }
        let table = Arc::new(build());
        let mut held = held();
        let kept: usize = held.values().map(|table| table.numbers()).sum();
        if kept + table.numbers() > MOST_NUMBERS {
            held.clear();
        }
        held.insert(key, Arc::clone(&table));
        table
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Table(usize);

    impl Size for Table {
        fn numbers(&self) -> usize {
            self.0
        }
    }

    #[test]
    fn tables_are_shared_and_bounded() {
        let shelf: Shelf<u8, Table> = Shelf::new();
        let first = shelf.get(1, || Table(MOST_NUMBERS / 2));
        assert!(Arc::ptr_eq(&first, &shelf.get(1, || unreachable!("it is on the shelf"))));
        shelf.get(2, || Table(MOST_NUMBERS));
        let again = shelf.get(1, || Table(7));
        assert_eq!(again.0, 7, "the second one took the room of the first");
    }
}
