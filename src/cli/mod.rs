//! The command line: what is asked, what is read and written, and how it ends.

mod args;
mod chart;
mod check;
mod completions;
mod explain;
mod failure;
mod init;
mod input;
mod interrupt;
mod journal;
mod named;
mod output;
mod plugins;
mod print;
mod progress;
mod schema;
mod solve;
mod sweep;
mod verify;

use crate::caught::caught;
use args::{Arguments, Command};
use clap::Parser;
use failure::Failure;
use std::ffi::OsString;
use std::process::ExitCode;

/// How a run ends. Bad input (2) and failures of files or the system (3) are [`Failure`]s.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Outcome {
    /// Everything asked for was done.
    Done,
    /// The result or the report is written; its status is not `converged`, or a check in it failed.
    Failed,
}

/// Runs one command, as the program `slipzone` does: arguments in, the program's name first; exit code out (the
/// repository's `docs/command-line.md` lists both). Plugins of the calling program's own are known like those that come
/// with it.
///
/// ```no_run
/// // A `main.rs` that adds plugins of one's own to the command line; `use my_plugins as _;` above it links their crate.
/// fn main() -> std::process::ExitCode {
///     slipzone::cli::run(std::env::args_os())
/// }
/// ```
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    interrupt::watch();
    crate::link_plugins();
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version arrive here too, with exit code 0. A closed pipe is no reason to complain.
            let printed = error.print();
            if let (0, Err(why)) = (error.exit_code(), printed)
                && why.kind() != std::io::ErrorKind::BrokenPipe
            {
                let failure = Failure::System(format!("cannot write to standard output: {why}"));
                failure.print();
                return ExitCode::from(failure.exit_code());
            }
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    match caught(|| dispatch(&arguments.command)).unwrap_or_else(|why| Err(Failure::System(why))) {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Failed) => ExitCode::from(1),
        Err(failure) => {
            failure.print();
            ExitCode::from(failure.exit_code())
        }
    }
}

fn dispatch(command: &Command) -> Result<Outcome, Failure> {
    if crate::api::plugins().is_empty() {
        return Err(Failure::System("this program was built without any plugin; build it again".into()));
    }
    match command {
        Command::Solve(arguments) => solve::run(arguments),
        Command::Check { scene } => check::run(scene),
        Command::Explain(arguments) => explain::run(arguments),
        Command::Sweep(arguments) => sweep::run(arguments),
        Command::Verify(arguments) => verify::run(arguments),
        Command::Chart(arguments) => chart::run(arguments),
        Command::Plugins { names, json } => plugins::run(names, *json),
        Command::Init(arguments) => init::run(arguments),
        Command::Schema => schema::run(),
        Command::Completions { shell } => completions::run(*shell),
    }
}
