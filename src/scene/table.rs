//! A scene as its file has it: what it says of the load is one table there.

use super::load_path::LoadTable;
use super::{Layer, Output, Scene, Solver, Units, tagged};
use serde::ser::{Serialize, SerializeStruct, Serializer};
use slipzone_api::{Friction, PunchProfile};

/// The sections of a scene file.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SceneTable {
    format: u32,
    title: Option<String>,
    layer: Layer,
    punch: Box<dyn PunchProfile>,
    #[serde(default, deserialize_with = "tagged::friction")]
    friction: Option<Friction>,
    load: LoadTable,
    #[serde(default)]
    solver: Solver,
    #[serde(default)]
    output: Output,
    #[serde(default)]
    units: Units,
}

impl From<SceneTable> for Scene {
    fn from(table: SceneTable) -> Self {
        let SceneTable { format, title, layer, punch, friction, load, solver, output, units } = table;
        let LoadTable { load, path } = load;
        Self { format, title, layer, punch, friction, load, path, solver, output, units }
    }
}

impl Serialize for Scene {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        // Taken apart, so that a field that is added is not forgotten.
        let Self { format, title, layer, punch, friction, load, path, solver, output, units } = self;
        let mut table = serializer.serialize_struct("Scene", 9)?;
        table.serialize_field("format", format)?;
        table.serialize_field("title", title)?;
        table.serialize_field("layer", layer)?;
        table.serialize_field("punch", punch)?;
        table.serialize_field("friction", friction)?;
        table.serialize_field("load", &LoadTable { load: *load, path: path.clone() })?;
        table.serialize_field("solver", solver)?;
        table.serialize_field("output", output)?;
        table.serialize_field("units", units)?;
        table.end()
    }
}
