//! What can be asked for.

use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;

/// Partial-slip contact between a rigid punch and an elastic graded layer.
#[derive(Debug, Parser)]
#[command(name = "slipzone", version, about, after_help = EXIT_CODES, arg_required_else_help = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
}

const EXIT_CODES: &str = "Exit codes:
  0    done
  1    the result is written, but its status is not `converged`; verify: a check failed
  2    bad input: arguments or scene
  3    a file or the system failed
  130  interrupted";

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Solve a scene and report the result
    Solve(Solve),
    /// Check a scene without solving it
    Check {
        /// Scene file (TOML); `-` reads standard input
        scene: PathBuf,
    },
    /// Show a scene with defaults filled in, and how it would be solved
    Explain(Explain),
    /// List the plugins, or describe one
    Plugins {
        /// Name of a plugin, as in `type = "..."`
        name: Option<String>,
        /// Print JSON
        #[arg(long)]
        json: bool,
    },
    /// Check the program against closed forms, limits, identities and other programs' numbers
    Verify(Verify),
}

#[derive(Debug, Args)]
pub(super) struct Explain {
    /// Scene file (TOML); `-` reads standard input
    pub(super) scene: PathBuf,
    /// Draw the elastic constants over depth, and the flexibility of the surface, as SVG
    #[cfg(feature = "plot")]
    #[arg(long, value_name = "FILE")]
    pub(super) svg: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct Verify {
    /// Groups of checks to run; all when none is named
    #[arg(value_name = "GROUP")]
    pub(super) groups: Vec<String>,
    /// Print every check, not only those that failed
    #[arg(long, conflicts_with = "json")]
    pub(super) all: bool,
    /// Print every check as JSON
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Debug, Args)]
pub(super) struct Solve {
    /// Scene file (TOML); `-` reads standard input
    pub(super) scene: PathBuf,
    /// Write the result as JSON; `-` prints it in place of the report
    #[arg(long, value_name = "FILE|-")]
    pub(super) json: Option<PathBuf>,
    /// Write the tractions along the contact as CSV
    #[arg(long, value_name = "FILE")]
    pub(super) csv: Option<PathBuf>,
    /// Draw the tractions as SVG
    #[cfg(feature = "plot")]
    #[arg(long, value_name = "FILE")]
    pub(super) svg: Option<PathBuf>,
    /// Write the loading curve that the scene asks for as CSV
    #[arg(long, value_name = "FILE")]
    pub(super) curve_csv: Option<PathBuf>,
    /// Draw the loading curve that the scene asks for as SVG
    #[cfg(feature = "plot")]
    #[arg(long, value_name = "FILE")]
    pub(super) curve_svg: Option<PathBuf>,
}
