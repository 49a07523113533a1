//! `slipzone check`: is this a scene?

use super::{Failure, Outcome, input, print};
use crate::api::rounded;
use crate::scene::Scene;
use crate::{engine, report};
use std::path::Path;

pub(super) fn run(path: &Path) -> Result<Outcome, Failure> {
    let (scene, _) = input::scene(path)?;
    print::result(&format!("ok: {}", summary(&scene)))?;
    if let Some(refusal) = engine::refusal(&scene) {
        print::result(&format!("but solving it would be refused: {refusal}"))?;
    }
    Ok(Outcome::Done)
}

/// A scene in one line.
fn summary(scene: &Scene) -> String {
    let title = scene.title.as_ref().map_or(String::new(), |title| format!("{title}: "));
    let path = scene.path.as_ref().map_or(String::new(), |path| {
        format!(", on a path of {} from {}", path.points(), rounded(path.load(0).value().get(), 8))
    });
    format!("{title}{}{path}", report::scene_line(scene))
}
