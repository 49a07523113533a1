//! A solution as text, JSON, CSV and SVG. Nothing here computes physics.
//!
//! Start with [`text()`], for people, or [`json()`], for programs: it has every number. All of them return the text of
//! a file; writing it is the caller's.

mod atlas_csv;
mod chart_csv;
mod csv;
mod curve_csv;
mod json;
mod labels;
mod number;
mod page;
mod scene_line;
mod study_table;
#[cfg(feature = "plot")]
mod svg;
mod text;

pub use atlas_csv::atlas_csv;
pub use chart_csv::chart_csv;
pub use csv::csv;
pub use curve_csv::curve_csv;
pub use json::json;
pub use page::{atlas_html, chart_html};
pub use scene_line::scene_line;
pub use study_table::{StudyTable, record_line};
#[cfg(feature = "plot")]
pub use svg::{FigureError, StudyFigure, atlas_svg, chart_svg, curve_svg, layer_svg, study_svg, svg};
pub use text::text;

#[cfg(test)]
pub(crate) mod samples;
