//! `slipzone check`: is this a scene?

use super::{Failure, Outcome, input, print};
use slipzone::api::{Base, Friction};
use slipzone::engine;
use slipzone::scene::{Load, Scene};
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
    let punch = scene.punch.typetag_name();
    let grading = scene.layer.grading.typetag_name();
    let base = match scene.layer.base {
        Base::Rigid => "layer on a rigid base",
        Base::Frictionless => "layer on a frictionless rigid base",
        Base::HalfPlane { .. } => "layer on a half-plane",
        Base::Infinite => "half-plane",
    };
    let friction = match scene.friction {
        None => "frictionless".into(),
        Some(Friction::Goodman { coefficient, .. }) => format!("Goodman friction {}", coefficient.get()),
    };
    let load = match scene.load {
        Load::Force(force) => format!("force {}", force.get()),
        Load::HalfWidth(half_width) => format!("half-width {}", half_width.get()),
        Load::Indentation(indentation) => format!("indentation {}", indentation.get()),
    };
    let path = scene.path.as_ref().map_or(String::new(), |path| {
        format!(", on a path of {} from {:?}", path.points(), path.load(0).value().get())
    });
    format!("{title}{punch} punch, {grading} {base}, {friction}, {load}{path}")
}
