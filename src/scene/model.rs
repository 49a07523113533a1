//! Which elastic model stands for the solid.

use serde::{Deserialize, Serialize};

/// The solid as it is solved: as the scene describes it, or something cheaper that is near enough.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// As described.
    #[default]
    Full,
    /// A homogeneous half-plane of the surface's material: base and grading are too far away to matter.
    HalfPlane,
    /// The same with the first correction by a rigid base: the contact is narrow beside the layer.
    CorrectedHalfPlane,
    /// The layer on its base, of the surface's material throughout: the grading is too weak to matter.
    Homogeneous,
    /// A layer so thin that each point of its surface sinks by its own pressure alone, a Winkler foundation.
    Thin,
}

impl Model {
    /// All of them, the cheapest first.
    pub const ALL: [Self; 5] = [Self::HalfPlane, Self::Thin, Self::CorrectedHalfPlane, Self::Homogeneous, Self::Full];

    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        match self {
            Self::Full => "full",
            Self::HalfPlane => "half-plane",
            Self::CorrectedHalfPlane => "corrected-half-plane",
            Self::Homogeneous => "homogeneous",
            Self::Thin => "thin",
        }
    }
}
