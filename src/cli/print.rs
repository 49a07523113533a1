//! Standard output and standard error. A reader that goes away (`| head`) is no failure.

use super::Failure;
use std::io::{ErrorKind, Write};

/// Writes a result to standard output.
pub(super) fn result(text: &str) -> Result<(), Failure> {
    let mut out = std::io::stdout().lock();
    let written =
        out.write_all(text.as_bytes()).and_then(|()| if text.ends_with('\n') { Ok(()) } else { out.write_all(b"\n") });
    match written.and_then(|()| out.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::System(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// Tells something beside the result, on standard error.
pub(super) fn note(text: &str) {
    // Nobody is left to be told when standard error itself is closed.
    let _ = writeln!(std::io::stderr(), "slipzone: {text}");
}
