//! Every registered method of a family.

use serde::de::DeserializeOwned;
use slipzone::api::{Family, PluginInfo, plugins};
use toml::Table;

/// Each plugin of a family by its name, configured as in its own example.
pub(crate) fn examples<Config>(family: Family) -> Vec<(&'static str, Config)>
where
    Config: DeserializeOwned,
{
    of_family(family, |_, table| table)
}

/// Each plugin of a family by its name, its optional keys left out: with the resolution open, as a solve
/// refines it.
pub(crate) fn unpinned<Config>(family: Family) -> Vec<(&'static str, Config)>
where
    Config: DeserializeOwned,
{
    of_family(family, |info, mut table| {
        for key in info.parameters.iter().filter(|key| !key.required) {
            table.remove(key.name);
        }
        table
    })
}

fn of_family<Config>(family: Family, prepare: impl Fn(&PluginInfo, Table) -> Table) -> Vec<(&'static str, Config)>
where
    Config: DeserializeOwned,
{
    let own = plugins().into_iter().filter(|info| info.family == family);
    own.map(|info| {
        let table = prepare(info, toml::from_str(info.example).expect("an example is a TOML table"));
        let config = table.try_into().unwrap_or_else(|e| panic!("{} `{}`: {e}", family.name(), info.name));
        (info.name, config)
    })
    .collect()
}
