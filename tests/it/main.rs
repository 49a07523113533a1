//! Tests of the whole program.

#![allow(missing_docs)]

#[cfg(feature = "cli")]
mod bad_input;
#[cfg(feature = "cli")]
mod command_line;
#[cfg(feature = "cli")]
mod run;
mod scene;
