//! Kernel tables by each registered strategy.

use crate::{layer, measure, methods, skip};
use criterion::{Criterion, SamplingMode};
use slipzone::api::{Family, KernelStrategy};
use std::hint::black_box;

/// The coarsest resolution of a solve, and one at which a graded layer typically meets the default
/// tolerance.
const LEVELS: [u32; 2] = [0, 3];

/// `kernel/STRATEGY/COMPONENTS/level-LEVEL`: `normal` without friction, `all` with it.
pub(crate) fn benchmarks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("kernel");
    group.sampling_mode(SamplingMode::Flat);
    let layer = layer::graded();
    let response = layer::response(&layer);
    for (strategy, kernel) in methods::unpinned::<Box<dyn KernelStrategy>>(Family::Kernel) {
        for (what, components) in [("normal", layer::NORMAL), ("all", layer::ALL)] {
            for level in LEVELS {
                let name = format!("{strategy}/{what}/level-{level}");
                let kernel = kernel.refined(level);
                let tabulate = || kernel.tabulate(response.as_ref(), black_box(&layer::request(components)));
                match tabulate() {
                    Ok(table) => {
                        let work = || {
                            let evaluations = table.flexibility_evaluations();
                            format!("{evaluations} flexibility evaluations, {} kernels", components.len())
                        };
                        measure(&mut group, &name, work, tabulate);
                    }
                    Err(refusal) => skip("kernel", &name, &refusal),
                }
            }
        }
    }
    group.finish();
}
