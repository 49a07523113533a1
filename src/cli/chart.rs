//! `slipzone chart`: speed against accuracy, and where methods end.

use super::args::Chart;
use super::named::named;
use super::output::{self, Target};
use super::{Failure, Outcome, interrupt, print, progress};
use crate::chart::{self, Effort, atlas};
use crate::report;
use std::path::{Path, PathBuf};

pub(super) fn run(arguments: &Chart) -> Result<Outcome, Failure> {
    let names = &arguments.names;
    let effort = if arguments.quick { Effort::Quick } else { Effort::Full };
    if arguments.atlas {
        let maps = named("map of the atlas", names, atlas::ALL, |map| map.name)?;
        if arguments.list {
            return list(maps.iter().map(|map| (map.name, map.about)));
        }
        let place = Place::new(arguments.out.as_deref(), "atlas", "cells.csv", maps.iter().map(|map| map.name))?;
        let bar = progress::bar(1, "cells");
        let sheets = atlas::run(&maps, effort, &|all| {
            bar.set_length(all as u64);
            bar.inc(1);
        });
        bar.finish_and_clear();
        return place.fill(of_atlas(&sheets), &atlas::summary(&sheets), atlas::is_sound(&sheets));
    }
    let scenes = named("scene of the charts", names, chart::ALL, |scene| scene.name)?;
    if arguments.list {
        return list(scenes.iter().map(|scene| (scene.name, scene.about)));
    }
    let place = Place::new(arguments.out.as_deref(), "chart", "runs.csv", scenes.iter().map(|scene| scene.name))?;
    let bar = progress::bar(1, "solves");
    let charts = chart::run(&scenes, effort, &mut |progress| {
        bar.set_length(progress.all as u64);
        bar.set_position(progress.done as u64);
        bar.set_message(format!(" ({})", progress.scene));
    });
    bar.finish_and_clear();
    place.fill(of_charts(&charts), &chart::summary(&charts), chart::is_sound(&charts))
}

fn list(names: impl Iterator<Item = (&'static str, &'static str)> + Clone) -> Result<Outcome, Failure> {
    let width = names.clone().map(|(name, _)| name.len()).max().unwrap_or(0);
    let lines: Vec<String> = names.map(|(name, about)| format!("{name:width$}  {about}\n")).collect();
    print::result(&lines.concat())?;
    Ok(Outcome::Done)
}

/// Where the results go.
struct Place {
    folder: PathBuf,
    /// A table, a page and a figure of each map or scene.
    targets: Vec<Target>,
}

impl Place {
    /// Made before hours of work, so that everything can be written after them.
    fn new(
        out: Option<&Path>,
        default: &str,
        table: &str,
        names: impl Iterator<Item = &'static str>,
    ) -> Result<Self, Failure> {
        if let Some(out) = out {
            output::named("--out", out, "a folder called `-` is `./-`")?;
        }
        let folder = out.map_or_else(|| PathBuf::from(default), Path::to_path_buf);
        output::make_folder(&folder)?;
        let figures = names.filter(|_| cfg!(feature = "plot")).map(|name| format!("{name}.svg"));
        let files = [table, "index.html"].map(str::to_owned).into_iter().chain(figures);
        let files: Vec<_> = files.map(|name| (name.clone(), folder.join(name))).collect();
        output::apart(&files.iter().map(|(name, path)| (name.as_str(), path.as_path())).collect::<Vec<_>>())?;
        let targets = files.iter().map(|(_, path)| Target::new(path)).collect::<Result<_, _>>()?;
        interrupt::say(|| "interrupted: nothing is written".into());
        Ok(Self { folder, targets })
    }

    /// Writes all files, and says what is in them.
    fn fill(self, texts: Vec<String>, summary: &str, is_sound: bool) -> Result<Outcome, Failure> {
        output::write(&self.targets.into_iter().zip(texts).collect::<Vec<_>>())?;
        interrupt::be_silent();
        print::result(&format!("{summary}{}: open index.html in a browser\n", self.folder.display()))?;
        Ok(if is_sound { Outcome::Done } else { Outcome::Failed })
    }
}

fn of_charts(charts: &[chart::Chart]) -> Vec<String> {
    #[cfg_attr(not(feature = "plot"), allow(unused_mut))]
    let mut texts = vec![report::chart_csv(charts), report::chart_html(charts)];
    #[cfg(feature = "plot")]
    texts.extend(charts.iter().map(report::chart_svg));
    texts
}

fn of_atlas(sheets: &[atlas::Sheet]) -> Vec<String> {
    #[cfg_attr(not(feature = "plot"), allow(unused_mut))]
    let mut texts = vec![report::atlas_csv(sheets), report::atlas_html(sheets)];
    #[cfg(feature = "plot")]
    texts.extend(sheets.iter().map(report::atlas_svg));
    texts
}
