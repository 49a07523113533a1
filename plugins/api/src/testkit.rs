//! Checks that each plugin crate runs over its own plugins: `testkit::check_crate(env!("CARGO_PKG_NAME"))`.

use crate::{Family, Flexibility, Grading, KernelStrategy, PluginInfo, PunchProfile, Quadrature, plugins};

/// Checks every plugin of one crate: its example parses, its tag is its registered name, an unknown key
/// is refused, each documented key is known and each sample value accepted, and names are unique.
///
/// # Panics
/// With the plugin's name and what is wrong with it.
pub fn check_crate(krate: &str) {
    let own: Vec<_> = plugins().into_iter().filter(|info| info.krate == krate).collect();
    assert!(!own.is_empty(), "{krate} registers no plugin: is `link()` naming every module?");
    for info in own {
        check_plugin(info);
    }
}

fn check_plugin(info: &PluginInfo) {
    let name = info.name;
    let twins = plugins().iter().filter(|other| (other.family, other.name) == (info.family, name)).count();
    assert_eq!(twins, 1, "{name}: {twins} plugins of this family share the name");

    let tag = parse(info.family, info.example).unwrap_or_else(|e| panic!("{name}: its example does not parse: {e}"));
    assert_eq!(tag, name, "the example of `{name}` parses as `{tag}`");

    let bogus = format!("{}\nno_such_key = 1", info.example);
    assert!(parse(info.family, &bogus).is_err(), "{name}: an unknown key passes; add #[serde(deny_unknown_fields)]");

    let table: toml::Table = toml::from_str(info.example).expect("parsed above");
    for key in table.keys().filter(|key| *key != "type") {
        assert!(info.parameters.iter().any(|p| p.name == key), "{name}: key `{key}` is not documented");
    }
    for parameter in info.parameters {
        for &sample in parameter.samples {
            let mut changed = table.clone();
            let value = if sample.fract() == 0.0 && table.get(parameter.name).is_none_or(toml::Value::is_integer) {
                #[allow(clippy::cast_possible_truncation)] // samples are small
                toml::Value::Integer(sample as i64)
            } else {
                toml::Value::Float(sample)
            };
            changed.insert(parameter.name.into(), value);
            let text = toml::to_string(&changed).expect("a table of numbers");
            assert!(parse(info.family, &text).is_ok(), "{name}: sample {} = {sample} is refused", parameter.name);
        }
        if parameter.required {
            let mut without = table.clone();
            without.remove(parameter.name);
            let text = toml::to_string(&without).expect("a table of numbers");
            assert!(parse(info.family, &text).is_err(), "{name}: key `{}` is not required after all", parameter.name);
        }
    }
}

/// Parses a table of one family and gives its typetag name, after a round trip through text.
fn parse(family: Family, text: &str) -> Result<String, toml::de::Error> {
    macro_rules! round_trip {
        ($config:ty) => {{
            let once: Box<$config> = toml::from_str(text)?;
            let written = toml::to_string(&once).expect("a config serialises");
            let twice: Box<$config> = toml::from_str(&written)?;
            assert_eq!(format!("{once:?}"), format!("{twice:?}"), "writing and reading back changes it");
            Ok(once.typetag_name().to_owned())
        }};
    }
    match family {
        Family::Grading => round_trip!(dyn Grading),
        Family::Punch => round_trip!(dyn PunchProfile),
        Family::Flexibility => round_trip!(dyn Flexibility),
        Family::Kernel => round_trip!(dyn KernelStrategy),
        Family::Quadrature => round_trip!(dyn Quadrature),
    }
}
