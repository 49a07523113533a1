//! The JSON schema of a scene file, for editors.

use super::KEYS;
use super::example::knows_thickness;
use serde_json::{Map, Value, json};
use slipzone_api::{Family, MODERATE, Parameter, PluginInfo, Values, plugins};

/// The schema of a scene file (JSON schema, draft 7), made from the registry: it knows every plugin that is linked.
///
/// It says which keys there are, which exclude each other, and what numbers may be. What takes more than one look, such
/// as a formula or a punch that is not convex, only [`super::parse`] finds.
///
/// ```
/// let schema = slipzone::scene::schema();
/// assert_eq!(schema["properties"]["layer"]["properties"]["thickness"]["minimum"], 1e-100);
/// ```
pub fn schema() -> Value {
    crate::link_plugins();
    let mut schema = object(KEYS, None);
    let layer = &mut schema["properties"]["layer"];
    for (key, value) in thickness() {
        layer[key] = value;
    }
    let families = Family::ALL.map(|family| (family.name(), json!({ "oneOf": family_of(family) })));
    schema["$schema"] = json!("http://json-schema.org/draft-07/schema#");
    schema["title"] = json!("slipzone scene, format 1");
    schema["definitions"] = families.into_iter().map(|(name, schema)| (name.to_owned(), schema)).collect();
    schema
}

/// The plugins of a family, each an object of its own.
fn family_of(family: Family) -> Vec<Value> {
    let own = plugins().into_iter().filter(|info| info.family == family);
    own.map(|info| kind(info.name, info.summary, info.parameters)).collect()
}

/// An object of one `type`.
fn kind(name: &str, summary: &str, parameters: &[Parameter]) -> Value {
    let mut schema = object(parameters, Some(name));
    schema["title"] = json!(name);
    schema["description"] = json!(summary);
    schema
}

/// A table of these keys and no others.
fn object(keys: &[Parameter], tag: Option<&str>) -> Value {
    let tag_schema = tag.map(|tag| ("type".to_owned(), json!({ "const": tag })));
    let described = keys.iter().map(|key| (key.name.to_owned(), describe(key)));
    let properties: Map<String, Value> = tag_schema.into_iter().chain(described).collect();
    let mut rules = Vec::new();
    let mut required: Vec<&str> = tag.map(|_| "type").into_iter().collect();
    for key in keys {
        let others = keys.iter().filter(|other| other.in_place_of == Some(key.name));
        let group: Vec<&str> = std::iter::once(key.name).chain(others.map(|other| other.name)).collect();
        match (group.as_slice(), key.required) {
            ([_], true) => required.push(key.name),
            ([_], false) => {}
            (group, must) => rules.push(one_of(group, must)),
        }
    }
    let mut schema = json!({ "type": "object", "properties": properties, "additionalProperties": false });
    if !required.is_empty() {
        schema["required"] = json!(required);
    }
    if !rules.is_empty() {
        schema["allOf"] = json!(rules);
    }
    schema
}

/// One of these keys; or none of them, unless one `must` be there.
fn one_of(group: &[&str], must: bool) -> Value {
    let each = group.iter().map(|key| json!({ "required": [key] }));
    let none = json!({ "not": { "anyOf": each.clone().collect::<Vec<_>>() } });
    json!({ "oneOf": each.chain((!must).then_some(none)).collect::<Vec<_>>() })
}

/// A key: what it may hold, and what for.
fn describe(key: &Parameter) -> Value {
    let mut schema = match key.values {
        Values::Unstated if !key.samples.is_empty() => json!({ "type": "number" }),
        values => of(values),
    };
    let other = key.in_place_of.map_or(String::new(), |other| format!("; in place of `{other}`"));
    schema["description"] = json!(format!("{}{other}", key.summary));
    if !key.samples.is_empty() {
        let whole = matches!(key.values, Values::Whole(..) | Values::Even(..));
        #[allow(clippy::cast_possible_truncation)] // samples are small
        let sample = |sample: &f64| if whole { json!(*sample as i64) } else { json!(sample) };
        schema["examples"] = key.samples.iter().map(sample).collect();
    }
    schema
}

/// The smallest and the largest number that is computed with.
const SMALLEST: f64 = *MODERATE.start();
const LARGEST: f64 = *MODERATE.end();

/// The schema of what a key may hold.
fn of(values: Values) -> Value {
    match values {
        Values::Unstated => json!({}),
        Values::Number => json!({ "type": "number", "minimum": -LARGEST, "maximum": LARGEST }),
        Values::Positive => json!({ "type": "number", "minimum": SMALLEST, "maximum": LARGEST }),
        Values::UpTo(most) => json!({ "type": "number", "minimum": SMALLEST, "maximum": most }),
        Values::Poisson => json!({ "type": "number", "exclusiveMinimum": -1.0, "maximum": 0.5 }),
        Values::Between(least, most) => json!({ "type": "number", "minimum": least, "maximum": most }),
        Values::Whole(least, most) if least == most => json!({ "const": least }),
        Values::Whole(least, most) => json!({ "type": "integer", "minimum": least, "maximum": most }),
        Values::Even(least, most) => json!({ "type": "integer", "minimum": least, "maximum": most, "multipleOf": 2 }),
        Values::Flag => json!({ "type": "boolean" }),
        Values::Text => json!({ "type": "string" }),
        Values::Line(most) => json!({ "type": "string", "maxLength": most, "pattern": PRINTABLE }),
        Values::OneOf(words) => json!({ "enum": words }),
        Values::List(entry, least, most) => {
            // Words are listed once each.
            let once = matches!(entry, Values::OneOf(_));
            json!({ "type": "array", "items": of(*entry), "minItems": least, "maxItems": most, "uniqueItems": once })
        }
        Values::ByName(entry) => json!({ "type": "object", "additionalProperties": of(*entry) }),
        Values::Table(keys) => object(keys, None),
        Values::Choice(kinds) => {
            json!({ "oneOf": kinds.iter().map(|each| kind(each.name, each.summary, each.parameters)).collect::<Vec<_>>() })
        }
        Values::Plugin(family) => json!({ "$ref": format!("#/definitions/{}", family.name()) }),
    }
}

/// Text without control characters.
const PRINTABLE: &str = r"^[^\u0000-\u001f\u007f-\u009f]*$";

/// A layer has a thickness, unless its grading knows its own; a solid without a base has none.
fn thickness() -> [(&'static str, Value); 3] {
    let given = json!({ "required": ["thickness"] });
    // One that holds another may know what that knows.
    let holds_another =
        |info: &PluginInfo| info.parameters.iter().any(|key| key.values == Values::Plugin(Family::Grading));
    let gradings = plugins().into_iter().filter(|info| info.family == Family::Grading);
    let known = gradings.filter(|info| knows_thickness(info) || holds_another(info));
    let names: Vec<_> = known.map(|info| info.name).collect();
    let known =
        json!({ "properties": { "grading": { "properties": { "type": { "enum": names } }, "required": ["type"] } } });
    let infinite = json!({ "properties": { "type": { "const": "infinite" } }, "required": ["type"] });
    [
        ("if", json!({ "properties": { "base": infinite }, "required": ["base"] })),
        ("then", json!({ "not": given })),
        ("else", json!({ "anyOf": [given, known] })),
    ]
}
