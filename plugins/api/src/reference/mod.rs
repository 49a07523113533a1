//! Closed forms of the field, tested against themselves before anything is tested against them.
//!
//! Symbols and signs are those of `docs/theory.md`. Units are any consistent ones unless said otherwise.

pub mod abel;
mod adaptive;
pub mod cylinder;
pub mod flat_punch;
pub mod goodman_shear;
pub mod homogeneous_layer;
pub mod hyperbola;
pub mod partial_slip;
pub mod power;
pub mod rounded_flat;
#[cfg(test)]
mod surface;
pub mod wedge;
