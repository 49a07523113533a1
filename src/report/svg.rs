//! Figures fit to print.

mod atlas;
mod axis;
mod canvas;
mod chart;
mod edges;
mod head;
mod layer;
mod legend;
mod loading;
mod panel;
mod scale;
mod sheet;
mod study;
mod style;
mod tractions;

use crate::engine::{Solution, Status, first_not_finite};
pub use atlas::atlas_svg;
pub use chart::chart_svg;
pub use layer::layer_svg;
pub use loading::curve_svg;
pub use study::{StudyFigure, study_svg};
pub use tractions::svg;

/// Why there is no figure.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FigureError {
    /// The scene was refused, so there are no numbers; the reason is the solution's.
    #[error("the scene was refused: {0}")]
    Refused(String),
    /// A number is not finite; see [`first_not_finite`].
    #[error("{0}")]
    NotFinite(String),
    /// Without contact half-width and mean pressure there are no axes.
    #[error("the solution has no contact half-width or no mean pressure")]
    NoScale,
    /// A curve needs two points.
    #[error(
        "the pressure is known and bounded at {0} point(s) of the profile, and a curve takes at least 2; list more in \
         `output.x`, or leave it out"
    )]
    NoProfile(usize),
    /// The scene asks for no loading curve, or no load on it has numbers.
    #[error("the solution has no loading curve")]
    NoCurve,
    /// Neither constants over depth nor flexibilities are known.
    #[error("nothing is known of the layer")]
    NoLayer,
    /// The description of a study's figure does not fit the study.
    #[error("{0}")]
    Plot(String),
    /// A line of results that no scene of the study has.
    #[error("the results are not of this study: {0}")]
    NotOfTheStudy(String),
    /// None of the scenes that the figure shows has the number.
    #[error("no scene has numbers to show: {0}")]
    NothingToShow(String),
}

/// Without numbers, or with one that is not finite, there is no figure of a solution.
fn with_numbers(solution: &Solution) -> Result<(), FigureError> {
    if solution.status == Status::Refused {
        return Err(FigureError::Refused(solution.reason.clone().unwrap_or_default()));
    }
    first_not_finite(solution).map_or(Ok(()), |found| Err(FigureError::NotFinite(found)))
}

/// All text of a figure; fails on what is no XML.
#[cfg(test)]
fn texts(svg: &str) -> Vec<String> {
    let document = roxmltree::Document::parse(svg).expect("well-formed XML");
    document.descendants().filter(|n| n.has_tag_name("text")).filter_map(|n| n.text()).map(Into::into).collect()
}
