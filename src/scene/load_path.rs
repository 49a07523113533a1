//! Loads on the way to the last one: what a loading curve is drawn through.

use super::Load;
use serde::{Deserialize, Serialize};
use slipzone_api::Positive;
use std::ops::RangeInclusive;

/// Which quantity is given as load.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadKind {
    /// Force per unit length out of plane.
    Force,
    /// Half-width of the contact.
    HalfWidth,
    /// Depth by which the punch sinks in.
    Indentation,
}

impl LoadKind {
    /// The key in a scene.
    pub const fn key(self) -> &'static str {
        match self {
            Self::Force => "force",
            Self::HalfWidth => "half_width",
            Self::Indentation => "indentation",
        }
    }

    /// The load of this kind and that size.
    pub const fn load(self, value: Positive) -> Load {
        match self {
            Self::Force => Load::Force(value),
            Self::HalfWidth => Load::HalfWidth(value),
            Self::Indentation => Load::Indentation(value),
        }
    }
}

impl Load {
    /// Which quantity is given.
    pub const fn kind(self) -> LoadKind {
        match self {
            Self::Force(_) => LoadKind::Force,
            Self::HalfWidth(_) => LoadKind::HalfWidth,
            Self::Indentation(_) => LoadKind::Indentation,
        }
    }

    /// How much of it.
    pub const fn value(self) -> Positive {
        match self {
            Self::Force(value) | Self::HalfWidth(value) | Self::Indentation(value) => value,
        }
    }
}

/// Growing loads of one kind, the largest last.
///
/// ```
/// use slipzone::{api::Positive, scene::{Load, LoadPath}};
///
/// let most = Load::Force(Positive::new(2.0)?);
/// let path = LoadPath::until(most, 4).unwrap();
/// let forces: Vec<f64> = path.loads().map(|load| load.value().get()).collect();
/// assert_eq!(forces, [0.5, 1.0, 1.5, 2.0]);
/// assert_eq!(path.last(), most);
/// # Ok::<(), slipzone::api::NotAllowed>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LoadPath {
    kind: LoadKind,
    steps: Steps,
}

#[derive(Clone, Debug, PartialEq)]
enum Steps {
    /// Never empty.
    Listed(Vec<Positive>),
    /// Equally spaced.
    Until { most: Positive, points: usize },
}

/// Why loads are no path.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PathError {
    /// How many there must be.
    #[error("expected from {} to {} loads, found {found}", allowed.start(), allowed.end())]
    Count {
        /// What would be right.
        allowed: RangeInclusive<usize>,
        /// What is there.
        found: usize,
    },
    /// A load that does not exceed the one before it.
    #[error("expected loads that grow, found {found} after {before}")]
    NotGrowing {
        /// Its index, counted from 0.
        index: usize,
        /// Its value.
        found: f64,
        /// The one before it.
        before: f64,
    },
    /// A load whose steps are lost among the smallest numbers.
    #[error("expected a load that can be divided into so many steps, found {0:?}")]
    TooSmall(f64),
}

impl LoadPath {
    /// How many loads may be listed.
    pub const LISTED: RangeInclusive<usize> = 1..=100_000;
    /// How many equal steps there may be.
    pub const POINTS: RangeInclusive<usize> = 2..=100_000;
    /// Equal steps of a scene that does not say how many.
    pub const DEFAULT_POINTS: usize = 60;

    /// Loads one by one.
    pub fn listed(kind: LoadKind, loads: Vec<Positive>) -> Result<Self, PathError> {
        if !Self::LISTED.contains(&loads.len()) {
            return Err(PathError::Count { allowed: Self::LISTED, found: loads.len() });
        }
        if let Some(index) = loads.windows(2).position(|pair| pair[1] <= pair[0]) {
            let (before, found) = (loads[index].get(), loads[index + 1].get());
            return Err(PathError::NotGrowing { index: index + 1, found, before });
        }
        Ok(Self { kind, steps: Steps::Listed(loads) })
    }

