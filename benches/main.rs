//! What each stage costs, and a whole solve.
//!
//! * `cargo bench --bench main` measures everything, `cargo bench --bench main -- kernel` one group.
//! * `cargo bench --bench main -- --test` runs each benchmark once and measures nothing.
//!
//! Methods come from the registry: a new plugin is measured without a line here. Beside its time each
//! benchmark prints the work done, since a time means little without it: a line `work:` per benchmark,
//! not in its name, so that a change in the work done leaves old measurements comparable.
//!
//! Instructions in place of times, for a machine that is not quiet: run the binary that `cargo bench --no-run` names as
//! `valgrind --tool=callgrind --toggle-collect='*main::counted*' BINARY --test '^solve/flat$'`. That counts one run of
//! one benchmark, its tables of nodes warm. What the numbers mean is in `docs/performance.md`.

mod assembly;
mod flexibility;
mod gradings;
mod growing;
mod kernel;
mod layer;
mod methods;
mod published;
mod reuse;
mod scenes;
mod solve;
mod thin;
mod unavoidable;

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion};
use std::cell::Cell;
use std::time::Duration;

fn main() {
    slipzone::link_plugins();
    let mut criterion = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1))
        .configure_from_args();
    flexibility::benchmarks(&mut criterion);
    kernel::benchmarks(&mut criterion);
    assembly::benchmarks(&mut criterion);
    solve::benchmarks(&mut criterion);
    gradings::benchmarks(&mut criterion);
    unavoidable::benchmarks(&mut criterion);
    published::benchmarks(&mut criterion);
    reuse::benchmarks(&mut criterion);
    thin::benchmarks(&mut criterion);
    growing::benchmarks(&mut criterion);
    criterion.final_summary();
}

/// Measures `run`, and says once what work it does if this benchmark is asked for at all.
fn measure<T>(group: &mut BenchmarkGroup<WallTime>, name: &str, work: impl Fn() -> String, mut run: impl FnMut() -> T) {
    let said = Cell::new(false);
    group.bench_function(name, |bencher| {
        if !said.replace(true) {
            eprintln!("\nwork: {name}: {}", work());
        }
        bencher.iter(|| counted(&mut run));
    });
}

/// What is measured, as a function that callgrind can find.
#[inline(never)]
fn counted<T>(run: &mut impl FnMut() -> T) -> T {
    run()
}

/// Says that a method is left out: refusing is what a plugin may do, and no failure of the benchmark.
fn skip(group: &str, name: &str, refusal: &slipzone::api::Refusal) {
    eprintln!("skipped: {group}/{name}: {refusal}");
}
