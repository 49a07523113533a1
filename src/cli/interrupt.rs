//! How a run ends that the user stops.

use super::{output, print};
use std::sync::{Mutex, PoisonError};

/// Exit code of a run that the user stopped (128 + SIGINT).
const INTERRUPTED: i32 = 130;

type Words = Box<dyn Fn() -> String + Send>;

/// What is said when the run is stopped now.
static LAST_WORDS: Mutex<Option<Words>> = Mutex::new(None);

/// Ends the program in order when it is told to stop. Whatever it writes is whole at any time: files by renaming,
/// journals line by line. What the program was started to ignore (`nohup`, a job in the background) it goes on
/// ignoring.
pub(super) fn watch() {
    let stop = || {
        let _no_more = output::abandon();
        if let Some(words) = &*LAST_WORDS.lock().unwrap_or_else(PoisonError::into_inner) {
            print::note(&words());
        }
        std::process::exit(INTERRUPTED)
    };
    // Without the handler the program would end by the signal, with no exit code of its own.
    if let Err(error) = on_signal(stop) {
        print::note(&format!("interrupting will not be tidy: {error}"));
    }
    // A file that outgrows its limit is an error of writing, to be told, and no reason to be killed.
    #[cfg(unix)]
    if let Err(error) = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, std::sync::Arc::default()) {
        print::note(&format!("a limit on the size of files will end the program without a word: {error}"));
    }
}

#[cfg(not(unix))]
fn on_signal(stop: impl Fn() + Send + 'static) -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(stop)
}

#[cfg(unix)]
fn on_signal(stop: impl Fn() + Send + 'static) -> std::io::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let ignored = ignored();
    let heeded = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    let mut signals = signal_hook::iterator::Signals::new(heeded)?;
    let wait = move || {
        if signals.forever().next().is_some() {
            stop();
        }
    };
    std::thread::Builder::new().name("signals".into()).spawn(wait).map(drop)
}

/// The signals that the program was started to ignore, a bit for each, where the system tells (Linux).
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

/// Says something if the run is stopped from now on.
pub(super) fn say(words: impl Fn() -> String + Send + 'static) {
    *LAST_WORDS.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(words));
}

/// Nothing is left to be said.
pub(super) fn be_silent() {
    *LAST_WORDS.lock().unwrap_or_else(PoisonError::into_inner) = None;
}
