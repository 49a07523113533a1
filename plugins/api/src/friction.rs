//! Friction laws.

use crate::Positive;
use serde::{Deserialize, Serialize};

/// How the punch rubs. A scene without this table is frictionless.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "type", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Friction {
    /// Coulomb friction in Goodman's approximation: the shear traction does not change the pressure.
    Goodman {
        /// Coulomb's coefficient `eta`.
        coefficient: Positive,
        /// What strain a growing contact leaves in its stick zone.
        #[serde(default)]
        strain: FrozenStrain,
    },
}

impl Friction {
    /// Goodman's law with that coefficient, under a contact that remembers how it grew.
    pub fn goodman(coefficient: Positive) -> Self {
        Self::Goodman { coefficient, strain: FrozenStrain::default() }
    }
}

/// Where the strain `u'(x)` comes from that is frozen in the stick zone of a contact that grows with the load.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum FrozenStrain {
    /// From how the contact grew: what the surface was strained by when it stuck.
    #[default]
    History,
    /// Taken to be `C|x|`, as Chen and Chen (2013, eq. 63) do: exact for a cylinder on a homogeneous half-plane.
    Linear,
}
