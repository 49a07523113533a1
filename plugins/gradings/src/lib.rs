//! Gradings: how the elastic constants vary with depth. One file per plugin.

mod details;
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
