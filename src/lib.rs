//! Partial-slip contact between a rigid punch and an elastic graded layer of finite thickness.
//!
//! A [`scene::Scene`] goes in, an [`engine::Solution`] comes out; both are plain data. Lengths, stresses and forces per
//! length are in any consistent units.
//!
//! ```
//! use slipzone::engine::{Status, solve};
//!
//! let scene = slipzone::scene::parse("example.toml", r#"
//!     format = 1
//!     layer = { thickness = 5.0, poisson = 0.3, grading = { type = "exponential", surface = 1.0, base = 8.0 } }
//!     punch = { type = "flat", half_width = 1.0 }
//!     friction = { type = "goodman", coefficient = 0.3 }
//!     load = { force = 1.0 }
//! "#).unwrap();
//! let solution = solve(&scene);
//! assert_eq!(solution.status, Status::Converged);
//!
//! // Every number of it is an option: what does not exist, or was refused, is `None`, never NaN.
//! print!("{}", slipzone::report::text(&solution));
//! // a/b of an independent program, ten digits of it: within what the solution claims of itself.
//! let ratio = solution.stick.unwrap().ratio.unwrap();
//! assert!((ratio - 0.9726279998).abs() <= solution.error.each["stick.ratio"] * ratio + 0.5e-10);
//! assert!(solution.error.estimate.unwrap() <= 1e-8, "the default tolerance");
//! ```
//!
//! | to | start with |
//! |---|---|
//! | read a scene | [`scene::parse`]; [`scene::parse_with`] if it names data files |
//! | solve it | [`engine::solve`]; many at once, [`engine::solve_all`]; one after another on one layer, [`engine::Solver`] |
//! | know beforehand how, or why not | [`engine::plan`], [`engine::refusal`] |
//! | write it down | [`report::text()`], [`report::json()`], [`report::csv()`] |
//! | draw it | [`report::svg()`], [`report::curve_svg()`], [`report::layer_svg()`] |
//! | solve many that differ in a few fields | [`study::Study`], [`study::sweep()`] |
//! | bound the work of a scene | [`engine::solve_within`], [`engine::BUDGET`] |
//! | help someone to write a scene | [`scene::schema()`], [`scene::KEYS`] |
//! | check the program | [`verify::run`], [`verify::GROUPS`] |
//! | compare methods | [`chart::run`], [`chart::atlas`] |
//! | list what a scene can name | [`link_plugins`], then [`api::plugins`] |
//! | offer the command line with plugins of one's own | `cli::run`, of the feature `cli` |
//! | add a punch or a grading | [`api::PunchProfile`], [`api::Grading`], [`api::register`] |
//!
//! What a scene can name are plugins of five families, whose contracts are in [`api`]; the repository's `docs/`
//! has their formulas, the theory and a worked example of a new one.

mod caught;
pub mod chart;
#[cfg(feature = "cli")]
pub mod cli;
#[cfg(any(test, doctest))]
mod doctests;
pub mod engine;
mod plan;
pub mod report;
pub mod scene;
pub mod study;
pub mod verify;

pub use slipzone_api as api;

/// Makes every plugin crate part of the program (a crate that nobody names is not linked).
pub fn link_plugins() {
    slipzone_gradings::link();
    slipzone_punches::link();
    slipzone_flexibilities::link();
    slipzone_kernels::link();
    slipzone_quadratures::link();
}
