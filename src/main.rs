//! The command line program: arguments in, exit code out.

fn main() -> std::process::ExitCode {
    slipzone::cli::run(std::env::args_os())
}
