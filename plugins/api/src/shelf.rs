//! Tables that depend on a resolution alone, made once per process.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

/// A bounded store of shared tables: what one solve made of a resolution serves the next, on any thread.
///
/// ```
/// use slipzone_api::Shelf;
///
/// static ROOTS: Shelf<usize, Vec<f64>> = Shelf::new(1 << 20, Vec::len);
/// let roots = |n| ROOTS.get(n, || (0..n).map(|k| (k as f64).sqrt()).collect());
/// assert_eq!(roots(5)[4], 2.0);
/// ```
pub struct Shelf<K, V> {
    tables: OnceLock<Mutex<BTreeMap<K, Arc<V>>>>,
    most: usize,
    numbers: fn(&V) -> usize,
}

impl<K: Ord, V> Shelf<K, V> {
    /// One that keeps so many numbers, as `numbers` counts them in a table; a table of more is kept alone.
    pub const fn new(most: usize, numbers: fn(&V) -> usize) -> Self {
        Self { tables: OnceLock::new(), most, numbers }
    }

    /// The table of a key, made if it is not there. Two threads that ask at once may both make it.
    pub fn get(&self, key: K, make: impl FnOnce() -> V) -> Arc<V> {
        let tables = self.tables.get_or_init(Mutex::default);
        // A table is inserted whole or not at all: one left by a thread that panicked is sound.
        let held = || tables.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(table) = held().get(&key) {
            return Arc::clone(table);
        }
        let table = Arc::new(make());
        let mut held = held();
        let kept: usize = held.values().map(|table| (self.numbers)(table)).sum();
        if kept + (self.numbers)(&table) > self.most {
            held.clear();
        }
        held.insert(key, Arc::clone(&table));
        table
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_are_shared_and_bounded() {
        const MOST: usize = 100;
        let shelf: Shelf<u8, usize> = Shelf::new(MOST, |table| *table);
        let first = shelf.get(1, || MOST / 2);
        assert!(Arc::ptr_eq(&first, &shelf.get(1, || unreachable!("it is on the shelf"))));
        shelf.get(2, || MOST / 2);
        assert!(Arc::ptr_eq(&first, &shelf.get(1, || unreachable!("there is room for both"))));
        shelf.get(3, || 2 * MOST);
        assert_eq!(*shelf.get(3, || unreachable!("the largest is kept alone")), 2 * MOST);
        assert_eq!(*shelf.get(1, || 7), 7, "the others took its room");
    }
}
