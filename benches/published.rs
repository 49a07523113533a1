//! The published scheme on the scenes that `solve` measures.

use crate::{measure, scenes, solve::in_words};
use criterion::{Criterion, SamplingMode};
use slipzone::engine::{Status, solve};
use std::hint::black_box;

/// Scene, flexibility, cut-off and nodes: the coarsest whose every number is within 1e-6 of the truth, found by trying
/// powers of two.
const COARSEST: [(&str, &str, u32, u32); 3] = [
    ("flat", "transfer-matrix", 160, 512),
    ("flat-goodman", "transfer-matrix", 160, 512),
    ("cylinder-by-force", "transfer-matrix", 160, 512),
];

/// `published/SCENE/1e-6`, to be held against `solve/SCENE/1e-6` of the same run.
pub(crate) fn benchmarks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("published");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    for (wanted, flexibility, cutoff, n) in COARSEST {
        let solver = format!(
            "tolerance = 1e-6\nflexibility = {{ type = \"{flexibility}\" }}\n\
             kernel = {{ type = \"truncated\", cutoff = {cutoff}.0 }}\n\
             quadrature = {{ type = \"gauss-chebyshev\", n = {n} }}"
        );
        let scenes = scenes::with_solver(&solver);
        let (_, scene) = scenes.into_iter().find(|(name, _)| *name == wanted).expect("a scene of that name");
        let work = || {
            let solution = solve(&scene);
            assert_ne!(solution.status, Status::Refused, "{wanted}: {:?}", solution.reason);
            in_words(&solution)
        };
        measure(&mut group, &format!("{wanted}/1e-6"), work, || solve(black_box(&scene)));
    }
    group.finish();
}
