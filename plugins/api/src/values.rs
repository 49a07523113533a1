//! What a key of a scene may hold.

use crate::{Family, Parameter};
use serde::Serialize;

/// What a key may hold, said in data: for editors, checks of input, forms.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Values {
    /// Not said; numbers where the key has samples.
    Unstated,
    /// A finite number.
    Number,
    /// A finite number above 0.
    Positive,
    /// Poisson's ratio, above -1 and up to 1/2.
    Poisson,
    /// A number above 0 and up to this.
    UpTo(f64),
    /// A number from the first to the second.
    Between(f64, f64),
    /// A whole number from the first to the second.
    Whole(u64, u64),
    /// An even number from the first to the second.
    Even(u64, u64),
    /// `true` or `false`.
    Flag,
    /// Text.
    Text,
    /// One line of printable text, of at most so many characters.
    Line(usize),
    /// One of these words.
    OneOf(&'static [&'static str]),
    /// A list of these, with so many entries at least and at most.
    List(&'static Self, usize, usize),
    /// A table of these, under names that the user chooses.
    ByName(&'static Self),
    /// A table of these keys.
    Table(&'static [Parameter]),
    /// A table whose `type` says which other keys it has.
    Choice(&'static [Kind]),
    /// A plugin of that family.
    Plugin(Family),
}

/// One `type` of [`Values::Choice`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Kind {
    /// Its `type`.
    pub name: &'static str,
    /// What it is, in one line.
    pub summary: &'static str,
    /// Its keys besides `type`.
    pub parameters: &'static [Parameter],
}

impl Parameter {
    /// A key that must be there, without samples.
    pub const fn required(name: &'static str, summary: &'static str, values: Values) -> Self {
        Self { name, summary, required: true, samples: &[], values, in_place_of: None }
    }

    /// A key that may be left out, without samples.
    pub const fn optional(name: &'static str, summary: &'static str, values: Values) -> Self {
        Self { required: false, ..Self::required(name, summary, values) }
    }

    /// The same key, which excludes another and makes up for its absence.
    #[must_use]
    pub const fn in_place_of(self, other: &'static str) -> Self {
        Self { required: false, in_place_of: Some(other), ..self }
    }
}
