//! Gradings: how the elastic constants vary with depth. One file per plugin.

mod error_function;
mod exponential;
#[cfg(feature = "formula")]
mod formula;
mod homogeneous;
mod linear;
mod own_poisson;
mod power_law;
mod sigmoid;
mod stack;
mod table;
mod thickness;
mod transition;
mod volume_fraction;

pub use error_function::ErrorFunction;
pub use exponential::Exponential;
#[cfg(feature = "formula")]
pub use formula::Formula;
pub use homogeneous::Homogeneous;
pub use linear::Linear;
pub use power_law::PowerLaw;
pub use sigmoid::Sigmoid;
pub use stack::{Piece, Stack};
pub use table::Table;
pub use transition::Transition;
pub use volume_fraction::{MixingRule, Phase, VolumeFraction};

/// Places wider than this, over the thickness, are seen anyway; beside a narrower one a law is cut up to the second,
/// ever farther from it.
const NARROW: f64 = 0.02;
const LAST_CUT: f64 = 0.1;

/// Depths that cut a law beside narrow places of which depth and width are given over the thickness.
fn cuts(narrow: impl Iterator<Item = (f64, f64)>) -> Vec<f64> {
    slipzone_api::details::beside(narrow, NARROW, LAST_CUT)
}

/// Names every module that registers a plugin, so that no linker drops this crate.
pub fn link() {
    error_function::link();
    exponential::link();
    #[cfg(feature = "formula")]
    formula::link();
    homogeneous::link();
    linear::link();
    power_law::link();
    sigmoid::link();
    stack::link();
    table::link();
    volume_fraction::link();
}

#[cfg(test)]
mod tests {
    #[test]
    fn plugins_conform() {
        super::link();
        slipzone_api::testkit::check_crate(env!("CARGO_PKG_NAME"));
    }
}
