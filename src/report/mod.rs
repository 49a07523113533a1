//! A solution as text, JSON, CSV and SVG. Nothing here computes physics.

use crate::engine::Solution;

/// The solution in words.
pub fn text(solution: &Solution) -> String {
    format!("{:?} {:?}\n", solution.status, solution.reason)
}

/// The solution as JSON.
pub fn json(solution: &Solution) -> String {
    serde_json::to_string_pretty(solution).unwrap_or_default()
}

/// The profile as CSV.
pub fn csv(_solution: &Solution) -> String {
    "x,pressure,shear\n".into()
}

/// Why no figure was drawn.
#[cfg(feature = "plot")]
#[derive(Clone, Debug, thiserror::Error)]
#[error("there is no profile to draw")]
pub struct FigureError;

/// The profile as SVG.
#[cfg(feature = "plot")]
pub fn svg(_solution: &Solution) -> Result<String, FigureError> {
    Err(FigureError)
}
