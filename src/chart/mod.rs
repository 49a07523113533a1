//! Speed charted against accuracy: every quadrature with every kernel strategy, over a list of scenes that stays as it
//! is, those among it where methods fail.
//!
//! [`run`] solves each scene by each [`Method`] at each of its [`Setting`]s and measures what that took, what the solution
//! claims and how far it is off a [`Judge`]: one of two solutions by unrelated discretisations, finer than anything
//! that is charted, of which none judges its own kind. How far the two are apart is as much as can be told.
//! [`atlas`] asks where methods end: digits over pairs of parameters.
//!
//! Methods and their settings are read off the registry: a new plugin is charted without a line changed here.

pub mod atlas;
mod errors;
mod judge;
mod measure;
mod method;
mod scenes;

pub use errors::{Errors, Measured};
pub use judge::Judge;
pub use measure::{Ended, Run, Spread};
pub use method::{Method, Setting};
pub use scenes::{ALL, Charted};

use serde::Serialize;
use std::fmt::Write;

/// How thoroughly scenes are charted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Every setting, times by repetition.
    Full,
    /// Two settings of each knob and two tolerances, each once: enough to see that everything runs.
    Quick,
}

/// Where a run stands.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// The scene.
    pub scene: &'a str,
    /// Runs done, of all scenes.
    pub done: usize,
    /// Runs in all.
    pub all: usize,
}

/// A scene charted.
#[derive(Clone, Debug, Serialize)]
pub struct Chart {
    /// The scene's name.
    pub scene: &'static str,
    /// What is hard about it.
    pub about: &'static str,
    /// Its file.
    pub text: &'static str,
    /// How far both judges are apart: no error below can be told. One for each number measured.
    pub band: Errors,
    /// The judges' quadratures.
    pub judges: [String; 2],
    /// All runs, method by method.
    pub runs: Vec<Run>,
}

/// Charts scenes, one after another on one thread, so that times mean something.
pub fn run(scenes: &[&'static Charted], effort: Effort, tell: &mut dyn FnMut(Progress)) -> Vec<Chart> {
    crate::link_plugins();
    let methods = Method::all();
    let settings: Vec<Vec<Setting>> = methods.iter().map(|method| method.settings(effort)).collect();
    let each: usize = settings.iter().map(Vec::len).sum();
    let all = each * scenes.len();
    let mut charts = Vec::new();
    for (index, scene) in scenes.iter().enumerate() {
        let mut done = index * each;
        tell(Progress { scene: scene.name, done, all });
        let judges = judge::pair(scene);
        let mut runs = Vec::new();
        for (method, settings) in methods.iter().zip(&settings) {
            // Settings come in series, the coarsest first: what follows one that took too long would take longer.
            let mut too_long = None;
            for setting in settings {
                let run = match too_long {
                    Some(series) if series == setting.series => Run::not_tried(method, setting),
                    _ => measure::measure(scene, method, setting, &judges, effort),
                };
                if run.ended == Ended::TooLong {
                    too_long = Some(setting.series);
                }
                runs.push(run);
                done += 1;
                tell(Progress { scene: scene.name, done, all });
            }
        }
        charts.push(Chart {
            scene: scene.name,
            about: scene.about,
            text: scene.text,
            band: judge::apart(&judges),
            judges: judges.map(|judge| judge.quadrature.to_owned()),
            runs,
        });
    }
    charts
}

/// Whether nothing that the program chooses by itself claims success and is wrong.
pub fn is_sound(charts: &[Chart]) -> bool {
    charts.iter().flat_map(|chart| &chart.runs).all(|run| !run.wrong || run.method.quadrature.is_some())
}

/// In a table: of each scene how far the judges are apart, and how its runs ended.
pub fn summary(charts: &[Chart]) -> String {
    let mut text = format!(
        "{:22}{:>12}{:>11}{:>9}{:>11}{:>7}\n",
        "scene", "judges agree", "converged", "flagged", "no number", "wrong"
    );
    for chart in charts {
        let count = |is: &dyn Fn(&Run) -> bool| chart.runs.iter().filter(|run| is(run)).count();
        let band = chart.band.worst().map_or_else(|| "never".into(), |band| format!("to {band:.0e}"));
        // Writing to a string does not fail.
        let _ = writeln!(
            text,
            "{:22}{:>12}{:>11}{:>9}{:>11}{:>7}",
            chart.scene,
            band,
            count(&|run| run.ended == Ended::Converged),
            count(&|run| run.ended == Ended::Flagged),
            count(&|run| !run.ended.has_numbers()),
            count(&|run| run.wrong)
        );
    }
    text
}
