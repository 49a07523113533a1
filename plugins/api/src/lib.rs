//! Contracts of slipzone: what a grading, a punch, a flexibility, a kernel strategy and a quadrature are.
//!
//! Every family is a pair. The *config half* ([`Grading`], [`PunchProfile`], [`Flexibility`],
//! [`KernelStrategy`], [`Quadrature`]) is small, serialisable and read from a scene by its `type` key.
//! It is turned once into a *run-time half* ([`ModulusLaw`], [`PunchShape`], [`LayerResponse`],
//! [`KernelTable`], [`Rule`]) that holds tables and scratch. Beside each plugin stands a [`PluginInfo`]
//! record, so that tools can list, explain and try it.
//!
//! # Units
//! A [`PunchShape`] is in the user's units, and so are the moduli of a [`ModulusLaw`]. All else of the run-time halves is
//! in the layer's own: lengths in its thickness `h` (in the user's unit of length on an infinite solid), stresses in the
//! surface shear modulus `mu1`. Signs and symbols are those of `docs/theory.md`: `y` points into the solid, `p` and `q`
//! act on it along +y and +x.
#![cfg_attr(docsrs, feature(doc_cfg))]

pub mod chebyshev;
pub mod contract;
pub mod details;
pub mod double_exponential;
mod elastic;
pub mod elementary;
pub mod examine;
mod files;
mod flexibility;
mod friction;
mod grading;
mod kernel;
mod layer_model;
mod number;
mod punch;
mod quadrature;
pub mod reference;
mod refusal;
mod registry;
mod room;
pub mod root;
pub mod rows;
mod shelf;
pub mod taylor;
#[cfg(feature = "testkit")]
pub mod testkit;
mod values;
mod words;

pub use elastic::{Base, Elastic, Moduli, Plane};
pub use files::{Fault, Files, LARGEST_FILE, NoFiles, Place};
pub use flexibility::{Flexibility, LayerResponse, SurfaceFlexibility};
pub use friction::{Friction, FrozenStrain};
pub use grading::{Grading, ModulusLaw, Setting, Stretch, Sublayer};
pub use kernel::{Component, KernelRequest, KernelStrategy, KernelTable, NEAREST_POLE, Parts, PartsMut, PartsVec};
pub use layer_model::{LawFlaw, LayerModel, Material, Solid};
pub use number::{Finite, MODERATE, NotAllowed, Poisson, Positive, exactly, of_height, rounded, short};
pub use punch::{FlatFace, Flaw, PunchProfile, PunchShape};
pub use quadrature::{Densities, Edge, Parity, Quadrature, Rule, Span, Station};
pub use refusal::Refusal;
pub use registry::{Family, Parameter, PluginInfo, find, known_elsewhere, plugins};
pub use room::lend;
pub use shelf::Shelf;
pub use values::{Kind, Values};
pub use words::{clip, nearest};

#[doc(hidden)]
pub use inventory;
