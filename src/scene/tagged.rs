//! The enums of a scene that are chosen by `type`, read key by key.
//!
//! The derived code of an internally tagged enum reads the whole table before it looks at it: an error
//! inside would lose its key, and extra keys beside `type = "rigid"` would pass. Plugins need no such
//! help, `typetag` streams what follows a leading `type`.

use serde::de::value::MapAccessDeserializer;
use serde::de::{Deserialize, Deserializer, Error, MapAccess, Visitor};
use slipzone_api::{Base, Friction, FrozenStrain, Moduli, Poisson, Positive};
use std::fmt;

/// Reads `layer.base`.
pub(super) fn base<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Base, D::Error> {
    deserializer.deserialize_map(BaseTable)
}

/// Reads `[friction]`; the scene of a result says `null` where there is none.
pub(super) fn friction<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Friction>, D::Error> {
    Option::<Tagged>::deserialize(deserializer).map(|tagged| tagged.map(|Tagged(friction)| friction))
}

struct Tagged(Friction);

impl<'de> Deserialize<'de> for Tagged {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(FrictionTable).map(Tagged)
    }
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct NoKeys {}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct HalfPlane {
    shear: Option<Positive>,
    young: Option<Positive>,
    poisson: Poisson,
}

impl HalfPlane {
    fn shear<E: Error>(&self) -> Result<Positive, E> {
        match (self.shear, self.young) {
            (Some(shear), None) => Ok(shear),
            (None, Some(young)) => {
                Positive::new(Moduli::Young.shear(young.get(), self.poisson.get())).map_err(E::custom)
            }
            (Some(_), Some(_)) => Err(E::custom("expected one of `shear` and `young`, found both")),
            (None, None) => Err(E::missing_field("shear")),
        }
    }
}

#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Goodman {
    coefficient: Positive,
    #[serde(default)]
    strain: FrozenStrain,
}

struct BaseTable;

impl<'de> Visitor<'de> for BaseTable {
    type Value = Base;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a table such as `{ type = \"rigid\" }`")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Base, A::Error> {
        let tag = tag(&mut map)?;
        let rest = MapAccessDeserializer::new(map);
        match tag.as_str() {
            "rigid" => NoKeys::deserialize(rest).map(|_| Base::Rigid),
            "frictionless" => NoKeys::deserialize(rest).map(|_| Base::Frictionless),
            "infinite" => NoKeys::deserialize(rest).map(|_| Base::Infinite),
            "half-plane" => {
                let base = HalfPlane::deserialize(rest)?;
                Ok(Base::HalfPlane { shear: base.shear()?, poisson: base.poisson })
            }
            _ => Err(A::Error::unknown_variant(&tag, &["rigid", "frictionless", "half-plane", "infinite"])),
        }
    }
}

struct FrictionTable;

impl<'de> Visitor<'de> for FrictionTable {
    type Value = Friction;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a table with `type` and `coefficient`")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Friction, A::Error> {
        let tag = tag(&mut map)?;
        let rest = MapAccessDeserializer::new(map);
        match tag.as_str() {
            "goodman" => Goodman::deserialize(rest)
                .map(|Goodman { coefficient, strain }| Friction::Goodman { coefficient, strain }),
            _ => Err(A::Error::unknown_variant(&tag, &["goodman"])),
        }
    }
}

/// The value of the leading `type`; [`super::decode`] moves it to the front.
fn tag<'de, A: MapAccess<'de>>(map: &mut A) -> Result<String, A::Error> {
    match map.next_key::<String>()?.as_deref() {
        Some("type") => map.next_value(),
        _ => Err(A::Error::missing_field("type")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Serialize;

    /// Each variant as the derived code writes it is read back here: a new one that is forgotten above
    /// fails.
    #[test]
    fn every_variant_is_known() {
        #[derive(Debug, PartialEq, Serialize, serde::Deserialize)]
        struct Doc {
            #[serde(deserialize_with = "base")]
            base: Base,
            #[serde(deserialize_with = "friction")]
            friction: Option<Friction>,
        }
        let positive = Positive::new(0.25).unwrap();
        let poisson = Poisson::new(0.3).unwrap();
        let friction = Some(Friction::Goodman { coefficient: positive, strain: FrozenStrain::Linear });
        let bases = [Base::Rigid, Base::Frictionless, Base::HalfPlane { shear: positive, poisson }, Base::Infinite];
        for base in bases {
            // A reminder to extend the list: this match is checked for completeness.
            match base {
                Base::Rigid | Base::Frictionless | Base::HalfPlane { .. } | Base::Infinite => {}
            }
            let doc = Doc { base, friction };
            let text = toml::to_string(&doc).unwrap();
            assert_eq!(toml::from_str::<Doc>(&text).unwrap(), doc, "{text}");
        }
    }
}
