//! Whole solves at the default tolerance.

use crate::{measure, scenes};
use criterion::{Criterion, SamplingMode};
use slipzone::engine::{Solution, Status, solve};
use std::hint::black_box;

/// `solve/SCENE`, see [`scenes`].
pub(crate) fn benchmarks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("solve");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    for (name, scene) in scenes::all() {
        let work = || {
            let solution = solve(&scene);
            assert_eq!(solution.status, Status::Converged, "{name}: {:?}", solution.reason);
            in_words(&solution)
        };
        measure(&mut group, name, work, || solve(black_box(&scene)));
    }
    group.finish();
}

fn in_words(Solution { plan, error, .. }: &Solution) -> String {
    format!(
        "{} unknowns at last, {} flexibility evaluations and {} factorisations in all, error estimate {:.0e}",
        plan.unknowns,
        plan.flexibility_evaluations,
        plan.factorisations,
        error.estimate.unwrap_or(f64::NAN)
    )
}
