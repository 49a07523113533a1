//! Rows of the operator by each registered quadrature.

use crate::{layer, measure, methods, skip};
use criterion::{Criterion, Throughput};
use slipzone::api::{Component, Edge, Family, KernelStrategy, Parity, Quadrature, Refusal, Rule, Span};
use slipzone_kernels::Truncated;
use std::hint::black_box;

/// Nodes over the whole contact; symmetry halves the unknowns.
const SIZES: [usize; 3] = [32, 64, 128];

/// `assembly/QUADRATURE/PARTS/NODES`: `cauchy` as on a half-plane, `kernel` as on a layer. Each by the
/// coarsest refinement that has at least that many nodes; the throughput is per matrix entry.
pub(crate) fn benchmarks(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("assembly");
    let layer = layer::graded();
    let table = Truncated::default()
        .tabulate(layer::response(&layer).as_ref(), &layer::request(layer::NORMAL))
        .expect("a contact narrower than the layer is thick");
    for (scheme, quadrature) in methods::unpinned::<Box<dyn Quadrature>>(Family::Quadrature) {
        for (what, kernel) in [("cauchy", None), ("kernel", Some((table.as_ref(), Component::NormalSlope)))] {
            for size in SIZES {
                let name = format!("{scheme}/{what}/{size}");
                let mut rule = match rule(quadrature.as_ref(), size) {
                    Ok(rule) => rule,
                    Err(refusal) => {
                        skip("assembly", &name, &refusal);
                        continue;
                    }
                };
                let (equations, unknowns) = (rule.collocation().len(), rule.unknowns());
                let mut rows = vec![0.0; equations * unknowns];
                group.throughput(Throughput::Elements(rows.len() as u64));
                let work = || format!("{unknowns} unknowns, {equations} equations");
                measure(&mut group, &name, work, || rule.operator_into(black_box(kernel), &mut rows));
            }
        }
    }
    group.finish();
}

/// The pressure under a flat punch on at least that many nodes.
fn rule(quadrature: &dyn Quadrature, nodes: usize) -> Result<Box<dyn Rule>, Refusal> {
    let span = Span::symmetric(layer::HALF_WIDTH, Parity::Even, Edge::Sharp);
    let mut level = 0;
    loop {
        let rule = quadrature.refined(level).rule(&span)?;
        if 2 * rule.unknowns() >= nodes {
            return Ok(rule);
        }
        level += 1;
    }
}
