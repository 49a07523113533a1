//! Studies: many scenes that differ in a few fields.
//!
//! [`Study::parse`] reads one, [`Study::scene`] makes each of its scenes, [`sweep`] solves them all. The format is in
//! `docs/studies.md`.

mod axis;
mod chunks;
mod files;
mod find;
mod inverse;
mod plot;
mod read;
mod record;
mod shown;
mod sweep;

pub use axis::{Axis, Cell, Column};
pub use find::{Find, Wanted};
pub use plot::{Line, OneOrMore, Over, Plot, PlotKind, Points, Scale};
pub(crate) use record::{ANSWER, at};
pub use record::{Found, Record, RecordStatus};
#[cfg(feature = "plot")]
pub(crate) use shown::{FOUND, Place, Shown, Source, in_one_line};
pub use sweep::sweep;

use crate::scene::{Asked, Replacement, Scene, SceneError, Template};
use files::Kept;
use slipzone_api::Files;
use std::fmt::Write;

/// Most scenes of one study.
pub const LARGEST_STUDY: u64 = 1_000_000_000;

/// A base scene and what changes in it.
///
/// ```
/// let study = slipzone::study::Study::parse("study.toml", r#"
///     format = 1
///     [scene]
///     format = 1
///     layer = { thickness = 5.0, poisson = 0.3, grading = { type = "exponential", surface = 1.0, base = 8.0 } }
///     punch = { type = "flat", half_width = 1.0 }
///     friction = { type = "goodman", coefficient = 0.3 }
///     load = { force = 1.0 }
///     [[axes]]
///     field = "friction.coefficient"
///     log = { from = 0.1, to = 1.0, count = 5 }
/// "#, &slipzone::api::NoFiles).unwrap();
/// assert_eq!(study.rows(), 5);
/// let mut ratios = Vec::new();
/// slipzone::study::sweep(&study, &|_| false, |record| {
///     ratios.push((record.index, record.number("stick.ratio").unwrap()));
///     std::ops::ControlFlow::Continue(())
/// });
/// ratios.sort_by_key(|(index, _)| *index);
/// assert!(ratios.is_sorted_by_key(|(_, ratio)| *ratio), "more friction, more stick");
/// ```
#[derive(Debug)]
pub struct Study {
    /// One line that names the study in figures.
    pub title: Option<String>,
    /// What changes, as the study lists it.
    pub axes: Vec<Axis>,
    /// Figures of the results.
    pub plots: Vec<Plot>,
    /// An inverse question to each scene.
    pub find: Option<Find>,
    base: Template,
    /// The base scene.
    pub scene: Scene,
    files: Kept,
    /// Whether tractions are asked for though no figure needs them.
    tractions: bool,
}

impl Study {
    /// Reads and checks a study; `name` is what errors call the text, and files that it names come from `files`.
    ///
    /// # Errors
    /// The first thing that is wrong, with its line in the study or in the scene that it names.
    pub fn parse(name: &str, text: &str, files: &dyn Files) -> Result<Self, SceneError> {
        crate::link_plugins();
        if text.len() > crate::scene::LARGEST {
            return Err(crate::scene::too_large("study", name));
        }
        read::study(name, text, files)
    }

    /// How many scenes there are.
    pub fn rows(&self) -> u64 {
        self.axes.iter().map(|axis| axis.count).product()
    }

    /// The fields that change, in the order in which the study lists them.
    pub fn columns(&self) -> impl Iterator<Item = &Column> {
        self.axes.iter().flat_map(|axis| &axis.columns)
    }

    /// The values of those fields in one scene.
    pub fn cells(&self, row: u64) -> Vec<Cell> {
        let steps = self.steps(row);
        let cells = |(axis, step): (&Axis, u64)| axis.columns.iter().map(|c| c.cell(step)).collect::<Vec<_>>();
        self.axes.iter().zip(steps).flat_map(cells).collect()
    }

    /// One of the scenes.
    ///
    /// # Errors
    /// When its values make no scene together; the error has no place.
    pub fn scene(&self, row: u64) -> Result<Scene, SceneError> {
        self.made(self.chosen(row), None, &self.files)
    }

