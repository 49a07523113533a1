//! Counts that a scene may ask for.

use serde::{Deserialize, Serialize};

/// A whole number within bounds.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[serde(try_from = "usize", into = "usize")]
pub(crate) struct Count<const LEAST: usize, const MOST: usize>(pub(crate) usize);

impl<const LEAST: usize, const MOST: usize> TryFrom<usize> for Count<LEAST, MOST> {
    type Error = String;

    fn try_from(count: usize) -> Result<Self, String> {
        if (LEAST..=MOST).contains(&count) {
            Ok(Self(count))
        } else {
            Err(format!("expected a whole number from {LEAST} to {MOST}, found {count}"))
        }
    }
}

impl<const LEAST: usize, const MOST: usize> From<Count<LEAST, MOST>> for usize {
    fn from(count: Count<LEAST, MOST>) -> usize {
        count.0
    }
}
