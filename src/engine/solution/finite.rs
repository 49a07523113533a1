//! No NaN and no infinity in a result.
//!
//! `serde_json` writes both as `null`, and a parsed `null` no longer tells. So the solution is serialised once into
//! nothing, by a serializer that looks at every number on its way: whatever field is added to a solution, or to a
//! plugin in its scene, is looked at too. Only the profile, most of the numbers, is looked at by itself first, and a
//! solve looks at what it found, not at the scene that it was given.

use crate::engine::Solution;
use serde::ser::{self, Serialize};
use std::fmt::{self, Display};

/// Path and value of the first number of a solution that is not finite, such as `` `load.force` is no number ``.
pub fn first_not_finite(solution: &Solution) -> Option<String> {
    beside(solution, None)
}

/// The same among the numbers that were found: all but the scene's.
pub(crate) fn first_found_not_finite(solution: &Solution) -> Option<String> {
    beside(solution, Some("scene"))
}

/// The first in a solution that is not in a field known to be finite.
fn beside(solution: &Solution, known: Option<&'static str>) -> Option<String> {
    let profile = solution.profile.is_finite().then_some("profile");
    solution.serialize(Probe { known: [profile, known] }).err().map(|found| found.to_string())
}

/// For the writers of formats that have no NaN.
///
/// # Panics
/// If a number is not finite.
pub(crate) fn insist(solution: &Solution) {
    if let Some(found) = first_not_finite(solution) {
        panic!("a result may hold finite numbers only, but {found}");
    }
}

/// Walks through a value. Where it is, it learns only on the way out of an error.
#[derive(Default)]
struct Probe {
    /// Fields of a struct that are known to be finite.
    known: [Option<&'static str>; 2],
}

/// What was found, or what kept the probe from looking; small, since every number passes one on.
#[derive(Debug)]
struct Found(Box<Trace>);

/// Where it was found, outermost step first, and what it is.
#[derive(Debug)]
struct Trace {
    path: String,
    what: String,
}

impl Found {
    fn new(what: impl Display) -> Self {
        Self(Box::new(Trace { path: String::new(), what: what.to_string() }))
    }

