//! The enums of a scene that are chosen by `type`, read key by key.
//!
//! The derived code of an internally tagged enum reads the whole table before it looks at it: an error
//! inside would lose its key, and extra keys beside `type = "rigid"` would pass. Plugins need no such
//! help, `typetag` streams what follows a leading `type`.

use serde::de::value::{MapAccessDeserializer, MapDeserializer};
use serde::de::{Deserialize, DeserializeOwned, Deserializer, Error, MapAccess, Visitor};
use serde_json::Value;
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

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Base, A::Error> {
        let (tag, rest) = tagged(map)?;
        match tag.as_str() {
            "rigid" => rest.read().map(|NoKeys {}| Base::Rigid),
            "frictionless" => rest.read().map(|NoKeys {}| Base::Frictionless),
            "infinite" => rest.read().map(|NoKeys {}| Base::Infinite),
            "half-plane" => {
                let base: HalfPlane = rest.read()?;
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

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Friction, A::Error> {
        let (tag, rest) = tagged(map)?;
        match tag.as_str() {
            "goodman" => rest.read().map(|Goodman { coefficient, strain }| Friction::Goodman { coefficient, strain }),
            _ => Err(A::Error::unknown_variant(&tag, &["goodman"])),
        }
    }
}

/// What a table holds beside its `type`.
enum Rest<A> {
    /// What follows a leading `type`.
    Unread(A),
    /// All of it, where `type` stood further back.
    Read(Vec<(String, Value)>),
}

impl<'de, A: MapAccess<'de>> Rest<A> {
    fn read<T: DeserializeOwned>(self) -> Result<T, A::Error> {
        match self {
            Self::Unread(map) => T::deserialize(MapAccessDeserializer::new(map)),
            Self::Read(entries) => {
                let entries = MapDeserializer::<_, serde_json::Error>::new(entries.into_iter());
                T::deserialize(entries).map_err(A::Error::custom)
            }
        }
    }
}

/// The value of `type`, and the rest. [`super::decode`] moves `type` to the front; elsewhere keys may be sorted.
fn tagged<'de, A: MapAccess<'de>>(mut map: A) -> Result<(String, Rest<A>), A::Error> {
    let mut before = Vec::new();
    while let Some(key) = map.next_key::<String>()? {
        if key != "type" {
            before.push((key, map.next_value()?));
            continue;
        }
        let tag = map.next_value()?;
        if before.is_empty() {
            return Ok((tag, Rest::Unread(map)));
        }
        while let Some(entry) = map.next_entry()? {
            before.push(entry);
        }
        return Ok((tag, Rest::Read(before)));
    }
    Err(A::Error::missing_field("type"))
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
            let sorted = serde_json::to_value(&doc).unwrap();
            assert_eq!(serde_json::from_value::<Doc>(sorted).unwrap(), doc, "{text}");
        }
    }

    /// What is wrong in a table is told wherever its `type` stands.
    #[test]
    fn a_type_further_back_lets_nothing_pass() {
        let told = |text: &str| base(&mut serde_json::Deserializer::from_str(text)).unwrap_err().to_string();
        let last = |keys: &str| told(&format!("{{ {keys}, \"type\": \"half-plane\" }}"));
        assert!(last("\"poisson\": 0.3").contains("missing field `shear`"));
        assert!(last("\"poisson\": 0.3, \"shear\": -1.0").contains("above 0"));
        assert!(last("\"poisson\": 0.3, \"shear\": 1.0, \"shear\": 2.0").contains("duplicate field `shear`"));
        assert!(told("{ \"shear\": 1.0, \"type\": \"rigid\" }").contains("unknown field `shear`"));
        assert!(told("{ \"shear\": 1.0 }").contains("missing field `type`"));
    }
}
