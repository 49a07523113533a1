//! What no solve can do without.

use crate::{layer, measure, solve};
use criterion::{Criterion, SamplingMode};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve as substitute};
use faer::perm::PermRef;
use faer::{Mat, Par};
use slipzone::api::{Flexibility, SurfaceFlexibility};
use slipzone::engine;
use slipzone_flexibilities::ClosedForm;
use std::hint::black_box;

/// `unavoidable/SCENE/TOLERANCE`: as many closed-form flexibilities as the scene's solve evaluates, and one dense
/// factorisation of its last size with one right-hand side. `solve/SCENE/TOLERANCE` in the same run over this is what
/// the solver itself costs.
pub(crate) fn benchmarks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("unavoidable");
    group.sampling_mode(SamplingMode::Flat).sample_size(10);
    let response = ClosedForm {}.respond(&layer::graded()).expect("an exponential law on a rigid base");
    for (name, scene) in solve::judged() {
        let plan = engine::solve(&scene).plan;
        let wave_numbers = wave_numbers(plan.flexibility_evaluations);
        let mut out = vec![SurfaceFlexibility::default(); wave_numbers.len()];
        let mut system = System::new(plan.unknowns);
        let work = || format!("{} flexibility evaluations, one system of {}", wave_numbers.len(), plan.unknowns);
        measure(&mut group, &name, work, || {
            response.surface_into(black_box(&wave_numbers), &mut out).expect("served everywhere");
            system.solve()
        });
    }
    group.finish();
}

/// So many, evenly over the decades that a kernel's panels cover.
fn wave_numbers(count: usize) -> Vec<f64> {
    (0..count).map(|i| (-4.0 + 10.0 * (i as f64 + 0.5) / count as f64).exp2()).collect()
}

/// A well-conditioned system, factorised in scratch that is kept, as the engine does.
struct System {
    original: Mat<f64>,
    matrix: Mat<f64>,
    right: Mat<f64>,
    forward: Vec<usize>,
    inverse: Vec<usize>,
    scratch: MemBuffer,
}

impl System {
    fn new(n: usize) -> Self {
        // Like a Hilbert transform on nodes and on the points between them.
        let original = Mat::from_fn(n, n, |i, j| 1.0 / (i as f64 - j as f64 + 0.5));
        let factor = factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, faer::Spec::default());
        let solve = substitute::solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq);
        Self {
            matrix: original.clone(),
            original,
            right: Mat::full(n, 1, 1.0),
            forward: vec![0; n],
            inverse: vec![0; n],
            scratch: MemBuffer::new(factor.or(solve)),
        }
    }

    fn solve(&mut self) -> f64 {
        let n = self.original.nrows();
        self.matrix.copy_from(&self.original);
        self.right.fill(1.0);
        let stack = MemStack::new(&mut self.scratch);
        let (forward, inverse) = (&mut self.forward, &mut self.inverse);
        factor::lu_in_place(self.matrix.as_mut(), forward, inverse, Par::Seq, stack, faer::Spec::default());
        let order = PermRef::new_checked(forward, inverse, n);
        let factors = self.matrix.as_ref();
        substitute::solve_in_place(factors, factors, order, self.right.as_mut(), Par::Seq, stack);
        self.right[(0, 0)]
    }
}
