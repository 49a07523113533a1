//! Where methods end: digits achieved over pairs of parameters, for each method.
//!
//! A cell is a scene, or a flexibility at a wave number. It is judged as the charts are, by an unrelated discretisation
//! or the other way to the same flexibility; a cell that calls itself converged and is off by more than three times
//! what both claim is wrong. Cells without numbers have a reason.

mod contacts;
mod flexibilities;
mod maps;

pub use maps::ALL;

use super::{Effort, Ended};
use rayon::prelude::*;
use serde::Serialize;
use std::fmt::Write;

/// A map of the atlas: two parameters and what depends on them.
#[derive(Clone, Copy, Debug)]
pub struct Map {
    /// Its name, unique.
    pub name: &'static str,
    /// What may fail there, in one line.
    pub about: &'static str,
    /// The abscissa.
    pub x: Axis,
    /// The ordinate.
    pub y: Axis,
    /// What is mapped.
    subject: Subject,
}

/// A parameter and its steps.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Axis {
    /// Its name, with its symbol.
    pub name: &'static str,
    /// Its values, from the least.
    pub values: &'static [f64],
}

/// What is mapped: a function of the two parameters.
#[derive(Clone, Copy, Debug)]
enum Subject {
    /// A contact: a scene without `[solver]`.
    Contact(fn(f64, f64) -> String),
    /// The flexibility of a scene's layer at a wave number `s h`.
    Flexibility(fn(f64, f64) -> (f64, String)),
}

/// One cell.
#[derive(Clone, Debug, Serialize)]
pub struct Cell {
    /// How it ended.
    pub ended: Ended,
    /// Called itself converged, and is off by more than it may be.
    pub wrong: bool,
    /// `-log10` of the largest relative error of a number; `None` without numbers, or without a judge.
    pub digits: Option<f64>,
    /// The largest error that it claims.
    pub claimed: Option<f64>,
    /// Why there is no number, or why it is flagged.
    pub reason: Option<String>,
}

/// A method's cells, row by row from the least of both parameters.
#[derive(Clone, Debug, Serialize)]
pub struct Mapped {
    /// The method.
    pub method: String,
    /// Whether the program chooses it by itself.
    pub is_default: bool,
    /// Its cells.
    pub cells: Vec<Cell>,
}

/// A map with its cells.
#[derive(Clone, Debug, Serialize)]
pub struct Sheet {
    /// The map's name.
    pub name: &'static str,
    /// What may fail there.
    pub about: &'static str,
    /// The abscissa.
    pub x: Axis,
    /// The ordinate.
    pub y: Axis,
    /// Each method's cells.
    pub methods: Vec<Mapped>,
}

impl Cell {
    fn lost(ended: Ended, reason: impl Into<String>) -> Self {
        Self { ended, wrong: false, digits: None, claimed: None, reason: Some(reason.into()) }
    }
}

/// Maps, on all cores; tells of each place when all methods were there, from whichever thread, and how many places
/// there are.
pub fn run(maps: &[&Map], effort: Effort, tell: &(dyn Fn(usize) + Sync)) -> Vec<Sheet> {
    crate::link_plugins();
    let maps: Vec<Map> = maps.iter().map(|map| map.reduced(effort)).collect();
    let all = maps.iter().map(|map| map.x.values.len() * map.y.values.len()).sum();
    let sheet = |map: &Map| {
        let places: Vec<(f64, f64)> =
            map.y.values.iter().flat_map(|y| map.x.values.iter().map(move |x| (*x, *y))).collect();
        // Each place by every method, so that they share a judge.
        let found: Vec<Vec<Cell>> = places
            .par_iter()
            .with_max_len(1)
            .map(|(x, y)| {
                let cells = match map.subject {
                    Subject::Contact(scene) => contacts::cells(&scene(*x, *y)),
                    Subject::Flexibility(layer) => flexibilities::cells(&layer(*x, *y)),
                };
                tell(all);
                cells
            })
            .collect();
        let names = match map.subject {
            Subject::Contact(_) => contacts::names(),
            Subject::Flexibility(_) => flexibilities::names(),
        };
        let methods = names.into_iter().enumerate().map(|(index, (method, is_default))| Mapped {
            method,
            is_default,
            cells: found.iter().map(|cells| cells[index].clone()).collect(),
        });
        Sheet { name: map.name, about: map.about, x: map.x, y: map.y, methods: methods.collect() }
    };
    maps.iter().map(sheet).collect()
}

impl Map {
    fn reduced(self, effort: Effort) -> Self {
        let few = |axis: Axis| Axis { values: &axis.values[..axis.values.len().min(2)], ..axis };
        match effort {
            Effort::Full => self,
            Effort::Quick => Self { x: few(self.x), y: few(self.y), ..self },
        }
    }
}

/// Whether nothing that the program chooses by itself claims success and is wrong.
pub fn is_sound(sheets: &[Sheet]) -> bool {
    let own = |sheet: &Sheet| sheet.methods.iter().filter(|mapped| mapped.is_default).all(|mapped| mapped.wrong() == 0);
    sheets.iter().all(own)
}

impl Mapped {
    /// Cells that claim success and are wrong.
    pub fn wrong(&self) -> usize {
        self.cells.iter().filter(|cell| cell.wrong).count()
    }
}

/// In a table: of each map and method how many cells converged, are flagged, have no numbers, and are wrong.
pub fn summary(sheets: &[Sheet]) -> String {
    let mut text = String::new();
    for sheet in sheets {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{}: {}", sheet.name, sheet.about);
        let _ = writeln!(text, "  {:32}{:>10}{:>9}{:>9}{:>7}", "", "converged", "flagged", "no digit", "wrong");
        for mapped in &sheet.methods {
            let count = |is: &dyn Fn(&Cell) -> bool| mapped.cells.iter().filter(|cell| is(cell)).count();
            let _ = writeln!(
                text,
                "  {:32}{:>10}{:>9}{:>9}{:>7}",
                mapped.method,
                count(&|cell| cell.ended == Ended::Converged),
                count(&|cell| cell.ended == Ended::Flagged),
                count(&|cell| !cell.ended.has_numbers()),
                mapped.wrong()
            );
        }
    }
    text
}
