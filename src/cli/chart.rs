//! `slipzone chart`: speed against accuracy, and where methods end.

use super::args::Chart;
use super::named::named;
use super::output::{self, Target};
use super::{Failure, Outcome, interrupt, print, progress};
use slipzone::chart::{self, Effort, atlas};
use slipzone::report;
use std::path::{Path, PathBuf};

pub(super) fn run(arguments: &Chart) -> Result<Outcome, Failure> {
    let names = &arguments.names;
    let effort = if arguments.quick { Effort::Quick } else { Effort::Full };
    if arguments.atlas {
        let maps = named("map of the atlas", names, atlas::ALL, |map| map.name)?;
        if arguments.list {
            return list(maps.iter().map(|map| (map.name, map.about)));
        }
        let folder = folder(arguments.out.as_deref(), "atlas")?;
        let bar = progress::bar(1, "cells");
        let sheets = atlas::run(&maps, effort, &|all| {
            bar.set_length(all as u64);
            bar.inc(1);
        });
        bar.finish_and_clear();
        return finish(&folder, atlas_files(&sheets), &atlas::summary(&sheets), atlas::is_sound(&sheets));
    }
    let scenes = named("scene of the charts", names, chart::ALL, |scene| scene.name)?;
    if arguments.list {
        return list(scenes.iter().map(|scene| (scene.name, scene.about)));
    }
    let folder = folder(arguments.out.as_deref(), "chart")?;
    let bar = progress::bar(1, "solves");
    let charts = chart::run(&scenes, effort, &mut |progress| {
        bar.set_length(progress.all as u64);
        bar.set_position(progress.done as u64);
        bar.set_message(format!(" ({})", progress.scene));
    });
    bar.finish_and_clear();
    finish(&folder, chart_files(&charts), &chart::summary(&charts), chart::is_sound(&charts))
}

fn list(names: impl Iterator<Item = (&'static str, &'static str)> + Clone) -> Result<Outcome, Failure> {
    let width = names.clone().map(|(name, _)| name.len()).max().unwrap_or(0);
    let lines: Vec<String> = names.map(|(name, about)| format!("{name:width$}  {about}\n")).collect();
    print::result(&lines.concat())?;
    Ok(Outcome::Done)
}

/// Made before hours of work, so that it is known to be there.
fn folder(out: Option<&Path>, default: &str) -> Result<PathBuf, Failure> {
    if let Some(out) = out {
        output::named("--out", out, "a folder called `-` is `./-`")?;
    }
    let folder = out.map_or_else(|| PathBuf::from(default), Path::to_path_buf);
    output::make_folder(&folder)?;
    Target::new(&folder.join("index.html"))?;
    interrupt::say(|| "interrupted: nothing is written".into());
    Ok(folder)
}

fn chart_files(charts: &[chart::Chart]) -> Vec<(String, String)> {
    #[cfg_attr(not(feature = "plot"), allow(unused_mut))]
    let mut files =
        vec![("runs.csv".to_owned(), report::chart_csv(charts)), ("index.html".to_owned(), report::chart_html(charts))];
    #[cfg(feature = "plot")]
    files.extend(charts.iter().map(|chart| (format!("{}.svg", chart.scene), report::chart_svg(chart))));
    files
}

fn atlas_files(sheets: &[atlas::Sheet]) -> Vec<(String, String)> {
    #[cfg_attr(not(feature = "plot"), allow(unused_mut))]
    let mut files = vec![
        ("cells.csv".to_owned(), report::atlas_csv(sheets)),
        ("index.html".to_owned(), report::atlas_html(sheets)),
    ];
    #[cfg(feature = "plot")]
    files.extend(sheets.iter().map(|sheet| (format!("{}.svg", sheet.name), report::atlas_svg(sheet))));
    files
}

/// Writes all files, and says what is in them.
fn finish(folder: &Path, files: Vec<(String, String)>, summary: &str, is_sound: bool) -> Result<Outcome, Failure> {
    let targets = files.into_iter().map(|(name, text)| Ok((Target::new(&folder.join(name))?, text)));
    let targets = targets.collect::<Result<Vec<_>, Failure>>()?;
    output::write(&targets)?;
    interrupt::be_silent();
    print::result(&format!("{summary}{}: open index.html in a browser\n", folder.display()))?;
    Ok(if is_sound { Outcome::Done } else { Outcome::ChecksFailed })
}
