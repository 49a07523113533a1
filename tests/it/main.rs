//! All integration tests, in one binary: on two cores linking dominates.

mod accuracy;
#[cfg(feature = "cli")]
mod bad_input;
#[cfg(feature = "cli")]
mod command_line;
mod examples;
mod flexibilities;
mod friction;
mod gradings;
mod hard_layers;
mod layers;
mod limits;
mod loading_curve;
mod marching;
mod planned;
mod planner;
mod properties;
mod punches;
mod random;
mod regressions;
#[cfg(feature = "cli")]
mod reuse;
mod run;
mod scene;
mod sketch;
mod strain;
