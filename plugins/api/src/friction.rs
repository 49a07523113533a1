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
    },
}
