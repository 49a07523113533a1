//! Named scenes: one per path through a solve.

use slipzone::scene::{Scene, parse};

/// A layer eight times as stiff at its base, five half-widths thick.
const LAYER: &str = r#"
[layer]
thickness = 5.0
poisson = 0.3
grading = { type = "exponential", surface = 1.0, base = 8.0 }
"#;

/// A homogeneous half-plane: no kernel, the Cauchy part alone.
const HALF_PLANE: &str = r#"
[layer]
poisson = 0.3
base = { type = "infinite" }
grading = { type = "homogeneous", modulus = 1.0 }
"#;

const FLAT: &str = r#"
[punch]
type = "flat"
half_width = 1.0
"#;

/// The force below makes its contact about as wide as the flat punch.
const CYLINDER: &str = r#"
[punch]
type = "cylinder"
radius = 1.0
"#;

const FRICTION: &str = r#"
[friction]
type = "goodman"
coefficient = 0.3
"#;

const FORCE: &str = r"
[load]
force = 2.0
";

/// All of them by name. The contact size of a cylinder is searched for, a stick zone too.
pub(crate) fn all() -> Vec<(&'static str, Scene)> {
    [
        ("flat", LAYER, FLAT, ""),
        ("flat-goodman", LAYER, FLAT, FRICTION),
        ("cylinder-by-force", LAYER, CYLINDER, ""),
        ("half-plane-flat", HALF_PLANE, FLAT, ""),
        ("half-plane-flat-goodman", HALF_PLANE, FLAT, FRICTION),
        ("half-plane-cylinder-by-force", HALF_PLANE, CYLINDER, ""),
    ]
    .map(|(name, layer, punch, friction)| (name, scene(name, &format!("format = 1\n{layer}{punch}{friction}{FORCE}"))))
    .into()
}

/// Those on a layer, whose cost is judged, at a tolerance.
pub(crate) fn judged(tolerance: f64) -> Vec<(&'static str, Scene)> {
    with_solver(&format!("tolerance = {tolerance:?}"))
}

/// Those on a layer, solved as told.
pub(crate) fn with_solver(solver: &str) -> Vec<(&'static str, Scene)> {
    let of = |punch: &str, friction: &str| format!("format = 1\n{LAYER}{punch}{friction}{FORCE}[solver]\n{solver}\n");
    [("flat", FLAT, ""), ("flat-goodman", FLAT, FRICTION), ("cylinder-by-force", CYLINDER, "")]
        .map(|(name, punch, friction)| (name, scene(name, &of(punch, friction))))
        .into()
}

/// A flat punch so many times as wide as the layer, softer towards its base, is thick, at the default tolerance.
pub(crate) fn thin(width_over_thickness: f64) -> Scene {
    let text = format!(
        "format = 1\n[layer]\nthickness = {:?}\npoisson = 0.3\n\
         grading = {{ type = \"exponential\", surface = 1.0, base = 0.125 }}\n{FLAT}{FORCE}",
        1.0 / width_over_thickness
    );
    scene("thin", &text)
}

/// A cylinder and a wedge with friction on the same layer, their contacts as wide as the flat punch.
pub(crate) fn growing() -> [Scene; 2] {
    let of = |punch: &str| format!("format = 1\n{LAYER}{punch}{FRICTION}[load]\nhalf_width = 1.0\n");
    [scene("cylinder", &of(CYLINDER)), scene("wedge", &of("[punch]\ntype = \"wedge\"\nslope = 0.1\n"))]
}

fn scene(name: &str, text: &str) -> Scene {
    parse(name, text).unwrap_or_else(|e| panic!("{e}"))
}
