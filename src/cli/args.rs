//! What can be asked for.

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;
use std::path::PathBuf;

/// Partial-slip contact between a rigid punch and an elastic graded layer.
#[derive(Debug, Parser)]
#[command(name = "slipzone", version, about, after_help = START, arg_required_else_help = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
}

const START: &str = "To begin with:
  slipzone init               write a commented scene into scene.toml
  slipzone solve scene.toml   solve it

Exit codes:
  0    done
  1    the result is written, but its status is not `converged` (of a sweep: that of
       some scene); of verify: a check failed; of chart: the program's own choice was wrong
  2    bad input: arguments, scene or study
  3    a file or the system failed
  130  interrupted

`slipzone COMMAND --help` has examples of each command.";

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Write a commented scene that runs, to start from
    Init(Init),
    /// Solve a scene and report the result
    Solve(Solve),
    /// Check a scene without solving it
    #[command(after_help = CHECK)]
    Check {
        /// Scene file (TOML); `-` reads standard input
        scene: PathBuf,
    },
    /// Show a scene with defaults filled in, and how it would be solved
    Explain(Explain),
    /// Solve all scenes of a study, and go on where an earlier run was interrupted
    #[command(after_help = SWEEP)]
    Sweep(Sweep),
    /// List the plugins, or describe one
    #[command(after_help = PLUGINS)]
    Plugins {
        /// Names of plugins, as in `type = "..."`, or of families; both as in `grading table`
        #[arg(value_name = "NAME")]
        names: Vec<String>,
        /// Print JSON
        #[arg(long)]
        json: bool,
    },
    /// Print the JSON schema of a scene, for editors
    #[command(after_help = SCHEMA)]
    Schema,
    /// Print a script that completes commands and options in a shell
    #[command(after_help = COMPLETIONS)]
    Completions {
        /// The shell
        shell: Shell,
    },
    /// Check the program against closed forms, limits, identities and other programs' numbers
    Verify(Verify),
    /// Chart speed against accuracy for every method, or map where each of them fails
    Chart(Chart),
}

#[derive(Debug, Args)]
#[command(after_help = INIT)]
pub(super) struct Init {
    /// File to write, which must not be there yet; `-` prints the scene
    #[arg(default_value = "scene.toml")]
    pub(super) file: PathBuf,
    /// Punch of the scene, by its name in `slipzone plugins`
    #[arg(long, value_name = "NAME", default_value = "flat")]
    pub(super) punch: String,
    /// Grading of the scene, by its name in `slipzone plugins`
    #[arg(long, value_name = "NAME", default_value = "exponential")]
    pub(super) grading: String,
}

const INIT: &str = "Examples:
  slipzone init
  slipzone init tip.toml --punch cylinder --grading power-law
  slipzone init - --punch wedge | slipzone solve -

Exit codes:
  0  the scene is written
  2  the file is there already, or there is no plugin of that name
  3  the file cannot be written";

#[derive(Debug, Args)]
#[command(after_help = EXPLAIN)]
pub(super) struct Explain {
    /// Scene file (TOML); `-` reads standard input
    pub(super) scene: PathBuf,
    /// Draw the elastic constants over depth, and the flexibility of the surface, as SVG
    #[cfg(feature = "plot")]
    #[arg(long, value_name = "FILE")]
    pub(super) svg: Option<PathBuf>,
}

const EXPLAIN: &str = "Examples:
  slipzone explain scene.toml
  slipzone explain scene.toml --svg layer.svg

Exit codes:
  0  explained, a scene that would be refused too
  2  bad input: arguments or scene
  3  a file or the system failed";

#[derive(Debug, Args)]
#[command(after_help = VERIFY)]
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

const VERIFY: &str = "Examples:
  slipzone verify
  slipzone verify friction tables --all
  slipzone verify --json

An unknown group is answered with the names of all.

Exit codes:
  0  all passed
  1  a check failed; it is printed
  2  there is no such group
  3  standard output cannot be written";

#[derive(Debug, Args)]
#[command(after_help = SOLVE)]
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
    /// Throw the journal and the results of an earlier run away and begin anew
    #[arg(long)]
    pub(super) fresh: bool,
}

#[derive(Debug, Args)]
#[command(after_help = CHART)]
pub(super) struct Chart {
    /// Scenes to chart, or maps of the atlas; all when none is named
    #[arg(value_name = "NAME")]
    pub(super) names: Vec<String>,
    /// Map the digits of each method over pairs of parameters, in place of charting scenes
    #[arg(long)]
    pub(super) atlas: bool,
    /// A few settings or cells of each, to see that everything runs
    #[arg(long)]
    pub(super) quick: bool,
    /// Only list the names
    #[arg(long, conflicts_with_all = ["quick", "out"])]
    pub(super) list: bool,
    /// Folder of the files; it is made if need be [default: `chart`, of the atlas `atlas`]
    #[arg(long, value_name = "FOLDER")]
    pub(super) out: Option<PathBuf>,
}

const CHART: &str = "Examples:
  slipzone chart
  slipzone chart thin growing --out charts
  slipzone chart --atlas

A page to open in a browser, a table (CSV) and figures (SVG). Times are those of one thread: let nothing else
run beside it.

Exit codes:
  0    the methods that the program chooses by itself are nowhere silently wrong
  1    they are somewhere; the files are written
  2    bad input: there is no scene or map of that name
  3    a file or the system failed
  130  interrupted: nothing is written";

const SOLVE: &str = "Examples:
  slipzone solve scene.toml
  slipzone solve scene.toml --svg tractions.svg --csv tractions.csv
  slipzone solve scene.toml --json - | jq .stick.ratio

A file is written whole or not at all.

Exit codes:
  0    solved: the status is `converged`
  1    the result is written; its status is another, and `reason` says why
  2    bad input: arguments or scene
  3    a file or the system failed
  130  interrupted: nothing is written";

const SWEEP: &str = "Examples:
  slipzone sweep study.toml
  slipzone sweep study.toml --out results --fresh

Each finished scene is in the folder's journal at once; the same command goes on from there.

Exit codes:
  0    all scenes converged
  1    the results are written; some scene has another status, and its `reason` says why
  2    bad input: arguments, study or scene, or a journal of another study
  3    a file or the system failed; no finished scene is lost
  130  interrupted; no finished scene is lost";

const CHECK: &str = "Examples:
  slipzone check scene.toml
  slipzone check - < scene.toml

Exit codes:
  0  valid; if solving would refuse it, that is printed
  2  bad input: what is wrong, with line and column
  3  the file cannot be read";

const PLUGINS: &str = "Examples:
  slipzone plugins
  slipzone plugins cylinder
  slipzone plugins grading
  slipzone plugins grading table
  slipzone plugins --json

Exit codes:
  0  listed
  2  there is no plugin of that name
  3  standard output cannot be written";

const SCHEMA: &str = "It is made from the plugins of this program. Examples:
  slipzone schema > scene.schema.json

An editor that knows TOML schemas (taplo; in VS Code, Even Better TOML) then checks and
completes every scene that begins with the line
  #:schema ./scene.schema.json

Exit codes:
  0  printed
  3  standard output cannot be written";

const COMPLETIONS: &str = "Examples:
  slipzone completions bash > ~/.local/share/bash-completion/completions/slipzone
  slipzone completions zsh > \"${fpath[1]}/_slipzone\"
  slipzone completions fish > ~/.config/fish/completions/slipzone.fish

Exit codes:
  0  printed
  2  there is no such shell
  3  standard output cannot be written";
