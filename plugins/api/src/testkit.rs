//! Checks that each plugin crate runs over its own plugins: `testkit::check_crate(env!("CARGO_PKG_NAME"))`.

mod contracts;
mod densities;
mod forbidden;
mod responses;
mod rules;
mod tables;
#[cfg(test)]
mod tests;

pub use rules::solve;

use crate::contract::ensure;
use crate::{Family, Flexibility, Grading, KernelStrategy, PluginInfo, PunchProfile, Quadrature, plugins};

/// Checks every plugin of one crate with [`check_plugin`].
///
/// # Panics
/// With the plugin's name and what is wrong with it, or when the crate registers nothing.
pub fn check_crate(krate: &str) {
    let own: Vec<_> = plugins().into_iter().filter(|info| info.krate == krate).collect();
    assert!(!own.is_empty(), "{krate} registers no plugin: is `link()` naming every module?");
    for info in own {
        check_plugin(info).unwrap_or_else(|fault| panic!("{} `{}`: {fault}", info.family.name(), info.name));
    }
}

/// Checks one plugin; the error says what is wrong with it.
///
/// Its name is unique in its family and equals the tag; its example parses, survives writing and reading back, and
/// refuses an unknown key; the documented keys are those that exist, required where they say so, each sample value is
/// accepted, and what [`crate::Values`] rules out is refused. It keeps the contract of its family, too:
///
/// * a grading: a finite and positive modulus, and all that it tells beside its values;
/// * a punch: an even height whose derivative is the slope;
/// * a flexibility: what small steps through a few layers give (theory.md section 2), of which it may refuse all but
///   one;
/// * a kernel: the transforms of a few flexibilities, to what its tables say of their errors, likewise;
/// * a quadrature: as many equations as the unknowns want, a flat punch on a half-plane to rounding, and densities of
///   each edge that are known in closed form.
pub fn check_plugin(info: &PluginInfo) -> Result<(), String> {
    let twins = plugins().iter().filter(|other| (other.family, other.name) == (info.family, info.name)).count();
    ensure(twins == 1, || format!("{twins} plugins of this family have this name"))?;

    let example = Parsed::new(info.family, info.example).map_err(|e| format!("its example fails: {e}"))?;
    ensure(example.tag == info.name, || format!("its example is a `{}`", example.tag))?;
    let bogus = format!("{}\nno_such_key = 1", info.example);
    ensure(Parsed::new(info.family, &bogus).is_err(), || {
        "an unknown key passes; add #[serde(deny_unknown_fields)]".into()
    })?;

    let table: toml::Table = toml::from_str(info.example).map_err(|e| e.to_string())?;
    // Written back, a config shows keys with defaults that its example leaves out.
    for key in table.keys().chain(example.written.keys()).filter(|key| *key != "type") {
        ensure(info.parameters.iter().any(|p| p.name == key), || format!("key `{key}` is not documented"))?;
    }
    if info.family == Family::Quadrature {
        // As it is where nothing is said of it: what may be said may be too coarse, or fit one edge alone.
        let is_needed = |key: &String| key == "type" || info.parameters.iter().any(|p| p.name == key && p.required);
        let least: toml::Table = table.clone().into_iter().filter(|(key, _)| is_needed(key)).collect();
        let config: Box<dyn Quadrature> = toml::from_str(&least.to_string()).map_err(|e| e.message().to_owned())?;
        densities::quadrature(&*config)?;
    }
    info.parameters.iter().try_for_each(|parameter| check_parameter(info.family, &table, parameter))
}