    /// Equal steps from `most / points` to `most`.
    pub fn until(most: Load, points: usize) -> Result<Self, PathError> {
        if !Self::POINTS.contains(&points) {
            return Err(PathError::Count { allowed: Self::POINTS, found: points });
        }
        if share(most.value().get(), 1, points) < f64::MIN_POSITIVE {
            return Err(PathError::TooSmall(most.value().get()));
        }
        Ok(Self { kind: most.kind(), steps: Steps::Until { most: most.value(), points } })
    }

    /// What grows.
    pub const fn kind(&self) -> LoadKind {
        self.kind
    }

    /// How many loads.
    pub const fn points(&self) -> usize {
        match &self.steps {
            Steps::Listed(loads) => loads.len(),
            Steps::Until { points, .. } => *points,
        }
    }

    /// One of them, counted from 0.
    ///
    /// # Panics
    /// Beyond the last.
    pub fn load(&self, index: usize) -> Load {
        assert!(index < self.points(), "load {index} of {}", self.points());
        self.kind.load(match &self.steps {
            Steps::Listed(loads) => loads[index],
            Steps::Until { most, points } => {
                Positive::new(share(most.get(), index + 1, *points)).expect("a positive share")
            }
        })
    }

    /// All of them, the smallest first.
    pub fn loads(&self) -> impl DoubleEndedIterator<Item = Load> + ExactSizeIterator {
        (0..self.points()).map(|index| self.load(index))
    }

    /// The largest.
    pub fn last(&self) -> Load {
        self.load(self.points() - 1)
    }

    /// The key of `[load]` that holds such a path.
    pub(super) const fn key(&self) -> &'static str {
        match &self.steps {
            Steps::Listed(_) => "path",
            Steps::Until { .. } => "until",
        }
    }
}

/// So many steps of as many as lead to the load given, the last to the last bit.
fn share(most: f64, steps: usize, points: usize) -> f64 {
    if steps == points { most } else { to_fifteen_digits(most * (steps as f64 / points as f64)) }
}

/// 0.3 and not 0.30000000000000004, which is no better a step.
pub(crate) fn to_fifteen_digits(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

/// What `[load]` says: the load that is solved for, and those on the way to it.
#[derive(Clone, Deserialize, Serialize)]
#[serde(try_from = "Keys", into = "Keys")]
pub(super) struct LoadTable {
    pub(super) load: Load,
    pub(super) path: Option<LoadPath>,
}

/// The keys of `[load]`: one of them.
#[derive(Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
enum Keys {
    Force(Positive),
    HalfWidth(Positive),
    Indentation(Positive),
    Path(Listed),
    Until(Until),
}

/// The keys of `load.path`: one of them.
#[derive(Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
enum Listed {
    Force(Vec<Positive>),
    HalfWidth(Vec<Positive>),
    Indentation(Vec<Positive>),
}

/// The keys of `load.until`: one of three, and how many steps.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Until {
    #[serde(skip_serializing_if = "Option::is_none")]
    force: Option<Positive>,
    #[serde(skip_serializing_if = "Option::is_none")]
    half_width: Option<Positive>,
    #[serde(skip_serializing_if = "Option::is_none")]
    indentation: Option<Positive>,
    #[serde(default = "default_points")]
    points: usize,
}

fn default_points() -> usize {
    LoadPath::DEFAULT_POINTS
}

impl TryFrom<Keys> for LoadTable {
    type Error = String;

