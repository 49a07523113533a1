//! How a run ends that the user stops.

use super::print;
use std::sync::{Mutex, PoisonError};

/// Exit code of a run that the user stopped (128 + SIGINT).
const INTERRUPTED: i32 = 130;

type Words = Box<dyn Fn() -> String + Send>;

/// What is said when the run is stopped now.
static LAST_WORDS: Mutex<Option<Words>> = Mutex::new(None);

/// Ends the program in order when it is told to stop. Whatever it writes is whole at any time: files by renaming, journals
/// line by line.
pub(super) fn watch() {
    let stop = || {
        if let Some(words) = &*LAST_WORDS.lock().unwrap_or_else(PoisonError::into_inner) {
            print::note(&words());
        }
        std::process::exit(INTERRUPTED)
    };
    // Without the handler the program would end by the signal, with no exit code of its own.
    if let Err(error) = ctrlc::set_handler(stop) {
        print::note(&format!("interrupting will not be tidy: {error}"));
    }
    // A file that outgrows its limit is an error of writing, to be told, and no reason to be killed.
    #[cfg(unix)]
    if let Err(error) = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default()) {
        print::note(&format!("a limit on the size of files will end the program without a word: {error}"));
    }
}

/// Says something if the run is stopped from now on.
pub(super) fn say(words: impl Fn() -> String + Send + 'static) {
    *LAST_WORDS.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(words));
}

/// Nothing is left to be said.
pub(super) fn be_silent() {
    *LAST_WORDS.lock().unwrap_or_else(PoisonError::into_inner) = None;
}
