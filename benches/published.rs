//! The published scheme on the scenes that `solve` measures.

use crate::{measure, scenes, solve::in_words};
use criterion::{Criterion, SamplingMode};
use slipzone::engine::{Status, solve};
use std::hint::black_box;

/// Scene, cut-off and nodes: the coarsest (in steps of 80 and 128) whose every number is within 1e-6 of the truth,
/// found by trying; `1 - a/b` of the contact with friction is not, with 1024 nodes neither. The flexibility is
/// `compliance`: `transfer-matrix` refuses the cut-off of the twin that judges these, and without it leaves 4e-6 in
/// `p(0)`.
const COARSEST: [(&str, u32, u32); 3] =
    [("flat", 240, 768), ("flat-goodman", 320, 768), ("cylinder-by-force", 240, 640)];

/// `published/SCENE/1e-6`, to be held against `solve/SCENE/1e-6` of the same run.
pub(crate) fn benchmarks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("published");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    for (wanted, cutoff, n) in COARSEST {
        let solver = format!(
            "tolerance = 1e-6\nflexibility = {{ type = \"compliance\" }}\n\
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
