//! Contacts that grow, under friction.

use crate::{measure, scenes};
use criterion::{Criterion, SamplingMode};
use slipzone::api::Positive;
use slipzone::engine::Solver;
use slipzone::scene::{Load, LoadPath};
use std::hint::black_box;

/// `growing/WHAT` at the default tolerance under Goodman friction: `fresh` prepares a cylinder on a new layer, `report`
/// writes its result, `load` presses it otherwise, `wedge` presses another punch on the layer known, `curve` follows 60
/// loads.
pub(crate) fn benchmarks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("growing");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    let [cylinder, wedge] = scenes::growing();
    let fresh = || {
        let mut solver = Solver::new(black_box(&cylinder)).expect("a bonded layer");
        solver.find().map(|()| solver)
    };
    let mut known = fresh().expect("a solution");
    let plan = known.solve().plan;
    let work =
        || format!("{} flexibility evaluations, {} factorisations", plan.flexibility_evaluations, plan.factorisations);
    measure(&mut group, "fresh", work, || fresh().is_ok());
    let nothing = || "no flexibility evaluation".to_owned();
    measure(&mut group, "report", nothing, || known.solve());
    let mut widths = [0.9, 0.8].into_iter().map(positive).cycle();
    measure(&mut group, "load", nothing, || {
        known.press(Load::HalfWidth(widths.next().expect("endless")));
        known.find().is_ok()
    });
    let mut layer = Some(known.into_layer());
    measure(&mut group, "wedge", nothing, || {
        let mut solver = Solver::on(layer.take().expect("put back"), &wedge).expect("the same layer");
        let found = solver.find().is_ok();
        layer = Some(solver.into_layer());
        found
    });
    let mut solver = fresh().expect("a solution");
    let loads = LoadPath::until(Load::HalfWidth(positive(1.0)), 60).expect("sixty loads");
    measure(&mut group, "curve", || "60 points, the last solved as well".to_owned(), || solver.curve(&loads));
    group.finish();
}

fn positive(value: f64) -> Positive {
    Positive::new(value).expect("a positive constant")
}
