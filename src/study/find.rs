//! The question that a study may ask of each of its scenes: which value of a field gives a result that is wanted.

use serde::Deserialize;

/// An inverse question: the value of one field at which a number of the result is as wanted.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "FindTable")]
pub struct Find {
    /// Path of the field in the scene that is looked for.
    pub field: String,
    /// Where the search begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Number of the result that decides, by its path, such as `stick.ratio`.
    pub quantity: String,
    /// What is wanted of it.
    pub wanted: Wanted,
}

impl Find {
    /// All that decides the answer, on one line.
    pub(super) fn described(&self) -> String {
        let Self { field, from, to, quantity, wanted } = self;
        let wanted = match wanted {
            Wanted::Target(target) => format!("target = {target:?}"),
            Wanted::Minimum => "minimum = true".into(),
            Wanted::Maximum => "maximum = true".into(),
            Wanted::HalfPlaneWithin(share) => format!("half_plane_within = {share:?}"),
        };
        format!("{field} from {from:?} to {to:?}, where {quantity} has {wanted}")
    }

    /// The keys of the field's path.
    pub(super) fn path(&self) -> Vec<String> {
        self.field.split('.').map(str::to_owned).collect()
    }
}

/// What is wanted of the number that decides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Wanted {
    /// A value.
    Target(f64),
    /// The least value within the range.
    Minimum,
    /// The largest value within the range.
    Maximum,
    /// To be within this share of what the homogeneous half-plane of the surface's modulus gives, from there on to the
    /// end of the range.
    HalfPlaneWithin(f64),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FindTable {
    field: String,
    from: f64,
    to: f64,
    quantity: String,
    target: Option<f64>,
    minimum: Option<bool>,
    maximum: Option<bool>,
    half_plane_within: Option<f64>,
}

impl TryFrom<FindTable> for Find {
    type Error = String;

    fn try_from(table: FindTable) -> Result<Self, Self::Error> {
        let FindTable { field, from, to, quantity, target, minimum, maximum, half_plane_within } = table;
        let wishes = [
            ("target", target.map(Wanted::Target)),
            ("minimum", minimum.filter(|is| *is).map(|_| Wanted::Minimum)),
            ("maximum", maximum.filter(|is| *is).map(|_| Wanted::Maximum)),
            ("half_plane_within", half_plane_within.map(Wanted::HalfPlaneWithin)),
        ];
        let wishes: Vec<_> = wishes.into_iter().filter_map(|(key, wanted)| Some((key, wanted?))).collect();
        let &[(_, wanted)] = wishes.as_slice() else {
            let keys: Vec<_> = wishes.iter().map(|(key, _)| format!("`{key}`")).collect();
            let found = if keys.is_empty() { "none of them".into() } else { keys.join(" and ") };
            return Err(format!(
                "expected exactly one of `target`, `minimum = true`, `maximum = true` and `half_plane_within`, found {found}"
            ));
        };
        let field = field.split('.').map(str::trim).collect::<Vec<_>>().join(".");
        Ok(Self { field, from, to, quantity, wanted })
    }
}
