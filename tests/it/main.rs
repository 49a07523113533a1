//! All integration tests, in one binary: on two cores linking dominates.

mod accuracy;
mod friction;
mod limits;
mod properties;
mod scenes;
