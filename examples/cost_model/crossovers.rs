//! Where one way overtakes another.

use crate::{scenes, shortest};
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve as substitute};
use faer::{Mat, Par};
use slipzone::engine;
use slipzone::scene::Model;
use std::hint::black_box;

// The engine's own, which no other crate sees.
#[path = "../../src/engine/elimination.rs"]
mod elimination;

/// Systems in a row of which one time is taken.
const SYSTEMS: usize = 50;
/// Largest ratio of two lengths in a scene.
const FURTHEST: f64 = 1e9;

/// Elimination row by row over factorisation in blocks.
pub(crate) fn systems() {
    println!("\nOne system, one right-hand side:\n\n| equations | row by row over in blocks |\n|---|---|");
    for n in [12, 17, 23, 32, 33, 46, 64, 65, 80, 91, 96, 128, 129, 182, 257] {
        // Like a Hilbert transform on nodes and on the points between them.
        let entry = |i: usize, j: usize| 1.0 / (i as f64 - j as f64 + 0.5);
        let whole: Vec<f64> = (0..n * n).map(|at| entry(at / n, at % n)).collect();
        let (mut rows, mut right) = (whole.clone(), vec![1.0; n]);
        let mut row_by_row = || {
            for _ in 0..SYSTEMS {
                rows.copy_from_slice(black_box(&whole));
                right.fill(1.0);
                elimination::solve(&mut rows, &mut right, n);
            }
        };
        let original = Mat::from_fn(n, n, entry);
        let (mut matrix, mut column) = (original.clone(), Mat::full(n, 1, 1.0));
        let (mut forward, mut inverse) = (vec![0_usize; n], vec![0_usize; n]);
        let room = factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, faer::Spec::default())
            .or(substitute::solve_in_place_scratch::<usize, f64>(n, 1, Par::Seq));
        let mut room = MemBuffer::new(room);
        let mut in_blocks = || {
            for _ in 0..SYSTEMS {
                matrix.copy_from(black_box(&original));
                column.fill(1.0);
                let (_, order) = factor::lu_in_place(
                    matrix.as_mut(),
                    &mut forward,
                    &mut inverse,
                    Par::Seq,
                    MemStack::new(&mut room),
                    faer::Spec::default(),
                );
                let (lower, upper) = (matrix.as_ref(), matrix.as_ref());
                substitute::solve_in_place(lower, upper, order, column.as_mut(), Par::Seq, MemStack::new(&mut room));
            }
        };
        let both: &mut [&mut dyn FnMut()] = &mut [&mut row_by_row, &mut in_blocks];
        let times = shortest(both);
        println!("| {n} | {:.2} |", times[0] / times[1]);
    }
}

/// The thickness of a layer whose contact has the half-width 1, by the ratio of the two, one way or the other.
type Thickness<'a> = &'a dyn Fn(&f64) -> f64;

/// From which thickness on the planner takes a model, and by how much that is faster there.
pub(crate) fn models() {
    const SOFTENING: &str = "{ type = \"exponential\", surface = 1.0, base = 0.125 }";
    const LINEAR: &str = "{ type = \"linear\", surface = 1.0, base = 8.0 }";
    const HOMOGENEOUS: &str = "{ type = \"homogeneous\", modulus = 1.0 }";
    const RIGHT: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6];
    let half_plane = |thickness: &f64| *thickness;
    let thin = |width: &f64| width.recip();
    println!("\n| model | layer, punch | ratio | {} | exponent |", RIGHT.map(|t| format!("{t:e}")).join(" | "));
    println!("|---|---|---|{}---|", "---|".repeat(RIGHT.len()));
    let cases: [(Model, &str, &str, &str, Thickness, &str); 5] = [
        (Model::HalfPlane, "homogeneous", HOMOGENEOUS, "flat", &half_plane, "h/b"),
        (Model::HalfPlane, "exponential", SOFTENING, "flat", &half_plane, "h/b"),
        (Model::HalfPlane, "linear", LINEAR, "flat", &half_plane, "h/b"),
        (Model::Homogeneous, "linear", LINEAR, "flat", &half_plane, "h/b"),
        (Model::Thin, "exponential", SOFTENING, "cylinder", &thin, "b/h"),
    ];
    for (model, name, grading, punch, thickness, ratio) in cases {
        let takes = |x: f64, tolerance: f64| {
            let forbid = if model == Model::Homogeneous { "forbid = [\"half-plane\"]" } else { "" };
            let scene = scenes::open(thickness(&x), punch, grading, tolerance, forbid);
            engine::solve(&scene).plan.model == model
        };
        let found = RIGHT.map(|tolerance| first(|x| takes(x, tolerance)).map(|x| (tolerance, x)));
        let cells = found.map(|found| match found {
            Some((tolerance, x)) => {
                let of = |forced: &str| scenes::open(thickness(&x), punch, grading, tolerance, forced);
                let (full, chosen) = (of("model = \"full\""), of(&format!("model = \"{}\"", model.name())));
                let times = shortest(&mut [full, chosen].map(|scene| move || drop(black_box(engine::solve(&scene)))));
                format!("{x:.3e} ({:.1})", times[0] / times[1])
            }
            None => "-".into(),
        });
        let points: Vec<(f64, f64)> = found.into_iter().flatten().collect();
        let exponent = if points.len() > 1 { format!("{:.2}", crate::slope(&points)) } else { "-".into() };
        println!("| `{}` | {name}, {punch} | `{ratio}` | {} | {exponent} |", model.name(), cells.join(" | "));
    }
}

/// The least value above 1 for which something holds, to a part in a thousand; `None` where that is further than scenes go.
fn first(holds: impl Fn(f64) -> bool) -> Option<f64> {
    let (mut low, mut high) = (1.0, 1.0);
    while !holds(high) {
        low = high;
        high = f64::min(4.0 * high, FURTHEST);
        if low == FURTHEST {
            return None;
        }
    }
    while high / low > 1.001 {
        let middle = f64::sqrt(low * high);
        if holds(middle) { high = middle } else { low = middle }
    }
    Some(high)
}
