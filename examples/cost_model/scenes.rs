//! Scenes of the cost model.

use slipzone::scene::{Scene, parse};

/// A layer eight times as stiff at its base, a contact of half-width 1.
pub(crate) fn graded(thickness: f64, punch: &str, friction: bool, solver: &str) -> Scene {
    let layer = format!(
        "thickness = {thickness:?}\ngrading = {{ type = \"exponential\", surface = 1.0, base = 8.0 }}\npoisson = 0.3"
    );
    scene(&layer, punch, friction, solver, "")
}

/// A stack of homogeneous sublayers five half-widths thick, together eight times as stiff at the base.
pub(crate) fn stack(count: i32, first: Option<f64>) -> Scene {
    let share = 5.0 / f64::from(count);
    let (top, rest) = first.map_or((share, share), |first| (first, (5.0 - first) / f64::from(count - 1)));
    let sublayer = |i: i32| {
        let thickness = if i == 0 { top } else { rest };
        let modulus = 8.0_f64.powf((f64::from(i) + 0.5) / f64::from(count));
        format!("{{ thickness = {thickness:?}, grading = {{ type = \"homogeneous\", modulus = {modulus:?} }} }}")
    };
    let sublayers = (0..count).map(sublayer).collect::<Vec<_>>().join(", ");
    let layer = format!("poisson = 0.3\ngrading = {{ type = \"stack\", layers = [{sublayers}] }}");
    scene(&layer, "flat", false, "", "")
}

/// A scene whose model the planner may choose: all numbers but the depth and the tractions, or the model given.
pub(crate) fn open(thickness: f64, punch: &str, grading: &str, tolerance: f64, forced: &str) -> Scene {
    let layer = format!("thickness = {thickness:?}\npoisson = 0.3\ngrading = {grading}");
    let solver = format!("tolerance = {tolerance:e}\n{forced}");
    scene(&layer, punch, false, &solver, "[output]\nquantities = [\"load.force\", \"load.half_width\", \"pressure\"]")
}

fn scene(layer: &str, punch: &str, friction: bool, solver: &str, output: &str) -> Scene {
    let (punch, load) = match punch {
        "flat" => ("type = \"flat\"\nhalf_width = 1.0", "force = 1.0"),
        _ => ("type = \"cylinder\"\nradius = 10.0", "half_width = 1.0"),
    };
    let friction = if friction { "[friction]\ntype = \"goodman\"\ncoefficient = 0.3" } else { "" };
    let text = format!(
        "format = 1\n[layer]\n{layer}\n[punch]\n{punch}\n{friction}\n[load]\n{load}\n[solver]\n{solver}\n{output}\n"
    );
    parse("cost_model.toml", &text).unwrap_or_else(|error| panic!("{error}"))
}
