//! The six standard scenes: those whose work is watched, each at the default tolerance of 1e-8.

use slipzone::scene::{Scene, parse};

/// A layer eight times as stiff at its base, five half-widths thick.
const GRADED: &str = r#"
thickness = 5.0
grading = { type = "exponential", surface = 1.0, base = 8.0 }
"#;

/// A tenth of the half-width thick, softer towards its base.
const THIN: &str = r#"
thickness = 0.1
grading = { type = "exponential", surface = 1.0, base = 0.125 }
"#;

/// Twelve rows of `1 + 0.3 y^(3/2)`, to three decimals.
const TABLE: &str = r#"
thickness = 5.0
grading = { type = "table", points = [
    [0.0, 1.0], [0.45, 1.091], [0.9, 1.256], [1.35, 1.471], [1.8, 1.724], [2.25, 2.012],
    [2.7, 2.331], [3.15, 2.677], [3.6, 3.049], [4.05, 3.445], [4.5, 3.864], [5.0, 4.354],
] }
"#;

const FLAT: &str = "type = \"flat\"\nhalf_width = 1.0";
const CYLINDER: &str = "type = \"cylinder\"\nradius = 1.0";
const DRY: &str = "";
const GOODMAN: &str = "[friction]\ntype = \"goodman\"\ncoefficient = 0.3";
/// Under it a contact of the cylinder is about as wide as the flat punch.
const FORCE: &str = "force = 2.0";
const HALF_WIDTH: &str = "half_width = 1.0";

/// All of them by name.
pub(crate) fn scenes() -> [(&'static str, Scene); 6] {
    [
        ("flat", GRADED, FLAT, DRY, FORCE),
        ("flat-goodman", GRADED, FLAT, GOODMAN, FORCE),
        ("cylinder-by-force", GRADED, CYLINDER, DRY, FORCE),
        ("growing-cylinder-goodman", GRADED, CYLINDER, GOODMAN, HALF_WIDTH),
        ("thin-flat", THIN, FLAT, DRY, FORCE),
        ("table-flat", TABLE, FLAT, DRY, FORCE),
    ]
    .map(|(name, layer, punch, friction, load)| {
        let text =
            format!("format = 1\n[layer]\npoisson = 0.3\n{layer}\n[punch]\n{punch}\n{friction}\n[load]\n{load}\n");
        (name, parse(name, &text).unwrap_or_else(|error| panic!("{error}")))
    })
}
