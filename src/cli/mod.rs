//! The command line: what is asked, what is read and written, and how it ends.

mod args;
mod check;
mod explain;
mod failure;
mod input;
mod output;
mod plugins;
mod print;
mod solve;
mod verify;

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
    /// The result is written; its status is not `converged`.
    NotConverged,
    /// The report is written; a check in it failed.
    ChecksFailed,
}

/// Exit code of a run that the user stopped (128 + SIGINT).
const INTERRUPTED: i32 = 130;

/// Runs one command.
pub(crate) fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    // Without the handler the program would end by the signal, with no exit code of its own.
    if let Err(error) = ctrlc::set_handler(|| std::process::exit(INTERRUPTED)) {
        print::note(&format!("interrupting will not be tidy: {error}"));
    }
    slipzone::link_plugins();
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            // Help and version arrive here too, with exit code 0. A closed pipe is no reason to complain.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
    };
    match dispatch(&arguments.command) {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::NotConverged | Outcome::ChecksFailed) => ExitCode::from(1),
        Err(failure) => {
            failure.print();
            ExitCode::from(failure.exit_code())
        }
    }
}

fn dispatch(command: &Command) -> Result<Outcome, Failure> {
    if slipzone::api::plugins().is_empty() {
        return Err(Failure::System("this program was built without any plugin; build it again".into()));
    }
    match command {
        Command::Solve(arguments) => solve::run(arguments),
        Command::Check { scene } => check::run(scene),
        Command::Explain(arguments) => explain::run(arguments),
        Command::Verify(arguments) => verify::run(arguments),
        Command::Plugins { name, json } => plugins::run(name.as_deref(), *json),
    }
}
