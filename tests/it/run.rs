//! Runs the program as a user would.

use std::ffi::OsStr;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// A scene with nothing wrong.
pub(crate) const GOOD: &str = r#"format = 1
title = "a good scene"

[layer]
thickness = 5.0
poisson = 0.3
grading = { type = "exponential", surface = 1.0, base = 8.0 }

[punch]
type = "flat"
half_width = 1.0

[friction]
type = "goodman"
coefficient = 0.3

[load]
force = 1.0
"#;

/// The program in a folder, without the colours that an environment may force on it.
pub(crate) fn program(folder: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_slipzone"));
    command.current_dir(folder).env("NO_COLOR", "1").env_remove("CLICOLOR_FORCE").stdin(Stdio::null());
    command
}

/// A run to its end.
pub(crate) fn run<S: AsRef<OsStr>>(folder: &Path, arguments: impl IntoIterator<Item = S>) -> Output {
    program(folder).args(arguments).output().expect("the program starts")
}

/// A run that is fed on standard input.
pub(crate) fn feed(folder: &Path, arguments: &[&str], input: &[u8]) -> Output {
    let mut child = program(folder)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the program starts");
    // It may rightly stop reading early.
    let _ = child.stdin.take().expect("piped").write_all(input);
    child.wait_with_output().expect("the program ends")
}

/// Exit code, standard error and, where there is any, standard output.
pub(crate) fn told(output: &Output) -> String {
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("the program writes UTF-8");
    let code = output.status.code().map_or("none: ended by a signal".into(), |code| code.to_string());
    let told = format!("exit code: {code}\n----- stderr -----\n{}", text(&output.stderr));
    if output.stdout.is_empty() { told } else { told + "----- stdout -----\n" + &text(&output.stdout) }
}

/// A folder of its own with a good scene in `good.toml`.
pub(crate) fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(folder.path().join("good.toml"), GOOD).expect("the folder can be written to");
    folder
}

/// Names of the files in a folder, sorted.
pub(crate) fn files(folder: &Path) -> Vec<PathBuf> {
    let mut names: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| PathBuf::from(entry.unwrap().file_name())).collect();
    names.sort();
    names
}
