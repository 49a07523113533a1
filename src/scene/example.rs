//! What the example of a plugin's record tells of it.

use slipzone_api::{Grading, PluginInfo};
use toml::Table;

/// Whether a layer of this grading needs no thickness of its own.
pub(crate) fn knows_thickness(info: &PluginInfo) -> bool {
    toml::from_str::<Box<dyn Grading>>(info.example).is_ok_and(|grading| grading.thickness().is_some())
}

/// The inline table that names a plugin with the keys that it requires, as in its example, and one that is set.
pub(crate) fn least(info: &PluginInfo, set: Option<(&str, f64)>) -> String {
    let example: Table = toml::from_str(info.example).unwrap_or_default();
    let is_set = |name: &str| set.is_some_and(|(key, _)| key == name);
    let required = info.parameters.iter().filter(|key| key.required && !is_set(key.name));
    let required = required.filter_map(|key| Some(format!(", {} = {}", key.name, example.get(key.name)?)));
    // A whole number is written as one, which keys of any numbers take as well.
    let keys: String = required.chain(set.map(|(key, value)| format!(", {key} = {value}"))).collect();
    format!("{{ type = {:?}{keys} }}", info.name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use slipzone_api::Family;

    #[test]
    fn what_is_required_stands_as_in_the_example() {
        crate::link_plugins();
        let named = |family, name, more| least(slipzone_api::find(family, name).unwrap(), more);
        assert_eq!(named(Family::Quadrature, "de-sinc", None), "{ type = \"de-sinc\" }");
        assert_eq!(named(Family::Quadrature, "de-sinc", Some(("n", 8.0))), "{ type = \"de-sinc\", n = 8 }");
        let linear = named(Family::Grading, "linear", Some(("base", 2.5)));
        assert!(
            linear.starts_with("{ type = \"linear\", surface = ") && linear.ends_with(", base = 2.5 }"),
            "{linear}"
        );
    }
}
