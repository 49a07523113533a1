//! Partial-slip contact between a rigid punch and an elastic graded layer of finite thickness.

#[cfg(any(test, doctest))]
mod doctests;
pub mod engine;
mod plan;
pub mod report;
pub mod scene;

pub use slipzone_api as api;

/// Makes every plugin crate part of the program (a crate that nobody names is not linked).
pub fn link_plugins() {
    slipzone_gradings::link();
    slipzone_punches::link();
    slipzone_flexibilities::link();
    slipzone_kernels::link();
    slipzone_quadratures::link();
}
