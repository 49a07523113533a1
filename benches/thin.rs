//! Contacts ever wider than the layer is thick.

use crate::{measure, scenes, solve::in_words};
use criterion::{Criterion, SamplingMode};
use slipzone::engine::{Status, solve};
use std::hint::black_box;

/// Half-width over thickness.
const WIDTHS: [f64; 7] = [0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0];

/// `thin/WIDTH`: the cost of a flat punch's contact may grow like the square of its width, and no faster.
pub(crate) fn benchmarks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("thin");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    for width in WIDTHS {
        let scene = scenes::thin(width);
        let work = || {
            let solution = solve(&scene);
            assert_ne!(solution.status, Status::Refused, "{width}: {:?}", solution.reason);
            in_words(&solution)
        };
        measure(&mut group, &width.to_string(), work, || solve(black_box(&scene)));
    }
    group.finish();
}
