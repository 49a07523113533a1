//! What a scene asks for.

use serde::{Deserialize, Deserializer, Serialize, de};

/// A quantity of the result, or a group of them, that `[output] quantities` may name.
///
/// ```
/// use slipzone::scene::Asked;
///
/// let group = Asked::named("edge").unwrap();
/// assert!(group.covers("edge.ratio") && !group.covers("stick.ratio"));
/// assert_eq!(Asked::named("edge.radius"), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(transparent)]
pub struct Asked(&'static str);

impl Asked {
    /// The numbers of a result, by their path.
    pub const NUMBERS: [&str; 12] = [
        "load.force",
        "load.half_width",
        "load.indentation",
        "pressure.centre",
        "pressure.mean",
        "pressure.peak",
        "edge.stress_intensity",
        "edge.ratio",
        "stick.half_width",
        "stick.ratio",
        "stick.one_minus_ratio",
        "stick.strain_rate",
    ];

    /// All names: the groups first, then the numbers.
    pub const NAMES: [&str; 17] = {
        let mut names =
            ["load", "pressure", "edge", "stick", "profile", "", "", "", "", "", "", "", "", "", "", "", ""];
        let mut i = 0;
        while i < Self::NUMBERS.len() {
            names[5 + i] = Self::NUMBERS[i];
            i += 1;
        }
        names
    };

    /// The quantity or group of that name.
    pub fn named(name: &str) -> Option<Self> {
        Self::NAMES.into_iter().find(|known| *known == name).map(Self)
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        self.0
    }

    /// Whether it is, or holds, what stands at a path of the result.
    pub fn covers(self, path: &str) -> bool {
        path.strip_prefix(self.0).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    }
}

impl<'de> Deserialize<'de> for Asked {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        Self::named(&name).ok_or_else(|| de::Error::unknown_variant(&name, &Self::NAMES))
    }
}
