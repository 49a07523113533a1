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

/// A flat punch on layers of every kind, without and with friction: five half-widths thick, but for the stacks.
pub(crate) fn layers() -> Vec<(String, Scene)> {
    let sublayer = |thickness: f64, modulus: f64| {
        format!("{{ thickness = {thickness:?}, grading = {{ type = \"homogeneous\", modulus = {modulus:?} }} }}")
    };
    let hundred: Vec<String> = (0..100).map(|i| sublayer(0.05, 8.0_f64.powf((f64::from(i) + 0.5) / 100.0))).collect();
    let stack = |layers: &[String]| format!("grading = {{ type = \"stack\", layers = [{}] }}", layers.join(", "));
    let row = |i: i32| {
        let depth = 5.0 * f64::from(i) / 11.0;
        format!("[{depth:?}, {:?}]", 1.0 + 0.3 * depth.powf(1.5))
    };
    let thick = |rest: &str| format!("thickness = 5.0\n{rest}");
    let table =
        format!("grading = {{ type = \"table\", points = [{}] }}", (0..12).map(row).collect::<Vec<_>>().join(", "));
    let mut layers = vec![
        ("exponential", thick("grading = { type = \"exponential\", surface = 1.0, base = 8.0 }")),
        (
            "exponential-on-half-plane",
            thick(
                "grading = { type = \"exponential\", surface = 1.0, base = 8.0 }\n\
                 base = { type = \"half-plane\", shear = 4.0, poisson = 0.2 }",
            ),
        ),
        ("linear", thick("grading = { type = \"linear\", surface = 1.0, base = 8.0 }")),
        ("power-law", thick("grading = { type = \"power-law\", surface = 1.0, length = 2.0, exponent = 2.0 }")),
        ("sigmoid", thick("grading = { type = \"sigmoid\", above = 1.0, below = 8.0, centre = 1.5, width = 0.5 }")),
        ("table", thick(&table)),
        ("three-layers", stack(&[sublayer(0.5, 1.0), sublayer(1.0, 3.0), sublayer(0.8, 0.5)])),
        ("hundred-layers", stack(&hundred)),
    ];
    if cfg!(feature = "formula") {
        layers.push(("formula", thick("grading = { type = \"formula\", modulus = \"exp(y/2.4)*(1 + 0.1*y)\" }")));
    }
    let of = |(name, layer): (&str, String), friction: &str| {
        let text = format!("format = 1\n[layer]\npoisson = 0.3\n{layer}\n{FLAT}{friction}{FORCE}");
        let name = if friction.is_empty() { name.to_owned() } else { format!("{name}/goodman") };
        let scene = scene(&name, &text);
        (name, scene)
    };
    let dry: Vec<_> = layers.iter().cloned().map(|layer| of(layer, "")).collect();
    dry.into_iter().chain(layers.into_iter().map(|layer| of(layer, FRICTION))).collect()
}

fn scene(name: &str, text: &str) -> Scene {
    parse(name, text).unwrap_or_else(|e| panic!("{e}"))
}
