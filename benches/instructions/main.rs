//! Instructions of the six standard scenes, counted by valgrind; what they mean is in `docs/performance.md`.
//!
//! ```sh
//! cargo install --version 0.20.0 gungraun-runner      # and valgrind itself from the system's packages
//! cargo bench -p slipzone-instructions                # compared with the run before
//! ```
//!
//! A package of its own, and no default member: nothing else builds what it needs. Only `cargo bench` measures; as one
//! of the targets of `cargo test` it says so and ends, for neither valgrind nor the runner is a part of Rust.

#[path = "../standard.rs"]
mod standard;

// Each solve once, its tables of nodes made before by the same solve.
mod counted {
    use crate::standard;
    use gungraun::prelude::*;
    use slipzone::engine::{Solution, Status, solve};
    use slipzone::scene::Scene;
    use std::hint::black_box;

    fn warm(name: &str) -> Scene {
        slipzone::link_plugins();
        let (_, scene) = standard::scenes().into_iter().find(|(other, _)| *other == name).expect("a standard scene");
        assert_eq!(solve(&scene).status, Status::Converged, "{name}");
        scene
    }

    #[library_benchmark(setup = warm)]
    #[bench::flat("flat")]
    #[bench::flat_goodman("flat-goodman")]
    #[bench::cylinder_by_force("cylinder-by-force")]
    #[bench::growing_cylinder_goodman("growing-cylinder-goodman")]
    #[bench::thin_flat("thin-flat")]
    #[bench::table_flat("table-flat")]
    fn one_solve(scene: Scene) -> (Scene, Solution) {
        let solution = solve(black_box(&scene));
        // Given back, so that dropping them is not counted.
        (scene, solution)
    }

    library_benchmark_group!(name = standard_scenes, benchmarks = one_solve);
    gungraun::main!(library_benchmark_groups = standard_scenes);

    pub(super) fn run() {
        main();
    }
}

fn main() {
    match std::env::args().nth(1).as_deref() {
        // What cargo says, and what the runner says to the program when it runs it in turn.
        Some("--bench" | "--gungraun-run") => counted::run(),
        _ => eprintln!("instructions are counted by `cargo bench -p slipzone-instructions` alone"),
    }
}
