//! Panics, told in words: a plugin's, and the program's own.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What some work answers, or what is said of its panic. Nothing that it changed is to be used after that.
pub(crate) fn caught<T>(work: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|payload| {
        let message = message(&*payload).unwrap_or("without a message");
        format!(
            "the program panicked ({message}): a fault of its own or of a plugin; standard error names the line of code"
        )
    })
}

/// What `panic!` was told.
fn message(payload: &(dyn Any + Send)) -> Option<&str> {
    let owned = payload.downcast_ref::<String>().map(String::as_str);
    owned.or_else(|| payload.downcast_ref::<&str>().copied())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_told_with_its_message() {
        assert_eq!(caught(|| 7), Ok(7));
        let number = 3;
        for (told, words) in [
            (caught(|| panic!("plain")), "panicked (plain)"),
            (caught(|| panic!("of {number}")), "panicked (of 3)"),
            (caught(|| std::panic::panic_any(number)), "panicked (without a message)"),
        ] {
            let told: Result<(), String> = told;
            let told = told.expect_err("a panic");
            assert!(told.contains(words), "{told}");
        }
    }
}