    fn try_from(keys: Keys) -> Result<Self, String> {
        let alone = |load| Ok(Self { load, path: None });
        let path = match keys {
            Keys::Force(force) => return alone(Load::Force(force)),
            Keys::HalfWidth(half_width) => return alone(Load::HalfWidth(half_width)),
            Keys::Indentation(depth) => return alone(Load::Indentation(depth)),
            Keys::Path(Listed::Force(forces)) => LoadPath::listed(LoadKind::Force, forces),
            Keys::Path(Listed::HalfWidth(half_widths)) => LoadPath::listed(LoadKind::HalfWidth, half_widths),
            Keys::Path(Listed::Indentation(depths)) => LoadPath::listed(LoadKind::Indentation, depths),
            Keys::Until(Until { force, half_width, indentation, points }) => {
                let most = match (force, half_width, indentation) {
                    (Some(force), None, None) => Load::Force(force),
                    (None, Some(half_width), None) => Load::HalfWidth(half_width),
                    (None, None, Some(depth)) => Load::Indentation(depth),
                    _ => return Err("exactly one of `force`, `half_width`, `indentation` must be there".into()),
                };
                LoadPath::until(most, points)
            }
        };
        let path = path.map_err(|error| error.to_string())?;
        Ok(Self { load: path.last(), path: Some(path) })
    }
}

impl From<LoadTable> for Keys {
    fn from(LoadTable { load, path }: LoadTable) -> Self {
        match path {
            None => match load {
                Load::Force(force) => Self::Force(force),
                Load::HalfWidth(half_width) => Self::HalfWidth(half_width),
                Load::Indentation(depth) => Self::Indentation(depth),
            },
            Some(LoadPath { kind, steps: Steps::Listed(loads) }) => Self::Path(match kind {
                LoadKind::Force => Listed::Force(loads),
                LoadKind::HalfWidth => Listed::HalfWidth(loads),
                LoadKind::Indentation => Listed::Indentation(loads),
            }),
            Some(LoadPath { kind, steps: Steps::Until { most, points } }) => {
                let of = |wanted| (kind == wanted).then_some(most);
                Self::Until(Until {
                    force: of(LoadKind::Force),
                    half_width: of(LoadKind::HalfWidth),
                    indentation: of(LoadKind::Indentation),
                    points,
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn positive(value: f64) -> Positive {
        Positive::new(value).expect("positive")
    }

    #[test]
    fn equal_steps_end_where_they_are_told_to() {
        for points in [2, 3, 7, 49, 60, 1000, 99_999] {
            let most = positive(0.1 + 0.2);
            let path = LoadPath::until(Load::Indentation(most), points).expect("a path");
            assert_eq!(path.loads().len(), points);
            assert_eq!(path.last(), Load::Indentation(most), "to the last bit");
            let values: Vec<Positive> = path.loads().map(Load::value).collect();
            assert!(values.is_sorted_by(|one, next| one < next), "{points} points");
            let first = to_fifteen_digits(most.get() / points as f64);
            assert_eq!(values[0], positive(first), "a product in place of a quotient");
        }
        let path = LoadPath::until(Load::Indentation(positive(0.02)), 20).expect("a path");
        assert_eq!(path.load(8), Load::Indentation(positive(0.009)), "and not 0.009000000000000001");
    }

    #[test]
    fn loads_that_are_no_path() {
        let listed = |loads: &[f64]| {
            let loads = loads.iter().map(|load| positive(*load)).collect();
            LoadPath::listed(LoadKind::Force, loads).map_err(|error| error.to_string())
        };
        assert!(listed(&[1.0]).is_ok() && listed(&[1.0, 1.000_000_000_000_000_2]).is_ok());
        assert_eq!(listed(&[]).unwrap_err(), "expected from 1 to 100000 loads, found 0");
        assert_eq!(listed(&[1.0, 2.0, 2.0]).unwrap_err(), "expected loads that grow, found 2 after 2");
        assert!(LoadPath::listed(LoadKind::Force, vec![positive(1.0); 100_001]).is_err());
        for points in [0, 1, 100_001] {
            assert!(LoadPath::until(Load::Force(positive(1.0)), points).is_err(), "{points}");
        }
        assert!(LoadPath::until(Load::Force(positive(1e-310)), 2).is_err(), "its half is no normal number");
    }
}
