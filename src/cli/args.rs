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
  1    the result is written, but its status is not `converged` (of a sweep: that of some scene)
  2    bad input: arguments, scene or study
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
    /// Solve all scenes of a study, and go on where an earlier run was interrupted
    Sweep(Sweep),
    /// List the plugins, or describe one
    Plugins {
        /// Name of a plugin, as in `type = "..."`
        name: Option<String>,
        /// Print JSON
        #[arg(long)]
        json: bool,
    },
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

#[derive(Debug, Args)]
pub(super) struct Sweep {
    /// Study file (TOML); `-` reads standard input
    pub(super) study: PathBuf,
    /// Folder of the results and of the journal; it is made if need be [default: the study's name with `.results`]
    #[arg(long, value_name = "FOLDER")]
    pub(super) out: Option<PathBuf>,
    /// Throw the journal of an earlier run away and begin anew
    #[arg(long)]
    pub(super) fresh: bool,
}