    /// The same, seen from one step further out.
    fn within(mut self, step: impl Display) -> Self {
        self.0.path.insert_str(0, &step.to_string());
        self
    }
}

impl Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` is {}", self.0.path.trim_matches('.'), self.0.what)
    }
}
impl std::error::Error for Found {}
impl ser::Error for Found {
    fn custom<T: Display>(message: T) -> Self {
        Self::new(message)
    }
}

/// Looks at what a field or a key leads to.
fn field<T: Serialize + ?Sized>(name: &str, value: &T) -> Result<(), Found> {
    value.serialize(Probe::default()).map_err(|found| found.within(format_args!(".{name}")))
}

/// Scalars that cannot be infinite.
macro_rules! pass {
    ($($method:ident: $type:ty),*) => {
        $(fn $method(self, _: $type) -> Result<(), Found> { Ok(()) })*
    };
}

impl ser::Serializer for Probe {
    type Ok = ();
    type Error = Found;
    type SerializeSeq = Inside;
    type SerializeTuple = Inside;
    type SerializeTupleStruct = Inside;
    type SerializeTupleVariant = Inside;
    type SerializeMap = Inside;
    type SerializeStruct = Inside;
    type SerializeStructVariant = Inside;

    fn serialize_f64(self, v: f64) -> Result<(), Found> {
        // In words: `NaN` is nothing for a reader, nor for who looks for it in a file.
        let what = if v.is_nan() { "no number" } else { "infinite" };
        if v.is_finite() { Ok(()) } else { Err(Found::new(what)) }
    }
    fn serialize_f32(self, v: f32) -> Result<(), Found> {
        self.serialize_f64(v.into())
    }
    pass!(serialize_bool: bool, serialize_i8: i8, serialize_i16: i16, serialize_i32: i32, serialize_i64: i64,
          serialize_u8: u8, serialize_u16: u16, serialize_u32: u32, serialize_u64: u64, serialize_char: char,
          serialize_str: &str, serialize_bytes: &[u8], serialize_unit_struct: &'static str);
    fn serialize_none(self) -> Result<(), Found> {
        Ok(())
    }
    fn serialize_unit(self) -> Result<(), Found> {
        Ok(())
    }
    fn serialize_unit_variant(self, _: &'static str, _: u32, _: &'static str) -> Result<(), Found> {
        Ok(())
    }
    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), Found> {
        value.serialize(self)
    }
    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Result<(), Found> {
        value.serialize(self)
    }
    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Result<(), Found> {
        field(variant, value)
    }
    fn serialize_seq(self, _: Option<usize>) -> Result<Inside, Found> {
        Ok(Inside::default())
    }
    fn serialize_tuple(self, _: usize) -> Result<Inside, Found> {
        Ok(Inside::default())
    }
    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Inside, Found> {
        Ok(Inside::default())
    }
    fn serialize_tuple_variant(self, _: &'static str, _: u32, _: &'static str, _: usize) -> Result<Inside, Found> {
        Ok(Inside::default())
    }
    fn serialize_map(self, _: Option<usize>) -> Result<Inside, Found> {
        Ok(Inside::default())
    }
    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Inside, Found> {
        Ok(Inside { known: self.known, ..Inside::default() })
    }
    fn serialize_struct_variant(self, _: &'static str, _: u32, _: &'static str, _: usize) -> Result<Inside, Found> {
        Ok(Inside::default())
    }
}

/// Inside a sequence, a map or a struct.
#[derive(Default)]
struct Inside {
    next: usize,
    key: String,
    known: [Option<&'static str>; 2],
}

impl Inside {
    fn item<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Found> {
        let index = self.next;
        self.next += 1;
        value.serialize(Probe::default()).map_err(|found| found.within(format_args!("[{index}]")))
    }
}

/// The traits that differ only in the name of their one method.
macro_rules! items {
    ($($trait:ident $method:ident),*) => {$(
        impl ser::$trait for Inside {
            type Ok = ();
            type Error = Found;
            fn $method<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Found> {
                self.item(value)
            }
            fn end(self) -> Result<(), Found> {
                Ok(())
            }
        }
    )*};
}
items!(SerializeSeq serialize_element, SerializeTuple serialize_element, SerializeTupleStruct serialize_field,
       SerializeTupleVariant serialize_field);

macro_rules! fields {
    ($($trait:ident),*) => {$(
        impl ser::$trait for Inside {
            type Ok = ();
            type Error = Found;
            fn serialize_field<T: Serialize + ?Sized>(&mut self, name: &'static str, value: &T) -> Result<(), Found> {
                if self.known.contains(&Some(name)) { Ok(()) } else { field(name, value) }
            }
            fn end(self) -> Result<(), Found> {
                Ok(())
            }
        }
    )*};
}
fields!(SerializeStruct, SerializeStructVariant);

impl ser::SerializeMap for Inside {
    type Ok = ();
    type Error = Found;
    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), Found> {
        self.key = word(key);
        Ok(())
    }
    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Found> {
        field(&self.key, value)
    }
    fn serialize_entry<K, T>(&mut self, key: &K, value: &T) -> Result<(), Found>
    where
        K: Serialize + ?Sized,
        T: Serialize + ?Sized,
    {
        value.serialize(Probe::default()).map_err(|found| found.within(format_args!(".{}", word(key))))
    }
    fn end(self) -> Result<(), Found> {
        Ok(())
    }
}

/// A key in the path; keys that are no strings do not occur in a solution.
fn word<K: Serialize + ?Sized>(key: &K) -> String {
    let value = serde_json::to_value(key).ok();
    value.and_then(|key| key.as_str().map(str::to_owned)).unwrap_or_else(|| "?".into())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::samples;

    #[test]
    fn sound_solutions_pass() {
        for solution in [samples::flat_with_friction(), samples::cylinder_without_friction(), samples::refused()] {
            assert_eq!(first_not_finite(&solution), None);
        }
    }

    #[test]
    fn every_hiding_place_is_looked_at() {
        let plant = |put: fn(&mut Solution)| {
            let mut solution = samples::flat_with_friction();
            put(&mut solution);
            first_not_finite(&solution).expect("a number that is not finite")
        };
        assert_eq!(plant(|s| s.load.force = Some(f64::NAN)), "`load.force` is no number");
        assert_eq!(plant(|s| s.profile.x[7] = f64::INFINITY), "`profile.x[7]` is infinite");
        assert_eq!(plant(|s| s.profile.pressure[3] = Some(f64::NEG_INFINITY)), "`profile.pressure[3]` is infinite");
        assert_eq!(
            plant(|s| s.stick.as_mut().unwrap().one_minus_ratio = Some(f64::NAN)),
            "`stick.one_minus_ratio` is no number"
        );
        assert_eq!(plant(|s| s.error.each.extend([("edge.ratio", f64::NAN)])), "`error.each.edge.ratio` is no number");
        assert_eq!(plant(|s| s.scene.output.x = Some(vec![0.0, f64::NAN])), "`scene.output.x[1]` is no number");
    }
}
