//! All scenes of a study, solved on all cores.

use super::record::Record;
use super::{Study, inverse};
use crate::caught::caught;
use crate::engine::{Solution, Solver, solve};
use crate::scene::Scene;
use rayon::iter::{ParallelBridge, ParallelIterator};
use std::ops::ControlFlow;
use std::sync::mpsc::sync_channel;

/// Records that may wait to be taken.
const WAITING: usize = 1024;

/// Solves each scene of a study that is not `done` yet, on all cores, and gives the records to `take` as they are
/// found, nearly in order, until that breaks off.
///
/// Scenes that share a layer share its tables. Which ones do is decided by the study alone: a record has the same bits
/// whatever the number of threads, and whatever was done before.
pub fn sweep(study: &Study, done: &(dyn Fn(u64) -> bool + Sync), mut take: impl FnMut(Record) -> ControlFlow<()>) {
    let (sender, receiver) = sync_channel(WAITING);
    std::thread::scope(|scope| {
        scope.spawn(move || {
            // Of a range bridged, chunks are taken in order.
            let _ = (0..study.chunks()).par_bridge().try_for_each_with(sender, |sender, chunk| {
                solve_chunk(study, chunk, done, |record| sender.send(record).ok())
            });
        });
        // Dropped when it breaks off: then the senders stop, too.
        let _ = receiver.into_iter().try_for_each(&mut take);
    });
}

/// Solves the scenes of a chunk that are not done, and those before them, whose tables they share; answers share none.
fn solve_chunk(
    study: &Study,
    chunk: u64,
    done: &(dyn Fn(u64) -> bool + Sync),
    send: impl Fn(Record) -> Option<()>,
) -> Option<()> {
    let rows = study.chunk_rows(chunk);
    let Some(last) = rows.clone().rev().find(|row| !done(*row)) else { return Some(()) };
    let mut known = None;
    for row in rows.start..=last {
        if study.find.is_some() && done(row) {
            continue;
        }
        let record = caught(|| solve_row(study, row, known.take()));
        // What comes after a panic knows nothing of what was before it.
        let (record, solver) = record.unwrap_or_else(|why| (Record::panicked(study, row, why), None));
        known = solver;
        if !done(row) {
            send(record)?;
        }
    }
    Some(())
}

/// The record of a scene, from what is known of the one before it, and what the next may know.
fn solve_row(study: &Study, row: u64, known: Option<Solver>) -> (Record, Option<Solver>) {
    match (&study.find, study.scene(row)) {
        (Some(find), Ok(_)) => (inverse::answer(study, row, find), None),
        (None, Ok(scene)) => {
            let only_pressed = known.is_some() && study.differ_in_load(row - 1, row);
            let (solution, solver) = solve_after(known, &scene, only_pressed);
            (Record::solved(study, row, solution), solver)
        }
        // What comes next differs from what is known by more than from this.
        (_, Err(error)) => (Record::invalid(study, row, &error), None),
    }
}

/// Solves a scene with what is known of the one before it on the same layer: all, where it is only pressed or rubbed
/// otherwise, or the layer.
fn solve_after(known: Option<Solver>, scene: &Scene, only_pressed: bool) -> (Solution, Option<Solver>) {
    let prepared = match known {
        Some(mut solver) if only_pressed => {
            solver.press(scene.load);
            if let Some(friction) = scene.friction {
                solver.rub(friction);
            }
            Ok(solver)
        }
        Some(solver) => Solver::on(solver.into_layer(), scene),
        None => Solver::new(scene),
    };
    match prepared {
        Ok(mut solver) => {
            let solution = solver.solve();
            (solution, Some(solver))
        }
        // Of another layer, or refused: by itself it says which.
        Err(_) => (solve(scene), None),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An answer takes dozens of scenes, and so their allocations.
    #[test]
    fn what_was_answered_is_not_asked_again() {
        let study = "format = 1\nscene = { format = 1, layer = { thickness = 5.0, poisson = 0.3, \
             grading = { type = \"homogeneous\", modulus = 1.0 } }, punch = { type = \"flat\", half_width = 1.0 }, \
             load = { force = 1.0 }, solver = { tolerance = 1e-4 } }\n\
             [[axes]]\nfield = \"load.force\"\nlinear = { from = 1.0, to = 1.31, count = 32 }\n\
             [find]\nfield = \"layer.thickness\"\nfrom = 2.0\nto = 4.0\nquantity = \"edge.ratio\"\nminimum = true\n";
        let study = Study::parse("study.toml", study, &slipzone_api::NoFiles).unwrap();
        let counted = |done: &(dyn Fn(u64) -> bool + Sync)| {
            allocation_counter::measure(|| solve_chunk(&study, 0, done, |_| Some(())).unwrap()).count_total
        };
        assert_eq!(study.chunk_rows(0), 0..2);
        let (both, one) = (counted(&|_| false), counted(&|row| row == 0));
        assert!(4 * one < 3 * both, "{one} of {both}");
    }
}
