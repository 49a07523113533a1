//! Whole solves.

use crate::{measure, scenes};
use criterion::{Criterion, SamplingMode};
use slipzone::engine::{Solution, Status, solve};
use slipzone::scene::Scene;
use std::hint::black_box;

/// Tolerances beside the default one.
pub(crate) const TOLERANCES: [f64; 3] = [1e-4, 1e-6, 1e-10];

/// `solve/SCENE` at the default tolerance and `solve/SCENE/TOLERANCE`, see [`scenes`].
pub(crate) fn benchmarks(criterion: &mut Criterion) {
    whole(criterion, "solve", all());
}

/// Solves of scenes, each of which must converge.
pub(crate) fn whole(criterion: &mut Criterion, group: &str, scenes: Vec<(String, Scene)>) {
    let mut group = criterion.benchmark_group(group);
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    for (name, scene) in scenes {
        let work = || {
            let solution = solve(&scene);
            assert_eq!(solution.status, Status::Converged, "{name}: {:?}", solution.reason);
            in_words(&solution)
        };
        measure(&mut group, &name, work, || solve(black_box(&scene)));
    }
    group.finish();
}

/// Every scene at the default tolerance, those that are judged at the others too.
fn all() -> Vec<(String, Scene)> {
    let default = scenes::all().into_iter().map(|(name, scene)| (name.to_owned(), scene));
    default.chain(judged()).collect()
}

/// `SCENE/TOLERANCE`.
pub(crate) fn judged() -> impl Iterator<Item = (String, Scene)> {
    TOLERANCES.into_iter().flat_map(|tolerance| {
        scenes::judged(tolerance).into_iter().map(move |(name, scene)| (format!("{name}/{tolerance:e}"), scene))
    })
}

pub(crate) fn in_words(Solution { plan, error, .. }: &Solution) -> String {
    format!(
        "{} unknowns at last, {} flexibility evaluations and {} factorisations in all, error estimate {:.0e}",
        plan.unknowns,
        plan.flexibility_evaluations,
        plan.factorisations,
        error.estimate.unwrap_or(f64::NAN)
    )
}