    /// The scene with one more value set.
    pub(crate) fn scene_where(&self, row: u64, more: Replacement) -> Result<Scene, SceneError> {
        self.made(self.chosen(row), Some(more), &self.files)
    }

    /// The scene of a record: with what was found, where the study looks for something.
    ///
    /// # Errors
    /// As of [`Self::scene`].
    #[cfg(feature = "plot")]
    pub(crate) fn scene_answered(&self, row: u64, found: Option<f64>) -> Result<Scene, SceneError> {
        match self.find.as_ref().map(Find::path).zip(found) {
            Some((path, found)) => self.scene_where(row, Replacement::number(&path, found)),
            None => self.scene(row),
        }
    }

    /// The steps of the axes in one scene.
    fn chosen(&self, row: u64) -> impl Iterator<Item = (&Axis, u64)> {
        self.axes.iter().zip(self.steps(row))
    }

    /// The base scene with some axes at given steps.
    fn made<'a>(
        &self,
        steps: impl Iterator<Item = (&'a Axis, u64)>,
        more: Option<Replacement>,
        files: &dyn Files,
    ) -> Result<Scene, SceneError> {
        let columns = steps.flat_map(|(axis, step)| axis.columns.iter().map(move |column| (column, step)));
        let replaced = columns.map(|(column, step)| Replacement { path: &column.path, value: column.toml(step) });
        let replaced: Vec<Replacement> = replaced.chain(more).collect();
        let mut scene = self.base.with(&replaced, files)?;
        // A record holds one contact.
        scene.path = None;
        scene.output.quantities.get_or_insert_with(|| self.quantities());
        Ok(scene)
    }

    /// What is asked for where the scene leaves it open: all numbers, and tractions where there is a use for them.
    fn quantities(&self) -> Vec<Asked> {
        let draws = self.plots.iter().any(|plot| plot.kind == PlotKind::Tractions);
        let tractions = (draws || self.tractions || self.scene.output.strain).then_some("profile");
        ["load", "pressure", "edge", "stick"].into_iter().chain(tractions).filter_map(Asked::named).collect()
    }

    /// Asks for tractions as a figure of them does, unless the scene says what it asks for: records that were made when
    /// there was one have them.
    pub fn ask_for_tractions(&mut self) {
        self.tractions = true;
    }

    /// Whether what stands at a path of a result is asked for.
    pub fn asks(&self, path: &str) -> bool {
        match &self.scene.output.quantities {
            Some(_) => self.scene.output.asks(path),
            None => self.quantities().iter().any(|asked| asked.covers(path)),
        }
    }

    /// What decides the records, and nothing else, in lines that can be compared: two studies with the same description
    /// have the same results.
    pub fn description(&self) -> String {
        let mut text = String::new();
        // Writing to a string does not fail.
        let _ = writeln!(text, "program = {}", env!("CARGO_PKG_VERSION"));
        self.base.text().lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#')).for_each(
            |line| {
                let _ = writeln!(text, "scene: {line}");
            },
        );
        for (name, bytes) in &self.files.0 {
            let _ = writeln!(text, "file {name}: {} bytes, checksum {:016x}", bytes.len(), checksum(bytes));
        }
        for column in self.columns() {
            let _ = writeln!(text, "axis {}: {}", column.field, column.described());
            if let Some(names) = column.names() {
                let _ = writeln!(text, "names of {}: {names}", column.field);
            }
        }
        for (index, axis) in self.axes.iter().enumerate() {
            let labels: Vec<&str> = axis.columns.iter().map(|column| column.label.as_str()).collect();
            let _ = writeln!(text, "axis {index} = {labels:?} x {}", axis.count);
        }
        let _ = writeln!(text, "tractions = {}", self.asks("profile"));
        if let Some(find) = &self.find {
            let _ = writeln!(text, "find: {}", find.described());
        }
        text
    }
}

/// Fowler, Noll and Vo's hash (FNV-1a, 64 bits): tells files apart, not more.
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}
