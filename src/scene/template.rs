//! A scene of which some values are replaced: what the scenes of a study have in common.

use super::document::{Document, written};
use super::error::{Kind, SHOWN, SceneError};
use super::{Known, Scene, checked};
use serde::Deserialize;
use serde::de::IntoDeserializer;
use slipzone_api::{Files, clip};
use std::borrow::Cow;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// The text of a scene that is valid as it stands.
#[derive(Debug)]
pub(crate) struct Template {
    name: String,
    text: String,
    /// As it stands.
    scene: Scene,
}

/// A place in the scene, and what is to stand there.
#[derive(Debug)]
pub(crate) struct Replacement<'a> {
    /// Keys and indices that lead there: `["layer", "grading", "base"]`.
    pub(crate) path: &'a [String],
    /// A value as TOML writes it.
    pub(crate) value: Cow<'a, str>,
}

impl<'a> Replacement<'a> {
    /// A number, with all its digits.
    pub(crate) fn number(path: &'a [String], number: f64) -> Self {
        Self { path, value: format!("{number:?}").into() }
    }
}

impl Template {
    /// A scene file.
    pub(crate) fn parse(name: &str, text: String, files: &dyn Files) -> Result<Self, SceneError> {
        let scene = super::parse_with(name, &text, files)?;
        Ok(Self { name: name.into(), text, scene })
    }

    /// A table of another document, in which its errors have their places.
    pub(crate) fn within(document: &Document, table: &str, files: &dyn Files) -> Result<Self, SceneError> {
        let part = document.part("scene", table);
        let scene = checked(&part, files, &Known::default())?;
        // Places are not needed any more: replaced values have none in this text.
        let mut whole = toml::Table::new();
        for (key, value) in part.tree().get_ref() {
            whole.insert(key.get_ref().to_string(), plain(document, value)?);
        }
        Ok(Self { name: part.name().into(), text: whole.to_string(), scene })
    }

    /// The scene with some values replaced, or set where nothing stood. Its errors have no place. What was made of
    /// files is not made again for a section that stays as it is.
    pub(crate) fn with(&self, replacements: &[Replacement], files: &dyn Files) -> Result<Scene, SceneError> {
        let whole = |what: String| SceneError::whole(&self.name, what);
        let mut tree = DeTable::parse(&self.text).map_err(|error| whole(error.message().into()))?;
        for Replacement { path, value } in replacements {
            let value = DeValue::parse(value).map_err(|error| whole(error.message().into()))?;
            set(tree.get_mut(), path, value).map_err(|at| {
                whole(format!("the scene has no place for `{}`", path.join(".")))
                    .found(format!("no table and no array at `{}`", path[..at].join(".")))
                    .expected("a path of keys, in arrays of indices, of the base scene")
                    .of_kind(Kind::NoPlace)
            })?;
        }
        let is_kept = |section: &[&str]| !replacements.iter().any(|replaced| overlap(replaced.path, section));
        let known = Known {
            grading: is_kept(&["layer", "grading"]).then_some(&self.scene),
            punch: is_kept(&["punch"]).then_some(&self.scene),
        };
        checked(&Document::of_scene(&self.name, tree), files, &known)
    }

    /// The scene as it stands.
    pub(crate) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What errors call the scene.
    pub(crate) fn name(&self) -> &str {
        &self.name
    }

    /// The scene as text.
    pub(crate) fn text(&self) -> &str {
        &self.text
    }
}

/// Whether one of two paths leads to what the other leads to, into it, or to a table that holds it.
pub(crate) fn overlap(path: &[String], other: &[impl AsRef<str>]) -> bool {
    path.iter().zip(other).all(|(one, other)| one == other.as_ref())
}

/// Puts a value where a path leads, making tables on the way; tells how far it came otherwise.
fn set<'a>(table: &mut DeTable<'a>, path: &[String], value: Spanned<DeValue<'a>>) -> Result<(), usize> {
    let Some((first, rest)) = path.split_first() else { return Err(0) };
    if rest.is_empty() {
        table.insert(key(first), value);
        return Ok(());
    }
    if !table.contains_key(first.as_str()) {
        table.insert(key(first), Spanned::new(0..0, DeValue::Table(DeTable::new())));
    }
    let Some(next) = table.get_mut(first.as_str()) else { return Err(0) };
    set_within(next, rest, value).map_err(|at| at + 1)
}

fn set_within<'a>(place: &mut Spanned<DeValue<'a>>, path: &[String], value: Spanned<DeValue<'a>>) -> Result<(), usize> {
    let Some((first, rest)) = path.split_first() else {
        *place = value;
        return Ok(());
    };
    match place.get_mut() {
        DeValue::Table(table) => set(table, path, value),
        DeValue::Array(array) => {
            let index: usize = first.parse().map_err(|_| 0_usize)?;
            let next = array.get_mut(index).ok_or(0_usize)?;
            set_within(next, rest, value).map_err(|at| at + 1)
        }
        _ => Err(0),
    }
}

fn key(name: &str) -> Spanned<Cow<'static, str>> {
    Spanned::new(0..0, Cow::Owned(name.to_owned()))
}

/// A value without its place; an integer that 64 bits do not hold is refused.
pub(crate) fn plain(document: &Document, value: &Spanned<DeValue>) -> Result<toml::Value, SceneError> {
    toml::Value::deserialize(value.clone().into_deserializer()).map_err(|error| {
        let error = document.error(error.span().unwrap_or(value.span()), "an integer beyond 64 bits");
        error
            .found(format!("`{}`", clip(&written(value.get_ref()), SHOWN)))
            .expected("a number with a decimal point, or one nearer to 0")
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use slipzone_api::NoFiles;

    struct Heights;

    impl Files for Heights {
        fn read(&self, _: &str) -> Result<Vec<u8>, String> {
            Ok(b"0,0\n1,1\n2,4\n3,9\n4,16\n".to_vec())
        }
    }

    #[test]
    fn what_a_section_has_read_is_not_read_again_while_it_stays_as_it_is() {
        crate::link_plugins();
        let text = "format = 1\nlayer = { thickness = 1.0, poisson = 0.3, grading = { type = \"homogeneous\", modulus = 1.0 } }\n\
                    punch = { type = \"table\", file = \"heights.csv\" }\nload = { half_width = 1.0 }\n";
        let template = Template::parse("scene.toml", text.into(), &Heights).unwrap();
        let with = |path: &[&str], value: &'static str| {
            let path: Vec<String> = path.iter().copied().map(str::to_owned).collect();
            template.with(&[Replacement { path: &path, value: value.into() }], &NoFiles)
        };
        for path in [&["load", "half_width"][..], &["layer", "grading", "modulus"], &["layer", "poisson"]] {
            assert!(with(path, "0.25").is_ok(), "{path:?}");
        }
        for (path, value) in
            [(&["punch", "height_unit"][..], "2.0"), (&["punch"], "{ type = \"table\", file = \"heights.csv\" }")]
        {
            let error = with(path, value).unwrap_err();
            assert!(error.message.contains("cannot read the file"), "{path:?}: {error}");
        }
    }
}
