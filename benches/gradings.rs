//! Whole solves on layers of every kind, beside the exponential one.

use crate::{measure, scenes, solve::in_words};
use criterion::{Criterion, SamplingMode};
use slipzone::engine::{Status, solve};
use std::hint::black_box;

/// `grading/LAYER` and `grading/LAYER/goodman`: a flat punch at the default tolerance, see [`scenes::layers`].
pub(crate) fn benchmarks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("grading");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    for (name, scene) in scenes::layers() {
        let work = || {
            let solution = solve(&scene);
            assert_eq!(solution.status, Status::Converged, "{name}: {:?}", solution.reason);
            in_words(&solution)
        };
        measure(&mut group, &name, work, || solve(black_box(&scene)));
    }
    group.finish();
}
