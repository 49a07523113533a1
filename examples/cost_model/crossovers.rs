//! Where one way overtakes another.

use crate::{scenes, shortest};
use slipzone::engine;
use slipzone::scene::Model;
use std::hint::black_box;

/// Largest ratio of two lengths in a scene.
const FURTHEST: f64 = 1e9;

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
            let cheaper = "forbid = [\"half-plane\", \"corrected-half-plane\"]";
            let forbid = if model == Model::Homogeneous { cheaper } else { "" };
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

/// The least value above 1 for which something holds, to a part in a thousand; `None` where that is further than scenes
/// go.
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
