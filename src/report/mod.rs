//! A solution as text, JSON, CSV and SVG. Nothing here computes physics.

mod csv;
mod curve_csv;
mod json;
mod labels;
mod number;
mod scene_line;
#[cfg(feature = "plot")]
mod svg;
mod text;

pub use csv::csv;
pub use curve_csv::curve_csv;
pub use json::json;
#[cfg(feature = "plot")]
pub use svg::{FigureError, curve_svg, layer_svg, study_svg, svg};
pub use text::text;

#[cfg(test)]
pub(crate) mod samples;
