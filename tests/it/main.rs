//! All integration tests, in one binary: on two cores linking dominates.

mod accuracy;
#[cfg(feature = "cli")]
mod bad_input;
mod cc13;
#[cfg(feature = "cli")]
mod chart;
#[cfg(feature = "cli")]
mod command_line;
mod coupled;
mod datum;
mod examples;
mod faults;
#[cfg(feature = "plot")]
mod figures;
mod flexibilities;
mod friction;
mod gradings;
mod hard_layers;
#[cfg(feature = "cli")]
mod interfaces;
mod layers;
mod limits;
mod loading_curve;
mod marching;
mod operator_counts;
mod own_plugins;
mod planned;
mod planner;
mod punches;
mod random;
mod regressions;
#[cfg(feature = "cli")]
mod reuse;
mod run;
mod scene;
mod scenes;
mod sketch;
#[path = "../../benches/standard.rs"]
mod standard;
mod strain;
mod study_plots;
#[cfg(feature = "cli")]
mod sweep;
mod verify;
