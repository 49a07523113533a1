//! One load after another on a layer that is known.

use crate::{measure, scenes};
use criterion::{Criterion, SamplingMode};
use slipzone::api::{Friction, Positive};
use slipzone::engine::Solver;
use slipzone::scene::Load;
use std::hint::black_box;

/// `reuse/SCENE/WHAT` at the default tolerance, numbers found and no report written: `fresh` prepares the scene,
/// `load` presses a known one harder or less, `friction` rubs it otherwise.
pub(crate) fn benchmarks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("reuse");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    for (name, scene) in scenes::judged(1e-8) {
        let fresh = || {
            let mut solver = Solver::new(black_box(&scene)).expect("a bonded layer");
            solver.find().map(|()| solver)
        };
        let mut known = fresh().expect("a solution");
        let evaluations = known.solve().plan.flexibility_evaluations;
        let work = || format!("{evaluations} flexibility evaluations");
        measure(&mut group, &format!("{name}/fresh"), work, || fresh().is_ok());
        let nothing = || "no flexibility evaluation".to_owned();
        let mut forces = [positive(1.5), positive(1.9)].into_iter().cycle();
        measure(&mut group, &format!("{name}/load"), nothing, || {
            known.press(Load::Force(forces.next().expect("endless")));
            known.find().is_ok()
        });
        if scene.friction.is_some() {
            let mut coefficients = [positive(0.2), positive(0.25)].into_iter().cycle();
            measure(&mut group, &format!("{name}/friction"), nothing, || {
                known.rub(Friction::goodman(coefficients.next().expect("endless")));
                known.find().is_ok()
            });
        }
    }
    group.finish();
}

fn positive(value: f64) -> Positive {
    Positive::new(value).expect("a positive constant")
}
