//! `slipzone completions`: what a shell completes.

use super::args::Arguments;
use super::{Failure, Outcome, print};
use clap::CommandFactory;
use clap_complete::Shell;

pub(super) fn run(shell: Shell) -> Result<Outcome, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "slipzone", &mut script);
    print::result(&String::from_utf8_lossy(&script))?;
    Ok(Outcome::Done)
}