fn check_parameter(family: Family, example: &toml::Table, parameter: &crate::Parameter) -> Result<(), String> {
    let name = parameter.name;
    let mut example = example.clone();
    if let Some(other) = parameter.in_place_of {
        ensure(!parameter.required, || format!("key `{name}` cannot be required where `{other}` may stand"))?;
        ensure(example.remove(other).is_some(), || {
            format!("key `{name}` stands for `{other}`, which the example lacks")
        })?;
    } else {
        ensure(!parameter.samples.is_empty() || example.contains_key(name), || {
            format!("key `{name}` has neither a sample nor a place in the example")
        })?;
    }
    let refusal = |table: &toml::Table| Parsed::new(family, &table.to_string()).err();
    let decodes = |table: &toml::Table| Parsed::decode(family, &table.to_string()).map(|_| ());
    for &sample in parameter.samples {
        let mut changed = example.clone();
        let value = if sample.fract() == 0.0 && example.get(name).is_none_or(toml::Value::is_integer) {
            #[allow(clippy::cast_possible_truncation)] // samples are small
            toml::Value::Integer(sample as i64)
        } else {
            toml::Value::Float(sample)
        };
        changed.insert(name.into(), value);
        if let Some(fault) = refusal(&changed) {
            return Err(format!("sample {name} = {sample} fails: {fault}"));
        }
    }
    for value in forbidden::values(parameter.values) {
        let mut changed = example.clone();
        changed.insert(name.into(), value.clone());
        // What cannot be told while decoding is told with the contract.
        ensure(refusal(&changed).is_some(), || {
            format!("`{name} = {value}` passes, which is not among {:?}", parameter.values)
        })?;
    }
    if parameter.in_place_of.is_some() {
        return ensure(decodes(&example).is_err(), || format!("key `{name}` stands for one that may be left out"));
    }
    let mut without = example.clone();
    without.remove(name);
    // A formula may do without parameters though the example's does not: what counts is that the table is understood.
    let is_required = decodes(&without).is_err();
    ensure(!parameter.required || is_required, || format!("key `{name}` is not required after all"))?;
    ensure(parameter.required || !is_required, || format!("key `{name}` is required after all"))
}

/// A table that parsed and survived a round trip.
struct Parsed {
    /// Its typetag name.
    tag: String,
    /// How it writes itself.
    written: toml::Table,
    /// Whether it keeps its family's contract.
    contract: Result<(), String>,
}

impl Parsed {
    /// One that keeps its family's contract too.
    fn new(family: Family, text: &str) -> Result<Self, String> {
        let parsed = Self::decode(family, text)?;
        parsed.contract.clone().map(|()| parsed)
    }

    fn decode(family: Family, text: &str) -> Result<Self, String> {
        macro_rules! round_trip {
            ($config:ty) => {{
                let once: Box<$config> = toml::from_str(text).map_err(|e| e.message().to_owned())?;
                let written = toml::Table::try_from(&once).map_err(|e| format!("it cannot be written: {e}"))?;
                let twice: Box<$config> = toml::from_str(&written.to_string()).map_err(|e| e.message().to_owned())?;
                ensure(format!("{once:?}") == format!("{twice:?}"), || {
                    format!("writing and reading back turns {once:?} into {twice:?}")
                })?;
                (once, written)
            }};
        }
        let (tag, written, contract) = match family {
            Family::Grading => {
                let (config, written) = round_trip!(dyn Grading);
                (config.typetag_name(), written, contracts::grading(config.clone()))
            }
            Family::Punch => {
                let (config, written) = round_trip!(dyn PunchProfile);
                (config.typetag_name(), written, contracts::punch(config.clone()))
            }
            Family::Flexibility => {
                let (config, written) = round_trip!(dyn Flexibility);
                (config.typetag_name(), written, responses::flexibility(&*config))
            }
            Family::Kernel => {
                let (config, written) = round_trip!(dyn KernelStrategy);
                (config.typetag_name(), written, tables::kernel(&*config))
            }
            Family::Quadrature => {
                let (config, written) = round_trip!(dyn Quadrature);
                (config.typetag_name(), written, rules::quadrature(&*config))
            }
        };
        Ok(Self { tag: tag.to_owned(), written, contract })
    }
}
