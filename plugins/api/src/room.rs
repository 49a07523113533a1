//! Room that each thread keeps from one use to the next.

use std::cell::Cell;
use std::thread::LocalKey;

/// Lends what this thread keeps; while that is lent already, what stands for nothing in its place.
///
/// ```
/// use std::cell::Cell;
///
/// thread_local! {
///     static ROOM: Cell<Vec<f64>> = const { Cell::new(Vec::new()) };
/// }
/// let first = slipzone_api::lend(&ROOM, |room| {
///     room.push(1.0);
///     room.as_ptr()
/// });
/// let again = slipzone_api::lend(&ROOM, |room| (room.as_ptr(), slipzone_api::lend(&ROOM, |other| other.len())));
/// assert_eq!(again, (first, 0));
/// ```
#[inline]
pub fn lend<T: Default, R>(kept: &'static LocalKey<Cell<T>>, work: impl FnOnce(&mut T) -> R) -> R {
    let mut room = kept.take();
    let done = work(&mut room);
    kept.set(room);
    done
}
