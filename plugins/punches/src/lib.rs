//! Punches: the shape of the rigid body. One file per plugin.

mod cylinder;
mod flat;
#[cfg(feature = "formula")]
mod formula;
mod polynomial;
mod power;
mod rounded_flat;
mod rounded_wedge;
mod table;
mod wedge;

pub use cylinder::Cylinder;
pub use flat::Flat;
#[cfg(feature = "formula")]
pub use formula::Formula;
pub use polynomial::{Coefficients, Polynomial};
pub use power::{Exponent, Power};
pub use rounded_flat::RoundedFlat;
pub use rounded_wedge::RoundedWedge;
pub use table::Table;
pub use wedge::Wedge;

/// Names every module that registers a plugin, so that no linker drops this crate.
pub fn link() {
    cylinder::link();
    flat::link();
    #[cfg(feature = "formula")]
    formula::link();
    polynomial::link();
    power::link();
    rounded_flat::link();
    rounded_wedge::link();
    table::link();
    wedge::link();
}

#[cfg(test)]
mod tests;
